//! Words, syllables, phones and mouth shapes in time: the tiers, every format they come and go in, whether they match
//! a script, and a guess where there are none yet.
//!
//! What a label means (a syllable, a shape) is not known here; callers say what fits. Finding times in sound is the
//! business of `speech`, and what an author makes of them the `timeline`'s.

mod clock;
mod csv;
mod cues;
mod decode;
mod format;
mod guess;
mod json;
mod layer;
mod matching;
mod textgrid;
mod tiers;

pub use format::{Format, parse, read, write, write_tier};
pub use guess::equal_shares;
pub use matching::{Parting, common, first_parting, match_labels};
pub use tiers::{Interval, Tier, Timing, is_silence_mark};

/// The latest time that is read, in seconds: 100 hours, which is what two digits of hours can say.
pub const MAX_SECONDS: f64 = 360_000.0;

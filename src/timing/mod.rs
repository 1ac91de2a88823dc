//! Words, syllables, phones and mouth shapes in time: the tiers, every format they come and go in, whether they match
//! a script, and a guess where there are none yet.
//!
//! What a label means (a syllable) is not known here; callers say what fits. Only mouth shapes are, where other programs
//! have names of their own for them. Finding times in sound is the
//! business of `speech`, and what an author makes of them the `timeline`'s.

mod audacity;
mod clock;
mod csv;
mod ctm;
mod cues;
mod decode;
mod format;
mod guess;
mod json;
mod lab;
mod layer;
mod matching;
mod moho;
mod rhubarb;
mod shapes;
mod textgrid;
mod tiers;

pub use format::{Format, parse, read, read_at, writable, write, write_tier};
pub use guess::equal_shares;
pub use matching::{Parting, common, first_parting, fitting_tier, match_labels};
pub use moho::FPS as MOHO_FPS;
pub use shapes::{check_shapes, mouth_shape};
pub use tiers::{Interval, Tier, Timing, is_silence_mark};

/// The latest time that is read, in seconds: 100 hours, which is what two digits of hours can say.
pub const MAX_SECONDS: f64 = 360_000.0;

//! The seven ratios of emotions over time: the record and its formats, its smoothing, and the files of other face
//! trackers. Beside the ratios the record has the gaze, lids, mouth and head of the same frames.
//!
//! It does not find shapes in videos, which is the business of `track`; an author's changes are `timeline`'s.

mod bridge;
mod foreign;
pub(crate) mod import;
mod lpr;
mod record;
mod smooth;
mod stream;
mod table;
mod tracks;

pub(crate) use bridge::{bridge_record, bridge_tracks};
pub use lpr::{LprReader, LprWriter, Moment, Whole, is_lpr, to_lpr};
pub use record::{Record, Row};
pub use smooth::{SMOOTH_WIDTH, Steady, smooth_keeping_peaks, smooth_record, smooth_tracks};
pub use stream::RecordReader;
pub use table::decimal;
pub use tracks::{MouthMoves, TrackRow, Tracks};

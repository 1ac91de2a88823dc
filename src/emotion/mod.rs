//! Emotions: a person's calibration, the seven ratios of a shape, and the record of them over time. Beside the ratios
//! the record has the gaze, lids, mouth and head of the same frames.
//!
//! It does not find shapes in videos, which is the room `track`'s, and an author's changes are the `timeline`'s.

mod binding;
mod bridge;
mod calibration;
mod decompose;
mod foreign;
pub mod import;
mod lpr;
mod record;
mod smooth;
mod stream;
mod table;
mod tracks;

pub use binding::Binding;
pub use bridge::{bridge_record, bridge_tracks};
pub use calibration::{
    CALIBRATION, Calibrated, Calibration, CalibrationFile, Inputs, Kept, Marks, Quality, Retake, Shape, ShotFiles,
    ShotInput, ShotQuality, Source, calibrate,
};
pub use decompose::{Choice, Decomposition, Reading};
pub use lpr::{LprReader, LprWriter, Moment, Whole, is_lpr, to_lpr};
pub use record::{Record, Row};
pub use smooth::{SMOOTH_WIDTH, Steady, smooth_keeping_peaks, smooth_record, smooth_tracks};
pub use stream::RecordReader;
pub(crate) use table::decimal;
pub use tracks::{MouthMoves, TrackRow, Tracks};

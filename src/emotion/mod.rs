//! Emotions: a person's calibration, the seven ratios of a shape, and the record of them over time. Beside the ratios
//! the record has the gaze, lids, mouth and head of the same frames.
//!
//! It does not find shapes in videos, which is the room `track`'s, and an author's changes are the `timeline`'s.

mod binding;
mod calibration;
mod decompose;
mod lpr;
mod record;
mod table;
mod tracks;

pub use binding::Binding;
pub use calibration::{
    Calibrated, Calibration, CalibrationFile, Inputs, Marks, Quality, Retake, Shape, ShotFiles, ShotInput, ShotQuality,
    Source, calibrate,
};
pub use decompose::{Choice, Decomposition, Reading};
pub use lpr::{LprReader, LprWriter, Moment};
pub use record::{Record, Row};
pub(crate) use table::decimal;
pub use tracks::{MouthMoves, TrackRow, Tracks};

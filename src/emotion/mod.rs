//! The record of emotions: the seven ratios of every frame as tracking found them, and beside them the gaze, lids,
//! mouth and head of the same frames. Both are tables that a person can read, as CSV or (ratios) JSON.
//!
//! It does not find ratios in pictures, and an author's changes to them are the `timeline`'s.

mod record;
mod table;
mod tracks;

pub use record::{Record, Row};
pub(crate) use table::decimal;
pub use tracks::{MouthMoves, TrackRow, Tracks};

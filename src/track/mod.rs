//! Videos read: from frames to the seven ratios, eyes, mouth and head of each, by active appearance model (paper
//! sec. 3) or by regions (thesis ch. 6).
//!
//! It owns the frames of a video as a stream, and how a face is followed through them. What a shape means is the room
//! `emotion`'s.

use crate::emotion::{Record, Tracks};

/// What was found in a video.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Tracked {
    /// The seven ratios of every frame; a lost frame has confidence 0 and values bridged from its neighbours.
    pub record: Record,
    /// Eyes, mouth and head of every frame.
    pub tracks: Tracks,
    /// What there is to say of it: frames lost, weak calibration.
    pub notes: Vec<String>,
}

//! The kinds of fault of following a face.

use crate::disk::FaultKind;

/// The kind of a fault of this room, as [`Fault::kind`](crate::disk::Fault::kind) gives it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum TrackFault {
    /// No face is found in the video.
    NoFace,
    /// It was stopped by its caller.
    Stopped,
}

impl FaultKind for TrackFault {}

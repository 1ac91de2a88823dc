//! The kinds of fault of reading a video.

use crate::disk::FaultKind;

/// The kind of a fault of this room, as [`Fault::kind`](crate::disk::Fault::kind) gives it; what is wrong with a file
/// itself is a [`FileFault`](crate::disk::FileFault).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum MediaFault {
    /// The program that decodes the video is not there.
    NoDecoder,
    /// The video has no such frame.
    NoSuchFrame,
}

impl FaultKind for MediaFault {}

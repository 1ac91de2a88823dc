//! The kinds of fault of finding times in a recording.

use crate::disk::FaultKind;

/// The kind of a fault of this room, as [`Fault::kind`](crate::disk::Fault::kind) gives it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum SpeechFault {
    /// There is no voice in the recording.
    NoVoice,
    /// The script has no syllables.
    NoScript,
    /// The recording is too short for its script.
    TooShort,
}

impl FaultKind for SpeechFault {}

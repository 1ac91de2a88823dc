//! The kinds of fault of an export.

use crate::disk::FaultKind;

/// The kind of a fault of this room, as [`Fault::kind`](crate::disk::Fault::kind) gives it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ExportFault {
    /// Two files of an export, a file and a folder, or two projects would have the same name.
    NamesClash,
    /// The clip has no such frame.
    NoSuchFrame,
    /// The ratios of a clip with a video are neither in its record nor found in the video.
    NoRatios,
    /// A manifest is damaged, or of another export.
    Manifest,
    /// A part of a divided export is missing, or differs from the others.
    Parts,
    /// The request for a part, or for the job of an engine, cannot be carried out.
    Division,
    /// A thread could not be started, or broke off.
    Threads,
}

impl FaultKind for ExportFault {}

//! The kinds of fault of an export.

use crate::disk::FaultKind;

/// The kind of a fault of this room, as [`Fault::kind`](crate::disk::Fault::kind) gives it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ExportFault {
    /// Two files of an export, a file and a folder, or two projects would have the same name.
    NamesClash,
    /// There is nothing to be shown in moving pictures.
    NoFrames,
    /// The clip has no such frame.
    NoSuchFrame,
    /// The ratios of a clip with a video are neither in its record nor found in the video.
    NoRatios,
    /// The folder or file cannot be written.
    CannotWrite,
    /// A manifest is damaged, or of another export.
    Manifest,
    /// A part of a divided export is missing, or differs from the others.
    Parts,
    /// The request for a part, or for the job of an engine, cannot be carried out.
    Division,
    /// An outside program that makes a form is missing or failed.
    Encoder,
    /// A thread could not be started, or broke off.
    Threads,
    /// The picture is too large for the form.
    TooLarge,
}

impl FaultKind for ExportFault {}

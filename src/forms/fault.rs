//! The kinds of fault of making a form.

use crate::disk::FaultKind;

/// The kind of a fault of this room, as [`Fault::kind`](crate::disk::Fault::kind) gives it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum FormFault {
    /// There is nothing to be shown in moving pictures.
    NoFrames,
    /// The form cannot be encoded or written.
    CannotWrite,
    /// An outside program that makes the form is missing or failed.
    Encoder,
    /// The picture is too large for the form.
    TooLarge,
}

impl FaultKind for FormFault {}

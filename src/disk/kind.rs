//! The kinds of fault: by them a program tells faults apart, without reading their words.

use std::any::Any;
use std::fmt;
use std::io;

/// A room's enum of faults, matched by programs: `fault.kind::<ExportFault>()`.
pub trait FaultKind: Any + fmt::Debug + Send + Sync {}

/// What is wrong with a file, or with a text that was typed. Every fault that is of no other room's kind is of this one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[non_exhaustive]
pub enum FileFault {
    /// It is not written as its format asks for.
    #[default]
    Malformed,
    /// It ends too early.
    CutOff,
    /// There is nothing in it.
    Empty,
    /// A file, or a part that must be in it, is not there.
    Missing,
    /// A name in it is not known.
    Unknown,
    /// A name or a part is there more than once.
    Duplicate,
    /// A value is not among those that are allowed.
    OutOfRange,
    /// It is larger than files of its kind are, or has more parts.
    TooLarge,
    /// Parts of it, or of two files, do not fit each other.
    Mismatch,
    /// It is in a format that is not read.
    Unsupported,
    /// It is of another version of its format.
    Version,
    /// Its text is in another encoding than the format's.
    Encoding,
    /// It lies outside the folder that it must be in.
    Outside,
    /// Another program has changed it meanwhile.
    Changed,
    /// The system does not permit the operation.
    Denied,
    /// The disk is full, or the user's share of it.
    NoSpace,
    /// Another failure of the system.
    System,
}

impl FaultKind for FileFault {}

impl From<io::ErrorKind> for FileFault {
    fn from(kind: io::ErrorKind) -> Self {
        match kind {
            io::ErrorKind::NotFound => Self::Missing,
            io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => Self::Denied,
            io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded | io::ErrorKind::FileTooLarge => Self::NoSpace,
            io::ErrorKind::UnexpectedEof => Self::CutOff,
            io::ErrorKind::InvalidData => Self::Malformed,
            _ => Self::System,
        }
    }
}

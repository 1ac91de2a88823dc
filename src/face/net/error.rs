//! Errors of reading a net.

use std::fmt;

/// A net that cannot be run.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum NetError {
    /// The file is no TensorFlow Lite model, or is cut off or damaged.
    Damaged,
    /// An operation that is not implemented, by its name or its number in the format.
    UnknownOperation(String),
    /// An operation with options or tensor shapes that do not fit it, by its name.
    Mismatch(&'static str),
    /// More values or multiplications than any carried net has: 2^24 values a tensor, 2^32 multiplications a run.
    TooLarge,
}

impl fmt::Display for NetError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Damaged => f.write_str("the file is not a TensorFlow Lite model, or it is damaged"),
            Self::UnknownOperation(name) => write!(f, "the net has an operation that is not implemented: {name}"),
            Self::Mismatch(name) => write!(f, "the operation {name} of the net has options or shapes that do not fit"),
            Self::TooLarge => f.write_str("the net is larger than this program runs"),
        }
    }
}

impl std::error::Error for NetError {}

/// A value, or why the net cannot be run.
pub type Result<T> = std::result::Result<T, NetError>;

//! Praat's TextGrid, long and short.
//!
//! Both forms are the same sequence of values; the long one has words between them that say what each is. Praat reads
//! every value that stands alone and skips the words, and so do we, but where a word contradicts the value that is due
//! we say so instead of misreading the rest. Tiers of points have no intervals and are passed over.

mod read;
mod tokens;
mod write;

pub(super) use read::parse;
pub(super) use tokens::{is_header, is_short};
pub(super) use write::write;

//! Praat's TextGrid, long, short and chronological.
//!
//! Both forms are the same sequence of values; the long one has words between them that say what each is. Praat reads
//! every value that stands alone and skips the words, and so do we, but where a word contradicts the value that is due
//! we say so instead of misreading the rest. The chronological form has the labels of all tiers in the order of time,
//! each with the number of its tier. Points are intervals that end where they start; a tier of nothing but points is
//! written as one, and one without any is left out.

mod chronological;
mod read;
mod tokens;
mod write;

pub(super) use tokens::{is_header, is_short};
pub(super) use write::write;

use super::Timing;
use crate::disk::Result;
use read::Reader;
use tokens::is_chronological;

/// Reads each form from cleaned text.
///
/// # Errors
/// With the line and what was found there.
pub(super) fn parse(text: &str) -> Result<Timing> {
    let chronological = is_chronological(text);
    let mut reader = Reader::new(text, chronological)?;
    if chronological { chronological::parse(&mut reader) } else { read::parse(&mut reader) }
}

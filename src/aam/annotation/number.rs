//! Numbers in annotations.

use super::MAX_POINTS;
use crate::disk::{Fault, FileFault, Result};
use crate::face::MAX_COORDINATE;

/// A finite coordinate that can lie in a picture's neighbourhood.
pub(super) fn coordinate(word: &str, line: usize) -> Result<f64> {
    match word.parse::<f64>() {
        Ok(v) if v.abs() <= MAX_COORDINATE => Ok(v),
        Ok(_) => Err(Fault::new(format!("`{}` is no place in a picture", short(word)))
            .line(line)
            .help(format!("coordinates lie between -{MAX_COORDINATE} and {MAX_COORDINATE}"))),
        Err(_) => {
            Err(Fault::new(format!("`{}` is not a number", short(word))).line(line).help("write numbers as 123.45"))
        }
    }
}

/// How many points there are said to be.
pub(super) fn count(word: &str, line: usize) -> Result<usize> {
    match word.parse::<usize>() {
        Ok(n) if (1..=MAX_POINTS).contains(&n) => Ok(n),
        _ => Err(Fault::new(format!("`{}` is no number of points", short(word)))
            .line(line)
            .help(format!("an annotation has 1 to {MAX_POINTS} points"))),
    }
}

/// The start of a word, for a message.
pub(super) fn short(word: &str) -> String {
    let start: String = word.chars().take(24).collect();
    if start.len() < word.len() { format!("{start}…") } else { start }
}

/// More or fewer points than were promised.
pub(super) fn miscounted(said: usize, found: usize, line: usize) -> Fault {
    Fault::of(FileFault::Mismatch, format!("{said} points are announced, and there are {found}"))
        .line(line)
        .help("is the file cut off? correct the number, or copy the file again")
}

//! The names of a project's files, and what they looked like when they were last read.

use std::path::Path;

use crate::disk::Sum;

/// The files of a clip that saving writes.
pub(in crate::project) const SCRIPT: &str = "script.txt";
pub(in crate::project) const TIMES: &str = "timing.TextGrid";
pub(in crate::project) const SCORE: &str = "score.toml";
pub(in crate::project) const RATIOS: &str = "ratios.csv";
pub(in crate::project) const TRACKS: &str = "tracks.csv";

/// The file of a face's points.
pub(in crate::project) const FACE_FILE: &str = "face.toml";

/// Whether a file that was there when it was last read or written is there no more: a save writes it again.
pub(in crate::project) fn is_gone(path: &Path, seen: Option<Sum>) -> bool {
    seen.is_some() && !path.exists()
}

/// The sum of a file that was just read; none where it cannot be read any more.
pub(in crate::project) fn sum_of(path: &Path) -> Option<Sum> {
    Sum::at(path).ok().flatten()
}

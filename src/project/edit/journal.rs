//! The journal: every change since the last save, a line of JSON each, so that a lost connection loses nothing.

use std::fs::File;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

use super::change::Change;
use crate::disk::{self, Commit, Fault, Result, read_bytes};

/// The largest journal that is read: hundreds of changes to all the times of an hour.
pub(in crate::project) const JOURNAL_BYTES: u64 = 2 << 30;

/// The journal's name in the program's own folder.
pub(in crate::project) const JOURNAL: &str = "journal";

/// What a journal holds.
#[derive(Debug, Default)]
pub(in crate::project) struct Left {
    /// The changes, oldest first.
    pub(in crate::project) changes: Vec<Change>,
    /// The whole lines that are none: damaged, or of another version of the program.
    pub(in crate::project) unreadable: usize,
}

/// A journal that is appended to.
#[derive(Debug)]
pub(in crate::project) struct Journal {
    /// Opened with the first note, and again after a save has put an empty one in its place.
    file: Option<File>,
    path: PathBuf,
    /// Whether half a line may be at its end.
    torn: bool,
}

impl Journal {
    /// The changes that an earlier session left unsaved. A last line that was cut off is dropped.
    pub(in crate::project) fn left_in(path: &Path) -> Result<Left> {
        if !path.is_file() {
            return Ok(Left::default());
        }
        let bytes = read_bytes(path, JOURNAL_BYTES)?;
        let mut left = Left::default();
        for line in bytes.split_inclusive(|b| *b == b'\n') {
            match serde_json::from_slice(line) {
                Ok(change) => left.changes.push(change),
                Err(_) if line.ends_with(b"\n") && !line.trim_ascii().is_empty() => left.unreadable += 1,
                Err(_) => {}
            }
        }
        Ok(left)
    }

    /// The journal at `path`, which is added to `commit` with the changes that hold, so that what is noted next follows
    /// them and nothing else.
    pub(in crate::project) fn start(path: PathBuf, holding: &[Change], commit: &mut Commit) -> Result<Self> {
        let text: String = holding.iter().map(line_of).collect();
        commit.put_over(&path, text)?;
        Ok(Self { file: None, path, torn: false })
    }

    /// Its file.
    pub(in crate::project) fn path(&self) -> &Path {
        &self.path
    }

    /// Whether its file is open: one that is not is opened by its path, where another project may lie by then.
    pub(in crate::project) fn is_open(&self) -> bool {
        self.file.as_ref().is_some_and(|file| !is_removed(file))
    }

    /// Goes on in a new file where its own was removed, with the changes that are not saved.
    pub(in crate::project) fn revive(&mut self, unsaved: &[Change]) -> Result<()> {
        if self.file.take_if(|file| is_removed(file)).is_some() {
            unsaved.iter().try_for_each(|change| self.note(change))?;
        }
        Ok(())
    }

    /// Notes a change that was made.
    pub(in crate::project) fn note(&mut self, change: &Change) -> Result<()> {
        let cannot = |e| Fault::io("cannot write the journal", &self.path, e);
        if self.file.is_none() {
            self.file = Some(disk::append_or_make(&self.path).map_err(cannot)?);
        }
        let Some(file) = &mut self.file else { return Ok(()) };
        let length = file.metadata().map_err(cannot)?.len();
        let line = if self.torn { "\n".to_owned() + &line_of(change) } else { line_of(change) };
        let noted = file.write_all(line.as_bytes()).and_then(|()| file.sync_data());
        // Half a line would spoil the one that follows it.
        self.torn = noted.is_err() && file.set_len(length).is_err() || noted.is_err() && self.torn;
        noted.map_err(cannot)
    }

    /// Adds to a commit that the changes are in the files now.
    pub(in crate::project) fn empty_in(&self, commit: &mut Commit) -> Result<()> {
        commit.put_over(&self.path, "")
    }

    /// Goes on with the file that a commit has put in its place.
    pub(in crate::project) fn replaced(&mut self) {
        self.file = None;
    }

    /// Forgets everything. A journal that is open is emptied wherever its project has been moved to.
    pub(in crate::project) fn clear(&mut self) -> Result<()> {
        let file = match self.file.take() {
            Some(file) => Ok(file),
            None => disk::append(&self.path),
        };
        match file.and_then(|file| file.set_len(0).and_then(|()| file.sync_all())) {
            Err(e) if e.kind() != ErrorKind::NotFound => Err(Fault::io("cannot empty the journal", &self.path, e)),
            _ => Ok(()),
        }
    }
}

/// Whether nobody can find a file any more: what is written into it is lost with the program.
#[cfg(unix)]
fn is_removed(file: &File) -> bool {
    use std::os::unix::fs::MetadataExt;
    file.metadata().is_ok_and(|about| about.nlink() == 0)
}

#[cfg(not(unix))]
fn is_removed(_file: &File) -> bool {
    false
}

fn line_of(change: &Change) -> String {
    // Only maps with odd keys and numbers that are none can fail to be JSON, and a change has neither.
    serde_json::to_string(change).unwrap_or_default() + "\n"
}

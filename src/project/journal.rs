//! The journal: every change since the last save, a line of JSON each, so that a lost connection loses nothing.

use std::fs::File;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

use super::Change;
use crate::disk::{self, Commit, Fault, Result, read_bytes};

/// The largest journal that is read: hundreds of changes to all the times of an hour.
pub(super) const JOURNAL_BYTES: u64 = 2 << 30;

/// The journal's name in the program's own folder.
pub(super) const JOURNAL: &str = "journal";

/// A journal that is appended to.
#[derive(Debug)]
pub(super) struct Journal {
    /// Opened with the first note, and again after a save has put an empty one in its place.
    file: Option<File>,
    path: PathBuf,
}

impl Journal {
    /// The changes that an earlier session left unsaved. A last line that was cut off is dropped.
    pub(super) fn left_in(path: &Path) -> Result<Vec<Change>> {
        if !path.is_file() {
            return Ok(Vec::new());
        }
        let bytes = read_bytes(path, JOURNAL_BYTES)?;
        Ok(bytes.split(|b| *b == b'\n').map_while(|line| serde_json::from_slice(line).ok()).collect())
    }

    /// The journal at `path`, which is added to `commit` with the changes that hold, so that what is noted next follows
    /// them and nothing else.
    pub(super) fn start(path: PathBuf, holding: &[Change], commit: &mut Commit) -> Result<Self> {
        let text: String = holding.iter().map(line_of).collect();
        commit.put_over(&path, text)?;
        Ok(Self { file: None, path })
    }

    /// Its file.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Whether its file is open: one that is not is opened by its path, where another project may lie by then.
    pub(super) fn is_open(&self) -> bool {
        self.file.is_some()
    }

    /// Notes a change that was made.
    pub(super) fn note(&mut self, change: &Change) -> Result<()> {
        let cannot = |e| Fault::io("cannot write the journal", &self.path, e);
        if self.file.is_none() {
            self.file = Some(disk::append_or_make(&self.path).map_err(cannot)?);
        }
        let Some(file) = &mut self.file else { return Ok(()) };
        let length = file.metadata().map_err(cannot)?.len();
        let noted = file.write_all(line_of(change).as_bytes()).and_then(|()| file.sync_data());
        if noted.is_err() {
            // Half a line would hide those that follow it.
            let _ = file.set_len(length);
        }
        noted.map_err(cannot)
    }

    /// Adds to a commit that the changes are in the files now.
    pub(super) fn empty_in(&self, commit: &mut Commit) -> Result<()> {
        commit.put_over(&self.path, "")
    }

    /// Goes on with the file that a commit has put in its place.
    pub(super) fn replaced(&mut self) {
        self.file = None;
    }

    /// Forgets everything. A journal that is open is emptied wherever its project has been moved to.
    pub(super) fn clear(&mut self) -> Result<()> {
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

fn line_of(change: &Change) -> String {
    // Only maps with odd keys and numbers that are none can fail to be JSON, and a change has neither.
    serde_json::to_string(change).unwrap_or_default() + "\n"
}

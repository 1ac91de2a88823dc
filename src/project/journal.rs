//! The journal: every change since the last save, a line of JSON each, so that a lost connection loses nothing.

use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::Path;

use super::Change;
use crate::disk::{Fault, MAX_TEXT_BYTES, Result, read_bytes};

#[derive(Debug)]
pub(super) struct Journal {
    file: File,
    path: std::path::PathBuf,
}

impl Journal {
    /// Opens the journal and reads what an earlier run left in it. A last line that was cut off is dropped.
    pub(super) fn open(path: &Path) -> Result<(Self, Vec<Change>)> {
        let unsaved = match path.is_file() {
            true => read_bytes(path, MAX_TEXT_BYTES)?
                .split(|b| *b == b'\n')
                .map_while(|line| serde_json::from_slice(line).ok())
                .collect(),
            false => Vec::new(),
        };
        let file = OpenOptions::new()
            .create(true)
            .append(true)
            .open(path)
            .map_err(|e| Fault::io("cannot open the journal", path, e))?;
        Ok((Self { file, path: path.to_owned() }, unsaved))
    }

    /// Notes a change that was made.
    pub(super) fn note(&mut self, change: &Change) -> Result<()> {
        let mut line = serde_json::to_vec(change).unwrap_or_default();
        line.push(b'\n');
        self.file
            .write_all(&line)
            .and_then(|()| self.file.sync_data())
            .map_err(|e| Fault::io("cannot write the journal", &self.path, e))
    }

    /// Forgets everything: it is in the files now.
    pub(super) fn clear(&mut self) -> Result<()> {
        self.file.set_len(0).map_err(|e| Fault::io("cannot empty the journal", &self.path, e))
    }
}

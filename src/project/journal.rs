//! The journal: every change since the last save, a line of JSON each, so that a lost connection loses nothing.

use std::fs::File;
use std::io::Write;
use std::path::Path;

use super::Change;
use crate::disk::{Fault, Result, append, read_bytes, write_whole};

/// The largest journal that is read: hundreds of changes to all the times of an hour.
const LARGEST: u64 = 2 << 30;

#[derive(Debug)]
pub(super) struct Journal {
    file: File,
    path: std::path::PathBuf,
}

impl Journal {
    /// What an earlier run left unsaved. A last line that was cut off is dropped.
    pub(super) fn left_in(path: &Path) -> Result<Vec<Change>> {
        if !path.is_file() {
            return Ok(Vec::new());
        }
        let bytes = read_bytes(path, LARGEST)?;
        Ok(bytes.split(|b| *b == b'\n').map_while(|line| serde_json::from_slice(line).ok()).collect())
    }

    /// Starts the journal with the changes that hold, so that what is noted next follows them and nothing else.
    pub(super) fn start(path: &Path, holding: &[Change]) -> Result<Self> {
        let text: String = holding.iter().map(line_of).collect();
        write_whole(path, text.as_bytes())?;
        let file = append(path).map_err(|e| Fault::io("cannot open the journal", path, e))?;
        Ok(Self { file, path: path.to_owned() })
    }

    /// Notes a change that was made.
    pub(super) fn note(&mut self, change: &Change) -> Result<()> {
        self.file
            .write_all(line_of(change).as_bytes())
            .and_then(|()| self.file.sync_data())
            .map_err(|e| Fault::io("cannot write the journal", &self.path, e))
    }

    /// Forgets everything: it is in the files now.
    pub(super) fn clear(&mut self) -> Result<()> {
        self.file.set_len(0).map_err(|e| Fault::io("cannot empty the journal", &self.path, e))
    }
}

fn line_of(change: &Change) -> String {
    // Only maps with odd keys and numbers that are none can fail to be JSON, and a change has neither.
    serde_json::to_string(change).unwrap_or_default() + "\n"
}

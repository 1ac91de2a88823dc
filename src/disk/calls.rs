//! The calls by which a commit changes the disk, as a trait, so that a test can fail, stop or reorder any one of them.

use std::fs::File;
use std::io::{Result, Write};
use std::path::{Path, PathBuf};

use super::rights::Rights;
use super::{door, temporary_in};

/// An open file and its path.
#[derive(Debug)]
pub struct Handle {
    /// The file.
    pub file: File,
    /// Its path when it was opened.
    pub path: PathBuf,
}

/// Every call of a commit that changes something on the disk. The provided methods are the system's.
pub trait Calls {
    /// Makes a folder and those above it, where they are missing.
    ///
    /// # Errors
    /// As the system's; so do all calls here.
    fn create_folder(&mut self, folder: &Path) -> Result<()> {
        door::make_folder(folder)
    }

    /// Makes a new temporary file in a folder, whose name ends in `ending`.
    ///
    /// # Errors
    /// As the system's.
    fn create(&mut self, folder: &Path, ending: &str) -> Result<Handle> {
        let (file, path) = temporary_in(folder, ending)?.keep().map_err(|e| e.error)?;
        Ok(Handle { file, path })
    }

    /// Opens a file to append to it, and makes it where it is missing.
    ///
    /// # Errors
    /// As the system's.
    fn open(&mut self, path: &Path) -> Result<Handle> {
        let file = door::append_or_make(path)?;
        Ok(Handle { file, path: path.to_owned() })
    }

    /// Gives a file mode and group.
    ///
    /// # Errors
    /// As the system's.
    fn set_rights(&mut self, handle: &Handle, rights: Rights) -> Result<()> {
        rights.give(&handle.file)
    }

    /// Appends bytes.
    ///
    /// # Errors
    /// As the system's.
    fn write(&mut self, handle: &mut Handle, bytes: &[u8]) -> Result<()> {
        handle.file.write_all(bytes)
    }

    /// Empties a file.
    ///
    /// # Errors
    /// As the system's.
    fn truncate(&mut self, handle: &mut Handle) -> Result<()> {
        handle.file.set_len(0)
    }

    /// Waits until a file's bytes are on the disk.
    ///
    /// # Errors
    /// As the system's.
    fn sync(&mut self, handle: &Handle) -> Result<()> {
        handle.file.sync_all()
    }

    /// Gives a file another name, in place of what has it.
    ///
    /// # Errors
    /// As the system's.
    fn rename(&mut self, from: &Path, to: &Path) -> Result<()> {
        door::rename(from, to)
    }

    /// Removes a file.
    ///
    /// # Errors
    /// As the system's.
    fn remove(&mut self, path: &Path) -> Result<()> {
        door::remove(path)
    }

    /// Waits until the names in a folder are on the disk.
    ///
    /// # Errors
    /// As the system's.
    fn sync_folder(&mut self, folder: &Path) -> Result<()> {
        super::write::sync_folder(folder)
    }
}

/// The system's own calls.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct SystemCalls;

impl Calls for SystemCalls {}

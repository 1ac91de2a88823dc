//! A large file on its way: it is written beside its place and put there when it is whole.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use crate::disk::{Fault, Result, temporary_in};

/// Whatever becomes of it, nobody sees half of it: dropped, it is gone.
pub(super) struct Draft {
    file: BufWriter<NamedTempFile>,
    place: PathBuf,
}

impl Draft {
    /// Makes the folder where it is missing.
    pub(super) fn new(place: &Path) -> Result<Self> {
        let file = beside(place, "")?;
        Ok(Self { file: BufWriter::with_capacity(1 << 18, file), place: place.to_owned() })
    }

    /// Puts it in its place and says how many bytes it has. `mend` may write something again first.
    pub(super) fn finish(self, mend: impl FnOnce(&mut File) -> std::io::Result<()>) -> Result<u64> {
        let Self { file, place } = self;
        let saved = (|| {
            let mut file = file.into_inner().map_err(std::io::IntoInnerError::into_error)?;
            mend(file.as_file_mut())?;
            let bytes = file.as_file().metadata()?.len();
            file.persist(&place).map_err(|e| e.error)?;
            Ok(bytes)
        })();
        saved.map_err(|e| write_fault(&place, e))
    }
}

impl Write for Draft {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.file.flush()
    }
}

/// A temporary file in the folder of `place`, with the rights of an ordinary file.
pub(super) fn beside(place: &Path, ending: &str) -> Result<NamedTempFile> {
    let folder = match place.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    std::fs::create_dir_all(folder).map_err(|e| Fault::io("cannot make the folder", folder, e))?;
    temporary_in(folder, ending).map_err(|e| write_fault(place, e))
}

pub(super) fn write_fault(place: &Path, error: std::io::Error) -> Fault {
    Fault::io("cannot write it", place, error).help("is there room, and may you write there?")
}

//! Saving: a file is there whole or not at all.

use std::fs;
use std::io::Write;
use std::path::Path;

use tempfile::NamedTempFile;

use super::{Fault, Result, temporary_in};

/// Puts `bytes` at `path`, making its folder where it is missing: a temporary file beside it, flush, fsync, rename,
/// fsync of the folder. A reader sees the old file or the new one, and a crash leaves one of the two.
///
/// # Errors
/// When any of these steps fails; the old file is then untouched.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<()> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    fs::create_dir_all(folder).map_err(|e| Fault::io("cannot make the folder", folder, e))?;
    let saved = (|| {
        let mut file = temporary_in(folder, "")?;
        file.write_all(bytes)?;
        put_whole(file, path)
    })();
    saved.map_err(|e| Fault::io("cannot save it", path, e).help("is there room, and may you write there?"))
}

/// Puts a temporary file of the same folder at `path` when it is on the disk: fsync, rename, fsync of the folder. A reader
/// sees the old file or the new one, and a crash leaves one of the two.
///
/// # Errors
/// When any of these steps fails; before the rename the old file is untouched.
pub fn put_whole(mut file: NamedTempFile, path: &Path) -> std::io::Result<()> {
    file.flush()?;
    file.as_file().sync_all()?;
    file.persist(path).map_err(|e| e.error)?;
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => sync_folder(folder),
        _ => sync_folder(Path::new(".")),
    }
}

/// Puts `bytes` at `path` for what can be made again, such as frames: whole or not at all for every reader, without
/// waiting for the disk. After a power cut a file may be damaged, so whoever relies on it looks inside. The folder
/// must be there.
///
/// # Errors
/// When the file cannot be written; the old one is then untouched.
pub fn replace(path: &Path, bytes: &[u8]) -> Result<()> {
    let folder = path.parent().unwrap_or(Path::new("."));
    let saved = (|| {
        let mut file = temporary_in(folder, "")?;
        file.write_all(bytes)?;
        file.persist(path).map(drop).map_err(|e| e.error)
    })();
    saved.map_err(|e| Fault::io("cannot write it", path, e))
}

#[cfg(unix)]
pub(super) fn sync_folder(folder: &Path) -> std::io::Result<()> {
    fs::File::open(folder)?.sync_all()
}

#[cfg(not(unix))]
pub(super) fn sync_folder(_folder: &Path) -> std::io::Result<()> {
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_saved_file_replaces_the_old_one_and_leaves_nothing_beside_it() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("deep/er/score.toml");
        write_whole(&path, b"one").unwrap();
        write_whole(&path, b"two").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"two");
        assert_eq!(fs::read_dir(path.parent().unwrap()).unwrap().count(), 1);
    }
}

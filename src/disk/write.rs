//! Saving: a file is there whole or not at all.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use super::{Fault, FileFault, Result, Rights, door, settle, temporary_in};

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
    door::make_folder(folder).map_err(|e| Fault::writing("cannot make the folder", folder, e))?;
    let saved = (|| {
        let mut file = temporary_in(folder, "")?;
        file.write_all(bytes)?;
        put_whole(file, path)
    })();
    saved.map_err(|e| Fault::writing("cannot save it", path, e))
}

/// Puts a temporary file of the same folder at `path` when it is on the disk: fsync, rename, fsync of the folder. A reader
/// sees the old file or the new one, and a crash leaves one of the two. The file that it replaces gives it mode and group.
///
/// # Errors
/// When any of these steps fails; before the rename the old file is untouched.
pub fn put_whole(mut file: NamedTempFile, path: &Path) -> std::io::Result<()> {
    file.flush()?;
    Rights::of(path, path).give(file.as_file())?;
    file.as_file().sync_all()?;
    settle(file.into_temp_path(), path)?;
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
        settle(file.into_temp_path(), path)
    })();
    saved.map_err(|e| Fault::writing("cannot write it", path, e))
}

/// Writes what a command was asked to put at a path of its user's: a link is followed, and the file that it names is
/// replaced whole; into standard output, a pipe, a terminal or a device the bytes are written.
///
/// # Errors
/// As [`write_whole`].
pub fn write_output(path: &Path, bytes: &[u8]) -> Result<()> {
    let into = |mut stream: Box<dyn Write>| {
        let written = stream.write_all(bytes).and_then(|()| stream.flush());
        written.map_err(|e| Fault::io("cannot write it", path, e))
    };
    // By its name: opened once more, a file behind it would have a second end.
    if ["/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"].iter().any(|name| path == Path::new(name)) {
        return into(Box::new(std::io::stdout()));
    }
    if door::is_confined(path) {
        return write_whole(path, bytes);
    }
    match fs::metadata(path) {
        Ok(there) if !there.is_file() && !there.is_dir() => {
            let stream = fs::OpenOptions::new().write(true).open(path);
            into(Box::new(stream.map_err(|e| Fault::io("cannot open it", path, e))?))
        }
        Ok(there) if there.is_dir() => {
            Err(Fault::of(FileFault::Mismatch, "it is a folder").at(path).help("name a file in it"))
        }
        _ => write_whole(&followed(path), bytes),
    }
}

/// What a link names in the end; another path as it is.
fn followed(path: &Path) -> PathBuf {
    let mut at = path.to_owned();
    // As many as Linux follows.
    for _ in 0..40 {
        let Ok(target) = fs::read_link(&at) else { break };
        at = at.parent().unwrap_or(Path::new("")).join(target);
    }
    at
}

#[cfg(unix)]
pub(super) fn sync_folder(folder: &Path) -> std::io::Result<()> {
    door::open_folder(folder)?.sync_all()
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

    #[cfg(unix)]
    #[test]
    fn a_private_file_stays_private_when_it_is_written_again() {
        use std::os::unix::fs::PermissionsExt;
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("marks.txt");
        fs::write(&path, b"one").unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o600)).unwrap();
        write_output(&path, b"two").unwrap();
        assert_eq!(fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o600);
    }
}

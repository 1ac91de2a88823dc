//! The lock that keeps two programs from changing one project, and the folder it is in, held by what it is and not by
//! its path.

use std::fs::{self, File, TryLockError};
use std::io::{ErrorKind, Read, Write};
use std::path::{Path, PathBuf};

use super::{Fault, Result, clean_line, door};

/// Held while a project is open for writing; let go when dropped or when the program ends, however it ends. Its file names
/// who holds it.
#[derive(Debug)]
pub struct Lock {
    file: File,
}

impl Lock {
    /// Takes the lock at `path`, or `None` where another program holds it.
    ///
    /// # Errors
    /// When the lock's file cannot be made.
    pub fn take(path: &Path) -> Result<Option<Self>> {
        if let Some(folder) = path.parent() {
            door::make_folder(folder).map_err(|e| Fault::io("cannot make the folder", folder, e))?;
        }
        let file = door::open_or_make(path).map_err(|e| Fault::io("cannot make the lock", path, e))?;
        match file.try_lock() {
            Ok(()) => {
                // On a full disk the lock holds, and nobody is named.
                let _ = file.set_len(0).and_then(|()| (&file).write_all(holder().as_bytes()));
                Ok(Some(Self { file }))
            }
            Err(TryLockError::WouldBlock) => Ok(None),
            Err(TryLockError::Error(e)) => Err(Fault::io("cannot take the lock", path, e)),
        }
    }

    /// Whether another program holds the lock at `path`. Nothing is made there.
    #[must_use]
    pub fn is_held(path: &Path) -> bool {
        door::open(path).is_ok_and(|f| matches!(f.try_lock_shared(), Err(TryLockError::WouldBlock)))
    }

    /// Who holds the lock at `path`, as `process 123 on HOST`; none where its file does not say.
    #[must_use]
    pub(crate) fn holder(path: &Path) -> Option<String> {
        const LONGEST: usize = 120;
        let mut text = String::new();
        door::open(path).ok()?.take(LONGEST as u64).read_to_string(&mut text).ok()?;
        Some(clean_line(&text, LONGEST)).filter(|t| !t.is_empty())
    }

    /// Whether the lock's file is still the one at `path`.
    #[must_use]
    pub(crate) fn is_at(&self, path: &Path) -> bool {
        is_file_at(&self.file, path)
    }
}

impl Drop for Lock {
    /// Let go at once: a child that was just started has the file too, until it runs its own program.
    fn drop(&mut self) {
        let _ = self.file.unlock();
    }
}

/// The text of the lock's file while this process holds it.
fn holder() -> String {
    let host = fs::read_to_string("/proc/sys/kernel/hostname").unwrap_or_default();
    let host = host.trim();
    let at = if host.is_empty() { String::new() } else { format!(" on {host}") };
    format!("process {}{at}\n", std::process::id())
}

/// A folder that is held open, so that another one at its path is noticed.
#[derive(Debug)]
pub(crate) struct HeldFolder {
    folder: Option<File>,
}

impl HeldFolder {
    /// Holds the folder at `path`. Where the system opens no folders, nothing is noticed.
    #[must_use]
    pub(crate) fn new(path: &Path) -> Self {
        Self { folder: door::open_folder(path).ok() }
    }

    /// Whether it is still the folder at `path`.
    #[must_use]
    pub(crate) fn is_at(&self, path: &Path) -> bool {
        self.folder.as_ref().is_none_or(|folder| is_file_at(folder, path))
    }

    /// Where it is now, however often it was renamed; none where it was removed or the system does not tell (only Linux
    /// does).
    #[must_use]
    pub(crate) fn place(&self) -> Option<PathBuf> {
        let place = place_of(self.folder.as_ref()?)?;
        self.is_at(&place).then_some(place)
    }
}

#[cfg(target_os = "linux")]
fn place_of(file: &File) -> Option<PathBuf> {
    use std::os::fd::AsRawFd;
    fs::read_link(format!("/proc/self/fd/{}", file.as_raw_fd())).ok()
}

#[cfg(not(target_os = "linux"))]
fn place_of(_file: &File) -> Option<PathBuf> {
    None
}

/// Whether the file at `path` is this one.
#[cfg(unix)]
fn is_file_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let same = |a: fs::Metadata, b: fs::Metadata| a.dev() == b.dev() && a.ino() == b.ino();
    match (file.metadata(), fs::metadata(path)) {
        (Ok(held), Ok(there)) => same(held, there),
        (_, Err(error)) => error.kind() != ErrorKind::NotFound,
        (Err(_), _) => true,
    }
}

#[cfg(not(unix))]
fn is_file_at(_file: &File, path: &Path) -> bool {
    !fs::metadata(path).is_err_and(|e| e.kind() == ErrorKind::NotFound)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_second_lock_is_refused_until_the_first_is_let_go() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("lock");
        assert!(!Lock::is_held(&path));
        let first = Lock::take(&path).unwrap().unwrap();
        assert!(Lock::take(&path).unwrap().is_none());
        assert!(Lock::is_held(&path));
        assert!(Lock::holder(&path).unwrap().starts_with(&format!("process {}", std::process::id())));
        drop(first);
        assert!(!Lock::is_held(&path));
        assert!(Lock::take(&path).unwrap().is_some());
    }

    #[cfg(unix)]
    #[test]
    fn a_folder_that_is_moved_is_noticed_and_so_is_another_in_its_place() {
        let dir = tempfile::tempdir().unwrap();
        let (old, new) = (dir.path().join("old"), dir.path().join("new"));
        fs::create_dir(&old).unwrap();
        let held = HeldFolder::new(&old);
        assert!(held.is_at(&old));
        fs::rename(&old, &new).unwrap();
        assert!(!held.is_at(&old) && held.is_at(&new));
        fs::create_dir(&old).unwrap();
        assert!(!held.is_at(&old));
    }
}

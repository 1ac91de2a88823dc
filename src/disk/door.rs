//! The one way to files and folders, with the names of `std::fs`: below a confined folder without leaving it, regular
//! files only, and never waiting for one.
//!
//! A project comes from anywhere, so that a link in it may lead anywhere. From [`confine`] on, every path that begins
//! with its folder is resolved below an open handle of that folder: with `openat2` and `RESOLVE_BENEATH` where the
//! system has it, else part by part. A link that leads out is refused, also one that is put there while the program
//! runs; links that stay within are followed. All other paths are a user's own words and may lead through links
//! anywhere. Named pipes, sockets and devices are opened without waiting, recognised and refused.

use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::fs::{self, File};
use std::io::{self, ErrorKind};
use std::path::{Component, Path, PathBuf};
use std::sync::{PoisonError, RwLock};

use cap_std::ambient_authority;
use cap_std::fs::Dir;

/// The folders that nothing leads out of, absolute.
static CONFINED: RwLock<BTreeSet<PathBuf>> = RwLock::new(BTreeSet::new());

/// Confines every path that begins with `folder` to it, in this process and from now on.
pub fn confine(folder: &Path) {
    // Where there is no current folder, no relative path can be opened either.
    let Ok(folder) = std::path::absolute(folder) else { return };
    if !CONFINED.read().unwrap_or_else(PoisonError::into_inner).contains(&folder) {
        CONFINED.write().unwrap_or_else(PoisonError::into_inner).insert(folder);
    }
}

/// Opens a file to read it.
///
/// # Errors
/// When there is none, it is no regular file, or a link leads out of its confined folder.
pub fn open(path: &Path) -> io::Result<File> {
    enter(path, Mode::Read)
}

/// Opens a file that is there to write behind its end.
///
/// # Errors
/// As [`open`].
pub fn append(path: &Path) -> io::Result<File> {
    enter(path, Mode::Append)
}

/// Opens a file to write behind its end, and makes an empty one where there is none.
///
/// # Errors
/// As [`open`], and when it cannot be made.
pub fn append_or_make(path: &Path) -> io::Result<File> {
    enter(path, Mode::Extend)
}

/// Opens a file to be locked, and makes an empty one where there is none.
pub(super) fn open_or_make(path: &Path) -> io::Result<File> {
    enter(path, Mode::Keep)
}

/// Makes a new file, to write and read.
pub(super) fn make(path: &Path) -> io::Result<File> {
    let (folder, name) = parent_of(path)?;
    let mut options = cap_std::fs::OpenOptions::new();
    folder.open_with(name, options.read(true).write(true).create_new(true)).map(cap_std::fs::File::into_std)
}

/// Opens a folder, to lock it or to flush it to the disk.
///
/// # Errors
/// When there is none, or a link leads out of its confined folder.
pub fn open_folder(folder: &Path) -> io::Result<File> {
    match Below::of(folder)? {
        None => File::open(folder),
        Some(below) => below.resolve(|dir, path| {
            let mut options = cap_std::fs::OpenOptions::new();
            dir.open_with(path, options.read(true)).map(cap_std::fs::File::into_std)
        }),
    }
}

/// The paths of what is in a folder, in order.
///
/// # Errors
/// As [`open_folder`], and when it cannot be read.
pub fn list(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut paths: Vec<PathBuf> = match Below::of(folder)? {
        None => fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<io::Result<_>>()?,
        Some(below) => below.resolve(|dir, path| {
            dir.read_dir(path)?.map(|entry| Ok(folder.join(entry?.file_name()))).collect::<io::Result<_>>()
        })?,
    };
    paths.sort();
    Ok(paths)
}

/// Makes a folder and those around it, as far as they are missing.
///
/// # Errors
/// When one cannot be made, or a link leads out of the confined folder.
pub fn make_folder(folder: &Path) -> io::Result<()> {
    match Below::of(folder)? {
        None => fs::create_dir_all(folder),
        Some(below) => below.resolve(|dir, path| match dir.open_dir(path) {
            Err(error) if error.kind() == ErrorKind::NotFound => dir.create_dir_all(path),
            other => other.map(drop),
        }),
    }
}

/// Removes a file; of a link the link.
///
/// # Errors
/// When there is none, or it may not be removed.
pub fn remove(path: &Path) -> io::Result<()> {
    let (folder, name) = parent_of(path)?;
    folder.remove_file(name)
}

/// Gives a file another name, in place of a file that has it. Links are not followed.
///
/// # Errors
/// When there is no such file, or the new name cannot be given.
pub fn rename(from: &Path, to: &Path) -> io::Result<()> {
    let ((folder, name), (there, new)) = (parent_of(from)?, parent_of(to)?);
    folder.rename(name, &there, new)
}

/// Gives a file one more name.
///
/// # Errors
/// When the name is taken, or the disk has no such links.
pub fn link(from: &Path, to: &Path) -> io::Result<()> {
    let ((folder, name), (there, new)) = (parent_of(from)?, parent_of(to)?);
    folder.hard_link(name, &there, new)
}

/// Copies a file to where there is none; its length in bytes.
///
/// # Errors
/// When the one cannot be read or the other not made.
pub fn copy(from: &Path, to: &Path) -> io::Result<u64> {
    io::copy(&mut open(from)?, &mut make(to)?)
}

/// Whether links at this path are confined.
pub(super) fn is_confined(path: &Path) -> bool {
    matches!(Below::of(path), Ok(Some(_)))
}

/// A path below a confined folder.
struct Below {
    root: PathBuf,
    folder: Dir,
    relative: PathBuf,
}

impl Below {
    /// None where the path is in no confined folder.
    fn of(path: &Path) -> io::Result<Option<Self>> {
        let Ok(whole) = std::path::absolute(path) else { return Ok(None) };
        let roots = CONFINED.read().unwrap_or_else(PoisonError::into_inner);
        // The outermost: an inner one may lie behind a link.
        let Some(root) = whole.ancestors().filter(|a| roots.contains(*a)).last() else { return Ok(None) };
        let relative = whole.strip_prefix(root).unwrap_or(&whole);
        // No name in a file has a `..`: it is a user's word.
        if relative.components().any(|c| c == Component::ParentDir) {
            return Ok(None);
        }
        let relative = if relative.as_os_str().is_empty() { Path::new(".") } else { relative };
        let folder = Dir::open_ambient_dir(root, ambient_authority())?;
        Ok(Some(Self { root: root.to_owned(), folder, relative: relative.to_owned() }))
    }

    /// Runs an operation on the path below its folder.
    fn resolve<T>(&self, operation: impl Fn(&Dir, &Path) -> io::Result<T>) -> io::Result<T> {
        match operation(&self.folder, &self.relative) {
            Err(error) if is_escape(&error) => {
                // An absolute link may lead back in. Opened below the folder again, so that nothing can be changed between.
                let within = self.without_links().ok_or_else(leads_out)?;
                operation(&self.folder, &within).map_err(|e| if is_escape(&e) { leads_out() } else { e })
            }
            done => done,
        }
    }

    /// The path without the links in it, where it stays below the folder.
    fn without_links(&self) -> Option<PathBuf> {
        let full = self.root.join(&self.relative);
        // What is not there yet cannot be a link.
        let there = full.ancestors().find(|a| a.symlink_metadata().is_ok())?;
        let real = there.canonicalize().ok()?;
        let inside = real.strip_prefix(self.root.canonicalize().ok()?).ok()?;
        // Part by part: joined with nothing, a path would end in `/`.
        Some(inside.iter().chain(full.strip_prefix(there).ok()?).collect())
    }
}

/// The folder of a path, open, and its name there.
fn parent_of(path: &Path) -> io::Result<(Dir, &OsStr)> {
    let name = path.file_name().ok_or_else(|| io::Error::new(ErrorKind::InvalidInput, "it has no name"))?;
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let folder = match Below::of(folder)? {
        None => Dir::open_ambient_dir(folder, ambient_authority())?,
        Some(below) => below.resolve(|dir, path| dir.open_dir(path))?,
    };
    Ok((folder, name))
}

/// What a file is opened for.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Mode {
    Read,
    Append,
    /// As `Append`, and made where it is missing.
    Extend,
    /// To hold it: made where it is missing, and its content left as it is.
    Keep,
}

fn enter(path: &Path, mode: Mode) -> io::Result<File> {
    let appends = matches!(mode, Mode::Append | Mode::Extend);
    let makes = matches!(mode, Mode::Keep | Mode::Extend);
    let writes = mode == Mode::Keep;
    let file = match Below::of(path)? {
        None => {
            let mut options = fs::OpenOptions::new();
            options.read(mode == Mode::Read).append(appends).write(writes).create(makes);
            #[cfg(unix)]
            std::os::unix::fs::OpenOptionsExt::custom_flags(&mut options, without_waiting());
            options.open(path)?
        }
        Some(below) => below.resolve(|dir, path| {
            let mut options = cap_std::fs::OpenOptions::new();
            options.read(mode == Mode::Read).append(appends).write(writes).create(makes);
            #[cfg(unix)]
            cap_std::fs::OpenOptionsExt::custom_flags(&mut options, without_waiting());
            dir.open_with(path, &options).map(cap_std::fs::File::into_std)
        })?,
    };
    regular(file)
}

/// A pipe without a writer is opened at once, and no terminal becomes the program's own.
#[cfg(unix)]
fn without_waiting() -> i32 {
    (rustix::fs::OFlags::NONBLOCK | rustix::fs::OFlags::NOCTTY).bits().cast_signed()
}

/// The file, where it is one that holds what it has.
fn regular(file: File) -> io::Result<File> {
    let kind = file.metadata()?.file_type();
    if kind.is_file() {
        return Ok(file);
    }
    if kind.is_dir() {
        return Err(io::Error::new(ErrorKind::IsADirectory, "it is a folder"));
    }
    Err(io::Error::new(ErrorKind::InvalidInput, format!("it is {}, and only files are opened", name_of(kind))))
}

#[cfg(unix)]
pub(super) fn name_of(kind: fs::FileType) -> &'static str {
    use std::os::unix::fs::FileTypeExt;
    match kind {
        k if k.is_fifo() => "a named pipe",
        k if k.is_socket() => "a socket",
        _ => "a device",
    }
}

#[cfg(not(unix))]
pub(super) fn name_of(_: fs::FileType) -> &'static str {
    "a device"
}

/// The error of `cap-std` for a path that would leave its folder; the system's own have a number.
fn is_escape(error: &io::Error) -> bool {
    error.kind() == ErrorKind::PermissionDenied && error.raw_os_error().is_none()
}

fn leads_out() -> io::Error {
    io::Error::new(ErrorKind::PermissionDenied, "a link leads out of the project's folder")
}

#[cfg(test)]
#[cfg(unix)]
mod tests {
    use std::os::unix::fs::symlink;

    use super::*;

    /// A confined folder with a link `out` to another one, `away` to that by its full path, and `in` and `full` to its
    /// own `real`.
    fn folders() -> (tempfile::TempDir, PathBuf, PathBuf) {
        let dir = tempfile::tempdir().unwrap();
        let (root, outside) = (dir.path().join("project"), dir.path().join("outside"));
        for folder in [&root.join("real"), &outside] {
            fs::create_dir_all(folder).unwrap();
        }
        fs::write(outside.join("secret"), "theirs").unwrap();
        fs::write(root.join("real/file"), "ours").unwrap();
        symlink("../outside", root.join("out")).unwrap();
        symlink(&outside, root.join("away")).unwrap();
        symlink("real", root.join("in")).unwrap();
        symlink(root.join("real"), root.join("full")).unwrap();
        symlink("../outside/secret", root.join("file")).unwrap();
        symlink("../outside/new", root.join("dangling")).unwrap();
        confine(&root);
        (dir, root, outside)
    }

    #[test]
    fn no_call_follows_a_link_out_of_a_confined_folder() {
        let (_dir, root, outside) = folders();
        let refused = |result: io::Result<()>, what: &str| {
            let error = result.expect_err(what);
            assert!(error.to_string().contains("leads out"), "{what}: {error}");
        };
        for link in ["out", "away"] {
            let at = |name: &str| root.join(link).join(name);
            refused(open(&at("secret")).map(drop), link);
            refused(append(&at("secret")).map(drop), link);
            refused(open_or_make(&at("new")).map(drop), link);
            refused(make(&at("new")).map(drop), link);
            refused(open_folder(&root.join(link)).map(drop), link);
            refused(list(&root.join(link)).map(drop), link);
            refused(make_folder(&root.join(link)), link);
            refused(make_folder(&at("deep/er")), link);
            refused(remove(&at("secret")), link);
            refused(rename(&at("secret"), &root.join("mine")), link);
            refused(rename(&root.join("real/file"), &at("file")), link);
            refused(self::link(&at("secret"), &root.join("mine")), link);
            refused(copy(&at("secret"), &root.join("mine")).map(drop), link);
        }
        refused(open(&root.join("file")).map(drop), "a file");
        refused(open_or_make(&root.join("dangling")).map(drop), "a dangling link");
        assert_eq!(list(&outside).unwrap(), [outside.join("secret")]);
        assert_eq!(fs::read(outside.join("secret")).unwrap(), b"theirs");
    }

    #[test]
    fn links_that_stay_within_are_followed() {
        let (_dir, root, _) = folders();
        for link in ["in", "full"] {
            let at = |name: &str| root.join(link).join(name);
            assert_eq!(io::read_to_string(open(&at("file")).unwrap()).unwrap(), "ours");
            make_folder(&at("deep/er")).unwrap();
            copy(&at("file"), &at("deep/er/copy")).unwrap();
            rename(&at("deep/er/copy"), &at("moved")).unwrap();
            assert_eq!(list(&root.join(link)).unwrap().len(), 3);
            remove(&at("moved")).unwrap();
            open_folder(&root.join(link)).unwrap().sync_all().unwrap();
        }
    }

    #[test]
    fn what_is_no_file_is_refused_at_once() {
        let (_dir, root, outside) = folders();
        for folder in [root, outside] {
            let pipe = folder.join("pipe");
            rustix::fs::mknodat(rustix::fs::CWD, &pipe, rustix::fs::FileType::Fifo, 0o600.into(), 0).unwrap();
            let error = open(&pipe).unwrap_err();
            assert_eq!(error.to_string(), "it is a named pipe, and only files are opened");
            assert!(append(&pipe).is_err() && open_or_make(&pipe).is_err());
            assert_eq!(open(&folder).unwrap_err().kind(), ErrorKind::IsADirectory);
        }
        assert!(open(Path::new("/dev/zero")).unwrap_err().to_string().contains("a device"));
    }

    #[test]
    fn a_link_that_is_swapped_while_it_runs_never_leads_out() {
        let (_dir, root, _) = folders();
        let at = root.join("swapped");
        let done = std::sync::atomic::AtomicBool::new(false);
        std::thread::scope(|scope| {
            scope.spawn(|| {
                for target in ["real", "../outside"].iter().cycle() {
                    if done.load(std::sync::atomic::Ordering::Relaxed) {
                        return;
                    }
                    let _ = symlink(target, root.join("next"));
                    let _ = fs::rename(root.join("next"), &at);
                }
            });
            for _ in 0..2000 {
                assert!(open(&at.join("secret")).is_err());
                let _ = make(&at.join("new")).map(|_| remove(&at.join("new")));
            }
            done.store(true, std::sync::atomic::Ordering::Relaxed);
        });
        assert!(!root.join("../outside/new").exists());
    }
}

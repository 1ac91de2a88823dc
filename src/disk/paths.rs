//! Paths that stay inside a folder.

use std::path::{Component, Path, PathBuf};

use super::{Fault, FileFault, Result, door};

/// The file that `relative` names inside `root`. Refuses absolute paths, `..`, and links that lead out, so that a
/// manifest can open nothing outside its own folder.
///
/// # Errors
/// When the path leaves `root`, by its words or through a link.
pub fn inside(root: &Path, relative: &str) -> Result<PathBuf> {
    let path = Path::new(relative);
    let leaves = path.components().any(|c| !matches!(c, Component::Normal(_) | Component::CurDir));
    if leaves || relative.is_empty() {
        return Err(Fault::of(FileFault::Outside, format!("`{relative}` leads out of the project's folder"))
            .help("give a path inside it, without `..` and not starting with `/`"));
    }
    let full = root.join(path);
    // Only what exists can be a link: walk up to the deepest part that is there and see where it really is.
    let mut existing = full.as_path();
    while let Err(error) = existing.symlink_metadata() {
        match existing.parent() {
            Some(parent) if error.kind() == std::io::ErrorKind::NotFound => existing = parent,
            _ => return Err(Fault::io("cannot look at it", existing, error)),
        }
    }
    let real = existing.canonicalize().map_err(|e| Fault::io("cannot follow the link", existing, e))?;
    let real_root = root.canonicalize().map_err(|e| Fault::io("cannot open the folder", root, e))?;
    if real.starts_with(&real_root) {
        Ok(full)
    } else {
        Err(Fault::of(FileFault::Outside, format!("`{relative}` is a link that leads out of the project's folder"))
            .at(&full)
            .help("copy the file into the project instead"))
    }
}

/// Whether a file is there. What is no file and has its name is told and not overlooked.
///
/// # Errors
/// When it is a folder, a named pipe, a device, or a link that leads nowhere.
pub fn is_file_there(path: &Path) -> Result<bool> {
    let Ok(own) = path.symlink_metadata() else { return Ok(false) };
    let what = match path.metadata() {
        Ok(there) if there.is_file() => return Ok(true),
        Ok(there) if there.is_dir() => "a folder",
        Ok(there) => door::name_of(there.file_type()),
        Err(_) if own.is_symlink() => "a link that leads nowhere",
        Err(error) => return Err(Fault::io("cannot look at it", path, error)),
    };
    Err(Fault::of(FileFault::Mismatch, format!("it is {what}, where a file is needed"))
        .at(path)
        .help("move it away, or put the file in its place"))
}

/// The path, or where something has it, the same with the first number from 2 on behind it that nothing has.
#[must_use]
pub fn free_name(path: &Path) -> PathBuf {
    let with = |number: u32| {
        let mut name = path.as_os_str().to_owned();
        name.push(number.to_string());
        PathBuf::from(name)
    };
    let is_free = |path: &Path| path.symlink_metadata().is_err();
    if is_free(path) {
        return path.to_owned();
    }
    (2..).map(with).find(|path| is_free(path)).unwrap_or_else(|| path.to_owned())
}

/// Whether `name` can name a folder or file of ours: letters of any script, digits, `-`, `_` and `.`, not starting
/// with a dot, at most 100 bytes.
///
/// # Errors
/// When it cannot, with what is allowed.
pub fn plain_name(name: &str) -> Result<()> {
    let fine = !name.is_empty()
        && name.len() <= 100
        && !name.starts_with('.')
        && name.chars().all(|c| c.is_alphanumeric() || matches!(c, '-' | '_' | '.'));
    if fine {
        Ok(())
    } else {
        Err(Fault::of(FileFault::OutOfRange, format!("`{name}` cannot be a name here"))
            .help("use letters, digits, `-`, `_` and `.`, at most 100 bytes, not starting with a dot"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_out_of_the_folder_is_refused_in_every_spelling() {
        let root = tempfile::tempdir().unwrap();
        for bad in ["../x", "/etc/passwd", "a/../../x", ""] {
            assert!(inside(root.path(), bad).is_err(), "{bad}");
        }
        assert!(inside(root.path(), "clips/new/file.txt").is_ok());
    }

    #[cfg(unix)]
    #[test]
    fn a_link_out_of_the_folder_is_refused_and_one_within_is_not() {
        let root = tempfile::tempdir().unwrap();
        let outside = tempfile::tempdir().unwrap();
        std::os::unix::fs::symlink(outside.path(), root.path().join("out")).unwrap();
        std::fs::create_dir(root.path().join("real")).unwrap();
        std::os::unix::fs::symlink(root.path().join("real"), root.path().join("in")).unwrap();
        assert!(inside(root.path(), "out/file").is_err());
        assert!(inside(root.path(), "in/file").is_ok());
    }
}

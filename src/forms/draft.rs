//! A large file on its way: it is written beside its place and put there when it is whole.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use crate::disk::{Fault, Result, Setting, make_folder, message, put_whole, temporary_in};

/// Whatever becomes of it, nobody sees half of it: dropped, it is gone.
pub(crate) struct Draft {
    file: BufWriter<NamedTempFile>,
    place: PathBuf,
}

impl Draft {
    /// Makes the folder where it is missing.
    pub(crate) fn new(place: &Path) -> Result<Self> {
        let file = beside(place, "")?;
        Ok(Self { file: BufWriter::with_capacity(1 << 18, file), place: place.to_owned() })
    }

    /// Puts it in its place and says how many bytes it has. `mend` may write something again first.
    pub(crate) fn finish(self, mend: impl FnOnce(&mut File) -> std::io::Result<()>) -> Result<u64> {
        let Self { file, place } = self;
        let saved = (|| {
            let mut file = file.into_inner().map_err(std::io::IntoInnerError::into_error)?;
            mend(file.as_file_mut())?;
            let bytes = file.as_file().metadata()?.len();
            put_whole(file, &place)?;
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
pub(crate) fn beside(place: &Path, ending: &str) -> Result<NamedTempFile> {
    let folder = match place.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    make_folder(folder).map_err(|e| folder_fault(folder, e))?;
    temporary_in(folder, ending).map_err(|e| write_fault(place, e))
}

/// A folder that cannot be made: often something else is where it or one of those around it should be.
pub(crate) fn folder_fault(folder: &Path, error: std::io::Error) -> Fault {
    let in_the_way = folder.ancestors().find(|f| !f.as_os_str().is_empty() && f.symlink_metadata().is_ok());
    let help = match in_the_way.filter(|f| !f.is_dir()) {
        Some(file) => {
            message![
                format!("`{}` is no folder: move it away, or choose another place with ", file.display()),
                Setting::Out
            ]
        }
        None => message!["choose a place where you may write with ", Setting::Out],
    };
    Fault::io("cannot make the folder", folder, error).help(help)
}

pub(crate) fn write_fault(place: &Path, error: std::io::Error) -> Fault {
    Fault::writing("cannot write it", place, error)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_where_the_folder_should_be_is_named_and_there_is_a_next_step() {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("out");
        std::fs::write(&out, "a file").unwrap();
        for place in [out.join("a.gif"), out.join("deeper/a.gif")] {
            let Err(fault) = beside(&place, "") else { panic!("a file became a folder") };
            let text = fault.to_string();
            assert!(text.starts_with("cannot make the folder: "), "{text}");
            assert!(
                text.contains(&format!("`{}` is no folder", out.display()))
                    && fault.advice().steps().any(|s| *s == Setting::Out.into()),
                "{text}"
            );
        }
        assert_eq!(std::fs::read(&out).unwrap(), b"a file");
    }
}

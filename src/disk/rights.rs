//! Who may read and write a file that takes another's place.

use std::fs::File;
use std::io::Result;
use std::path::Path;

/// Mode and group of a file to be written. Systems without modes ignore them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rights {
    /// A new file's usual ones.
    Usual,
    /// A new file's usual ones, less those that this mode lacks.
    AtMost(u32),
    /// Those of the file that is replaced.
    Same {
        /// Its permission bits.
        mode: u32,
        /// The number of its group.
        group: u32,
    },
}

impl Rights {
    /// Those of the file at `path`. Where nothing is there, a new file's, less those that `like` lacks: a file that is
    /// added to a private project is private.
    #[must_use]
    #[cfg(unix)]
    pub(crate) fn of(path: &Path, like: &Path) -> Self {
        use std::os::unix::fs::MetadataExt;
        /// Its owner can write what is made new.
        const OWNER: u32 = 0o600;
        if let Ok(data) = std::fs::metadata(path) {
            return Self::Same { mode: data.mode() & 0o777, group: data.gid() };
        }
        std::fs::metadata(like).map_or(Self::Usual, |data| Self::AtMost(data.mode() & 0o666 | OWNER))
    }

    /// A new file's usual ones: there are no modes here.
    #[must_use]
    #[cfg(not(unix))]
    pub(crate) fn of(_path: &Path, _like: &Path) -> Self {
        Self::Usual
    }

    /// Gives them to a file that was made with the usual ones.
    #[cfg(unix)]
    pub(super) fn give(self, file: &File) -> Result<()> {
        use std::os::unix::fs::{MetadataExt, PermissionsExt, fchown};
        let now = file.metadata()?;
        let mode = match self {
            Self::Usual => return Ok(()),
            Self::AtMost(mode) => now.mode() & 0o777 & mode,
            Self::Same { mode, group } => {
                // Allowed to the group's members; the file of another has its own group, which gets what all others have.
                let is_given = group == now.gid() || fchown(file, None, Some(group)).is_ok();
                if is_given { mode } else { mode & 0o707 | (mode & 0o7) << 3 & mode }
            }
        };
        if mode == now.mode() & 0o777 {
            return Ok(());
        }
        file.set_permissions(std::fs::Permissions::from_mode(mode))
    }

    #[cfg(not(unix))]
    pub(super) fn give(self, _file: &File) -> Result<()> {
        Ok(())
    }
}

//! The sum of a file's bytes, by which its states are compared.

use std::io::{ErrorKind, Read};
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::{Fault, Result, door};

/// Length in bytes and CRC-32 of a file. It detects an accidental change, not a forged one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Sum {
    length: u64,
    crc: u32,
}

impl Sum {
    /// The sum of bytes in memory.
    #[must_use]
    pub fn of(bytes: &[u8]) -> Self {
        Self { length: bytes.len() as u64, crc: crc32fast::hash(bytes) }
    }

    /// The sum of the file at `path`; none where nothing is there.
    ///
    /// # Errors
    /// When it cannot be read, or is no regular file.
    pub fn at(path: &Path) -> Result<Option<Self>> {
        let cannot = |e| Fault::io("cannot read it", path, e);
        let mut file = match door::open(path) {
            Ok(file) => file,
            Err(e) if e.kind() == ErrorKind::NotFound => return Ok(None),
            Err(e) if e.raw_os_error().is_none() => return Err(cannot(e).help("move it aside")),
            Err(e) => return Err(cannot(e)),
        };
        let mut hasher = crc32fast::Hasher::new();
        let mut length = 0;
        let mut buffer = vec![0; 1 << 16];
        loop {
            match file.read(&mut buffer).map_err(cannot)? {
                0 => return Ok(Some(Self { length, crc: hasher.finalize() })),
                read => {
                    length += read as u64;
                    hasher.update(&buffer[..read]);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_and_its_bytes_have_one_sum() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("file");
        assert_eq!(Sum::at(&path).unwrap(), None);
        let bytes = vec![7; 200_000];
        std::fs::write(&path, &bytes).unwrap();
        assert_eq!(Sum::at(&path).unwrap(), Some(Sum::of(&bytes)));
        assert!(Sum::at(folder.path()).is_err());
    }
}

//! The sum of a file's bytes, by which its states are compared.

use std::io::{ErrorKind, Read};
use std::path::Path;

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::{Fault, Result, door};

/// Length in bytes and the first eight bytes of the SHA-256 of a file. A CRC-32 would not do: it is the same for all
/// files of one length that end in their own CRC-32, as a model does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Sum {
    length: u64,
    sha256: u64,
}

impl Sum {
    /// The sum of bytes in memory.
    #[must_use]
    pub(crate) fn of(bytes: &[u8]) -> Self {
        Self::new(bytes.len() as u64, Sha256::new_with_prefix(bytes))
    }

    fn new(length: u64, hasher: Sha256) -> Self {
        let [a, b, c, d, e, f, g, h, ..] = hasher.finalize().0;
        Self { length, sha256: u64::from_be_bytes([a, b, c, d, e, f, g, h]) }
    }

    /// The sum of the file at `path`; none where nothing is there.
    ///
    /// # Errors
    /// When it cannot be read, or is no regular file.
    pub(crate) fn at(path: &Path) -> Result<Option<Self>> {
        let cannot = |e| Fault::io("cannot read it", path, e);
        let mut file = match door::open(path) {
            Ok(file) => file,
            Err(e) if e.kind() == ErrorKind::NotFound => return Ok(None),
            Err(e) if e.raw_os_error().is_none() => return Err(cannot(e).help("move it aside")),
            Err(e) => return Err(cannot(e)),
        };
        let mut hasher = Sha256::new();
        let mut length = 0;
        let mut buffer = vec![0; 1 << 16];
        loop {
            match file.read(&mut buffer).map_err(cannot)? {
                0 => return Ok(Some(Self::new(length, hasher))),
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

    #[test]
    fn files_that_end_in_their_own_checksum_have_sums_of_their_own() {
        let sum = |text: &[u8]| Sum::of(&[text, &crc32fast::hash(text).to_le_bytes()].concat());
        assert_ne!(sum(b"one model"), sum(b"two model"));
    }
}

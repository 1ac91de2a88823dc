//! Files as they come in: of bounded length, text in UTF-8.

use std::io::{ErrorKind, Read};
use std::path::Path;

use super::{Fault, FileFault, Result, clean, door};

/// The largest text file that is read. A lesson of an hour, phones included, is below 2 MB.
pub const MAX_TEXT_BYTES: u64 = 64 << 20;

/// The bytes of a file of at most `limit` bytes; the length in its header is not believed.
///
/// # Errors
/// When it cannot be read or is longer than `limit`.
pub fn read_bytes(path: &Path, limit: u64) -> Result<Vec<u8>> {
    let file = door::open(path).map_err(|e| cannot_open(path, e))?;
    let mut bytes = Vec::new();
    file.take(limit + 1).read_to_end(&mut bytes).map_err(|e| Fault::io("cannot read it", path, e))?;
    if bytes.len() as u64 > limit {
        return Err(Fault::of(FileFault::TooLarge, format!("the file is larger than {} MB", limit >> 20))
            .at(path)
            .help("files of this kind are far smaller; is it the right one?"));
    }
    Ok(bytes)
}

/// A file that cannot be opened; where that is not the system's word, with what to do.
fn cannot_open(path: &Path, error: std::io::Error) -> Fault {
    let help = match error.kind() {
        ErrorKind::PermissionDenied if error.raw_os_error().is_none() => "copy the file into the project instead",
        ErrorKind::InvalidInput => "save what comes out of it as a file and give that",
        _ => return Fault::io("cannot open it", path, error),
    };
    Fault::io("cannot open it", path, error).help(help)
}

/// The text of a UTF-8 file, with or without a byte order mark, made [`clean`].
///
/// # Errors
/// When it cannot be read, is too large, or is not UTF-8 (with the line where that begins).
pub fn read_text(path: &Path) -> Result<String> {
    let bytes = read_bytes(path, MAX_TEXT_BYTES)?;
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(&bytes);
    match std::str::from_utf8(bytes) {
        Ok(text) => Ok(clean(text)),
        Err(error) => {
            let line = 1 + bytes[..error.valid_up_to()].iter().filter(|b| **b == b'\n').count();
            Err(Fault::of(FileFault::Encoding, "the file is not UTF-8 text")
                .at(path)
                .line(line)
                .help("save it as UTF-8 and try again"))
        }
    }
}

/// The largest file that is compared with what is to take its place.
const MAX_OLD_BYTES: u64 = 1 << 30;

/// The bytes of a regular file of at most 1 GiB; none where there is no such file.
#[must_use]
pub fn read_old(path: &Path) -> Option<Vec<u8>> {
    read_bytes(path, MAX_OLD_BYTES).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_that_is_not_utf8_names_the_line() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("big5.txt");
        std::fs::write(&path, b"one\ntwo\n\xB1\x7A").unwrap();
        let fault = read_text(&path).unwrap_err();
        assert_eq!(fault.line_number(), Some(3));
    }
}

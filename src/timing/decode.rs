//! Bytes to text: UTF-8 or UTF-16, as Praat writes it, with or without a byte order mark.

use crate::disk::{self, Fault, FileFault, MAX_TEXT_BYTES, Result};

/// The text of a timing file, cleaned; lines keep their numbers.
///
/// # Errors
/// When it is too large, or neither UTF-8 nor UTF-16, with the line where that shows.
pub(super) fn text(bytes: &[u8]) -> Result<String> {
    if bytes.len() as u64 > MAX_TEXT_BYTES {
        return Err(Fault::of(FileFault::TooLarge, format!("the file is larger than {} MB", MAX_TEXT_BYTES >> 20))
            .help("timing files are far smaller; is it the right one?"));
    }
    match bytes {
        [0xFF, 0xFE, rest @ ..] => wide(rest, u16::from_le_bytes),
        [0xFE, 0xFF, rest @ ..] => wide(rest, u16::from_be_bytes),
        // Every format begins with a letter, a digit or a sign of ASCII, whose other half is 0.
        [1..=127, 0, ..] => wide(bytes, u16::from_le_bytes),
        [0, 1..=127, ..] => wide(bytes, u16::from_be_bytes),
        _ => {
            let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
            std::str::from_utf8(bytes).map(disk::clean).map_err(|error| {
                let line = 1 + bytes[..error.valid_up_to()].iter().filter(|b| **b == b'\n').count();
                Fault::of(FileFault::Encoding, "the file is neither UTF-8 nor UTF-16 text")
                    .line(line)
                    .help("save it as UTF-8 and try again")
            })
        }
    }
}

/// UTF-16 in one of its byte orders. A byte left over at the end is what a cut leaves; what follows will say so.
fn wide(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> Result<String> {
    let units = bytes.chunks_exact(2).map(|pair| unit([pair[0], pair[1]]));
    let mut text = String::new();
    for c in char::decode_utf16(units) {
        match c {
            Ok(c) => text.push(c),
            Err(_) => {
                let line = 1 + text.matches('\n').count();
                return Err(Fault::of(FileFault::CutOff, "the file is not whole UTF-16 text")
                    .line(line)
                    .help("save it as UTF-8"));
            }
        }
    }
    Ok(disk::clean(&text))
}

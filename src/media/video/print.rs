//! Whether a video is still the one that was tracked: a fingerprint that is quick to take.

use std::io::{Read, Seek, SeekFrom};
use std::path::Path;

use sha2::{Digest, Sha256};

use crate::disk::{Fault, Result, open};

/// Bytes of a stretch that is looked at.
const STRETCH: u64 = 16 << 10;

/// SHA-256 of the names and lengths of files and of some of their bytes: all of a file up to 16 kB a stretch, else as
/// many stretches, evenly spread. 64 hexadecimal digits.
pub(super) fn fingerprint<'a>(files: impl Iterator<Item = &'a Path>, stretches: u64) -> Result<String> {
    let mut sum = Sha256::new();
    let mut bytes = Vec::new();
    for path in files {
        let fault = |e| Fault::io("cannot read it", path, e);
        let mut file = open(path).map_err(fault)?;
        let length = file.metadata().map_err(fault)?.len();
        sum.update(path.file_name().unwrap_or_default().as_encoded_bytes());
        sum.update([0]);
        sum.update(length.to_le_bytes());
        let count = if length <= stretches * STRETCH { length.div_ceil(STRETCH) } else { stretches };
        for k in 0..count {
            let at = if count == stretches {
                (length.saturating_sub(STRETCH)) * k / (count - 1).max(1)
            } else {
                k * STRETCH
            };
            file.seek(SeekFrom::Start(at)).map_err(fault)?;
            bytes.clear();
            file.by_ref().take(STRETCH).read_to_end(&mut bytes).map_err(fault)?;
            sum.update(&bytes);
        }
    }
    Ok(sum.finalize().iter().map(|b| format!("{b:02x}")).collect())
}

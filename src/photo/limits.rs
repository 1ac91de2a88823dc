//! The largest photos that are decoded, and the faults of those that are larger or damaged.

use image::ImageError;

use crate::disk::{Fault, FileFault, Result};

/// The most pixels that a photo may be wide or high.
pub const MAX_PHOTO_SIDE: u32 = 12_000;
/// The most memory that decoding may take: 100 megapixels of 16-bit RGBA.
pub(super) const MAX_DECODED_BYTES: u64 = 800 << 20;
/// How many times larger than its file a photo may be once decoded. One colour all over is packed 500 times smaller by
/// JPEG and 1000 times by PNG; a header that promises more is a trap for memory, or no photo.
const MAX_PACKED: u64 = 2000;
/// Below this size once decoded a photo is no trap.
const HARMLESS_BYTES: u64 = 4 << 20;

/// Refuses a photo of `size` bytes once decoded, from a file of `packed` bytes, where that is more than may be decoded or
/// than the file can hold.
pub(super) fn check_size(size: u64, packed: usize) -> Result<()> {
    if size > MAX_DECODED_BYTES {
        return Err(too_large());
    }
    if size > HARMLESS_BYTES && size / MAX_PACKED > packed as u64 {
        return Err(Fault::of(
            FileFault::CutOff,
            "the photo is damaged: its header promises more pixels than the file can hold",
        )
        .help("save it again in another program and give that"));
    }
    Ok(())
}

pub(super) fn too_large() -> Fault {
    Fault::of(
        FileFault::TooLarge,
        format!("the photo is larger than {MAX_PHOTO_SIDE} × {MAX_PHOTO_SIDE} pixels, or too large to decode"),
    )
    .help("scale it down; 1000 pixels across are plenty")
}

pub(super) fn of_decoding(error: ImageError) -> Fault {
    match error {
        ImageError::Limits(_) => too_large(),
        error => {
            Fault::new(format!("the photo is damaged: {error}")).help("save it again in another program and give that")
        }
    }
}

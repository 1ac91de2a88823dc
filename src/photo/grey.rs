//! A picture as the model looks at it: luma alone.

use std::path::Path;

use super::{MAX_PHOTO_BYTES, Photo, jpeg_luma};
use crate::disk::{Result, read_bytes};
use crate::drawing::Image;

/// Luma (Rec. 601 on sRGB values) of 8 bits.
pub type Grey = Image<u8>;

impl Grey {
    /// The luma of a photo.
    #[must_use]
    pub fn of(photo: &Photo) -> Self {
        photo.map(|p| {
            let [r, g, b] = p.map(u32::from);
            // 0.299, 0.587, 0.114 in parts of 65536, rounded.
            ((19_595 * r + 38_470 * g + 7_471 * b + 32_768) >> 16) as u8
        })
    }

    /// Decodes the bytes of a PNG, JPEG or WebP file. Of a JPEG the colours are not decoded, which is what takes most
    /// of the time; everything out of the ordinary goes the way of [`Photo::decode`].
    ///
    /// # Errors
    /// As [`Photo::decode`].
    pub fn decode(bytes: &[u8]) -> Result<Self> {
        match jpeg_luma(bytes) {
            Some(grey) => Ok(grey),
            None => Ok(Self::of(&Photo::decode(bytes)?)),
        }
    }

    /// Reads a PNG, JPEG or WebP file; see [`decode`](Self::decode).
    ///
    /// # Errors
    /// When it cannot be read, and as [`Photo::decode`].
    pub fn read(path: &Path) -> Result<Self> {
        Self::decode(&read_bytes(path, MAX_PHOTO_BYTES)?).map_err(|fault| fault.at(path))
    }

    /// Half the size: the means of blocks of two by two; an odd last row or column is left out.
    ///
    /// # Panics
    /// When a side is 1.
    #[must_use]
    pub(crate) fn halved(&self) -> Self {
        let (width, height) = (self.width() / 2, self.height() / 2);
        let mut pixels = Vec::with_capacity(width * height);
        for y in 0..height {
            halve(self.row(2 * y), self.row(2 * y + 1), &mut pixels);
        }
        Self::new(width, height, pixels)
    }

    /// The same in grey, as a photo.
    #[must_use]
    pub fn to_photo(&self) -> Photo {
        self.map(|v| [*v; 3])
    }
}

/// Appends the means of blocks of two by two of two rows.
pub(crate) fn halve(top: &[u8], below: &[u8], out: &mut Vec<u8>) {
    let ((top, _), (below, _)) = (top.as_chunks::<2>(), below.as_chunks::<2>());
    out.extend(
        top.iter()
            .zip(below)
            .map(|([a, b], [c, d])| ((u16::from(*a) + u16::from(*b) + u16::from(*c) + u16::from(*d) + 2) >> 2) as u8),
    );
}

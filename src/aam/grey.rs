//! A picture as the model looks at it: luma alone.

use std::path::Path;

use crate::disk::{Result, read_bytes};
use crate::photo::{MAX_PHOTO_BYTES, Photo, Plane, jpeg_luma};

/// Luma (Rec. 601 on sRGB values) of 8 bits, row by row from the top; pixel centres are whole numbers.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Grey {
    width: usize,
    height: usize,
    pixels: Vec<u8>,
}

impl Grey {
    /// A picture of `width` × `height` pixels, row by row.
    ///
    /// # Panics
    /// When there are not exactly `width * height` pixels, or none.
    #[must_use]
    pub fn new(width: usize, height: usize, pixels: Vec<u8>) -> Self {
        assert!(width > 0 && height > 0 && pixels.len() == width * height, "a picture has width × height pixels");
        Self { width, height, pixels }
    }

    /// The luma of a photo.
    #[must_use]
    pub fn of(photo: &Photo) -> Self {
        let luma = |p: &[u8; 3]| {
            let [r, g, b] = p.map(u32::from);
            // 0.299, 0.587, 0.114 in parts of 65536, rounded.
            ((19_595 * r + 38_470 * g + 7_471 * b + 32_768) >> 16) as u8
        };
        Self { width: photo.width(), height: photo.height(), pixels: photo.pixels().iter().map(luma).collect() }
    }

    /// A plane of values from 0 to 255, rounded.
    #[must_use]
    pub fn of_plane(plane: &Plane) -> Self {
        let pixels = plane.values.iter().map(|v| v.round() as u8).collect();
        Self { width: plane.width, height: plane.height, pixels }
    }

    /// Decodes the bytes of a PNG, JPEG or WebP file. Of a JPEG the colours are not decoded, which is what takes most
    /// of the time; everything out of the ordinary goes the way of [`Photo::decode`].
    ///
    /// # Errors
    /// As [`Photo::decode`].
    pub fn decode(bytes: &[u8]) -> Result<Self> {
        match jpeg_luma(bytes) {
            Some((width, height, pixels)) => Ok(Self::new(width, height, pixels)),
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

    /// Pixels in a row.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    #[must_use]
    pub fn height(&self) -> usize {
        self.height
    }

    /// The pixels, row by row.
    #[must_use]
    pub fn pixels(&self) -> &[u8] {
        &self.pixels
    }

    /// The same in grey, as a photo.
    #[must_use]
    pub fn to_photo(&self) -> Photo {
        Photo::new(self.width, self.height, self.pixels.iter().map(|v| [*v; 3]).collect())
    }
}

//! PNG, JPEG and WebP files as photos: size checked before a pixel is decoded, turned upright, made opaque.
//!
//! Colour profiles are ignored: values are taken as sRGB. A photo in Display P3, as many phones take them, comes out a
//! little paler than it is, by less than skin tones differ from photo to photo. Of CMYK files the inks are turned to
//! RGB without a profile either. Of animations the first picture is taken.

use std::io::Cursor;
use std::path::Path;

use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};
use sha2::{Digest, Sha256};

use super::limits::{MAX_DECODED_BYTES, MAX_PHOTO_SIDE, check_size, of_decoding};
use super::{Photo, jpeg};
use crate::disk::{Fault, FileFault, Result, read_bytes};

/// The largest photo file that is read.
pub const MAX_PHOTO_BYTES: u64 = 64 << 20;

impl Photo {
    /// Reads a PNG, JPEG or WebP file. Orientation tags are obeyed, 16 bits become 8, grey becomes RGB, and what is
    /// transparent is laid on light grey, as a wall would be. What else a file says, above all where and when the photo
    /// was taken, is not kept.
    ///
    /// # Errors
    /// When it cannot be read, is of another kind, is damaged, or is too large.
    pub fn read(path: &Path) -> Result<Self> {
        Self::decode(&read_bytes(path, MAX_PHOTO_BYTES)?).map_err(|fault| fault.at(path))
    }

    /// The photo of a file, and the file's SHA-256 as 64 hexadecimal digits.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn read_with_sum(path: &Path) -> Result<(Self, String)> {
        let bytes = read_bytes(path, MAX_PHOTO_BYTES)?;
        let photo = Self::decode(&bytes).map_err(|fault| fault.at(path))?;
        let sum = sha256(&bytes);
        Ok((photo, sum))
    }

    /// Decodes the bytes of a PNG, JPEG or WebP file, as [`read`](Self::read) does.
    ///
    /// # Errors
    /// When they are of another kind, damaged, or of too large a picture.
    pub fn decode(bytes: &[u8]) -> Result<Self> {
        let kind = image::guess_format(bytes).ok().filter(|f| KINDS.contains(f));
        let Some(kind) = kind else {
            return Err(Fault::of(
                FileFault::Unsupported,
                format!("this is not a photo that can be read{}", named(bytes)),
            )
            .help("save it as PNG, JPEG or WebP and give that"));
        };
        if kind == ImageFormat::Jpeg {
            return jpeg::upright(bytes).map(flattened);
        }
        let mut reader = ImageReader::new(Cursor::new(bytes));
        reader.set_format(kind);
        let mut limits = Limits::default();
        limits.max_image_width = Some(MAX_PHOTO_SIDE);
        limits.max_image_height = Some(MAX_PHOTO_SIDE);
        limits.max_alloc = Some(MAX_DECODED_BYTES);
        reader.limits(limits);
        let mut decoder = reader.into_decoder().map_err(of_decoding)?;
        check_size(decoder.total_bytes(), bytes.len())?;
        let orientation = decoder.orientation().map_err(of_decoding)?;
        let mut image = DynamicImage::from_decoder(decoder).map_err(of_decoding)?;
        image.apply_orientation(orientation);
        Ok(flattened(image))
    }
}

/// The SHA-256 of bytes, as 64 hexadecimal digits.
#[must_use]
pub fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|b| format!("{b:02x}")).collect()
}

const KINDS: [ImageFormat; 3] = [ImageFormat::Png, ImageFormat::Jpeg, ImageFormat::WebP];

/// What the bytes are of, where that is a known kind that is not read.
fn named(bytes: &[u8]) -> &'static str {
    let is = |at: usize, magic: &[u8]| bytes.get(at..at + magic.len()) == Some(magic);
    if is(4, b"ftyphei") || is(4, b"ftypmif") || is(4, b"ftyphev") {
        ": it is HEIC, as phones write it"
    } else if is(4, b"ftypavif") {
        ": it is AVIF"
    } else if is(0, b"GIF8") {
        ": it is a GIF"
    } else if is(0, b"II*\0") || is(0, b"MM\0*") {
        ": it is a TIFF or a camera's raw file"
    } else if is(0, b"%PDF") {
        ": it is a PDF"
    } else if is(0, b"BM") {
        ": it is a BMP"
    } else if bytes.is_empty() {
        ": the file is empty"
    } else {
        ""
    }
}

/// Opaque 8-bit RGB; see [`Photo::read`].
fn flattened(image: DynamicImage) -> Photo {
    let (width, height) = (image.width() as usize, image.height() as usize);
    let pixels = if image.color().has_alpha() {
        const WALL: f32 = 224.0;
        let laid = |v: u8, a: u8| {
            let a = f32::from(a) / 255.0;
            (f32::from(v) * a + WALL * (1.0 - a)).round() as u8
        };
        image.into_rgba8().pixels().map(|p| [laid(p[0], p[3]), laid(p[1], p[3]), laid(p[2], p[3])]).collect()
    } else {
        image.into_rgb8().pixels().map(|p| p.0).collect()
    };
    Photo::new(width, height, pixels)
}

//! Pixels as PNG, with a key that says what they show, so that an interrupted export can tell what is done.

use super::Painter;
use crate::disk::{Fault, FileFault, Result};
use crate::drawing::{Drawing, Picture};

/// The keyword of the text chunk that carries the key.
const KEYWORD: &[u8] = b"lianpu";

/// What every PNG file starts with.
pub(super) const SIGNATURE: &[u8; 8] = b"\x89PNG\r\n\x1a\n";

/// Appends a chunk with its length and checksum.
pub(super) fn chunk(file: &mut Vec<u8>, kind: [u8; 4], data: &[u8]) {
    file.extend_from_slice(&(data.len() as u32).to_be_bytes());
    let start = file.len();
    file.extend_from_slice(&kind);
    file.extend_from_slice(data);
    let sum = crc32fast::hash(&file[start..]);
    file.extend_from_slice(&sum.to_be_bytes());
}

/// Appends the text chunk that carries a key.
pub(super) fn text_chunk(file: &mut Vec<u8>, key: &str) {
    chunk(file, *b"tEXt", &[KEYWORD, b"\0", key.as_bytes()].concat());
}

/// The PNG file of a picture: RGBA, each row told by its difference from the one above, which suits flat colours
/// and costs a third of the other filters. `key` goes into a text chunk before the pixels.
///
/// # Errors
/// When the encoder refuses the size.
pub fn encode_png(picture: &Picture, key: &str) -> Result<Vec<u8>> {
    let mut bytes = Vec::with_capacity(64 << 10);
    let encoded = (|| {
        let side = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
        let mut encoder = png::Encoder::new(&mut bytes, side(picture.width()), side(picture.height()));
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::Fast);
        encoder.set_filter(png::Filter::Up);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        if !key.is_empty() {
            encoder.add_text_chunk(String::from_utf8_lossy(KEYWORD).into_owned(), key.to_owned())?;
        }
        let mut writer = encoder.write_header()?;
        writer.write_image_data(picture.pixels().as_flattened())?;
        writer.finish()
    })();
    encoded.map_err(|e| Fault::of(FileFault::OutOfRange, format!("the picture cannot be written as PNG: {e}")))?;
    Ok(bytes)
}

/// A drawing as a PNG file of `width` × `height` pixels, without key.
///
/// # Errors
/// When a picture cannot have that size.
pub fn to_png(drawing: &Drawing, width: u32, height: u32) -> Result<Vec<u8>> {
    encode_png(&Painter::new(width, height)?.paint(drawing), "")
}

/// The key of a PNG file that is whole: every chunk's checksum holds and the end is there. `None` for any other.
#[must_use]
pub fn decode_key(file: &[u8]) -> Option<String> {
    let mut rest = file.strip_prefix(SIGNATURE)?;
    let mut key = None;
    loop {
        let length = u32::from_be_bytes(rest.get(..4)?.try_into().ok()?) as usize;
        let body = rest.get(4..length.checked_add(8)?)?;
        let sum = u32::from_be_bytes(rest.get(length + 8..length + 12)?.try_into().ok()?);
        if crc32fast::hash(body) != sum {
            return None;
        }
        let (kind, data) = body.split_at(4);
        match kind {
            b"tEXt" => {
                if let Some(text) = data.strip_prefix(KEYWORD).and_then(|d| d.strip_prefix(b"\0")) {
                    key = Some(String::from_utf8_lossy(text).into_owned());
                }
            }
            b"IEND" => return key,
            _ => {}
        }
        rest = rest.get(length + 12..)?;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_is_read_back_and_a_damaged_file_has_none() {
        let picture = Picture::new(3, 2, (0..6).map(|i| [i, i + 6, i + 12, i + 18]).collect());
        let file = encode_png(&picture, "abc").unwrap();
        assert_eq!(decode_key(&file).as_deref(), Some("abc"));
        for cut in 0..file.len() {
            assert_eq!(decode_key(&file[..cut]), None, "cut at {cut}");
        }
        let mut damaged = file.clone();
        let last = damaged.len() - 20;
        damaged[last] ^= 1;
        assert_eq!(decode_key(&damaged), None);
    }
}

//! Photos out: pixels and nothing else.

use super::Photo;
use crate::disk::{Fault, FileFault, Result};

/// A photo as a PNG file of 8-bit RGB that holds its pixels and nothing else: no place, no time, no camera, no
/// thumbnail of what was cut away, as the file it came from may. The same photo gives the same bytes.
///
/// # Errors
/// When the encoder refuses the size, which no photo that was read has.
pub fn to_clean_png(photo: &Photo) -> Result<Vec<u8>> {
    let mut bytes = Vec::with_capacity(64 << 10);
    let encoded = (|| {
        let size = |v: usize| u32::try_from(v).unwrap_or(u32::MAX);
        let mut encoder = png::Encoder::new(&mut bytes, size(photo.width()), size(photo.height()));
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::Balanced);
        encoder.set_filter(png::Filter::Adaptive);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(photo.pixels().as_flattened())?;
        writer.finish()
    })();
    encoded.map_err(|e| Fault::of(FileFault::OutOfRange, format!("the photo cannot be written as PNG: {e}")))?;
    Ok(bytes)
}

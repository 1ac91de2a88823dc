//! Pictures without what is said about them: place, camera, owner, comments. Pixels stay as they are.

/// The bytes of a JPEG or PNG without its metadata, its pixels untouched. None where that cannot be had by leaving
/// parts out: another format, a damaged file, or a photo that its metadata turns upright.
#[must_use]
pub(crate) fn without_metadata(bytes: &[u8]) -> Option<Vec<u8>> {
    if bytes.starts_with(PNG) { png(bytes) } else { jpeg(bytes) }
}

const PNG: &[u8] = b"\x89PNG\r\n\x1a\n";

/// The chunks that make the picture.
const KEPT: [&[u8; 4]; 8] = [b"IHDR", b"PLTE", b"tRNS", b"IDAT", b"IEND", b"sRGB", b"gAMA", b"cHRM"];

fn png(bytes: &[u8]) -> Option<Vec<u8>> {
    let mut out = PNG.to_vec();
    let mut at = PNG.len();
    loop {
        let length = u32::from_be_bytes(bytes.get(at..at + 4)?.try_into().ok()?) as usize;
        let chunk = bytes.get(at..at.checked_add(12)?.checked_add(length)?)?;
        let kind: &[u8; 4] = chunk[4..8].try_into().ok()?;
        if kind == b"eXIf" {
            return None;
        }
        if KEPT.contains(&kind) {
            out.extend_from_slice(chunk);
        }
        if kind == b"IEND" {
            return Some(out);
        }
        at += chunk.len();
    }
}

fn jpeg(bytes: &[u8]) -> Option<Vec<u8>> {
    if !bytes.starts_with(&[0xFF, 0xD8]) {
        return None;
    }
    let mut out = vec![0xFF, 0xD8];
    let mut at = 2;
    loop {
        let &[0xFF, marker] = bytes.get(at..at + 2)? else { return None };
        if marker == 0xFF {
            // Padding before a marker.
            at += 1;
            continue;
        }
        let length = usize::from(u16::from_be_bytes(bytes.get(at + 2..at + 4)?.try_into().ok()?));
        let segment = bytes.get(at..at + 2 + length).filter(|_| length >= 2)?;
        match marker {
            // Exif may say how the photo is turned; whoever reads it turns it.
            0xE1 if segment[4..].starts_with(b"Exif") => return None,
            // Scan: the rest is the picture, which may have further scans and ends by itself.
            0xDA => {
                out.extend_from_slice(&bytes[at..end_of_picture(bytes, at)?]);
                return Some(out);
            }
            // JFIF says how large a pixel is, Adobe how colours are meant.
            0xE0 | 0xEE => out.extend_from_slice(segment),
            0xE1..=0xEF | 0xFE => {}
            _ => out.extend_from_slice(segment),
        }
        at += 2 + length;
    }
}

/// Where the picture ends: after the first end marker, which no scan can hold. Phones append whole videos.
fn end_of_picture(bytes: &[u8], from: usize) -> Option<usize> {
    let end = bytes.get(from..)?.windows(2).position(|w| w == [0xFF, 0xD9])?;
    Some(from + end + 2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::photo::{Photo, to_clean_png};

    fn picture() -> Photo {
        Photo::new(16, 8, (0..128u8).map(|i| [i, 2 * i, 255 - i]).collect())
    }

    #[test]
    fn a_png_loses_its_text_and_keeps_its_pixels() {
        let clean = to_clean_png(&picture()).unwrap();
        let mut said = clean[..33].to_vec();
        let mut text = b"tEXtAuthor\0me".to_vec();
        let sum = crc32fast::hash(&text).to_be_bytes();
        said.extend(((text.len() - 4) as u32).to_be_bytes());
        said.append(&mut text);
        said.extend(sum);
        said.extend(&clean[33..]);
        assert_eq!(Photo::decode(&said).unwrap(), picture());
        let stripped = without_metadata(&said).unwrap();
        assert_eq!(Photo::decode(&stripped).unwrap(), picture());
        assert!(!stripped.windows(6).any(|w| w == b"Author"));
        for cut in 0..said.len() - 1 {
            assert!(without_metadata(&said[..cut]).is_none(), "cut at {cut}");
        }
    }

    #[test]
    fn a_jpeg_loses_comment_and_what_is_appended() {
        let mut plain = Vec::new();
        let pixels: Vec<u8> = picture().pixels().iter().flatten().copied().collect();
        image::codecs::jpeg::JpegEncoder::new(&mut plain)
            .encode(&pixels, 16, 8, image::ExtendedColorType::Rgb8)
            .unwrap();
        let mut said = plain[..2].to_vec();
        said.extend([0xFF, 0xFE, 0, 8]);
        said.extend(b"secret");
        said.extend(&plain[2..]);
        said.extend(b"a video behind it");
        let stripped = without_metadata(&said).unwrap();
        assert_eq!(Photo::decode(&stripped).unwrap(), Photo::decode(&plain).unwrap());
        assert!(stripped.len() <= plain.len());
        let mut exif = plain[..2].to_vec();
        exif.extend([0xFF, 0xE1, 0, 8]);
        exif.extend(b"Exif\0\0");
        exif.extend(&plain[2..]);
        assert!(without_metadata(&exif).is_none(), "it may be turned");
        assert!(without_metadata(b"GIF89a").is_none());
    }
}

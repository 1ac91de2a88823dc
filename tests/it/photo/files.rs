//! Files as photos: whatever a camera, a phone or a mishap makes of them.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use std::io::Cursor;

use image::{DynamicImage, ImageFormat, RgbImage};
use lianpu::photo::{Photo, to_clean_png};

const RED: [u8; 3] = [220, 30, 30];
const GREEN: [u8; 3] = [30, 200, 40];
const BLUE: [u8; 3] = [40, 40, 210];
const WHITE: [u8; 3] = [250, 250, 250];

/// The scene as a person sees it: 48 × 32, red and green above, blue and white below.
fn scene(x: usize, y: usize) -> [u8; 3] {
    match (x < 24, y < 16) {
        (true, true) => RED,
        (false, true) => GREEN,
        (true, false) => BLUE,
        (false, false) => WHITE,
    }
}

/// The scene as a camera stores it under an orientation tag: which side of the scene the first row and the first
/// column lie at is what the eight values of the tag mean (EXIF 2.3, tag 0x0112).
fn stored(orientation: u8) -> RgbImage {
    let (row, column) = [
        ("top", "left"),
        ("top", "right"),
        ("bottom", "right"),
        ("bottom", "left"),
        ("left", "top"),
        ("right", "top"),
        ("right", "bottom"),
        ("left", "bottom"),
    ][usize::from(orientation) - 1];
    let turned = orientation >= 5;
    let (width, height) = if turned { (32, 48) } else { (48, 32) };
    let place = |side: &str, k: usize| match side {
        "left" | "top" => k,
        "right" => 47 - k,
        _ => 31 - k,
    };
    RgbImage::from_fn(width, height, |c, r| {
        let (from_row, from_column) = (place(row, r as usize), place(column, c as usize));
        image::Rgb(if turned { scene(from_row, from_column) } else { scene(from_column, from_row) })
    })
}

/// The EXIF block of an orientation, big-endian TIFF with one entry.
fn exif(orientation: u8) -> Vec<u8> {
    let mut tiff = b"MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0".to_vec();
    tiff.extend([orientation, 0, 0, 0, 0, 0, 0]);
    tiff
}

fn encoded(image: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Vec::new();
    image.write_to(&mut Cursor::new(&mut bytes), format).unwrap();
    bytes
}

fn png_chunk(kind: &[u8; 4], data: &[u8]) -> Vec<u8> {
    let body: Vec<u8> = kind.iter().chain(data).copied().collect();
    let mut chunk = (data.len() as u32).to_be_bytes().to_vec();
    chunk.extend(&body);
    chunk.extend(crc32fast::hash(&body).to_be_bytes());
    chunk
}

/// The scene as a file of a kind, with its orientation told.
fn oriented(format: ImageFormat, orientation: u8) -> Vec<u8> {
    let file = encoded(&stored(orientation).into(), format);
    let exif = exif(orientation);
    match format {
        ImageFormat::Jpeg => {
            let mut out = file[..2].to_vec();
            out.extend([0xFF, 0xE1]);
            out.extend(((exif.len() + 8) as u16).to_be_bytes());
            out.extend(b"Exif\0\0");
            out.extend(&exif);
            out.extend(&file[2..]);
            out
        }
        ImageFormat::Png => {
            // After the signature and IHDR.
            let mut out = file[..33].to_vec();
            out.extend(png_chunk(b"eXIf", &exif));
            out.extend(&file[33..]);
            out
        }
        _ => {
            let riff = |kind: &[u8], data: &[u8]| {
                let mut chunk = kind.to_vec();
                chunk.extend((data.len() as u32).to_le_bytes());
                chunk.extend(data);
                chunk.resize(chunk.len().next_multiple_of(2), 0);
                chunk
            };
            let image = image::load_from_memory(&file).unwrap();
            let mut header = vec![0x08, 0, 0, 0];
            header.extend(&(image.width() - 1).to_le_bytes()[..3]);
            header.extend(&(image.height() - 1).to_le_bytes()[..3]);
            let mut body = b"WEBP".to_vec();
            body.extend(riff(b"VP8X", &header));
            // What the plain file holds after RIFF, its length and WEBP.
            body.extend(&file[12..]);
            body.extend(riff(b"EXIF", &exif));
            riff(b"RIFF", &body)
        }
    }
}

fn near(found: [u8; 3], wanted: [u8; 3]) -> bool {
    found.iter().zip(wanted).all(|(a, b)| a.abs_diff(b) <= 12)
}

#[test]
fn every_orientation_of_every_kind_is_turned_upright() {
    for format in [ImageFormat::Jpeg, ImageFormat::Png, ImageFormat::WebP] {
        for orientation in 1..=8 {
            let photo = Photo::decode(&oriented(format, orientation)).unwrap();
            assert_eq!((photo.width(), photo.height()), (48, 32), "{format:?} {orientation}");
            for (x, y) in [(5, 5), (42, 5), (5, 26), (42, 26)] {
                let found = photo.at(x, y);
                assert!(near(found, scene(x as usize, y as usize)), "{format:?} {orientation} at {x}, {y}: {found:?}");
            }
        }
    }
}

#[test]
fn an_orientation_that_cannot_be_is_ignored() {
    for orientation in [0, 9, 255] {
        let mut file = oriented(ImageFormat::Jpeg, 1);
        let at = file.windows(4).position(|w| w == b"Exif").unwrap() + 6 + 18;
        assert_eq!(file[at + 1], 1);
        file[at + 1] = orientation;
        assert!(near(Photo::decode(&file).unwrap().at(5, 5), RED));
    }
}

#[test]
fn sixteen_bits_grey_palette_and_alpha_become_opaque_rgb_of_8_bits() {
    let one = |image: DynamicImage| Photo::decode(&encoded(&image, ImageFormat::Png)).unwrap().at(0, 0);
    let deep = image::ImageBuffer::from_pixel(3, 2, image::Rgb([65535_u16, 32896, 257]));
    assert_eq!(one(DynamicImage::ImageRgb16(deep)), [255, 128, 1]);
    assert_eq!(one(DynamicImage::ImageLuma8(image::GrayImage::from_pixel(3, 2, image::Luma([77])))), [77; 3]);
    let grey = image::ImageBuffer::from_pixel(3, 2, image::Luma([32896_u16]));
    assert_eq!(one(DynamicImage::ImageLuma16(grey)), [128; 3]);
    let half = image::RgbaImage::from_pixel(3, 2, image::Rgba([255, 0, 0, 128]));
    assert_eq!(one(DynamicImage::ImageRgba8(half)), [240, 112, 112]);
    let nothing = image::ImageBuffer::from_pixel(3, 2, image::LumaA([9_u8, 0]));
    assert_eq!(one(DynamicImage::ImageLumaA8(nothing)), [224; 3]);

    // A palette of four colours, two bits a pixel, the second of them transparent.
    let mut file = Vec::new();
    {
        let mut encoder = png::Encoder::new(&mut file, 4, 1);
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_depth(png::BitDepth::Two);
        encoder.set_palette([RED, GREEN, BLUE, WHITE].concat());
        encoder.set_trns(vec![255, 0]);
        encoder.write_header().unwrap().write_image_data(&[0b00_01_10_11]).unwrap();
    }
    let photo = Photo::decode(&file).unwrap();
    assert_eq!([0, 1, 2, 3].map(|x| photo.at(x, 0)), [RED, [224; 3], BLUE, WHITE]);
}

/// A JPEG of one block of 8 × 8 pixels whose components each have one value: a quantiser of 8 makes the first
/// coefficient the value less 128.
fn flat_jpeg(values: &[u8], adobe: Option<u8>) -> Vec<u8> {
    fn segment(out: &mut Vec<u8>, kind: u8, data: &[u8]) {
        out.extend([0xFF, kind]);
        out.extend((data.len() as u16 + 2).to_be_bytes());
        out.extend(data);
    }
    let mut out = vec![0xFF, 0xD8];
    if let Some(transform) = adobe {
        segment(&mut out, 0xEE, &[b"Adobe\0d\0\0\0\0".as_slice(), &[transform]].concat());
    }
    segment(&mut out, 0xDB, &[[0].as_slice(), &[8; 64]].concat());
    let mut frame = vec![8, 0, 8, 0, 8, values.len() as u8];
    (0..values.len() as u8).for_each(|i| frame.extend([i + 1, 0x11, 0]));
    segment(&mut out, 0xC0, &frame);
    // First coefficients: twelve sizes, four bits each. Others: only the end of the block, one bit.
    let sizes: Vec<u8> = (0..12).collect();
    segment(&mut out, 0xC4, &[[0, 0, 0, 0, 12].as_slice(), &[0; 12], &sizes].concat());
    segment(&mut out, 0xC4, &[[0x10, 1].as_slice(), &[0; 15], &[0]].concat());
    let mut scan = vec![values.len() as u8];
    (0..values.len() as u8).for_each(|i| scan.extend([i + 1, 0]));
    scan.extend([0, 63, 0]);
    segment(&mut out, 0xDA, &scan);
    let mut bits = String::new();
    for value in values {
        let level = i32::from(*value) - 128;
        let size = 32 - level.unsigned_abs().leading_zeros() as usize;
        bits += &format!("{size:04b}");
        if size > 0 {
            let code = if level < 0 { level + (1 << size) - 1 } else { level };
            bits += &format!("{code:0size$b}");
        }
        bits.push('0');
    }
    while !bits.len().is_multiple_of(8) {
        bits.push('1');
    }
    for byte in bits.as_bytes().chunks(8) {
        let byte = u8::from_str_radix(std::str::from_utf8(byte).unwrap(), 2).unwrap();
        out.push(byte);
        if byte == 0xFF {
            out.push(0);
        }
    }
    out.extend([0xFF, 0xD9]);
    out
}

#[test]
fn a_cmyk_jpeg_shows_its_inks() {
    // Files of Adobe's programs hold inks the other way round: 255 is none.
    let photo = Photo::decode(&flat_jpeg(&[255, 60, 60, 255], Some(0))).unwrap();
    let [r, g, b] = photo.at(4, 4);
    assert!(r > 240 && g.abs_diff(60) < 8 && b.abs_diff(60) < 8, "{:?}", photo.at(4, 4));
    let grey = Photo::decode(&flat_jpeg(&[255, 255, 255, 100], Some(0))).unwrap().at(4, 4);
    assert!(grey.iter().all(|v| v.abs_diff(100) < 8), "{grey:?}");
    // The builder itself, on what every decoder knows.
    assert_eq!(Photo::decode(&flat_jpeg(&[90], None)).unwrap().at(3, 3), [90; 3]);
}

#[test]
fn what_is_cut_off_is_refused_wherever_it_is_cut() {
    for format in [ImageFormat::Jpeg, ImageFormat::Png, ImageFormat::WebP] {
        let noise = RgbImage::from_fn(40, 40, |x, y| image::Rgb([(x * y % 251) as u8, (x * 7 % 255) as u8, y as u8]));
        let file = encoded(&noise.into(), format);
        assert!(Photo::decode(&file).is_ok(), "{format:?}");
        for share in [0.2, 0.5, 0.8, 0.95] {
            let cut = (share * file.len() as f64) as usize;
            let fault = Photo::decode(&file[..cut]).unwrap_err().to_string();
            assert!(fault.contains("damaged"), "{format:?} cut at {share}: {fault}");
        }
    }
}

#[test]
fn no_single_byte_and_no_cut_makes_it_panic() {
    for format in [ImageFormat::Jpeg, ImageFormat::Png, ImageFormat::WebP] {
        let file = oriented(format, 6);
        for at in 0..file.len() {
            let _ = Photo::decode(&file[..at]);
            for change in [0x00, 0xFF, file[at] ^ 0x10] {
                let mut changed = file.clone();
                changed[at] = change;
                let _ = Photo::decode(&changed);
            }
        }
    }
}

#[test]
fn headers_that_promise_too_much_are_refused_before_anything_is_decoded() {
    let png_of = |side: u32, depth: u8, colour: u8| {
        let mut file = b"\x89PNG\r\n\x1a\n".to_vec();
        let mut header = [side.to_be_bytes(), side.to_be_bytes()].concat();
        header.extend([depth, colour, 0, 0, 0]);
        file.extend(png_chunk(b"IHDR", &header));
        file.extend(png_chunk(b"IDAT", &[0x78, 0x9C, 0x63, 0, 0, 0, 1, 0, 1]));
        file.extend(png_chunk(b"IEND", &[]));
        file
    };
    let mut jpeg = flat_jpeg(&[90, 128, 128], None);
    let frame = jpeg.windows(2).position(|w| w == [0xFF, 0xC0]).unwrap();
    let mut jpeg_of = |side: u16| {
        jpeg[frame + 5..frame + 7].copy_from_slice(&side.to_be_bytes());
        jpeg[frame + 7..frame + 9].copy_from_slice(&side.to_be_bytes());
        jpeg.clone()
    };
    let start = std::time::Instant::now();
    for (name, file, says) in [
        ("a PNG of 2³¹ − 1", png_of(0x7FFF_FFFF, 8, 2), "larger than"),
        ("a PNG of 12001", png_of(12_001, 8, 2), "larger than"),
        ("a PNG of 12000 at 16 bits RGBA", png_of(12_000, 16, 6), "too large"),
        ("a PNG of 9000 in 60 bytes", png_of(9_000, 8, 2), "promises"),
        ("a JPEG of 65500", jpeg_of(65_500), "larger than"),
        ("a JPEG of 11000 in 200 bytes", jpeg_of(11_000), "promises"),
    ] {
        let fault = Photo::decode(&file).unwrap_err().to_string();
        assert!(fault.contains(says), "{name}: {fault}");
    }
    // Clearing the pixels of one of them alone takes longer.
    assert!(start.elapsed().as_millis() < 200, "{:?}", start.elapsed());
}

#[test]
fn what_is_no_photo_is_named() {
    let says = |bytes: &[u8]| Photo::decode(bytes).unwrap_err().to_string();
    let heic = |brand: &[u8]| [b"\0\0\0\x18ftyp".as_slice(), brand, b"\0\0\0\0mif1heic"].concat();
    assert!(says(&heic(b"heic")).contains("HEIC"));
    assert!(says(&heic(b"mif1")).contains("HEIC"));
    assert!(says(&heic(b"avif")).contains("AVIF"));
    assert!(says(b"GIF89a\x01\0\x01\0").contains("GIF"));
    assert!(says(b"BM\x46\0\0\0\0\0\0\0").contains("BMP"));
    assert!(says(b"II*\0\x08\0\0\0").contains("TIFF"));
    assert!(says(b"%PDF-1.7").contains("PDF"));
    assert!(says(b"").contains("empty"));
    assert!(says("Liebe Grüße".as_bytes()).contains("not a photo"));
    let folder = tempfile::tempdir().unwrap();
    let fault = Photo::read(&folder.path().join("missing.jpg")).unwrap_err().to_string();
    assert!(fault.contains("missing.jpg"), "{fault}");
}

#[test]
fn a_clean_png_holds_the_pixels_and_nothing_that_the_file_said_beside_them() {
    let photo = Photo::decode(&oriented(ImageFormat::Jpeg, 6)).unwrap();
    let file = to_clean_png(&photo).unwrap();
    assert_eq!(file, to_clean_png(&photo).unwrap());
    assert_eq!(Photo::decode(&file).unwrap(), photo);
    let mut kinds = Vec::new();
    let mut at = 8;
    while at < file.len() {
        let length = u32::from_be_bytes(file[at..at + 4].try_into().unwrap()) as usize;
        kinds.push(String::from_utf8(file[at + 4..at + 8].to_vec()).unwrap());
        at += length + 12;
    }
    kinds.dedup();
    assert_eq!(kinds, ["IHDR", "IDAT", "IEND"]);
}

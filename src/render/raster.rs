//! Pictures of pixels inside drawings: painted with as many pixels as can be seen, or carried whole as a PNG.

use super::canvas::Pixel;
use crate::drawing::{Image, Picture, Raster};
use crate::geometry::{Affine, Point};

/// Weights between pixels are told in so many parts.
const PARTS: f64 = 256.0;

/// The pixels of a raster, as many as can be seen, to be looked up from pixels of the picture.
pub(super) struct Sampler {
    pixels: Image<Pixel>,
    /// From the picture to the middles of `pixels`.
    back: Affine,
}

impl Sampler {
    /// Where the raster is drawn at half its size or smaller, whole blocks of its pixels are averaged first, so that
    /// nothing flickers or is skipped. `None` where it has no area.
    pub(super) fn new(raster: &Raster, place: Affine) -> Option<Self> {
        let place = place * raster.place();
        if !place.is_finite() || place.determinant().abs() < 1e-12 {
            return None;
        }
        let [a, b, c, d, _, _] = place.as_coeffs();
        let blocks = |scale: f64, side: usize| ((1.0 / scale.max(1e-6)) as usize).clamp(1, side);
        let picture = raster.picture();
        let (across, down) = (blocks(a.hypot(b), picture.width()), blocks(c.hypot(d), picture.height()));
        let pixels = averaged(picture, across, down);
        // Blocks at the border may be cut, but all have one size in the plane.
        let back = (place * Affine::scale_non_uniform(across as f64, down as f64)).inverse();
        Some(Self { pixels, back: Affine::translate((-0.5, -0.5)) * back })
    }

    /// What is seen at the middle of a pixel of the picture: between the four pixels round it, in proportion; the
    /// border goes on outward.
    pub(super) fn at(&self, x: i32, y: i32) -> Pixel {
        let p = self.back * Point::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
        let split = |v: f64, side: usize| {
            let v = (v.clamp(0.0, (side - 1) as f64) * PARTS + 0.5).floor() as usize;
            let (whole, part) = (v / PARTS as usize, v % PARTS as usize);
            (whole, (whole + 1).min(side - 1), part as u32)
        };
        let ((x0, x1, right), (y0, y1, below)) = (split(p.x, self.pixels.width()), split(p.y, self.pixels.height()));
        let at = |x: usize, y: usize| self.pixels[(x, y)].to_le_bytes();
        let [a, b, c, d] = [at(x0, y0), at(x1, y0), at(x0, y1), at(x1, y1)];
        let (left, above) = (256 - right, 256 - below);
        u32::from_le_bytes(std::array::from_fn(|k| {
            let [a, b, c, d] = [a, b, c, d].map(|p| u32::from(p[k]));
            ((a * left * above + b * right * above + c * left * below + d * right * below + (1 << 15)) >> 16) as u8
        }))
    }
}

/// The picture with `across` × `down` of its pixels averaged to one, premultiplied.
fn averaged(picture: &Picture, across: usize, down: usize) -> Image<Pixel> {
    let (width, height) = (picture.width().div_ceil(across), picture.height().div_ceil(down));
    let mut pixels = Vec::with_capacity(width * height);
    for rows in picture.pixels().chunks(picture.width() * down) {
        let mut sums = vec![[0_u64; 4]; width];
        let rows_here = rows.len() / picture.width();
        for row in rows.chunks_exact(picture.width()) {
            for (sum, block) in sums.iter_mut().zip(row.chunks(across)) {
                for p in block {
                    let alpha = u64::from(p[3]);
                    (0..3).for_each(|k| sum[k] += u64::from(p[k]) * alpha);
                    sum[3] += alpha;
                }
            }
        }
        for (x, sum) in sums.iter().enumerate() {
            let count = (rows_here * across.min(picture.width() - x * across)) as u64;
            let alpha = ((sum[3] + count / 2) / count).min(255) as u8;
            let channel = |k: usize| (((2 * sum[k] + count * 255) / (2 * count * 255)).min(255) as u8).min(alpha);
            pixels.push(u32::from_le_bytes([channel(0), channel(1), channel(2), alpha]));
        }
    }
    Image::new(width, height, pixels)
}

/// The raster as a `data:` address of a PNG; RGB where it is opaque, which is a third smaller.
pub(super) fn data_uri(raster: &Raster) -> String {
    let picture = raster.picture();
    let opaque = picture.pixels().iter().all(|p| p[3] == 255);
    let rgb: Vec<u8>;
    let (kind, data) = if opaque {
        rgb = picture.pixels().iter().flat_map(|p| [p[0], p[1], p[2]]).collect();
        (png::ColorType::Rgb, &rgb[..])
    } else {
        (png::ColorType::Rgba, picture.pixels().as_flattened())
    };
    let mut bytes = Vec::with_capacity(64 << 10);
    let encoded = (|| {
        let size = |v: usize| u32::try_from(v).unwrap_or(u32::MAX);
        let mut encoder = png::Encoder::new(&mut bytes, size(picture.width()), size(picture.height()));
        encoder.set_color(kind);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::Balanced);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(data)?;
        writer.finish()
    })();
    // Only a picture of more than four thousand million pixels a side is refused: it then shows as missing.
    if encoded.is_err() {
        bytes.clear();
    }
    format!("data:image/png;base64,{}", base64(&bytes))
}

/// Bytes in the letters of RFC 4648.
fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for three in bytes.chunks(3) {
        let word = three.iter().enumerate().fold(0_u32, |w, (i, b)| w | u32::from(*b) << (16 - 8 * i));
        for i in 0..4 {
            let letter = LETTERS[(word >> (18 - 6 * i) & 63) as usize];
            text.push(if i <= three.len() { char::from(letter) } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::{Colour, Drawing, Item, Layer};
    use crate::geometry::Rect;
    use crate::render::{Painter, to_svg};

    fn shown(raster: Raster, side: f64) -> Drawing {
        Drawing {
            view: Rect::new(0.0, 0.0, side, side),
            title: String::new(),
            description: String::new(),
            background: Some(Colour::WHITE),
            layers: vec![Layer { name: "static".into(), items: vec![Item::Picture(raster)] }],
        }
    }

    fn stripes(side: usize) -> Raster {
        let pixel = |i: usize| if (i % side).is_multiple_of(2) { [0, 0, 0, 255] } else { [255, 255, 255, 255] };
        Raster::new("photo", Picture::new(side, side, (0..side * side).map(pixel).collect()))
    }

    #[test]
    fn base64_is_that_of_the_standard() {
        let of = |text: &str| base64(text.as_bytes());
        assert_eq!(["", "f", "fo", "foo", "foobar"].map(of), ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYmFy"]);
    }

    #[test]
    fn a_raster_at_its_own_size_keeps_every_pixel_and_reduced_it_is_their_mean() {
        let at = |painter: &mut Painter, side: f64| {
            painter.paint(&shown(stripes(32).placed_in(Rect::new(0.0, 0.0, side, side)), side))
        };
        let whole = at(&mut Painter::new(32, 32).unwrap(), 32.0);
        assert_eq!(&whole, stripes(32).picture());
        for side in [16_u32, 8, 4] {
            let small = at(&mut Painter::new(side, side).unwrap(), f64::from(side));
            let wrong = small.pixels().iter().filter(|p| p[0].abs_diff(128) > 1 || p[3] != 255).count();
            assert_eq!(wrong, 0, "{side}");
        }
    }

    #[test]
    fn what_is_transparent_does_not_colour_what_is_averaged() {
        let pixel = |i: usize| if i.is_multiple_of(2) { [255, 0, 0, 255] } else { [0, 255, 0, 0] };
        let small = averaged(&Picture::new(8, 8, (0..64).map(pixel).collect()), 2, 2);
        let mean = |p: &Pixel| matches!(p.to_le_bytes(), [r, 0, _, a] if r.abs_diff(128) <= 1 && r == a);
        assert!(small.pixels().iter().all(mean));
    }

    #[test]
    fn a_turned_raster_is_painted_where_its_corners_are() {
        let red = Raster::new("", Picture::filled(4, 4, [255, 0, 0, 255]));
        let place = Affine::translate((20.0, 4.0)) * Affine::rotate(std::f64::consts::FRAC_PI_2) * Affine::scale(2.0);
        let picture = Painter::new(32, 32).unwrap().paint(&shown(red.placed(place), 32.0));
        assert_eq!(picture[(15, 8)], [255, 0, 0, 255]);
        assert_eq!(picture[(25, 8)], [255; 4]);
    }

    #[test]
    fn an_svg_carries_the_pixels_whole() {
        let raster = stripes(6).placed_in(Rect::new(10.0, 10.0, 22.0, 22.0));
        let svg = to_svg(&shown(raster.clone(), 32.0), 32, 32);
        let (_, rest) = svg.split_once("href=\"data:image/png;base64,").unwrap();
        let text = rest.split('"').next().unwrap();
        let letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        let bits: Vec<u32> = text.chars().filter_map(|c| letters.find(c)).map(|n| n as u32).collect();
        let bytes: Vec<u8> = bits
            .chunks(4)
            .flat_map(|four| {
                let word = four.iter().enumerate().fold(0, |w, (i, b)| w | b << (18 - 6 * i));
                word.to_be_bytes()[1..four.len()].to_vec()
            })
            .collect();
        let decoded = image::load_from_memory(&bytes).unwrap().into_rgba8();
        assert_eq!(decoded.as_raw(), raster.picture().pixels().as_flattened());
        assert!(svg.contains("transform=\"matrix(2 0 0 2 10 10)\""));
    }

    #[test]
    fn another_pixel_or_another_place_is_another_fingerprint() {
        let first = shown(stripes(6), 32.0);
        let mut other = stripes(6).picture().clone();
        other[(1, 3)][1] ^= 1;
        let print = first.fingerprint();
        assert_eq!(print, shown(stripes(6), 32.0).fingerprint());
        assert_ne!(print, shown(Raster::new("photo", other), 32.0).fingerprint());
        assert_ne!(print, shown(stripes(6).placed(Affine::translate((0.1, 0.0))), 32.0).fingerprint());
    }
}

//! From light to a picture: samples gathered to pixels, a photograph's tone and grain, and the PNG.

use std::io;
use std::path::Path;

use rayon::prelude::*;

use crate::noise::fraction;
use crate::vector::{V, mix, smooth};
use crate::view::Canvas;

/// Width of the lens's blur, in pixels.
const BLUR: f32 = 0.52;

/// Deviation of the sensor's noise, in 1/255, in a picture of 600 pixels; a smaller picture averages it away.
const NOISE: f32 = 1.3;

/// sRGB bytes, row by row from the top, three to a pixel.
pub fn develop(canvas: &Canvas, seed: u64) -> Vec<u8> {
    let (side, fine, wide) = (canvas.side, Canvas::FINE, canvas.wide());
    let grain = NOISE * (side as f32 / 600.0).min(1.0);
    let sigma = BLUR * fine as f32;
    let reach = (sigma * 2.6).ceil() as i32;
    let kernel: Vec<f32> = (-reach..reach).map(|i| (-0.5 * ((i as f32 + 0.5) / sigma).powi(2)).exp()).collect();
    let total: f32 = kernel.iter().sum();
    let gather = |from: &dyn Fn(usize) -> V, n: usize, centre: usize| {
        let mut sum = V::ZERO;
        for (k, w) in kernel.iter().enumerate() {
            let at = (centre as i32 + fine as i32 / 2 + k as i32 - reach).clamp(0, n as i32 - 1);
            // Lamps in the eyes are brighter than film: they may not bleed.
            let c = from(at as usize);
            sum = sum + V(c.0.min(1.6), c.1.min(1.6), c.2.min(1.6)) * (w / total);
        }
        sum
    };
    let across: Vec<V> = (0..wide)
        .into_par_iter()
        .flat_map_iter(|row| {
            (0..side).map(move |x| gather(&|c| canvas.colour[row * wide + c], wide, x * fine)).collect::<Vec<_>>()
        })
        .collect();
    (0..side)
        .into_par_iter()
        .flat_map_iter(|y| {
            (0..side)
                .flat_map(|x| {
                    let c = gather(&|r| across[r * side + x], wide, y * fine);
                    let n = noise(x, y, seed);
                    let own = |k: u64| grain * (n * 0.8 + 0.5 * noise(x, y, seed ^ (k + 1) << 40));
                    [tone(c.0, own(0)), tone(c.1, own(1)), tone(c.2, own(2))]
                })
                .collect::<Vec<_>>()
        })
        .collect()
}

/// How a head is held in front of the camera: a turn about a place low in the neck, then a shift. What is below moves less and
/// less.
#[derive(Clone, Copy)]
pub struct Held {
    /// In pixels of the canvas's picture.
    pub pivot: (f32, f32),
    /// Down to where all moves alike, and where only a fourth of it is left, in pixels.
    pub fades: (f32, f32),
    /// In radians, clockwise as seen.
    pub roll: f32,
    /// In pixels.
    pub shift: (f32, f32),
}

impl Held {
    /// Where a place of the head goes, in pixels of the canvas's picture.
    pub fn moved(&self, x: f32, y: f32) -> (f32, f32) {
        let (s, c) = self.roll.sin_cos();
        let (dx, dy) = (x - self.pivot.0, y - self.pivot.1);
        (self.pivot.0 + c * dx - s * dy + self.shift.0, self.pivot.1 + s * dx + c * dy + self.shift.1)
    }

    /// What is seen at a place.
    fn seen(&self, x: f32, y: f32) -> (f32, f32) {
        let (s, c) = self.roll.sin_cos();
        let (dx, dy) = (x - self.shift.0 - self.pivot.0, y - self.shift.1 - self.pivot.1);
        let (u, v) = (self.pivot.0 + c * dx + s * dy, self.pivot.1 - s * dx + c * dy);
        let share = mix(1.0, 0.25, smooth(self.fades.0, self.fades.1, v));
        (mix(x, u, share), mix(y, v, share))
    }
}

/// A square picture of `side` pixels from the middle of the canvas's, its figure held as is said; sRGB bytes.
pub fn develop_held(canvas: &Canvas, side: usize, held: &Held, seed: u64) -> Vec<u8> {
    let (fine, wide) = (Canvas::FINE as f32, canvas.wide());
    let margin = (canvas.side - side) as f32 * 0.5;
    let sigma = BLUR * fine;
    let reach = (sigma * 2.4).ceil() as i32;
    (0..side)
        .into_par_iter()
        .flat_map_iter(|row| {
            (0..side)
                .flat_map(|column| {
                    let at = held.seen(column as f32 + 0.5 + margin, row as f32 + 0.5 + margin);
                    let (u, v) = (at.0 * fine - 0.5, at.1 * fine - 0.5);
                    let (iu, iv) = (u.round() as i32, v.round() as i32);
                    let weights = |from: i32, at: f32| -> [f32; 16] {
                        std::array::from_fn(|k| {
                            (-0.5 * ((from - reach + k as i32) as f32 - at).powi(2) / sigma / sigma).exp()
                        })
                    };
                    let (wx, wy) = (weights(iu, u), weights(iv, v));
                    let (mut sum, mut total) = (V::ZERO, 0.0);
                    for j in 0..=2 * reach {
                        let y = (iv - reach + j).clamp(0, wide as i32 - 1) as usize * wide;
                        for i in 0..=2 * reach {
                            let c = canvas.colour[y + (iu - reach + i).clamp(0, wide as i32 - 1) as usize];
                            let w = wx[i as usize] * wy[j as usize];
                            sum = sum + V(c.0.min(1.6), c.1.min(1.6), c.2.min(1.6)) * w;
                            total += w;
                        }
                    }
                    let c = sum * (1.0 / total);
                    let n = 0.4 * noise(column, row, seed);
                    [tone(c.0, n), tone(c.1, n), tone(c.2, n)]
                })
                .collect::<Vec<_>>()
        })
        .collect()
}

/// A number of deviation about one for a pixel.
fn noise(x: usize, y: usize, seed: u64) -> f32 {
    let n = seed.wrapping_mul(0x9e37) ^ ((y as u64) << 20 | x as u64) << 2;
    (fraction(n) + fraction(n + 1) + fraction(n + 2) - 1.5) * 2.0
}

/// Linear light to an sRGB byte, through a gentle S with a soft shoulder.
fn tone(light: f32, noise: f32) -> u8 {
    let light = light.max(0.0);
    let light = if light > 0.6 { 0.6 + 0.4 * (1.0 - (-(light - 0.6) / 0.4).exp()) } else { light };
    let s = if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 };
    let s = mix(s, s * s * (3.0 - 2.0 * s), 0.24);
    // Noise is strongest in the middle tones once the eye's curve is applied.
    let s = s * 255.0 + noise * (0.55 + s * (1.0 - s) * 1.8);
    (s + 0.5).clamp(0.0, 255.0) as u8
}

/// Writes sRGB bytes as a PNG without any metadata, as small as the encoder can.
pub fn write(path: &Path, side: usize, pixels: &[u8]) -> io::Result<()> {
    let file = io::BufWriter::new(std::fs::File::create(path)?);
    let mut encoder = png::Encoder::new(file, side as u32, side as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::High);
    encoder.set_filter(png::Filter::Adaptive);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels)?;
    writer.finish()?;
    Ok(())
}

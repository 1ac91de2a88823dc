//! Square crops of a photo, turned upright and resampled, as the nets take them.

use crate::drawing::Image;
use crate::geometry::Point;
use crate::photo::Photo;

/// Levels stop where the shorter side is at most so many pixels.
const SMALLEST_SIDE: usize = 160;

/// A photo and its halves, quarters and so on, for crops without aliasing.
#[derive(Debug, Clone)]
pub struct Levels<'a> {
    photo: &'a Photo,
    halves: Vec<Photo>,
}

/// A square of a photo.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Square {
    /// Its centre, in pixels of the photo.
    pub centre: Point,
    /// Its side, in pixels of the photo.
    pub side: f64,
    /// The angle of its upper side, in radians, clockwise as seen.
    pub turn: f64,
}

/// Colours of what a crop shows beyond the photo.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Beyond {
    /// The lowest value of each channel.
    Black,
    /// The nearest pixel of the photo.
    Nearest,
}

impl<'a> Levels<'a> {
    /// The levels of a photo.
    #[must_use]
    pub fn of(photo: &'a Photo) -> Self {
        let mut halves: Vec<Photo> = Vec::new();
        while let last = halves.last().unwrap_or(photo)
            && last.width().min(last.height()) > SMALLEST_SIDE
        {
            halves.push(halve(last));
        }
        Self { photo, halves }
    }

    /// Width and height of the photo, in pixels.
    #[must_use]
    pub fn size(&self) -> [f64; 2] {
        [self.photo.width() as f64, self.photo.height() as f64]
    }

    /// A square as `side` × `side` pixels, row by row, red, green and blue from `low` to `high`, interpolated bilinearly on
    /// the level whose pixels are at most as large as the crop's.
    pub(super) fn crop(&self, square: &Square, side: usize, [low, high]: [f32; 2], beyond: Beyond) -> Vec<f32> {
        let step = square.side / side as f64;
        let mut number = 0;
        while step >= f64::from(2 << number) && number < self.halves.len() {
            number += 1;
        }
        let level = if number == 0 { self.photo } else { &self.halves[number - 1] };
        let scale = 1.0 / f64::from(1 << number);
        let (sin, cos) = libm::sincos(square.turn);
        let unit = (high - low) / 255.0;
        let (right, bottom) = ((level.width() - 1) as f64, (level.height() - 1) as f64);
        let mut out = Vec::with_capacity(3 * side * side);
        for y in 0..side {
            for x in 0..side {
                let offset = |i: usize| (i as f64 + 0.5 - side as f64 / 2.0) * step;
                let (u, v) = (offset(x), offset(y));
                // Centres of pixels are whole numbers in the level, halves in the photo.
                let x = (square.centre.x + 0.5 + cos * u - sin * v) * scale - 0.5;
                let y = (square.centre.y + 0.5 + sin * u + cos * v) * scale - 0.5;
                let is_inside = (-0.5..=right + 0.5).contains(&x) && (-0.5..=bottom + 0.5).contains(&y);
                if beyond == Beyond::Black && !is_inside {
                    out.extend([low; 3]);
                    continue;
                }
                let ([a, b, c, d], [across, down]) = level.around(x, y);
                let (across, down) = (across as f32, down as f32);
                out.extend([0, 1, 2].map(|channel| {
                    let value = |pixel: &[u8; 3]| f32::from(pixel[channel]);
                    let upper = (1.0 - across) * value(a) + across * value(b);
                    let lower = (1.0 - across) * value(c) + across * value(d);
                    low + unit * ((1.0 - down) * upper + down * lower)
                }));
            }
        }
        out
    }
}

impl Square {
    /// The point of the photo at `x`, `y` of the crop, which counts from -0.5 to 0.5 from its centre.
    pub(super) fn point(&self, x: f64, y: f64) -> Point {
        let (sin, cos) = libm::sincos(self.turn);
        let (u, v) = (x * self.side, y * self.side);
        Point::new(self.centre.x + cos * u - sin * v, self.centre.y + sin * u + cos * v)
    }
}

/// A photo of half the width and height: each pixel is the mean of four, rounded.
fn halve(photo: &Photo) -> Photo {
    let (width, height) = (photo.width() / 2, photo.height() / 2);
    let mut pixels = Vec::with_capacity(width * height);
    for y in 0..height {
        let (above, below) = (photo.row(2 * y), photo.row(2 * y + 1));
        for (above, below) in above.chunks_exact(2).zip(below.chunks_exact(2)) {
            pixels.push(std::array::from_fn(|channel| {
                let sum: u16 = above.iter().chain(below).map(|pixel| u16::from(pixel[channel])).sum();
                ((sum + 2) / 4) as u8
            }));
        }
    }
    Image::new(width, height, pixels)
}

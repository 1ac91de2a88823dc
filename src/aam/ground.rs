//! The part of a picture that a fit looks at: halved until its pixels are about as large as the model's, smoothed, and
//! laid out so that four neighbours are read at once.

use crate::geometry::Rect;
use crate::photo::{Grey, halve};

/// A part of a picture. A place in it is counted in its own pixels, whose centres are whole numbers.
#[derive(Debug, Clone, Default)]
pub(super) struct Ground {
    /// The place of its first pixel in the picture.
    corner: [f32; 2],
    /// Pixels of the picture in one of its own.
    step: f32,
    width: usize,
    height: usize,
    /// Of each channel a pixel, its right neighbour, the one below, and that one's right neighbour, in the bytes from
    /// low to high.
    fours: Vec<Vec<u32>>,
    pixels: Vec<u8>,
    other: Vec<u8>,
    sums: Vec<u16>,
}

/// What of a picture is compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Channels {
    /// The luma.
    Luma,
    /// How luma changes along x and along y, over how much it changes plus the mean of that (Cootes and Taylor 2001):
    /// where edges run, hardly how strong they are. Of faces and light that are new to a model this says more.
    Edges,
}

impl Channels {
    /// How many there are.
    pub(crate) const fn count(self) -> usize {
        match self {
            Self::Luma => 1,
            Self::Edges => 2,
        }
    }
}

/// Of so many pixels at most; a place is then exact as a float.
const MOST: usize = 1 << 22;

impl Ground {
    /// Takes the part of a picture within `region`, halved so often, then smoothed so often by 1, 2, 1. What lies
    /// outside the picture is not part of it, and whatever does not overlap it is its nearest corner.
    pub(crate) fn lay(&mut self, grey: &Grey, region: Rect, halvings: u32, smooth: u32, channels: Channels) {
        let side = |low: f64, high: f64, size: usize| {
            let low = low.floor().clamp(0.0, (size - 1) as f64) as usize;
            let high = high.ceil().clamp(low as f64, (size - 1) as f64) as usize;
            (low, high + 1 - low)
        };
        let (x0, mut width) = side(region.x0, region.x1, grey.width());
        let (y0, mut height) = side(region.y0, region.y1, grey.height());
        let mut left = halvings;
        while left > 0 && width.min(height) < 8 {
            left = 0;
        }
        // Whole blocks only, so that every pixel is the mean of as many.
        self.pixels.clear();
        let mut step = 1;
        if left == 0 {
            for y in y0..y0 + height {
                self.pixels.extend_from_slice(&grey.row(y)[x0..x0 + width]);
            }
        } else {
            (width, height) = (width / 2, height / 2);
            for y in 0..height {
                let [top, below] = [0, 1].map(|i| &grey.row(y0 + 2 * y + i)[x0..x0 + 2 * width]);
                halve(top, below, &mut self.pixels);
            }
            (step, left) = (2, left - 1);
        }
        while (left > 0 || width * height > MOST) && width.min(height) >= 4 {
            let from = std::mem::take(&mut self.pixels);
            self.pixels = std::mem::take(&mut self.other);
            self.pixels.clear();
            let (w, h) = (width / 2, height / 2);
            for y in 0..h {
                let top = &from[2 * y * width..2 * y * width + 2 * w];
                let below = &from[(2 * y + 1) * width..(2 * y + 1) * width + 2 * w];
                halve(top, below, &mut self.pixels);
            }
            self.other = from;
            (width, height, step, left) = (w, h, step * 2, left.saturating_sub(1));
        }
        (self.width, self.height, self.step) = (width, height, step as f32);
        let half = (self.step - 1.0) / 2.0;
        self.corner = [x0 as f32 + half, y0 as f32 + half];
        for _ in 0..smooth {
            self.smooth();
        }
        self.fours.resize(channels.count(), Vec::new());
        match channels {
            Channels::Luma => self.pack(0),
            Channels::Edges => {
                let luma = self.pixels.clone();
                let (slopes, mean) = self.slopes(&luma);
                for channel in 0..2 {
                    self.pixels.clear();
                    self.pixels.extend(slopes.iter().map(|[x, y]| {
                        let along = if channel == 0 { x } else { y };
                        let strength = (x * x + y * y).sqrt();
                        (128.0 + 120.0 * along / (strength + mean)) as u8
                    }));
                    self.smooth();
                    self.pack(channel);
                }
            }
        }
    }

    /// How a plane changes along x and y, and the mean of how much, not 0.
    fn slopes(&self, luma: &[u8]) -> (Vec<[f32; 2]>, f32) {
        let (w, h) = (self.width, self.height);
        let at = |x: usize, y: usize| f32::from(luma[y * w + x]);
        let slopes: Vec<[f32; 2]> = (0..w * h)
            .map(|i| {
                let (x, y) = (i % w, i / w);
                [
                    at((x + 1).min(w - 1), y) - at(x.saturating_sub(1), y),
                    at(x, (y + 1).min(h - 1)) - at(x, y.saturating_sub(1)),
                ]
            })
            .collect();
        let sum: f64 = slopes.iter().map(|[x, y]| f64::from((x * x + y * y).sqrt())).sum();
        (slopes, ((sum / (w * h) as f64) as f32).max(0.5))
    }

    /// 1, 2, 1 along both axes; the border goes on beyond itself.
    fn smooth(&mut self) {
        let (w, h) = (self.width, self.height);
        if w < 2 || h < 2 {
            return;
        }
        self.other.resize(w * h, 0);
        self.sums.resize(w, 0);
        for y in 0..h {
            let rows = [y.saturating_sub(1), y, (y + 1).min(h - 1)].map(|y| &self.pixels[y * w..(y + 1) * w]);
            for (((s, a), b), c) in self.sums.iter_mut().zip(rows[0]).zip(rows[1]).zip(rows[2]) {
                *s = u16::from(*a) + 2 * u16::from(*b) + u16::from(*c);
            }
            let out = &mut self.other[y * w..(y + 1) * w];
            let s = &self.sums;
            out[0] = ((3 * s[0] + s[1] + 8) >> 4) as u8;
            out[w - 1] = ((3 * s[w - 1] + s[w - 2] + 8) >> 4) as u8;
            for (((o, a), b), c) in out[1..w - 1].iter_mut().zip(&s[..w - 2]).zip(&s[1..w - 1]).zip(&s[2..]) {
                *o = ((a + 2 * b + c + 8) >> 4) as u8;
            }
        }
        std::mem::swap(&mut self.pixels, &mut self.other);
    }

    fn pack(&mut self, channel: usize) {
        let (w, h) = (self.width, self.height);
        let fours = &mut self.fours[channel];
        fours.resize(w * h, 0);
        for y in 0..h {
            let below = (y + 1).min(h - 1);
            let (top, below) = (&self.pixels[y * w..(y + 1) * w], &self.pixels[below * w..(below + 1) * w]);
            let out = &mut fours[y * w..(y + 1) * w];
            let four =
                |a: u8, b: u8, c: u8, d: u8| u32::from(a) | u32::from(b) << 8 | u32::from(c) << 16 | u32::from(d) << 24;
            out[w - 1] = four(top[w - 1], top[w - 1], below[w - 1], below[w - 1]);
            for ((((o, a), b), c), d) in
                out[..w - 1].iter_mut().zip(&top[..w - 1]).zip(&top[1..]).zip(&below[..w - 1]).zip(&below[1..])
            {
                *o = four(*a, *b, *c, *d);
            }
        }
    }

    /// Pixels in a row, as a float, and the largest place along x and y.
    pub(crate) fn size(&self) -> (f32, f32, f32) {
        (self.width as f32, (self.width - 1) as f32, (self.height - 1) as f32)
    }

    /// The packed neighbours of each channel, row by row.
    pub(crate) fn fours(&self) -> impl Iterator<Item = &[u32]> {
        self.fours.iter().map(|f| &f[..])
    }

    /// From places in the picture to its own.
    pub(crate) fn enter(&self, xs: &mut [f32], ys: &mut [f32]) {
        let [cx, cy] = self.corner;
        xs.iter_mut().for_each(|x| *x = (*x - cx) / self.step);
        ys.iter_mut().for_each(|y| *y = (*y - cy) / self.step);
    }

    /// From its own places to the picture's.
    pub(crate) fn leave(&self, xs: &mut [f32], ys: &mut [f32]) {
        let [cx, cy] = self.corner;
        xs.iter_mut().for_each(|x| *x = *x * self.step + cx);
        ys.iter_mut().for_each(|y| *y = *y * self.step + cy);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slope_stays_a_slope_at_every_size() {
        let grey = Grey::new(64, 48, (0..64 * 48).map(|i| (2 * (i % 64) + i / 64) as u8).collect());
        for (halvings, smooth) in [(0, 0), (0, 2), (1, 1), (2, 0)] {
            let mut ground = Ground::default();
            ground.lay(&grey, Rect::new(3.0, 5.0, 60.0, 46.0), halvings, smooth, Channels::Luma);
            let (mut xs, mut ys) = ([30.0_f32], [20.0_f32]);
            ground.enter(&mut xs, &mut ys);
            let (x, y) = (xs[0] as usize, ys[0] as usize);
            let w = ground.size().0 as usize;
            let four = ground.fours[0][y * w + x].to_le_bytes().map(f32::from);
            let (fx, fy) = (xs[0].fract(), ys[0].fract());
            let v = (four[0] * (1.0 - fx) + four[1] * fx) * (1.0 - fy) + (four[2] * (1.0 - fx) + four[3] * fx) * fy;
            assert!((v - 80.0).abs() <= 1.0, "{halvings} {smooth}: {v}");
            ground.leave(&mut xs, &mut ys);
            assert!((xs[0] - 30.0).abs() < 1e-4 && (ys[0] - 20.0).abs() < 1e-4);
        }
    }

    #[test]
    fn a_region_outside_the_picture_and_a_tiny_picture_are_borne() {
        let grey = Grey::new(1, 1, vec![7]);
        let mut ground = Ground::default();
        for region in [Rect::new(-50.0, -50.0, -10.0, -10.0), Rect::new(1e9, 1e9, 1e9, 1e9), Rect::ZERO] {
            ground.lay(&grey, region, 3, 2, Channels::Edges);
            assert_eq!(ground.fours[1].len(), 1);
        }
    }
}

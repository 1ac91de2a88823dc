//! One channel of a picture as numbers.

use super::Photo;
use crate::drawing::Image;

/// One number a pixel.
pub type Plane = Image<f32>;

impl Plane {
    /// The luma of a photo (Rec. 601 weights on the sRGB values), 0 to 255.
    #[must_use]
    pub fn luma(photo: &Photo) -> Self {
        photo.map(|p| 0.299 * f32::from(p[0]) + 0.587 * f32::from(p[1]) + 0.114 * f32::from(p[2]))
    }

    /// The value between pixels, bilinear; beyond the border that of the nearest pixel.
    #[must_use]
    pub fn sample(&self, x: f64, y: f64) -> f32 {
        let ([a, b, c, d], [fx, fy]) = self.around(x, y);
        let (fx, fy) = (fx as f32, fy as f32);
        let (top, bottom) = (a + (b - a) * fx, c + (d - c) * fx);
        top + (bottom - top) * fy
    }

    /// The plane blurred by a Gaussian of `sigma` pixels, cut at three sigmas; the border's values go on beyond it.
    #[must_use]
    pub fn blurred(&self, sigma: f64) -> Self {
        if sigma <= 0.0 {
            return self.clone();
        }
        let reach = (3.0 * sigma).ceil() as usize;
        let mut kernel: Vec<f32> =
            (0..=2 * reach).map(|i| (-0.5 * ((i as f64 - reach as f64) / sigma).powi(2)).exp() as f32).collect();
        let sum: f32 = kernel.iter().sum();
        kernel.iter_mut().for_each(|k| *k /= sum);
        let (width, height) = (self.width(), self.height());
        let mut across = Vec::with_capacity(width * height);
        let mut line = Vec::new();
        for row in self.rows() {
            line.clear();
            line.extend(std::iter::repeat_n(row[0], reach));
            line.extend_from_slice(row);
            line.extend(std::iter::repeat_n(row[width - 1], reach));
            across.extend(line.windows(kernel.len()).map(|w| w.iter().zip(&kernel).map(|(v, k)| v * k).sum::<f32>()));
        }
        let across = Self::new(width, height, across);
        let mut blurred = Self::filled(width, height, 0.0);
        for y in 0..height {
            let out = blurred.row_mut(y);
            for (i, k) in kernel.iter().enumerate() {
                let from = (y + i).saturating_sub(reach).min(height - 1);
                out.iter_mut().zip(across.row(from)).for_each(|(o, v)| *o += k * v);
            }
        }
        blurred
    }

    /// The means over squares of `2 radius + 1` pixels, cut at the border.
    #[must_use]
    pub(crate) fn boxed(&self, radius: usize) -> Self {
        let (width, height) = (self.width(), self.height());
        let mut across = Self::filled(width, height, 0.0);
        for (y, row) in self.rows().enumerate() {
            let mut sum: f32 = row.iter().take(radius).sum();
            for (x, o) in across.row_mut(y).iter_mut().enumerate() {
                if x + radius < width {
                    sum += row[x + radius];
                }
                if x > radius {
                    sum -= row[x - radius - 1];
                }
                let count = (x + radius + 1).min(width) - x.saturating_sub(radius);
                *o = sum / count as f32;
            }
        }
        let mut out = Self::filled(width, height, 0.0);
        let mut sums = vec![0.0_f32; width];
        let add = |sums: &mut [f32], y: usize, sign: f32| {
            sums.iter_mut().zip(across.row(y)).for_each(|(s, v)| *s += sign * v);
        };
        (0..radius.min(height)).for_each(|y| add(&mut sums, y, 1.0));
        for y in 0..height {
            if y + radius < height {
                add(&mut sums, y + radius, 1.0);
            }
            if y > radius {
                add(&mut sums, y - radius - 1, -1.0);
            }
            let share = 1.0 / ((y + radius + 1).min(height) - y.saturating_sub(radius)) as f32;
            out.row_mut(y).iter_mut().zip(&sums).for_each(|(o, s)| *o = s * share);
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_mean_keeps_constants_and_sums_what_it_covers() {
        assert!(Plane::filled(230, 290, 0.25).boxed(6).pixels().iter().all(|v| (v - 0.25).abs() < 1e-4));
        assert_eq!(Plane::filled(2, 1, 0.5).boxed(6), Plane::filled(2, 1, 0.5));
        let mut one = Plane::filled(230, 290, 0.0);
        one[(100, 100)] = 1.0;
        let mean = one.boxed(2);
        assert!((mean[(98, 102)] - 0.04).abs() < 1e-6 && mean[(98, 103)].abs() < 1e-6);
    }
}

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
}

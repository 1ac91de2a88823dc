//! One channel of a picture as numbers.

use super::Photo;

/// One number a pixel, row by row; pixel centres are whole numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Plane {
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// The values, row by row.
    pub values: Vec<f32>,
}

impl Plane {
    /// A plane of one value.
    #[must_use]
    pub fn filled(width: usize, height: usize, value: f32) -> Self {
        Self { width, height, values: vec![value; width * height] }
    }

    /// The luma of a photo (Rec. 601 weights on the sRGB values), 0 to 255.
    #[must_use]
    pub fn luma(photo: &Photo) -> Self {
        let values =
            photo.pixels().iter().map(|p| 0.299 * f32::from(p[0]) + 0.587 * f32::from(p[1]) + 0.114 * f32::from(p[2]));
        Self { width: photo.width(), height: photo.height(), values: values.collect() }
    }

    /// The value of a pixel; beyond the border that of the nearest one.
    #[must_use]
    pub fn at(&self, x: isize, y: isize) -> f32 {
        let x = x.clamp(0, self.width as isize - 1) as usize;
        let y = y.clamp(0, self.height as isize - 1) as usize;
        self.values[y * self.width + x]
    }

    /// The value between pixels, bilinear; beyond the border that of the nearest pixel.
    #[must_use]
    pub fn sample(&self, x: f64, y: f64) -> f32 {
        let x = x.clamp(0.0, (self.width - 1) as f64);
        let y = y.clamp(0.0, (self.height - 1) as f64);
        let (x0, y0) = (x as usize, y as usize);
        let (x1, y1) = ((x0 + 1).min(self.width - 1), (y0 + 1).min(self.height - 1));
        let (fx, fy) = ((x - x0 as f64) as f32, (y - y0 as f64) as f32);
        let row = |y: usize| {
            let (a, b) = (self.values[y * self.width + x0], self.values[y * self.width + x1]);
            a + (b - a) * fx
        };
        let (top, bottom) = (row(y0), row(y1));
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
        let mut across = Vec::with_capacity(self.values.len());
        let mut line = Vec::new();
        for row in self.values.chunks_exact(self.width) {
            line.clear();
            line.extend(std::iter::repeat_n(row[0], reach));
            line.extend_from_slice(row);
            line.extend(std::iter::repeat_n(row[self.width - 1], reach));
            across.extend(line.windows(kernel.len()).map(|w| w.iter().zip(&kernel).map(|(v, k)| v * k).sum::<f32>()));
        }
        let mut values = vec![0.0_f32; self.values.len()];
        for (y, out) in values.chunks_exact_mut(self.width).enumerate() {
            for (i, k) in kernel.iter().enumerate() {
                let from = (y + i).saturating_sub(reach).min(self.height - 1);
                let row = &across[from * self.width..(from + 1) * self.width];
                out.iter_mut().zip(row).for_each(|(o, v)| *o += k * v);
            }
        }
        Self { width: self.width, height: self.height, values }
    }
}

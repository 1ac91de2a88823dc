//! The three operations of the attention mesh: it crops the features round the lips and each eye and looks there again.
//!
//! Landmarks of a region give a similarity (Landmarks2TransformMatrix), features are sampled through it
//! (TransformTensorBilinear), and the finer landmarks are carried back (TransformLandmarks). Matrices are 4 × 4, row by
//! row, of which the first two rows' columns 0, 1 and 3 are used.

use super::convolution::Hwc;
use super::error::{NetError, Result};
use super::flexbuffer::Options;

/// Makes the matrix from a crop of a region to the grid that its landmarks are in.
#[derive(Debug, Clone)]
pub(super) struct Region {
    /// The region's landmarks, by number.
    pub landmarks: Vec<usize>,
    /// Two landmarks on the line that becomes horizontal.
    axis: [usize; 2],
    /// The direction of that line in the crop, in radians.
    turn: f32,
    /// The crop's height and width.
    size: [f32; 2],
    /// The crop's extent by that of the landmarks, across and down.
    scale: [f32; 2],
}

impl Region {
    /// From the options of the operation, for a net with `count` landmarks.
    pub(super) fn read(options: &[u8], count: usize) -> Result<Self> {
        let options = Options::read(options)?;
        let size = |key| Ok(options.index(key)?.min(1 << 16) as f32);
        let region = Self {
            landmarks: options.indices("subset_idxs")?,
            axis: [options.index("left_rotation_idx")?, options.index("right_rotation_idx")?],
            turn: options.float("target_rotation_radians")?,
            size: [size("output_height")?, size("output_width")?],
            scale: [options.float("scale_x")?, options.float("scale_y")?],
        };
        let fits = region.landmarks.iter().chain(&region.axis).all(|landmark| *landmark < count);
        match fits && !region.landmarks.is_empty() && region.size.iter().all(|s| *s > 0.0) {
            true => Ok(region),
            false => Err(NetError::Mismatch("Landmarks2TransformMatrix")),
        }
    }

    /// `landmarks` are triples x, y, z.
    pub(super) fn run(&self, landmarks: &[f32], matrix: &mut [f32]) {
        let point = |i: usize| (landmarks[3 * i], landmarks[3 * i + 1]);
        let (a, b) = (point(self.axis[0]), point(self.axis[1]));
        let (sin, cos) = libm::sincosf(self.turn - libm::atan2f(b.1 - a.1, b.0 - a.0));
        let (mut low, mut high) = ([f32::INFINITY; 2], [f32::NEG_INFINITY; 2]);
        for landmark in &self.landmarks {
            let (x, y) = point(*landmark);
            for (axis, v) in [cos * x - sin * y, sin * x + cos * y].into_iter().enumerate() {
                low[axis] = low[axis].min(v);
                high[axis] = high[axis].max(v);
            }
        }
        let middle = [f32::midpoint(low[0], high[0]), f32::midpoint(low[1], high[1])];
        let centre = [cos * middle[0] + sin * middle[1], cos * middle[1] - sin * middle[0]];
        let [height, width] = self.size;
        let step = [self.scale[0] * (high[0] - low[0]) / width, self.scale[1] * (high[1] - low[1]) / height];
        let rows = [[cos * step[0], sin * step[1]], [-sin * step[0], cos * step[1]]];
        matrix.fill(0.0);
        for (row, [across, down]) in rows.into_iter().enumerate() {
            let origin = centre[row] - (across * width + down * height) / 2.0;
            matrix[4 * row..][..4].copy_from_slice(&[across, down, 0.0, origin]);
        }
        matrix[10] = 1.0;
        matrix[15] = 1.0;
    }
}

/// Samples features on a grid that a matrix maps into them, bilinearly; 0 outside.
#[derive(Debug, Clone)]
pub(super) struct Sampler {
    pub input: Hwc,
    pub output: Hwc,
}

impl Sampler {
    pub(super) fn run(&self, input: &[f32], matrix: &[f32], output: &mut [f32]) {
        let [height, width, channels] = self.input;
        // Both grids have their pixels' centres at halves.
        let shift = |row: &[f32]| row[3] + 0.5 * (row[0] + row[1]) - 0.5;
        let (shift_x, shift_y) = (shift(&matrix[..4]), shift(&matrix[4..8]));
        for (pixel, out) in output.chunks_exact_mut(channels).enumerate() {
            let (x, y) = ((pixel % self.output[1]) as f32, (pixel / self.output[1]) as f32);
            let u = matrix[0] * x + matrix[1] * y + shift_x;
            let v = matrix[4] * x + matrix[5] * y + shift_y;
            if !(0.0..=(width - 1) as f32).contains(&u) || !(0.0..=(height - 1) as f32).contains(&v) {
                out.fill(0.0);
                continue;
            }
            let (left, top) = (u as usize, v as usize);
            let (right, bottom) = ((left + 1).min(width - 1), (top + 1).min(height - 1));
            blend(
                input,
                [top * width + left, top * width + right, bottom * width + left, bottom * width + right],
                [u - left as f32, v - top as f32],
                out,
            );
        }
    }
}

/// The bilinear mean of four pixels: upper left, upper right, lower left, lower right.
pub(super) fn blend(input: &[f32], pixels: [usize; 4], [across, down]: [f32; 2], out: &mut [f32]) {
    let channels = out.len();
    let [a, b, c, d] = pixels.map(|pixel| &input[pixel * channels..][..channels]);
    for (i, out) in out.iter_mut().enumerate() {
        let upper = (1.0 - across) * a[i] + across * b[i];
        let lower = (1.0 - across) * c[i] + across * d[i];
        *out = (1.0 - down) * upper + down * lower;
    }
}

/// Carries landmarks of a crop, pairs x, y, back through its matrix.
pub(super) fn carry_back(landmarks: &[f32], matrix: &[f32], output: &mut [f32]) {
    for (to, from) in output.chunks_exact_mut(2).zip(landmarks.chunks_exact(2)) {
        to[0] = matrix[0] * from[0] + matrix[1] * from[1] + matrix[3];
        to[1] = matrix[4] * from[0] + matrix[5] * from[1] + matrix[7];
    }
}

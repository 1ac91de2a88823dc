//! What a picture looks like near a place, apart from its light: how much edge there is in each of eight
//! directions, and the descriptor built of it (Lowe 2004's, sampled densely).

use crate::drawing::Image;
use crate::photo::Plane;

/// Directions of an edge, 45° apart; opposite ones differ, since a face is dark on one side of an edge.
pub(crate) const BINS: usize = 8;
/// Numbers in a descriptor: four by four places, eight directions.
pub const DESCRIPTOR: usize = 16 * BINS;

/// Strength of the gradient in each direction, a pixel at a time.
pub(crate) type Channels = Image<[f32; BINS]>;

/// `cos` and `sin` of the eight directions.
const HALF: f32 = std::f32::consts::FRAC_1_SQRT_2;
const COS: [f32; BINS] = [1.0, HALF, 0.0, -HALF, -1.0, -HALF, 0.0, HALF];
const SIN: [f32; BINS] = [0.0, HALF, 1.0, HALF, 0.0, -HALF, -1.0, -HALF];

/// A gradient shared out among the directions: |g| cos³ of the angle to each, none beyond 90°. The cube falls to one
/// half at 37°, so neighbours overlap as linear shares would, without an arc tangent.
fn share(gx: f32, gy: f32) -> [f32; BINS] {
    let inverse = 1.0 / (gx * gx + gy * gy + 1e-3);
    let mut out = [0.0; BINS];
    for k in 0..BINS {
        let along = (gx * COS[k] + gy * SIN[k]).max(0.0);
        out[k] = along * along * along * inverse;
    }
    out
}

impl Channels {
    /// Of a grey plane.
    #[must_use]
    pub(crate) fn of(plane: &Plane) -> Self {
        let (width, height) = (plane.width(), plane.height());
        let mut values = Vec::with_capacity(width * height);
        for y in 0..height {
            let (above, here, below) =
                (plane.row(y.saturating_sub(1)), plane.row(y), plane.row((y + 1).min(height - 1)));
            for x in 0..width {
                let gx = here[(x + 1).min(width - 1)] - here[x.saturating_sub(1)];
                values.push(share(gx, below[x] - above[x]));
            }
        }
        Self::new(width, height, values)
    }

    /// Sums over squares of `side` pixels, one after another; what is left at the right and below is dropped.
    #[must_use]
    pub(crate) fn cells(plane: &Plane, side: usize) -> Self {
        let (width, height) = (plane.width() / side, plane.height() / side);
        let mut cells = Self::filled(width, height, [0.0; BINS]);
        let last = plane.width() - 1;
        for y in 0..height * side {
            let (above, here, below) =
                (plane.row(y.saturating_sub(1)), plane.row(y), plane.row((y + 1).min(plane.height() - 1)));
            for (i, sum) in cells.row_mut(y / side).iter_mut().enumerate() {
                for x in i * side..(i + 1) * side {
                    let gx = here[(x + 1).min(last)] - here[x.saturating_sub(1)];
                    let shares = share(gx, below[x] - above[x]);
                    for k in 0..BINS {
                        sum[k] += shares[k];
                    }
                }
            }
        }
        cells
    }

    /// Spread so that a pixel holds what lies within `cell` pixels of it, the nearer the more: a triangle, by two
    /// running means.
    #[must_use]
    pub(crate) fn spread(&self, cell: f32) -> Self {
        let side = (cell.round() as usize).max(1);
        let (before, after) = (side / 2, (side - 1) / 2);
        let mut out = self.clone();
        let mut other = self.clone();
        // An even side leans to one side; the second pass leans back.
        for (left, right) in [(before, after), (after, before)] {
            for (y, from) in out.rows().enumerate() {
                running_mean(from, other.row_mut(y), left, right);
            }
            other.down(&mut out, left, right);
        }
        out
    }

    /// Running means of each column over `up` rows above to `down` below.
    fn down(&self, to: &mut Self, up: usize, down: usize) {
        let (w, h) = (self.width(), self.height());
        let mean = 1.0 / (up + down + 1) as f32;
        let row = |y: isize| self.row(y.clamp(0, h as isize - 1) as usize);
        let mut sums = vec![[0.0_f32; BINS]; w];
        for y in -(up as isize)..=down as isize {
            for (s, v) in sums.iter_mut().zip(row(y)) {
                (0..BINS).for_each(|k| s[k] += v[k]);
            }
        }
        for y in 0..h {
            let (leaves, enters) = (row(y as isize - up as isize), row(y as isize + down as isize + 1));
            let out = to.row_mut(y);
            for (((s, o), l), e) in sums.iter_mut().zip(out).zip(leaves).zip(enters) {
                for k in 0..BINS {
                    o[k] = s[k] * mean;
                    s[k] += e[k] - l[k];
                }
            }
        }
    }

    /// The channels between pixels, bilinear; beyond the border the nearest.
    #[inline]
    fn sample(&self, x: f32, y: f32) -> [f32; BINS] {
        let ([a, b, c, d], [fx, fy]) = self.around(f64::from(x), f64::from(y));
        let (fx, fy) = (fx as f32, fy as f32);
        let mut out = [0.0; BINS];
        for k in 0..BINS {
            let top = a[k] + (b[k] - a[k]) * fx;
            out[k] = top + (c[k] + (d[k] - c[k]) * fx - top) * fy;
        }
        out
    }

    /// Mean strength over the middle half of the picture: what its gradients are measured against.
    #[must_use]
    pub(crate) fn strength(&self) -> f32 {
        let (w, h) = (self.width(), self.height());
        let mut sum = 0.0;
        for y in h / 4..h - h / 4 {
            sum += self.row(y)[w / 4..w - w / 4].iter().flatten().sum::<f32>();
        }
        sum / ((h - h / 4 - h / 4) * (w - w / 4 - w / 4)) as f32
    }

    /// The descriptor at a place of channels [spread](Self::spread) by `cell`: four by four samples `cell` apart,
    /// scaled to length 1, no number above 0.25 (Lowe 2004, sec. 6.1). Where there is hardly an edge the length stays
    /// below 1: `strength` is what [`strength`](Self::strength) says of the picture.
    pub(crate) fn describe(&self, x: f32, y: f32, cell: f32, strength: f32, out: &mut [f32]) {
        for (n, place) in out.chunks_exact_mut(BINS).enumerate() {
            let (u, v) = ((n % 4) as f32 - 1.5, (n / 4) as f32 - 1.5);
            place.copy_from_slice(&self.sample(x + u * cell, y + v * cell));
        }
        // A place with a fifth of the usual strength everywhere has a length of 2.3 strengths (128 numbers) and keeps 0.7.
        let floor = 2.3 * strength + 1e-3;
        let length = |d: &[f32]| d.iter().map(|v| v * v).sum::<f32>();
        let scale = 1.0 / (length(out) + floor * floor).sqrt();
        out.iter_mut().for_each(|v| *v = (*v * scale).min(0.25));
        let scale = 1.0 / length(out).sqrt().max(0.5);
        out.iter_mut().for_each(|v| *v *= scale);
    }
}

/// Running means over `left` before to `right` after; the ends go on beyond the ends.
fn running_mean(from: &[[f32; BINS]], to: &mut [[f32; BINS]], left: usize, right: usize) {
    let n = from.len() as isize;
    let at = |i: isize| &from[i.clamp(0, n - 1) as usize];
    let mean = 1.0 / (left + right + 1) as f32;
    let mut sum = [0.0_f32; BINS];
    for i in -(left as isize)..=right as isize {
        (0..BINS).for_each(|k| sum[k] += at(i)[k]);
    }
    for (i, o) in to.iter_mut().enumerate() {
        let (leaves, enters) = (at(i as isize - left as isize), at(i as isize + right as isize + 1));
        for k in 0..BINS {
            o[k] = sum[k] * mean;
            sum[k] += enters[k] - leaves[k];
        }
    }
}

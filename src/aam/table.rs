//! Where each pixel of the mean shape lies in its triangle, and how a picture is read there for any other shape.

use super::ground::Ground;
use crate::geometry::{Point, Vec2};

/// Pixels are read so many at a time.
const LANES: usize = 4;
/// Added to and taken from a float it rounds to the nearest whole number, halves to the even one.
const WHOLE: f32 = 12_582_912.0;

/// The pixels of a mean shape, sorted by triangle, each triangle's filled up to a multiple of four.
#[derive(Debug, Clone, Default)]
pub(super) struct Table {
    runs: Vec<Run>,
    /// How far a pixel lies along its triangle's first and second side, as shares of them.
    u: Vec<f32>,
    v: Vec<f32>,
    /// The place of each pixel in the grid; `usize::MAX` for what only fills up.
    grid: Vec<usize>,
    /// Pixels in a row of the grid, and rows.
    size: [usize; 2],
    count: usize,
    /// The mean shape's least x and y, and pixels in its width.
    low: Vec2,
    width: f64,
}

#[derive(Debug, Clone, Copy)]
struct Run {
    corners: [usize; 3],
    first: usize,
    /// With what fills up, and without.
    len: usize,
    count: usize,
}

/// Round the mean shape, in pixels.
const MARGIN: f64 = 3.0;

impl Table {
    /// The pixels of a mean shape of the width 1 when drawn `width` pixels wide.
    pub(crate) fn new(mean: &[Point], triangles: &[[usize; 3]], width: f64) -> Self {
        let low = mean.iter().fold(Vec2::new(f64::MAX, f64::MAX), |l, p| Vec2::new(l.x.min(p.x), l.y.min(p.y)));
        let mut table = Self { low, width, ..Self::default() };
        let placed: Vec<Point> = mean.iter().map(|p| table.place(*p)).collect();
        let high = placed.iter().fold(Vec2::ZERO, |h, p| Vec2::new(h.x.max(p.x), h.y.max(p.y)));
        let size = [high.x, high.y].map(|v| (v + MARGIN).ceil() as usize + 1);
        let mut taken = vec![false; size[0] * size[1]];
        table.size = size;
        for t in triangles {
            let [a, b, c] = t.map(|v| placed[v]);
            let (ab, ac) = (b - a, c - a);
            let area = ab.cross(ac);
            let first = table.u.len();
            let range = |low: f64, high: f64| low.ceil() as usize..=high.floor() as usize;
            for y in range(a.y.min(b.y).min(c.y), a.y.max(b.y).max(c.y)) {
                for x in range(a.x.min(b.x).min(c.x), a.x.max(b.x).max(c.x)) {
                    let p = Point::new(x as f64, y as f64) - a;
                    let (u, v) = (p.cross(ac) / area, ab.cross(p) / area);
                    let at = y * size[0] + x;
                    if u >= -1e-9 && v >= -1e-9 && u + v <= 1.0 + 1e-9 && !taken[at] {
                        taken[at] = true;
                        table.u.push(u as f32);
                        table.v.push(v as f32);
                        table.grid.push(at);
                    }
                }
            }
            let count = table.u.len() - first;
            if count == 0 {
                continue;
            }
            let len = count.next_multiple_of(LANES);
            table.u.resize(first + len, 0.0);
            table.v.resize(first + len, 0.0);
            table.grid.resize(first + len, usize::MAX);
            table.runs.push(Run { corners: *t, first, len, count });
            table.count += count;
        }
        // Whole blocks for the sums.
        let blocks = table.u.len().next_multiple_of(super::sums::LANES);
        table.u.resize(blocks, 0.0);
        table.v.resize(blocks, 0.0);
        table.grid.resize(blocks, usize::MAX);
        table
    }

    /// The place in the grid of a place in the mean shape.
    pub(crate) fn place(&self, p: Point) -> Point {
        ((p.to_vec2() - self.low) * self.width + Vec2::new(MARGIN, MARGIN)).to_point()
    }

    /// How many pixels the mean shape has.
    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// How many numbers a reading has: the pixels and what fills up, which reads as 0.
    pub(crate) fn len(&self) -> usize {
        self.u.len()
    }

    /// Pixels in a row of the grid, and rows.
    pub(crate) fn size(&self) -> [usize; 2] {
        self.size
    }

    /// The place in the grid of each number of a reading; none for what fills up.
    pub(crate) fn places(&self) -> impl Iterator<Item = Option<usize>> + '_ {
        self.grid.iter().map(|at| (*at != usize::MAX).then_some(*at))
    }

    /// The corners of the triangle and the shares along its sides of each number of a reading.
    pub(crate) fn weights(&self) -> impl Iterator<Item = (usize, [usize; 3], [f32; 3])> + '_ {
        self.runs.iter().flat_map(|r| {
            (r.first..r.first + r.count).map(|i| (i, r.corners, [1.0 - self.u[i] - self.v[i], self.u[i], self.v[i]]))
        })
    }

    /// Reads a picture where a shape's triangles lie; bilinear, and beyond the border what lies nearest. `xs` and `ys`
    /// are places in `ground`; its channels are read one after the other; whatever is no number is read as 0.
    pub(crate) fn read(&self, ground: &Ground, xs: &[f32], ys: &[f32], out: &mut [f32]) {
        let (row, right, bottom) = ground.size();
        for (fours, out) in ground.fours().zip(out.chunks_exact_mut(self.len().max(1))) {
            self.read_channel(fours, [row, right, bottom], xs, ys, out);
        }
    }

    fn read_channel(&self, fours: &[u32], [row, right, bottom]: [f32; 3], xs: &[f32], ys: &[f32], out: &mut [f32]) {
        for run in &self.runs {
            let [i, j, k] = run.corners;
            let (ax, ay) = (xs[i], ys[i]);
            let (bx, by) = (xs[j] - ax, ys[j] - ay);
            let (cx, cy) = (xs[k] - ax, ys[k] - ay);
            let span = run.first..run.first + run.len;
            let (us, _) = self.u[span.clone()].as_chunks::<LANES>();
            let (vs, _) = self.v[span.clone()].as_chunks::<LANES>();
            let (outs, _) = out[span.clone()].as_chunks_mut::<LANES>();
            for ((u, v), out) in us.iter().zip(vs).zip(outs) {
                let mut fx = [0.0_f32; LANES];
                let mut fy = [0.0_f32; LANES];
                let mut at = [0_u32; LANES];
                for l in 0..LANES {
                    let x = within(ax + u[l] * bx + v[l] * cx, right);
                    let y = within(ay + u[l] * by + v[l] * cy, bottom);
                    // Rounding down; of a whole number perhaps to the one below, which reads the same.
                    let (x0, y0) = ((x - 0.5 + WHOLE) - WHOLE, (y - 0.5 + WHOLE) - WHOLE);
                    fx[l] = x - x0;
                    fy[l] = y - y0;
                    // A float from 2^23 on holds a whole number in its low bits.
                    at[l] = (y0 * row + x0 + 8_388_608.0).to_bits() & 0x007F_FFFF;
                }
                let mut four = [0_u32; LANES];
                for l in 0..LANES {
                    four[l] = fours.get(at[l] as usize).copied().unwrap_or_default();
                }
                for l in 0..LANES {
                    let byte = |shift: u32| ((four[l] >> shift) & 255) as i32 as f32;
                    let (a, b, c, d) = (byte(0), byte(8), byte(16), byte(24));
                    let (top, below) = (a + fx[l] * (b - a), c + fx[l] * (d - c));
                    out[l] = top + fy[l] * (below - top);
                }
            }
            out[run.first + run.count..span.end].fill(0.0);
        }
    }
}

/// Between 0 and `most`; 0 for what is no number.
#[inline]
fn within(v: f32, most: f32) -> f32 {
    let v = if v > 0.0 { v } else { 0.0 };
    if v < most { v } else { most }
}

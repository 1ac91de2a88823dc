//! The model at one size, made ready to fit: what a reading of the picture says about how the shape must move
//! (project-out inverse compositional, Matthews and Baker 2004).
//!
//! A constant, the mean texture and its modes span all looks, brightness and contrast of the light included. The steepest
//! descent images, what a small move of the shape would change in the mean texture, are freed of all of them.
//! With them one product of the reading gives the move: nothing needs to be subtracted, and the light drops out.

use nalgebra::{DMatrix, DVector};

use super::ground::Channels;
use super::shape::{Shapes, dot, similar};
use super::table::Table;
use crate::geometry::Point;

/// What is stored of a level.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Look {
    /// Pixels in the mean shape's width.
    pub width: f32,
    /// How many of the shape's modes move.
    pub modes: usize,
    /// How often the picture is smoothed.
    pub smooth: u32,
    /// What of it is compared.
    pub channels: Channels,
    /// The mean texture and its modes, as whole numbers in parts of a largest one.
    pub textures: Vec<Texture>,
}

/// A texture as it is stored.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Texture {
    /// What one step of a value is worth.
    pub step: f32,
    /// The standard deviation along it, as a share of the contrast; 0 of the mean.
    pub deviation: f32,
    /// The values at the table's pixels, without what fills up.
    pub values: Vec<i16>,
}

impl Texture {
    pub(crate) fn of(values: &[f64], deviation: f64) -> Self {
        let largest = values.iter().fold(0.0_f64, |l, v| l.max(v.abs())).max(1e-12);
        let step = (largest / 32_000.0) as f32;
        Self {
            step,
            deviation: deviation as f32,
            values: values.iter().map(|v| (v / f64::from(step)).round() as i16).collect(),
        }
    }
}

/// Image gradients and point motions of a level, computed once for its simultaneous steps.
#[derive(Debug, Clone, Default)]
pub(super) struct Slopes {
    /// Derivatives along x, then along y, of each look but the constant; as long as a reading.
    pub looks: Vec<[Vec<f32>; 2]>,
    /// Motion of each of the table's pixels along each direction: x, then y.
    pub warps: Vec<[Vec<f32>; 2]>,
}

/// A level ready to fit.
#[derive(Debug, Clone)]
pub(super) struct Level {
    /// Pixels in the mean shape's width.
    pub width: f32,
    /// How many of the shape's modes move.
    pub modes: usize,
    /// How often the picture is smoothed.
    pub smooth: u32,
    /// What of it is compared.
    pub channels: Channels,
    /// The pixels.
    pub table: Table,
    /// Row by row: how far to move along the similarity's four directions and the modes, times the contrast; then the
    /// contrast.
    pub steps: Vec<f32>,
    /// Row by row: a constant, the mean texture and its modes, orthogonal, of length 1.
    pub looks: Vec<f32>,
    /// The directions of `steps`: all x, then all y, in pixels.
    pub directions: Vec<Vec<f32>>,
    /// Of each triangle the corners and the inverse of its sides in the mean shape.
    pub triangles: Vec<([usize; 3], [f32; 4])>,
    /// One over the number of triangles that a point is a corner of.
    pub shares: Vec<f32>,
    /// For simultaneous steps.
    pub slopes: Slopes,
}

impl Level {
    /// Makes a level ready; none where the textures are not as many pixels as the table, or say nothing.
    pub(crate) fn new(shapes: &Shapes, triangles: &[[usize; 3]], look: &Look) -> Option<Self> {
        let mean = shapes.mean();
        let table = Table::new(&mean, triangles, f64::from(look.width));
        let mut rows = vec![constant(&table, look.channels.count())];
        for texture in &look.textures {
            if texture.values.len() != table.count() * look.channels.count() {
                return None;
            }
            let mut values = texture.values.iter();
            let step = f64::from(texture.step);
            let spread = |at: Option<usize>| match at {
                Some(_) => values.next().map_or(0.0, |v| f64::from(*v) * step),
                None => 0.0,
            };
            rows.push((0..look.channels.count()).flat_map(|_| table.places()).map(spread).collect());
        }
        let rows = orthogonal(rows);
        if rows.len() < 2 {
            return None;
        }
        let modes = look.modes.min(shapes.modes().len());
        let directions = directions(shapes, modes);
        let len = table.len() * look.channels.count();
        let slopes: Vec<[f64; 2]> =
            rows[1].chunks_exact(table.len()).flat_map(|texture| slopes(&table, texture)).collect();
        let mut descent = vec![vec![0.0_f64; len]; directions.len()];
        for (i, corners, weights) in table.weights() {
            for (images, direction) in descent.iter_mut().zip(&directions) {
                let along = |axis: usize| -> f64 {
                    corners.iter().zip(weights).map(|(c, w)| direction[axis + c] * f64::from(w)).sum()
                };
                let (x, y) = (along(0), along(shapes.count()));
                for at in (i..len).step_by(table.len()) {
                    images[at] = slopes[at][0] * x + slopes[at][1] * y;
                }
            }
        }
        for image in &mut descent {
            for row in &rows {
                let along = dot(image, row);
                image.iter_mut().zip(row).for_each(|(v, r)| *v -= along * r);
            }
        }
        let n = descent.len();
        let mut hessian = DMatrix::from_fn(n, n, |i, j| dot(&descent[i], &descent[j]));
        let slight = 1e-6 * hessian.trace() / n as f64;
        for i in 0..n {
            hessian[(i, i)] += slight.max(1e-12);
        }
        let inverse = hessian.cholesky()?.inverse();
        let mut steps = Vec::with_capacity((n + 1) * len);
        let mut column = DVector::zeros(n);
        let mut by_pixel = vec![0.0_f32; n * len];
        for i in 0..len {
            (0..n).for_each(|k| column[k] = descent[k][i]);
            let moved = &inverse * &column;
            (0..n).for_each(|k| by_pixel[k * len + i] = moved[k] as f32);
        }
        steps.append(&mut by_pixel);
        steps.extend(rows[1].iter().map(|v| *v as f32));
        let ready = ready(&table, &rows[1..], &directions, shapes.count());
        let (triangles, shares) = incident(&mean, triangles, look.width);
        Some(Self {
            width: look.width,
            modes,
            smooth: look.smooth,
            channels: look.channels,
            steps,
            looks: rows.iter().flatten().map(|v| *v as f32).collect(),
            directions: directions.iter().map(|d| d.iter().map(|v| *v as f32).collect()).collect(),
            table,
            triangles,
            shares,
            slopes: ready,
        })
    }

    /// How many rows `steps` has.
    pub(crate) fn step_count(&self) -> usize {
        self.directions.len() + 1
    }

    /// How many rows `looks` has.
    pub(crate) fn look_count(&self) -> usize {
        self.looks.len() / self.len().max(1)
    }

    /// How many numbers a reading has.
    pub(crate) fn len(&self) -> usize {
        self.table.len() * self.channels.count()
    }
}

/// What simultaneous steps need of textures and directions.
fn ready(table: &Table, textures: &[Vec<f64>], directions: &[Vec<f64>], count: usize) -> Slopes {
    let of = |texture: &Vec<f64>| {
        let all: Vec<[f64; 2]> = texture.chunks_exact(table.len()).flat_map(|t| slopes(table, t)).collect();
        [0, 1].map(|axis| all.iter().map(|s| s[axis] as f32).collect())
    };
    let warp = |direction: &Vec<f64>| {
        let mut out = [vec![0.0_f32; table.len()], vec![0.0_f32; table.len()]];
        for (i, corners, weights) in table.weights() {
            for (axis, out) in out.iter_mut().enumerate() {
                out[i] = corners.iter().zip(weights).map(|(c, w)| direction[axis * count + c] as f32 * w).sum();
            }
        }
        out
    };
    Slopes { looks: textures.iter().map(of).collect(), warps: directions.iter().map(warp).collect() }
}

/// The similarity's four directions, then the modes.
fn directions(shapes: &Shapes, modes: usize) -> Vec<Vec<f64>> {
    let mean: Vec<f64> = shapes.mean_vector().iter().map(|v| f64::from(*v)).collect();
    let modes = shapes.modes()[..modes].iter().map(|m| m.iter().map(|v| f64::from(*v)).collect());
    similar(&mean).into_iter().chain(modes).collect()
}

/// 1 at every pixel, as a vector of length 1.
fn constant(table: &Table, channels: usize) -> Vec<f64> {
    let one = 1.0 / ((table.count() * channels).max(1) as f64).sqrt();
    (0..channels).flat_map(|_| table.places()).map(|at| if at.is_some() { one } else { 0.0 }).collect()
}

/// Gram and Schmidt, twice for the sake of rounding; what adds nothing is left out.
fn orthogonal(rows: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let mut kept: Vec<Vec<f64>> = Vec::with_capacity(rows.len());
    for mut row in rows {
        for _ in 0..2 {
            for other in &kept {
                let along = dot(&row, other);
                row.iter_mut().zip(other).for_each(|(v, o)| *v -= along * o);
            }
        }
        let length = dot(&row, &row).sqrt();
        if length > 1e-4 {
            row.iter_mut().for_each(|v| *v /= length);
            kept.push(row);
        }
    }
    kept
}

/// A texture on the table's grid. Beyond the mean shape's border it goes on as it is there, for two pixels; farther out
/// it is no number.
pub(super) fn grid(table: &Table, texture: &[f64]) -> Vec<f64> {
    let [w, h] = table.size();
    let mut grid = vec![f64::NAN; w * h];
    for (at, v) in table.places().zip(texture) {
        if let Some(at) = at {
            grid[at] = *v;
        }
    }
    for _ in 0..2 {
        let known = grid.clone();
        for y in 1..h.saturating_sub(1) {
            for x in 1..w.saturating_sub(1) {
                let at = y * w + x;
                if !known[at].is_nan() {
                    continue;
                }
                let near = [at - 1, at + 1, at - w, at + w].map(|i| known[i]);
                let (sum, count) = near.iter().filter(|v| !v.is_nan()).fold((0.0, 0), |(s, n), v| (s + v, n + 1));
                if count > 0 {
                    grid[at] = sum / f64::from(count);
                }
            }
        }
    }
    grid
}

/// How a texture changes along x and y, for each number of a reading.
fn slopes(table: &Table, texture: &[f64]) -> Vec<[f64; 2]> {
    let w = table.size()[0];
    let grid = grid(table, texture);
    let slope = |at: usize, by: usize| {
        let (a, b) = (grid.get(at.wrapping_sub(by)), grid.get(at + by));
        match (a, b) {
            (Some(a), Some(b)) if !a.is_nan() && !b.is_nan() => (b - a) / 2.0,
            _ => 0.0,
        }
    };
    table.places().map(|at| at.map_or([0.0; 2], |at| [slope(at, 1), slope(at, w)])).collect()
}

/// The inverse of each triangle's sides in the mean shape, and each point's share of a triangle.
#[allow(clippy::type_complexity, reason = "a pair of lists")]
fn incident(mean: &[Point], triangles: &[[usize; 3]], width: f32) -> (Vec<([usize; 3], [f32; 4])>, Vec<f32>) {
    let mut counts = vec![0_u32; mean.len()];
    let inverses = triangles
        .iter()
        .map(|t| {
            t.iter().for_each(|v| counts[*v] += 1);
            let [a, b, c] = t.map(|v| mean[v]);
            let (ab, ac) = ((b - a) * f64::from(width), (c - a) * f64::from(width));
            let area = ab.cross(ac);
            (*t, [ac.y, -ac.x, -ab.y, ab.x].map(|v| (v / area) as f32))
        })
        .collect();
    let shares = counts.iter().map(|n| if *n > 0 { 1.0 / *n as f32 } else { 0.0 }).collect();
    (inverses, shares)
}

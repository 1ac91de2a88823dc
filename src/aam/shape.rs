//! How the shape varies: a mean and a few modes.

use nalgebra::{DMatrix, SymmetricEigen};

use super::align::align;
use crate::geometry::{Point, Similarity};

/// A mean shape and its modes, in units of the mean's width. A vector over the points holds all their x, then all
/// their y. Modes have length 1, are orthogonal to each other and to what a similarity does to the mean.
#[derive(Debug, Clone, PartialEq)]
pub struct Shapes {
    count: usize,
    mean: Vec<f32>,
    modes: Vec<Vec<f32>>,
    deviations: Vec<f32>,
    /// The sum of squares of the mean.
    square: f32,
}

/// How far along a mode a shape may go, in its standard deviations.
pub(super) const REACH: f32 = 3.0;

impl Shapes {
    /// Learns from shapes: so many modes that they hold `share` of the variance, at most `most`. None where the shapes
    /// cannot be aligned.
    #[must_use]
    pub(crate) fn learned(shapes: &[Vec<Point>], share: f64, most: usize) -> Option<Self> {
        let aligned = align(shapes)?;
        let n = aligned.mean.len();
        let (low, high) = aligned.mean.iter().fold((f64::MAX, f64::MIN), |(l, h), p| (l.min(p.x), h.max(p.x)));
        let size = 1.0 / (high - low).max(1e-9);
        let vector =
            |s: &[Point]| -> Vec<f64> { s.iter().map(|p| p.x * size).chain(s.iter().map(|p| p.y * size)).collect() };
        let mean = vector(&aligned.mean);
        let still = similar(&mean);
        let rest: Vec<Vec<f64>> = aligned
            .shapes
            .iter()
            .map(|s| {
                let mut d: Vec<f64> = vector(s).iter().zip(&mean).map(|(a, b)| a - b).collect();
                for q in &still {
                    let along = dot(&d, q);
                    d.iter_mut().zip(q).for_each(|(d, q)| *d -= along * q);
                }
                d
            })
            .collect();
        let found = principal(&rest, share, most);
        let dof = (shapes.len().max(2) - 1) as f64;
        let mean: Vec<f32> = mean.iter().map(|v| *v as f32).collect();
        let deviations = found.iter().map(|(_, square)| (square / dof).sqrt() as f32).collect();
        let modes = found.into_iter().map(|(mode, _)| mode.iter().map(|v| *v as f32).collect()).collect();
        Self::of(n, mean, modes, deviations)
    }

    /// Puts stored numbers together; none where they do not belong together or are no shapes.
    pub(super) fn of(count: usize, mean: Vec<f32>, modes: Vec<Vec<f32>>, deviations: Vec<f32>) -> Option<Self> {
        let square = mean.iter().map(|v| v * v).sum::<f32>();
        let whole = count >= 3
            && mean.len() == 2 * count
            && modes.len() == deviations.len()
            && modes.iter().all(|m| m.len() == 2 * count)
            // Its width is 1; what is made ready of it must stay of a size.
            && mean.iter().chain(modes.iter().flatten()).all(|v| v.abs() <= 3.0)
            && deviations.iter().all(|d| (0.0..1e4).contains(d))
            && square > 1e-6;
        whole.then_some(Self { count, mean, modes, deviations, square })
    }

    /// How many points a shape has.
    #[must_use]
    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// The mean shape, its middle at the origin and its width 1.
    #[must_use]
    pub fn mean(&self) -> Vec<Point> {
        points(&self.mean)
    }

    /// The modes, the strongest first: all x, then all y.
    #[must_use]
    pub fn modes(&self) -> &[Vec<f32>] {
        &self.modes
    }

    /// The standard deviation along each mode.
    #[must_use]
    pub(crate) fn deviations(&self) -> &[f32] {
        &self.deviations
    }

    pub(super) fn mean_vector(&self) -> &[f32] {
        &self.mean
    }

    /// The shape at `p` along the modes; modes without a number stay at 0.
    #[must_use]
    pub(crate) fn shape(&self, p: &[f64]) -> Vec<Point> {
        let mut vector = self.mean.clone();
        for (mode, by) in self.modes.iter().zip(p) {
            vector.iter_mut().zip(mode).for_each(|(v, m)| *v += *by as f32 * m);
        }
        points(&vector)
    }

    /// The pose and the place along the modes of a shape, by least squares; none for a shape without extent or of
    /// another number of points.
    #[must_use]
    pub(crate) fn describe(&self, shape: &[Point]) -> Option<(Similarity, Vec<f64>)> {
        if shape.len() != self.count {
            return None;
        }
        let q = Similarity::between(&self.mean(), shape)?;
        if q.scale() < 1e-9 {
            return None;
        }
        let laid: Vec<Point> = shape.iter().map(|p| q.undo(*p)).collect();
        let along = |mode: &Vec<f32>| {
            let (mx, my) = mode.split_at(self.count);
            let (cx, cy) = self.mean.split_at(self.count);
            (0..self.count)
                .map(|i| {
                    f64::from(mx[i]) * (laid[i].x - f64::from(cx[i]))
                        + f64::from(my[i]) * (laid[i].y - f64::from(cy[i]))
                })
                .sum()
        };
        Some((q, self.modes.iter().map(along).collect()))
    }

    /// Brings a shape onto the model with its first `use_modes` modes: the nearest similarity, and along the modes no
    /// farther than [`REACH`]. Where it has no extent it is left as it is, and this is false.
    pub(super) fn project(&self, xs: &mut [f32], ys: &mut [f32], use_modes: usize, state: &mut State) -> bool {
        let n = self.count as f32;
        let (mx, my) = self.mean.split_at(self.count);
        let tx = xs.iter().sum::<f32>() / n;
        let ty = ys.iter().sum::<f32>() / n;
        let (mut re, mut im) = (0.0_f32, 0.0_f32);
        for (((x, y), cx), cy) in xs.iter().zip(ys.iter()).zip(mx).zip(my) {
            let (x, y) = (x - tx, y - ty);
            re += cx * x + cy * y;
            im += cx * y - cy * x;
        }
        re /= self.square;
        im /= self.square;
        let square = re * re + im * im;
        // Also false for what is no number.
        if !(square > 1e-6 && square < 1e12) {
            return false;
        }
        state.a = re;
        state.b = im;
        state.at = [tx, ty];
        for (((x, y), cx), cy) in xs.iter_mut().zip(ys.iter_mut()).zip(mx).zip(my) {
            let (dx, dy) = (*x - tx, *y - ty);
            *x = (dx * re + dy * im) / square - cx;
            *y = (dy * re - dx * im) / square - cy;
        }
        state.along.iter_mut().for_each(|p| *p = 0.0);
        for ((mode, sd), p) in self.modes.iter().zip(&self.deviations).zip(&mut state.along).take(use_modes) {
            let (ux, uy) = mode.split_at(self.count);
            let along: f32 = ux.iter().zip(xs.iter()).chain(uy.iter().zip(ys.iter())).map(|(m, v)| m * v).sum();
            *p = along.clamp(-REACH * sd, REACH * sd);
        }
        self.place(state, use_modes, xs, ys);
        true
    }

    /// The shape that a state stands for.
    pub(super) fn place(&self, state: &State, use_modes: usize, xs: &mut [f32], ys: &mut [f32]) {
        let (mx, my) = self.mean.split_at(self.count);
        xs.copy_from_slice(mx);
        ys.copy_from_slice(my);
        for (mode, p) in self.modes.iter().zip(&state.along).take(use_modes) {
            let (ux, uy) = mode.split_at(self.count);
            xs.iter_mut().zip(ux).for_each(|(x, u)| *x += p * u);
            ys.iter_mut().zip(uy).for_each(|(y, u)| *y += p * u);
        }
        let (a, b, [tx, ty]) = (state.a, state.b, state.at);
        for (x, y) in xs.iter_mut().zip(ys.iter_mut()) {
            (*x, *y) = (a * *x - b * *y + tx, b * *x + a * *y + ty);
        }
    }
}

/// A shape's pose and its place along the modes, as the fit has it.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct State {
    pub a: f32,
    pub b: f32,
    pub at: [f32; 2],
    pub along: Vec<f32>,
}

impl State {
    /// Pixels in a width of the mean shape.
    pub(crate) fn scale(&self) -> f32 {
        self.a.hypot(self.b)
    }
}

/// What a similarity does to a mean, as four vectors of length 1, orthogonal to each other: it grows, turns, moves
/// along x and along y.
pub(super) fn similar(mean: &[f64]) -> [Vec<f64>; 4] {
    let n = mean.len() / 2;
    let (x, y) = mean.split_at(n);
    let length = dot(mean, mean).sqrt().max(1e-12);
    let one = 1.0 / (n as f64).sqrt();
    [
        mean.iter().map(|v| v / length).collect(),
        y.iter().map(|v| -v / length).chain(x.iter().map(|v| v / length)).collect(),
        (0..2 * n).map(|i| if i < n { one } else { 0.0 }).collect(),
        (0..2 * n).map(|i| if i < n { 0.0 } else { one }).collect(),
    ]
}

/// The directions in which rows vary about the origin, of length 1, with the sum of squares along each; so many that
/// they hold `share` of all, at most `most`. By way of the products of the rows with each other, which are few.
pub(super) fn principal(rows: &[Vec<f64>], share: f64, most: usize) -> Vec<(Vec<f64>, f64)> {
    let m = rows.len();
    let products = DMatrix::from_fn(m, m, |i, j| dot(&rows[i], &rows[j]));
    let total = products.trace();
    let eigen = SymmetricEigen::new(products);
    let mut order: Vec<usize> = (0..m).collect();
    order.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
    let mut found = Vec::new();
    let mut held = 0.0;
    for k in order.into_iter().take(most) {
        let square = eigen.eigenvalues[k];
        if !(square > 1e-9 * total && total > 0.0) || held >= share * total {
            break;
        }
        held += square;
        let mut mode = vec![0.0; rows[0].len()];
        for (row, weight) in rows.iter().zip(eigen.eigenvectors.column(k).iter()) {
            mode.iter_mut().zip(row).for_each(|(v, r)| *v += weight * r);
        }
        let length = dot(&mode, &mode).sqrt();
        // The sign of an eigenvector is nobody's choice; the largest number shall be positive.
        let largest = mode.iter().fold(0.0_f64, |l, v| if v.abs() > l.abs() { *v } else { l });
        let by = largest.signum() / length.max(1e-300);
        mode.iter_mut().for_each(|v| *v *= by);
        found.push((mode, square));
    }
    found
}

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn points(vector: &[f32]) -> Vec<Point> {
    let (x, y) = vector.split_at(vector.len() / 2);
    x.iter().zip(y).map(|(x, y)| Point::new(f64::from(*x), f64::from(*y))).collect()
}

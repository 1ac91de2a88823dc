//! How much of each emotion a shape shows (paper eq. 6).
//!
//! With E1 the neutral shape, `S − E1 = Σ αi (Ei − E1)` over the six others is solved by least squares with the SVD's
//! pseudo-inverse, once for a calibration; `α1 = 1 − Σ αi`. Points may weigh differently ([`Decomposition::weighed`]),
//! and movements that are no emotion may be told apart ([`Decomposition::apart_from`]); the paper has neither.

mod simplex;

use nalgebra::{DMatrix, DVector};

use crate::disk::{Fault, FileFault, Result};
use crate::geometry::Point;
use crate::pose::{Emotion, Ratios};
use simplex::nearest_mix;

/// Which of the solutions of eq. 6.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Choice {
    /// The paper's: least squares, negative ratios kept.
    #[default]
    Paper,
    /// The nearest mix without a negative ratio: least squares over all mixes of the seven that sum to 1.
    NonNegative,
}

/// What a shape shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading {
    /// The seven; they sum to 1.
    pub ratios: Ratios,
    /// What neither a mix of the seven nor a known other movement explains: root mean square over the points, in the
    /// units of the shapes. Infinite for a shape that has no finite points.
    pub rest: f64,
}

/// The seven shapes made ready: the SVD of their differences to the neutral one, once for a calibration.
#[derive(Debug, Clone)]
pub struct Decomposition {
    neutral: DVector<f64>,
    /// The six differences to the neutral shape, as columns.
    differences: DMatrix<f64>,
    /// How the misfits of coordinates count.
    metric: Metric,
    /// From a difference to the neutral shape to the six ratios.
    inverse: DMatrix<f64>,
    /// From a difference to the neutral shape to the normal equations' right side, and their left side.
    pull: DMatrix<f64>,
    gram: [[f64; 6]; 6],
    singular: [f64; 6],
}

/// Singular values below this share of the largest are cut: the shapes of a calibration are known to about a
/// thousandth of their differences at best, so that what lies below is chance.
const CUT: f64 = 1e-3;

impl Decomposition {
    /// From the seven shapes in canonical order, laid over each other.
    ///
    /// # Errors
    /// When they have different numbers of points, points that are not finite, or are all alike.
    pub fn new(shapes: &[Vec<Point>; 7]) -> Result<Self> {
        let n = shapes[0].len();
        if n == 0 || shapes.iter().any(|s| s.len() != n) {
            return Err(Fault::of(FileFault::Mismatch, "the seven shapes have different numbers of points"));
        }
        if shapes.iter().flatten().any(|p| !p.is_finite()) {
            return Err(Fault::of(FileFault::Mismatch, "a point of the seven shapes is no finite number"));
        }
        let neutral = flat(&shapes[0]);
        let columns: Vec<_> = shapes[1..].iter().map(|s| flat(s) - &neutral).collect();
        Self::of(neutral, DMatrix::from_columns(&columns), Metric::plain(n))
    }

    fn of(neutral: DVector<f64>, differences: DMatrix<f64>, metric: Metric) -> Result<Self> {
        let seen = metric.apply(differences.clone());
        let svd = seen.clone().svd(true, true);
        let largest = svd.singular_values.max();
        if largest <= 1e-12 {
            return Err(Fault::of(FileFault::Mismatch, "the seven shapes are all alike"));
        }
        let mut singular = [0.0; 6];
        // A model of one or two points has fewer values than emotions; the others are 0.
        for (to, value) in singular.iter_mut().zip(svd.singular_values.iter()) {
            *to = *value;
        }
        singular.sort_by(|a, b| b.total_cmp(a));
        let (Some(u), Some(vt)) = (&svd.u, &svd.v_t) else {
            return Err(Fault::of(FileFault::Mismatch, "the seven shapes cannot be taken apart"));
        };
        let mut shares = vt.transpose();
        for (mut column, value) in shares.column_iter_mut().zip(svd.singular_values.iter()) {
            column *= if *value > CUT * largest { 1.0 / value } else { 0.0 };
        }
        let inverse = metric.apply_left(&times(&shares, &u.transpose()));
        let pull = metric.apply_left(&seen.transpose());
        let product = times(&seen.transpose(), &seen);
        let gram = std::array::from_fn(|i| std::array::from_fn(|j| product[(i, j)]));
        Ok(Self { neutral, differences, metric, inverse, pull, gram, singular })
    }

    /// The same with points that weigh differently: those that are found less surely, or that speech moves, may weigh
    /// less. Weights are scaled to a mean of 1. Pure and mixed shapes are read as exactly as before.
    ///
    /// # Errors
    /// When there is not a weight for each point, one is negative or not finite, or too many are 0 to tell anything.
    pub fn weighed(&self, weights: &[f64]) -> Result<Self> {
        let n = self.neutral.len() / 2;
        let sum: f64 = weights.iter().sum();
        if weights.len() != n || weights.iter().any(|w| !w.is_finite() || *w < 0.0) || sum <= 0.0 {
            return Err(Fault::new("each point needs a weight that is not negative"));
        }
        let roots = weights.iter().flat_map(|w| [(w * n as f64 / sum).sqrt(); 2]);
        let metric = Metric { roots: DVector::from_iterator(2 * n, roots), ..self.metric.clone() };
        Self::of(self.neutral.clone(), self.differences.clone(), metric)
    }

    /// The same, with movements told apart that are no emotion: the shapes of speech or of a blink, as whole shapes laid
    /// over the seven. A shape is then read as `Σ αi (Ei − E1) + Σ βk Dk` + noise, where each βk is about 1 at most
    /// (a ridge: Gaussian of deviation 1) and the noise of each coordinate about `noise`, in the units of the shapes.
    ///
    /// The ratios are the best linear unbiased ones (Aitken 1935): mixes of the seven without other movement are read as
    /// exactly as before.
    ///
    /// # Errors
    /// When a shape has another number of points or points that are not finite, or `noise` is not above 0.
    pub fn apart_from(&self, shapes: &[Vec<Point>], noise: f64) -> Result<Self> {
        let n = self.neutral.len() / 2;
        if !noise.is_finite() || noise <= 0.0 {
            return Err(Fault::of(FileFault::OutOfRange, "the noise of points must be above 0"));
        }
        if shapes.iter().any(|s| s.len() != n || s.iter().any(|p| !p.is_finite())) {
            return Err(Fault::of(FileFault::Mismatch, "a shape to tell apart has other points than the seven"));
        }
        let metric = if shapes.is_empty() {
            Metric { apart: None, ..self.metric.clone() }
        } else {
            let columns: Vec<_> =
                shapes.iter().map(|s| (flat(s) - &self.neutral).component_mul(&self.metric.roots)).collect();
            Metric { apart: Some(Apart::new(DMatrix::from_columns(&columns), noise)?), ..self.metric.clone() }
        };
        Self::of(self.neutral.clone(), self.differences.clone(), metric)
    }

    /// The ratios of a shape that is laid over the seven. A shape of another number of points, or that is not finite,
    /// shows nothing: neutral, with an infinite rest.
    #[must_use]
    pub fn read(&self, shape: &[Point], choice: Choice) -> Reading {
        if 2 * shape.len() != self.neutral.len() || shape.iter().any(|p| !p.is_finite()) {
            return Reading { ratios: Ratios::NEUTRAL, rest: f64::INFINITY };
        }
        let s = flat(shape) - &self.neutral;
        let solved = &self.inverse * &s;
        let mut alpha: [f64; 6] = std::array::from_fn(|i| solved[i]);
        let outside = alpha.iter().any(|a| *a < 0.0) || alpha.iter().sum::<f64>() > 1.0;
        if choice == Choice::NonNegative && outside {
            let right = &self.pull * &s;
            alpha = nearest_mix(&self.gram, &std::array::from_fn(|i| right[i]));
        }
        let left = &self.differences * DVector::from_column_slice(&alpha) - s;
        let rest = self.metric.apply(DMatrix::from_columns(&[left])).norm() / (shape.len() as f64).sqrt();
        let mut ratios = [0.0; 7];
        ratios[1..].copy_from_slice(&alpha);
        let ratios = Ratios(ratios).closed();
        Reading {
            ratios: if choice == Choice::NonNegative { Ratios(ratios.0.map(|r| r.max(0.0))) } else { ratios },
            rest,
        }
    }

    /// How unevenly the seven can be told: the largest singular value of their differences over the smallest. Noise
    /// grows up to so many times more in one mix than in another; infinite where some mix cannot be told at all.
    #[must_use]
    pub fn condition(&self) -> f64 {
        if self.singular[5] > 0.0 { self.singular[0] / self.singular[5] } else { f64::INFINITY }
    }

    /// How much the error of a ratio is, for an error of 1 in each coordinate of a shape (root mean square, each on its
    /// own), by emotion; neutral's first. The worst of them says which shot to take again.
    #[must_use]
    pub fn amplification(&self) -> [f64; 7] {
        let row = |i: usize| self.inverse.row(i).norm();
        let neutral = (0..self.inverse.ncols()).map(|j| self.inverse.column(j).sum().powi(2)).sum::<f64>().sqrt();
        std::array::from_fn(|i| if i == 0 { neutral } else { row(i - 1) })
    }

    /// The angle between the directions in which two emotions move the points, in degrees from 0 (alike but for strength)
    /// to 180 (opposite). None with neutral, which has no direction, with itself, and of a shape that does not move.
    #[must_use]
    pub(crate) fn angle(&self, a: Emotion, b: Emotion) -> Option<f64> {
        let (i, j) = (a.index().checked_sub(1)?, b.index().checked_sub(1)?);
        let size = (self.gram[i][i] * self.gram[j][j]).sqrt();
        let is_told = i != j && size > 1e-24;
        is_told.then(|| (self.gram[i][j] / size).clamp(-1.0, 1.0).acos().to_degrees())
    }

    /// Pairs of emotions with the `angle` between them, the hardest to tell apart first.
    #[must_use]
    pub fn alike(&self) -> Vec<(Emotion, Emotion, f64)> {
        let mut pairs = Vec::with_capacity(15);
        for (i, a) in Emotion::ALL.into_iter().enumerate() {
            let rest = Emotion::ALL[i + 1..].iter();
            pairs.extend(rest.filter_map(|b| Some((a, *b, self.angle(a, *b)?))));
        }
        pairs.sort_by(|a, b| a.2.total_cmp(&b.2));
        pairs
    }
}

fn flat(shape: &[Point]) -> DVector<f64> {
    DVector::from_iterator(2 * shape.len(), shape.iter().flat_map(|p| [p.x, p.y]))
}

/// How misfits of coordinates count: `W = (1 − U diag(less) Uᵀ) diag(roots)`, and least squares minimises `|W(Dα − s)|²`.
#[derive(Debug, Clone)]
struct Metric {
    /// Square roots of the coordinates' weights.
    roots: DVector<f64>,
    apart: Option<Apart>,
}

/// Directions in which a misfit counts less, because other movements go there.
#[derive(Debug, Clone)]
struct Apart {
    /// Orthonormal columns.
    directions: DMatrix<f64>,
    /// How much less, 0 to 1, each.
    less: DVector<f64>,
}

impl Apart {
    /// The root of the inverse of the noise's covariance `noise² 1 + D Dᵀ`, times the noise.
    fn new(movements: DMatrix<f64>, noise: f64) -> Result<Self> {
        let svd = movements.svd(true, false);
        let directions =
            svd.u.ok_or_else(|| Fault::of(FileFault::OutOfRange, "the shapes to tell apart cannot be taken apart"))?;
        let less = svd.singular_values.map(|s| 1.0 - 1.0 / (1.0 + (s / noise).powi(2)).sqrt());
        Ok(Self { directions, less })
    }
}

impl Metric {
    fn plain(points: usize) -> Self {
        Self { roots: DVector::from_element(2 * points, 1.0), apart: None }
    }

    /// `W` times columns.
    fn apply(&self, mut columns: DMatrix<f64>) -> DMatrix<f64> {
        self.scale(&mut columns);
        self.lessen(&mut columns);
        columns
    }

    /// Rows times `W`.
    fn apply_left(&self, rows: &DMatrix<f64>) -> DMatrix<f64> {
        let mut columns = rows.transpose();
        self.lessen(&mut columns);
        self.scale(&mut columns);
        columns.transpose()
    }

    fn scale(&self, columns: &mut DMatrix<f64>) {
        for mut column in columns.column_iter_mut() {
            column.component_mul_assign(&self.roots);
        }
    }

    fn lessen(&self, columns: &mut DMatrix<f64>) {
        let Some(apart) = &self.apart else { return };
        for mut column in columns.column_iter_mut() {
            for (direction, less) in apart.directions.column_iter().zip(apart.less.iter()) {
                // The directions are orthogonal, so that one after the other is all at once.
                let along = direction.dot(&column);
                column.axpy(-less * along, &direction, 1.0);
            }
        }
    }
}

/// A product whose sums have one order on every processor, which the library's own has not.
fn times(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    DMatrix::from_fn(a.nrows(), b.ncols(), |i, j| (0..a.ncols()).map(|k| a[(i, k)] * b[(k, j)]).sum())
}

//! The shapes that faces have: a mean and the ways in which they differ from it (Cootes and Taylor 1995).

use nalgebra::{DMatrix, DVector};

use super::weights::{Matrix, Reader, Writer};
use crate::geometry::{Point, Similarity, Vec2};

/// Mean and modes, in the face frame.
#[derive(Debug, Clone, PartialEq)]
pub struct ShapeModel {
    /// The mean place of each point: first those of the 47 that are learned, in their order, then further ones that
    /// steady the fit.
    pub mean: Vec<Point>,
    /// Each row is a mode, x and y of each point in turn, of length 1. The first four turn, scale and move the mean.
    pub modes: Matrix,
    /// How far people differ along each mode, one standard deviation.
    pub spread: Vec<f32>,
    /// The points by which a frame is fitted: those whose places vary least from face to face.
    pub steady: Vec<usize>,
}

impl ShapeModel {
    /// Points in a shape.
    #[must_use]
    pub fn count(&self) -> usize {
        self.mean.len()
    }

    /// The shape moved along the modes.
    pub fn moved(&self, shape: &mut [Point], along: &[f32]) {
        for (row, by) in along.iter().enumerate() {
            for (p, d) in shape.iter_mut().zip(self.modes.row(row).chunks_exact(2)) {
                *p += Vec2::new(f64::from(d[0] * by), f64::from(d[1] * by));
            }
        }
    }

    /// How far a shape lies from another along each mode.
    #[must_use]
    pub fn along(&self, from: &[Point], to: &[Point]) -> Vec<f32> {
        let off: Vec<f32> = from.iter().zip(to).flat_map(|(f, t)| [(t.x - f.x) as f32, (t.y - f.y) as f32]).collect();
        (0..self.modes.rows).map(|n| super::weights::dot(self.modes.row(n), &off)).collect()
    }

    /// The similarity that lays the mean on a shape, by the steady points.
    #[must_use]
    pub fn frame_of(&self, shape: &[Point]) -> Similarity {
        let pick = |points: &[Point]| self.steady.iter().map(|i| points[*i]).collect::<Vec<_>>();
        Similarity::between(&pick(&self.mean), &pick(shape)).unwrap_or(Similarity::new(Point::ORIGIN, 1.0, 0.0))
    }

    /// A shape bent so that some of its points come to lie where they are known to be, the others following as the
    /// modes say: the mean of a Gaussian given those points. `fixed` holds which point, where, and how many pupil
    /// distances that may be off; `loose` is how far, in shares of people's differences, the rest may follow: 1 for
    /// a mean shape, less for one already fitted.
    #[must_use]
    pub(crate) fn given(&self, shape: &[Point], fixed: &[(usize, Point, f64)], loose: f64) -> Vec<Point> {
        let mut bent = shape.to_vec();
        if fixed.is_empty() {
            return bent;
        }
        let rows = 2 * fixed.len();
        let k = self.modes.rows;
        let mut at = DMatrix::zeros(rows, k);
        let mut off = DVector::zeros(rows);
        let mut noise = DVector::zeros(rows);
        for (n, (point, place, slack)) in fixed.iter().enumerate() {
            let by = *place - shape[*point];
            for (axis, d) in [by.x, by.y].into_iter().enumerate() {
                let row = 2 * n + axis;
                off[row] = d;
                noise[row] = slack * slack + 1e-6;
                for m in 0..k {
                    let free = f64::from(self.spread[m]) * loose;
                    at[(row, m)] = f64::from(self.modes.row(m)[2 * point + axis]) * free;
                }
            }
        }
        let mut covariance = &at * at.transpose();
        (0..rows).for_each(|i| covariance[(i, i)] += noise[i]);
        let Some(solved) = covariance.cholesky().map(|c| c.solve(&off)) else { return bent };
        let along = at.transpose() * solved;
        let along: Vec<f32> = (0..k).map(|m| along[m] as f32 * self.spread[m] * loose as f32).collect();
        self.moved(&mut bent, &along);
        bent
    }

    /// Into bytes.
    pub(crate) fn write(&self, out: &mut Writer) {
        out.numbers(&self.mean.iter().flat_map(|p| [p.x as f32, p.y as f32]).collect::<Vec<_>>());
        out.matrix(&self.modes);
        out.numbers(&self.spread);
        out.numbers(&self.steady.iter().map(|i| *i as f32).collect::<Vec<_>>());
    }

    /// From bytes.
    pub(crate) fn read(bytes: &mut Reader) -> Option<Self> {
        let mean = bytes.numbers()?;
        let mean = mean.chunks_exact(2).map(|p| Point::new(f64::from(p[0]), f64::from(p[1]))).collect();
        let (modes, spread) = (bytes.matrix()?, bytes.numbers()?);
        let steady = bytes.numbers()?.iter().map(|i| *i as usize).collect();
        Some(Self { mean, modes, spread, steady })
    }
}

//! How much of each emotion a shape shows (paper eq. 6).

use nalgebra::{DMatrix, DVector};

use crate::disk::{Fault, Result};
use crate::geometry::Point;
use crate::pose::Ratios;

/// Which of the solutions of eq. 6.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Choice {
    /// The paper's: least squares, negative ratios kept.
    #[default]
    Paper,
    /// The nearest mix without a negative ratio.
    NonNegative,
}

/// What a shape shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading {
    /// The seven; they sum to 1.
    pub ratios: Ratios,
    /// What no mix of the seven explains: root mean square over the points, in the units of the shapes.
    pub rest: f64,
}

/// The seven shapes made ready: the SVD of their differences to the neutral one, once for a calibration.
#[derive(Debug, Clone)]
pub struct Decomposition {
    neutral: DVector<f64>,
    differences: DMatrix<f64>,
    inverse: DMatrix<f64>,
}

/// Singular values below this share of the largest are cut.
const CUT: f64 = 1e-3;

impl Decomposition {
    /// From the seven shapes in canonical order, laid over each other.
    ///
    /// # Errors
    /// When they have different numbers of points, or all are alike.
    pub fn new(shapes: &[Vec<Point>; 7]) -> Result<Self> {
        let n = shapes[0].len();
        if n == 0 || shapes.iter().any(|s| s.len() != n) {
            return Err(Fault::new("the seven shapes have different numbers of points"));
        }
        let flat = |s: &[Point]| DVector::from_iterator(2 * n, s.iter().flat_map(|p| [p.x, p.y]));
        let neutral = flat(&shapes[0]);
        let columns: Vec<_> = shapes[1..].iter().map(|s| flat(s) - &neutral).collect();
        let differences = DMatrix::from_columns(&columns);
        let svd = differences.clone().svd(true, true);
        let largest = svd.singular_values.max();
        if largest <= 0.0 {
            return Err(Fault::new("the seven shapes are all alike"));
        }
        let inverse = svd.pseudo_inverse(CUT * largest).map_err(Fault::new)?;
        Ok(Self { neutral, differences, inverse })
    }

    /// The ratios of a shape that is laid over the seven.
    #[must_use]
    pub fn read(&self, shape: &[Point], _choice: Choice) -> Reading {
        let s = DVector::from_iterator(self.neutral.len(), shape.iter().flat_map(|p| [p.x, p.y])) - &self.neutral;
        let alpha = &self.inverse * &s;
        let rest = (&self.differences * &alpha - s).norm() / (shape.len() as f64).sqrt();
        let mut ratios = [0.0; 7];
        ratios[1..].copy_from_slice(alpha.as_slice());
        Reading { ratios: Ratios(ratios).closed(), rest }
    }
}

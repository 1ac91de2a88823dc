//! How usual each point of a face looks, and how far that and the starts of the fit tell that it is off.

use super::cascade::{Spread, Stage};
use super::weights::{Matrix, Reader, Writer};
use crate::geometry::Point;

/// What faces look like at each point, and what follows for a point that looks otherwise.
#[derive(Debug, Clone, PartialEq)]
pub struct Looks {
    /// The mean short descriptor of each point, as the first fine stage shortens it; a row a point.
    pub usual: Matrix,
    /// One over the standard deviation of each of its numbers.
    pub sharpness: Matrix,
    /// The logarithm of each learned point's usual error, in pupil distances, less what the next two add on average.
    pub base: Vec<f32>,
    /// What the logarithms of the spread between starts and of the strangeness add.
    pub slopes: Vec<f32>,
}

impl Looks {
    /// How strange each point of a shape looks: the mean square of its descriptor's numbers in standard deviations.
    /// 1 is usual.
    #[must_use]
    pub fn strangeness(&self, stage: &Stage, chip: &Spread, shape: &[Point]) -> Vec<f32> {
        let sites: Vec<usize> = (0..shape.len()).collect();
        let mut short = Vec::new();
        stage.describe(chip, shape, &sites, &mut short);
        short
            .chunks_exact(stage.basis.rows)
            .enumerate()
            .map(|(n, numbers)| {
                let (usual, sharp) = (self.usual.row(n), self.sharpness.row(n));
                let square = |((v, m), s): ((&f32, &f32), &f32)| ((v - m) * s).powi(2);
                numbers.iter().zip(usual).zip(sharp).map(square).sum::<f32>() / numbers.len() as f32
            })
            .collect()
    }

    /// The error to be expected of a learned point, in pupil distances.
    #[must_use]
    pub fn expected(&self, point: usize, spread: f32, strangeness: f32) -> f64 {
        let [by_spread, by_strangeness] = self.features(spread, strangeness);
        let sum = self.base[point] + self.slopes[0] * by_spread + self.slopes[1] * by_strangeness;
        f64::from(sum.exp())
    }

    /// The logarithms that the error is told from; a spread below a thousandth of a pupil distance says no more.
    #[must_use]
    pub fn features(&self, spread: f32, strangeness: f32) -> [f32; 2] {
        [(spread + 0.001).ln(), strangeness.max(0.1).ln()]
    }

    /// Into bytes.
    pub(crate) fn write(&self, out: &mut Writer) {
        out.matrix(&self.usual);
        out.matrix(&self.sharpness);
        out.numbers(&self.base);
        out.numbers(&self.slopes);
    }

    /// From bytes.
    pub(crate) fn read(bytes: &mut Reader) -> Option<Self> {
        Some(Self {
            usual: bytes.matrix()?,
            sharpness: bytes.matrix()?,
            base: bytes.numbers()?,
            slopes: bytes.numbers()?,
        })
    }
}

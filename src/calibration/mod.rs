//! A person's calibration: the shapes of the seven emotions, from marked shots, found points or the rig, and how a shape
//! is decomposed into the ratios of them (paper sec. 3, eq. 6).
//!
//! Photos of emotions go in, with the points of their annotations where there are any; a [`Calibration`] and its
//! [`Quality`] come out, kept in a face's folder by [`Kept`]. The ratios over time are the business of `ratios`.

mod binding;
mod calibrate;
mod closer;
mod decompose;
mod expressions;
mod file;
mod files;
mod finding;
mod inputs;
mod kept;
mod known;
mod marks;
mod movements;
mod moves;
mod patches;
mod person;
mod quality;
mod settle;
mod spread;
mod warped;

pub use binding::Binding;
pub use calibrate::{Calibrated, calibrate};
pub use decompose::{Choice, Decomposition, Reading};
pub use file::CalibrationFile;
pub use files::ShotFiles;
pub(crate) use files::{sum_of_face, sum_of_marks};
pub use inputs::Inputs;
pub(crate) use kept::CALIBRATION;
pub use kept::Kept;
pub use marks::Marks;
pub use quality::{Quality, Retake, ShotQuality};

use crate::disk::{Fault, FileFault, Result};
use crate::face::FeaturePoint as P;
use crate::geometry::{Point, Similarity};

/// How the shape of an emotion came to be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Source {
    /// Somebody marked its points, all or those that were wrong.
    Marked,
    /// The points were found in its photo, this surely (0 to 1).
    Found(f64),
    /// There is no photo of it: it is the neutral shape, moved as the rig moves a face.
    Modelled,
}

/// The shape of one emotion.
#[derive(Debug, Clone, PartialEq)]
pub struct Shape {
    /// Its points: pixels of its photo, or of the neutral one where it is modelled.
    pub points: Vec<Point>,
    /// How it came to be.
    pub source: Source,
}

/// A person's seven shapes (paper sec. 3.2), and how named points hang on theirs.
#[derive(Debug, Clone)]
pub struct Calibration {
    shapes: [Shape; 7],
    binding: Binding,
    /// The shapes in the frame of the neutral one's pupils: distance 1, origin midway, laid over it.
    laid: [Vec<Point>; 7],
    decomposition: Decomposition,
    /// The same with movements told apart that are no emotion.
    apart: Decomposition,
}

/// How far points are off that movements are told apart by, in pupil distances.
const NOISE: f64 = 0.03;

impl Calibration {
    /// From the seven shapes in canonical order.
    ///
    /// # Errors
    /// When they have different numbers of points, all are alike, or the neutral one's pupils coincide.
    pub fn new(shapes: [Shape; 7], binding: Binding) -> Result<Self> {
        let neutral = &shapes[0].points;
        let (Some(left), Some(right)) = (binding.at(neutral, P::P3_6), binding.at(neutral, P::P3_5)) else {
            return Err(Fault::of(FileFault::Missing, "the eyes of the neutral shape are not known"));
        };
        let across = right - left;
        if across.hypot() < 1e-6 {
            return Err(Fault::new("the pupils of the neutral shape coincide"));
        }
        let frame = Similarity::spanning(left, right);
        let first: Vec<Point> = neutral.iter().map(|p| frame.undo(*p)).collect();
        let mut laid: [Vec<Point>; 7] = Default::default();
        for (to, shape) in laid.iter_mut().zip(&shapes) {
            *to = over(&shape.points, &first)
                .ok_or_else(|| Fault::of(FileFault::Mismatch, "a shape has no extent, or other points"))?;
        }
        let decomposition = Decomposition::new(&laid)?;
        let apart = decomposition.clone();
        let mut own = Self { shapes, binding, laid, decomposition, apart };
        own.apart = own.decomposition.apart_from(&own.movements(), NOISE)?;
        Ok(own)
    }

    /// The shapes as they were given, by emotion.
    #[must_use]
    pub fn shapes(&self) -> &[Shape; 7] {
        &self.shapes
    }

    /// How named points hang on its points.
    #[must_use]
    pub fn binding(&self) -> &Binding {
        &self.binding
    }

    /// The shapes laid over the neutral one, in the frame of its pupils: their distance 1, the origin midway.
    #[must_use]
    pub fn laid(&self) -> &[Vec<Point>; 7] {
        &self.laid
    }

    /// The similarity that lays a shape over the neutral one: the q of eq. 5, which is dropped.
    #[must_use]
    pub(crate) fn lay(&self, shape: &[Point]) -> Option<Similarity> {
        (shape.len() == self.laid[0].len()).then(|| Similarity::between(shape, &self.laid[0]))?
    }

    /// The ratios of a shape in whatever place, turn and size, told apart from what it does besides: speech, blinks,
    /// glances, a turning head. None for another number of points.
    #[must_use]
    pub fn read_apart(&self, shape: &[Point], choice: Choice) -> Option<Reading> {
        let q = self.lay(shape)?;
        let laid: Vec<Point> = shape.iter().map(|p| q.apply(*p)).collect();
        Some(self.apart.read(&laid, choice))
    }

    /// The ratios of a shape in whatever place, turn and size; none for another number of points.
    #[must_use]
    pub fn read(&self, shape: &[Point], choice: Choice) -> Option<Reading> {
        let q = self.lay(shape)?;
        let laid: Vec<Point> = shape.iter().map(|p| q.apply(*p)).collect();
        Some(self.decomposition.read(&laid, choice))
    }
}

/// A shape laid over another by a similarity.
fn over(shape: &[Point], onto: &[Point]) -> Option<Vec<Point>> {
    if shape.len() != onto.len() {
        return None;
    }
    let q = Similarity::between(shape, onto)?;
    Some(shape.iter().map(|p| q.apply(*p)).collect())
}

//! A trained model.

use super::align::align;
use super::detected::Detected;
use super::level::{Level, Look};
use super::mesh::triangles;
use super::shape::Shapes;
use super::skirt::{border, skirted};
use super::trust::Trust;
use crate::face::find::Found;
use crate::geometry::{Point, Similarity};

/// A trained active appearance model, ready to fit.
#[derive(Debug, Clone)]
pub struct Model {
    pub(super) shapes: Shapes,
    pub(super) triangles: Vec<[usize; 3]>,
    /// From coarse to fine, as they are stored and as they are used.
    pub(super) stored: Vec<Look>,
    pub(super) levels: Vec<Level>,
    pub(super) trust: Trust,
    pub(super) detected: Option<Detected>,
    /// Which points lie on the border and have another outside; those come after the marked ones in every shape.
    pub(super) border: Vec<usize>,
    /// Whether shape and look are fitted at once.
    pub(super) simultaneous: bool,
}

/// What a model is made of.
#[derive(Debug, Clone)]
pub(super) struct Parts {
    pub shapes: Shapes,
    pub stored: Vec<Look>,
    pub trust: Trust,
    pub detected: Option<Detected>,
    pub border: Vec<usize>,
    pub simultaneous: bool,
}

/// How much farther from the middle the points outside the border lie.
const OUTSIDE: f64 = 0.16;

impl Model {
    /// Puts parts together; none where they do not belong together.
    pub(super) fn of(parts: Parts) -> Option<Self> {
        let Parts { shapes, stored, trust, detected, border, simultaneous } = parts;
        let marked = shapes.count().checked_sub(border.len()).filter(|n| *n >= 3)?;
        if border.iter().any(|i| *i >= marked) {
            return None;
        }
        let triangles = triangles(&shapes.mean());
        let ready = |look| Level::new(&shapes, &triangles, look);
        let levels = stored.iter().map(ready).collect::<Option<Vec<_>>>()?;
        let whole = !levels.is_empty() && !triangles.is_empty();
        whole.then_some(Self { shapes, triangles, stored, levels, trust, detected, border, simultaneous })
    }

    /// How many points were marked, and are found.
    #[must_use]
    pub fn count(&self) -> usize {
        self.shapes.count() - self.border.len()
    }

    /// A shape with the points outside its border.
    pub(super) fn skirted(&self, points: &[Point]) -> Vec<Point> {
        skirted(points, &self.border, OUTSIDE)
    }

    /// The shapes with the points outside their borders, and which points those are of.
    pub(super) fn with_skirts(shapes: &[Vec<Point>]) -> Option<(Vec<Vec<Point>>, Vec<usize>)> {
        let border = border(&align(shapes)?.mean);
        Some((shapes.iter().map(|s| skirted(s, &border, OUTSIDE)).collect(), border))
    }

    /// How its shapes vary: the marked points first, then those outside the border where it has some.
    #[must_use]
    pub fn shapes(&self) -> &Shapes {
        &self.shapes
    }

    /// The triangles of its points, as three of their numbers each.
    #[must_use]
    pub(crate) fn triangles(&self) -> &[[usize; 3]] {
        &self.triangles
    }

    /// How many pixels of the mean shape are compared at the finest level, and how many parameters are fitted there.
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        self.levels.last().map_or([0, 0], |l| [l.table.count(), l.directions.len()])
    }

    /// The pose and the place along the modes of marked points; none for another number of points or without extent.
    #[must_use]
    pub fn describe(&self, points: &[Point]) -> Option<(Similarity, Vec<f64>)> {
        if points.len() != self.count() {
            return None;
        }
        self.shapes.describe(&self.skirted(points))
    }

    /// Where a fit begins in a picture in which a face was found; none where the model was trained on pictures in
    /// which none is.
    #[must_use]
    pub fn start(&self, found: &Found) -> Option<Vec<Point>> {
        let mut points = self.detected.as_ref()?.start(&self.shapes, found)?;
        points.truncate(self.count());
        Some(points)
    }
}

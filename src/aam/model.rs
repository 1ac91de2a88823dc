//! A trained model.

use super::detected::Detected;
use super::fit::{Fit, Fitter, Start};
use super::grey::Grey;
use super::level::{Level, Look};
use super::mesh::triangles;
use super::shape::Shapes;
use super::trust::Trust;
use crate::face::find::Found;
use crate::geometry::Point;

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
}

impl Model {
    /// Puts stored parts together; none where they do not belong together.
    pub(super) fn of(shapes: Shapes, stored: Vec<Look>, trust: Trust, detected: Option<Detected>) -> Option<Self> {
        let triangles = triangles(&shapes.mean());
        let levels = stored.iter().map(|look| Level::new(&shapes, &triangles, look)).collect::<Option<Vec<_>>>()?;
        (!levels.is_empty() && !triangles.is_empty()).then_some(Self { shapes, triangles, stored, levels, trust, detected })
    }

    /// How its shapes vary.
    #[must_use]
    pub fn shapes(&self) -> &Shapes {
        &self.shapes
    }

    /// The triangles of its points, as three of their numbers each.
    #[must_use]
    pub fn triangles(&self) -> &[[usize; 3]] {
        &self.triangles
    }

    /// How many pixels of the mean shape are compared at the finest level, and how many parameters are fitted there.
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        self.levels.last().map_or([0, 0], |l| [l.table.count(), l.directions.len()])
    }

    /// Where a fit begins in a picture in which a face was found; none where the model was trained on pictures in
    /// which none is.
    #[must_use]
    pub fn start(&self, found: &Found) -> Option<Vec<Point>> {
        self.detected.as_ref()?.start(&self.shapes, found)
    }

    /// Finds the shape in a picture; for more than one picture a [`Fitter`] keeps its memory.
    #[must_use]
    pub fn fit(&self, grey: &Grey, start: Start) -> Fit {
        Fitter::new(self).fit(grey, start)
    }
}

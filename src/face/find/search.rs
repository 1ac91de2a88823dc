//! From a photo to the faces in it: windows, rough fits, judged; then close fits, judged again.

use super::cascade::{Chip, Spread, Stage};
use super::detector::BELOW;
use super::fit::{Fit, Known};
use super::{Model, Pyramid};
use crate::geometry::{Point, Similarity};
use crate::photo::Photo;

/// The longer side of the copy of a photo in which faces are looked for.
pub const WORKING_SIDE: usize = 640;
/// The smallest pupil distance that is looked for, in pixels of that copy.
pub const SMALLEST: f64 = 20.0;
/// Windows below this sum are not looked at closer. Cross-validated, faces have 2 and more.
const LEAST: f32 = -1.0;
/// So many windows are.
const MOST: usize = 6;

/// A fit and what the two judges say of it.
#[derive(Debug, Clone)]
pub struct Candidate {
    /// The shape.
    pub fit: Fit,
    /// The detector's sum.
    pub window: f32,
    /// The judge's after the coarse stages.
    pub rough: f32,
    /// The judge's after the fine stages.
    pub close: f32,
    /// How strange each point looks; empty after the coarse stages.
    pub strangeness: Vec<f32>,
}

impl Model {
    /// Rough fits of what may be faces, the best first, no two on one place.
    #[must_use]
    pub fn candidates(&self, picture: &Pyramid, known: &[Known]) -> Vec<Candidate> {
        let hits = self.detector.scan(picture, SMALLEST * picture.step(), LEAST);
        let mut found: Vec<Candidate> =
            hits.iter().take(MOST).map(|h| self.roughly(picture, h.frame, h.score, known)).collect();
        found.sort_by(|a, b| b.rough.total_cmp(&a.rough));
        let mut kept: Vec<Candidate> = Vec::new();
        for candidate in found {
            if kept.iter().all(|k| apart(&k.fit.frame, &candidate.fit.frame)) {
                kept.push(candidate);
            }
        }
        kept
    }

    /// The rough fit from a frame.
    #[must_use]
    pub fn roughly(&self, picture: &Pyramid, frame: Similarity, window: f32, known: &[Known]) -> Candidate {
        let fit = Fit::at(&self.shapes, frame).through(&self.shapes, &self.coarse, picture, known, 1.0);
        let rough = self.judged(0, picture, &fit);
        Candidate { fit, window, rough, close: f32::NEG_INFINITY, strangeness: Vec::new() }
    }

    /// The close fit after a rough one, in the photo itself.
    #[must_use]
    pub fn closely(&self, photo: &Photo, rough: &Candidate, known: &[Known]) -> Candidate {
        let picture = Pyramid::round_face(photo, &rough.fit.frame, self.fine[0][0].scale);
        self.closely_in(&picture, rough, known)
    }

    /// The close fit after a rough one.
    #[must_use]
    pub fn closely_in(&self, picture: &Pyramid, rough: &Candidate, known: &[Known]) -> Candidate {
        let fit = rough.fit.clone().by_all(&self.shapes, &self.fine, picture, known);
        let close = self.judged(1, picture, &fit);
        let strangeness = self.strangeness(picture, &fit);
        Candidate { fit, close, strangeness, window: rough.window, rough: rough.rough }
    }

    /// What a judge says of a fit.
    fn judged(&self, judge: usize, picture: &Pyramid, fit: &Fit) -> f32 {
        let judge = &self.judges[judge];
        let (chip, shape) = self.upright(picture, fit, judge);
        judge.judge(&chip, &shape)
    }

    /// How strange each point of a fit looks.
    #[must_use]
    pub(crate) fn strangeness(&self, picture: &Pyramid, fit: &Fit) -> Vec<f32> {
        let (chip, shape) = self.upright(picture, fit, self.first_look());
        self.looks.strangeness(self.first_look(), &chip, &shape)
    }

    /// The stage whose descriptors the looks are of.
    fn first_look(&self) -> &Stage {
        &self.fine[0][0]
    }

    /// A fit's face upright and of its size, ready for a stage's descriptors.
    fn upright(&self, picture: &Pyramid, fit: &Fit, stage: &Stage) -> (Spread, Vec<Point>) {
        let turn = self.shapes.frame_of(&fit.shape);
        let shape = fit.shape.iter().map(|p| turn.undo(*p)).collect();
        (Chip::of(picture, &fit.frame.after(&turn), stage.scale).spread(stage.cell), shape)
    }
}

/// Whether two frames are of different faces.
pub(crate) fn apart(a: &Similarity, b: &Similarity) -> bool {
    let middle = |f: &Similarity| f.apply(Point::new(0.0, BELOW));
    middle(a).distance(middle(b)) > 0.9 * a.scale().max(b.scale())
}

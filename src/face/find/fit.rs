//! A shape laid on a face, from several starts.

use super::Pyramid;
use super::cascade::{Chip, Stage};
use super::shape::ShapeModel;
use crate::geometry::{Point, Similarity};

/// Points of a shape that are known: which, where in the photo, and by how many pupil distances that may be off.
pub type Known = (usize, Point, f64);

/// A shape as it was found.
#[derive(Debug, Clone)]
pub struct Fit {
    /// Where the face lies in the photo.
    pub frame: Similarity,
    /// The points in the face frame.
    pub shape: Vec<Point>,
    /// How far the several starts ended from each other at each point, in pupil distances: root mean square.
    pub spread: Vec<f32>,
}

/// Starts of a fit: moves right and down, in pupil distances, and turns in radians and sizes that are tried besides
/// the one given.
const STARTS: [[f64; 4]; 5] = [
    [0.0, 0.0, 0.0, 1.0],
    [0.06, 0.0, 0.05, 1.0],
    [-0.06, 0.0, -0.05, 1.0],
    [0.0, 0.06, 0.0, 1.06],
    [0.0, -0.06, 0.0, 0.94],
];
/// What is left of them where the face is already known roughly.
const CLOSE: f64 = 0.4;

impl Fit {
    /// The mean face at a frame.
    #[must_use]
    pub fn at(model: &ShapeModel, frame: Similarity) -> Self {
        Self { frame, shape: model.mean.clone(), spread: vec![0.0; model.count()] }
    }

    /// Runs stages, which look at one chip, from several starts round the shape; `share` is how far apart they are.
    /// Known points pull the others after every stage.
    #[must_use]
    pub fn through(
        mut self,
        model: &ShapeModel,
        stages: &[Stage],
        picture: &Pyramid,
        known: &[Known],
        share: f64,
    ) -> Self {
        let Some(first) = stages.first() else { return self };
        let turn = model.frame_of(&self.shape);
        self.shape.iter_mut().for_each(|p| *p = turn.undo(*p));
        self.frame = self.frame.after(&turn);
        let mut starts: Vec<_> = STARTS.iter().map(|s| jittered(&self.shape, s, share)).collect();
        let chip = Chip::of(picture, &self.frame, first.scale);
        let held: Vec<_> = known.iter().map(|(i, at, slack)| (*i, self.frame.undo(*at), *slack)).collect();
        for stage in stages {
            let spread = chip.spread(stage.cell);
            for shape in &mut starts {
                stage.step(model, &spread, shape);
                *shape = model.given(shape, &held, 0.5);
            }
        }
        self.gather(&starts);
        self
    }

    /// Takes the middle of several shapes.
    fn gather(&mut self, starts: &[Vec<Point>]) {
        let n = starts.len() as f64;
        for (i, (point, spread)) in self.shape.iter_mut().zip(&mut self.spread).enumerate() {
            *point =
                (starts.iter().fold(crate::geometry::Vec2::ZERO, |s, shape| s + shape[i].to_vec2()) / n).to_point();
            let square = starts.iter().map(|shape| shape[i].distance_squared(*point)).sum::<f64>() / n;
            *spread = square.sqrt() as f32;
        }
    }

    /// Runs several chains of stages, each by itself, and takes the middle of what they find. They look at one place
    /// in different ways, so where they disagree none can be trusted much.
    #[must_use]
    pub fn by_all(self, model: &ShapeModel, chains: &[Vec<Stage>], picture: &Pyramid, known: &[Known]) -> Self {
        let each: Vec<Self> = chains.iter().map(|c| self.clone().through(model, c, picture, known, CLOSE)).collect();
        let Some(first) = each.first() else { return self };
        let mut fit = Self { frame: first.frame, ..self };
        let ends: Vec<_> = each.iter().map(|f| f.shape.clone()).collect();
        fit.gather(&ends);
        let within = |i: usize| each.iter().map(|f| f.spread[i] * f.spread[i]).sum::<f32>() / each.len() as f32;
        for (i, spread) in fit.spread.iter_mut().enumerate() {
            *spread = (*spread * *spread + within(i)).sqrt();
        }
        fit
    }

    /// The points in the photo.
    #[must_use]
    pub fn places(&self) -> Vec<Point> {
        self.shape.iter().map(|p| self.frame.apply(*p)).collect()
    }
}

/// A shape as a start has it.
fn jittered(shape: &[Point], start: &[f64; 4], share: f64) -> Vec<Point> {
    let origin = Point::new(start[0] * share, start[1] * share);
    let by = Similarity::new(origin, 1.0 + (start[3] - 1.0) * share, start[2] * share);
    shape.iter().map(|p| by.apply(*p)).collect()
}

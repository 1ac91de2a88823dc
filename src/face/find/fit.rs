//! A shape laid on a face, from several starts.

use super::cascade::{Chip, Stage};
use super::shape::ShapeModel;
use super::{Frame, Pyramid};
use crate::geometry::Point;

/// Points of a shape that are known: which, where in the photo, and by how many pupil distances that may be off.
pub type Known = (usize, Point, f64);

/// A shape as it was found.
#[derive(Debug, Clone)]
pub struct Fit {
    /// Where the face lies in the photo.
    pub frame: Frame,
    /// The points in the face frame.
    pub shape: Vec<Point>,
    /// How far the several starts ended from each other at each point, in pupil distances: root mean square.
    pub spread: Vec<f32>,
}

/// Starts of a fit: moves right and down, in pupil distances, and turns in radians and sizes that are tried besides
/// the one given.
const STARTS: [[f64; 4]; 5] =
    [[0.0, 0.0, 0.0, 1.0], [0.06, 0.0, 0.05, 1.0], [-0.06, 0.0, -0.05, 1.0], [0.0, 0.06, 0.0, 1.06], [
        0.0, -0.06, 0.0, 0.94,
    ]];
/// What is left of them when the chip is cut anew.
const LATER: f64 = 0.4;

impl Fit {
    /// Runs stages on a face that lies near `frame`. Known points pull the others after every stage.
    #[must_use]
    pub fn run(model: &ShapeModel, stages: &[Stage], picture: &Pyramid, frame: Frame, known: &[Known]) -> Self {
        let mut fit = Self { frame, shape: model.mean.clone(), spread: vec![0.0; model.count()] };
        let mut chip: Option<Chip> = None;
        let mut starts: Vec<Vec<Point>> = Vec::new();
        let mut share = 1.0;
        for stage in stages {
            if chip.is_none() || stage.anew {
                fit.gather(&starts);
                fit.straighten(model);
                starts = STARTS.iter().map(|s| jittered(&fit.shape, s, share)).collect();
                share = LATER;
                chip = Some(Chip::of(picture, &fit.frame, stage.scale));
            }
            let Some(spread) = chip.as_ref().map(|c| c.spread(stage.cell)) else { continue };
            let held: Vec<_> = known.iter().map(|(i, at, slack)| (*i, fit.frame.undo(*at), *slack)).collect();
            for shape in &mut starts {
                stage.step(model, &spread, shape);
                *shape = model.given(shape, &held, 0.5);
            }
        }
        fit.gather(&starts);
        fit
    }

    /// Takes the middle of several shapes.
    fn gather(&mut self, starts: &[Vec<Point>]) {
        let n = starts.len() as f64;
        if starts.is_empty() {
            return;
        }
        for (i, (point, spread)) in self.shape.iter_mut().zip(&mut self.spread).enumerate() {
            *point = (starts.iter().fold(crate::geometry::Vec2::ZERO, |s, shape| s + shape[i].to_vec2()) / n).to_point();
            let square = starts.iter().map(|shape| shape[i].distance_squared(*point)).sum::<f64>() / n;
            *spread = square.sqrt() as f32;
        }
    }

    /// Makes the frame that of the shape.
    fn straighten(&mut self, model: &ShapeModel) {
        let turn = model.frame_of(&self.shape);
        self.shape.iter_mut().for_each(|p| *p = turn.undo(*p));
        self.frame = self.frame.after(&turn);
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
    let by = Frame::new(origin, 1.0 + (start[3] - 1.0) * share, start[2] * share);
    shape.iter().map(|p| by.apply(*p)).collect()
}

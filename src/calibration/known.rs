//! A face before its shots are looked at, and a shot whose points are known.

use super::Binding;
use super::inputs::Inputs;
use super::moves::Moves;
use super::spread::Spread;
use crate::disk::{Fault, FileFault, Result};
use crate::face::{FeaturePoint as P, Part};
use crate::geometry::{Point, Similarity, Vec2};
use crate::photo::Grey;

/// What is known of a face before its shots are looked at.
pub(super) struct Ground {
    /// From the frame of the neutral pupils to the pixels of the neutral shot.
    pub frame: Similarity,
    /// The named points in that frame.
    pub named: Vec<(P, Point)>,
    /// The model's points in that frame.
    pub points: Vec<Point>,
    pub moves: Moves,
    /// How named points hang on the model's.
    pub binding: Binding,
    pub spread: Spread,
}

impl Ground {
    pub(crate) fn of(inputs: &Inputs) -> Result<Self> {
        let at = |p: P| inputs.named.iter().find(|(n, _)| *n == p).map(|n| n.1);
        let missing =
            || Fault::of(FileFault::Missing, "the pupils of the neutral photo are not known").help("set 3.6 and 3.5");
        let (left, right) = (at(P::P3_6).ok_or_else(missing)?, at(P::P3_5).ok_or_else(missing)?);
        let across = right - left;
        if across.hypot().is_nan() || across.hypot() <= 1.0 {
            return Err(Fault::new("the pupils of the neutral photo coincide").help("set 3.6 and 3.5 anew"));
        }
        let frame = Similarity::spanning(left, right);
        let named: Vec<(P, Point)> = inputs.named.iter().map(|(p, at)| (*p, frame.undo(*at))).collect();
        let first =
            inputs.shots[0].as_ref().ok_or_else(|| Fault::of(FileFault::Missing, "there is no neutral shot"))?;
        let points: Vec<Point> = first.points.iter().map(|p| frame.undo(p.at)).collect();
        let moves = Moves::of(&named);
        let spread = Spread::new(&inputs.binding, &points, &named);
        Ok(Self { frame, named, points, moves, binding: inputs.binding.clone(), spread })
    }

    /// The model's points when the named ones have moved so, in the frame of the neutral pupils.
    pub(crate) fn moved(&self, moves: &[Vec2]) -> Vec<Point> {
        self.points.iter().zip(self.spread.over(moves)).map(|(p, by)| *p + by).collect()
    }

    /// The part of the face whose named point is nearest to a place.
    pub(crate) fn part_near(&self, at: Point) -> Option<Part> {
        let far = |n: &&(P, Point)| n.1.distance_squared(at);
        self.named.iter().min_by(|a, b| far(a).total_cmp(&far(b))).map(|n| n.0.part())
    }

    /// The ways in which the model's points move: columns of x and y in turns, each one standard deviation.
    pub(crate) fn ways(&self) -> nalgebra::DMatrix<f64> {
        let named = self.moves.ways();
        let columns: Vec<Vec<Vec2>> = named
            .column_iter()
            .map(|c| self.spread.over(&c.as_slice().chunks_exact(2).map(|v| Vec2::new(v[0], v[1])).collect::<Vec<_>>()))
            .collect();
        nalgebra::DMatrix::from_fn(2 * self.points.len(), columns.len(), |r, c| {
            let v = columns[c][r / 2];
            if r % 2 == 0 { v.x } else { v.y }
        })
    }

    /// The same in pixels of the neutral shot.
    pub(crate) fn on_neutral(&self, moves: &[Vec2]) -> Vec<Point> {
        self.moved(moves).into_iter().map(|p| self.frame.apply(p)).collect()
    }
}

/// A shot as far as it is known.
#[derive(Debug, Clone)]
pub(super) struct Known<'a> {
    pub grey: &'a Grey,
    /// From the frame of the neutral pupils to its pixels.
    pub place: Similarity,
    pub points: Vec<Point>,
    /// How far each point may be off, in pupil distances; 0 where a hand has set it.
    pub errors: Vec<f64>,
    pub hands: Vec<bool>,
    pub turned: f64,
    /// How well the person's own look fits there, 0 to 1; 1 of what was marked.
    pub look: f64,
}

impl Known<'_> {
    pub(crate) fn is_marked(&self) -> bool {
        self.hands.iter().all(|h| *h)
    }

    /// How far it can be trusted as a whole, 0 to 1.
    pub(crate) fn confidence(&self) -> f64 {
        let mean = self.errors.iter().sum::<f64>() / self.errors.len().max(1) as f64;
        self.look * trusted(mean)
    }
}

/// The confidence of a point that may be so far off: a half at 6 % of the pupil distance, as for found points.
pub(super) fn trusted(error: f64) -> f64 {
    1.0 / (1.0 + error / 0.06)
}

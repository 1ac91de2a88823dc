//! What a face does besides showing emotions: it speaks, blinks, glances, turns. Ratios are told apart from that.

use super::Calibration;
use super::moves::Moves;
use super::spread::Spread;
use crate::geometry::{Point, Vec2};
use crate::pose::MouthShape;

/// How far a head turns and nods within what a similarity does not explain, in radians.
const TURN: f64 = 0.12;

impl Calibration {
    /// The neutral shape as it speaks, blinks, glances and turns, laid over the seven as they are.
    pub(super) fn movements(&self) -> Vec<Vec<Point>> {
        let neutral = &self.laid()[0];
        let named: Vec<_> =
            self.binding().rows().iter().filter_map(|(p, _)| Some((*p, self.binding().at(neutral, *p)?))).collect();
        let moves = Moves::of(&named);
        let spread = Spread::new(self.binding(), neutral, &named);
        let mut list: Vec<Vec<Vec2>> = MouthShape::ALL.iter().map(|s| moves.mouth(*s, 1.0)).collect();
        list.extend([moves.lids(0.0, 0.0), moves.lids(0.0, 1.0), moves.lids(1.0, 0.0)]);
        list.extend([moves.gaze(0.5, 0.0), moves.gaze(0.0, 0.4)]);
        list.extend([moves.head(TURN, 0.0), moves.head(0.0, TURN)]);
        let shape =
            |by: &Vec<Vec2>| -> Vec<Point> { neutral.iter().zip(spread.over(by)).map(|(p, by)| *p + by).collect() };
        list.iter().map(shape).collect()
    }
}

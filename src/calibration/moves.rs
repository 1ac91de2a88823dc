//! How a person's own points move when the rig moves a face: differences of the rig's poses, in pupil distances, laid
//! on the points as they were marked.

use nalgebra::DMatrix;

use crate::face::rig::{Expression, Expressions, Neutral, Proportions};
use crate::face::{FeaturePoint as P, Part, Points};
use crate::geometry::{Point, Vec2};
use crate::pose::{Emotion, Gaze, Lids, MouthPose, MouthPreset, MouthShape, Pose, Ratios};

/// The rig of a face as it is, without what a drawing changes about it.
const AS_MEASURED: Proportions =
    Proportions { symmetry: 0.0, ear_symmetry: 0.0, eye_width: 1.0, eye_height: 1.0, ..Proportions::NORMAL };

/// How far each part of an expression goes on faces, one standard deviation, in the numbers' own units. The table's
/// numbers are a cartoon's; a face moves about half as far. Parts that move no point are 0.
const SPREAD: [(usize, f64); 12] = [
    (0, 0.03),
    (1, 0.06),
    (2, 0.06),
    (3, 0.05),
    (4, 0.3),
    (5, 0.2),
    (8, 0.2),
    (9, 0.5),
    (10, 0.12),
    (11, 0.25),
    (12, 0.15),
    (13, 0.5),
];
/// How far points stand before the plane of the eyes, in pupil distances: what a head that turns or nods shows.
const fn depth(part: Part) -> f64 {
    match part {
        Part::Brows => 0.08,
        Part::Eyes => 0.0,
        Part::Nose => 0.30,
        Part::Mouth => 0.20,
        Part::Face => -0.25,
        Part::Ears | Part::Hair => -0.8,
    }
}
/// How far a head that looks into the camera turns and nods, in radians, one standard deviation.
const TURN: f64 = 0.07;

/// The moves of a person's points.
#[derive(Debug, Clone)]
pub(crate) struct Moves {
    rig: Neutral,
    rest: Points,
    /// The points as they were marked, in the frame of the pupils.
    places: Vec<(P, Point)>,
}

impl Moves {
    /// Of named points in the frame of the pupils: distance 1, the origin midway. Points that are not given are where
    /// a usual face has them, and only matter to the rig.
    pub(crate) fn of(named: &[(P, Point)]) -> Self {
        let mut all = Points([Point::ORIGIN; P::FIXED]);
        for (p, at) in named {
            all[*p] = (at.to_vec2() * 100.0).to_point();
        }
        let rig = Neutral::of(&all, &AS_MEASURED);
        let rest = rig.express(Expression::of(&Ratios::NEUTRAL), &Pose::default()).points;
        Self { rig, rest, places: named.to_vec() }
    }

    /// How the points move to a pose and an expression, in pupil distances, in the order they were given.
    fn by(&self, expression: Expression, pose: &Pose) -> Vec<Vec2> {
        let posed = self.rig.express(expression, pose).points;
        self.places.iter().map(|(p, _)| (posed[*p] - self.rest[*p]) / 100.0).collect()
    }

    /// To a pose.
    pub(crate) fn pose(&self, pose: &Pose) -> Vec<Vec2> {
        self.by(Expressions::general().mix(&pose.ratios), pose)
    }

    /// To an emotion, as far as faces show it.
    pub(crate) fn emotion(&self, emotion: Emotion) -> Vec<Vec2> {
        self.pose(&Pose::of(Ratios::some(emotion, SHOWN)))
    }

    /// To a mouth shape.
    pub(crate) fn mouth(&self, shape: MouthShape, amount: f64) -> Vec<Vec2> {
        let full = MouthPose::of(shape, MouthPreset::Distinct);
        self.pose(&Pose { mouth: MouthPose::REST.lerp(&full, amount), ..Pose::default() })
    }

    /// To lids so far open.
    pub(crate) fn lids(&self, left: f64, right: f64) -> Vec<Vec2> {
        self.pose(&Pose { lids: Lids { left, right }, ..Pose::default() })
    }

    /// To a glance, in heights of the eye.
    pub(crate) fn gaze(&self, x: f64, y: f64) -> Vec<Vec2> {
        self.pose(&Pose { gaze: Gaze { x, y }, ..Pose::default() })
    }

    /// A head turned to the image's right and nodded down, in radians, as far as that is small.
    pub(crate) fn head(&self, turn: f64, nod: f64) -> Vec<Vec2> {
        let by = |p: &P| Vec2::new(turn, nod) * depth_of(*p);
        self.places.iter().map(|(p, _)| by(p)).collect()
    }

    /// All the ways in which the points may move, each as far as one standard deviation: columns of x and y in turns.
    pub(crate) fn ways(&self) -> DMatrix<f64> {
        let rest = Expression::of(&Ratios::NEUTRAL).to_array();
        let mut list: Vec<Vec<Vec2>> = Vec::new();
        for (part, by) in SPREAD {
            for sign in [1.0, -1.0] {
                let mut numbers = rest;
                numbers[part] += sign * by;
                let whole = self.by(Expression::from_array(numbers), &Pose::default());
                // Two half-hearted ways make one, and a face is a little one-sided.
                let half = |v: &Vec<Vec2>, share: f64| v.iter().map(|v| *v * share).collect::<Vec<_>>();
                for side in [-1.0, 1.0] {
                    let own = |v: &Vec2, p: P| *v * if side_of(p) * side >= 0.0 { 1.0 } else { 0.0 };
                    let one: Vec<Vec2> = whole.iter().zip(&self.places).map(|(v, (p, _))| own(v, *p)).collect();
                    list.push(half(&one, 0.35));
                }
                list.push(half(&whole, 0.7));
            }
        }
        list.extend(Emotion::ALL[1..].iter().map(|e| self.emotion(*e)));
        list.extend(MouthShape::ALL.iter().map(|s| self.mouth(*s, 0.6)));
        list.extend([self.lids(0.3, 1.0), self.lids(1.0, 0.3), self.lids(0.3, 0.3)]);
        list.extend([self.gaze(0.5, 0.0), self.gaze(-0.5, 0.0), self.gaze(0.0, 0.4), self.gaze(0.0, -0.4)]);
        list.extend([self.head(TURN, 0.0), self.head(0.0, TURN)]);
        let rows = 2 * self.places.len();
        DMatrix::from_fn(rows, list.len(), |r, c| {
            let v = list[c][r / 2];
            if r % 2 == 0 { v.x } else { v.y }
        })
    }
}

/// A pupil distance is about 63 mm; the depths of single points that differ from their part's.
fn depth_of(p: P) -> f64 {
    match p {
        P::P9_15 => 0.42,
        P::P9_6 | P::P9_7 => 0.15,
        P::P2_1 => 0.05,
        P::P11_1 => 0.05,
        P::P8_4 | P::P8_3 => 0.12,
        P::P4_6 | P::P4_5 => -0.08,
        P::P3_12 | P::P3_7 => -0.06,
        _ => depth(p.part()),
    }
}

/// −1 of points at the image's left, 1 at its right, 0 in the middle.
pub(super) fn side_of(p: P) -> f64 {
    if p.mirror() == p {
        return 0.0;
    }
    let left = [P::P4_6, P::P4_4A, P::P4_4, P::P4_2, P::P3_12, P::P3_8, P::P3_2, P::P3_4, P::P3_6, P::P9_6, P::P9_14]
        .into_iter()
        .chain([P::P9_2, P::P9_4, P::P8_4, P::P8_9, P::P2_14, P::P11_2, P::P10_2, P::P10_4, P::P10_6]);
    if left.into_iter().any(|l| l == p) { -1.0 } else { 1.0 }
}

/// How much of the cartoon's full emotion a person shows who is asked for it.
const SHOWN: f64 = 0.6;

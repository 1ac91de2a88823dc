//! The neutral face made ready to move: symmetrised, eyes enlarged, the brows at rest, the mouth closed (recipe part 0).

use super::deformed::Deformed;
use super::eye::Socket;
use super::landmarks::{BROWS, ES0, EYES};
use super::lips::Lips;
use super::prepare::{close_mouth, make_sound, proportion, rest_brows, symmetrise};
use super::{Expression, Expressions, Eye, Proportions, within};
use crate::face::{FeaturePoint as P, Points, Units};
use crate::geometry::{Affine, Point, Vec2};
use crate::pose::{Head, Pose};

/// A brow's middle line stays at least this far above the upper lid, in face units: half a brow and a strip of skin.
const BROW_OVER_LID: f64 = 9.0;

/// A person's face at rest, as a drawing starts from it.
///
/// ```
/// use lianpu::face::{FeaturePoint, Points, rig::{Neutral, Proportions}};
/// use lianpu::pose::Pose;
/// # let points = Points([lianpu::geometry::Point::ZERO; FeaturePoint::FIXED]);
/// let neutral = Neutral::of(&points, &Proportions::NORMAL);
/// let face = neutral.pose(&Pose::default());
/// assert!(face.points[FeaturePoint::P2_1].is_finite());
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Neutral {
    points: Points,
    units: Units,
    lips: Lips,
    sockets: [Socket; 2],
    expressions: Expressions,
}

impl Neutral {
    /// Makes a face ready. `measured` are its points in the face frame ([`to_face_frame`](crate::face::to_face_frame)).
    ///
    /// Points that no face can have, such as lids that cross or lips above the nose, are moved to the nearest places
    /// that one could; what is not finite becomes 0 first.
    #[must_use]
    pub fn of(measured: &Points, proportions: &Proportions) -> Self {
        let mut points = Points(measured.0.map(|p| Point::new(within(p.x, -1e4, 1e4), within(p.y, -1e4, 1e4))));
        symmetrise(&mut points, proportions);
        make_sound(&mut points);
        proportion(&mut points, proportions);
        rest_brows(&mut points);
        close_mouth(&mut points);
        let lips = Lips::of(&mut points);
        let units = Units::of(&points);
        let sockets = [Socket::of(&points, EYES[0], -1.0, proportions), Socket::of(&points, EYES[1], 1.0, proportions)];
        Self { points, units, lips, sockets, expressions: Expressions::general().clone() }
    }

    /// The same face, showing the emotions as a person of these expressions does.
    #[must_use]
    pub fn with_expressions(mut self, expressions: Expressions) -> Self {
        self.expressions = expressions;
        self
    }

    /// How it shows the emotions.
    #[must_use]
    pub(crate) fn expressions(&self) -> &Expressions {
        &self.expressions
    }

    /// The points at rest, as drawn.
    #[must_use]
    pub fn points(&self) -> &Points {
        &self.points
    }

    /// The units that the face moves in, of the points as drawn.
    #[must_use]
    pub fn units(&self) -> &Units {
        &self.units
    }

    /// The face in a pose. Any pose gives finite points; lids and inner edges of the lips do not cross.
    #[must_use]
    pub fn pose(&self, pose: &Pose) -> Deformed {
        self.express(self.expressions.mix(&pose.ratios), pose)
    }

    /// The face in a pose, with this expression instead of that of the pose's ratios.
    #[must_use]
    pub(crate) fn express(&self, expression: Expression, pose: &Pose) -> Deformed {
        let mut points = self.points;
        let mouth = self.lips.pose(&expression, &pose.mouth);
        mouth.place(&mut points);
        let chin_drop = self.move_jaw(&mut points);
        let eyes = [
            self.sockets[0].pose(&expression, pose.lids.left, pose.gaze),
            self.sockets[1].pose(&expression, pose.lids.right, pose.gaze),
        ];
        for eye in &eyes {
            eye.place(&mut points);
        }
        self.move_brows(&mut points, &expression, &eyes);
        let brows = BROWS.map(|side| side.map(|p| points[p]));
        Deformed { points, mouth, eyes, brows, expression, chin_drop, head: self.head(&pose.head) }
    }

    /// The chin follows the lower lip and the jaw follows the chin a little (thesis sec. 4.4.2, softened as in the
    /// recipe: flesh gives). Returns how far the chin has come down.
    fn move_jaw(&self, points: &mut Points) -> f64 {
        const CHIN_DOWN: f64 = 0.85;
        /// A lip that rises does so mostly by itself.
        const CHIN_UP: f64 = 0.25;
        const JAW: f64 = 0.18;
        let lip = points[P::P8_2] - self.points[P::P8_2];
        let followed = lip.y * if lip.y > 0.0 { CHIN_DOWN } else { CHIN_UP };
        let least = points[P::P8_2].y + 0.4 * self.units.jaw_height;
        let chin = Point::new(self.points[P::P2_1].x + lip.x, (self.points[P::P2_1].y + followed).max(least));
        points[P::P2_1] = chin;
        let drop = (chin.y - self.points[P::P2_1].y).max(0.0);
        for jaw in [P::P2_14, P::P2_13] {
            points[jaw].y += JAW * lip.y.max(0.0);
        }
        drop
    }

    /// Brows by the emotions: the inner end by its own numbers, its neighbour between them and the middle's.
    fn move_brows(&self, points: &mut Points, e: &Expression, eyes: &[Eye; 2]) {
        for ((side, eye), toward_middle) in BROWS.iter().zip(eyes).zip([1.0, -1.0]) {
            let moves = [
                Vec2::new(e.brow_in * toward_middle, e.brow_inner),
                Vec2::new(0.5 * e.brow_in * toward_middle, 0.45 * e.brow_inner + 0.55 * e.brow_middle),
                Vec2::new(0.0, e.brow_middle),
                Vec2::new(0.0, e.brow_outer),
            ];
            for ((i, p), by) in side.iter().enumerate().zip(moves) {
                let rest = self.points[*p];
                let mut to = rest + by * ES0;
                // The outer end may hang beside the eye; over it a brow stops short of the lid, or where it rests.
                if i < 3 && to.y > rest.y {
                    to.y = to.y.min((eye.lid_over(to.x) - BROW_OVER_LID).max(rest.y));
                }
                points[*p] = to;
            }
            // Inner ends that would pass each other meet short of the middle.
            let inner = side[0];
            let middle = self.points[P::P4_2].x.midpoint(self.points[P::P4_1].x);
            let room = 0.35 * (self.points[inner].x - middle).abs();
            let x = points[inner].x - middle;
            points[inner].x = middle + if toward_middle > 0.0 { x.min(-room) } else { x.max(room) };
        }
    }

    /// The head rolled about the neck under the chin, and moved in pupil distances.
    fn head(&self, head: &Head) -> Affine {
        if *head == Head::default() {
            return Affine::IDENTITY;
        }
        let pivot = Vec2::new(self.points[P::P2_1].x, self.points[P::P2_1].y + 0.1 * ES0);
        let by = Vec2::new(within(head.x, -10.0, 10.0), within(head.y, -10.0, 10.0)) * ES0;
        Affine::translate(pivot + by)
            * Affine::rotate(within(head.roll, -360.0, 360.0).to_radians())
            * Affine::translate(-pivot)
    }
}

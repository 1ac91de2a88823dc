//! The neutral face made ready to move: symmetrised, eyes enlarged, the brows at rest, the mouth closed (recipe part 0).

use super::deformed::Deformed;
use super::eye::Socket;
use super::mouth::Lips;
use super::{Expression, Eye, Proportions, within};
use crate::face::{FeaturePoint as P, Part, Points, Units};
use crate::geometry::{Affine, Point, Vec2, lerp};
use crate::pose::{Head, Pose};

/// Pupil distance in the face frame.
pub(super) const ES0: f64 = 100.0;

/// Brows of the left and the right side, from the inner to the outer end.
pub(super) const BROWS: [[P; 4]; 2] = [[P::P4_2, P::P4_4, P::P4_4A, P::P4_6], [P::P4_1, P::P4_3, P::P4_3A, P::P4_5]];

const NOSE: [P; 9] = [P::P9_6, P::P9_7, P::P9_14, P::P9_13, P::P9_2, P::P9_1, P::P9_4, P::P9_5, P::P9_15];
pub(super) const MOUTH: [P; 8] = [P::P8_4, P::P8_3, P::P8_9, P::P8_10, P::P8_1, P::P2_2, P::P2_3, P::P8_2];

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
        let sockets = [
            Socket::of(&points, [P::P3_8, P::P3_12, P::P3_2, P::P3_4, P::P3_6], -1.0, proportions),
            Socket::of(&points, [P::P3_11, P::P3_7, P::P3_1, P::P3_3, P::P3_5], 1.0, proportions),
        ];
        Self { points, units, lips, sockets }
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
        let expression = Expression::of(&pose.ratios);
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

/// Brings the two sides together: L' = L (1 − s/2) + mirror(R) s/2; points of the middle to x (1 − s).
fn symmetrise(points: &mut Points, proportions: &Proportions) {
    let found = *points;
    for p in P::fixed() {
        let s = if p.part() == Part::Ears { proportions.ear_symmetry } else { proportions.symmetry };
        let s = within(s, 0.0, 1.0);
        let other = found[p.mirror()];
        let (own, half) = (1.0 - s / 2.0, s / 2.0);
        points[p] = Point::new(found[p].x * own - other.x * half, found[p].y * own + other.y * half);
    }
}

/// Moves what no face can have. The bounds, in face units, are wider than any of 72 measured faces has needed.
fn make_sound(points: &mut Points) {
    for (eye, side) in
        [([P::P3_8, P::P3_12, P::P3_2, P::P3_4, P::P3_6], -1.0), ([P::P3_11, P::P3_7, P::P3_1, P::P3_3, P::P3_5], 1.0)]
    {
        let [inner, outer, upper, lower, middle] = eye;
        // In the face frame the eyes are where they are; anything else is a slip of whoever moved the points there.
        points[middle].x = side * within(side * points[middle].x, 0.35 * ES0, 0.65 * ES0);
        points[middle].y = within(points[middle].y, -0.15 * ES0, 0.15 * ES0);
        let c = points[middle];
        points[inner].x = c.x - side * within(side * (c.x - points[inner].x), 12.0, 34.0);
        points[outer].x = c.x + side * within(side * (points[outer].x - c.x), 12.0, 40.0);
        for corner in [inner, outer] {
            points[corner].y = c.y + within(points[corner].y - c.y, -10.0, 14.0);
        }
        points[upper].y = c.y - within(c.y - points[upper].y, 2.0, 20.0);
        points[lower].y = c.y + within(points[lower].y - c.y, 2.0, 20.0);
    }
    for (brow, side) in BROWS.into_iter().zip([-1.0, 1.0]) {
        let mut from = 0.0;
        for (p, (least, most)) in brow.into_iter().zip([(5.0, 60.0), (10.0, 70.0), (10.0, 70.0), (5.0, 70.0)]) {
            from += within(side * points[p].x - from, least, most);
            points[p] = Point::new(side * from, within(points[p].y, -90.0, 5.0));
        }
    }
    let nose = Point::new(within(points[P::P9_15].x, -30.0, 30.0), within(points[P::P9_15].y, 30.0, 140.0));
    points[P::P9_15] = nose;
    let half = within(0.5 * (points[P::P8_3].x - points[P::P8_4].x), 15.0, 80.0);
    let middle = within(points[P::P8_3].x.midpoint(points[P::P8_4].x), -30.0, 30.0);
    points[P::P8_4].x = middle - half;
    points[P::P8_3].x = middle + half;
    let down = |from: f64, y: f64, least: f64, most: f64| from + within(y - from, least, most);
    points[P::P8_1].y = down(nose.y, points[P::P8_1].y, 8.0, 70.0);
    points[P::P2_2].y = down(points[P::P8_1].y, points[P::P2_2].y, 1.0, 40.0);
    points[P::P2_3].y = down(points[P::P2_2].y, points[P::P2_3].y, 0.0, 60.0);
    points[P::P8_2].y = down(points[P::P2_3].y, points[P::P8_2].y, 2.0, 45.0);
    points[P::P2_1].y = down(points[P::P8_2].y, points[P::P2_1].y, 18.0, 150.0);
    let lips = (points[P::P8_1].y, points[P::P8_2].y);
    for corner in [P::P8_4, P::P8_3] {
        points[corner].y = within(points[corner].y, lips.0 - 5.0, lips.1 + 5.0);
    }
    for peak in [P::P8_9, P::P8_10] {
        points[peak].y = within(points[peak].y, nose.y + 3.0, points[P::P8_1].y);
    }
    for (jaw, side) in [(P::P2_14, -1.0), (P::P2_13, 1.0)] {
        points[jaw].x = side * (side * points[jaw].x).max(middle.abs() + 1.15 * half);
    }
}

/// Eyes, and for some styles nose, mouth, brows, chin and jaw (recipe parts 0.2 and 7).
fn proportion(points: &mut Points, by: &Proportions) {
    /// Corners of the eye are drawn out less in height than in width.
    const CORNER_HEIGHT: f64 = 1.08;
    /// The least height of an eye in ES0 before it is enlarged: narrower ones could not be seen to look or to close.
    const LEAST_EYE: f64 = 0.147;
    for [inner, outer, upper, lower, middle] in
        [[P::P3_8, P::P3_12, P::P3_2, P::P3_4, P::P3_6], [P::P3_11, P::P3_7, P::P3_1, P::P3_3, P::P3_5]]
    {
        let c = points[middle];
        for corner in [inner, outer] {
            let v = points[corner] - c;
            points[corner] = c + Vec2::new(v.x * by.eye_width, v.y * CORNER_HEIGHT);
        }
        for lid in [upper, lower] {
            points[lid].y = c.y + (points[lid].y - c.y) * by.eye_height;
        }
        let missing = LEAST_EYE * by.eye_height * ES0 - (points[lower].y - points[upper].y);
        if missing > 0.0 {
            points[upper].y -= 0.6 * missing;
            points[lower].y += 0.4 * missing;
        }
    }
    let eye_nose = points[P::P9_15].y - points[P::P3_6].midpoint(points[P::P3_5]).y;
    let base = points[P::P9_15];
    for p in NOSE {
        points[p] = base + (points[p] - base) * by.nose - Vec2::new(0.0, by.nose_up * eye_nose);
    }
    let middle = points[P::P8_4].midpoint(points[P::P8_3]);
    for p in MOUTH {
        let v = points[p] - middle;
        points[p] = middle + Vec2::new(v.x * by.mouth_wide, v.y * by.mouth_high - by.mouth_up * eye_nose);
    }
    for p in BROWS.into_iter().flatten() {
        points[p].y -= by.brow_up * ES0;
    }
    points[P::P2_1].y = (points[P::P2_1].y - by.chin_up * ES0).max(points[P::P8_2].y + 12.0);
    for p in [P::P2_14, P::P2_13] {
        points[p].y -= by.jaw_up * ES0;
    }
}

/// Neutral must read neutral: measured brows lie lower inside than drawn ones may, or a face at rest looks cross.
fn rest_brows(points: &mut Points) {
    for [inner, next, _, outer] in BROWS {
        points[inner].y -= 0.028 * ES0;
        points[next].y -= 0.012 * ES0;
        points[outer].y += 0.008 * ES0;
        points[inner].y = points[inner].y.min(points[next].y + 0.04 * ES0);
    }
}

/// A mouth at rest is closed: both inner edges at 0.6 of the upper and 0.4 of the lower one. A mouth that the photo
/// shows further open than a line of ink is shut by its lower lip, and the chin comes along.
fn close_mouth(points: &mut Points) {
    const A_LINE: f64 = 1.6;
    /// How far the corners of 72 faces hang below their lips' line on average, in face units.
    const USUAL_HANG: f64 = 2.5;
    let gap = points[P::P2_3].y - points[P::P2_2].y;
    let shut = (gap - A_LINE).max(0.0);
    points[P::P2_3].y -= shut;
    points[P::P8_2].y -= shut;
    points[P::P2_1].y -= 0.85 * shut;
    let meet = lerp(points[P::P2_2].y, points[P::P2_3].y, 0.4);
    points[P::P2_2].y = meet;
    points[P::P2_3].y = meet;
    // Corners that hang far make a sad mouth of a resting one: half of what hangs further than usual is kept.
    for corner in [P::P8_4, P::P8_3] {
        let further = (points[corner].y - meet - USUAL_HANG).max(0.0);
        points[corner].y -= 0.5 * further;
    }
}

//! What is done to measured points before they move: sides brought together, eyes enlarged, brows at rest, mouth closed
//! (recipe parts 0 and 7).

use super::landmarks::{BROWS, ES0, EYES};
use super::{Proportions, within};
use crate::face::{FeaturePoint as P, Part, Points};
use crate::geometry::{Point, Vec2, lerp};

const NOSE: [P; 9] = [P::P9_6, P::P9_7, P::P9_14, P::P9_13, P::P9_2, P::P9_1, P::P9_4, P::P9_5, P::P9_15];
const MOUTH: [P; 8] = [P::P8_4, P::P8_3, P::P8_9, P::P8_10, P::P8_1, P::P2_2, P::P2_3, P::P8_2];

/// Brings the two sides together: L' = L (1 − s/2) + mirror(R) s/2; points of the middle to x (1 − s).
pub(super) fn symmetrise(points: &mut Points, proportions: &Proportions) {
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
pub(super) fn make_sound(points: &mut Points) {
    for ([inner, outer, upper, lower, middle], side) in EYES.into_iter().zip([-1.0, 1.0]) {
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
        for (p, (least, most)) in brow.into_iter().zip([(5.0, 60.0), (4.0, 70.0), (4.0, 70.0), (3.0, 70.0)]) {
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
pub(super) fn proportion(points: &mut Points, by: &Proportions) {
    /// Corners of the eye are drawn out less in height than in width.
    const CORNER_HEIGHT: f64 = 1.08;
    /// The least height of an eye in ES0 before it is enlarged: narrower ones could not be seen to look or to close.
    const LEAST_EYE: f64 = 0.147;
    for [inner, outer, upper, lower, middle] in EYES {
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
pub(super) fn rest_brows(points: &mut Points) {
    for [inner, next, _, outer] in BROWS {
        points[inner].y -= 0.028 * ES0;
        points[next].y -= 0.012 * ES0;
        points[outer].y += 0.008 * ES0;
        points[inner].y = points[inner].y.min(points[next].y + 0.04 * ES0);
    }
}

/// A mouth at rest is closed: both inner edges at 0.6 of the upper and 0.4 of the lower one. A mouth that the photo
/// shows further open than a line of ink is shut by its lower lip, and the chin comes along.
pub(super) fn close_mouth(points: &mut Points) {
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

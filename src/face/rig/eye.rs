//! The eyes: lids as two cubics that never cross, an eyeball that looks, a blink (recipe part 5).

use super::landmarks::ES0;
use super::{Expression, Proportions, within};
use crate::face::{FeaturePoint as P, Points};
use crate::geometry::{CubicBez, ParamCurve, Point, Vec2, lerp};
use crate::pose::Gaze;

/// Radius of the iris in ES0.
const IRIS: f64 = 0.117;
/// Where closed lids meet, between the lower (0) and the upper lid (1): people close from above.
const CLOSED_AT: f64 = 0.18;
/// How far below that the lids' ink takes the line, in face units.
const CLOSED_SINKS: f64 = 1.5;
/// Of a glance up or down, how much the upper and the lower lid follow.
const LIDS_FOLLOW: (f64, f64) = (0.40, 0.20);
/// Of the way that a closing lid makes, how much its crease follows.
const CREASE_FOLLOWS: f64 = 0.40;
/// Lids stay at least this far apart before a blink, in heights of the eye.
const LEAST_OPEN: f64 = 0.22;

/// An eye at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Socket {
    names: [P; 5],
    inner: Point,
    outer: Point,
    upper: f64,
    lower: f64,
    centre: Point,
    radius: f64,
    crease: f64,
    side: f64,
}

/// An eye in a pose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Eye {
    /// −1 at the image's left, 1 at its right.
    pub side: f64,
    /// The upper lid's edge, from the inner to the outer corner.
    pub upper: CubicBez,
    /// The lower lid's edge, from the inner to the outer corner. Nowhere above the upper one.
    pub lower: CubicBez,
    /// Middle of the iris.
    pub iris: Point,
    /// Radius of the iris.
    pub radius: f64,
    /// How far the blink has gone, 0 open to 1 closed.
    pub closed: f64,
    /// The crease over the upper lid, from its inner to its outer end. A blink draws it down a little and stretches the
    /// skin between.
    pub crease: CubicBez,
    /// Height of the eye at rest.
    pub height: f64,
    names: [P; 5],
}

impl Socket {
    /// From the prepared points of an eye: inner and outer corner, upper and lower lid, middle.
    pub(super) fn of(points: &Points, names: [P; 5], side: f64, proportions: &Proportions) -> Self {
        let [inner, outer, upper, lower, centre] = names.map(|p| points[p]);
        let height = lower.y - upper.y;
        Self {
            names,
            inner,
            outer,
            upper: upper.y,
            lower: lower.y,
            centre,
            radius: IRIS * proportions.iris * ES0,
            crease: proportions.crease * height,
            side,
        }
    }

    /// `open` is 1 as the emotion has the eye, 0 closed.
    pub(super) fn pose(&self, e: &Expression, open: f64, gaze: Gaze) -> Eye {
        let height = self.lower - self.upper;
        let open = within(open, 0.0, 1.2);
        let closed = (1.0 - open).max(0.0);
        let wide = (open - 1.0).max(0.0);
        let radius = self.radius * e.iris;
        // Gaze: on the eyeball, so that the iris never leaves the lids.
        let toward = if (gaze.x >= 0.0) == (self.side > 0.0) { self.outer } else { self.inner };
        let reach = Vec2::new(0.8 * ((toward.x - self.centre.x).abs() - 0.72 * radius).max(0.0), 0.32 * height);
        let look = Vec2::new(soft(gaze.x * height, reach.x), soft((gaze.y + e.look_down) * height, reach.y));
        let iris = self.centre + Vec2::new(look.x, 0.02 * height + look.y);
        // Lids: by the emotion about the eyeball's middle, after the glance, and wider than at rest when startled.
        let mut upper = self.centre.y - (self.centre.y - self.upper) * (e.lid_upper + wide);
        let mut lower = self.lower - e.lid_lower * height;
        upper += LIDS_FOLLOW.0 * look.y;
        lower += LIDS_FOLLOW.1 * look.y;
        let missing = (LEAST_OPEN * height - (lower - upper)).max(0.0);
        upper -= 0.5 * missing;
        lower += 0.5 * missing;
        // The blink: both lids go to the line where they meet, the corners come along.
        let meet = lerp(lower, upper, CLOSED_AT) + CLOSED_SINKS;
        let folded = lerp(upper, meet, CREASE_FOLLOWS * closed);
        upper = lerp(upper, meet, closed);
        lower = lerp(lower, meet, closed);
        let crease = self.crease * (0.75 + 0.25 * e.lid_upper) * (1.0 - 0.25 * closed);
        let crease = creased(&lids(self.inner, self.outer, folded, folded).0, crease);
        let inner = Point::new(self.inner.x, lerp(self.inner.y, meet, 0.45 * closed));
        let outer = Point::new(self.outer.x, lerp(self.outer.y, meet, 0.35 * closed));
        let (upper, lower) = lids(inner, outer, upper, lower);
        Eye { side: self.side, upper, lower, iris, radius, closed, crease, height, names: self.names }
    }
}

/// The two lids between the corners, with their middles at the heights `upper` and `lower`.
///
/// Both have their handles at the same x, so at any x they stand at the same parameter, and since no control point of
/// the lower one lies above the upper one's, the curves do not cross. The upper lid peaks toward the nose and the
/// lower one hangs toward the temple: the inner handles stand higher than the outer ones.
fn lids(inner: Point, outer: Point, upper: f64, lower: f64) -> (CubicBez, CubicBez) {
    const HANDLES: (f64, f64) = (0.25, 0.75);
    /// Share of the opening that a lid's stronger handle gains and the other loses.
    const LEAN: f64 = 0.08;
    let across = outer.x - inner.x;
    let middle = inner.y.midpoint(outer.y);
    // A cubic's middle is (ends + 3 handles) / 8 of each: the handles' height that brings it to the lid's.
    let handle = |lid: f64| (lid - 0.125 * (inner.y + outer.y)) / 0.75;
    let tilt = |corner: Point| 0.3 * (corner.y - middle);
    let (top, bottom) = (handle(upper), handle(lower));
    // As much for both lids, so that it is nothing once they have closed.
    let lean = LEAN * (bottom - top);
    let upper = [top + tilt(inner) - lean, top + tilt(outer) + lean];
    let lower = [bottom + tilt(inner) - lean, bottom + tilt(outer) + lean];
    let curve = |y: [f64; 2]| {
        CubicBez::new(
            inner,
            Point::new(inner.x + HANDLES.0 * across, y[0]),
            Point::new(inner.x + HANDLES.1 * across, y[1]),
            outer,
        )
    };
    (curve(upper), curve(lower))
}

/// A lid's curve raised by three quarters of `by` at its inner end and all of it at the outer one.
fn creased(lid: &CubicBez, by: f64) -> CubicBez {
    let up = |p: Point, share: f64| Point::new(p.x, p.y - share * by);
    CubicBez::new(up(lid.p0, 0.75), up(lid.p1, 0.83), up(lid.p2, 0.92), up(lid.p3, 1.0))
}

/// `v` up to about `reach`, slowing down on the way: an eye that follows something does not hit a wall.
fn soft(v: f64, reach: f64) -> f64 {
    if reach <= 0.0 {
        return 0.0;
    }
    let t = within(v / reach, -1e3, 1e3);
    // Straight for small glances, at its end at twice the reach.
    let t = within(t, -2.0, 2.0);
    reach * (t - t * t.abs() / 4.0)
}

impl Eye {
    /// Its inner corner.
    #[must_use]
    pub fn inner(&self) -> Point {
        self.upper.p0
    }

    /// Its outer corner.
    #[must_use]
    pub fn outer(&self) -> Point {
        self.upper.p3
    }

    /// How far the lids stand apart in the middle, in face units; 0 when closed.
    #[must_use]
    pub fn opening(&self) -> f64 {
        self.lower.eval(0.5).y - self.upper.eval(0.5).y
    }

    /// Height of the upper lid at `x`, or of the corner beyond which `x` lies.
    pub(super) fn lid_over(&self, x: f64) -> f64 {
        let (from, to) = (self.inner().x, self.outer().x);
        self.upper.eval(within((x - from) / (to - from), 0.0, 1.0)).y
    }

    /// Puts the points of the eye where the pose has them; 3.6 and 3.5, the eyeball's middle, go with the gaze.
    pub(super) fn place(&self, points: &mut Points) {
        let [inner, outer, upper, lower, centre] = self.names;
        points[inner] = self.inner();
        points[outer] = self.outer();
        points[upper].y = self.upper.eval(0.5).y;
        points[lower].y = self.lower.eval(0.5).y;
        points[centre] = self.iris;
    }
}

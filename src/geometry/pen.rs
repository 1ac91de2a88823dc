//! The pen that draws a stroke of varying width: a disc that moves, and where the envelope of all its places touches it.

use kurbo::{Point, Vec2};

use super::Ribbon;

/// Above this change of radius per length, one disc swallows the next and there is no envelope.
const MAX_FLARE: f64 = 0.98;

/// Where a handle lies on its end point the stroke stands still; what the pen does there is read so far beside it.
const BESIDE: f64 = 1e-4;

/// A stroke as polynomials of its parameter: the factors of 1, t, t², t³.
pub(super) struct Track {
    place: [Vec2; 4],
    width: [f64; 4],
    /// Slower than this is standing still.
    still: f64,
}

/// The pen at one parameter. Rates are by the parameter.
#[derive(Clone, Copy)]
pub(super) struct Pen {
    pub(super) at: Point,
    /// Where to, of length 1.
    pub(super) tangent: Vec2,
    /// Half the width, not below 0.
    pub(super) radius: f64,
    /// Change of the radius per unit of arc length.
    pub(super) flare: f64,
    velocity: Vec2,
    growth: f64,
    /// Rate of the tangent's angle.
    turning: f64,
    /// Rate of the angle between the tangent and the direction of the contact point.
    opening: f64,
}

impl Track {
    pub(super) fn of(ribbon: &Ribbon) -> Self {
        let [a, b, c, d] = ribbon.0.map(|k| k.point().to_vec2());
        let [p, q, r, s] = ribbon.0.map(|k| k.w);
        let longest = (b - a).hypot().max((c - b).hypot()).max((d - c).hypot());
        Self {
            place: [a, 3.0 * (b - a), 3.0 * (a - 2.0 * b + c), d - a + 3.0 * (b - c)],
            width: [p, 3.0 * (q - p), 3.0 * (p - 2.0 * q + r), s - p + 3.0 * (q - r)],
            still: 1e-6 * longest,
        }
    }

    /// The parameters between which there is ink: where the width is above 0.
    pub(super) fn inked(&self) -> Vec<(f64, f64)> {
        let [c0, c1, c2, c3] = self.width;
        let mut ends: Vec<f64> =
            kurbo::common::solve_cubic(c0, c1, c2, c3).into_iter().filter(|t| *t > 0.0 && *t < 1.0).collect();
        ends.extend([0.0, 1.0]);
        ends.sort_by(f64::total_cmp);
        let width = |t: f64| c0 + t * (c1 + t * (c2 + t * c3));
        let inked = |w: &[f64]| (w[1] - w[0] > 1e-9 && width(f64::midpoint(w[0], w[1])) > 1e-9).then_some((w[0], w[1]));
        ends.windows(2).filter_map(inked).collect()
    }

    pub(super) fn pen(&self, t: f64) -> Pen {
        let [p0, p1, p2, p3] = self.place;
        let [w0, w1, w2, w3] = self.width;
        let at = p0 + t * (p1 + t * (p2 + t * p3));
        let radius = (w0 + t * (w1 + t * (w2 + t * w3))).max(0.0) / 2.0;
        let mut t = t;
        let mut velocity = p1 + t * (2.0 * p2 + t * (3.0 * p3));
        if velocity.hypot() <= self.still {
            t += if t < 0.5 { BESIDE } else { -BESIDE };
            velocity = p1 + t * (2.0 * p2 + t * (3.0 * p3));
        }
        let speed = velocity.hypot();
        let (growth, change) = ((w1 + t * (2.0 * w2 + t * (3.0 * w3))) / 2.0, w2 + 3.0 * t * w3);
        let mut pen = Pen {
            at: at.to_point(),
            tangent: Vec2::new(1.0, 0.0),
            radius,
            flare: 0.0,
            velocity,
            growth,
            turning: 0.0,
            opening: 0.0,
        };
        if speed <= self.still {
            // All in one place: a dot.
            pen.flare = if growth.abs() > 0.0 { MAX_FLARE.copysign(growth) } else { 0.0 };
            return pen;
        }
        let acceleration = 2.0 * p2 + t * (6.0 * p3);
        pen.tangent = velocity / speed;
        pen.turning = velocity.cross(acceleration) / (speed * speed);
        let flare = growth / speed;
        pen.flare = flare.clamp(-MAX_FLARE, MAX_FLARE);
        if flare == pen.flare {
            let flaring = (change - flare * pen.tangent.dot(acceleration)) / speed;
            pen.opening = flaring / (1.0 - flare * flare).sqrt();
        }
        pen
    }
}

impl Pen {
    /// The direction in which the envelope touches the disc on one side, 1 or -1: the contact points of a family of
    /// discs lie at r (±√(1 − r'²) n − r' τ) from the centre, r' being the change of r along the curve.
    pub(super) fn outward(&self, side: f64) -> Vec2 {
        let k = self.flare;
        let normal = Vec2::new(-self.tangent.y, self.tangent.x);
        side * (1.0 - k * k).sqrt() * normal - k * self.tangent
    }

    /// Where the envelope touches the disc.
    pub(super) fn contact(&self, side: f64) -> Point {
        self.at + self.radius * self.outward(side)
    }

    /// Rate of the contact point by the parameter: along the envelope, which is at right angles to the direction outward.
    pub(super) fn slope(&self, side: f64) -> Vec2 {
        let u = self.outward(side);
        self.velocity + self.growth * u + self.radius * (self.turning + side * self.opening) * Vec2::new(-u.y, u.x)
    }

    /// The angle between the tangent and the direction outward, 0 to π.
    pub(super) fn angle(&self) -> f64 {
        (-self.flare).acos()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Knot;
    use proptest::prelude::*;

    #[test]
    fn ink_ends_where_the_width_does() {
        let k = |x, w| Knot::new(x, 0.0, w);
        let inked = Track::of(&Ribbon([k(0.0, 12.0), k(1.0, -12.0), k(2.0, -12.0), k(3.0, 12.0)])).inked();
        assert_eq!(inked.len(), 2);
        // w = 12 − 72 t + 72 t².
        let root = (1.0 - (1.0_f64 / 3.0).sqrt()) / 2.0;
        assert!((inked[0].1 - root).abs() < 1e-9 && (inked[1].0 - (1.0 - root)).abs() < 1e-9);
        assert!(Track::of(&Ribbon([k(0.0, 0.0); 4])).inked().is_empty());
    }

    proptest! {
        /// The rate of the contact point is what its places say, and lies along the envelope.
        #[test]
        fn the_envelope_runs_at_right_angles_to_its_discs(
            c in prop::array::uniform4((0.0..100.0f64, 0.0..100.0f64, 1.0..20.0f64)), t in 0.01..0.99f64,
        ) {
            let track = Track::of(&Ribbon(c.map(|(x, y, w)| Knot::new(x, y, w))));
            let (pen, before, after) = (track.pen(t), track.pen(t - 1e-6), track.pen(t + 1e-6));
            prop_assume!([before, pen, after].iter().all(|p| p.flare.abs() < 0.9 && p.velocity.hypot() > 20.0));
            for side in [1.0, -1.0] {
                let slope = (after.contact(side) - before.contact(side)) / 2e-6;
                prop_assert!((slope - pen.slope(side)).hypot() < 1e-3 * (1.0 + slope.hypot()), "{slope:?}");
                prop_assert!(pen.slope(side).dot(pen.outward(side)).abs() < 1e-8 * (1.0 + slope.hypot()));
            }
        }
    }
}

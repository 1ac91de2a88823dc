//! The outline of a chain of strokes of varying width, as one path.
//!
//! What is drawn is the union of the discs along the strokes. Where their envelope is regular it is the outline, and
//! strokes that go on where the last one ended share it: one contour goes round the whole line, so that its joints
//! have no seams. Where the pen is too wide for a bend the envelope folds; there the convex hulls of neighbouring
//! discs are united instead, which holds for any input.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use kurbo::{BezPath, CubicBez, Line, ParamCurve, PathEl, PathSeg, Point, Vec2};

use super::Ribbon;
use super::envelope::{fit, stretches};
use super::pen::{Pen, Track};

/// How far an outline may be off, as a share of its stroke's greatest width: what is drawn by thin lines is then as
/// exact as what is drawn by thick ones.
const OF_WIDTH: f64 = 0.003;

/// The outline of a chain of strokes as one path to be filled non-zero: every part winds the same way, so where
/// strokes overlap they unite. `tolerance` is the largest distance from the true outline; of a thin line it is no more
/// than three thousandths of its width.
#[must_use]
pub fn outline(chain: &[Ribbon], tolerance: f64) -> BezPath {
    let mut path = BezPath::new();
    let mut run = Run::default();
    for ribbon in chain {
        let widest = ribbon.0.iter().map(|k| k.w).fold(0.0, f64::max);
        let tolerance = tolerance.min(OF_WIDTH * widest);
        let track = Track::of(ribbon);
        for inked in track.inked() {
            for stretch in stretches(&track, inked) {
                if stretch.regular {
                    let (start, end) = (track.pen(stretch.from), track.pen(stretch.to));
                    run.reach(&start, tolerance, &mut path);
                    fit(&track, &stretch, tolerance, &mut run.sides);
                    run.ends = run.ends.map_or(Some((start, end)), |(first, _)| Some((first, end)));
                } else {
                    run.finish(&mut path);
                    united_hulls(&track, stretch.from, stretch.to, tolerance, &mut path);
                }
            }
        }
    }
    run.finish(&mut path);
    path
}

/// Regular stretches that go on where the last one ended: both sides so far, and the pens at the two ends.
#[derive(Default)]
struct Run {
    sides: [Vec<PathSeg>; 2],
    ends: Option<(Pen, Pen)>,
    tolerance: f64,
}

impl Run {
    /// Goes on with a stretch that starts with `pen`: round the joint, or as a new part.
    fn reach(&mut self, pen: &Pen, tolerance: f64, path: &mut BezPath) {
        if self.ends.is_some_and(|(_, last)| !meet(&last, pen)) {
            self.finish(path);
        }
        self.tolerance = tolerance;
        if let Some((_, last)) = self.ends {
            self.join(&last, pen);
        }
    }

    /// Both sides go round the disc of a joint; on its inner side backward, where the next stretch covers it. Together
    /// with the caps that two parts would have here this is one whole turn: what two parts with caps cover, this does.
    fn join(&mut self, last: &Pen, next: &Pen) {
        let turn = last.tangent.cross(next.tangent).atan2(last.tangent.dot(next.tangent));
        let opened = next.angle() - last.angle();
        for (side, sign, turn) in [(0, 1.0, turn + opened), (1, -1.0, turn - opened)] {
            around(last.at, (last.contact(sign), next.contact(sign)), turn, self.tolerance, &mut self.sides[side]);
        }
    }

    /// Closes the part and begins anew.
    fn finish(&mut self, path: &mut BezPath) {
        let Some((first, last)) = self.ends.take() else { return };
        // A line that ends where it began is a ring: two contours without caps.
        let ring = meet(&last, &first);
        if ring {
            self.join(&last, &first);
        }
        let [mut left, right] = std::mem::take(&mut self.sides);
        let back = right.iter().rev().map(PathSeg::reverse);
        if ring {
            contour(left, path);
            contour(back, path);
            return;
        }
        let places = (last.contact(1.0), last.contact(-1.0));
        around(last.at, places, -2.0 * last.angle(), self.tolerance, &mut left);
        left.extend(back);
        let places = (first.contact(-1.0), first.contact(1.0));
        around(first.at, places, 2.0 * first.angle() - TAU, self.tolerance, &mut left);
        contour(left, path);
    }
}

/// Adds one closed contour.
fn contour(segments: impl IntoIterator<Item = PathSeg>, path: &mut BezPath) {
    for (i, segment) in segments.into_iter().enumerate() {
        if i == 0 {
            path.push(PathEl::MoveTo(segment.start()));
        }
        path.push(segment.as_path_el());
    }
    path.push(PathEl::ClosePath);
}

/// Whether one pen stands where another does.
fn meet(a: &Pen, b: &Pen) -> bool {
    (a.at - b.at).hypot() < 1e-6 && (a.radius - b.radius).abs() < 1e-6
}

/// Goes round a disc between two places on its rim, by an angle.
fn around(centre: Point, (from, to): (Point, Point), turn: f64, tolerance: f64, segments: &mut Vec<PathSeg>) {
    let radius = (from - centre).hypot();
    if turn.abs() * radius < 1e-6 {
        return;
    }
    if radius * turn.abs().min(1.0) <= tolerance {
        segments.push(PathSeg::Line(Line::new(from, to)));
        return;
    }
    let pieces = (turn.abs() / FRAC_PI_2 - 1e-9).ceil().max(1.0);
    let (start, step) = ((from - centre).atan2(), turn / pieces);
    segments.extend(
        (0..pieces as usize).map(|i| turned(centre, radius, start + step * i as f64, step)).map(PathSeg::Cubic),
    );
}

/// A cubic about `centre` that turns by `step` from the direction `from`. Its handles' length makes it meet the circle
/// at both ends and in the middle.
pub(super) fn turned(centre: Point, radius: f64, from: f64, step: f64) -> CubicBez {
    let handle = 4.0 / 3.0 * (step / 4.0).tan() * radius;
    let (u, v) = (Vec2::from_angle(from), Vec2::from_angle(from + step));
    let (p, q) = (centre + u * radius, centre + v * radius);
    CubicBez::new(p, p + Vec2::new(-u.y, u.x) * handle, q - Vec2::new(-v.y, v.x) * handle, q)
}

/// Unites the convex hulls of neighbouring discs: for cusps, loops and pens wider than the bend.
fn united_hulls(track: &Track, from: f64, to: f64, tolerance: f64, path: &mut BezPath) {
    let (middle, mut pens) = (f64::midpoint(from, to), vec![track.pen(from)]);
    divide(track, from, middle, 0, tolerance, &mut pens);
    divide(track, middle, to, 0, tolerance, &mut pens);
    for pair in pens.windows(2) {
        hull(&pair[0], &pair[1], path);
    }
}

/// The convex hull of two discs.
fn hull(a: &Pen, b: &Pen, path: &mut BezPath) {
    let (small, large) = if a.radius < b.radius { (a, b) } else { (b, a) };
    if large.radius < 1e-6 {
        return;
    }
    let along = large.at - small.at;
    let (distance, more) = (along.hypot(), large.radius - small.radius);
    let mut segments = Vec::with_capacity(8);
    let mut arc = |pen: &Pen, from: f64, turn: f64| {
        let rim = |angle| pen.at + Vec2::from_angle(angle) * pen.radius;
        let places = (rim(from), rim(from + turn));
        if let Some(last) = segments.last().map(PathSeg::end) {
            segments.push(Line::new(last, places.0).into());
        }
        around(pen.at, places, turn, 0.0, &mut segments);
    };
    if distance <= more + 1e-9 {
        arc(large, PI, -TAU);
    } else {
        // From the direction of the line between them to where the hull leaves their rims.
        let (ahead, angle) = (along.atan2(), (-more / distance).acos());
        arc(large, ahead + angle, -2.0 * angle);
        arc(small, ahead - angle, 2.0 * angle - TAU);
    }
    contour(segments, path);
}

/// Adds pens until the discs between two neighbours stay within `tolerance` of their hull.
fn divide(track: &Track, a: f64, b: f64, depth: u32, tolerance: f64, pens: &mut Vec<Pen>) {
    let middle = f64::midpoint(a, b);
    let [pa, pm, pb] = [a, middle, b].map(|t| track.pen(t));
    let off_chord = (pm.at - pa.at.midpoint(pb.at)).hypot();
    let off_width = (pm.radius - f64::midpoint(pa.radius, pb.radius)).abs();
    if depth < 9 && off_chord.max(off_width) > tolerance {
        divide(track, a, middle, depth + 1, tolerance, pens);
        divide(track, middle, b, depth + 1, tolerance, pens);
    } else {
        pens.push(pb);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Knot;
    use kurbo::Shape;
    use proptest::prelude::*;

    fn covered(path: &BezPath, p: Point) -> bool {
        path.winding(p) != 0
    }

    #[test]
    fn a_straight_even_stroke_is_a_capsule() {
        let k = |x| Knot::new(x, 0.0, 10.0);
        let path = outline(&[Ribbon([k(0.0), k(30.0), k(60.0), k(90.0)])], 0.01);
        let area = path.area().abs();
        let truth = 90.0 * 10.0 + PI * 25.0;
        assert!((area - truth).abs() < 0.01 * truth, "{area} against {truth}");
    }

    #[test]
    fn a_stroke_without_width_draws_nothing() {
        let k = |x| Knot::new(x, 0.0, 0.0);
        assert!(outline(&[Ribbon([k(0.0), k(1.0), k(2.0), k(3.0)])], 0.01).elements().is_empty());
    }

    #[test]
    fn a_chain_is_one_contour_and_a_ring_two() {
        let contours = |path: &BezPath| path.elements().iter().filter(|e| matches!(e, PathEl::MoveTo(_))).count();
        let k = |x, y| Knot::new(x, y, 4.0);
        let half = |up: f64| {
            Ribbon([k(-40.0 * up, 0.0), k(-40.0 * up, 53.0 * up), k(40.0 * up, 53.0 * up), k(40.0 * up, 0.0)])
        };
        let wave = [half(1.0), Ribbon([k(40.0, 0.0), k(40.0, -53.0), k(120.0, -53.0), k(120.0, 0.0)])];
        assert_eq!(contours(&outline(&wave, 0.01)), 1);
        let ring = outline(&[half(1.0), half(-1.0)], 0.01);
        assert_eq!(contours(&ring), 2);
        assert!(!covered(&ring, Point::ZERO) && covered(&ring, Point::new(40.0, 0.0)));
        // Where a line turns sharply it has a round joint, and no gap on either side.
        let corner = [
            Ribbon([k(0.0, 0.0), k(10.0, 0.0), k(20.0, 0.0), k(30.0, 0.0)]),
            Ribbon([k(30.0, 0.0), k(30.0, 10.0), k(30.0, 20.0), k(30.0, 30.0)]),
        ];
        let path = outline(&corner, 0.01);
        assert_eq!(contours(&path), 1);
        for (x, y, inked) in
            [(31.3, -1.3, true), (31.6, -1.6, false), (28.1, 1.9, true), (27.9, 2.1, false), (30.0, 0.0, true)]
        {
            assert_eq!(covered(&path, Point::new(x, y)), inked, "{x} {y}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(128))]

        /// Against the truth, the union of discs: nothing well inside is missed, nothing well outside is inked.
        #[test]
        fn any_stroke_covers_its_discs_and_nothing_else(
            c in prop::array::uniform4((0.0..100.0f64, 0.0..100.0f64, 0.0..20.0f64)),
        ) {
            let ribbon = Ribbon(c.map(|(x, y, w)| Knot::new(x, y, w)));
            let path = outline(&[ribbon], 0.02);
            let discs: Vec<Knot> = (0..=400).map(|i| ribbon.eval(f64::from(i) / 400.0)).collect();
            for gx in 0..26 {
                for gy in 0..26 {
                    let p = Point::new(f64::from(gx) * 5.0 - 12.0 + 0.37, f64::from(gy) * 5.0 - 12.0 + 0.21);
                    let depth = discs.iter().map(|k| k.w / 2.0 - (k.point() - p).hypot()).fold(f64::MIN, f64::max);
                    prop_assert!(depth < 0.25 || covered(&path, p), "missed {p:?} at depth {depth}");
                    prop_assert!(depth > -0.25 || !covered(&path, p), "inked {p:?} at depth {depth}");
                }
            }
        }
    }
}

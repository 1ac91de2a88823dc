//! Outlines in fewer curves: two that go on smoothly into each other become one where nobody could tell.

use crate::geometry::{BezPath, CubicBez, ParamCurve, ParamCurveNearest, PathEl, Point};

/// Places along a curve at which it is compared.
const LOOKS: u32 = 8;

/// How far a corner may bend and still be none, as the sine of its angle.
const SMOOTH: f64 = 0.12;

/// The same outline with curves joined, no further from it than `most`.
pub(crate) fn fewer(path: &BezPath, most: f64) -> BezPath {
    let mut out = BezPath::new();
    // The curve that is being made longer, and those it stands for.
    let mut open: Option<(CubicBez, Vec<CubicBez>)> = None;
    let mut at = Point::ORIGIN;
    for element in path.elements() {
        if let PathEl::CurveTo(a, b, c) = *element {
            let next = CubicBez::new(at, a, b, c);
            at = c;
            if let Some((joined, of)) = &mut open {
                of.push(next);
                if let Some(longer) = join(*joined, next).filter(|longer| stands_for(*longer, of, most)) {
                    *joined = longer;
                    continue;
                }
            }
            if let Some((done, _)) = open.replace((next, vec![next])) {
                out.curve_to(done.p1, done.p2, done.p3);
            }
            continue;
        }
        if let Some((done, _)) = open.take() {
            out.curve_to(done.p1, done.p2, done.p3);
        }
        if let Some(end) = element.end_point() {
            at = end;
        }
        out.push(*element);
    }
    if let Some((done, _)) = open {
        out.curve_to(done.p1, done.p2, done.p3);
    }
    out
}

/// The curve that two are the parts of, were it cut where they meet; none at a corner.
fn join(a: CubicBez, b: CubicBez) -> Option<CubicBez> {
    let (before, after) = (a.p3 - a.p2, b.p1 - b.p0);
    let (first, second) = (before.hypot(), after.hypot());
    if first + second <= 0.0 || first == 0.0 || second == 0.0 {
        return None;
    }
    let is_smooth = before.dot(after) > 0.0 && before.cross(after).abs() <= SMOOTH * first * second;
    // De Casteljau's cut at t leaves handles of t and 1 − t of the whole one's.
    let t = first / (first + second);
    is_smooth.then(|| CubicBez::new(a.p0, a.p0 + (a.p1 - a.p0) / t, b.p3 + (b.p2 - b.p3) / (1.0 - t), b.p3))
}

/// Whether a curve is nowhere further than `most` from those it takes the place of.
fn stands_for(one: CubicBez, of: &[CubicBez], most: f64) -> bool {
    // A millionth of a step decides nothing.
    const EXACT: f64 = 1e-6;
    let is_near = |p: Point| one.nearest(p, EXACT).distance_sq <= most * most;
    of.iter().all(|part| (1..=LOOKS).all(|i| is_near(part.eval(f64::from(i) / f64::from(LOOKS)))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Circle, Shape as _};
    use proptest::prelude::*;

    #[test]
    fn a_curve_that_was_cut_becomes_whole_again() {
        let whole = CubicBez::new((0.0, 0.0), (40.0, 90.0), (120.0, -60.0), (200.0, 30.0));
        let mut path = BezPath::new();
        path.move_to(whole.p0);
        for (from, to) in [(0.0, 0.2), (0.2, 0.5), (0.5, 0.9), (0.9, 1.0)] {
            let part = whole.subsegment(from..to);
            path.curve_to(part.p1, part.p2, part.p3);
        }
        let PathEl::CurveTo(a, b, _) = fewer(&path, 0.5).elements()[1] else { panic!("a curve") };
        assert_eq!(fewer(&path, 0.5).elements().len(), 2);
        assert!(a.distance(whole.p1) < 1.0 && b.distance(whole.p2) < 1.0);
    }

    proptest! {
        #[test]
        fn no_outline_moves_by_more_than_was_said(
            points in prop::collection::vec((-60..60_i32, -60..60_i32), 4..40), most in 0.3..3.0_f64,
        ) {
            let at = |i: usize| Point::new(f64::from(points[i].0), f64::from(points[i].1));
            let mut path = BezPath::new();
            path.move_to(at(0));
            (1..points.len() / 3).for_each(|i| path.curve_to(at(3 * i), at(3 * i + 1), at(3 * i + 2)));
            path.close_path();
            let less = fewer(&path, most);
            prop_assert!(less.elements().len() <= path.elements().len());
            let far = |p: Point| {
                let near = less.segments().map(|s| s.nearest(p, 1e-6).distance_sq);
                near.fold(f64::INFINITY, f64::min).sqrt()
            };
            for part in path.segments() {
                prop_assert!((0..=8).all(|i| far(part.eval(f64::from(i) / 8.0)) <= most + 1e-3));
            }
        }
    }

    #[test]
    fn corners_stay() {
        let path = Circle::new((0.0, 0.0), 30.0).to_path(1e-4);
        let round = fewer(&path, 0.2).elements().len();
        assert!(round <= path.elements().len() && round >= 4, "{round}");
        let mut square = BezPath::new();
        square.move_to((0.0, 0.0));
        square.curve_to((3.0, 0.0), (6.0, 0.0), (9.0, 0.0));
        square.curve_to((9.0, 3.0), (9.0, 6.0), (9.0, 9.0));
        assert_eq!(fewer(&square, 1.0).elements().len(), 3);
    }
}

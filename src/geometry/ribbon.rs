//! A cubic Bézier in (x, y, width), and the clean filled outline of what it draws.
//!
//! The width is a third coordinate of the curve, so it runs continuously between the widths given at the control
//! points and may touch 0 (SOURCES.md 1, "stroke width"). What is drawn is the union of the discs of diameter w(t)
//! about P(t); its outline is the envelope of those discs. Where the envelope is regular it is fitted with a few
//! cubics; where the pen is too wide for the curve's bend it folds, and convex hulls of neighbouring discs are
//! united instead, which holds for any input.

use kurbo::{
    BezPath, CurveFitSample, ParamCurve, ParamCurveFit, ParamCurveNearest, PathEl, Point, Vec2, fit_to_bezpath,
};

/// One control point: a place and the width of the stroke there (paper eq. 4).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Knot {
    /// To the right.
    pub x: f64,
    /// Down.
    pub y: f64,
    /// Full width, in the same unit as x and y; below 0 counts as 0.
    pub w: f64,
}

impl Knot {
    /// A control point.
    #[must_use]
    pub const fn new(x: f64, y: f64, w: f64) -> Self {
        Self { x, y, w }
    }

    /// Where it is.
    #[must_use]
    pub const fn point(self) -> Point {
        Point::new(self.x, self.y)
    }
}

/// A cubic stroke of varying width: four control points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ribbon(pub [Knot; 4]);

/// The pen at one parameter.
#[derive(Clone, Copy)]
struct Pen {
    at: Point,
    tangent: Vec2,
    radius: f64,
    /// Change of the radius per unit of arc length.
    flare: f64,
}

impl Pen {
    /// Where the envelope touches the disc on one side: the contact points of a family of
    /// discs lie at r (±√(1 − r'²) n − r' τ) from the centre, r' being the change of r along the curve.
    fn contact(&self, side: f64) -> Point {
        let k = self.flare.clamp(-MAX_FLARE, MAX_FLARE);
        let normal = Vec2::new(-self.tangent.y, self.tangent.x);
        self.at + self.radius * (side * (1.0 - k * k).sqrt() * normal - k * self.tangent)
    }
}

/// Above this change of radius per length, one disc swallows the next and there is no envelope.
const MAX_FLARE: f64 = 0.98;

impl Ribbon {
    /// The centre line.
    #[must_use]
    pub fn centre(&self) -> kurbo::CubicBez {
        let [a, b, c, d] = self.0.map(Knot::point);
        kurbo::CubicBez::new(a, b, c, d)
    }

    /// The stroke drawn the other way.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let [a, b, c, d] = self.0;
        Self([d, c, b, a])
    }

    /// The stroke in the paper's own reading of widths, by "interpolation of the adjacent control points": from one
    /// control point's width straight to the next one's, each in a third of the parameter, so that the inner widths
    /// are reached. The three parts are one stroke when they are drawn as a chain.
    #[must_use]
    pub fn as_in_paper(&self) -> [Self; 3] {
        let centre = self.centre();
        std::array::from_fn(|i| {
            let c = kurbo::ParamCurve::subsegment(&centre, i as f64 / 3.0..(i + 1) as f64 / 3.0);
            let (from, to) = (self.0[i].w.max(0.0), self.0[i + 1].w.max(0.0));
            let knot = |p: Point, t: f64| Knot::new(p.x, p.y, super::lerp(from, to, t));
            Self([knot(c.p0, 0.0), knot(c.p1, 1.0 / 3.0), knot(c.p2, 2.0 / 3.0), knot(c.p3, 1.0)])
        })
    }

    /// Place and width at a parameter, 0 to 1.
    #[must_use]
    pub fn eval(&self, t: f64) -> Knot {
        let s = 1.0 - t;
        let weights = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
        let sum = |f: fn(&Knot) -> f64| self.0.iter().zip(weights).map(|(k, b)| f(k) * b).sum();
        Knot::new(sum(|k| k.x), sum(|k| k.y), sum(|k| k.w))
    }

    fn pen(&self, t: f64) -> Pen {
        let s = 1.0 - t;
        let slope = |f: fn(&Knot) -> f64| {
            let [a, b, c, d] = [f(&self.0[0]), f(&self.0[1]), f(&self.0[2]), f(&self.0[3])];
            3.0 * (s * s * (b - a) + 2.0 * s * t * (c - b) + t * t * (d - c))
        };
        let mut velocity = Vec2::new(slope(|k| k.x), slope(|k| k.y));
        if velocity.hypot() < 1e-7 {
            // A handle lies on its end point: the chord of a small piece gives the direction the derivative lost.
            let (a, b) = (self.eval((t - 1e-4).max(0.0)), self.eval((t + 1e-4).min(1.0)));
            velocity = (b.point() - a.point()) / 2e-4;
        }
        let speed = velocity.hypot().max(1e-9);
        let knot = self.eval(t);
        let flare = if knot.w > 0.0 { slope(|k| k.w) / 2.0 / speed } else { 0.0 };
        Pen { at: knot.point(), tangent: velocity / speed, radius: knot.w.max(0.0) / 2.0, flare }
    }

    /// Stretches of the parameter, and whether both sides of the envelope run forward on each, so that it can be fitted.
    fn stretches(&self) -> Vec<(f64, f64, bool)> {
        const STEPS: usize = 32;
        let at = |i: usize| i as f64 / STEPS as f64;
        let pens: [Pen; STEPS + 1] = std::array::from_fn(|i| self.pen(at(i)));
        let mut all: Vec<(f64, f64, bool)> = Vec::with_capacity(4);
        for (i, w) in pens.windows(2).enumerate() {
            let ahead = w[0].tangent + w[1].tangent;
            let forward = |side| (w[1].contact(side) - w[0].contact(side)).dot(ahead) > 0.0;
            let slow = w[0].flare.abs().max(w[1].flare.abs()) < 0.9;
            let regular = slow && w[0].tangent.dot(w[1].tangent) > 0.7 && forward(1.0) && forward(-1.0);
            match all.last_mut() {
                Some((_, to, same)) if *same == regular => *to = at(i + 1),
                _ => all.push((at(i), at(i + 1), regular)),
            }
        }
        all
    }
}

/// One side of the envelope, as the curve to fit.
struct Side<'a> {
    ribbon: &'a Ribbon,
    side: f64,
    from: f64,
    to: f64,
}

impl Side<'_> {
    fn at(&self, t: f64) -> Point {
        self.ribbon.pen(super::lerp(self.from, self.to, t)).contact(self.side)
    }

    /// The contact point's derivative needs third derivatives of the stroke; a central difference is as exact as
    /// the fit can use.
    fn derivative(&self, t: f64) -> Vec2 {
        const H: f64 = 1e-5;
        let (a, b) = ((t - H).max(0.0), (t + H).min(1.0));
        (self.at(b) - self.at(a)) / (b - a)
    }
}

/// Pieces of a side that cannot be fitted.
const FINE: usize = 32;

impl Side<'_> {
    /// Whether a path stays near the curve: now and then a fit bulges where the curve nearly has a cusp.
    fn is_followed_by(&self, path: &BezPath, tolerance: f64) -> bool {
        let line: [Point; 65] = std::array::from_fn(|i| self.at(i as f64 / 64.0));
        let longest = line.windows(2).map(|w| (w[1] - w[0]).hypot2()).fold(0.0, f64::max).sqrt();
        let most = 4.0 * tolerance + 0.05 * longest;
        let near = |p: Point| {
            line.windows(2).any(|w| kurbo::Line::new(w[0], w[1]).nearest(p, 1e-3).distance_sq <= most * most)
        };
        path.segments().all(|piece| [0.25, 0.5, 0.75].into_iter().all(|t| near(piece.eval(t))))
    }

    /// The curve as so many cubics between equal steps of its parameter.
    fn in_pieces(&self, pieces: usize) -> BezPath {
        let step = 1.0 / pieces as f64;
        let at = |i: usize| (self.at(i as f64 * step), self.derivative(i as f64 * step) * (step / 3.0));
        let points: Vec<(Point, Vec2)> = (0..=pieces).map(at).collect();
        let mut path = BezPath::new();
        path.move_to(points[0].0);
        for pair in points.windows(2) {
            let ((a, da), (b, db)) = (pair[0], pair[1]);
            // A fold has derivatives without end: no handle is longer than its piece.
            let most = (b - a).hypot();
            let held = |v: Vec2| v * (most / v.hypot().max(1e-12)).min(1.0);
            path.curve_to(a + held(da), b - held(db), b);
        }
        path
    }
}

impl ParamCurveFit for Side<'_> {
    fn sample_pt_tangent(&self, t: f64, _sign: f64) -> CurveFitSample {
        CurveFitSample { p: self.at(t), tangent: self.derivative(t) }
    }

    fn sample_pt_deriv(&self, t: f64) -> (Point, Vec2) {
        (self.at(t), self.derivative(t))
    }

    fn break_cusp(&self, _range: std::ops::Range<f64>) -> Option<f64> {
        None
    }
}

/// The outline of a chain of strokes as one path to be filled non-zero: every part winds the same way, so where
/// strokes overlap, at their joints, they unite. `tolerance` is the largest distance from the true outline.
#[must_use]
pub fn outline(chain: &[Ribbon], tolerance: f64) -> BezPath {
    let mut path = BezPath::new();
    for ribbon in chain {
        if ribbon.0.iter().all(|k| k.w <= 0.0) {
            continue;
        }
        for (from, to, regular) in ribbon.stretches() {
            if regular {
                fitted(ribbon, from, to, tolerance, &mut path);
            } else {
                united_hulls(ribbon, from, to, tolerance, &mut path);
            }
        }
    }
    path
}

fn fitted(ribbon: &Ribbon, from: f64, to: f64, tolerance: f64, path: &mut BezPath) {
    let side = |side| {
        let curve = Side { ribbon, side, from, to };
        let path = fit_to_bezpath(&curve, tolerance);
        if curve.is_followed_by(&path, tolerance) { path } else { curve.in_pieces(FINE) }
    };
    let (left, right) = (side(1.0), side(-1.0).reverse_subpaths());
    let (start, end) = (ribbon.pen(from), ribbon.pen(to));
    path.extend(left.elements().iter().copied());
    cap(path, &end, end.contact(1.0), end.contact(-1.0));
    path.extend(right.elements().iter().skip(1).copied());
    cap(path, &start, start.contact(-1.0), start.contact(1.0));
    path.push(PathEl::ClosePath);
}

/// Goes round the pen's disc from one contact point to the other, against the clock in these coordinates.
fn cap(path: &mut BezPath, pen: &Pen, from: Point, to: Point) {
    arc(path, pen.at, from - pen.at, to - pen.at);
}

/// An arc about `centre` that turns by a negative angle, in cubics of at most a quarter turn each.
fn arc(path: &mut BezPath, centre: Point, from: Vec2, to: Vec2) {
    use std::f64::consts::{FRAC_PI_2, TAU};
    let radius = from.hypot();
    if radius < 1e-6 {
        path.line_to(centre + to);
        return;
    }
    let start = from.atan2();
    let mut turn = to.atan2() - start;
    while turn > 0.0 {
        turn -= TAU;
    }
    let pieces = (-turn / FRAC_PI_2 - 1e-9).ceil().max(1.0);
    let step = turn / pieces;
    for i in 0..pieces as usize {
        turn_by(path, centre, radius, start + step * i as f64, step);
    }
}

/// Unites the convex hulls of neighbouring discs: for cusps, loops and pens wider than the bend.
fn united_hulls(ribbon: &Ribbon, from: f64, to: f64, tolerance: f64, path: &mut BezPath) {
    let (middle, mut parameters) = (f64::midpoint(from, to), vec![from]);
    divide(ribbon, from, middle, 0, tolerance, &mut parameters);
    divide(ribbon, middle, to, 0, tolerance, &mut parameters);
    for pair in parameters.windows(2) {
        let (mut a, mut b) = (ribbon.pen(pair[0]), ribbon.pen(pair[1]));
        let along = b.at - a.at;
        let distance = along.hypot();
        if distance <= (a.radius - b.radius).abs() + 1e-9 {
            let larger = if a.radius > b.radius { a } else { b };
            if larger.radius > 1e-6 {
                let r = Vec2::new(larger.radius, 0.0);
                path.move_to(larger.at + r);
                arc(path, larger.at, r, -r);
                arc(path, larger.at, -r, r);
                path.close_path();
            }
            continue;
        }
        (a.tangent, b.tangent) = (along / distance, along / distance);
        let flare = (b.radius - a.radius) / distance;
        (a.flare, b.flare) = (flare, flare);
        path.move_to(a.contact(1.0));
        path.line_to(b.contact(1.0));
        cap(path, &b, b.contact(1.0), b.contact(-1.0));
        path.line_to(a.contact(-1.0));
        cap(path, &a, a.contact(-1.0), a.contact(1.0));
        path.close_path();
    }
}

/// Adds parameters until the discs between two neighbours stay within `tolerance` of their hull.
fn divide(ribbon: &Ribbon, a: f64, b: f64, depth: u32, tolerance: f64, parameters: &mut Vec<f64>) {
    let (pa, pb, pm) = (ribbon.eval(a), ribbon.eval(b), ribbon.eval((a + b) / 2.0));
    let off_chord = (pm.point() - pa.point().midpoint(pb.point())).hypot();
    let off_width = (pm.w.max(0.0) - (pa.w.max(0.0) + pb.w.max(0.0)) / 2.0).abs() / 2.0;
    if depth < 9 && off_chord.max(off_width) > tolerance {
        divide(ribbon, a, f64::midpoint(a, b), depth + 1, tolerance, parameters);
        divide(ribbon, f64::midpoint(a, b), b, depth + 1, tolerance, parameters);
    } else {
        parameters.push(b);
    }
}

/// The outline of a chain with always the same elements: for outputs that let one shape change into another. A stroke
/// is one closed part of `pieces` cubics a side and two a cap, also where it is too narrow to be seen. Where the
/// envelope is regular it is off by less than the width of a hair line at four pieces; where it folds, it is less exact
/// than [`outline`].
#[must_use]
pub fn outline_in_pieces(chain: &[Ribbon], pieces: usize) -> BezPath {
    let mut path = BezPath::new();
    let pieces = pieces.max(1);
    for ribbon in chain {
        let side = |side: f64| Side { ribbon, side, from: 0.0, to: 1.0 }.in_pieces(pieces);
        let (left, right) = (side(1.0), side(-1.0).reverse_subpaths());
        let (start, end) = (ribbon.pen(0.0), ribbon.pen(1.0));
        path.extend(left.elements().iter().copied());
        half_turns(&mut path, end.at, end.contact(1.0) - end.at, end.contact(-1.0) - end.at);
        path.extend(right.elements().iter().skip(1).copied());
        half_turns(&mut path, start.at, start.contact(-1.0) - start.at, start.contact(1.0) - start.at);
        path.close_path();
    }
    path
}

/// An [`arc`] in two cubics, whatever its turn.
fn half_turns(path: &mut BezPath, centre: Point, from: Vec2, to: Vec2) {
    let radius = from.hypot();
    let start = from.atan2();
    let turn = (to.atan2() - start).rem_euclid(std::f64::consts::TAU) - std::f64::consts::TAU;
    let step = if radius < 1e-6 { 0.0 } else { turn / 2.0 };
    turn_by(path, centre, radius, start, step);
    turn_by(path, centre, radius, start + step, step);
}

/// A cubic about `centre` that turns by `step` from the direction `from`. Its handles' length makes it meet the circle
/// at both ends and in the middle.
fn turn_by(path: &mut BezPath, centre: Point, radius: f64, from: f64, step: f64) {
    let handle = 4.0 / 3.0 * (step / 4.0).tan() * radius;
    let (u, v) = (Vec2::from_angle(from), Vec2::from_angle(from + step));
    let (p, q) = (centre + u * radius, centre + v * radius);
    path.curve_to(p + Vec2::new(-u.y, u.x) * handle, q - Vec2::new(-v.y, v.x) * handle, q);
}

#[cfg(test)]
mod tests {
    use super::*;
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
        let truth = 90.0 * 10.0 + std::f64::consts::PI * 25.0;
        assert!((area - truth).abs() < 0.01 * truth, "{area} against {truth}");
    }

    #[test]
    fn a_stroke_without_width_draws_nothing() {
        let k = |x| Knot::new(x, 0.0, 0.0);
        assert!(outline(&[Ribbon([k(0.0), k(1.0), k(2.0), k(3.0)])], 0.01).elements().is_empty());
    }

    #[test]
    fn the_paper_s_widths_are_those_of_its_control_points() {
        let stroke = Ribbon(
            [(0.0, 0.0, 1.0), (10.0, 20.0, 4.0), (30.0, 20.0, 2.0), (40.0, 0.0, 3.0)]
                .map(|(x, y, w)| Knot::new(x, y, w)),
        );
        let parts = stroke.as_in_paper();
        for (i, part) in parts.iter().enumerate() {
            let (start, end) = (stroke.0[i].w, stroke.0[i + 1].w);
            assert!((part.eval(0.0).w - start).abs() < 1e-12 && (part.eval(1.0).w - end).abs() < 1e-12);
            assert!((part.eval(0.5).w - (start + end) / 2.0).abs() < 1e-12);
            let whole = stroke.eval((i as f64 + 0.5) / 3.0);
            assert!((part.eval(0.5).point() - whole.point()).hypot() < 1e-9);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(128))]

        #[test]
        fn an_outline_in_pieces_has_always_the_same_elements(
            c in prop::array::uniform4((0.0..100.0f64, 0.0..100.0f64, -5.0..20.0f64)),
            pieces in 1_usize..9,
        ) {
            let ribbon = Ribbon(c.map(|(x, y, w)| Knot::new(x, y, w)));
            let kinds = |path: &BezPath| path.elements().iter().map(std::mem::discriminant).collect::<Vec<_>>();
            let nothing = Ribbon([Knot::default(); 4]);
            let path = outline_in_pieces(&[ribbon, nothing], pieces);
            prop_assert_eq!(kinds(&path), kinds(&outline_in_pieces(&[nothing, nothing], pieces)));
            prop_assert_eq!(path.elements().len(), 2 * (2 * pieces + 6));
            prop_assert!(path.is_finite());
        }

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

//! Both sides of the envelope of a stroke's discs, as few cubics.
//!
//! A cubic starts and ends on the envelope with its tangents there; the lengths of its two handles are chosen so that
//! it meets the envelope at two places between. Where it is still too far off, the piece is halved. kurbo's own fitting
//! takes as many cubics and ten times as long.

use kurbo::{CubicBez, ParamCurve, PathSeg, Vec2};

use super::pen::{Pen, Track};

/// A stretch of a stroke's parameter.
pub(super) struct Stretch {
    pub(super) from: f64,
    pub(super) to: f64,
    /// Whether both sides of the envelope run forward on it, so that they are its outline.
    pub(super) regular: bool,
}

/// Steps over a whole stroke in which it is looked at.
const STEPS: f64 = 32.0;

/// Where a handle's length makes a cubic meet the envelope.
const MET: [f64; 2] = [0.28, 0.72];

/// Where it is furthest off then.
const CHECKED: [f64; 3] = [0.12, 0.5, 0.88];

/// A piece is halved at most so often.
const DEEPEST: u32 = 7;

/// The stretches of a stroke between two parameters, in order.
pub(super) fn stretches(track: &Track, (from, to): (f64, f64)) -> Vec<Stretch> {
    let steps = ((to - from) * STEPS).ceil().max(4.0) as usize;
    let at = |i: usize| super::lerp(from, to, i as f64 / steps as f64);
    let mut all: Vec<Stretch> = Vec::with_capacity(4);
    let mut a = track.pen(from);
    for i in 1..=steps {
        let b = track.pen(at(i));
        let ahead = a.tangent + b.tangent;
        let forward = |side| (b.contact(side) - a.contact(side)).dot(ahead) > 0.0;
        let slow = a.flare.abs().max(b.flare.abs()) < 0.9;
        let regular = slow && a.tangent.dot(b.tangent) > 0.7 && forward(1.0) && forward(-1.0);
        match all.last_mut() {
            Some(last) if last.regular == regular => last.to = at(i),
            _ => all.push(Stretch { from: at(i - 1), to: at(i), regular }),
        }
        a = b;
    }
    all
}

/// Adds the cubics of the two sides of a regular stretch, both from its start to its end, none further than `tolerance`
/// from the envelope.
pub(super) fn fit(track: &Track, stretch: &Stretch, tolerance: f64, sides: &mut [Vec<PathSeg>; 2]) {
    let ends = (track.pen(stretch.from), track.pen(stretch.to));
    piece(track, (stretch.from, stretch.to), ends, (tolerance, DEEPEST), sides);
}

fn piece(
    track: &Track,
    (from, to): (f64, f64),
    (a, b): (Pen, Pen),
    (tolerance, deeper): (f64, u32),
    sides: &mut [Vec<PathSeg>; 2],
) {
    let inner = |s: f64| track.pen(super::lerp(from, to, s));
    let (met, checked) = (MET.map(inner), CHECKED.map(inner));
    let third = (to - from) / 3.0;
    let cubics = [1.0, -1.0].map(|side| {
        let cubic = meeting([&a, &b], third, &met, side);
        let off = |(pen, s): (&Pen, f64)| off(&cubic, s, pen, side).abs();
        let far = checked.iter().zip(CHECKED).chain(met.iter().zip(MET)).map(off).fold(0.0, f64::max);
        (far <= tolerance).then_some(cubic)
    });
    match cubics {
        [Some(left), Some(right)] => {
            sides[0].push(left.into());
            sides[1].push(right.into());
        }
        _ if deeper > 0 => {
            let (middle, [_, pen, _]) = (f64::midpoint(from, to), checked);
            piece(track, (from, middle), (a, pen), (tolerance, deeper - 1), sides);
            piece(track, (middle, to), (pen, b), (tolerance, deeper - 1), sides);
        }
        _ => {
            for (side, sign) in sides.iter_mut().zip([1.0, -1.0]) {
                side.push(between(&a, &b, third, sign).into());
            }
        }
    }
}

/// The cubic with the envelope's ends and rates there; `third` is a third of the parameter between them.
pub(super) fn between(a: &Pen, b: &Pen, third: f64, side: f64) -> CubicBez {
    let (p, q) = (a.contact(side), b.contact(side));
    // A fold has rates without end: no handle is longer than its piece.
    let most = (q - p).hypot();
    let held = |v: Vec2| v * (most / v.hypot().max(1e-12)).min(1.0);
    CubicBez::new(p, p + held(a.slope(side) * third), q - held(b.slope(side) * third), q)
}

/// The same with handles of such lengths that it meets the envelope twice between its ends, where there are such.
fn meeting([a, b]: [&Pen; 2], third: f64, met: &[Pen; 2], side: f64) -> CubicBez {
    let cubic = between(a, b, third, side);
    let (first, last) = (cubic.p1 - cubic.p0, cubic.p3 - cubic.p2);
    // How far a longer handle moves the cubic outward, and how far it has to go.
    let row = |i: usize| {
        let (s, u) = (MET[i], met[i].outward(side));
        let r = 1.0 - s;
        [3.0 * s * r * r * first.dot(u), -3.0 * s * s * r * last.dot(u), -off(&cubic, s, &met[i], side)]
    };
    let ([a, b, e], [c, d, f]) = (row(0), row(1));
    let det = a * d - b * c;
    let (x, y) = ((e * d - b * f) / det, (a * f - e * c) / det);
    // Not a number or far away where the piece is straight: it needs none.
    if x.abs() < 0.5 && y.abs() < 0.5 {
        CubicBez::new(cubic.p0, cubic.p1 + x * first, cubic.p2 - y * last, cubic.p3)
    } else {
        cubic
    }
}

/// How far outside the envelope's point a cubic passes it; `s` is about where.
fn off(cubic: &CubicBez, s: f64, pen: &Pen, side: f64) -> f64 {
    let (place, u) = (pen.contact(side), pen.outward(side));
    let along = Vec2::new(-u.y, u.x);
    // Its own parameter runs ahead or behind: to where it is abreast of the point (Newton).
    let mut s = s;
    for _ in 0..2 {
        let rate = cubic_rate(cubic, s).dot(along);
        let ahead = (cubic.eval(s) - place).dot(along) / rate;
        s = if ahead.abs() < 0.2 { (s - ahead).clamp(0.0, 1.0) } else { s };
    }
    (cubic.eval(s) - place).dot(u)
}

fn cubic_rate(c: &CubicBez, s: f64) -> Vec2 {
    let r = 1.0 - s;
    3.0 * (r * r * (c.p1 - c.p0) + 2.0 * r * s * (c.p2 - c.p1) + s * s * (c.p3 - c.p2))
}

//! The jaw's edge in the photo, and the handles of the cubic that follows it (thesis sec. 4.2.2.2 B: the inner
//! handles are moved until the curve lies on the edge).

use super::frame::Frame;
use super::shape::{Shape, USUAL_JAW, jaw_curve};
use crate::face::FeaturePoint as P;
use crate::geometry::{CubicBez, ParamCurve, ParamCurveDeriv, ParamCurveNearest, Point, Vec2};

/// The handles of a jaw whose edge is not seen at all: a soft one (recipe part 1).
const UNSEEN: [f64; 2] = [0.6, 0.5];
/// Places along each half of the jaw at which its edge is looked for.
const PLACES: usize = 20;
/// How far from the usual jaw the edge is looked for, in units.
const REACH: i32 = 12;
/// Steps a unit of that search.
const STEPS: i32 = 2;

/// A place of the edge and how clearly it is seen there, 0 to 1.
struct Seen {
    at: Point,
    clear: f64,
}

/// The handles (see [`Measures::jaw`](crate::face::Measures::jaw)) that bring both cubics nearest to the edge, held
/// to the usual ones as far as the edge cannot be seen.
pub(super) fn handles(frame: &Frame, shape: &Shape) -> [f64; 2] {
    let p = &shape.points;
    let halves = [(P::P2_14, P::P10_6), (P::P2_13, P::P10_5)].map(|(corner, lobe)| {
        let usual = jaw_curve(p[P::P2_1], p[corner], p[lobe], USUAL_JAW);
        (corner, lobe, edge(frame, &usual))
    });
    let cost = |handles: [f64; 2]| {
        let mut sum = 0.0;
        for (corner, lobe, seen) in &halves {
            let curve = jaw_curve(p[P::P2_1], p[*corner], p[*lobe], handles);
            for s in seen {
                let off = curve.nearest(s.at, 1e-3).distance_sq;
                // Past 5 units it is another edge: a shadow, a beard, a collar.
                sum += s.clear * (off / (1.0 + off / 25.0));
            }
        }
        // A handle 0.1 off the usual weighs as much as three clear places that are a unit off.
        const HELD: f64 = 300.0;
        let held = (handles[0] - USUAL_JAW[0]).powi(2) + (handles[1] - USUAL_JAW[1]).powi(2);
        sum + held * HELD
    };
    let clear = halves.iter().flat_map(|h| &h.2).map(|s| s.clear).sum::<f64>() / (2 * PLACES) as f64;
    if clear < 0.15 {
        return UNSEEN;
    }
    let mut best = (cost(USUAL_JAW), USUAL_JAW);
    let mut step = 0.16;
    while step > 0.006 {
        let at = best.1;
        for (da, db) in [(1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1)] {
            let tried =
                [(at[0] + f64::from(da) * step).clamp(0.25, 0.95), (at[1] + f64::from(db) * step).clamp(0.15, 0.95)];
            let c = cost(tried);
            if c < best.0 {
                best = (c, tried);
            }
        }
        if best.1 == at {
            step /= 2.0;
        }
    }
    best.1
}

/// The edge along one half: at every place the step from light skin to what is darker or of another colour, joined to
/// its neighbours (dynamic programming over the offset from the curve).
fn edge(frame: &Frame, curve: &CubicBez) -> Vec<Seen> {
    const OFFSETS: usize = (2 * REACH * STEPS + 1) as usize;
    /// What being a unit off the usual jaw costs, squared: collars and locks are strong edges too.
    const FAR: f64 = 0.0015;
    /// What a unit of change of the offset between two places costs.
    const BEND: f64 = 0.012;
    let offset = |k: usize| f64::from(k as i32 - REACH * STEPS) / f64::from(STEPS);
    let outward = |t: f64| {
        let along = curve.deriv().eval(t).to_vec2();
        let side = Vec2::new(-along.y, along.x).normalize();
        // Away from the middle of the curve's ends: below and beside it.
        let chord = curve.p0.midpoint(curve.p3);
        if side.dot(curve.eval(0.5) - Point::new(chord.x, chord.y - 40.0)) > 0.0 { side } else { -side }
    };
    // The chin and the jaw's corner are given: the edge is looked for between them.
    let places: Vec<f64> = (0..PLACES).map(|i| 0.12 + 0.80 * (i as f64 + 0.5) / PLACES as f64).collect();
    let steps: Vec<Vec<f64>> = places
        .iter()
        .map(|t| {
            let (at, out) = (curve.eval(*t), outward(*t));
            (0..OFFSETS)
                .map(|k| {
                    let tone = |by: f64| {
                        let q = at + out * (offset(k) + by);
                        frame.at(q.x, q.y)
                    };
                    let mean = |by: [f64; 3]| {
                        let three = by.map(tone);
                        [0, 1, 2].map(|c| three.iter().map(|v| v[c]).sum::<f32>() / 3.0)
                    };
                    let (inner, outer) = (mean([-1.5, -3.0, -4.5]), mean([1.5, 3.0, 4.5]));
                    let d = [0, 1, 2].map(|c| f64::from(inner[c] - outer[c]));
                    // Towards the neck's shade it gets darker; a wall or hair may differ in any way.
                    d[0].max(0.6 * -d[0]) + 1.5 * d[1].hypot(d[2]) - FAR * offset(k).powi(2)
                })
                .collect()
        })
        .collect();
    let mut total = steps[0].clone();
    let mut from: Vec<Vec<usize>> = Vec::with_capacity(PLACES);
    for row in &steps[1..] {
        let mut next = vec![f64::NEG_INFINITY; OFFSETS];
        let mut came = vec![0; OFFSETS];
        for k in 0..OFFSETS {
            for (j, before) in total.iter().enumerate().take(k + 5).skip(k.saturating_sub(4)) {
                let v = before - BEND * (offset(k) - offset(j)).abs();
                if v > next[k] {
                    next[k] = v;
                    came[k] = j;
                }
            }
            next[k] += row[k];
        }
        total = next;
        from.push(came);
    }
    let mut k = (0..OFFSETS).max_by(|a, b| total[*a].total_cmp(&total[*b])).unwrap_or(OFFSETS / 2);
    let mut path = vec![k];
    for came in from.iter().rev() {
        k = came[k];
        path.push(k);
    }
    path.reverse();
    path.iter()
        .zip(&places)
        .zip(&steps)
        .map(|((k, t), row)| {
            // A step of 0.10 is as clear as jaws get; below 0.02 it is noise.
            let clear = ((row[*k] - 0.02) / 0.08).clamp(0.0, 1.0);
            Seen { at: curve.eval(*t) + outward(*t) * offset(*k), clear }
        })
        .collect()
}

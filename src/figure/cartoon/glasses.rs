//! Glasses, where a face wears them.

use super::Pen;
use super::head::HeadShape;
use crate::drawing::{Colour, Item};
use crate::face::rig::Neutral;
use crate::face::{FeaturePoint as P, Points};
use crate::geometry::{Point, Vec2, brush, brush_ring, spline};

/// A lens is so wide and high about the middle of the eye, in pupil distances.
const WIDE: f64 = 0.385;
const HIGH: f64 = 0.285;

/// The arms, from the frames to the tops of the ears: under the hair.
pub(super) fn arms(pen: &Pen, neutral: &Neutral, head: &HeadShape) -> Vec<Item> {
    let unit = neutral.units().eye_separation;
    let one = |side: usize, sign: f64, eye: P| {
        let hinge = middle(neutral.points(), eye, sign, unit) + Vec2::new(sign * WIDE, -0.10) * unit;
        let ear = head.ear_top(side);
        let arm = [hinge, hinge.lerp(ear, 0.5), ear + Vec2::new(sign * 1.0, 2.0)];
        Item::area("arm", brush(&arm, 1.9 * pen.ink, &[1.0, 0.9, 0.6]), pen.palette.frame)
    };
    vec![one(0, -1.0, P::P3_6), one(1, 1.0, P::P3_5)]
}

/// Frames and bridge round the eyes at rest, the lenses a little brighter than what is behind them.
pub(super) fn glasses(pen: &Pen, neutral: &Neutral) -> Vec<Item> {
    let points = neutral.points();
    let unit = neutral.units().eye_separation;
    let colour = pen.palette.frame;
    let mut items = Vec::new();
    for (sign, eye) in [(-1.0, P::P3_6), (1.0, P::P3_5)] {
        let middle = middle(points, eye, sign, unit);
        let rim = lens(middle, sign, unit);
        if !pen.ink_only {
            items.push(Item::area("lens", spline(&rim, true), Colour::WHITE.faded(0.13)));
            let gleam = [(-0.22, 0.02), (-0.10, -0.13), (-0.02, -0.19)].map(|(x, y)| middle + Vec2::new(x, y) * unit);
            items.push(Item::area("gleam", brush(&gleam, 0.06 * unit, &[0.2, 1.0, 0.3]), Colour::WHITE.faded(0.35)));
        }
        items.push(Item::area("frame", brush_ring(&rim, |out| pen.ink * (1.7 - 0.5 * out.y)), colour));
    }
    let from = middle(points, P::P3_6, -1.0, unit) + Vec2::new(WIDE - 0.01, -0.08) * unit;
    let to = middle(points, P::P3_5, 1.0, unit) + Vec2::new(0.01 - WIDE, -0.08) * unit;
    let bridge = [from, from.midpoint(to) - Vec2::new(0.0, 0.045 * unit), to];
    items.push(Item::area("bridge", brush(&bridge, 1.9 * pen.ink, &[1.0, 0.8, 1.0]), colour));
    items
}

/// The middle of a lens.
fn middle(points: &Points, eye: P, sign: f64, unit: f64) -> Point {
    points[eye] + Vec2::new(sign * 0.02 * unit, 0.035 * unit)
}

/// A rounded lens, wider above and outside.
fn lens(middle: Point, sign: f64, unit: f64) -> Vec<Point> {
    const POINTS: usize = 40;
    (0..POINTS)
        .map(|i| {
            let angle = std::f64::consts::TAU * i as f64 / POINTS as f64;
            let (sin, cos) = angle.sin_cos();
            // A superellipse of power 3: between an ellipse and a box.
            let bent = |v: f64| v.signum() * v.abs().powf(2.0 / 3.0);
            let narrower = 1.0 - 0.08 * sin.max(0.0);
            middle + Vec2::new(sign * WIDE * bent(cos) * narrower, HIGH * bent(sin)) * unit
        })
        .collect()
}

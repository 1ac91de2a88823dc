//! Colours as medians of places that the points and the hair mask name.

use super::frame::{Frame, Lab, colour};
use super::shape::Shape;
use crate::face::{Colours, FeaturePoint as P};
use crate::geometry::{Point, Vec2};

/// What the cheeks show: their colour, and how light each of them is.
pub(super) struct Cheeks {
    /// The median of both.
    pub skin: Lab,
    /// The median lightness of the left and the right one.
    pub light: [f32; 2],
}

/// The quads under the eyes, from the lower lid to halfway between jaw and wing of the nose: no beard grows there, and
/// they are turned to the camera.
pub(super) fn cheeks(frame: &Frame, shape: &Shape) -> Cheeks {
    let p = &shape.points;
    let sides = [(P::P3_4, P::P2_14, P::P9_2), (P::P3_3, P::P2_13, P::P9_1)].map(|(lid, jaw, wing)| {
        let high = p[lid] + Vec2::new(0.0, 14.0);
        let low = p[jaw].midpoint(p[wing]);
        let by = |p: Point, x: f64, y: f64| p + Vec2::new(x, y);
        frame.within(&[by(high, -12.0, 0.0), by(high, 12.0, 0.0), by(low, 8.0, -6.0), by(low, -8.0, -6.0)])
    });
    let light = [&sides[0], &sides[1]].map(|side| median(side).map_or(0.5, |c| c[0]));
    let skin = median(&sides.concat()).unwrap_or([0.5, 0.0, 0.0]);
    Cheeks { skin, light }
}

/// All colours; `hair` is the median of the mask, none on a bald head.
pub(super) fn colours(frame: &Frame, shape: &Shape, cheeks: &Cheeks, hair: Option<Lab>) -> Colours {
    let brows = brows(frame, shape).unwrap_or(cheeks.skin);
    Colours {
        skin: colour(cheeks.skin),
        hair: colour(hair.unwrap_or(brows)),
        lips: colour(lips(frame, shape).unwrap_or(cheeks.skin)),
        iris: colour(iris(frame, shape).unwrap_or([0.35, 0.02, 0.03])),
        brows: colour(brows),
        beard: colour(median(&chin(frame, shape)).unwrap_or(cheeks.skin)),
    }
}

/// The lower lip without its edges and ends: points found by machine are a fifth of its height off.
fn lips(frame: &Frame, shape: &Shape) -> Option<Lab> {
    let p = &shape.points;
    let (left, right) = (p[P::P8_4], p[P::P8_3]);
    // Its two edges over the line between the corners: the outer one is full, a flat curve to the very ends.
    let edge = |deepest: Point, full: f64, t: f64| {
        let line = left.lerp(right, 0.5 + t);
        line + (deepest - left.midpoint(right)) * (1.0 - (2.0 * t).abs().powf(full))
    };
    let steps = [-0.42, -0.28, -0.1, 0.1, 0.28, 0.42];
    let at = |t: f64, share: f64| edge(p[P::P2_3], 2.0, t).lerp(edge(p[P::P8_2], 3.0, t), share);
    let mut outline: Vec<Point> = steps.iter().map(|t| at(*t, 0.12)).collect();
    outline.extend(steps.iter().rev().map(|t| at(*t, 0.87)));
    let mut lip = frame.within(&outline);
    lip.sort_by(|a, b| a[0].total_cmp(&b[0]));
    // Without lights on wet lips.
    median(&lip[..lip.len() * 88 / 100])
}

/// The ring between pupil and sclera, below the upper lid, without lashes and lights.
fn iris(frame: &Frame, shape: &Shape) -> Option<Lab> {
    let p = &shape.points;
    let mut ring: Vec<Lab> = Vec::new();
    for (eye, upper, lower) in [(P::P3_6, P::P3_2, P::P3_4), (P::P3_5, P::P3_1, P::P3_3)] {
        let middle = p[eye];
        for dy in -8..=8 {
            for dx in -8..=8 {
                let (dx, dy) = (f64::from(dx), f64::from(dy));
                let y = middle.y + dy;
                let open = y > p[upper].y + 3.0 && y < p[lower].y - 1.5;
                if (4.2..8.2).contains(&dx.hypot(dy)) && open {
                    ring.push(frame.at(middle.x + dx, y));
                }
            }
        }
    }
    ring.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let (from, to) = (ring.len() / 4, ring.len() * 9 / 10);
    median(ring.get(from..to)?)
}

/// The darker 35 % between the brows' points.
fn brows(frame: &Frame, shape: &Shape) -> Option<Lab> {
    let p = &shape.points;
    let pairs = [(P::P4_4, P::P4_4A), (P::P4_3, P::P4_3A), (P::P4_2, P::P4_4), (P::P4_1, P::P4_3)];
    let mut all: Vec<Lab> = pairs.iter().flat_map(|(a, b)| frame.around(p[*a].midpoint(p[*b]), 3.0)).collect();
    all.sort_by(|a, b| a[0].total_cmp(&b[0]));
    median(&all[..all.len() * 35 / 100])
}

/// The chin between lower lip and edge, where a beard would be.
pub(super) fn chin(frame: &Frame, shape: &Shape) -> Vec<Lab> {
    let p = &shape.points;
    let middle = p[P::P8_2].lerp(p[P::P2_1], 0.55);
    [-14.0, 0.0, 14.0].iter().flat_map(|x| frame.around(middle + Vec2::new(*x, 0.0), 3.3)).collect()
}

/// The median of each channel; none of nothing.
pub(super) fn median(colours: &[Lab]) -> Option<Lab> {
    if colours.is_empty() {
        return None;
    }
    let middle = colours.len() / 2;
    Some(std::array::from_fn(|k| {
        let mut channel: Vec<f32> = colours.iter().map(|c| c[k]).collect();
        *channel.select_nth_unstable_by(middle, f32::total_cmp).1
    }))
}

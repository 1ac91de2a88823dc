//! Hair seen from the middle of the brows: where each ray enters it for the last time and where it leaves it.

use super::super::at;
use crate::geometry::{Point, Vec2};

/// Degrees between two rays.
const STEP: f64 = 4.0;
/// The first ray runs right and down, the last left and down, and between them they go over the top.
const FIRST: f64 = -62.0;
const COUNT: usize = 77;
/// Hair nearer than this to the middle of the brows is none.
const NEAREST: f64 = 20.0;

/// The rays.
pub(super) struct Rays {
    /// Where they start.
    pub(super) centre: Point,
    /// For each, the hairline and the silhouette; none where there is no hair.
    pub(super) runs: Vec<Option<(Point, Point)>>,
}

impl Rays {
    /// The ray that runs up, a little to the left, where hair parts.
    pub(super) const CROWN: usize = Self::toward(98.0);

    /// The ray that runs in a direction, in degrees against the clock from the right.
    pub(super) const fn toward(degrees: f64) -> usize {
        ((degrees - FIRST) / STEP) as usize
    }

    /// `outlines` are closed lines, holes among them; `brows` is the height of the brows.
    pub(super) fn new(outlines: &[&[Point]], brows: f64) -> Self {
        let centre = at(0.0, brows);
        let runs = (0..COUNT)
            .map(|i| {
                let angle = (FIRST + STEP * i as f64).to_radians();
                let ray = Vec2::new(angle.cos(), -angle.sin());
                let mut crossings: Vec<f64> = outlines.iter().flat_map(|o| crossings(o, centre, ray)).collect();
                crossings.sort_by(f64::total_cmp);
                let outer = crossings.pop()?;
                let inner = crossings.pop().unwrap_or(NEAREST).max(NEAREST);
                (outer > inner + 3.0).then(|| (centre + ray * inner, centre + ray * outer))
            })
            .collect();
        Self { centre, runs }
    }

    /// How thick the hair is on a ray.
    pub(super) fn depth(&self, i: usize) -> f64 {
        self.runs.get(i).copied().flatten().map_or(0.0, |(inner, outer)| inner.distance(outer))
    }
}

/// How far along a ray it meets the edges of a closed line.
fn crossings(outline: &[Point], from: Point, ray: Vec2) -> Vec<f64> {
    let n = outline.len();
    let side = |p: Point| ray.cross(p - from);
    (0..n)
        .filter_map(|i| {
            let (a, b) = (outline[i], outline[(i + 1) % n]);
            let (sa, sb) = (side(a), side(b));
            // One end counts to each edge, so that a vertex on the ray is met once.
            ((sa < 0.0) != (sb < 0.0)).then(|| (a.lerp(b, sa / (sa - sb)) - from).dot(ray)).filter(|d| *d > 0.0)
        })
        .collect()
}

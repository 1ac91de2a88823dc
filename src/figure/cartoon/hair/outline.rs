//! The outline of hair from the vertices that were found: few, smooth between them, and sharp where hair has tips.

use super::tips::{domed, tipped};
use crate::figure::cartoon::style::HairCurve;
use crate::geometry::{BezPath, CubicBez, ParamCurve, PathEl, Point, Vec2, cut_corners, simplify, spline};

/// Vertices closer to the line than this are left out, in face units: 50 to 60 remain, and show all there is to see.
const TOLERANCE: f64 = 2.3;
/// A vertex whose angle is smaller stays a corner: the tip of a tuft.
const SHARP: f64 = 118.0;
/// Handles at a corner lie along its edges, so far.
const CORNER: f64 = 0.30;
/// Handles elsewhere lie along the tangent.
const SMOOTH: f64 = 0.34;
/// Steps of the outline as a line.
const STEP: f64 = 3.6;
/// How often corners are cut (thesis sec. 4.2.3).
const DEPTH: u32 = 2;

/// A closed outline as a path and as a line of short straight pieces.
#[derive(Debug, Clone)]
pub(super) struct Contour {
    pub(super) path: BezPath,
    pub(super) line: Vec<Point>,
}

impl Contour {
    /// Through the vertices that matter of `outline`. Its lower ends get `tips`, given the height of the
    /// brows and whether it lies behind the head.
    pub(super) fn new(outline: &[Point], curve: HairCurve, tips: Option<(f64, bool)>) -> Self {
        let vertices = domed(&simplify(outline, TOLERANCE, true));
        let vertices = tips.map_or_else(|| vertices.clone(), |(brows, behind)| tipped(&vertices, brows, behind));
        match curve {
            HairCurve::Tufts => tufts(&vertices),
            HairCurve::CornerCutting => {
                let line = cut_corners(&vertices, DEPTH);
                let mut path = BezPath::new();
                path.move_to(line[0]);
                line[1..].iter().for_each(|p| path.line_to(*p));
                path.close_path();
                Self { path, line }
            }
        }
    }
}

/// Waves of the silhouette: so far out and in, and so long, in face units.
const WAVE: (f64, f64) = (3.0, 34.0);

impl Contour {
    /// The same in waves where it is the silhouette, which lies away from the middle of the brows.
    pub(super) fn waved(self, brows: f64) -> Self {
        let n = self.line.len();
        let turn: f64 = (0..n).map(|i| self.line[i].to_vec2().cross(self.line[(i + 1) % n].to_vec2())).sum();
        let length: f64 = (0..n).map(|i| self.line[i].distance(self.line[(i + 1) % n])).sum();
        // A whole number of waves, so that the last meets the first.
        let waves = (length / WAVE.1).round().max(1.0) / length.max(1.0) * std::f64::consts::TAU;
        let mut gone = 0.0;
        let line: Vec<Point> = (0..n)
            .map(|i| {
                let (a, p, b) = (self.line[(i + n - 1) % n], self.line[i], self.line[(i + 1) % n]);
                gone += a.distance(p);
                let along = b - a;
                let outward = Vec2::new(along.y, -along.x) * (turn.signum() / along.hypot().max(1e-6));
                let from = p - Point::new(0.0, brows);
                let silhouette = (outward.dot(from) / from.hypot().max(1e-6)).clamp(0.0, 1.0);
                // Swelling and ebbing, or it looks cut with a pattern.
                let high = WAVE.0 * (1.0 + 0.4 * (gone * waves / 3.7).sin());
                p + outward * (high * silhouette * (gone * waves).sin())
            })
            .collect();
        Self { path: spline(&line, true), line }
    }
}

fn tufts(vertices: &[Point]) -> Contour {
    let n = vertices.len();
    let around = |i: usize| (vertices[(i + n - 1) % n], vertices[i], vertices[(i + 1) % n]);
    let unit = |v: Vec2| v / v.hypot().max(1e-6);
    let sharp: Vec<bool> = (0..n)
        .map(|i| {
            let (before, here, after) = around(i);
            let cos = unit(before - here).dot(unit(after - here));
            cos.clamp(-1.0, 1.0).acos().to_degrees() < SHARP
        })
        .collect();
    let tangent = |i: usize| {
        let (before, _, after) = around(i);
        unit(after - before)
    };
    let mut path = BezPath::new();
    let mut line = Vec::new();
    path.push(PathEl::MoveTo(vertices[0]));
    for i in 0..n {
        let next = (i + 1) % n;
        let (a, b) = (vertices[i], vertices[next]);
        let (along, length) = (b - a, a.distance(b));
        let out = if sharp[i] { a + along * CORNER } else { a + tangent(i) * (length * SMOOTH) };
        let into = if sharp[next] { b - along * CORNER } else { b - tangent(next) * (length * SMOOTH) };
        path.push(PathEl::CurveTo(out, into, b));
        let piece = CubicBez::new(a, out, into, b);
        let steps = ((length / STEP) as usize).max(2);
        line.extend((0..steps).map(|k| piece.eval(k as f64 / steps as f64)));
    }
    path.push(PathEl::ClosePath);
    Contour { path, line }
}

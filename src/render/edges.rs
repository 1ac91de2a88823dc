//! Outlines as straight edges in whole 256ths of a pixel: from there on all is whole numbers.

use super::canvas::Area;
use crate::geometry::{Affine, BezPath, PathEl, Point, Vec2};

/// Edges are told in so many parts of a pixel, as a power of 2.
pub(super) const BITS: u32 = 8;

/// Curves are cut so finely that no piece is further from them, in pixels …
const FLAT: f64 = 0.06;
/// … and those of drawn lines, which are thin.
const FLAT_OF_LINES: f64 = 0.025;

/// No edge reaches further out, in pixels: a picture has at most 16,384.
pub(super) const FAR: f64 = 1e6;

/// An edge that runs down from (`x0`, `y0`) to (`x1`, `y1`), `y0 <= y1`. `down` is 1 where the outline did too, else -1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Edge {
    pub(super) x0: i32,
    pub(super) y0: i32,
    pub(super) x1: i32,
    pub(super) y1: i32,
    pub(super) down: i32,
}

/// The edges of a filled outline, every contour closed. Level ones add no area, but are a border that tiles must know.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Edges {
    pub(super) all: Vec<Edge>,
    /// In how many steps pixels they cross are covered: a divisor of 255, or 0 without edges.
    pub(super) steps: u32,
}

/// Steps of cover of areas: more can hardly be seen, and fewer different pixels make smaller files …
const STEPS: u32 = 15;
/// … and of drawn lines, which may have nothing but such pixels.
const STEPS_OF_LINES: u32 = 255;

impl Edges {
    /// The outline `path`, moved to the picture by `place`.
    pub(super) fn of(path: &BezPath, place: Affine) -> Self {
        Self::flattened(path, place, FLAT, STEPS)
    }

    /// The same of drawn lines.
    pub(super) fn of_lines(path: &BezPath, place: Affine) -> Self {
        Self::flattened(path, place, FLAT_OF_LINES, STEPS_OF_LINES)
    }

    fn flattened(path: &BezPath, place: Affine, flat: f64, steps: u32) -> Self {
        let mut edges = Self { all: Vec::with_capacity(4 * path.elements().len()), steps };
        let (mut start, mut last) = (Point::ZERO, Point::ZERO);
        let (mut first, mut at) = ((0, 0), (0, 0));
        let mut to = |at: &mut (i32, i32), p: Point| {
            let next = whole(p);
            edges.line(*at, next);
            *at = next;
        };
        for element in path.elements() {
            match *element {
                PathEl::MoveTo(p) => {
                    to(&mut at, start);
                    (start, last) = (place * p, place * p);
                    (first, at) = (whole(start), whole(start));
                }
                PathEl::LineTo(p) => {
                    last = place * p;
                    to(&mut at, last);
                }
                PathEl::QuadTo(a, p) => {
                    let (a, p) = (place * a, place * p);
                    // The same curve as a cubic.
                    cubic(last, last.lerp(a, 2.0 / 3.0), p.lerp(a, 2.0 / 3.0), p, flat, &mut |q| to(&mut at, q));
                    last = p;
                }
                PathEl::CurveTo(a, b, p) => {
                    let (a, b, p) = (place * a, place * b, place * p);
                    cubic(last, a, b, p, flat, &mut |q| to(&mut at, q));
                    last = p;
                }
                PathEl::ClosePath => {
                    to(&mut at, start);
                    (last, at) = (start, first);
                }
            }
        }
        to(&mut at, start);
        edges
    }

    /// The pixels that the outline reaches.
    pub(super) fn bounds(&self) -> Area {
        let mut all = Area { x0: i32::MAX, y0: i32::MAX, x1: i32::MIN, y1: i32::MIN };
        for e in &self.all {
            all.x0 = all.x0.min(e.x0.min(e.x1));
            all.x1 = all.x1.max(e.x0.max(e.x1));
            all.y0 = all.y0.min(e.y0);
            all.y1 = all.y1.max(e.y1);
        }
        if self.all.is_empty() {
            return Area::NONE;
        }
        Area { x0: all.x0 >> BITS, y0: all.y0 >> BITS, x1: (all.x1 >> BITS) + 1, y1: (all.y1 >> BITS) + 1 }
    }

    fn line(&mut self, a: (i32, i32), b: (i32, i32)) {
        if a == b {
            return;
        }
        let (a, b, down) = if a.1 <= b.1 { (a, b, 1) } else { (b, a, -1) };
        self.all.push(Edge { x0: a.0, y0: a.1, x1: b.0, y1: b.1, down });
    }
}

fn whole(p: Point) -> (i32, i32) {
    // Rounded by cutting off what follows the point of a positive number: that needs no call of a function.
    const PARTS: f64 = (1 << BITS) as f64;
    let one = |v: f64| ((v.clamp(-FAR, FAR) + FAR) * PARTS + 0.5) as i64 as i32 - (FAR * PARTS) as i32;
    (one(p.x), one(p.y))
}

/// Cuts a cubic into even steps of its parameter, as many as its second differences ask for (Wang's bound).
fn cubic(p: Point, a: Point, b: Point, q: Point, flat: f64, to: &mut impl FnMut(Point)) {
    let bend = |a: Point, b: Point, c: Point| (a.to_vec2() - 2.0 * b.to_vec2() + c.to_vec2()).hypot2();
    let most = bend(p, a, b).max(bend(a, b, q)).sqrt();
    // Not a number where a coordinate is none: one step.
    let steps = ((0.75 * most / flat).sqrt() as u32 + 1).min(500);
    let (c3, c2, c1): (Vec2, Vec2, Vec2) =
        (q - p + 3.0 * (a - b), 3.0 * (p.to_vec2() - 2.0 * a.to_vec2() + b.to_vec2()), 3.0 * (a - p));
    let step = 1.0 / f64::from(steps);
    // Chords lie inside every bend. Points moved outward by a sixth of a chord's height, B'' step² / 12, leave the area
    // as it was.
    let (outer, c1) = (p - c2 * (step * step / 6.0), c1 - c3 * (step * step / 2.0));
    for i in 1..steps {
        let t = f64::from(i) * step;
        to(outer + t * (c1 + t * (c2 + t * c3)));
    }
    to(q);
}

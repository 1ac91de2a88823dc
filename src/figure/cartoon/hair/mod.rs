//! Hair: outlines with their tips, strands that follow its form, waves, curls, and heads without any.
//!
//! All of it is made once a face; only the head's own move moves it.

mod curl;
mod mass;
mod outline;
mod rays;
mod scalp;
mod strand;
mod tips;

use super::style::HairCurve;
use super::{Pen, at};
use crate::drawing::Item;
use crate::face::{Face, FeaturePoint as P, HairKind, Points};
use crate::geometry::{Affine, BezPath, Point, Rect, Shape, brush_ring};

pub(super) use scalp::scalp;

use outline::Contour;
use rays::Rays;

/// The hair of a face in the face frame.
#[derive(Debug, Clone)]
pub(super) struct Hair {
    kind: HairKind,
    front: Vec<Contour>,
    back: Vec<Contour>,
}

impl Hair {
    /// The hair of `face`, moved into the face frame by `place`. `points` are the face's as drawn.
    pub(super) fn new(face: &Face, kind: HairKind, curve: HairCurve, place: Affine, points: &Points) -> Self {
        let moved = |outline: &[Point]| -> Vec<Point> { outline.iter().map(|p| place * *p).collect() };
        let curves = |outline: &[Point], behind: bool| match kind {
            HairKind::Curly => {
                curl::scallops(&Contour::new(outline, HairCurve::Tufts, None).line, if behind { 17.0 } else { 15.0 })
            }
            HairKind::Wavy => Contour::new(outline, curve, None).waved(points[P::P4_4].y),
            _ => Contour::new(outline, curve, Some((points[P::P4_4].y, behind))),
        };
        let (mut front, mut back) = (Vec::new(), Vec::new());
        if !matches!(kind, HairKind::Bald | HairKind::Shaved) {
            let ear = points[P::P10_2].y.midpoint(points[P::P10_1].y);
            let first = moved(&face.hair_outline());
            let rest = face.hair.front.iter().skip(1).map(|o| moved(o));
            for outline in std::iter::once(first).chain(rest).filter(|o| o.len() > 2) {
                // What starts below the ears' tops lies behind the head and belongs to the back alone.
                let top = outline.iter().map(|p| p.y).fold(f64::MAX, f64::min);
                if top <= ear + 8.0 {
                    front.push(curves(&outline, false));
                }
            }
            back = face.hair.back.iter().filter(|o| o.len() > 2).map(|o| curves(&moved(o), true)).collect();
        }
        Self { kind, front, back }
    }

    /// Whether there is any to draw beside a tint of the scalp.
    pub(super) fn is_some(&self) -> bool {
        !self.front.is_empty()
    }

    /// Whether it stays clear of what moves: it ends above the jaw, and no fringe hides the forehead.
    pub(super) fn clear_of(&self, points: &Points) -> bool {
        let lobe = points[P::P10_6].y.midpoint(points[P::P10_5].y);
        let lowest = self.front.iter().flat_map(|c| &c.line).map(|p| p.y).fold(f64::MIN, f64::max);
        let brows = points[P::P4_4].y.min(points[P::P4_3].y);
        let forehead = [-30.0, -12.0, 0.0, 12.0, 30.0].map(|x| at(x, brows - 16.0));
        lowest < lobe + 4.0 && !forehead.iter().any(|p| self.front.iter().any(|c| c.path.contains(*p)))
    }

    /// The box round it; none without hair.
    pub(super) fn bounds(&self) -> Option<Rect> {
        let boxes = self.front.iter().chain(&self.back).map(|c| c.path.bounding_box());
        boxes.reduce(|a, b| a.union(b))
    }

    /// What lies behind the head.
    pub(super) fn behind(&self, pen: &Pen) -> Vec<Item> {
        let mut items = Vec::new();
        for contour in &self.back {
            let shade = pen.palette.hair_shade;
            let colour = if pen.ink_only { shade } else { pen.palette.hair_ink.over(shade, 0.22) };
            items.push(Item::area("hair-back", contour.path.clone(), colour));
            items.push(ring("hair-back-line", contour, pen, 0.8));
        }
        items
    }

    /// What lies over the face.
    pub(super) fn before(&self, pen: &Pen, points: &Points, strands: f64) -> Vec<Item> {
        if self.front.is_empty() {
            return Vec::new();
        }
        let mut whole = BezPath::new();
        self.front.iter().for_each(|c| whole.extend(c.path.elements().iter().copied()));
        let lines: Vec<&[Point]> = self.front.iter().map(|c| c.line.as_slice()).collect();
        let rays = Rays::new(&lines, points[P::P4_4].y);
        let mut inside = match self.kind {
            HairKind::Curly => curl::curls(pen, &lines, rays.centre, strands),
            kind => strand::strands(pen, &rays, kind == HairKind::Wavy, strands),
        };
        if !pen.ink_only {
            inside.splice(0..0, mass::shades(pen, &rays));
        }
        let mut items = Vec::new();
        // Along a smooth outline they look like a line drawn twice.
        if self.kind == HairKind::Wavy && strands > 0.0 {
            items.push(strand::loose(pen, &rays, strands));
        }
        items.push(Item::area("hair-front", whole.clone(), pen.palette.hair));
        items.push(Item::clipped("strands", whole, inside));
        items.extend(self.front.iter().map(|c| ring("hair-line", c, pen, 0.85)));
        items
    }
}

/// The ink round an outline: thinner toward the light, at the upper left.
fn ring(name: &str, contour: &Contour, pen: &Pen, width: f64) -> Item {
    let width = width * pen.ink;
    let ink = brush_ring(&contour.line, |outward| width * (1.0 + 0.28 * (0.5 * outward.x + 0.86 * outward.y)));
    Item::area(name, ink, pen.palette.hair_ink)
}

/// The points on a ray at a level between hairline (0) and silhouette (1).
fn between(ray: (Point, Point), level: f64) -> Point {
    at(ray.0.x + (ray.1.x - ray.0.x) * level, ray.0.y + (ray.1.y - ray.0.y) * level)
}

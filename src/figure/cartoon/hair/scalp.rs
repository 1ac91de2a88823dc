//! Heads without hair: the tint of shaved hair above the hairline, and the shine of a bald head.

use crate::drawing::Item;
use crate::face::{FeaturePoint as P, Points};
use crate::figure::cartoon::head::{HeadShape, Outline};
use crate::figure::cartoon::{Pen, at};
use crate::geometry::{BezPath, Point, Vec2, brush_in_steps, spline};

/// How opaque the tint is, of two that lie over each other so that its edge is soft.
const TINT: f64 = 0.40;

/// The scalp of a shaved (`tinted`) or bald head, and the skull's line.
pub(in crate::figure::cartoon) fn scalp(
    pen: &Pen,
    points: &Points,
    head: &HeadShape,
    outline: &Outline,
    tinted: bool,
) -> Vec<Item> {
    let skull = outline.skull();
    let mut items = Vec::new();
    if !pen.ink_only {
        // Light from the upper left shines on what is smooth.
        let shine = at(0.42 * head.ear_top(0).x, points[P::P11_1].y.min(head.top + 40.0).max(head.top + 22.0));
        let glow = Item::glow("shine", shine, Vec2::new(34.0, 20.0), pen.palette.light.faded(0.75));
        if tinted {
            for up in [0.0, 4.5] {
                items.push(Item::area("hair-tint", tint(points, head, &skull, up), pen.palette.hair_tint.faded(TINT)));
            }
        } else {
            items.push(glow);
        }
    } else if tinted {
        let ink = brush_in_steps(&hairline(points, head, 0.0), 0.8 * pen.ink, &[0.0, 1.0, 1.0, 0.0], 25);
        items.push(Item::area("hairline", ink, pen.palette.line));
    }
    let ink = brush_in_steps(&skull, 0.95 * pen.ink, &[0.4, 1.0, 0.4], 21);
    items.push(Item::area("skull", ink, pen.palette.line));
    items
}

/// From in front of the left ear over the forehead to in front of the right.
fn hairline(points: &Points, head: &HeadShape, up: f64) -> Vec<Point> {
    let middle = points[P::P11_1];
    let half = |side: usize, temple: P| -> [Point; 5] {
        let sign = if side == 0 { -1.0 } else { 1.0 };
        let (ear, temple) = (head.ear_top(side), points[temple]);
        let y = |q: f64| q - up;
        // A temple farther out than the face is where hair was taken for one.
        let out = temple.x.abs().min(ear.x.abs() - 9.0);
        [
            at(ear.x + sign * 1.5, y(ear.y + 30.0)),
            at(ear.x - sign * 7.0, y(ear.y + 3.0)),
            at(sign * (out + 2.0), y(temple.y + 0.55 * (ear.y - temple.y))),
            at(sign * out, y(temple.y)),
            at(sign * 0.55 * out, y(middle.y + 0.16 * (temple.y - middle.y))),
        ]
    };
    let (left, right) = (half(0, P::P11_2), half(1, P::P11_3));
    left.into_iter().chain([middle - Vec2::new(0.0, up)]).chain(right.into_iter().rev()).collect()
}

fn tint(points: &Points, head: &HeadShape, skull: &[Point], up: f64) -> BezPath {
    let mut path = spline(&hairline(points, head, up), false);
    skull.iter().rev().for_each(|p| path.line_to(*p));
    path.close_path();
    path
}

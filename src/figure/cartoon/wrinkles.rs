//! What an expression does to the skin: the creases beside the nose, wrinkles on its bridge, lines of the forehead,
//! the fold under a raised cheek. All of it thin ink that fades in with the emotion.

use super::Palette;
use crate::drawing::Item;
use crate::face::FeaturePoint as P;
use crate::face::rig::Deformed;
use crate::geometry::{ParamCurve, Point, Vec2, brush, lerp};

/// An amount below this draws nothing.
const UNSEEN: f64 = 0.02;

/// The lines, back to front; they belong under the front hair.
pub(super) fn wrinkles(face: &Deformed, palette: &Palette, ink: f64) -> Vec<Item> {
    let e = &face.expression;
    let mut items = Vec::new();
    let mut draw = |name: &str, line: &[Point], width: f64, amount: f64| {
        if amount > UNSEEN {
            let path = brush(line, width * ink, &[0.0, 1.0, 0.0]);
            items.push(Item::area(name, path, palette.line.faded(amount.min(1.0))));
        }
    };
    let p = &face.points;
    for (side, wing, corner) in [(-1.0, P::P9_2, P::P8_4), (1.0, P::P9_1, P::P8_3)] {
        let (wing, corner) = (p[wing], p[corner]);
        let out = |at: Point, x: f64, y: f64| at + Vec2::new(side * x, y);
        let bend = out(Point::new(lerp(wing.x, corner.x, 0.55), wing.y.midpoint(corner.y)), 9.0, -2.0);
        draw("crease", &[out(wing, 4.0, -2.0), bend, out(corner, 8.0, -1.0)], 0.85, 0.75 * e.crease);
    }
    let (bridge, base) = (p[P::P9_6].midpoint(p[P::P9_7]), p[P::P9_15]);
    for side in [-1.0, 1.0] {
        for step in 0..2 {
            let k = f64::from(step);
            let at = |x: f64, share: f64| {
                Point::new(bridge.x + side * (x + 3.0 * k), lerp(bridge.y, base.y, share + 0.10 * k))
            };
            draw("nose-wrinkle", &[at(4.0, 0.30), at(8.0, 0.36), at(10.0, 0.44)], 0.8, e.wrinkle);
        }
    }
    for eye in &face.eyes {
        let under = |t: f64, y: f64| eye.lower.eval(t) + Vec2::new(0.0, y * eye.height);
        draw("cheek", &[under(0.30, 0.22), under(0.58, 0.30), under(0.88, 0.22)], 0.8, 0.5 * e.cheek);
    }
    let top = p[P::P11_1];
    for (share, width) in [(0.34, 0.62), (0.56, 0.46)] {
        let over = |brow: &[Point; 4]| {
            let y = lerp(brow[1].midpoint(brow[2]).y, top.y, share);
            (
                Point::new(brow[0].x.midpoint(top.x), y + 1.5),
                Point::new(lerp(top.x, brow[2].x, width + 0.38), y + 2.5),
                y,
            )
        };
        let ((in_left, out_left, y), (in_right, out_right, _)) = (over(&face.brows[0]), over(&face.brows[1]));
        let bow = |a: Point, b: Point| Point::new(a.x.midpoint(b.x), y - 1.0);
        let line = [out_left, bow(in_left, out_left), Point::new(top.x, y + 1.5), bow(in_right, out_right), out_right];
        draw("forehead", &line, 0.8, 0.42 * e.forehead);
    }
    items
}

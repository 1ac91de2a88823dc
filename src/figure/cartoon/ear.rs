//! The ears. They stand behind the face, so that it hides their roots however it is drawn.

use super::head::HeadShape;
use super::{Pen, at};
use crate::drawing::Item;
use crate::face::{FeaturePoint as P, Points};
use crate::geometry::{Vec2, spline};

/// An ear is drawn at least this far out, or it looks cut off.
const LEAST: f64 = 15.0;

/// Both ears.
pub(super) fn ears(pen: &Pen, points: &Points, head: &HeadShape) -> Vec<Item> {
    let mut items = Vec::new();
    for (side, sign, name, [top, outer, lobe]) in
        [(0, -1.0, "ear-left", [P::P10_2, P::P10_4, P::P10_6]), (1, 1.0, "ear-right", [P::P10_1, P::P10_3, P::P10_5])]
    {
        let (top, outer, lobe) = (points[top], points[outer], points[lobe]);
        let high = lobe.y - top.y;
        let base = head.ear_top(side).x;
        // Where it is widest, within what leaves it an ear.
        let widest = ((outer.y - top.y) / high.max(1.0)).clamp(0.2, 0.5);
        let out = (sign * (outer.x - base)).max(LEAST);
        let p = |reach: f64, down: f64| at(base + sign * reach * out, top.y + down * high);
        let rim = [
            at(base - sign * 6.0, top.y + 8.0),
            p(0.40, 0.0) - Vec2::new(0.0, 1.0),
            at(base + sign * (out - 1.2), top.y + (widest - 0.12) * high),
            at(base + sign * (out - 0.6), top.y + (widest + 0.12) * high),
            p(0.66, 0.70),
            at(lobe.x + sign, lobe.y - 4.0),
            at(lobe.x - sign * 4.0, lobe.y + 1.0),
            at(lobe.x - sign * 9.0, lobe.y - 6.0),
        ];
        let inner = [at(base - sign, top.y + 0.20 * high), p(0.55, 0.17), p(0.62, 0.42), p(0.25, 0.72)];
        items.push(Item::area(name, spline(&rim, true), pen.palette.skin));
        if !pen.ink_only {
            let hollow = [inner[0], inner[1], inner[2], inner[3], at(base - sign * 2.0, top.y + 0.6 * high)];
            items.push(Item::area("ear-shade", spline(&hollow, true), pen.palette.shade.faded(0.9)));
        }
        items.push(pen.line("ear-inner", &inner, 0.8, &[0.0, 1.0, 0.8, 0.0]));
        items.push(pen.line("ear-line", &rim[1..7], 1.0, &[0.2, 1.0, 0.9, 0.8, 0.2]));
    }
    items
}

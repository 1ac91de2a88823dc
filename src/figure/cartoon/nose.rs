//! The nose: shade on its right, light on its bridge, wings and nostrils in ink. The bridge is never outlined.

use super::{NoseStyle, Pen, at};
use crate::drawing::Item;
use crate::face::{FeaturePoint as P, Points, Units};
use crate::geometry::{Ellipse, Shape, Vec2, brush, spline};

/// The nose at rest.
pub(super) fn nose(pen: &Pen, points: &Points, units: &Units, style: NoseStyle) -> Vec<Item> {
    let p = Shapes::of(points, units);
    let mut items = Vec::new();
    let colours = &pen.palette;
    if !pen.ink_only {
        items.extend(p.shade(pen));
    }
    match style {
        NoseStyle::Modelled => {
            for sign in [-1.0, 1.0] {
                let wing = [
                    p.at(sign, 0.78, -0.52),
                    p.at(sign, 1.02, -0.12),
                    p.low(sign, 0.98, -0.16),
                    p.low(sign, 0.72, -0.02),
                ];
                items.push(pen.line("nose-wing", &wing, 0.95, &[0.0, 0.9, 1.0, 0.1]));
                let hole = [p.low(sign, 0.70, -0.05), p.low(sign, 0.46, -0.20), p.low(sign, 0.24, 0.02)];
                items.push(Item::area("nostril", brush(&hole, 1.7 * pen.ink, &[0.1, 1.0, 0.15]), colours.ink));
            }
            let base =
                [at(p.x - 0.26 * p.n, p.base + 1.0), at(p.x, p.base + 0.16 * p.n), at(p.x + 0.26 * p.n, p.base + 1.0)];
            items.push(pen.line("nose-base", &base, 0.9, &[0.0, 1.0, 0.0]));
        }
        NoseStyle::Line => {
            // One stroke: down the shaded side, round the tip, and the near wing.
            let stroke = [
                at(p.x + 0.30 * p.n, 0.30 * p.base),
                at(p.x + 0.34 * p.n, 0.55 * p.base),
                p.at(1.0, 0.72, -0.55),
                p.at(1.0, 0.98, -0.10),
                p.low(1.0, 0.78, 0.02),
                p.low(1.0, 0.30, 0.12),
                at(p.x - 0.35 * p.n, p.base + 0.08 * p.n),
            ];
            items.push(pen.line("nose-line", &stroke, 1.1, &[0.0, 0.5, 0.7, 1.0, 1.0, 0.9, 0.1]));
        }
    }
    items
}

/// What the nose is measured by.
struct Shapes {
    x: f64,
    /// Half its width at the wings.
    n: f64,
    base: f64,
    wing: f64,
    mouth: f64,
    bridge: f64,
}

impl Shapes {
    fn of(points: &Points, units: &Units) -> Self {
        let (left, right) = (points[P::P9_2], points[P::P9_1]);
        Self {
            x: left.x.midpoint(right.x),
            n: ((right.x - left.x) / 2.0).max(4.0),
            base: points[P::P9_15].y,
            wing: left.y.midpoint(right.y),
            mouth: units.mouth_nose,
            bridge: points[P::P9_7].x,
        }
    }

    /// In half widths, from the height of the wings.
    fn at(&self, sign: f64, x: f64, y: f64) -> crate::geometry::Point {
        at(self.x + sign * x * self.n, self.wing + y * self.n)
    }

    /// In half widths, from the base.
    fn low(&self, sign: f64, x: f64, y: f64) -> crate::geometry::Point {
        at(self.x + sign * x * self.n, self.base + y * self.n)
    }

    fn shade(&self, pen: &Pen) -> Vec<Item> {
        let colours = &pen.palette;
        let side = [
            at(0.4 * self.x + 0.6 * self.bridge + 1.0, 4.0),
            at(self.x + 0.26 * self.n, 0.42 * self.base),
            self.at(1.0, 0.36, -0.75),
            self.at(1.0, 0.62, -0.28),
        ];
        let wing = [
            self.at(1.0, 0.62, -0.38),
            self.at(1.0, 0.98, -0.10),
            self.low(1.0, 0.92, -0.08),
            self.low(1.0, 0.45, -0.18),
            self.low(1.0, 0.10, 0.10),
            self.low(1.0, 0.42, -0.34),
        ];
        let bridge = [
            at(self.x - 0.06 * self.n, 0.34 * self.base),
            at(self.x - 0.03 * self.n, 0.55 * self.base),
            self.at(-1.0, 0.05, -0.65),
        ];
        let tip = Ellipse::new(self.at(-1.0, 0.10, -0.30), Vec2::new(0.17, 0.12) * self.n, 0.0);
        let under = [
            self.low(-1.0, 0.6, 0.5 / self.n),
            at(self.x, self.base + 0.26 * self.mouth),
            self.low(1.0, 0.7, 0.5 / self.n),
            at(self.x, self.base + 3.0),
        ];
        vec![
            Item::area(
                "nose-shade",
                brush(&side, 0.36 * self.n, &[0.05, 0.75, 0.9, 1.0, 0.05]),
                colours.shade.faded(0.85),
            ),
            Item::area("nose-wing-shade", spline(&wing, true), colours.shade.faded(0.85)),
            Item::area("nose-light", brush(&bridge, 0.17 * self.n, &[0.0, 0.8, 1.0, 0.0]), colours.light.faded(0.6)),
            Item::area("nose-tip", tip.to_path(0.05), colours.light.faded(0.75)),
            Item::area("nose-under", spline(&under, true), colours.shade.faded(0.7)),
        ]
    }
}

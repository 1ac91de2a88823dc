//! A cubic Bézier in (x, y, width): a stroke as the paper has it.
//!
//! The width is a third coordinate of the curve, so it runs continuously between the widths given at the control
//! points and may touch 0 (SOURCES.md 1, "stroke width"). What is drawn is the union of the discs of diameter w(t)
//! about P(t); `outline` gives its outline.

use kurbo::Point;

/// One control point: a place and the width of the stroke there (paper eq. 4).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Knot {
    /// To the right.
    pub x: f64,
    /// Down.
    pub y: f64,
    /// Full width, in the same unit as x and y; below 0 counts as 0.
    pub w: f64,
}

impl Knot {
    /// A control point.
    #[must_use]
    pub const fn new(x: f64, y: f64, w: f64) -> Self {
        Self { x, y, w }
    }

    /// Where it is.
    #[must_use]
    pub const fn point(self) -> Point {
        Point::new(self.x, self.y)
    }
}

/// A cubic stroke of varying width: four control points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ribbon(pub [Knot; 4]);

impl Ribbon {
    /// The centre line.
    #[must_use]
    pub(crate) fn centre(&self) -> kurbo::CubicBez {
        let [a, b, c, d] = self.0.map(Knot::point);
        kurbo::CubicBez::new(a, b, c, d)
    }

    /// The stroke in the paper's own reading of widths, by "interpolation of the adjacent control points": from one
    /// control point's width straight to the next one's, each in a third of the parameter, so that the inner widths
    /// are reached. The three parts are one stroke when they are drawn as a chain.
    #[must_use]
    pub(crate) fn as_in_paper(&self) -> [Self; 3] {
        let centre = self.centre();
        std::array::from_fn(|i| {
            let c = kurbo::ParamCurve::subsegment(&centre, i as f64 / 3.0..(i + 1) as f64 / 3.0);
            let (from, to) = (self.0[i].w.max(0.0), self.0[i + 1].w.max(0.0));
            let knot = |p: Point, t: f64| Knot::new(p.x, p.y, super::lerp(from, to, t));
            Self([knot(c.p0, 0.0), knot(c.p1, 1.0 / 3.0), knot(c.p2, 2.0 / 3.0), knot(c.p3, 1.0)])
        })
    }

    /// Place and width at a parameter, 0 to 1.
    #[must_use]
    pub fn eval(&self, t: f64) -> Knot {
        let s = 1.0 - t;
        let weights = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
        let sum = |f: fn(&Knot) -> f64| self.0.iter().zip(weights).map(|(k, b)| f(k) * b).sum();
        Knot::new(sum(|k| k.x), sum(|k| k.y), sum(|k| k.w))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_paper_s_widths_are_those_of_its_control_points() {
        let stroke = Ribbon(
            [(0.0, 0.0, 1.0), (10.0, 20.0, 4.0), (30.0, 20.0, 2.0), (40.0, 0.0, 3.0)]
                .map(|(x, y, w)| Knot::new(x, y, w)),
        );
        let parts = stroke.as_in_paper();
        for (i, part) in parts.iter().enumerate() {
            let (start, end) = (stroke.0[i].w, stroke.0[i + 1].w);
            assert!((part.eval(0.0).w - start).abs() < 1e-12 && (part.eval(1.0).w - end).abs() < 1e-12);
            assert!((part.eval(0.5).w - (start + end) / 2.0).abs() < 1e-12);
            let whole = stroke.eval((i as f64 + 0.5) / 3.0);
            assert!((part.eval(0.5).point() - whole.point()).hypot() < 1e-9);
        }
    }
}

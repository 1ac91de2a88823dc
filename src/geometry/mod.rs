//! Points, boxes and curves: kurbo's, and the one that it lacks, a cubic whose width varies along it.
//!
//! y grows downward, so angles run clockwise as seen. It knows nothing of faces or colours.

mod brush;
mod envelope;
mod outline;
mod pen;
mod pieces;
mod polygon;
mod ribbon;
mod similarity;
mod spline;

pub(crate) use brush::{brush, brush_in_steps, brush_ring};
pub use kurbo::{Affine, BezPath, Circle, CubicBez, ParamCurve, ParamCurveNearest, PathEl, Point, Rect, Shape, Vec2};
pub(crate) use kurbo::{Ellipse, ParamCurveDeriv};
pub use outline::outline;
pub use pieces::outline_in_pieces;
pub use polygon::{cut_corner, cut_corners, simplify};
pub use ribbon::{Knot, Ribbon};
pub use similarity::{Similarity, centroid};
pub use spline::{equal_steps, flattened, spline};

/// Calls `each` for every element of a path in order, with the number of its kind (move 1, line 2, quadratic 3, cubic 4,
/// close 5) and its points: for sums that tell paths apart.
#[inline]
pub(crate) fn each_element(path: &BezPath, mut each: impl FnMut(u64, &[Point])) {
    for element in path.elements() {
        match *element {
            PathEl::MoveTo(a) => each(1, &[a]),
            PathEl::LineTo(a) => each(2, &[a]),
            PathEl::QuadTo(a, b) => each(3, &[a, b]),
            PathEl::CurveTo(a, b, c) => each(4, &[a, b, c]),
            PathEl::ClosePath => each(5, &[]),
        }
    }
}

/// The cubic that leaves `a` with derivative `da` and reaches `b` with derivative `db` over a unit of parameter.
#[must_use]
pub(crate) fn hermite(a: Point, da: Vec2, b: Point, db: Vec2) -> CubicBez {
    CubicBez::new(a, a + da / 3.0, b - db / 3.0, b)
}

/// `a` at t = 0, `b` at t = 1.
#[must_use]
pub(crate) fn lerp(a: f64, b: f64, t: f64) -> f64 {
    a + (b - a) * t
}

/// The outline of a line of even width with round joints and ends.
#[must_use]
pub(crate) fn stroke_outline(path: &BezPath, width: f64) -> BezPath {
    let style = kurbo::Stroke::new(width).with_caps(kurbo::Cap::Round).with_join(kurbo::Join::Round);
    kurbo::stroke(path.iter(), &style, &kurbo::StrokeOpts::default(), 0.05)
}

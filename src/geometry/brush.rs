//! The brush: ink whose width runs along a line by a profile, as one closed outline of few cubics.
//!
//! Unlike a [`Ribbon`](super::Ribbon), whose outline is exact, a brush only offsets points at equal steps along the
//! line. That is a hundred times cheaper, and on lines that bend less than the brush is wide it looks the same.

use kurbo::{BezPath, PathEl, Point, Vec2};

use super::spline::{equal_steps, spline_on, spline_points};

/// Fewest and most steps along a line. Fewer lose its bends, more cannot be seen.
const STEPS: (usize, usize) = (7, 25);

/// The length of line that one step is for, in widths of a brush that is as wide as a face's ink: 2.5 of its 100
/// units a pupil distance.
const STEP: f64 = 5.0;

/// Ink along the Catmull-Rom spline through `line`: `width` wide where `profile` is 1. The values of the profile lie
/// at equal steps of arc length and run into each other smoothly (smoothstep). Steps are chosen by the length, which
/// is meant in units of a face (pupil distance 100).
///
/// Filled non-zero. Empty when the line has no length or no two points.
///
/// ```ignore
/// use lianpu::geometry::{Point, Shape, brush};
/// let ink = brush(&[Point::new(0.0, 0.0), Point::new(100.0, 0.0)], 4.0, &[0.0, 1.0, 0.0]);
/// assert!((ink.bounding_box().height() - 4.0).abs() < 0.01);
/// ```
#[must_use]
pub(crate) fn brush(line: &[Point], width: f64, profile: &[f64]) -> BezPath {
    let length: f64 = line.windows(2).map(|w| w[0].distance(w[1])).sum();
    // What the profile says must be met too: two steps for each of its values.
    let wanted = ((length / STEP) as usize).max(2 * profile.len().saturating_sub(1) + 1);
    brush_in_steps(line, width, profile, wanted.clamp(STEPS.0, STEPS.1))
}

/// [`brush`] with `steps` points along the line, at least two.
#[must_use]
pub(crate) fn brush_in_steps(line: &[Point], width: f64, profile: &[f64], steps: usize) -> BezPath {
    let mut path = BezPath::new();
    let steps = steps.max(2);
    let dense = spline_points(line, 2 * steps);
    let points = equal_steps(&dense, steps, false);
    if points.len() < 2 || points.windows(2).all(|w| w[0] == w[1]) {
        return path;
    }
    let (mut left, mut right) = (Vec::with_capacity(steps), Vec::with_capacity(steps));
    for (i, p) in points.iter().enumerate() {
        let (a, b) = (points[i.saturating_sub(1)], points[(i + 1).min(steps - 1)]);
        let along = b - a;
        let normal = Vec2::new(-along.y, along.x) / along.hypot().max(1e-6);
        let half = normal * (width / 2.0 * share(profile, i as f64 / (steps - 1) as f64));
        left.push(*p + half);
        right.push(*p - half);
    }
    right.reverse();
    path.push(PathEl::MoveTo(left[0]));
    spline_on(&mut path, &left, false);
    path.push(PathEl::LineTo(right[0]));
    spline_on(&mut path, &right, false);
    path.push(PathEl::ClosePath);
    path
}

/// A closed brush round `line`, as wide at each of its points as `width` says for the outward direction there: two
/// outlines of straight pieces that wind against each other. The points are meant to be close: with steps of 3 on a
/// bend of radius 20 the pieces are 0.06 off it.
#[must_use]
pub(crate) fn brush_ring(line: &[Point], width: impl Fn(Vec2) -> f64) -> BezPath {
    let n = line.len();
    let mut path = BezPath::new();
    if n < 3 {
        return path;
    }
    // Outward, whichever way the line runs round.
    let turn: f64 = (0..n).map(|i| line[i].to_vec2().cross(line[(i + 1) % n].to_vec2())).sum::<f64>().signum();
    let (mut outer, mut inner) = (Vec::with_capacity(n), Vec::with_capacity(n));
    for i in 0..n {
        let along = line[(i + 1) % n] - line[(i + n - 1) % n];
        let outward = Vec2::new(along.y, -along.x) * (turn / along.hypot().max(1e-6));
        let half = width(outward) / 2.0;
        outer.push(line[i] + outward * half);
        inner.push(line[i] - outward * half);
    }
    inner.reverse();
    for ring in [outer, inner] {
        path.move_to(ring[0]);
        ring[1..].iter().for_each(|p| path.line_to(*p));
        path.close_path();
    }
    path
}

/// The profile at `t` from 0 to 1.
fn share(profile: &[f64], t: f64) -> f64 {
    match profile {
        [] => 1.0,
        [one] => *one,
        _ => {
            let place = t.clamp(0.0, 1.0) * (profile.len() - 1) as f64;
            let i = (place as usize).min(profile.len() - 2);
            let u = place - i as f64;
            super::lerp(profile[i], profile[i + 1], u * u * (3.0 - 2.0 * u))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kurbo::Shape;

    #[test]
    fn a_straight_brush_is_as_wide_as_its_profile_says() {
        let line = [Point::new(0.0, 0.0), Point::new(60.0, 0.0), Point::new(120.0, 0.0)];
        let ink = brush(&line, 10.0, &[1.0, 1.0]);
        assert!((ink.area().abs() - 1200.0).abs() < 1.0, "{}", ink.area());
        let tapered = brush(&line, 10.0, &[0.0, 1.0, 0.0]);
        assert!(tapered.contains(Point::new(60.0, 4.8)) && !tapered.contains(Point::new(5.0, 2.0)));
    }

    #[test]
    fn a_line_without_length_draws_nothing() {
        assert!(brush(&[Point::ZERO; 3], 5.0, &[1.0]).elements().is_empty());
        assert!(brush(&[], 5.0, &[1.0]).elements().is_empty());
    }

    #[test]
    fn a_ring_is_hollow() {
        let line: Vec<Point> = (0..40).map(|i| (Vec2::from_angle(f64::from(i) * 0.157) * 50.0).to_point()).collect();
        let ring = brush_ring(&line, |_| 4.0);
        assert!(ring.winding(Point::ZERO) == 0 && ring.winding(Point::new(50.0, 0.0)) != 0);
    }
}

//! Smooth curves through points: Catmull and Rom's spline as cubic Béziers, and equal steps along a line.

use kurbo::{BezPath, ParamCurve, PathEl, Point};

/// The handles that make a chain of cubics Catmull and Rom's spline: a sixth of the way between a point's neighbours.
const HANDLE: f64 = 1.0 / 6.0;

/// The point `i` of a list that goes on round its end, or stops there.
fn at(points: &[Point], i: isize, closed: bool) -> Point {
    let n = points.len() as isize;
    points[if closed { i.rem_euclid(n) } else { i.clamp(0, n - 1) } as usize]
}

/// The two handles of the piece of the spline that leaves point `i`.
fn handles(points: &[Point], i: usize, closed: bool) -> [Point; 3] {
    let g = |k: isize| at(points, i as isize + k, closed);
    let (a, b, c, d) = (g(-1), g(0), g(1), g(2));
    [b + (c - a) * HANDLE, c - (d - b) * HANDLE, c]
}

/// The Catmull-Rom spline through `points`, as cubics; at an open end the end point stands for its missing neighbour.
/// Empty for fewer than two points.
///
/// ```
/// use lianpu::geometry::{Point, spline};
/// let path = spline(&[Point::new(0.0, 0.0), Point::new(10.0, 5.0), Point::new(20.0, 0.0)], false);
/// assert_eq!(path.segments().count(), 2);
/// ```
#[must_use]
pub fn spline(points: &[Point], closed: bool) -> BezPath {
    let mut path = BezPath::new();
    if points.len() < 2 {
        return path;
    }
    path.push(PathEl::MoveTo(points[0]));
    spline_on(&mut path, points, closed);
    if closed {
        path.push(PathEl::ClosePath);
    }
    path
}

/// The spline's pieces, added to a path that has reached `points[0]`.
pub(super) fn spline_on(path: &mut BezPath, points: &[Point], closed: bool) {
    let pieces = if closed { points.len() } else { points.len().saturating_sub(1) };
    for i in 0..pieces {
        let [a, b, c] = handles(points, i, closed);
        path.push(PathEl::CurveTo(a, b, c));
    }
}

/// Points on the open spline through `points`, about `count` of them, no two far apart.
pub(super) fn spline_points(points: &[Point], count: usize) -> Vec<Point> {
    if points.len() < 2 {
        return points.to_vec();
    }
    let each = (count / (points.len() - 1)).max(1);
    if each == 1 {
        return points.to_vec();
    }
    let mut line = Vec::with_capacity(each * points.len());
    line.push(points[0]);
    for i in 0..points.len() - 1 {
        let [a, b, c] = handles(points, i, false);
        let piece = kurbo::CubicBez::new(points[i], a, b, c);
        line.extend((1..=each).map(|k| piece.eval(k as f64 / each as f64)));
    }
    line
}

/// A path as a line of straight pieces, 8 to a curve, whose starts and closings are not told apart.
#[must_use]
pub fn flattened(path: &BezPath) -> Vec<Point> {
    let mut line = Vec::new();
    for piece in path.segments() {
        if line.last() != Some(&piece.start()) {
            line.push(piece.start());
        }
        let steps = if matches!(piece, kurbo::PathSeg::Line(_)) { 1 } else { 8 };
        line.extend((1..=steps).map(|k| piece.eval(f64::from(k) / f64::from(steps))));
    }
    line
}

/// `count` points at equal steps along a line of straight pieces, both ends among them; a closed line is walked round
/// once and its start is not repeated. A line without length gives its first point `count` times, no line nothing.
#[must_use]
pub fn equal_steps(line: &[Point], count: usize, closed: bool) -> Vec<Point> {
    let Some(first) = line.first() else { return Vec::new() };
    let mut gone = Vec::with_capacity(line.len() + 1);
    let mut length = 0.0;
    gone.push(length);
    let ends = line.len() + usize::from(closed);
    for i in 1..ends {
        length += line[i - 1].distance(line[i % line.len()]);
        gone.push(length);
    }
    if length <= 0.0 || !length.is_finite() {
        return vec![*first; count];
    }
    let steps = if closed { count } else { count.saturating_sub(1) }.max(1) as f64;
    let mut piece = 0;
    (0..count)
        .map(|k| {
            let want = length * k as f64 / steps;
            while piece + 2 < gone.len() && gone[piece + 1] < want {
                piece += 1;
            }
            let (a, b) = (line[piece], line[(piece + 1) % line.len()]);
            let run = gone[piece + 1] - gone[piece];
            if run > 0.0 { a.lerp(b, ((want - gone[piece]) / run).clamp(0.0, 1.0)) } else { a }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_spline_passes_through_its_points_and_leaves_each_toward_its_neighbours() {
        let points = [(0.0, 0.0), (10.0, 10.0), (30.0, 0.0)].map(Point::from);
        let path = spline(&points, true);
        assert_eq!(path.segments().count(), 3);
        let second = path.segments().nth(1).unwrap().to_cubic();
        assert_eq!(second.p0, points[1]);
        assert_eq!(second.p1 - second.p0, (points[2] - points[0]) / 6.0);
    }

    proptest! {
        #[test]
        fn equal_steps_are_equal_along_a_straight_line_and_keep_both_ends(n in 2usize..40, x in 1.0f64..500.0) {
            let line = [Point::ZERO, Point::new(x / 3.0, 0.0), Point::new(x, 0.0)];
            let found = equal_steps(&line, n, false);
            prop_assert_eq!(found.len(), n);
            for (k, p) in found.iter().enumerate() {
                prop_assert!((p.x - x * k as f64 / (n - 1) as f64).abs() < 1e-9);
            }
        }
    }
}

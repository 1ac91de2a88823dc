//! Points joined to triangles, none of which holds a fourth point in its circle (Delaunay 1934).

use crate::geometry::Point;

/// Flatter triangles, by their height over their longest side, are left out: a small move of their points turns them
/// over. They lie along the border only.
const FLATTEST: f64 = 0.02;

/// The Delaunay triangles of points, as three of their numbers each, clockwise as seen; by Bowyer's and Watson's way
/// (1981), which is quick enough for the few hundred points of a face. Of points that lie on one circle the
/// lower-numbered decide, so that the same points always give the same triangles. Points that coincide share a place:
/// the later ones are in no triangle.
#[must_use]
pub fn triangles(points: &[Point]) -> Vec<[usize; 3]> {
    let n = points.len();
    let Some(first) = points.first() else { return Vec::new() };
    let (low, high) = points.iter().fold((*first, *first), |(l, h), p| {
        (Point::new(l.x.min(p.x), l.y.min(p.y)), Point::new(h.x.max(p.x), h.y.max(p.y)))
    });
    let size = (high.x - low.x).max(high.y - low.y);
    if !(size.is_finite() && size > 0.0) {
        return Vec::new();
    }
    // Of size 1, and moved by less than can be seen, so that no four lie on a circle.
    let nudge = |i: usize| ((i as f64 * 0.618_033_988_749_895).fract() - 0.5) * 1e-7;
    let mut all: Vec<Point> = points
        .iter()
        .enumerate()
        .map(|(i, p)| Point::new((p.x - low.x) / size + nudge(2 * i), (p.y - low.y) / size + nudge(2 * i + 1)))
        .collect();
    all.extend([Point::new(-60.0, -50.0), Point::new(61.0, -50.0), Point::new(0.5, 70.0)]);
    let mut made: Vec<[usize; 3]> = vec![[n, n + 1, n + 2]];
    for i in 0..n {
        if (0..i).any(|j| all[j].distance(all[i]) < 1e-5) {
            continue;
        }
        let (gone, mut kept): (Vec<[usize; 3]>, Vec<[usize; 3]>) =
            made.iter().partition(|t| in_circle(&all, t, all[i]));
        let edges: Vec<[usize; 2]> = gone.iter().flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]).collect();
        for [a, b] in &edges {
            if !edges.contains(&[*b, *a]) {
                kept.push([*a, *b, i]);
            }
        }
        made = kept;
    }
    made.retain(|t| t.iter().all(|v| *v < n) && height(t.map(|v| points[v])) > FLATTEST);
    made
}

/// Whether `p` lies in the circle through a triangle's points, which run clockwise as seen with y down.
fn in_circle(all: &[Point], triangle: &[usize; 3], p: Point) -> bool {
    let [a, b, c] = triangle.map(|v| all[v] - p);
    let det = a.hypot2() * b.cross(c) - b.hypot2() * a.cross(c) + c.hypot2() * a.cross(b);
    det > 0.0
}

/// A triangle's height over its longest side, over that side.
fn height([a, b, c]: [Point; 3]) -> f64 {
    let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
    (b - a).cross(c - a).abs() / (longest * longest).max(1e-300)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_with_a_middle_is_four_triangles_and_a_grid_is_covered_once() {
        let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0), (1.0, 1.0)].map(Point::from);
        assert_eq!(triangles(&square).len(), 4);
        let grid: Vec<Point> = (0..49).map(|i| Point::new(f64::from(i % 7), f64::from(i / 7))).collect();
        let made = triangles(&grid);
        let area: f64 = made.iter().map(|t| (grid[t[1]] - grid[t[0]]).cross(grid[t[2]] - grid[t[0]]) / 2.0).sum();
        assert_eq!(made.len(), 72);
        assert!((area - 36.0).abs() < 1e-9, "{area}");
    }

    #[test]
    fn points_without_extent_and_points_in_one_place_are_left_out() {
        assert!(triangles(&[]).is_empty());
        assert!(triangles(&[Point::new(1.0, 1.0); 5]).is_empty());
        let line: Vec<Point> = (0..9).map(|i| Point::new(f64::from(i), f64::from(2 * i))).collect();
        assert!(triangles(&line).is_empty());
        let twice = [(0.0, 0.0), (2.0, 0.0), (0.0, 2.0), (0.0, 2.0)].map(Point::from);
        assert_eq!(triangles(&twice).len(), 1);
    }

    #[test]
    fn no_circle_holds_a_fourth_point() {
        let points: Vec<Point> = (0..90)
            .map(|i| Point::new((f64::from(i) * 0.754_877).fract(), (f64::from(i) * 0.569_840).fract()))
            .collect();
        for t in triangles(&points) {
            let [a, b, c] = t.map(|v| points[v]);
            let d = 2.0 * (b - a).cross(c - a);
            let (u, v) = ((b - a).hypot2(), (c - a).hypot2());
            let centre = a + crate::geometry::Vec2::new(
                ((c - a).y * u - (b - a).y * v) / d,
                ((b - a).x * v - (c - a).x * u) / d,
            );
            let radius = centre.distance(a);
            assert!(points.iter().all(|p| p.distance(centre) > radius * (1.0 - 1e-4)), "{t:?}");
        }
    }
}

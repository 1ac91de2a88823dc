//! Lines of straight pieces: thinned to the vertices that matter, and rounded by cutting their corners.

use kurbo::{Point, Vec2};

/// Ramer, Douglas and Peucker: the vertices of a line without which it would leave its place by more than
/// `tolerance`. A closed line is divided at its first vertex and the one farthest from it.
#[must_use]
pub fn simplify(line: &[Point], tolerance: f64, closed: bool) -> Vec<Point> {
    if line.len() < 3 {
        return line.to_vec();
    }
    let mut kept = vec![false; line.len()];
    if closed {
        let far = (1..line.len()).max_by(|a, b| line[*a].distance(line[0]).total_cmp(&line[*b].distance(line[0])));
        let far = far.unwrap_or(line.len() - 1);
        let mut round = line.to_vec();
        round.push(line[0]);
        kept.push(false);
        thin(&round, 0, far, tolerance, &mut kept);
        thin(&round, far, line.len(), tolerance, &mut kept);
        kept.truncate(line.len());
        kept[0] = true;
        kept[far] = true;
    } else {
        thin(line, 0, line.len() - 1, tolerance, &mut kept);
        kept[0] = true;
        kept[line.len() - 1] = true;
    }
    line.iter().zip(kept).filter_map(|(p, keep)| keep.then_some(*p)).collect()
}

/// Marks the vertices to keep strictly between `a` and `b`. A stack of its own: outlines may be long.
fn thin(line: &[Point], a: usize, b: usize, tolerance: f64, kept: &mut [bool]) {
    let mut parts = vec![(a, b)];
    while let Some((a, b)) = parts.pop() {
        let along: Vec2 = line[b] - line[a];
        let length = along.hypot();
        let off = |p: Point| {
            if length > 1e-9 { along.cross(p - line[a]).abs() / length } else { p.distance(line[a]) }
        };
        let farthest = (a + 1..b).map(|i| (off(line[i]), i)).max_by(|x, y| x.0.total_cmp(&y.0));
        if let Some((distance, i)) = farthest.filter(|f| f.0 > tolerance) {
            debug_assert!(distance.is_finite());
            kept[i] = true;
            parts.extend([(a, i), (i, b)]);
        }
    }
}

/// A corner cut `depth` times (thesis alg. 4.1, as corrected: the recursion counts `depth` down): from `a` toward `b`
/// and on to `c`, in 2^(depth + 1) straight pieces. Depth 0 leaves the corner.
///
/// ```
/// use lianpu::geometry::{Point, cut_corner};
/// let [a, b, c] = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0)].map(Point::from);
/// assert_eq!(cut_corner(a, b, c, 0), [a, b, c]);
/// assert_eq!(cut_corner(a, b, c, 2).len(), 9);
/// ```
#[must_use]
pub fn cut_corner(a: Point, b: Point, c: Point, depth: u32) -> Vec<Point> {
    let mut line = vec![a];
    cut_on(&mut line, [a, b, c], depth.min(8));
    line
}

fn cut_on(line: &mut Vec<Point>, [a, b, c]: [Point; 3], depth: u32) {
    if depth == 0 {
        line.extend([b, c]);
        return;
    }
    let (ab, bc) = (a.midpoint(b), b.midpoint(c));
    let middle = ab.midpoint(bc);
    cut_on(line, [a, ab, middle], depth - 1);
    cut_on(line, [middle, bc, c], depth - 1);
}

/// Every corner of a closed line cut `depth` times, from the middle of one edge to the middle of the next.
#[must_use]
pub fn cut_corners(outline: &[Point], depth: u32) -> Vec<Point> {
    let n = outline.len();
    if n < 3 {
        return outline.to_vec();
    }
    let corner = |i: usize| {
        let (before, here, after) = (outline[(i + n - 1) % n], outline[i], outline[(i + 1) % n]);
        let mut cut = cut_corner(before.midpoint(here), here, here.midpoint(after), depth);
        cut.pop();
        cut
    };
    (0..n).flat_map(corner).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_straight_line_keeps_its_ends_alone() {
        let line: Vec<Point> = (0..20).map(|i| Point::new(f64::from(i), 2.0 * f64::from(i))).collect();
        assert_eq!(simplify(&line, 0.1, false), [line[0], line[19]]);
    }

    #[test]
    fn a_cut_corner_ends_where_the_corner_did_and_stays_inside_it() {
        let [a, b, c] = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0)].map(Point::from);
        let cut = cut_corner(a, b, c, 3);
        assert_eq!((cut[0], cut[cut.len() - 1]), (a, c));
        // The limit is the parabola through the middle of the corner; depth 3 is near it.
        let nearest = cut.iter().map(|p| p.distance(Point::new(7.5, 2.5))).fold(f64::MAX, f64::min);
        assert!(nearest < 1e-9, "{nearest}");
    }

    proptest! {
        #[test]
        fn no_vertex_left_out_was_farther_than_the_tolerance(
            line in prop::collection::vec((0.0..100.0f64, 0.0..100.0f64), 3..60), tolerance in 0.1..20.0f64,
        ) {
            let line: Vec<Point> = line.into_iter().map(Point::from).collect();
            let kept = simplify(&line, tolerance, false);
            let places: Vec<usize> = kept.iter().map(|k| line.iter().position(|p| p == k).unwrap()).collect();
            for pair in places.windows(2) {
                let (a, b) = (line[pair[0]], line[pair[1]]);
                for p in &line[pair[0]..pair[1]] {
                    let off = (b - a).cross(*p - a).abs() / (b - a).hypot();
                    prop_assert!(off <= tolerance + 1e-6, "{off}");
                }
            }
            prop_assert!(kept.len() <= line.len());
        }
    }
}

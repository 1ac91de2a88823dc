//! Shapes laid over each other, so that what is left of their differences is form alone.

use crate::geometry::{Point, Similarity, Vec2, centroid};

/// Shapes turned, scaled and shifted onto their common mean.
#[derive(Debug, Clone)]
pub struct Aligned {
    /// The mean: its middle at the origin, its size (root of the sum of squares) 1, turned as the shapes are on the whole.
    pub mean: Vec<Point>,
    /// The shapes, each as near to the mean as a similarity brings it.
    pub shapes: Vec<Vec<Point>>,
}

/// So often is the mean made anew; it settles within five.
const ROUNDS: usize = 50;

/// Generalised Procrustes analysis (Gower 1975), without reflections. None where there are no shapes, they have
/// different numbers of points, or one has no two different points.
#[must_use]
pub fn align(shapes: &[Vec<Point>]) -> Option<Aligned> {
    let first = shapes.first()?;
    if shapes.iter().any(|s| s.len() != first.len()) {
        return None;
    }
    let mut mean = unit(first)?;
    let mut laid = Vec::new();
    for _ in 0..ROUNDS {
        laid = shapes.iter().map(|s| onto(s, &mean)).collect::<Option<Vec<_>>>()?;
        let sums: Vec<Point> =
            (0..mean.len()).map(|i| centroid(&laid.iter().map(|s: &Vec<Point>| s[i]).collect::<Vec<_>>())).collect();
        // The mean may neither shrink nor turn away.
        let turned = onto(&sums, &mean)?;
        let next = unit(&turned)?;
        let moved = next.iter().zip(&mean).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
        mean = next;
        if moved < 1e-12 {
            break;
        }
    }
    // How the shapes are turned against the mean, together.
    let turns = shapes.iter().filter_map(|s| Similarity::between(&mean, s)).map(|q| Vec2::from_angle(q.angle()));
    let turn = turns.fold(Vec2::ZERO, |s, v| s + v);
    let upright =
        Similarity { a: turn.x / turn.hypot().max(1e-9), b: turn.y / turn.hypot().max(1e-9), origin: Point::ORIGIN };
    if turn.hypot() > 1e-6 {
        for p in mean.iter_mut().chain(laid.iter_mut().flatten()) {
            *p = upright.apply(*p);
        }
    }
    Some(Aligned { mean, shapes: laid })
}

fn onto(shape: &[Point], mean: &[Point]) -> Option<Vec<Point>> {
    let place = Similarity::between(shape, mean)?;
    Some(shape.iter().map(|p| place.apply(*p)).collect())
}

/// Moved to the origin and scaled to size 1.
fn unit(shape: &[Point]) -> Option<Vec<Point>> {
    let centre = centroid(shape);
    let size = shape.iter().map(|p| (*p - centre).hypot2()).sum::<f64>().sqrt();
    (size > 1e-9).then(|| shape.iter().map(|p| ((*p - centre) / size).to_point()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shapes_that_differ_by_a_similarity_alone_fall_on_their_mean() {
        let shape: Vec<Point> = [(0.0, 0.0), (4.0, 0.5), (3.0, 5.0), (-1.0, 2.0)].map(Point::from).to_vec();
        let places = [(1.0, 0.0, 3.0), (0.3, 1.7, -80.0), (-2.0, 0.4, 9.0)];
        let shapes: Vec<Vec<Point>> = places
            .iter()
            .map(|(a, b, x)| Similarity { a: *a, b: *b, origin: Point::new(*x, 2.0 * x) })
            .map(|q| shape.iter().map(|p| q.apply(*p)).collect())
            .collect();
        let aligned = align(&shapes).unwrap();
        for laid in &aligned.shapes {
            for (p, q) in laid.iter().zip(&aligned.mean) {
                assert!(p.distance(*q) < 1e-9);
            }
        }
    }
}

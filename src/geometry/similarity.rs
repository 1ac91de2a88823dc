//! Similarities of the plane and their least-squares fit.

use super::{Point, Vec2};

/// Turns and scales, then shifts: `z ↦ (a + b i) z + origin` in the plane's complex numbers, without reflection.
///
/// `x' = a x − b y + origin.x`, `y' = b x + a y + origin.y`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Similarity {
    /// Scale times cosine of the angle.
    pub a: f64,
    /// Scale times sine of the angle, clockwise as seen.
    pub b: f64,
    /// The image of the origin.
    pub origin: Point,
}

impl Similarity {
    /// Scales by `scale` and turns by `angle` radians, clockwise as seen, and takes the origin to `origin`.
    #[must_use]
    pub fn new(origin: Point, scale: f64, angle: f64) -> Self {
        Self { a: scale * angle.cos(), b: scale * angle.sin(), origin }
    }

    /// Takes (−½, 0) to `left` and (½, 0) to `right`: for pupils, from the face's frame to pixels.
    #[must_use]
    pub fn spanning(left: Point, right: Point) -> Self {
        let across = right - left;
        Self { a: across.x, b: across.y, origin: left.midpoint(right) }
    }

    /// The least-squares similarity from points to points in the same order (Umeyama 1991); none where `from` has no
    /// two different points. Of lists of different length the longer one's rest counts for nothing.
    #[must_use]
    pub fn between(from: &[Point], to: &[Point]) -> Option<Self> {
        let n = from.len().min(to.len());
        let (cf, ct) = (centroid(&from[..n]), centroid(&to[..n]));
        let (mut dot, mut cross, mut square) = (0.0, 0.0, 0.0);
        for (p, q) in from.iter().zip(to) {
            let (p, q) = (*p - cf, *q - ct);
            dot += p.dot(q);
            cross += p.cross(q);
            square += p.hypot2();
        }
        if square < 1e-12 {
            return None;
        }
        let linear = Self { a: dot / square, b: cross / square, origin: Point::ORIGIN };
        Some(Self { origin: ct - linear.apply_vec(cf.to_vec2()), ..linear })
    }

    /// The factor by which lengths grow.
    #[must_use]
    pub fn scale(&self) -> f64 {
        self.a.hypot(self.b)
    }

    /// The angle in radians, −π to π, clockwise as seen.
    #[must_use]
    pub fn angle(&self) -> f64 {
        self.b.atan2(self.a)
    }

    /// The image of a point.
    #[must_use]
    pub fn apply(&self, p: Point) -> Point {
        self.origin + self.apply_vec(p.to_vec2())
    }

    /// The image of a difference of two points: turned and scaled, not shifted.
    #[must_use]
    pub fn apply_vec(&self, v: Vec2) -> Vec2 {
        Vec2::new(self.a * v.x - self.b * v.y, self.b * v.x + self.a * v.y)
    }

    /// The point whose image is `p`; the origin where the scale is 0.
    #[must_use]
    pub fn undo(&self, p: Point) -> Point {
        let (d, square) = (p - self.origin, (self.a * self.a + self.b * self.b).max(1e-30));
        Point::new((self.a * d.x + self.b * d.y) / square, (self.a * d.y - self.b * d.x) / square)
    }

    /// First `inner`, then this.
    #[must_use]
    pub fn after(&self, inner: &Self) -> Self {
        let across = self.apply_vec(Vec2::new(inner.a, inner.b));
        Self { a: across.x, b: across.y, origin: self.apply(inner.origin) }
    }
}

/// The mean of points; the origin of none.
#[must_use]
pub fn centroid(points: &[Point]) -> Point {
    let sum = points.iter().fold(Vec2::ZERO, |s, p| s + p.to_vec2());
    (sum / points.len().max(1) as f64).to_point()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_fit_finds_the_similarity_that_moved_the_points(
            (a, b, x, y) in (0.1..3.0, -3.0..3.0, -50.0..50.0, -50.0..50.0),
            points in prop::collection::vec((-9.0..9.0, -9.0..9.0), 2..8),
        ) {
            let from: Vec<Point> = points.into_iter().map(Point::from).collect();
            prop_assume!(from.iter().any(|p| p.distance(from[0]) > 0.1));
            let moves = Similarity { a, b, origin: Point::new(x, y) };
            let to: Vec<Point> = from.iter().map(|p| moves.apply(*p)).collect();
            let found = Similarity::between(&from, &to).unwrap();
            for (p, q) in from.iter().zip(&to) {
                prop_assert!(found.apply(*p).distance(*q) < 1e-9 && moves.undo(*q).distance(*p) < 1e-9);
            }
        }

        #[test]
        fn one_after_another_is_both(
            (a, b, x, y) in (-3.0..3.0, -3.0..3.0, -9.0..9.0, -9.0..9.0), (c, d, u, v) in (-3.0..3.0, -3.0..3.0, -9.0..9.0, -9.0..9.0),
        ) {
            let outer = Similarity { a, b, origin: Point::new(x, y) };
            let inner = Similarity { a: c, b: d, origin: Point::new(u, v) };
            let p = Point::new(y, u);
            prop_assert!(outer.after(&inner).apply(p).distance(outer.apply(inner.apply(p))) < 1e-9);
        }
    }

    #[test]
    fn degenerate_points_have_no_fit_and_no_scale_undoes_to_the_origin() {
        let same = [Point::new(3.0, 4.0); 3];
        assert_eq!(Similarity::between(&same, &same), None);
        assert_eq!(Similarity::between(&[], &same), None);
        let flat = Similarity { a: 0.0, b: 0.0, origin: Point::new(1.0, 2.0) };
        assert_eq!(flat.undo(Point::new(1.0, 2.0)), Point::ORIGIN);
    }

    #[test]
    fn spanning_takes_half_a_unit_to_either_point() {
        let (left, right) = (Point::new(10.0, 20.0), Point::new(16.0, 28.0));
        let frame = Similarity::spanning(left, right);
        assert_eq!([frame.apply(Point::new(-0.5, 0.0)), frame.apply(Point::new(0.5, 0.0))], [left, right]);
        assert_eq!(frame.scale(), 10.0);
    }
}

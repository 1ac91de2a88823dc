//! Where a face is: how it is turned, how large, and where its middle lies.

use crate::geometry::{Point, Vec2};

/// A turn and scale, then a shift: `z ↦ a z + t` of the plane's complex numbers (paper eq. 5, `q`).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Similarity {
    /// Scale times cosine of the turn.
    pub a: f64,
    /// Scale times sine of the turn, clockwise as seen.
    pub b: f64,
    /// Where the origin goes.
    pub at: Point,
}

impl Similarity {
    /// Leaves everything where it is.
    pub const IDENTITY: Self = Self { a: 1.0, b: 0.0, at: Point::ORIGIN };

    /// How many times larger things become.
    #[must_use]
    pub fn scale(&self) -> f64 {
        self.a.hypot(self.b)
    }

    /// The turn in radians, clockwise as seen.
    #[must_use]
    pub fn turn(&self) -> f64 {
        self.b.atan2(self.a)
    }

    /// The place that `p` goes to.
    #[must_use]
    pub fn apply(&self, p: Point) -> Point {
        self.at + Vec2::new(self.a * p.x - self.b * p.y, self.b * p.x + self.a * p.y)
    }

    /// The place that goes to `p`; the origin where the scale is 0.
    #[must_use]
    pub fn undo(&self, p: Point) -> Point {
        let (d, square) = (p - self.at, (self.a * self.a + self.b * self.b).max(1e-30));
        Point::new((self.a * d.x + self.b * d.y) / square, (self.a * d.y - self.b * d.x) / square)
    }

    /// The least-squares similarity from points to points, without reflection (Umeyama 1991); none where `from` has
    /// no two different points.
    #[must_use]
    pub fn between(from: &[Point], to: &[Point]) -> Option<Self> {
        let n = from.len().min(to.len());
        let (cf, ct) = (middle(&from[..n]), middle(&to[..n]));
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
        let turned = Self { a: dot / square, b: cross / square, at: Point::ORIGIN };
        let at = ct - turned.apply(cf).to_vec2();
        Some(Self { at, ..turned })
    }
}

/// The mean of points; the origin of none.
#[must_use]
pub fn middle(points: &[Point]) -> Point {
    let sum = points.iter().fold(Vec2::ZERO, |s, p| s + p.to_vec2());
    (sum / points.len().max(1) as f64).to_point()
}

//! Where a face lies in a picture: a similarity from the face's own frame.

use crate::geometry::{Point, Vec2};

/// A similarity from the face frame (pupils near (∓0.5, 0), y down, so that the pupil distance is 1) to pixels:
/// `x = a u − b v + x0`, `y = b u + a v + y0`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Pixels to the right for a pupil distance to the face's right.
    pub a: f64,
    /// Pixels down for a pupil distance to the face's right.
    pub b: f64,
    /// Where the middle between the pupils lies.
    pub origin: Point,
}

impl Frame {
    /// A face whose pupils are `scale` pixels apart, turned by `roll` radians (clockwise as seen).
    #[must_use]
    pub fn new(origin: Point, scale: f64, roll: f64) -> Self {
        Self { a: scale * roll.cos(), b: scale * roll.sin(), origin }
    }

    /// The frame in which the pupils are at these points.
    #[must_use]
    pub fn of_pupils(left: Point, right: Point) -> Self {
        let across = right - left;
        Self { a: across.x, b: across.y, origin: left.midpoint(right) }
    }

    /// Pixels in a pupil distance.
    #[must_use]
    pub fn scale(&self) -> f64 {
        self.a.hypot(self.b)
    }

    /// How far the face is tilted, in radians, clockwise as seen.
    #[must_use]
    pub fn roll(&self) -> f64 {
        self.b.atan2(self.a)
    }

    /// Turns a move in the face frame into one in pixels.
    #[must_use]
    pub fn turn(&self, by: Vec2) -> Vec2 {
        Vec2::new(self.a * by.x - self.b * by.y, self.b * by.x + self.a * by.y)
    }

    /// From the face frame to pixels.
    #[must_use]
    pub fn apply(&self, at: Point) -> Point {
        self.origin + self.turn(at.to_vec2())
    }

    /// From pixels to the face frame; the origin where the frame has no size.
    #[must_use]
    pub fn undo(&self, at: Point) -> Point {
        let (d, square) = (at - self.origin, (self.a * self.a + self.b * self.b).max(1e-12));
        Point::new((self.a * d.x + self.b * d.y) / square, (self.a * d.y - self.b * d.x) / square)
    }

    /// First `inner`, then this.
    #[must_use]
    pub fn after(&self, inner: &Self) -> Self {
        let across = self.turn(Vec2::new(inner.a, inner.b));
        Self { a: across.x, b: across.y, origin: self.apply(inner.origin) }
    }

    /// The least-squares similarity that takes `from` to `to` (Umeyama 1991, without reflections); none for fewer
    /// than two different points.
    #[must_use]
    pub fn fitting(from: &[Point], to: &[Point]) -> Option<Self> {
        let n = from.len().min(to.len());
        let middle = |points: &[Point]| points[..n].iter().fold(Vec2::ZERO, |s, p| s + p.to_vec2()) / n.max(1) as f64;
        let (cf, ct) = (middle(from), middle(to));
        let (mut dot, mut cross, mut square) = (0.0, 0.0, 0.0);
        for (p, q) in from.iter().zip(to) {
            let (p, q) = (p.to_vec2() - cf, q.to_vec2() - ct);
            dot += p.dot(q);
            cross += p.cross(q);
            square += p.hypot2();
        }
        if square < 1e-9 {
            return None;
        }
        let turn = Self { a: dot / square, b: cross / square, origin: Point::ORIGIN };
        Some(Self { origin: (ct - turn.turn(cf)).to_point(), ..turn })
    }
}

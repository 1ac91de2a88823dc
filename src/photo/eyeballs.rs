//! The eyeballs, and the square that the features lie in (thesis sec. 3.4.1).

use super::{Bounds, EyePair, Region, Regions};
use crate::geometry::{Point, Vec2};

/// A circle for an eyeball.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Eyeball {
    /// Its middle, in pixels.
    pub centre: Point,
    /// Its radius, in pixels.
    pub radius: f64,
}

/// Both eyeballs; left and right are the image's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Eyeballs {
    /// At the image's left.
    pub left: Eyeball,
    /// At the image's right.
    pub right: Eyeball,
}

impl Eyeball {
    /// Eyeball.height: the circle's.
    #[must_use]
    pub(crate) fn height(&self) -> f64 {
        2.0 * self.radius
    }

    /// The circle that holds the most pixels of an eye's region. It is as high as the region; where several places
    /// hold as many, their middle is taken.
    #[must_use]
    pub(crate) fn of(dark: &Regions, region: &Region) -> Self {
        let b = region.bounds;
        let radius = b.height() as f64 / 2.0;
        // How many pixels of the region lie left of each column, row by row.
        let before: Vec<Vec<u32>> = (b.y0..b.y1)
            .map(|y| {
                let mut sum = 0;
                std::iter::once(0)
                    .chain((b.x0..b.x1).map(|x| {
                        sum += u32::from(dark.labels[(x, y)] == region.label);
                        sum
                    }))
                    .collect()
            })
            .collect();
        let within = |cx: usize, cy: usize| {
            let mut count = 0;
            for (row, sums) in before.iter().enumerate() {
                let half = radius * radius - (row as f64 - cy as f64).powi(2);
                if half >= 0.0 {
                    let half = half.sqrt() as usize;
                    count += sums[(cx + half + 1).min(b.width())] - sums[cx.saturating_sub(half)];
                }
            }
            count
        };
        let (mut most, mut sum, mut places) = (0, Vec2::ZERO, 0.0);
        for cy in 0..b.height() {
            for cx in 0..b.width() {
                let count = within(cx, cy);
                if count > most {
                    (most, sum, places) = (count, Vec2::ZERO, 0.0);
                }
                if count == most {
                    sum += Vec2::new((b.x0 + cx) as f64, (b.y0 + cy) as f64);
                    places += 1.0;
                }
            }
        }
        Self { centre: (sum / f64::max(places, 1.0)).to_point(), radius }
    }
}

impl Eyeballs {
    /// The eyeballs of a pair of regions.
    #[must_use]
    pub(crate) fn of(dark: &Regions, pair: &EyePair) -> Self {
        Self { left: Eyeball::of(dark, &pair.left), right: Eyeball::of(dark, &pair.right) }
    }

    /// Eyeballs whose middles are known otherwise. Their circles are as high as open eyes are on average: 0.19 of the
    /// distance between them, which is also the width of an iris.
    #[must_use]
    pub fn at(left: Point, right: Point) -> Self {
        let radius = 0.095 * left.distance(right);
        Self { left: Eyeball { centre: left, radius }, right: Eyeball { centre: right, radius } }
    }

    /// EyeMid: the middle between them.
    #[must_use]
    pub(crate) fn middle(&self) -> Point {
        self.left.centre.midpoint(self.right.centre)
    }

    /// d: the distance between them.
    #[must_use]
    pub(crate) fn distance(&self) -> f64 {
        self.left.centre.distance(self.right.centre)
    }

    /// The 2d × 2d square of the features: d to both sides of the middle, d/2 up, 3d/2 down; what of it lies in an
    /// image of that size.
    #[must_use]
    pub fn square(&self, width: usize, height: usize) -> Bounds {
        let (m, d) = (self.middle(), self.distance());
        Bounds::between(m + Vec2::new(-d, -0.5 * d), m + Vec2::new(d, 1.5 * d), width, height)
    }

    /// The point on the other side of the line that runs upright between the eyeballs.
    #[must_use]
    pub(crate) fn mirror(&self, p: Point) -> Point {
        let across = self.right.centre - self.left.centre;
        let length = across.hypot2();
        if length < 1e-12 {
            return p;
        }
        p - across * (2.0 * (p - self.middle()).dot(across) / length)
    }
}

#[cfg(test)]
mod tests {
    use super::super::Neighbours;
    use super::super::regions::drawn;
    use super::*;

    #[test]
    fn the_circle_sits_where_the_region_is_thickest() {
        let mask = drawn(&[
            "..............",
            "......###.....",
            ".....#####....",
            ".############.",
            ".....#####....",
            "......###.....",
            "..............",
        ]);
        let regions = Regions::of(&mask, Neighbours::Four);
        let ball = Eyeball::of(&regions, &regions.list[0]);
        assert_eq!((ball.centre, ball.radius), (Point::new(7.0, 3.0), 2.5));
    }

    #[test]
    fn mirroring_swaps_the_eyeballs_and_keeps_their_middle() {
        let eyes = Eyeballs::at(Point::new(100.0, 210.0), Point::new(190.0, 200.0));
        assert!(eyes.mirror(eyes.left.centre).distance(eyes.right.centre) < 1e-9);
        assert!(eyes.mirror(eyes.middle()).distance(eyes.middle()) < 1e-9);
        let square = eyes.square(600, 600);
        assert!(square.width().abs_diff(181) <= 1 && square.height().abs_diff(181) <= 1, "{square:?}");
    }
}

//! Where an eye looks: the dark iris within the opening of the lids (thesis sec. 3.4.1, 6.2, inside lids that are known).

use crate::geometry::{Point, Vec2};
use crate::photo::Grey;

/// Places across and down an eye's opening at which it is looked at.
const ACROSS: usize = 40;
const DOWN: usize = 20;
/// How much of the opening is left out at either corner, where lashes and shadow are.
const CORNERS: f64 = 0.08;
/// The share of the opening that an iris covers at least; its darkness is that of the darkest so much.
const IRIS: f64 = 0.25;
/// How many grey levels an iris is darker than the white beside it at least.
const CONTRAST: f64 = 12.0;

/// The middle of what is dark in an eye's opening, in pixels; none where nothing is. The eye is given by its inner and
/// outer corner, upper and lower lid.
pub(super) fn iris(grey: &Grey, [inner, outer, upper, lower]: [Point; 4]) -> Option<Point> {
    let across = outer - inner;
    let width = across.hypot();
    if width < 4.0 {
        return None;
    }
    let middle = inner.midpoint(outer);
    let down = {
        let v = Vec2::new(-across.y, across.x) / width;
        if v.dot(lower - upper) < 0.0 { -v } else { v }
    };
    let (top, bottom) = ((upper - middle).dot(down), (lower - middle).dot(down));
    if bottom - top < 1.5 {
        return None;
    }
    let mut seen: Vec<(f64, Point)> = Vec::with_capacity(ACROSS * DOWN);
    for i in 0..ACROSS {
        let u = CORNERS + (1.0 - 2.0 * CORNERS) * (i as f64 + 0.5) / ACROSS as f64;
        // Lids as parabolas over the line of the corners.
        let arch = 4.0 * u * (1.0 - u);
        for j in 0..DOWN {
            let v = (j as f64 + 0.5) / DOWN as f64;
            let at = inner + across * u + down * (arch * (top + (bottom - top) * v));
            seen.push((sample(grey, at)?, at));
        }
    }
    // Each column of places stands for as much of the opening as it is high there; near the corners that is little, and they
    // are weighed so below.
    let mut levels: Vec<f64> = seen.iter().map(|s| s.0).collect();
    levels.sort_by(f64::total_cmp);
    let dark = levels[(IRIS * 0.5 * levels.len() as f64) as usize];
    let white = levels[levels.len() * 4 / 5];
    if white - dark < CONTRAST {
        return None;
    }
    let threshold = 0.5 * (dark + white);
    let (mut sum, mut weight) = (Vec2::ZERO, 0.0);
    for (k, (level, at)) in seen.iter().enumerate() {
        let u = CORNERS + (1.0 - 2.0 * CORNERS) * ((k / DOWN) as f64 + 0.5) / ACROSS as f64;
        let w = (threshold - level).clamp(0.0, threshold - dark) * 4.0 * u * (1.0 - u);
        sum += at.to_vec2() * w;
        weight += w;
    }
    (weight > 0.0).then(|| (sum / weight).to_point())
}

/// The grey at a place between pixels; none outside.
fn sample(grey: &Grey, at: Point) -> Option<f64> {
    let (w, h) = (grey.width(), grey.height());
    if !(at.x >= 0.0 && at.y >= 0.0 && at.x < w as f64 - 1.0 && at.y < h as f64 - 1.0) {
        return None;
    }
    let (four, [fx, fy]) = grey.around(at.x, at.y);
    let [a, b, c, d] = four.map(|p| f64::from(*p));
    let (above, below) = (a + (b - a) * fx, c + (d - c) * fx);
    Some(above + (below - above) * fy)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dark_disc_between_lids_is_found_within_a_tenth_of_a_pixel() {
        for (cx, cy) in [(30.0, 20.0), (26.4, 20.3), (33.7, 19.6)] {
            let disc = |i: usize| {
                let (x, y) = ((i % 60) as f64, (i / 60) as f64);
                let r = f64::hypot(x - cx, y - cy);
                (200.0 - 150.0 * (5.5 - r).clamp(0.0, 1.0)) as u8
            };
            let grey = Grey::new(60, 40, (0..2400).map(disc).collect());
            let eye = [Point::new(46.0, 20.0), Point::new(14.0, 20.0), Point::new(30.0, 12.0), Point::new(30.0, 28.0)];
            let found = iris(&grey, eye).unwrap();
            assert!(found.distance(Point::new(cx, cy)) < 0.3, "{found:?} {cx} {cy}");
        }
        let flat = Grey::new(60, 40, vec![120; 2400]);
        let eye = [Point::new(46.0, 20.0), Point::new(14.0, 20.0), Point::new(30.0, 12.0), Point::new(30.0, 28.0)];
        assert_eq!(iris(&flat, eye), None);
    }
}

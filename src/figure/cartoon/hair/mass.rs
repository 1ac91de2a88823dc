//! Hair as a mass: darker toward the face and away from the light.

use super::between;
use super::rays::Rays;
use crate::drawing::Item;
use crate::figure::cartoon::Pen;
use crate::geometry::{BezPath, Point, spline};

/// The soft shades under the strands.
pub(super) fn shades(pen: &Pen, rays: &Rays) -> Vec<Item> {
    let (crown, last, shade, hair) = (Rays::CROWN, rays.runs.len(), pen.palette.hair_shade, pen.palette.hair);
    let mut toward = BezPath::new();
    for run in [crown + 2..last - 1, 1..crown - 2] {
        toward.extend(band(rays, run, |t| (-0.08, 0.17 * swell(t))));
    }
    let far = band(rays, 1..crown - 4, |t| (1.0 - 0.30 * swell(t), 1.1));
    let under = band(rays, crown + 22..last, |t| (1.0 - 0.16 * swell(t), 1.1));
    let mut items = vec![Item::area("hair-shade", toward, shade), Item::area("hair-far", far, shade.over(hair, 0.85))];
    items.push(Item::area("hair-under", under, shade.over(hair, 0.6)));
    items
}

/// 0 at both ends of a band, 1 where it is fullest.
fn swell(t: f64) -> f64 {
    (std::f64::consts::PI * t).sin().max(0.0).sqrt()
}

/// The area between two levels that change along a run of rays.
fn band(rays: &Rays, run: std::ops::Range<usize>, levels: impl Fn(f64) -> (f64, f64)) -> BezPath {
    let last = run.len().max(2) as f64 - 1.0;
    let mut path = BezPath::new();
    let (mut low, mut high): (Vec<Point>, Vec<Point>) = (Vec::new(), Vec::new());
    let mut close = |low: &mut Vec<Point>, high: &mut Vec<Point>| {
        if low.len() > 3 {
            low.extend(high.drain(..).rev());
            path.extend(spline(low, true));
        }
        low.clear();
        high.clear();
    };
    for (k, i) in run.enumerate() {
        match rays.runs.get(i).copied().flatten() {
            Some(ray) => {
                let (a, b) = levels(k as f64 / last);
                low.push(between(ray, a));
                high.push(between(ray, b));
            }
            None => close(&mut low, &mut high),
        }
    }
    close(&mut low, &mut high);
    path
}

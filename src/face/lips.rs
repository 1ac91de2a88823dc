//! Whether lips are parted: what lies between them is teeth, lighter and greyer than the cheeks, or dark.

use super::{Colours, FeaturePoint as P, Points};
use crate::drawing::Oklch;
use crate::photo::Photo;

/// Samples across the mouth and down it.
const GRID: (usize, usize) = (25, 25);

/// The shares of the mouth, between its corners and from 8.1 to 8.2, that look like teeth and like the dark behind
/// them, each 0 to 1.
#[must_use]
pub(super) fn parted(photo: &Photo, points: &Points, colours: &Colours) -> [f64; 2] {
    let skin = Oklch::from(colours.skin);
    let (left, right) = (points[P::P8_4], points[P::P8_3]);
    let (top, bottom) = (points[P::P8_1], points[P::P8_2]);
    let middle = left.midpoint(right);
    let mut counts = [0_usize; 2];
    for i in 0..GRID.0 {
        let t = 0.15 + 0.7 * (i as f64 + 0.5) / GRID.0 as f64;
        let across = left.lerp(right, t);
        // Lips are thinner toward the corners.
        let high = 1.0 - (2.0 * t - 1.0).powi(2);
        for j in 0..GRID.1 {
            let down = top.lerp(bottom, (j as f64 + 0.5) / GRID.1 as f64) - middle;
            let at = across + down * high;
            let seen = Oklch::from(photo.colour(at.x.round() as isize, at.y.round() as isize));
            counts[0] += usize::from(seen.l > 0.92 * skin.l && seen.c < 0.8 * skin.c);
            counts[1] += usize::from(seen.l < 0.5 * skin.l);
        }
    }
    counts.map(|n| n as f64 / (GRID.0 * GRID.1) as f64)
}

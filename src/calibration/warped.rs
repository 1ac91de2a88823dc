//! A picture bent from one shape to another: what a face that was photographed at rest would look like.

use crate::aam::triangles;
use crate::geometry::{Point, Vec2};
use crate::photo::Grey;
use crate::photo::Mask;

/// A triangle that grows to more than so many times its size shows what was hidden: the inside of a mouth.
const OPENED: f64 = 5.0;
/// How dark the inside of a mouth is, against the whole of the face's light.
const INSIDE: f64 = 0.32;

/// The part of a picture round a shape, in which the face has another one; with where that lies in it. `scale` is how
/// many pixels of the new picture a pixel of the old one is.
pub(super) fn bent(grey: &Grey, from: &[Point], to: &[Point], scale: f64) -> (Grey, Vec<Point>) {
    let first = to.first().copied().unwrap_or_default();
    let (mut low, mut high) = (first, first);
    for p in to.iter().chain(from) {
        low = Point::new(low.x.min(p.x), low.y.min(p.y));
        high = Point::new(high.x.max(p.x), high.y.max(p.y));
    }
    let margin = 0.12 * (high - low).hypot();
    let low = low - Vec2::new(margin, margin);
    let size = (high - low) + Vec2::new(margin, margin);
    let [width, height] = [size.x, size.y].map(|v| ((v * scale).ceil() as usize).clamp(8, 2000));
    let place = |p: &Point| ((*p - low) * scale).to_point();
    // What lies round the face stays: points round it that do not move.
    let mut old: Vec<Point> = from.to_vec();
    let mut new: Vec<Point> = to.iter().map(place).collect();
    for i in 0..4 {
        for (x, y) in [(f64::from(i), 0.0), (4.0, f64::from(i)), (f64::from(4 - i), 4.0), (0.0, f64::from(4 - i))] {
            let at = low + Vec2::new(size.x * x / 4.0, size.y * y / 4.0);
            old.push(at);
            new.push(place(&at));
        }
    }
    let dark = INSIDE * brightness(grey, from);
    let mut picture = Grey::filled(width, height, 0);
    let mut seen = Mask::filled(width, height, false);
    for t in triangles(&new) {
        let [a, b, c] = t.map(|i| new[i]);
        let [oa, ob, oc] = t.map(|i| old[i]);
        let (ab, ac) = (b - a, c - a);
        let area = ab.cross(ac);
        let before = (ob - oa).cross(oc - oa) * scale * scale;
        let face = t.iter().all(|i| *i < from.len());
        let opened = face && area.abs() > OPENED * before.abs() && area.abs() > 6.0;
        let range =
            |l: f64, h: f64, n: usize| l.ceil().max(0.0) as usize..=(h.floor().min(n as f64 - 1.0)).max(0.0) as usize;
        for y in range(a.y.min(b.y).min(c.y), a.y.max(b.y).max(c.y), height) {
            for x in range(a.x.min(b.x).min(c.x), a.x.max(b.x).max(c.x), width) {
                let p = Point::new(x as f64, y as f64) - a;
                let (u, v) = (p.cross(ac) / area, ab.cross(p) / area);
                let at = (x, y);
                if u < -1e-9 || v < -1e-9 || u + v > 1.0 + 1e-9 || seen[at] {
                    continue;
                }
                seen[at] = true;
                let from = oa + (ob - oa) * u + (oc - oa) * v;
                picture[at] = if opened { dark } else { between(grey, from) }.round().clamp(0.0, 255.0) as u8;
            }
        }
    }
    for y in 0..height {
        for x in 0..width {
            if !seen[(x, y)] {
                let at = low + Vec2::new(x as f64, y as f64) / scale;
                picture[(x, y)] = between(grey, at).round().clamp(0.0, 255.0) as u8;
            }
        }
    }
    new.truncate(to.len());
    (picture, new)
}

/// The mean of a picture at some points.
fn brightness(grey: &Grey, at: &[Point]) -> f64 {
    at.iter().map(|p| between(grey, *p)).sum::<f64>() / at.len().max(1) as f64
}

/// A picture between its pixels; its border goes on outside.
pub(super) fn between(grey: &Grey, at: Point) -> f64 {
    let (four, [u, v]) = grey.around(at.x, at.y);
    let [a, b, c, d] = four.map(|p| f64::from(*p));
    (a * (1.0 - u) + b * u) * (1.0 - v) + (c * (1.0 - u) + d * u) * v
}

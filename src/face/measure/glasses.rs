//! Whether the face wears glasses: a line across the bridge of the nose, and lines under both eyes.

use super::frame::{Frame, HEIGHT, VIEW, WIDTH};
use super::shape::Shape;
use crate::face::FeaturePoint as P;
use crate::geometry::Rect;

/// How likely the face wears glasses, 0 to 1. It takes a line across the bridge and one under either eye together:
/// folds of skin make the one or the other, not all three.
pub(super) fn likely(frame: &Frame, shape: &Shape) -> f64 {
    let [bridge, under] = lines(frame, shape);
    // Between what bare faces and drawn rims show: see the test of glasses.
    let score = (bridge / BRIDGE).min(under / UNDER);
    1.0 / (1.0 + (-8.0 * (score - 1.0)).exp())
}

/// A mean step of lightness along a line across the bridge at which glasses are as likely as not.
const BRIDGE: f64 = 0.05;
/// The same under the eyes.
const UNDER: f64 = 0.06;

/// How strongly lines run across the bridge, and under the weaker of the two eyes.
pub(super) fn lines(frame: &Frame, shape: &Shape) -> [f64; 2] {
    let p = &shape.points;
    let bridge = Rect::new(-9.0, -16.0, 9.0, 20.0);
    let under = [P::P3_6, P::P3_5].map(|eye| {
        let lid = if eye == P::P3_6 { p[P::P3_4].y } else { p[P::P3_3].y };
        strongest(frame, Rect::new(p[eye].x - 20.0, lid + 8.0, p[eye].x + 20.0, lid + 34.0))
    });
    [strongest(frame, bridge), under[0].min(under[1])]
}

/// The mean response along the strongest path across `area` from left to right, which rises or falls by at most a
/// unit a unit. The response of a place is how much darker or lighter it is than both what is above and below.
fn strongest(frame: &Frame, area: Rect) -> f64 {
    const THICK: usize = 4;
    let column = |x: f64| (x - VIEW.x0).round().clamp(0.0, (WIDTH - 1) as f64) as usize;
    let row = |y: f64| (y - VIEW.y0).round().clamp(THICK as f64, (HEIGHT - 1 - THICK) as f64) as usize;
    let (left, right, top, bottom) = (column(area.x0), column(area.x1), row(area.y0), row(area.y1));
    if right <= left || bottom <= top {
        return 0.0;
    }
    let light = |r: usize, c: usize| frame.lab[r * WIDTH + c][0];
    let mut most = 0.0_f32;
    for sign in [1.0_f32, -1.0] {
        let response = |r: usize, c: usize| {
            let (up, here, down) = (light(r - THICK, c), light(r, c), light(r + THICK, c));
            (sign * (up - here)).min(sign * (down - here)).max(0.0)
        };
        let mut total: Vec<f32> = (top..=bottom).map(|r| response(r, left)).collect();
        for c in left + 1..=right {
            total = (0..total.len())
                .map(|k| {
                    let before = &total[k.saturating_sub(1)..(k + 2).min(total.len())];
                    before.iter().fold(0.0_f32, |m, v| m.max(*v)) + response(top + k, c)
                })
                .collect();
        }
        let best = total.iter().fold(0.0_f32, |m, v| m.max(*v)) / (right - left + 1) as f32;
        most = most.max(best);
    }
    f64::from(most)
}

//! The smaller measures: beard, neck, height of the brows.

use super::colours::{Cheeks, chin, median};
use super::frame::{Frame, Lab};
use super::mask::{COLUMNS, centre, column_at, row_at};
use super::segment::Regions;
use super::shape::{Shape, USUAL_JAW, jaw_curve};
use crate::face::{Beard, FeaturePoint as P};
use crate::geometry::{ParamCurve, Point, Vec2};
use crate::photo::Mask;

/// How much darker than the cheek of the same side chin, jaw, lower cheek and upper lip are. Where hair hangs before
/// them they are not measured, and count as not darker.
pub(super) fn beard(frame: &Frame, shape: &Shape, cheeks: &Cheeks, hair: &Mask) -> Beard {
    let p = &shape.points;
    let both = (cheeks.light[0] + cheeks.light[1]) / 2.0;
    let clear = |at: Point| !hair[(column_at(at.x), row_at(at.y))];
    let darker = |light: f32, at: Point, radius: f64| {
        let tone = median(&frame.around(at, radius)).filter(|_| clear(at))?;
        Some(f64::from(light - tone[0]))
    };
    let sides = [(P::P2_14, P::P10_6, cheeks.light[0]), (P::P2_13, P::P10_5, cheeks.light[1])];
    let mut jaw: Vec<f64> = Vec::new();
    let mut cheek: Vec<f64> = Vec::new();
    for (corner, lobe, light) in sides {
        let curve = jaw_curve(p[P::P2_1], p[corner], p[lobe], USUAL_JAW);
        let inward = |at: Point, to: P, share: f64| at.lerp(p[to], share);
        for t in [0.3, 0.55, 0.8] {
            jaw.extend(darker(light, inward(curve.eval(t), P::P8_2, 0.09), 2.7));
        }
        cheek.extend(darker(light, inward(p[corner], P::P9_15, 0.12), 2.7));
    }
    jaw.sort_by(f64::total_cmp);
    let under = p[P::P9_15].lerp(p[P::P8_1], 0.55);
    let lip: Vec<f64> = [-13.0, 13.0].iter().filter_map(|x| darker(both, under + Vec2::new(*x, 1.0), 2.0)).collect();
    let mean = |values: &[f64]| if values.is_empty() { 0.0 } else { values.iter().sum::<f64>() / values.len() as f64 };
    Beard {
        chin: median(&chin(frame, shape)).map_or(0.0, |tone: Lab| f64::from(both - tone[0])),
        jaw: jaw.get(jaw.len() / 2).copied().unwrap_or(0.0),
        cheek: mean(&cheek),
        lip: mean(&lip),
    }
}

/// Half the width of the neck in half widths of the jaw, 0.66 to 0.84: the nearer of its two edges, below the chin.
/// 0.76 where it cannot be seen.
pub(super) fn neck(regions: &Regions, shape: &Shape) -> f64 {
    let skin = |row: usize, column: usize| {
        let cell = row * COLUMNS + column;
        regions.inside[cell] && regions.skin()[cell] > 0.5
    };
    let middle = column_at(shape.points[P::P2_1].x);
    let mut widths: Vec<f64> = (row_at(shape.chin + 14.0)..=row_at(shape.chin + 30.0))
        .filter(|row| skin(*row, middle))
        .map(|row| {
            let left = (0..middle).rev().take_while(|k| skin(row, *k)).last().unwrap_or(middle);
            let right = (middle..COLUMNS).take_while(|k| skin(row, *k)).last().unwrap_or(middle);
            let x = |column: usize| centre(row * COLUMNS + column).x - shape.points[P::P2_1].x;
            -x(left).max(-x(right))
        })
        .collect();
    if widths.len() < 4 {
        return 0.76;
    }
    widths.sort_by(f64::total_cmp);
    (widths[widths.len() / 2] / shape.half_jaw).clamp(0.66, 0.84)
}

/// The height of the brows in pupil distances: how far up and down from its darkest line the brow stands out from
/// the skin, the median of four places. 0.12 where no brow stands out.
pub(super) fn brow_height(frame: &Frame, shape: &Shape) -> f64 {
    const USUAL: f64 = 0.12;
    const REACH: i32 = 15;
    /// Where the hairs thin out to this share of the brow's darkness is its edge, as a hand sets it.
    const EDGE: f32 = 0.22;
    let p = &shape.points;
    let mut heights = Vec::new();
    for (a, b) in [(P::P4_4, P::P4_4A), (P::P4_4A, P::P4_4), (P::P4_3, P::P4_3A), (P::P4_3A, P::P4_3)] {
        let middle = p[a].lerp(p[b], 0.25);
        let slope = (p[b].y - p[a].y) / (p[b].x - p[a].x).abs().max(1.0) * (p[b].x - p[a].x).signum();
        // The mean over nine columns, each shifted along the brow's slope.
        let profile: Vec<f32> = (-REACH..=REACH)
            .map(|dy| {
                let tone =
                    |dx: i32| frame.at(middle.x + f64::from(dx), middle.y + f64::from(dy) + slope * f64::from(dx))[0];
                (-4..=4).map(tone).sum::<f32>() / 9.0
            })
            .collect();
        let darkest =
            (6..profile.len() - 6).min_by(|i, j| profile[*i].total_cmp(&profile[*j])).unwrap_or(REACH as usize);
        // Below the brow lies the lid's shadow, so skin is what is lightest within a brow's height on either side.
        let above = profile[..darkest].iter().fold(0.0_f32, |m, v| m.max(*v));
        let below = profile[darkest..].iter().take(14).fold(0.0_f32, |m, v| m.max(*v));
        if above.min(below) - profile[darkest] < 0.04 {
            continue;
        }
        let edge = |levels: &mut dyn Iterator<Item = f32>, light: f32| {
            let edge = light + (profile[darkest] - light) * EDGE;
            let (mut before, mut steps) = (profile[darkest], 0.0);
            for v in levels {
                if v > edge {
                    return steps + (edge - before) / (v - before).max(1e-6);
                }
                before = v;
                steps += 1.0;
            }
            steps
        };
        let up = edge(&mut profile[..darkest].iter().rev().copied(), above);
        let down = edge(&mut profile[darkest + 1..].iter().copied(), below);
        heights.push(f64::from(up + down) / 100.0);
    }
    if heights.is_empty() {
        return USUAL;
    }
    heights.sort_by(f64::total_cmp);
    let n = heights.len();
    ((heights[(n - 1) / 2] + heights[n / 2]) / 2.0).clamp(0.05, 0.22)
}

//! A clip's whole score in one picture: sound, syllables, mouth shapes, ratios.

use super::axes::{Axes, TEXT, block, chart, rule};
use super::curves::{Samples, heading, peak_letters};
use super::{GREY, INK, RULE, colour_of};
use crate::drawing::{Anchor, Colour, Drawing, Item};
use crate::geometry::{BezPath, Point, Rect};
use crate::pose::Emotion;

/// Labels with times, a lane of the chart.
pub struct Row<'a> {
    /// What the lane is called.
    pub name: &'a str,
    /// Start, end and label; an end at its start is a moment.
    pub spans: Vec<(f64, f64, String)>,
}

/// The score of a clip. `peaks` are the lowest and highest values of the sound in equal steps over the duration.
#[must_use]
pub fn timeline(title: &str, duration: f64, peaks: &[(f32, f32)], rows: &[Row<'_>], samples: &Samples) -> Drawing {
    const LEFT: f64 = 110.0;
    const RIGHT: f64 = 1360.0;
    let mut items = vec![heading(title)];
    let axes = |top: f64, bottom: f64, values| Axes {
        area: Rect::new(LEFT, top, RIGHT, bottom),
        times: (0.0, duration.max(1e-3)),
        values,
    };
    let mut top = 60.0;
    let lane = |items: &mut Vec<Item>, name: &str, y: f64| {
        items.push(Item::text(Point::new(LEFT - 12.0, y), TEXT, Anchor::End, GREY, name));
    };
    if !peaks.is_empty() {
        let wave = axes(top, top + 90.0, (-1.0, 1.0));
        let loudest = peaks.iter().map(|(a, b)| a.abs().max(b.abs())).fold(1e-6, f32::max);
        let mut path = BezPath::new();
        let at = |i: usize, v: f32| {
            let time = duration * (i as f64 + 0.5) / peaks.len() as f64;
            Point::new(wave.x(time), wave.y(f64::from(v / loudest)))
        };
        path.move_to(at(0, peaks[0].1));
        (1..peaks.len()).for_each(|i| path.line_to(at(i, peaks[i].1)));
        (0..peaks.len()).rev().for_each(|i| path.line_to(at(i, peaks[i].0)));
        path.close_path();
        items.push(Item::area("sound", path, Colour::rgb(0x9A, 0xA3, 0xB5)));
        lane(&mut items, "sound", top + 50.0);
        top += 104.0;
    }
    for row in rows {
        let area = axes(top, top + 30.0, (0.0, 1.0));
        for (start, end, label) in &row.spans {
            let (x0, x1) = (area.x(*start), area.x(*end));
            if end > start {
                items.push(block(Rect::new(x0, top, x1, top + 28.0), RULE));
                items.push(rule(Point::new(x0, top), Point::new(x0, top + 28.0), 1.2, GREY));
                items.push(rule(Point::new(x1, top), Point::new(x1, top + 28.0), 1.2, GREY));
            }
            let middle = Point::new(f64::midpoint(x0, x1), top + 19.0);
            items.push(Item::text(middle, TEXT + 1.0, Anchor::Middle, INK, label));
        }
        lane(&mut items, row.name, top + 19.0);
        top += 38.0;
    }
    top += 26.0;
    let low = samples.iter().flat_map(|(_, r)| r.0).fold(0.0, f64::min);
    let high = samples.iter().flat_map(|(_, r)| r.0).fold(1.0, f64::max);
    let chart_axes = axes(top, top + 240.0, (low, high));
    items.extend(chart_axes.items("ratio", true));
    for emotion in Emotion::ALL {
        let points = samples.iter().map(|(t, r)| (*t, r[emotion]));
        items.push(chart_axes.curve(emotion.name(), points, 2.2, colour_of(emotion)));
        let at = Point::new(LEFT + 90.0 * emotion.index() as f64 + 60.0, top + 240.0 + 44.0);
        items.push(Item::text(at, TEXT, Anchor::Start, colour_of(emotion), format!("{} {emotion}", emotion.letter())));
    }
    items.extend(peak_letters(&chart_axes, samples));
    chart(title, "Sound, syllables, mouth shapes and emotion ratios over time.", 1400.0, top + 310.0, items)
}

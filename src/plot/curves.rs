//! The ratios over time (paper fig. 6) and how fast they change (fig. 7).

use super::axes::{Axes, TEXT, chart, number};
use super::{INK, colour_of};
use crate::drawing::{Anchor, Drawing, Item};
use crate::geometry::{Point, Rect};
use crate::pose::{Emotion, Ratios};

/// The ratios at every frame, with their times in seconds.
pub type Samples = [(f64, Ratios)];

const WIDTH: f64 = 1200.0;

/// The seven ratios over time in one chart. A letter stands over
/// each hill of a curve and at its end, so that no curve is told by colour alone.
#[must_use]
pub fn ratios(title: &str, samples: &Samples) -> Drawing {
    let (low, high) = bounds(samples.iter().flat_map(|(_, r)| r.0));
    let axes = Axes {
        area: Rect::new(70.0, 70.0, WIDTH - 130.0, 500.0),
        times: times(samples),
        values: ((low.min(0.0) * 10.0 - 0.5).floor() / 10.0, (high.max(1.0) * 10.0 + 0.5).ceil() / 10.0),
    };
    let mut items = vec![heading(title)];
    items.extend(axes.items("ratio", true));
    // Neutral first, so that what is felt lies over it.
    for emotion in Emotion::ALL {
        let points = samples.iter().map(|(t, r)| (*t, r[emotion]));
        items.push(axes.curve(emotion.name(), points, 2.4, colour_of(emotion)));
    }
    items.extend(peak_letters(&axes, samples));
    items.extend(end_labels(&axes, samples));
    chart(title, "The seven emotion ratios over time.", WIDTH, 560.0, items)
}

/// How fast each ratio changes, a strip an emotion on one scale: change per second between neighbouring samples.
#[must_use]
pub fn change(title: &str, samples: &Samples) -> Drawing {
    let rates: Vec<(f64, Ratios)> = samples
        .windows(2)
        .filter(|w| w[1].0 > w[0].0)
        .map(|w| {
            let dt = w[1].0 - w[0].0;
            (w[1].0, Ratios(std::array::from_fn(|i| (w[1].1.0[i] - w[0].1.0[i]) / dt)))
        })
        .collect();
    let (low, high) = bounds(rates.iter().flat_map(|(_, r)| r.0));
    let most = low.abs().max(high.abs()).max(0.5);
    let mut items = vec![heading(title)];
    const STRIP: f64 = 92.0;
    for emotion in Emotion::ALL {
        let top = 70.0 + STRIP * emotion.index() as f64;
        let axes = Axes {
            area: Rect::new(170.0, top, WIDTH - 40.0, top + STRIP - 16.0),
            times: times(samples),
            values: (-most, most),
        };
        let last = emotion == Emotion::Surprised;
        items.extend(axes.items("", last));
        let colour = colour_of(emotion);
        items.push(axes.curve(emotion.name(), rates.iter().map(|(t, r)| (*t, r[emotion])), 2.0, colour));
        let at = Point::new(20.0, top + 0.5 * STRIP);
        items.push(Item::text(at, TEXT + 1.0, Anchor::Start, colour, format!("{} {emotion}", emotion.letter())));
    }
    let note = format!("change per second, all strips from {} to {}", number(-most), number(most));
    items.push(Item::text(Point::new(170.0, 54.0), TEXT, Anchor::Start, super::GREY, note));
    chart(title, "How fast the seven emotion ratios change.", WIDTH, 70.0 + 7.0 * STRIP + 40.0, items)
}

pub(super) fn heading(title: &str) -> Item {
    Item::text(Point::new(20.0, 34.0), 20.0, Anchor::Start, INK, title)
}

pub(super) fn times(samples: &Samples) -> (f64, f64) {
    let (from, to) = (samples.first().map_or(0.0, |s| s.0), samples.last().map_or(1.0, |s| s.0));
    (from, to.max(from + 1e-3))
}

fn bounds(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
}

/// The letter of each emotion over each of its hills, where one rises enough to be looked for.
pub(super) fn peak_letters(axes: &Axes, samples: &Samples) -> Vec<Item> {
    let (mut items, mut taken): (Vec<Item>, Vec<Point>) = (Vec::new(), Vec::new());
    for emotion in Emotion::ALL {
        let mut start = 0;
        while start < samples.len() {
            let level = samples[start].1[emotion];
            let length = samples[start..].iter().take_while(|s| (s.1[emotion] - level).abs() < 1e-3).count();
            let lower = |i: Option<usize>| i.and_then(|i| samples.get(i)).is_none_or(|s| s.1[emotion] < level);
            let is_hill = lower(start.checked_sub(1)) && lower(Some(start + length));
            // Clear of the axis's name in the corner.
            let middle = axes.x(samples[start + length / 2].0).max(axes.area.x0 + 4.0 * TEXT);
            if is_hill && level > 0.08 {
                let mut at = Point::new(middle, axes.y(level) - 6.0);
                // Two emotions on one level share a hill: their letters stand side by side.
                while taken.iter().any(|t| (t.x - at.x).abs() < TEXT && (t.y - at.y).abs() < TEXT) {
                    at.x += TEXT;
                }
                taken.push(at);
                let letter = emotion.letter().to_string();
                items.push(Item::text(at, TEXT + 1.0, Anchor::Middle, colour_of(emotion), letter));
            }
            start += length;
        }
    }
    items
}

/// Name and letter of each curve at its right end, moved apart where ends are close.
fn end_labels(axes: &Axes, samples: &Samples) -> Vec<Item> {
    let Some((_, last)) = samples.last() else { return Vec::new() };
    let mut labels: Vec<(f64, Emotion)> = Emotion::ALL.into_iter().map(|e| (axes.y(last[e]), e)).collect();
    labels.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let step = 1.35 * TEXT;
    for i in 1..labels.len() {
        labels[i].0 = labels[i].0.max(labels[i - 1].0 + step);
    }
    let overflow = labels.last().map_or(0.0, |l| (l.0 - axes.area.y1).max(0.0));
    labels
        .into_iter()
        .map(|(y, emotion)| {
            let at = Point::new(axes.area.x1 + 10.0, y - overflow + 0.35 * TEXT);
            Item::text(at, TEXT, Anchor::Start, colour_of(emotion), format!("{} {emotion}", emotion.letter()))
        })
        .collect()
}

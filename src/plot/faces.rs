//! Faces with their ratios: a frame beside its bars (paper fig. 4), several moments with their numbers (fig. 5).

use super::axes::{TEXT, block, chart, number, rule};
use super::curves::heading;
use super::pixels::image;
use super::{GREY, INK, RULE, colour_of};
use crate::drawing::{Anchor, Drawing, Item};
use crate::geometry::{Affine, Point, Rect, Vec2};
use crate::photo::Photo;
use crate::pose::{Emotion, Ratios};

/// A drawing beside the seven ratios it shows as bars; before it the frame of the video that it is drawn from, where
/// there is one.
#[must_use]
pub fn frame(title: &str, video: Option<&Photo>, face: &Drawing, ratios: &Ratios) -> Drawing {
    let mut items = vec![heading(title)];
    let left = if video.is_some() { 560.0 } else { 0.0 };
    if let Some(photo) = video {
        let (photo, _) = photo.at_most(VIDEO_SIDE);
        let (width, height) = (photo.width() as f64, photo.height() as f64);
        let scale = (520.0 / width).min(540.0 / height);
        let corner = Vec2::new(20.0 + (520.0 - scale * width) / 2.0, 60.0 + (540.0 - scale * height) / 2.0);
        items.push(Item::moved("video", Affine::translate(corner) * Affine::scale(scale), vec![image(&photo)]));
    }
    items.push(face.placed_in(Rect::new(left + 20.0, 60.0, left + 560.0, 600.0)));
    items.extend(bars(Rect::new(left + 700.0, 110.0, left + 1080.0, 550.0), ratios));
    chart(title, "A face beside its seven emotion ratios.", left + 1200.0, 630.0, items)
}

/// The longest side of a video's frame as it is drawn.
const VIDEO_SIDE: usize = 800;

/// Bars to the right for ratios above 0 and to the left for those below, on one axis.
fn bars(area: Rect, ratios: &Ratios) -> Vec<Item> {
    let low = ratios.0.iter().copied().fold(0.0, f64::min).min(-0.2);
    let high = ratios.0.iter().copied().fold(1.0, f64::max);
    let x = |v: f64| area.x0 + (v - low) / (high - low) * area.width();
    let row = area.height() / 7.0;
    let mut items = Vec::new();
    for tick in super::axes::ticks(low, high, 5.0) {
        items.push(rule(Point::new(x(tick), area.y0 - 6.0), Point::new(x(tick), area.y1), 1.0, RULE));
        let at = Point::new(x(tick), area.y1 + 1.5 * TEXT);
        items.push(Item::text(at, TEXT, Anchor::Middle, GREY, number(tick)));
    }
    for emotion in Emotion::ALL {
        let (value, top) = (ratios[emotion], area.y0 + row * emotion.index() as f64);
        let (a, b) = (x(0.0).min(x(value)), x(0.0).max(x(value)));
        items.push(block(Rect::new(a, top + 0.2 * row, b.max(a + 1.0), top + 0.72 * row), colour_of(emotion)));
        let name = format!("{} {emotion}", emotion.letter());
        let base = top + 0.46 * row + 0.35 * TEXT;
        items.push(Item::text(Point::new(area.x0 - 12.0, base), TEXT + 1.0, Anchor::End, INK, name));
        let text = format!("{}{:.2}", if value < 0.0 { "\u{2212}" } else { "" }, value.abs());
        items.push(Item::text(Point::new(area.x1 + 12.0, base), TEXT + 1.0, Anchor::Start, INK, text));
    }
    items.push(rule(Point::new(x(0.0), area.y0 - 6.0), Point::new(x(0.0), area.y1), 1.2, GREY));
    items
}

/// Drawings in rows, each under its label, with its seven ratios beside it where they are given.
#[must_use]
pub fn faces(title: &str, list: &[(String, Drawing, Option<Ratios>)]) -> Drawing {
    let columns = list.len().clamp(1, 4);
    let rows = list.len().div_ceil(columns).max(1);
    let with_numbers = list.iter().any(|(_, _, r)| r.is_some());
    let cell = (if with_numbers { 400.0 } else { 300.0 }, 320.0);
    let mut items = vec![heading(title)];
    for (i, (label, face, ratios)) in list.iter().enumerate() {
        let (x, y) = ((i % columns) as f64 * cell.0 + 20.0, (i / columns) as f64 * cell.1 + 60.0);
        items.push(Item::text(Point::new(x + 8.0, y + 14.0), TEXT + 1.0, Anchor::Start, INK, label));
        items.push(face.placed_in(Rect::new(x, y + 22.0, x + 285.0, y + cell.1 - 12.0)));
        if let Some(ratios) = ratios {
            for emotion in Emotion::ALL {
                let base = y + 70.0 + 26.0 * emotion.index() as f64;
                let value = ratios[emotion];
                let text = format!("{}{:.2}", if value < 0.0 { "\u{2212}" } else { "" }, value.abs());
                let name = Point::new(x + 292.0, base);
                items.push(Item::text(name, TEXT, Anchor::Start, colour_of(emotion), emotion.letter().to_string()));
                items.push(Item::text(Point::new(x + 358.0, base), TEXT, Anchor::End, INK, text));
            }
        }
    }
    let (width, height) = (columns as f64 * cell.0 + 20.0, rows as f64 * cell.1 + 70.0);
    chart(title, "Faces and their emotion ratios.", width, height, items)
}

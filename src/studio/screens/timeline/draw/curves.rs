//! The seven ratios over time, in braille, each with its colour, and its letter at the right edge and at its peak.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Modifier;

use super::sound::Dots;
use crate::pose::Emotion;
use crate::project::{Clip, Concern};
use crate::studio::app::colours::Colours;
use crate::studio::screens::timeline::editor::Editor;
use crate::studio::widgets::text::{DIM, cells, put};

/// A curve that never gets this far from zero in sight has no letter: all of those lie on one line.
const NOTHING: f64 = 0.02;

pub(super) fn curves(buffer: &mut Buffer, area: Rect, editor: &Editor, clip: &Clip, colours: Colours) {
    let window = editor.window;
    let columns = usize::from(area.width) * 2;
    let rows = usize::from(area.height) * 4;
    let (low, high) = editor.extent;
    let row = |v: f64| ((high - v) / (high - low) * (rows as f64 - 1.0)).round().clamp(0.0, rows as f64 - 1.0) as usize;
    let time = |column: usize| window.time_of(column as f64 / 2.0 + 0.25, area.width);
    let end = editor.timeline.duration();
    let samples: Vec<_> =
        (0..columns).take_while(|c| time(*c) < end).map(|c| editor.timeline.ratios(time(c))).collect();
    // What the height stands for: 1 where the curves get that far, else the tenth above the highest.
    let top = if high >= 1.0 { 1.0 } else { high };
    for value in [top, 0.0] {
        let text = format!("{value:.1}").replace("0.0", "0").replace("1.0", "1").replace("0.", ".");
        let wide = cells(&text);
        put(buffer, area.x.saturating_sub(wide), area.y + (row(value) / 4) as u16, wide, &text, DIM);
    }
    lost(buffer, area, editor, clip, colours);
    // What was tracked stays in sight, faint, where an author's edits and keys have changed it.
    if let Some(record) = &clip.record {
        let mut dots = Dots::new(area);
        for (column, now) in samples.iter().enumerate() {
            let Some((tracked, _)) = record.at(time(column)) else { continue };
            for emotion in Emotion::ALL.into_iter().filter(|e| (tracked[*e] - now[*e]).abs() > NOTHING) {
                dots.set(column, row(tracked[emotion]));
            }
        }
        dots.put(buffer, DIM);
    }
    let mut edge: Vec<Vec<Emotion>> = vec![Vec::new(); usize::from(area.height)];
    let mut peaks = Vec::new();
    // Neutral first: where curves meet, the six lie over it.
    for emotion in Emotion::ALL {
        let largest = samples.iter().map(|r| r[emotion].abs()).fold(0.0, f64::max);
        if largest < NOTHING {
            continue;
        }
        let mut dots = Dots::new(area);
        let mut before = None;
        for (column, ratios) in samples.iter().enumerate() {
            let y = row(ratios[emotion]);
            let from = before.unwrap_or(y);
            for y in from.min(y)..=from.max(y) {
                // A step is joined up to the dot before it.
                dots.set(column, y);
            }
            before = Some(y);
        }
        dots.put(buffer, colours.of_emotion(emotion));
        if let Some(y) = before {
            edge[y / 4].push(emotion);
        }
        let peak = samples.iter().enumerate().max_by(|a, b| a.1[emotion].total_cmp(&b.1[emotion]));
        if let Some((column, ratios)) = peak.filter(|_| emotion != Emotion::Neutral && largest > 0.1) {
            peaks.push((column, row(ratios[emotion]), emotion));
        }
    }
    let letter = |e: Emotion| (e.letter().to_string(), colours.of_emotion(e).add_modifier(Modifier::BOLD));
    for (index, emotions) in edge.iter().enumerate() {
        let mut x = area.x + (samples.len().div_ceil(2) as u16).min(area.width);
        for emotion in emotions {
            let (text, style) = letter(*emotion);
            x += put(buffer, x, area.y + index as u16, 1, &text, style);
        }
    }
    // At its peak, where that is not at the edge anyway.
    for (column, y, emotion) in peaks.into_iter().filter(|(c, ..)| c + 6 < samples.len()) {
        let (text, style) = letter(emotion);
        let x = area.x + (column / 2) as u16;
        put(buffer, x, area.y + (y / 4) as u16, 1, &text, style);
    }
}

/// Stretches in which the video shows no face, or shows it unsurely: the curves are bridged there.
fn lost(buffer: &mut Buffer, area: Rect, editor: &Editor, clip: &Clip, colours: Colours) {
    let window = editor.window;
    for doubt in clip.lost() {
        let sign = if doubt.what == Concern::FaceLost { "░" } else { "·" };
        let (start, end) = (window.column(doubt.start, area.width), window.column(doubt.end, area.width));
        // A single frame is seen too.
        for column in start.max(0)..end.max(start + 1).min(i32::from(area.width)) {
            for y in area.y..area.bottom() {
                put(buffer, area.x + column as u16, y, 1, sign, colours.warning());
            }
        }
    }
}

//! The pitch of the voice over the syllables: dots at its height in the speaker's own range, gaps left open.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::sound::Dots;
use crate::project::Clip;
use crate::studio::app::heard::Tone;
use crate::studio::screens::timeline::editor::Editor;
use crate::studio::widgets::text::{DIM, cells, put};

/// A step of more than this share of the range from one column to the next is no glide of a voice: it is left open.
const LEAP: usize = 2;

pub(super) fn tone(buffer: &mut Buffer, area: Rect, heard: Option<&Tone>, editor: &Editor, clip: &Clip) {
    let middle = area.y + area.height / 2;
    if clip.sound.is_none() {
        put(buffer, area.x, middle, area.width, "no sound: add a speech.wav to the clip", DIM);
        return;
    }
    let Some(tone) = heard else {
        put(buffer, area.x, middle, area.width, "listening…", DIM);
        return;
    };
    let Some((low, high)) = tone.hertz() else {
        put(buffer, area.x, middle, area.width, "no voice is heard", DIM);
        return;
    };
    let rows = usize::from(area.height) * 4;
    let mut dots = Dots::new(area);
    let time = |column: usize| editor.window.time_of(column as f64 / 2.0, area.width);
    let mut before: Option<usize> = None;
    for column in 0..usize::from(area.width) * 2 {
        let row = tone
            .between(time(column), time(column + 1))
            .map(|share| ((1.0 - share) * (rows as f64 - 1.0)).round() as usize);
        if let Some(row) = row {
            dots.set(column, row);
            // A steep glide is joined up; a leap is two voices, or an error, and is not.
            if let Some(before) = before.filter(|b| b.abs_diff(row) <= rows / LEAP) {
                for between in before.min(row) + 1..before.max(row) {
                    dots.set(column, between);
                }
            }
        }
        before = row;
    }
    dots.put(buffer, Style::new());
    // What the height stands for, at the right edge.
    for (hertz, y) in [(high, area.y), (low, area.bottom() - 1)] {
        let text = format!("{hertz:.0}Hz");
        put(buffer, area.right(), y, cells(&text), &text, DIM);
    }
}

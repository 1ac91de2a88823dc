//! The phones inside the syllables, where they are wide enough to be read.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Modifier;

use crate::project::Clip;
use crate::studio::screens::timeline::editor::Editor;
use crate::studio::widgets::text::{DIM, cells, put};

pub(super) fn phones(buffer: &mut Buffer, row: Rect, editor: &Editor, clip: &Clip) {
    let Some(tier) = clip.timing.tier("phones") else { return };
    let (window, columns) = (editor.window, row.width);
    for (index, phone) in tier.intervals.iter().enumerate() {
        let (start, end) = (window.column(phone.start, columns), window.column(phone.end, columns));
        if end < 0 || start >= i32::from(columns) {
            continue;
        }
        let first = row.x + start.max(0) as u16;
        let room = (row.x + end.clamp(0, i32::from(columns)) as u16).saturating_sub(first);
        let wide = cells(&phone.label);
        // Where names would touch, every second one is underlined.
        let line = if index % 2 == 1 { Modifier::UNDERLINED } else { Modifier::empty() };
        if start >= 0 && wide < room {
            let used = put(buffer, first, row.y, 1, "╵", DIM);
            put(buffer, first + used, row.y, room - used, &phone.label, ratatui::style::Style::new());
        } else if wide <= room {
            put(buffer, first, row.y, room, &phone.label, ratatui::style::Style::new().add_modifier(line));
        } else if start >= 0 {
            put(buffer, first, row.y, 1, "╵", DIM);
        }
    }
}

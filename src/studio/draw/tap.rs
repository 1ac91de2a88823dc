//! What tapping asks for, in the place of the ratios, and what was tapped, on the ruler.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};

use super::lists::folded;
use super::{BOLD, Layout, put};
use crate::project::Clip;
use crate::studio::editor::Editor;
use crate::studio::state::State;
use crate::studio::tap_desk;
use crate::studio::tapping::Tapping;

/// The panel beside the face.
pub(super) fn panel(buffer: &mut Buffer, area: Rect, state: &State, tapping: &Tapping, clip: &Clip) {
    let mut y = area.y;
    for (index, line) in tap_desk::lines(state, tapping, clip).iter().enumerate() {
        // What there is to do now stands out.
        let style = if index == 0 { BOLD.add_modifier(Modifier::REVERSED) } else { Style::new() };
        let lines = if line.starts_with(' ') { vec![line.clone()] } else { folded(line, area.width) };
        for part in &lines {
            if y >= area.bottom() {
                return;
            }
            put(buffer, area.x, y, area.width, part, if part.trim().is_empty() { Style::new() } else { style });
            y += 1;
        }
        y += u16::from(index < 2);
    }
}

/// The taps on the ruler: starts, and ends before a pause.
pub(super) fn marks(buffer: &mut Buffer, layout: &Layout, state: &State, editor: &Editor, tapping: &Tapping) {
    for tap in &tapping.taps {
        if let Some(column) = editor.window.shown_column(tap.at, layout.columns()) {
            let sign = if tap.is_end { "╴" } else { "▾" };
            let style = state.colours.accent().add_modifier(Modifier::BOLD);
            put(buffer, layout.ruler.x + column, layout.ruler.y, 1, sign, style);
        }
    }
}

//! Lines to read in a box.

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::style::Style;

use super::help::scrolled;
use crate::studio::app::action::Action;
use crate::studio::app::keys::Place;
use crate::studio::app::stack::{Context, Flow, Screen, View};
use crate::studio::widgets::boxed::boxed;
use crate::studio::widgets::text::{folded, put_short};

/// Lines to read, folded where the terminal is too narrow.
#[derive(Debug)]
pub(crate) struct NotesScreen {
    title: String,
    lines: Vec<String>,
    /// Lines scrolled.
    scrolled: usize,
}

impl NotesScreen {
    /// Lines under a title.
    #[must_use]
    pub(crate) const fn new(title: String, lines: Vec<String>) -> Self {
        Self { title, lines, scrolled: 0 }
    }
}

impl Screen for NotesScreen {
    fn place(&self) -> Place {
        Place::Help
    }

    fn handle(&mut self, action: Action, cx: &mut Context<'_>) -> Flow {
        match action {
            Action::Scroll(by) => self.scrolled = scrolled(self.scrolled, by),
            Action::Close => cx.close(),
            _ => return Flow::Passed,
        }
        Flow::Taken
    }

    fn draw(&self, view: &mut View<'_>) -> Option<Position> {
        notes(view.buffer, view.area, &self.title, &self.lines, self.scrolled);
        None
    }
}

/// Lines to read, a mark before each.
fn notes(buffer: &mut Buffer, area: Rect, title: &str, lines: &[String], scrolled: usize) {
    const WIDEST: u16 = 100;
    let width = area.width.saturating_sub(8).min(WIDEST);
    let mut rows: Vec<String> = Vec::new();
    for line in lines.iter().flat_map(|text| text.lines().take(1).chain(text.lines().skip(1))) {
        let folded = folded(line.trim(), width.saturating_sub(2));
        rows.extend(
            folded.into_iter().enumerate().map(|(n, row)| format!("{}{row}", if n == 0 { "· " } else { "  " })),
        );
    }
    let height = (rows.len() as u16).min(area.height.saturating_sub(4));
    let first = scrolled.min(rows.len().saturating_sub(usize::from(height)));
    let more = rows.len() > usize::from(height);
    let title = if more { format!("{title}: ↑ ↓ for more, Esc closes") } else { format!("{title}: Esc closes") };
    let inside = boxed(buffer, area, width, height, &title);
    for (row, y) in rows[first..].iter().zip(inside.y..inside.bottom()) {
        put_short(buffer, inside.x, y, inside.width, row, Style::new());
    }
}

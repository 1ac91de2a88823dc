//! A line being typed.

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};

use crate::studio::app::action::Action;
use crate::studio::app::keys::Place;
use crate::studio::app::stack::{Context, Effect, Flow, Screen, View};
use crate::studio::widgets::boxed::{boxed, boxed_at};
use crate::studio::widgets::line::Line;
use crate::studio::widgets::prompt::{Prompt, Purpose};
use crate::studio::widgets::text::{BOLD, CHOSEN, DIM, cells, folded, put};

/// A line being typed. What is accepted goes to the page below.
#[derive(Debug)]
pub(crate) struct TypingScreen {
    /// The line and what it is for.
    pub prompt: Prompt,
}

impl TypingScreen {
    /// A line that proposes a text.
    #[must_use]
    pub(crate) fn new(
        purpose: Purpose,
        title: String,
        help: impl Into<std::borrow::Cow<'static, str>>,
        text: String,
    ) -> Self {
        Self { prompt: Prompt { purpose, title, help: help.into(), line: Line::new(text), fault: None } }
    }
}

impl Screen for TypingScreen {
    fn place(&self) -> Place {
        Place::Prompt
    }

    fn handle(&mut self, action: Action, cx: &mut Context<'_>) -> Flow {
        let line = &mut self.prompt.line;
        match action {
            Action::Accept => cx.ask(Effect::Accept),
            Action::Close => cx.close(),
            Action::Type(letter) => line.put(letter.encode_utf8(&mut [0; 4])),
            Action::Rub => line.rub(),
            Action::RubAhead => line.rub_ahead(),
            Action::RubLine => line.rub_line(),
            Action::Caret(by) => line.move_caret(by),
            _ => return Flow::Passed,
        }
        Flow::Taken
    }

    fn paste(&mut self, text: &str) {
        self.prompt.line.put(text);
    }

    fn draw(&self, view: &mut View<'_>) -> Option<Position> {
        Some(prompt(view, &self.prompt))
    }
}

/// The box of a prompt and the text below its line. Beside the face where that has room, so that what is being changed
/// stays in sight.
fn prompt_box(buffer: &mut Buffer, area: Rect, panel: Option<Rect>, title: &str, below: &str) -> (Vec<String>, Rect) {
    const WIDEST: u16 = 70;
    if let Some(panel) = panel {
        let width = panel.width.min(WIDEST + 4);
        let lines = folded(below, width.saturating_sub(4));
        let height = 4 + lines.len() as u16;
        if height <= panel.height && cells(title) + 4 <= width {
            let inside = boxed_at(buffer, Rect { width, height, ..panel }, title);
            return (lines, inside);
        }
    }
    let width = area.width.saturating_sub(8).min(WIDEST);
    let lines = folded(below, width);
    let inside = boxed(buffer, area, width, 2 + lines.len() as u16, title);
    (lines, inside)
}

/// A line to type; where its caret stands.
fn prompt(view: &mut View<'_>, prompt: &Prompt) -> Position {
    let (area, panel, colours) = (view.area, view.panel, view.shell.colours);
    let buffer = &mut *view.buffer;
    let below = prompt.fault.as_deref().unwrap_or(&prompt.help);
    let (lines, inside) = prompt_box(buffer, area, panel, &prompt.title, below);
    // Of a long line the part before the caret is shown.
    let room = inside.width.saturating_sub(3);
    let mut start = 0;
    let before = prompt.line.before_caret();
    while cells(&before[start..]) > room {
        start += before[start..].chars().next().map_or(1, char::len_utf8);
    }
    let typed = if prompt.line.is_proposed() { CHOSEN } else { BOLD };
    put(buffer, inside.x, inside.y, 2, "> ", DIM);
    put(buffer, inside.x + 2, inside.y, inside.width - 2, &prompt.line.text()[start..], typed);
    let style = if prompt.fault.is_some() { colours.fault() } else { DIM };
    for (line, y) in lines.iter().zip(inside.y + 2..inside.bottom()) {
        put(buffer, inside.x, y, inside.width, line, style);
    }
    Position::new(inside.x + 2 + cells(&before[start..]), inside.y)
}

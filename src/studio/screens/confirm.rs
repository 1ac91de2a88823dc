//! The question about unsaved changes.

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::style::Style;

use crate::studio::app::action::Action;
use crate::studio::app::keys::Place;
use crate::studio::app::project::SharedProject;
use crate::studio::app::stack::{Context, Effect, Flow, Screen, View};
use crate::studio::widgets::boxed::boxed;
use crate::studio::widgets::text::{BOLD, put};

/// Leave with unsaved changes? What was asked for is done after the answer.
pub(crate) struct ConfirmScreen {
    project: SharedProject,
    by: Action,
}

impl ConfirmScreen {
    /// The question before leaving by `Quit` or `Back`.
    #[must_use]
    pub(crate) const fn new(project: SharedProject, by: Action) -> Self {
        Self { project, by }
    }
}

impl Screen for ConfirmScreen {
    fn place(&self) -> Place {
        Place::Confirm
    }

    fn handle(&mut self, action: Action, cx: &mut Context<'_>) -> Flow {
        match action {
            Action::SaveAndGo => {
                // What went wrong stays on the screen, and so do the changes.
                match self.project.borrow_mut().is_saved(cx.shell) {
                    true => cx.ask(Effect::Go(self.by)),
                    false => cx.close(),
                }
            }
            Action::DropAndGo => match self.project.borrow_mut().lesson.discard() {
                Ok(()) => cx.ask(Effect::Go(self.by)),
                Err(fault) => {
                    cx.shell.say_fault(&fault);
                    cx.ask(Effect::Go(Action::Back));
                }
            },
            Action::KeepAndGo => cx.ask(Effect::Go(self.by)),
            Action::Close => cx.close(),
            _ => return Flow::Passed,
        }
        Flow::Taken
    }

    fn draw(&self, view: &mut View<'_>) -> Option<Position> {
        confirm(view.buffer, view.area);
        None
    }
}

fn confirm(buffer: &mut Buffer, area: Rect) {
    let rows = [
        ("s", "save them, then go"),
        ("d", "discard them, then go"),
        ("k", "keep them for the next time, and go"),
        ("Esc", "stay here"),
    ];
    let inside = boxed(buffer, area, 44, rows.len() as u16, "There are unsaved changes");
    for ((key, text), y) in rows.into_iter().zip(inside.y..inside.bottom()) {
        put(buffer, inside.x, y, 4, key, BOLD);
        put(buffer, inside.x + 5, y, inside.width.saturating_sub(5), text, Style::new());
    }
}

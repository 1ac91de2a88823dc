//! The keys of a place.

use ratatui::layout::Position;

use crate::studio::app::action::Action;
use crate::studio::app::keys::Place;
use crate::studio::app::stack::{Context, Flow, Screen, View};
use crate::studio::widgets::boxed;

/// The list of all keys of a place.
#[derive(Debug)]
pub(crate) struct HelpScreen {
    of: Place,
    /// Lines scrolled.
    scrolled: usize,
}

impl HelpScreen {
    /// The keys of a place.
    #[must_use]
    pub(crate) const fn new(of: Place) -> Self {
        Self { of, scrolled: 0 }
    }
}

/// Lines scrolled after a step; the drawing stops at the end.
pub(super) fn scrolled(now: usize, by: i32) -> usize {
    (now as i32 + by).clamp(0, 100) as usize
}

impl Screen for HelpScreen {
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
        boxed::help(view.buffer, view.area, self.of, self.scrolled);
        None
    }
}

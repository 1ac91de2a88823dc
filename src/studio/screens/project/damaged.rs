//! A project that does not open, and why.

use ratatui::layout::Position;

use super::draw;
use crate::disk::Fault;
use crate::project::Finding;
use crate::studio::app::action::Action;
use crate::studio::app::keys::Place;
use crate::studio::app::stack::{Context, Effect, Flow, Screen, View};

/// A project that does not open.
#[derive(Debug)]
pub(crate) struct DamagedScreen {
    /// The folder's name.
    pub name: String,
    /// Why it does not open.
    pub fault: Fault,
    /// What a check found.
    pub findings: Vec<Finding>,
}

impl Screen for DamagedScreen {
    fn place(&self) -> Place {
        Place::Lesson
    }

    fn is_page(&self) -> bool {
        true
    }

    fn handle(&mut self, action: Action, cx: &mut Context<'_>) -> Flow {
        match action {
            Action::Back => cx.ask(Effect::Leave(Action::Back)),
            // The other keys of the place are for a project that is open.
            _ => return Flow::Passed,
        }
        Flow::Taken
    }

    fn draw(&self, view: &mut View<'_>) -> Option<Position> {
        draw::damaged(view, &self.name, &self.fault, &self.findings);
        None
    }
}

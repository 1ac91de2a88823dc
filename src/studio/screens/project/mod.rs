//! An open project: its clips and what a check found.

pub(in crate::studio) mod checking;
pub(in crate::studio) mod damaged;
mod draw;

use std::rc::Rc;

use ratatui::layout::Position;

use super::{exporting, face, timeline};
use crate::studio::app::action::Action;
use crate::studio::app::keys::Place;
use crate::studio::app::project::SharedProject;
use crate::studio::app::stack::{Context, Effect, Flow, Screen, View};
use crate::studio::widgets::prompt::{Prompt, Purpose};

/// An open project with one of its clips chosen.
pub(crate) struct ProjectScreen {
    project: SharedProject,
    chosen: usize,
}

impl ProjectScreen {
    /// A project that was just opened.
    #[must_use]
    pub(crate) const fn new(project: SharedProject) -> Self {
        Self { project, chosen: 0 }
    }
}

impl Screen for ProjectScreen {
    fn place(&self) -> Place {
        Place::Lesson
    }

    fn is_page(&self) -> bool {
        true
    }

    fn project(&self) -> Option<&SharedProject> {
        Some(&self.project)
    }

    fn handle(&mut self, action: Action, cx: &mut Context<'_>) -> Flow {
        let shared = Rc::clone(&self.project);
        let project = &mut *shared.borrow_mut();
        match action {
            Action::Choose(by) => {
                let last = project.lesson.clips.len().saturating_sub(1) as i32;
                self.chosen = (self.chosen as i32 + by).clamp(0, last) as usize;
            }
            Action::Open => timeline::opening::open(&self.project, project, self.chosen, cx),
            Action::Face => face::open(&self.project, project, self.chosen, cx),
            Action::Save => checking::save(project, cx),
            Action::Export => exporting::ask(&project.lesson.manifest.title, cx),
            Action::Align if self.chosen < project.lesson.clips.len() => {
                timeline::aligning::start(project, self.chosen, true, cx);
            }
            Action::Follow if self.chosen < project.lesson.clips.len() => {
                timeline::following::ask(project, self.chosen, cx);
            }
            Action::Back => cx.ask(Effect::Leave(Action::Back)),
            _ => return Flow::Passed,
        }
        Flow::Taken
    }

    fn accept(&mut self, prompt: &Prompt, cx: &mut Context<'_>) -> Result<(), String> {
        match prompt.purpose {
            Purpose::Export => exporting::start(&mut self.project.borrow_mut(), None, prompt.line.text(), cx),
            _ => Ok(()),
        }
    }

    fn draw(&self, view: &mut View<'_>) -> Option<Position> {
        draw::project(view, &self.project.borrow(), self.chosen);
        None
    }
}

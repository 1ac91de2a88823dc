//! The list of the projects in a folder.

mod draw;
pub(in crate::studio) mod listed;
mod opening;

use std::path::PathBuf;

use ratatui::layout::Position;

use self::listed::Listed;
use self::opening::OpenJob;
use crate::disk::Result;
use crate::project::projects_in;
use crate::studio::app::action::Action;
use crate::studio::app::keys::Place;
use crate::studio::app::stack::{Context, Flow, Screen, View};

/// The projects of a folder, or the one it is.
#[derive(Debug)]
pub(crate) struct ProjectsScreen {
    /// The folder that was opened.
    pub folder: PathBuf,
    /// The projects in it.
    pub projects: Vec<Listed>,
    /// The number of the chosen one.
    chosen: usize,
}

impl ProjectsScreen {
    /// The projects of a folder.
    ///
    /// # Errors
    /// When the folder cannot be listed.
    pub(crate) fn new(folder: PathBuf) -> Result<Self> {
        let projects = projects_in(&folder)?.into_iter().map(Listed::of).collect();
        Ok(Self { folder, projects, chosen: 0 })
    }

    fn open(&self, cx: &mut Context<'_>) {
        let Some(listed) = self.projects.get(self.chosen) else { return };
        cx.shell.busy = Some(format!("opening {}…", listed.name));
        cx.start(OpenJob { root: listed.root.clone() });
    }
}

impl Screen for ProjectsScreen {
    fn place(&self) -> Place {
        Place::Projects
    }

    fn is_page(&self) -> bool {
        true
    }

    fn handle(&mut self, action: Action, cx: &mut Context<'_>) -> Flow {
        match action {
            Action::Quit => return Flow::Passed,
            // While a project opens, other keys would go to a screen that is about to change.
            _ if cx.shell.busy.is_some() => {}
            Action::Choose(by) => {
                let last = self.projects.len().saturating_sub(1) as i32;
                self.chosen = (self.chosen as i32 + by).clamp(0, last) as usize;
            }
            Action::Open => self.open(cx),
            _ => return Flow::Passed,
        }
        Flow::Taken
    }

    fn draw(&self, view: &mut View<'_>) -> Option<Position> {
        draw::projects(view, &self.folder, &self.projects, self.chosen);
        None
    }
}

//! Saving a project, and checking its files after they were written.

use std::path::PathBuf;

use crate::disk::Result;
use crate::project::{Finding, check};
use crate::studio::app::project::OpenProject;
use crate::studio::app::stack::{Context, Job, Reporter, Stack};

/// Saves the project; where files were written they are checked in a thread.
pub(in crate::studio) fn save(project: &mut OpenProject, cx: &mut Context<'_>) {
    if project.save(cx.shell) {
        cx.start(CheckJob { root: project.lesson.root.clone() });
    }
}

/// Checks a project's files.
pub(in crate::studio) struct CheckJob {
    /// The project's folder.
    pub root: PathBuf,
}

impl Job for CheckJob {
    type Made = Vec<Finding>;
    const BROKEN: [&'static str; 2] = ["the lesson cannot be checked", "please report what `lianpu check` says"];

    fn run(&mut self, _: &Reporter) -> Result<Vec<Finding>> {
        Ok(check(&self.root))
    }

    fn done(self, made: Result<Vec<Finding>>, stack: &mut Stack) {
        if let Some(project) = stack.project(&self.root) {
            project.borrow_mut().findings = made.unwrap_or_default();
        }
    }
}

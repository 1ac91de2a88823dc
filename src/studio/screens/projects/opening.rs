//! Opening a project in a thread, with a check of its files.

use std::cell::RefCell;
use std::path::PathBuf;
use std::rc::Rc;

use crate::disk::Result;
use crate::project::{Finding, Lesson, check};
use crate::studio::app::project::OpenProject;
use crate::studio::app::stack::{Context, Job, Reporter, Stack};
use crate::studio::app::wording;
use crate::studio::screens::project::ProjectScreen;
use crate::studio::screens::project::damaged::DamagedScreen;

/// Opens a project and checks it.
pub(super) struct OpenJob {
    /// The project's folder.
    pub root: PathBuf,
}

impl Job for OpenJob {
    type Made = (Result<Lesson>, Vec<Finding>);
    const BROKEN: [&'static str; 2] = ["the lesson cannot be opened", "please report what `lianpu check` says"];

    fn run(&mut self, _: &Reporter) -> Result<Self::Made> {
        let lesson = Lesson::open(&self.root);
        let notes: Vec<Finding> = lesson.iter().flat_map(|l| l.notes.iter().cloned().map(Finding::Odd)).collect();
        Ok((lesson, notes.into_iter().chain(check(&self.root)).collect()))
    }

    fn done(self, made: Result<Self::Made>, stack: &mut Stack) {
        let (lesson, findings) = made.unwrap_or_else(|fault| (Err(fault), Vec::new()));
        let mut cx = stack.context();
        cx.shell.busy = None;
        match lesson {
            Ok(lesson) => {
                say_state(&lesson, &mut cx);
                cx.push(ProjectScreen::new(Rc::new(RefCell::new(OpenProject::new(lesson, findings)))));
            }
            Err(fault) => {
                let name = self.root.file_name().map_or_else(|| "lesson".into(), |n| n.to_string_lossy().into_owned());
                cx.push(DamagedScreen { name, fault, findings });
            }
        }
    }
}

/// What became of an earlier save and of unsaved changes.
fn say_state(lesson: &Lesson, cx: &mut Context<'_>) {
    if let Some(note) = lesson.notes.first() {
        cx.shell.say(wording::worded(note));
    }
    if lesson.recovered > 0 {
        let many = if lesson.recovered == 1 { "change" } else { "changes" };
        cx.shell.say(format!("brought back {} unsaved {many} from last time", lesson.recovered));
    }
    if lesson.lost > 0 {
        cx.shell.refuse(format!(
            "{} unsaved changes fit the files no more: brought back {}, all are kept in .lianpu/journal.lost",
            lesson.lost, lesson.recovered
        ));
    }
}

//! `lianpu [FOLDER]`: the studio.

use std::io::IsTerminal;
use std::path::Path;

use crate::disk::{Fault, Result, Setting, Task, message};
use crate::project::projects_in;
use crate::studio;

/// Whether there is somebody to open it for.
pub(crate) fn is_possible() -> bool {
    std::io::stdin().is_terminal() && std::io::stdout().is_terminal()
}

/// Opens the studio on a folder of projects, or on one; `projects`, or what is here, where none is named.
pub(crate) fn open(folder: Option<&Path>) -> Result<()> {
    let usual = [Path::new("projects"), Path::new(".")];
    let has_lessons = |f: &&Path| projects_in(f).is_ok_and(|found| !found.is_empty());
    match folder.or_else(|| usual.into_iter().find(has_lessons)) {
        Some(folder) => studio::run(folder, Box::new(studio::export)),
        None => Err(Fault::new("there are no lessons here yet")
            .help(message!["make one: ", Task::New.with(Setting::Speech, "a.wav").with(Setting::Script, "a.txt")])),
    }
}

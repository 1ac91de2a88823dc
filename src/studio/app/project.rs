//! An open project, as all screens above its page share it.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use ratatui::style::{Modifier, Style};

use super::action::Action;
use super::colours::Colours;
use super::heard::Listened;
use super::shell::Shell;
use crate::project::{Change, Finding, Lesson};
use crate::studio::screens::timeline::editor::Left;
use crate::studio::widgets::text::DIM;

/// An open project that several screens hold. A screen borrows it while it handles one action or draws once.
pub type SharedProject = Rc<RefCell<OpenProject>>;

/// An open project, what a check found of it, and the work on it that is under way.
#[derive(Debug)]
pub struct OpenProject {
    /// The project.
    pub lesson: Lesson,
    /// What is there, missing or wrong.
    pub findings: Vec<Finding>,
    /// Where the author was on the clips that she has left, by their numbers.
    pub left: BTreeMap<usize, Left>,
    /// The clips whose times were looked for: what was taken back is not done again unasked.
    pub aligned: BTreeSet<usize>,
    /// The clips whose video was tracked: what was taken back is not done again unasked.
    pub followed: BTreeSet<usize>,
    /// What was heard of the clips so far, by their numbers.
    pub heard: BTreeMap<usize, Listened>,
    /// What the last search found odd of a clip as a whole.
    pub notes: BTreeMap<usize, Vec<String>>,
    /// The tracking that is under way.
    pub following: Option<Following>,
    /// Whether it was asked if somebody else's ratios may be replaced.
    pub replace_asked: bool,
    /// Counts the changes, so that screens see that what they show is old.
    pub revision: u64,
    /// Counts the changes of faces.
    pub faces_revision: u64,
}

/// A tracking that is under way.
#[derive(Debug)]
pub struct Following {
    /// Frames done, and of how many where that is known.
    pub done: (usize, Option<usize>),
    /// Set to stop it.
    pub stop: Arc<AtomicBool>,
}

impl Following {
    /// How far it is, in a few letters.
    #[must_use]
    pub(crate) fn told(&self) -> String {
        match self.done {
            (_, Some(0)) | (0, _) => "following the face…".into(),
            (done, Some(of)) => format!("following the face {} %…", 100 * done / of),
            (done, None) => format!("following the face, frame {done}…"),
        }
    }
}

impl OpenProject {
    /// A project that was just opened.
    #[must_use]
    pub(crate) fn new(lesson: Lesson, findings: Vec<Finding>) -> Self {
        Self {
            lesson,
            findings,
            left: BTreeMap::new(),
            aligned: BTreeSet::new(),
            followed: BTreeSet::new(),
            heard: BTreeMap::new(),
            notes: BTreeMap::new(),
            following: None,
            replace_asked: false,
            revision: 0,
            faces_revision: 0,
        }
    }

    /// How often it and its faces were changed.
    #[must_use]
    pub(crate) const fn counts(&self) -> (u64, u64) {
        (self.revision, self.faces_revision)
    }

    /// How it stands, for the line at the top.
    #[must_use]
    pub(crate) fn standing(&self, colours: Colours) -> (&'static str, Style) {
        match (&self.lesson.read_only, self.lesson.is_unsaved()) {
            (Some(_), _) => ("read-only", colours.warning()),
            (None, true) => ("● unsaved: s saves", colours.warning().add_modifier(Modifier::BOLD)),
            (None, false) => ("saved", DIM),
        }
    }

    /// Makes a change and says so; whether it could be made.
    pub(crate) fn change(&mut self, change: Change, shell: &mut Shell) -> bool {
        let label = change.label.clone();
        match self.lesson.change(change) {
            Ok(()) => {
                self.revision += 1;
                shell.say(label);
                true
            }
            Err(fault) => {
                shell.say_fault(&fault);
                false
            }
        }
    }

    /// Undoes or makes again.
    pub(crate) fn retrace(&mut self, action: Action, shell: &mut Shell) {
        let (done, word) = match action {
            Action::Redo => (self.lesson.redo(), "again"),
            _ => (self.lesson.undo(), "undone"),
        };
        match done {
            Ok(Some(label)) => {
                self.revision += 1;
                self.faces_revision += 1;
                shell.say(format!("{word}: {label}"));
            }
            Ok(None) if action == Action::Redo => shell.say("nothing to make again"),
            Ok(None) => shell.say("nothing to undo"),
            Err(fault) => shell.say_fault(&fault),
        }
    }

    /// Writes the project's files and says which; whether any of them changed.
    pub(crate) fn save(&mut self, shell: &mut Shell) -> bool {
        let done = self.lesson.save();
        let any = done.as_ref().is_ok_and(|written| !written.is_empty());
        match done {
            Ok(_) if !any => shell.say("saved: nothing had changed"),
            Ok(written) => {
                let names: Vec<String> =
                    written.iter().filter_map(|p| p.file_name()).map(|n| n.to_string_lossy().into_owned()).collect();
                shell.say(format!("saved {}", names.join(", ")));
            }
            Err(fault) => shell.say_fault(&fault),
        }
        any
    }

    /// Whether everything is in the files, after a save where it was not.
    pub(crate) fn is_saved(&mut self, shell: &mut Shell) -> bool {
        if self.lesson.is_unsaved() {
            self.save(shell);
        }
        !self.lesson.is_unsaved()
    }

    /// Whether it can be changed; says why not.
    pub(crate) fn may_change(&self, shell: &mut Shell) -> bool {
        if let Some(why) = &self.lesson.read_only {
            shell.refuse(format!("the lesson cannot be changed: {why}"));
        }
        self.lesson.read_only.is_none()
    }
}

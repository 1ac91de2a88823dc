//! What an action on a clip works on.

use super::editor::Editor;
use crate::project::{Change, Clip};
use crate::studio::app::project::OpenProject;
use crate::studio::app::stack::Context;
use crate::studio::screens::typing::TypingScreen;
use crate::studio::widgets::prompt::Purpose;

/// A clip that is being edited: its project, its editor, and what a screen may ask for.
pub(in crate::studio) struct ClipDesk<'a, 'b> {
    /// The project.
    pub project: &'a mut OpenProject,
    /// The clip's editor.
    pub editor: &'a mut Editor,
    /// What a screen may ask for.
    pub cx: &'a mut Context<'b>,
}

impl ClipDesk<'_, '_> {
    /// The clip.
    pub(crate) fn clip(&self) -> &Clip {
        &self.project.lesson.clips[self.editor.clip]
    }

    /// Makes a change and shows it; whether it could be made. What cannot be done is said.
    pub(crate) fn change(&mut self, change: Change) -> bool {
        let made = self.project.change(change, self.cx.shell);
        if made {
            self.editor.sync(&self.project.lesson, self.project.counts());
        }
        made
    }

    /// Puts the cursor on an instant.
    pub(crate) fn go(&mut self, time: f64) {
        self.editor.go(&self.project.lesson.clips[self.editor.clip], time);
    }

    /// Says something.
    pub(crate) fn say(&mut self, text: impl Into<String>) {
        self.cx.shell.say(text);
    }

    /// Says that something could not be done, and what to do.
    pub(crate) fn refuse(&mut self, text: impl Into<String>) {
        self.cx.shell.refuse(text);
    }

    /// Asks for a line to be typed that changes the clip, where it can be changed.
    pub(crate) fn prompt(&mut self, purpose: Purpose, title: String, help: &'static str, text: String) {
        if self.project.may_change(self.cx.shell) {
            self.cx.push(TypingScreen::new(purpose, title, help, text));
        }
    }
}

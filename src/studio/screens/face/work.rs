//! What an action on the page of a face works on.

use super::desk::FaceDesk;
use crate::face::FeaturePoint;
use crate::project::{Change, LessonFace};
use crate::studio::app::project::OpenProject;
use crate::studio::app::stack::Context;

/// A face that is being edited: its project, what is shown of it, and what a screen may ask for.
pub(super) struct FaceWork<'a, 'b> {
    /// The project.
    pub project: &'a mut OpenProject,
    /// What is shown of the face.
    pub desk: &'a mut FaceDesk,
    /// What a screen may ask for.
    pub cx: &'a mut Context<'b>,
}

impl FaceWork<'_, '_> {
    /// The face.
    pub(crate) fn face(&self) -> &LessonFace {
        &self.project.lesson.faces[self.desk.face]
    }

    /// Says something.
    pub(crate) fn say(&mut self, text: impl Into<String>) {
        self.cx.shell.say(text);
    }

    /// Says that something could not be done, and what to do.
    pub(crate) fn refuse(&mut self, text: impl Into<String>) {
        self.cx.shell.refuse(text);
    }

    /// Whether the project can be changed; says why not.
    pub(crate) fn may_change(&mut self) -> bool {
        if self.cx.shell.busy.is_some() {
            self.refuse("the face is still being looked for");
            return false;
        }
        self.project.may_change(self.cx.shell)
    }

    /// Makes a change and shows it; whether it could be made.
    pub(crate) fn change(&mut self, change: Change) -> bool {
        let made = self.project.change(change, self.cx.shell);
        if made {
            self.project.faces_revision += 1;
            self.show();
        }
        made
    }

    /// Draws the face as the project has it now.
    pub(crate) fn show(&mut self) {
        let lesson = &self.project.lesson;
        let face = &lesson.faces[self.desk.face];
        self.desk.figure = face.face.is_some().then(|| lesson.cartoon_of(face).ok()).flatten();
        self.desk.choose_known(face);
        self.desk.is_stale = face.is_stale();
        self.desk.shown = self.project.faces_revision;
    }
}

impl FaceDesk {
    /// Chooses another point where the shot has not the one that is chosen.
    pub(crate) fn choose_known(&mut self, face: &LessonFace) {
        let points = self.points(face);
        if !points.is_empty() && points.iter().all(|p| p.0 != self.point) {
            self.point = FeaturePoint::P3_6;
        }
    }
}

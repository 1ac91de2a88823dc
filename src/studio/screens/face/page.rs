//! The state of the page of a face.

use std::path::Path;

use super::desk::FaceDesk;
use super::work::FaceWork;
use crate::studio::app::project::SharedProject;
use crate::studio::app::stack::Context;
use crate::studio::widgets::picture::FacePicture;

/// The page of a face.
pub struct FaceScreen {
    pub(super) project: SharedProject,
    /// What is shown of the face.
    pub desk: FaceDesk,
    pub(super) cartoon: FacePicture,
    /// The stage of the search that is shown.
    pub(super) stage: FacePicture,
}

impl FaceScreen {
    /// Lets an action work on the face.
    pub(super) fn with<T>(&mut self, cx: &mut Context<'_>, work: impl FnOnce(&mut FaceWork<'_, '_>) -> T) -> T {
        let project = &mut *self.project.borrow_mut();
        work(&mut FaceWork { project, desk: &mut self.desk, cx })
    }

    /// The same for what a thread has made, where the page still shows that face of that project.
    pub(super) fn work_on(
        &mut self,
        root: &Path,
        face: usize,
        cx: &mut Context<'_>,
        work: impl FnOnce(&mut FaceWork<'_, '_>),
    ) {
        if self.desk.face == face && self.project.borrow().lesson.root == root {
            self.with(cx, work);
        }
    }
}

//! The kinds of fault of a project.

use crate::disk::{Fault, FaultKind};

/// The kind of a fault of this room, as [`Fault::kind`] gives it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ProjectFault {
    /// The folder holds no project.
    NoProject,
    /// The project has no such clip.
    NoSuchClip,
    /// The project has no such face.
    NoSuchFace,
    /// The name of a new project is taken.
    Taken,
    /// What is asked for a new project does not go together.
    Request,
    /// What an analysis needs is not there: a recording, a script, a video, the points of a face.
    Incomplete,
    /// The project cannot be written, or another program has it open.
    ReadOnly,
    /// It has changes of an earlier session that were never saved.
    Unsaved,
    /// Its files were changed or moved by something else while it was open.
    Changed,
    /// Another program saves it again and again.
    Busy,
    /// The edit does not suit what is there.
    Edit,
}

impl FaultKind for ProjectFault {}

/// The fault of a change that was made to other files than those that are there.
pub(super) fn stale() -> Fault {
    Fault::of(ProjectFault::Changed, "the change does not fit the lesson as it is now")
        .help("the files were changed by other means")
}

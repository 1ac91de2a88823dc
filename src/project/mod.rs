//! A lesson: its folder on disk, what is in it, and every change to it as an invertible edit.
//!
//! It owns the files of a project and what they mean together; how a face is drawn or a frame written is not its
//! business. Loading changes nothing on disk but a save that was cut off, which it finishes.

mod count;
mod edit;
mod fault;
mod files;
mod findings;
mod jobs;

pub use count::counted;
pub use edit::{Change, ClipEdit, Edit, FaceEdit, Footage, History, Lesson, Said, Spot, Times, Unsaved, projects_in};
pub use fault::ProjectFault;
pub(crate) use files::check_output;
pub use files::{
    Clip, ClipEntry, FaceEntry, FaceShot, LayerEntry, LessonFace, MANIFEST, Manifest, Output, read_script,
};
pub use findings::{Concern, Doubt, Finding, check, check_quality};
pub use jobs::{
    AlignJob, AlignReport, Followed, Made, Method, NewLesson, TrackEvent, TrackJob, TrackRequest, Tracking, create,
    prepare, tiers_of,
};

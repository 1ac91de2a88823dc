//! A lesson: its folder on disk, what is in it, and every change to it as an invertible edit.
//!
//! It owns the files of a project and what they mean together; how a face is drawn or a frame written is not its
//! business. Loading changes nothing on disk but a save that was cut off, which it finishes.

mod align;
mod brought;
mod change;
mod check;
mod clip;
mod create;
mod doubts;
mod face;
mod fault;
mod figures;
mod footage;
mod history;
mod journal;
mod label;
mod lesson;
mod manifest;
mod open;
mod prepare;
mod said;
mod quality;
mod save;
mod settled;
mod shots;
mod times;
mod tracking;
mod video;
mod work;

pub use align::{AlignJob, tiers_of};
pub use change::{Change, Edit, Spot, Times};
pub(crate) use check::counted;
pub use check::{Finding, check, check_quality};
pub use clip::{Clip, LABEL_LIMIT, read_script};
pub use create::{Made, NewLesson, create};
pub use doubts::{Concern, Doubt};
pub use face::LessonFace;
pub use fault::ProjectFault;
pub use footage::Footage;
pub use history::History;
pub use lesson::{Lesson, projects_in};
pub(crate) use manifest::check_output;
pub use manifest::{ClipEntry, FaceEntry, LayerEntry, MANIFEST, Manifest, Output};
pub use prepare::{Tracking, prepare};
pub use said::Said;
pub use shots::FaceShot;
pub use tracking::{Followed, Method, TrackJob};
pub use work::{AlignReport, TrackEvent, TrackRequest};

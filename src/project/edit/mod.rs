//! A project that is worked on: opened with its lock, changed by invertible edits, noted in a journal, saved in one commit.

mod change;
mod clip;
mod face;
mod footage;
mod history;
mod journal;
mod lay_words;
mod lesson;
mod open;
mod refusal;
mod save;
mod script;
mod times;
mod tracked;
mod unsaved;

pub use change::{Change, Edit};
pub use clip::ClipEdit;
pub use face::{FaceEdit, Spot};
pub use footage::Footage;
pub use history::History;
pub use lesson::{Lesson, projects_in};
pub(super) use refusal::refusal;
pub use script::Said;
pub use times::Times;
pub use unsaved::Unsaved;

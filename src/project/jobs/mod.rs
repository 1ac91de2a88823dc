//! The work on a project that takes a while: aligning, tracking, making a new one.

mod align;
mod create;
mod prepare;
mod tracking;
mod work;

pub use align::{AlignJob, tiers_of};
pub use create::{Made, NewLesson, create};
pub use prepare::{Tracking, prepare};
pub use tracking::{Followed, Method, TrackJob};
pub use work::{AlignReport, TrackEvent, TrackRequest};

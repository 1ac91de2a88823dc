//! Lessons as files: frames, timings, and whole lessons for the web, the reader and other programs. It only reads a project, so any number of exports may run at once.
//!
//! An export can be stopped at any moment and run again: what is there and still right is not written again.

mod captions;
mod format;
mod frames;
mod parts;
mod plan;
mod poses;
mod repeats;
mod run;
mod said;
mod whole;

pub use format::Format;
pub use frames::{FrameSet, Shard};
pub use plan::{Job, Request, plan};
pub use repeats::Dedupe;
pub use run::{Progress, Report, run};
pub use whole::{Whole, Written, wholes, write_wholes};

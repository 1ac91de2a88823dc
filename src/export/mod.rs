//! Lessons as files: frames and timings. It only reads a project, so any number of exports may run at once.
//!
//! An export can be stopped at any moment and run again: what is there and still right is not written again.

mod frames;
mod plan;
mod poses;
mod repeats;
mod run;

pub use frames::{FrameSet, Shard};
pub use plan::{Format, Job, Request, plan};
pub use repeats::Dedupe;
pub use run::{Progress, Report, run};

//! Lessons as files: frames and timings. It only reads a project, so any number of exports may run at once.
//!
//! An export can be stopped at any moment and run again: what is there and still right is not written again.

pub mod apng;
mod cels;
mod divide;
mod draft;
mod farm;
mod frames;
pub mod gif;
mod manifest;
mod merge;
pub mod movie;
mod palette;
mod plan;
mod poses;
mod run;
mod stream;

pub use divide::{Share, divide, shard_of_array};
pub use farm::{Engine, Farm, MOST_TASKS};
pub use frames::{FrameSet, Shard};
pub use manifest::{Asked, Entry, Manifest};
pub use merge::{Merged, merge};
pub use plan::{Format, Job, Request, plan};
pub use run::{Progress, Report, run};
pub use stream::{Frames, Outcome, Rate, Watch};

//! Lessons as files: frames, timings, and whole lessons for the web, the reader and other programs. It only reads a project, so any number of exports may run at once.
//!
//! An export can be stopped at any moment and run again: what is there and still right is not written again.

pub mod apng;
mod asked;
mod beside;
mod captions;
mod cels;
mod course;
mod digests;
mod divide;
mod draft;
mod farm;
mod fault;
mod format;
mod frames;
pub mod gif;
mod ledger;
mod lesson;
mod manifest;
mod merge;
pub mod movie;
mod palette;
mod parts;
mod plan;
mod poses;
mod repeats;
mod run;
mod said;
mod stream;
mod whole;

pub use asked::asked;
pub use course::{CourseReport, Event, Observer, export_projects};
pub use divide::{Share, divide, shard_of_array};
pub use farm::{Engine, Farm, MOST_TASKS};
pub use fault::ExportFault;
pub use format::Format;
pub use frames::{FrameSet, Shard};
pub use ledger::Ledger;
pub use lesson::{Exported, Place, Step, export};
pub use manifest::{Asked, Entry, Manifest};
pub use merge::{Merged, merge};
pub use plan::{Job, Request, plan};
pub use repeats::Dedupe;
pub use run::{Progress, Report, run};
pub use stream::{Frames, Outcome, Rate, Watch};
pub use whole::{Whole, Written, wholes, write_wholes};

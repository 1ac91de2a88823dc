//! Lessons as files: the plan of what is asked for, the run that writes frames and forms, the ledger of what is there,
//! and exports that are divided among machines. It only reads a project, so any number of exports may run at once.
//!
//! An export can be stopped at any moment and run again: what is there and still right is not written again. How a form
//! is made is the business of `forms`.

mod aside;
mod asked;
mod beside;
mod course;
mod digests;
mod divide;
mod farm;
mod fault;
mod format;
mod frames;
mod ledger;
mod lesson;
mod manifest;
mod merge;
mod plan;
mod repeats;
mod run;
mod whole;

pub use aside::Aside;
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
pub use whole::{Whole, Written, wholes, write_wholes};

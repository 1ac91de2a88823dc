//! Exports that the studio asks for. The course of work is that of the command line: [`export_projects`].

use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::atomic::AtomicBool;

use crate::disk::Result;
use crate::export::{CourseReport, Format, Observer, Request, Shard, Step, export_projects};

/// An export to be made.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExportRequest {
    /// The project's folder.
    pub project: PathBuf,
    /// The clip; `None` for all of them.
    pub clip: Option<String>,
    /// The formats.
    pub formats: Vec<Format>,
}

/// How far an export is.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Progress {
    /// Steps done, such as frames.
    pub done: u64,
    /// Steps in all; 0 while that is not known.
    pub total: u64,
    /// The work at hand, in a few words.
    pub what: String,
}

/// Exports: reports its progress from any thread, and stops soon after the flag is set. Another one than
/// [`export`] is for tests.
pub type Exporter = Box<dyn Fn(ExportRequest, &(dyn Fn(Progress) + Sync), &AtomicBool) -> Result<CourseReport> + Send>;

/// Exports a project from its files into its `export` folder.
///
/// # Errors
/// As [`export_projects`].
pub fn export(request: ExportRequest, progress: &(dyn Fn(Progress) + Sync), stop: &AtomicBool) -> Result<CourseReport> {
    let last = Mutex::new((String::new(), u64::MAX));
    let step = |step: Step<'_>| {
        let (what, done, total) = match step {
            Step::Frames(p) => ("frames".to_owned(), p.done.into(), p.of.into()),
            Step::Whole(whole, p) => (whole.format.name().to_owned(), p.done.into(), p.of.into()),
            Step::Tracking { clip, done, of } => {
                (format!("following the face in {clip}"), done as u64, of.unwrap_or_default() as u64)
            }
        };
        // One report a percent: the screen is drawn for each.
        let percent = (100 * done).checked_div(total).unwrap_or(done / 10);
        let Ok(mut last) = last.lock() else { return };
        if last.0 != what || last.1 != percent {
            *last = (what.clone(), percent);
            drop(last);
            progress(Progress { done, total, what });
        }
    };
    let mut export = Request::new(request.formats);
    export.clip = request.clip;
    let mut observer = Observer { event: &mut |_| Ok(()), progress: &step, stop };
    export_projects(&[request.project], &export, Shard::WHOLE, &mut observer)
}

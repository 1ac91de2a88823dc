//! `lianpu [FOLDER]`: the studio, with the export that it asks for.

use std::io::IsTerminal;
use std::path::Path;
use std::sync::atomic::AtomicBool;

use crate::disk::{Fault, Result};
use crate::export::{self, Format, Request};
use crate::project::Lesson;
use crate::studio::{self, ExportRequest, Progress};

/// Whether there is somebody to open it for.
pub fn is_possible() -> bool {
    std::io::stdin().is_terminal() && std::io::stdout().is_terminal()
}

/// Opens the studio on a folder of projects, or on one.
pub fn open(folder: Option<&Path>) -> Result<()> {
    studio::run(folder.unwrap_or(Path::new("projects")), Box::new(run_export))
}

/// Exports what the studio asks for, from the files as they are.
fn run_export(request: ExportRequest, progress: &dyn Fn(Progress), stop: &AtomicBool) -> Result<String> {
    let formats: Vec<Format> = request
        .formats
        .split([',', ' '])
        .filter(|word| !word.is_empty())
        .map(|word| word.parse().map_err(Fault::new))
        .collect::<Result<_>>()?;
    if formats.is_empty() {
        return Err(Fault::new("no format was named").help("type for example: png, srt"));
    }
    let lesson = Lesson::read(&request.project)?;
    let mut asked = Request::new(formats);
    asked.clip = request.clip;
    let jobs = export::plan(&lesson, &asked)?;
    // The export's threads count; only this one may talk to the studio, which misses a step while it is busy.
    let (sender, receiver) = crossbeam_channel::bounded(64);
    let (jobs, threads) = (&jobs, asked.jobs);
    let report = std::thread::scope(|scope| {
        let worker = scope.spawn(move || {
            let tell = |p: export::Progress| {
                let _ = sender.try_send(p);
            };
            export::run(jobs, threads, &tell, stop)
        });
        for p in &receiver {
            progress(Progress { done: p.done.into(), total: p.of.into(), what: "frames".into() });
        }
        worker.join().unwrap_or_else(|_| Err(Fault::new("the export broke off")))
    })?;
    if report.stopped {
        return Ok(format!("stopped: {} files written, the rest when it is run again", report.written));
    }
    let place = lesson.root.join("export");
    Ok(format!("{} files written, {} already there, in {}", report.written, report.kept, place.display()))
}

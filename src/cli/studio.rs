//! `lianpu [FOLDER]`: the studio, with the export that it asks for.

use std::io::IsTerminal;
use std::path::Path;
use std::sync::atomic::AtomicBool;

use crate::disk::{Fault, Result};
use crate::export::{self, Format, Request};
use crate::project::{Lesson, projects_in};
use crate::studio::{self, ExportRequest, Progress};

/// Whether there is somebody to open it for.
pub fn is_possible() -> bool {
    std::io::stdin().is_terminal() && std::io::stdout().is_terminal()
}

/// Opens the studio on a folder of projects, or on one; `projects`, or what is here, where none is named.
pub fn open(folder: Option<&Path>) -> Result<()> {
    let usual = [Path::new("projects"), Path::new(".")];
    let has_lessons = |f: &&Path| projects_in(f).is_ok_and(|found| !found.is_empty());
    match folder.or_else(|| usual.into_iter().find(has_lessons)) {
        Some(folder) => studio::run(folder, Box::new(run_export)),
        None => Err(Fault::new("there are no lessons here yet")
            .help("make one: lianpu new my-lesson --speech a.wav --script a.txt")),
    }
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
    });
    let report = report.and_then(|report| {
        let all = export::wholes(&lesson, &asked)?;
        let mut tell = |number: usize, whole: &export::Whole| {
            progress(Progress { done: number as u64, total: all.len() as u64, what: whole.format.name().into() });
        };
        let made = export::write_wholes(&lesson, &asked, &all, &mut tell, stop)?;
        let mut report = report.with(&made);
        report.stopped |= made.len() < all.len();
        Ok(report)
    });
    let report = report.map_err(|fault| {
        let help = format!("elsewhere: lianpu export {} --to {} --out DIR", request.project.display(), request.formats);
        Fault::new(fault.what()).help(help)
    })?;
    if report.stopped {
        return Ok(format!("stopped: {} files written, the rest when it is run again", report.written));
    }
    let place = lesson.root.join("export");
    Ok(format!("{} files written, {} already there, in {}", report.written, report.kept, place.display()))
}

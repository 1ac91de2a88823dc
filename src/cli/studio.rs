//! `lianpu [FOLDER]`: the studio, with the export that it asks for.

use std::io::IsTerminal;
use std::path::Path;
use std::sync::atomic::AtomicBool;

use crate::disk::{Fault, Result};
use crate::export::{self, Format, Ledger, Request, Shard, Step};
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
    let clips = export::asked(&lesson, &asked)?;
    let mut ledger = Ledger::open(&lesson.root.join("export"), Shard::WHOLE);
    // The export's threads count; only this one may talk to the studio, which misses a step while it is busy.
    let (sender, receiver) = crossbeam_channel::bounded(64);
    let (source, asked, book) = (&lesson, &asked, &mut ledger);
    let exported = std::thread::scope(|scope| {
        let worker = scope.spawn(move || {
            let tell = |step: Step<'_>| {
                let (what, p) = match step {
                    Step::Frames(p) => ("frames".to_owned(), p),
                    Step::Whole(whole, p) => (whole.format.name().to_owned(), p),
                };
                let _ = sender.try_send(Progress { done: p.done.into(), total: p.of.into(), what });
            };
            export::export(source, asked, book, &tell, stop)
        });
        for p in &receiver {
            progress(p);
        }
        worker.join().unwrap_or_else(|_| Err(Fault::new("the export broke off")))
    });
    let report = exported.and_then(|exported| {
        if !exported.report.stopped {
            ledger.ask(clips);
            ledger.close()?;
        }
        Ok(exported.report)
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

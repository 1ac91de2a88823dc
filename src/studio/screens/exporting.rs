//! A running export, from the formats that were typed to its notes.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::style::{Modifier, Style};

use super::notes::NotesScreen;
use super::typing::TypingScreen;
use crate::disk::Result;
use crate::export::{CourseReport, Format};
use crate::project::counted;
use crate::studio::app::action::Action;
use crate::studio::app::export::{ExportRequest, Exporter, Progress};
use crate::studio::app::keys::Place;
use crate::studio::app::project::OpenProject;
use crate::studio::app::stack::{Context, Flow, Job, Reporter, Screen, Stack, View};
use crate::studio::app::wording;
use crate::studio::widgets::boxed::boxed;
use crate::studio::widgets::prompt::Purpose;
use crate::studio::widgets::text::{put, put_short};

/// How far a running export is.
#[derive(Debug)]
pub(crate) struct ExportingScreen {
    progress: Progress,
    /// Set to stop it.
    cancel: Arc<AtomicBool>,
}

/// Asks for the formats of an export of something.
pub(super) fn ask(what: &str, cx: &mut Context<'_>) {
    let help = format!("one or more of {}; what is unsaved is saved first", known_formats());
    cx.push(TypingScreen::new(Purpose::Export, format!("Export {what} as"), help, "png".into()));
}

/// Begins an export in the formats that were typed, of one clip or of all. What is unsaved is saved first.
///
/// # Errors
/// When there is no such format.
pub(super) fn start(
    project: &mut OpenProject,
    clip: Option<String>,
    typed: &str,
    cx: &mut Context<'_>,
) -> Result<(), String> {
    let formats = formats(typed)?;
    if !project.is_saved(cx.shell) {
        return Ok(());
    }
    let cancel = Arc::new(AtomicBool::new(false));
    cx.push(ExportingScreen { progress: Progress::default(), cancel: Arc::clone(&cancel) });
    let request = ExportRequest { project: project.lesson.root.clone(), clip, formats };
    cx.start(ExportJob { request, cancel, exporter: Arc::clone(&cx.shell.exporter) });
    Ok(())
}

fn known_formats() -> String {
    Format::ALL.map(Format::name).join(" ")
}

/// The formats that were typed, with a comma between them; what is none is told while it can still be mended.
fn formats(typed: &str) -> Result<Vec<Format>, String> {
    let words: Vec<String> = typed
        .split([' ', ',', '，', '、', ';'])
        .filter(|word| !word.is_empty())
        .map(|word| word.trim_start_matches('.').to_lowercase())
        .collect();
    if words.is_empty() {
        return Err(format!("type one or more of {}", known_formats()));
    }
    match words.iter().find(|word| Format::ALL.iter().all(|format| format.name() != word.as_str())) {
        Some(word) => Err(format!("`{word}` is no format: {}", known_formats())),
        None => Ok(words.iter().filter_map(|word| word.parse().ok()).collect()),
    }
}

/// An export in a thread.
struct ExportJob {
    request: ExportRequest,
    cancel: Arc<AtomicBool>,
    exporter: Arc<Mutex<Exporter>>,
}

impl Job for ExportJob {
    type Made = CourseReport;
    const BROKEN: [&'static str; 2] = ["the export broke off", "what it had written is incomplete: try again"];

    fn run(&mut self, reporter: &Reporter) -> Result<CourseReport> {
        let exporter = self.exporter.lock().unwrap_or_else(PoisonError::into_inner);
        let progress = |now| {
            reporter.tell(move |stack| {
                stack.with(|screen: &mut ExportingScreen, _| screen.progress = now);
            });
        };
        exporter(self.request.clone(), &progress, &self.cancel)
    }

    fn done(self, made: Result<CourseReport>, stack: &mut Stack) {
        stack.with(|_: &mut ExportingScreen, cx| cx.close());
        exported(made, &mut stack.context());
    }
}

/// Shows the result of an export: a line at the foot, and its notes in a list on top.
fn exported(made: Result<CourseReport>, cx: &mut Context<'_>) {
    let report = match made {
        Ok(report) => report,
        Err(fault) => return cx.shell.say_fault(&fault),
    };
    let count = |of: fn(&crate::export::Report) -> u32| -> usize {
        report.exported.iter().map(|(_, e)| of(&e.report) as usize).sum()
    };
    let (written, there) = (counted(count(|r| r.written), "file"), count(|r| r.kept));
    if let Some((_, fault)) = report.failed.first() {
        cx.shell.say_fault(fault);
    } else if report.stopped {
        cx.shell.say(format!("stopped: {written} written, the rest when it is run again"));
    } else {
        let folder = report.exported.first().map(|(root, _)| root.join("export")).unwrap_or_default();
        cx.shell.say(format!("{written} written, {there} already there, in {}", folder.display()));
    }
    if !report.notes.is_empty() {
        let lines = report.notes.iter().map(wording::worded).collect();
        cx.push(NotesScreen::new("Notes on the export".to_owned(), lines));
    }
}

impl Screen for ExportingScreen {
    fn place(&self) -> Place {
        Place::Export
    }

    fn handle(&mut self, action: Action, cx: &mut Context<'_>) -> Flow {
        if action != Action::Close {
            return Flow::Passed;
        }
        self.cancel.store(true, Ordering::Relaxed);
        cx.shell.say("stopping the export…");
        Flow::Taken
    }

    fn draw(&self, view: &mut View<'_>) -> Option<Position> {
        export(view.buffer, view.area, &self.progress);
        None
    }

    fn holds(&self) -> Option<&'static str> {
        Some("an export is running: Esc stops it")
    }
}

fn export(buffer: &mut Buffer, area: Rect, progress: &Progress) {
    let inside = boxed(buffer, area, 50, 2, "Exporting: Esc stops it");
    let share = if progress.total == 0 { 0.0 } else { progress.done as f64 / progress.total as f64 };
    let full = (share.clamp(0.0, 1.0) * f64::from(inside.width)).round() as u16;
    for column in 0..inside.width {
        let text = if column < full { "█" } else { "░" };
        put(buffer, inside.x + column, inside.y, 1, text, Style::new().remove_modifier(Modifier::DIM));
    }
    let text = match progress.total {
        0 => progress.what.clone(),
        total => format!("{} of {total}   {}", progress.done, progress.what),
    };
    put_short(buffer, inside.x, inside.y + 1, inside.width, &text, Style::new());
}

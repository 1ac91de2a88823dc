//! Exports of projects, from the missing analyses to the closed manifest: the one course of work that the studio and the
//! command line both run. It prints nothing; what it has to say goes to an [`Observer`] and into a [`CourseReport`].

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use super::lesson::{Exported, Step, export};
use super::run::elsewhere;
use super::{Asked, ExportFault, Format, Ledger, Request, Shard, Share, asked, divide};
use crate::disk::{Fault, Message, Result, Setting, message};
use crate::project::{Lesson, Output, check_output, prepare};

/// Where a course of exports reports to while it runs.
pub struct Observer<'a> {
    /// Takes each event as it happens, on the thread that exports; an error ends the course.
    pub event: &'a mut dyn FnMut(Event<'_>) -> Result<()>,
    /// Takes progress, from any thread.
    pub progress: &'a (dyn Fn(Step<'_>) + Sync),
    /// Set to end the course early, between two frames or files.
    pub stop: &'a AtomicBool,
}

/// An event of a course of exports.
#[derive(Debug)]
pub enum Event<'a> {
    /// Something an author should know.
    Note(&'a Message),
    /// A project is exported.
    Exported(&'a Path, &'a Exported),
    /// A project could not be exported; the course goes on with the others.
    Failed(&'a Path, &'a Fault),
}

/// The result of a course of exports.
#[derive(Debug, Default)]
pub struct CourseReport {
    /// The projects that were exported, in order.
    pub exported: Vec<(PathBuf, Exported)>,
    /// The projects that could not be exported.
    pub failed: Vec<(PathBuf, Fault)>,
    /// All notes, in the order in which they were observed.
    pub notes: Vec<Message>,
    /// Whether the course was stopped before its end; run again it goes on where it stopped.
    pub stopped: bool,
}

/// Exports projects: into one folder with one manifest where the request names a folder, else each into its own `export`.
/// Times and ratios that a project lacks are found first, in memory. A project that cannot be exported does not keep the
/// others from it.
///
/// # Errors
/// When the request suits no project at all, two projects would be written into the same folder, or a manifest cannot be
/// written. Faults of single projects are in the report.
pub fn export_projects(
    projects: &[PathBuf],
    request: &Request,
    shard: Shard,
    observer: &mut Observer<'_>,
) -> Result<CourseReport> {
    check_names(projects, request)?;
    let usual = Output::default();
    let output = Output { fps: request.fps.unwrap_or(usual.fps), size: request.size.unwrap_or(usual.size) };
    check_output(&output).map_err(Fault::of_the_call)?;
    let mut request = Request { by_project: projects.len() > 1, ..request.clone() };
    request.formats = distinct(&request.formats);
    let mut course = Course { request: &request, shard, observer, report: CourseReport::default() };
    match &request.out {
        Some(out) => course.export(projects, out)?,
        None => {
            for project in projects {
                course.export(std::slice::from_ref(project), &project.join("export"))?;
            }
        }
    }
    Ok(course.report)
}

struct Course<'a, 'b> {
    request: &'a Request,
    shard: Shard,
    observer: &'a mut Observer<'b>,
    report: CourseReport,
}

/// A project and the shares of its clips that are to be exported; `None` for everything.
type Work<'p> = (&'p Path, Option<Vec<Share>>);

impl Course<'_, '_> {
    /// Exports projects that share the manifest in `folder`.
    fn export(&mut self, projects: &[PathBuf], folder: &Path) -> Result<()> {
        if self.report.stopped {
            return Ok(());
        }
        let mut ledger = Ledger::open(folder, self.shard);
        let failed_before = self.report.failed.len();
        let work = self.shares(projects, &mut ledger)?;
        ledger.begin();
        for (project, shares) in work {
            let request = Request { shares, ..self.request.clone() };
            if request.shares.as_ref().is_some_and(|all| all.iter().all(Share::is_empty)) {
                continue;
            }
            match self.project(project, &request, &mut ledger) {
                Ok(()) => {}
                Err(fault) => self.fail(project, fault)?,
            }
            if self.report.stopped {
                return Ok(());
            }
        }
        let failed = self.report.failed.len() > failed_before;
        if failed && self.shard != Shard::WHOLE {
            ledger.give_up();
            return self
                .note(format!("part {} is not done; run it again when its projects are mended", self.shard).into());
        }
        if failed && ledger.is_empty() {
            return Ok(());
        }
        ledger.close().map_err(elsewhere).map(drop)
    }

    /// The share of each project that is to be exported here. In a divided export all projects are read first, so that
    /// every part knows of the others; they are not kept in memory.
    fn shares<'p>(&mut self, projects: &'p [PathBuf], ledger: &mut Ledger) -> Result<Vec<Work<'p>>> {
        if self.shard == Shard::WHOLE {
            return Ok(projects.iter().map(|p| (p.as_path(), None)).collect());
        }
        let mut lessons: Vec<(&Path, Vec<Asked>)> = Vec::new();
        for project in projects {
            match Lesson::read(project).and_then(|lesson| asked(&lesson, self.request)) {
                Ok(clips) => lessons.push((project, clips)),
                Err(fault) => self.fail(project, fault)?,
            }
        }
        let counts: Vec<u32> = lessons.iter().flat_map(|(_, clips)| clips.iter().map(Asked::count)).collect();
        let mut shares = divide(&counts, self.shard).into_iter();
        let mut work = Vec::with_capacity(lessons.len());
        for (project, clips) in lessons {
            work.push((project, Some(shares.by_ref().take(clips.len()).collect())));
            ledger.ask(clips);
        }
        Ok(work)
    }

    fn project(&mut self, project: &Path, request: &Request, ledger: &mut Ledger) -> Result<()> {
        let mut lesson = Lesson::read(project)?;
        let clips = asked(&lesson, request)?;
        let wanted = wanted(&lesson, request);
        let (progress, stop) = (self.observer.progress, self.observer.stop);
        let tracking = |clip: &str, done, of| {
            progress(Step::Tracking { clip, done, of });
            !stop.load(Ordering::Relaxed)
        };
        for note in prepare(&mut lesson, &wanted, &tracking) {
            self.note(note)?;
        }
        let exported = export(&lesson, request, ledger, progress, stop);
        for note in ledger.aside().take_notes() {
            self.note(note)?;
        }
        let exported = exported?;
        for note in &exported.notes {
            self.note(note.clone())?;
        }
        if exported.report.stopped {
            self.report.stopped = true;
        } else {
            if request.shares.is_none() {
                ledger.ask(clips);
            }
            (self.observer.event)(Event::Exported(project, &exported))?;
        }
        self.report.exported.push((project.to_owned(), exported));
        Ok(())
    }

    fn note(&mut self, note: Message) -> Result<()> {
        (self.observer.event)(Event::Note(&note))?;
        self.report.notes.push(note);
        Ok(())
    }

    fn fail(&mut self, project: &Path, fault: Fault) -> Result<()> {
        if self.observer.stop.load(Ordering::Relaxed) {
            self.report.stopped = true;
        }
        (self.observer.event)(Event::Failed(project, &fault))?;
        self.report.failed.push((project.to_owned(), fault));
        Ok(())
    }
}

/// The clips whose times and ratios are needed, by number: with shares of the project those that have one, but all of them
/// where they go into one file.
fn wanted(lesson: &Lesson, request: &Request) -> Vec<usize> {
    let chosen: Vec<usize> = (0..lesson.clips.len())
        .filter(|n| request.clip.as_ref().is_none_or(|name| lesson.clips[*n].entry.name == *name))
        .collect();
    let Some(shares) = &request.shares else { return chosen };
    let together =
        request.formats.iter().any(|f| f.is_of_the_lesson()) && shares.first().is_some_and(|s| s.whole_files);
    chosen.into_iter().zip(shares).filter(|(_, share)| together || !share.is_empty()).map(|(n, _)| n).collect()
}

/// The formats in the order given, each once.
fn distinct(formats: &[Format]) -> Vec<Format> {
    let mut all = Vec::new();
    for format in formats {
        if !all.contains(format) {
            all.push(*format);
        }
    }
    all
}

/// Projects that are exported into one folder need names that differ there.
fn check_names(projects: &[PathBuf], request: &Request) -> Result<()> {
    if request.out.is_none() {
        return Ok(());
    }
    let name = |p: &PathBuf| p.canonicalize().ok().and_then(|p| p.file_name().map(|n| n.to_owned()));
    for (i, project) in projects.iter().enumerate() {
        if let Some(other) = projects[..i].iter().find(|o| name(o).is_some() && name(o) == name(project)) {
            let (other, project) = (other.display(), project.display());
            let what = format!("`{other}` and `{project}` would be written into the same folder");
            return Err(Fault::of(ExportFault::NamesClash, what)
                .help(message!["export them one by one, each with its own ", Setting::Out])
                .of_the_call());
        }
    }
    Ok(())
}

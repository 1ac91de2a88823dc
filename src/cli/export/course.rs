//! Lessons that are exported into one place, or one part of that work.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use super::show::Show;
use crate::cli::print::{self, note, tell};
use crate::disk::{Fault, Result};
use crate::export::{Asked, Ledger, Request, Shard, Share, asked, divide, export};
use crate::project::{Clip, Lesson};

/// What is done with each lesson.
pub(super) struct Course<'a> {
    pub(super) request: &'a Request,
    pub(super) shard: Shard,
    /// Whether there are other lessons, which one that is damaged does not keep from being exported.
    pub(super) several: bool,
    pub(super) stop: &'a AtomicBool,
    pub(super) json: bool,
}

/// Lessons that could not be exported.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Failed {
    pub(super) count: u32,
    /// Those of them that nothing is wrong with: what was asked for does not fit them.
    pub(super) of_the_call: u32,
}

/// A project and what of its clips is to be done; everything where left out.
type Work<'p> = (&'p Path, Option<Vec<Share>>);

impl Course<'_> {
    /// Exports lessons that share a manifest. Tells of each that failed why.
    pub(super) fn export(&self, projects: &[PathBuf], out: &mut dyn Write) -> Result<Failed> {
        let mut failed = Failed::default();
        let folder = self.request.out.clone().or_else(|| projects.first().map(|p| p.join("export")));
        let mut ledger = Ledger::open(&folder.unwrap_or_default(), self.shard);
        let work = self.shares(projects, &mut ledger, &mut failed)?;
        ledger.begin();
        for (project, shares) in work {
            let request = Request { shares, ..self.request.clone() };
            if request.shares.as_ref().is_some_and(|all| all.iter().all(Share::is_empty)) {
                continue;
            }
            if let Err(fault) = self.lesson(project, &request, &mut ledger, out) {
                self.forgive(project, fault, &mut failed)?;
            }
        }
        if failed.count > 0 && self.shard != Shard::WHOLE {
            ledger.give_up();
            note(format_args!("part {} is not done; run it again when its lessons are mended", self.shard));
            return Ok(failed);
        }
        if failed.count > 0 && ledger.is_empty() {
            return Ok(failed);
        }
        ledger.close().map_err(|f| f.help("choose another place with --out DIR"))?;
        Ok(failed)
    }

    /// One lesson that is damaged, or has no such clip or frame, must not keep a course from being exported.
    fn forgive(&self, project: &Path, fault: Fault, failed: &mut Failed) -> Result<()> {
        if !self.several || self.stop.load(Ordering::Relaxed) {
            return Err(fault);
        }
        tell(format_args!("error: {}: {fault}", project.display()));
        failed.count += 1;
        failed.of_the_call += u32::from(fault.is_of_the_call());
        Ok(())
    }

    /// What of each lesson is to be done here. In a divided export all lessons are looked at first, so that every part
    /// knows of the others; lessons are not kept in memory.
    fn shares<'p>(&self, projects: &'p [PathBuf], ledger: &mut Ledger, failed: &mut Failed) -> Result<Vec<Work<'p>>> {
        if self.shard == Shard::WHOLE {
            return Ok(projects.iter().map(|p| (p.as_path(), None)).collect());
        }
        let mut lessons: Vec<(&Path, Vec<Asked>)> = Vec::new();
        for project in projects {
            match Lesson::read(project).and_then(|lesson| asked(&lesson, self.request)) {
                Ok(clips) => lessons.push((project, clips)),
                Err(fault) => self.forgive(project, fault, failed)?,
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

    fn lesson(&self, project: &Path, request: &Request, ledger: &mut Ledger, out: &mut dyn Write) -> Result<()> {
        let mut lesson = Lesson::read(project)?;
        let clips = asked(&lesson, request)?;
        let wanted = wanted(&lesson, request);
        crate::cli::align::find_missing(&mut lesson, &wanted);
        for clip in lesson.clips.iter().filter(|c| request.clip.as_ref().is_none_or(|name| c.entry.name == *name)) {
            note_guess(clip);
            note_sound(clip);
        }
        for face in lesson.faces.iter().filter(|f| f.looks_each_time()) {
            note(format_args!(
                "the points of face {} were looked for in its photo; `lianpu face` keeps them",
                face.entry.name
            ));
        }
        let show = Show::new(self.json);
        let exported = export(&lesson, request, ledger, &|step| show.step(step), self.stop)?;
        show.clear();
        for note in &exported.notes {
            print::note(note);
        }
        if exported.report.stopped {
            return Err(
                Fault::new("the export was stopped before its end").help("run it again: it goes on where it stopped")
            );
        }
        if request.shares.is_none() {
            ledger.ask(clips);
        }
        show.result(project, self.several, &exported, out)
    }
}

/// The clips whose times and ratios are needed, by number: with shares of the lesson those that have one, but all of them
/// where they go into one file.
fn wanted(lesson: &Lesson, request: &Request) -> Vec<usize> {
    let asked: Vec<usize> = (0..lesson.clips.len())
        .filter(|n| request.clip.as_ref().is_none_or(|name| lesson.clips[*n].entry.name == *name))
        .collect();
    let Some(shares) = &request.shares else { return asked };
    let together =
        request.formats.iter().any(|f| f.is_of_the_lesson()) && shares.first().is_some_and(|s| s.whole_files);
    asked.into_iter().zip(shares).filter(|(_, share)| together || !share.is_empty()).map(|(n, _)| n).collect()
}

/// Frames drawn from guessed times look as sure as any others, so it is said.
fn note_guess(clip: &Clip) {
    if clip.timing.guessed && !clip.syllables.is_empty() {
        note(format_args!("the times of clip {} are guessed; set them in the studio", clip.entry.name));
    }
}

/// What was wrong with a recording, and what it does not hold of what is said.
fn note_sound(clip: &Clip) {
    let Some(sound) = &clip.sound else { return };
    let name = &clip.entry.name;
    for warning in &sound.warnings {
        note(format_args!("the recording of clip {name}: {warning}"));
    }
    let end = sound.duration();
    // Rounded times may end a hair later.
    if let Some(over) = clip.intervals().iter().find(|i| i.end > end + 0.01) {
        note(format_args!("`{}` of clip {name} ends at {:.2} s, its recording at {end:.2} s", over.label, over.end));
    }
}

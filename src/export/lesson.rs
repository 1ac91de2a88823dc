//! The export of one lesson, or of a share of it: frames and texts first, then what holds a clip or the lesson whole, all of
//! it noted in the ledger.

use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

use super::plan::out_folder;
use super::{ExportFault, Format, Ledger, Progress, Report, Request, Whole, plan, run, wholes, write_wholes};
use crate::disk::{Fault, Message, Result, Setting, Task, clear_temporaries, message};
use crate::forms::movie;
use crate::project::Lesson;

/// What an export is at.
#[derive(Debug, Clone, Copy)]
pub enum Step<'a> {
    /// Frames of all clips.
    Frames(Progress),
    /// A file that holds a clip or the lesson whole, and how many of its frames are done.
    Whole(&'a Whole, Progress),
    /// The face in a clip's video is followed, since the clip has no ratios.
    Tracking {
        /// The clip's name.
        clip: &'a str,
        /// Frames done.
        done: usize,
        /// Frames in all, where that is known.
        of: Option<usize>,
    },
}

/// Where something is now.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// The clip; none where it is of the lesson.
    pub clip: Option<String>,
    /// A file, or a folder of frames.
    pub path: PathBuf,
    /// How many frames are in the folder; 0 of a file.
    pub frames: usize,
}

/// What became of an export.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Exported {
    /// What there is now, in the order it was made.
    pub places: Vec<Place>,
    /// What the author should know, each once.
    pub notes: Vec<Message>,
    /// How much was done.
    pub report: Report,
}

/// Exports what is asked of a lesson. `tell` is called from any thread; `stop` ends it early, between two frames, and then
/// the ledger is not to be closed. What was set aside the ledger knows.
///
/// # Errors
/// When it cannot be planned or a file cannot be written. Every file that is there is whole.
pub fn export(
    lesson: &Lesson,
    request: &Request,
    ledger: &mut Ledger,
    tell: &(dyn Fn(Step<'_>) + Sync),
    stop: &AtomicBool,
) -> Result<Exported> {
    let jobs = plan(lesson, request)?;
    let whole = wholes(lesson, request)?;
    if whole.iter().any(|w| matches!(w.format, Format::Mp4 | Format::Webm)) {
        movie::is_there()?;
    }
    check_ratios(lesson, &whole)?;
    // What a run that was killed has left half done.
    clear_temporaries(&out_folder(lesson, request));
    jobs.iter().for_each(|job| clear_temporaries(&job.folder));
    ledger.set_manifest_aside()?;
    for (path, text) in jobs.iter().flat_map(|job| &job.texts) {
        ledger.set_aside(path, Some(text.as_bytes()))?;
    }
    let (report, files) = run(&jobs, request.jobs, ledger.aside(), &|p| tell(Step::Frames(p)), stop)?;
    ledger.add(files);
    let made = write_wholes(lesson, request, &whole, ledger, &|whole, p| tell(Step::Whole(whole, p)), stop)?;
    let mut exported = Exported { report: report.with(&made), ..Exported::default() };
    exported.report.stopped |= made.len() < whole.len();
    if !request.frames.is_all() {
        exported.notes.extend(note_on_frames(request));
    }
    for job in &jobs {
        let clip = Some(job.clip.clone());
        if !job.formats.is_empty() && !job.frames.is_empty() {
            let (path, frames) = (job.folder.clone(), job.frames.len());
            exported.places.push(Place { clip: clip.clone(), path, frames });
        }
        let texts = job.texts.iter().map(|(path, _)| path.clone());
        exported.places.extend(texts.map(|path| Place { clip: clip.clone(), path, frames: 0 }));
    }
    for (whole, written) in whole.iter().zip(made) {
        let paths = written.paths.into_iter();
        exported.places.extend(paths.map(|path| Place { clip: whole.clip.clone(), path, frames: 0 }));
        for note in written.notes {
            if !exported.notes.contains(&note) {
                exported.notes.push(note);
            }
        }
    }
    Ok(exported)
}

/// A record is written of ratios that are there, not of a face at rest in place of those that are lost.
fn check_ratios(lesson: &Lesson, whole: &[Whole]) -> Result<()> {
    let records = whole.iter().filter(|w| matches!(w.format, Format::Ratios | Format::Lpr));
    let lost = records.filter_map(|w| w.clip.as_deref()).find_map(|name| {
        let clip = lesson.clips.iter().find(|c| c.entry.name == name)?;
        (clip.record.is_none() && (clip.video.is_some() || clip.lost_its_record())).then_some(clip)
    });
    let Some(clip) = lost else { return Ok(()) };
    let what = format!("the clip `{}` has no ratios: its ratios.csv is not there", clip.entry.name);
    let help = match clip.video {
        Some(_) => message!["find them by ", Task::Track, ", or leave the formats ratios and lpr out"],
        None => "put the file back, or leave the formats ratios and lpr out".into(),
    };
    Err(Fault::of(ExportFault::NoRatios, what).at(clip.folder.join("ratios.csv")).help(help))
}

/// Some forms have no use for a part of a clip.
fn note_on_frames(request: &Request) -> Option<Message> {
    let follows = |f: &Format| f.is_frames() || f.is_moving() || *f == Format::Poses;
    let others: Vec<&str> = request.formats.iter().filter(|f| !follows(f)).map(|f| f.name()).collect();
    (!others.is_empty())
        .then(|| message!["of the whole clip, whatever ", Setting::Frames, format!(" says: {}", others.join(", "))])
}

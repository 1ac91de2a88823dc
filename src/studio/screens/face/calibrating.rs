//! The calibration of a face on its page: from shot to shot, made in a thread, kept with the project, told in words.

use std::path::PathBuf;

use super::photo::PhotoJob;
use super::work::FaceWork;
use crate::calibration::{CalibrationFile, Kept, Source};
use crate::disk::Result;
use crate::pose::Emotion;
use crate::project::counted;
use crate::studio::app::project::OpenProject;
use crate::studio::app::stack::{Job, Reporter, Stack};
use crate::studio::screens::project::checking::CheckJob;

/// Goes to another of the seven shots. Its photo is read in a thread; the cartoon shows what the shot shows.
pub(super) fn turn(work: &mut FaceWork<'_, '_>, by: i32) {
    if work.desk.placing.is_some() {
        work.refuse("first place the four points, or give that up with o");
        return;
    }
    let face = &work.project.lesson.faces[work.desk.face];
    let desk = &mut *work.desk;
    let shot = Emotion::ALL[(desk.shot.index() as i32 + by).rem_euclid(7) as usize];
    (desk.shot, desk.emotion, desk.mouth, desk.stage) = (shot, shot, None, None);
    (desk.photo, desk.dots) = (None, Vec::new());
    let stages = shot == Emotion::Neutral && desk.stages.is_empty();
    desk.choose_known(face);
    if let Some(job) = PhotoJob::of(&work.project.lesson, desk.face, shot, stages) {
        work.cx.start(job);
    }
}

/// Saves the project and calibrates the face from its files.
pub(super) fn ask(work: &mut FaceWork<'_, '_>) {
    if !work.may_change() || work.desk.placing.is_some() {
        return;
    }
    let face = work.face();
    let (folder, photos) = (face.folder.clone(), face.shots.iter().filter(|s| s.photo.is_some()).count());
    // It is made from what is in the files: what is not there yet would be missing from it.
    if !work.project.is_saved(work.cx.shell) {
        return;
    }
    let from = counted(photos + 1, "photo");
    let saved = work.cx.shell.message.take().map_or_else(String::new, |m| format!("{}; ", m.text));
    work.cx.shell.busy = Some(format!("{saved}calibrating from {from}…"));
    work.cx.start(CalibrateJob { root: work.project.lesson.root.clone(), face: work.desk.face, folder });
}

/// Calibrates a face from the files of its folder.
struct CalibrateJob {
    root: PathBuf,
    face: usize,
    folder: PathBuf,
}

impl Job for CalibrateJob {
    type Made = Kept;
    const BROKEN: [&'static str; 2] = ["the face cannot be calibrated", "please report what `lianpu calibrate` says"];

    fn run(&mut self, _: &Reporter) -> Result<Kept> {
        Kept::make(&self.folder)
    }

    fn done(self, made: Result<Kept>, stack: &mut Stack) {
        stack.shell.busy = None;
        // The author may have gone to another project in the meantime.
        let Some(project) = stack.project(&self.root) else { return };
        let (project, cx) = (&mut *project.borrow_mut(), &mut stack.context());
        let done = made.and_then(|kept| keep(project, self.face, &kept));
        project.revision += 1;
        project.faces_revision += 1;
        match done {
            Ok(()) => {
                let file = project.lesson.faces[self.face].calibration.as_ref();
                cx.shell.say(format!("calibrated: {}", file.map(|file| summary(file)).unwrap_or_default()));
                cx.start(CheckJob { root: self.root });
            }
            Err(fault) => cx.shell.say_fault(&fault),
        }
    }
}

/// Keeps a calibration: its points become a change of the project, and everything is written.
fn keep(project: &mut OpenProject, face: usize, kept: &Kept) -> Result<()> {
    if let Some(change) = project.lesson.calibrated(face, kept)? {
        project.lesson.change(change)?;
    }
    project.lesson.keep_calibration(face, kept).map(drop)
}

/// How good a calibration is as a whole.
fn summary(file: &CalibrationFile) -> String {
    let (a, b, degrees) = file.quality.nearest;
    format!("{a} and {b} are hardest to tell apart ({degrees:.0}°); condition {:.1}", file.quality.condition)
}

/// What a calibration says of a shot.
pub(super) fn told(file: &CalibrationFile, shot: Emotion) -> String {
    if shot == Emotion::Neutral {
        return summary(file);
    }
    let source = file.calibration.shapes()[shot.index()].source;
    let quality = file.quality.shots.iter().find(|s| s.emotion == shot);
    let (residual, strength) = quality.map_or((0.0, 0.0), |q| (q.residual, q.strength));
    let moved = format!("moves {strength:.1} % of the pupil distance");
    match source {
        Source::Marked => format!("set by hand; {moved}; residual {residual:.1} %"),
        Source::Found(sure) => format!("found, {:.0} % sure; {moved}; residual {residual:.1} %", 100.0 * sure),
        Source::Modelled => format!("modelled after everybody's face; {moved}"),
    }
}

/// What is to be said of a calibration besides, the most important first.
pub(super) fn remarks(file: &CalibrationFile) -> Vec<String> {
    let quality = &file.quality;
    let first = quality.retake.as_ref();
    let told = first.map(|r| format!("take {} anew first: {}", r.emotion, r.why));
    told.into_iter().chain(quality.notes.iter().filter(|n| first.is_none_or(|r| r.why != **n)).cloned()).collect()
}

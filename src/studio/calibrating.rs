//! The calibration of a face on its page: from shot to shot, made in a thread, kept with the lesson, told in words.

use std::path::Path;

use super::execute::save;
use super::face_edits;
use super::job::Job;
use super::state::State;
use crate::calibration::{CalibrationFile, Kept, Source};
use crate::disk::Result;
use crate::face::FeaturePoint;
use crate::pose::Emotion;

/// Goes to another of the seven shots. Its photo is read in a thread; the cartoon shows what the shot shows.
pub(super) fn turn(state: &mut State, by: i32) -> Option<Job> {
    let root = state.lesson()?.root.clone();
    let desk = state.face.as_mut()?;
    if desk.placing.is_some() {
        state.refuse("first place the four points, or give that up with o");
        return None;
    }
    let shot = Emotion::ALL[(desk.shot.index() as i32 + by).rem_euclid(7) as usize];
    (desk.shot, desk.emotion, desk.mouth, desk.stage) = (shot, shot, None, None);
    (desk.photo, desk.dots) = (None, Vec::new());
    let (number, stages) = (desk.face, shot == Emotion::Neutral && desk.stages.is_empty());
    let face = state.open.as_ref()?.lesson.as_ref().ok()?.faces.get(number)?;
    let desk = state.face.as_mut()?;
    let points = desk.points(face);
    if !points.is_empty() && points.iter().all(|p| p.0 != desk.point) {
        desk.point = FeaturePoint::P3_6;
    }
    let path = face.photo_of(shot)?.clone();
    let dots = face.shot(shot).and_then(|s| s.foreign.clone());
    let eyes = face_edits::eyes(face);
    Some(Job::Photo { root, face: number, shot, path, eyes, dots, stages })
}

/// Saves the lesson and calibrates the face on the desk from its files.
pub(super) fn ask(state: &mut State) -> Option<Job> {
    if !face_edits::may_change(state) {
        return None;
    }
    let number = state.face.as_ref().filter(|d| d.placing.is_none())?.face;
    let face = state.lesson()?.faces.get(number)?;
    let (folder, photos) = (face.folder.clone(), face.shots.iter().filter(|s| s.photo.is_some()).count());
    // It is made from what is in the files: what is not there yet would be missing from it.
    if state.is_unsaved() {
        save(state);
        if state.is_unsaved() {
            return None;
        }
    }
    let from = crate::project::counted(photos + 1, "photo");
    let saved = state.message.take().map_or_else(String::new, |m| format!("{}; ", m.text));
    state.busy = Some(format!("{saved}calibrating from {from}…"));
    let root = state.lesson()?.root.clone();
    Some(Job::Calibrate { root, face: number, folder })
}

/// Takes a calibration: its points become a change of the lesson, and everything is written.
pub(super) fn made(state: &mut State, root: &Path, number: usize, made: Result<Kept>) -> Option<Job> {
    if state.lesson().is_none_or(|l| l.root != root) {
        return None;
    }
    let done = made.and_then(|kept| {
        let Some(lesson) = state.lesson_mut() else { return Ok(()) };
        if let Some(change) = lesson.calibrated(number, &kept)? {
            lesson.change(change)?;
        }
        lesson.keep_calibration(number, &kept).map(drop)
    });
    face_edits::show(state);
    if let Err(fault) = done {
        state.say_fault(&fault);
        return None;
    }
    if let Some(desk) = &mut state.face {
        desk.remarks.clear();
    }
    let said = state.lesson()?.faces.get(number)?.calibration.as_ref().map(|file| summary(file));
    state.say(format!("calibrated: {}", said.unwrap_or_default()));
    Some(Job::Check(root.to_owned()))
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

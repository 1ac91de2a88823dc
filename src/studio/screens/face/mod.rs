//! The page of a face: its photo with its points, its cartoon, its shots and its calibration.

mod calibrating;
pub(in crate::studio) mod desk;
mod draw;
mod edits;
mod finding;
pub(in crate::studio) mod page;
mod photo;
mod placing;
mod points;
mod work;

use std::rc::Rc;

use ratatui::layout::{Position, Rect};

use self::desk::FaceDesk;
use self::draw::FaceLayout;
use self::page::FaceScreen;
use self::photo::PhotoJob;
use self::work::FaceWork;
use crate::pose::Emotion;
use crate::studio::app::action::Action;
use crate::studio::app::keys::Place;
use crate::studio::app::project::{OpenProject, SharedProject};
use crate::studio::app::shell::Shell;
use crate::studio::app::stack::{Context, Flow, Screen, View};
use crate::studio::screens::project::checking;
use crate::studio::widgets::picture::FacePicture;
use crate::studio::widgets::prompt::{Prompt, Purpose};

/// Opens the page of the face of a clip; its photo is read in a thread.
pub(super) fn open(shared: &SharedProject, project: &mut OpenProject, clip: usize, cx: &mut Context<'_>) {
    let lesson = &project.lesson;
    let entry = match lesson.clips.get(clip) {
        Some(clip) => lesson.manifest.face_of(&clip.entry),
        None => lesson.manifest.faces.first(),
    };
    let Some(number) = entry.and_then(|e| lesson.faces.iter().position(|f| f.entry.name == e.name)) else {
        cx.shell.refuse("the lesson has no face: add a [[face]] to lianpu.toml");
        return;
    };
    let face = &lesson.faces[number];
    if face.photo.is_none() && face.face.is_none() {
        let folder = format!("faces/{}/neutral.png", face.entry.name);
        cx.shell.refuse(format!("this face has no photo: put one there as {folder}"));
        return;
    }
    let mut desk = FaceDesk::new(number, face.entry.mouths, None);
    match face.face.is_some().then(|| lesson.cartoon_of(face)).transpose() {
        Ok(figure) => desk.figure = figure,
        Err(fault) => desk.remarks.push(format!("the cartoon cannot be drawn: {}", fault.what())),
    }
    desk.is_stale = face.is_stale();
    desk.shown = project.faces_revision;
    if face.face.is_none() {
        desk.remarks.push("the points have not been found yet: r finds them".into());
    }
    if let Some(why) = &lesson.read_only {
        cx.shell.say(format!("you can look but not change: {why}"));
    }
    if let Some(job) = PhotoJob::of(lesson, number, Emotion::Neutral, true) {
        cx.start(job);
    }
    let (cartoon, stage) = (FacePicture::default(), FacePicture::default());
    cx.push(FaceScreen { project: Rc::clone(shared), desk, cartoon, stage });
}

fn on_face(work: &mut FaceWork<'_, '_>, action: Action) -> bool {
    match action {
        Action::Undo | Action::Redo if work.cx.shell.busy.is_some() => {
            work.refuse("the face is still being looked for");
        }
        Action::Undo | Action::Redo => work.project.retrace(action, work.cx.shell),
        Action::Save => checking::save(work.project, work.cx),
        Action::Back => {
            if work.desk.placing.take().is_none() {
                work.cx.close();
            }
        }
        _ => return edits::execute(work, action),
    }
    true
}

impl Screen for FaceScreen {
    fn place(&self) -> Place {
        Place::Face
    }

    fn is_page(&self) -> bool {
        true
    }

    fn project(&self) -> Option<&SharedProject> {
        Some(&self.project)
    }

    fn handle(&mut self, action: Action, cx: &mut Context<'_>) -> Flow {
        if self.with(cx, |work| on_face(work, action)) { Flow::Taken } else { Flow::Passed }
    }

    fn refresh(&mut self, cx: &mut Context<'_>) {
        self.with(cx, |work| {
            if work.desk.shown != work.project.faces_revision {
                work.show();
            }
        });
    }

    fn accept(&mut self, prompt: &Prompt, cx: &mut Context<'_>) -> Result<(), String> {
        match prompt.purpose {
            Purpose::Point => self.with(cx, |work| edits::take_point(work, prompt.line.text().trim())),
            _ => Ok(()),
        }
    }

    fn paint(&mut self, area: Rect, shell: &Shell) {
        let layout = FaceLayout::of(area, &self.desk);
        if let Some(figure) = &self.desk.figure {
            self.cartoon.show(figure, &self.desk.pose(), layout.cartoon, shell.colours);
        }
        if let Some((_, drawing)) = self.desk.stage.and_then(|s| self.desk.stages.get(s)) {
            self.stage.show_drawing(drawing, layout.photo, shell.colours);
        }
    }

    fn draw(&self, view: &mut View<'_>) -> Option<Position> {
        draw::face(view, &self.project.borrow(), self);
        None
    }
}

//! The search for the points of a face in its photo, in a thread.

use std::path::PathBuf;

use super::page::FaceScreen;
use super::work::FaceWork;
use crate::disk::Result;
use crate::face::{Anchors, Created, Face, FeaturePoint, How, create};
use crate::photo::Photo;
use crate::project::{Change, Edit, FaceEdit};
use crate::studio::app::stack::{Job, Reporter, Stack};

/// Gives the chosen point back to the search: it is found again with everything else.
pub(super) fn release(work: &mut FaceWork<'_, '_>) {
    let (desk, lesson_face) = (&*work.desk, work.face());
    let Some(face) = &lesson_face.face else { return };
    let points = [Some(desk.point), desk.both.then(|| desk.point.mirror())];
    let free: Vec<FeaturePoint> =
        points.into_iter().flatten().filter(|p| face.placed(*p).is_some_and(|p| p.how == How::Hand)).collect();
    if free.is_empty() {
        work.refuse(format!("{} was not set by hand", desk.point));
        return;
    }
    let mut kept = face.clone();
    for point in free {
        if let Some(placed) = kept.placed_mut(point) {
            placed.how = How::Rule;
        }
    }
    find(work, Some(kept), None);
}

/// Finds the points again. What a hand has set stays.
pub(super) fn again(work: &mut FaceWork<'_, '_>, anchors: Option<Anchors>) {
    let kept = work.face().face.clone();
    find(work, kept, anchors);
}

/// Starts the search. What a hand has set in `kept` stays.
fn find(work: &mut FaceWork<'_, '_>, kept: Option<Face>, anchors: Option<Anchors>) {
    if !work.may_change() {
        return;
    }
    let Some(path) = work.face().photo.clone() else {
        work.refuse("this face has no photo to look at");
        return;
    };
    work.cx.shell.busy = Some("looking for the face…".into());
    let (root, face) = (work.project.lesson.root.clone(), work.desk.face);
    work.cx.start(FindJob { root, face, path, kept: kept.map(Box::new), anchors });
}

/// Finds the points of a face.
struct FindJob {
    root: PathBuf,
    face: usize,
    path: PathBuf,
    /// The face so far.
    kept: Option<Box<Face>>,
    /// Four places given by hand.
    anchors: Option<Anchors>,
}

impl Job for FindJob {
    type Made = Created;
    const BROKEN: [&'static str; 2] = super::photo::BROKEN;

    fn run(&mut self, _: &Reporter) -> Result<Created> {
        let (photo, sha256) = Photo::read_with_sum(&self.path)?;
        create(&photo, &sha256, self.kept.as_deref(), self.anchors.as_ref()).map_err(|f| f.at(&self.path))
    }

    fn done(self, made: Result<Created>, stack: &mut Stack) {
        stack.shell.busy = None;
        stack.with(|screen: &mut FaceScreen, cx| {
            screen.work_on(&self.root, self.face, cx, |work| match made {
                Ok(created) => {
                    found(work, &created.face);
                    work.desk.remarks = created.warnings.iter().map(ToString::to_string).collect();
                }
                Err(fault) => {
                    work.desk.remarks = vec!["where the search fails, o places the face by hand".into()];
                    work.cx.shell.say_fault(&fault);
                }
            });
        });
    }
}

/// Takes what a search has found.
fn found(work: &mut FaceWork<'_, '_>, face: &Face) {
    let before = work.face().face.as_ref().map(Face::to_toml);
    let after = face.to_toml();
    if before.as_ref() == Some(&after) {
        work.say("found the same points again");
        return;
    }
    let edit = Edit::Face(work.desk.face, FaceEdit::Face { before, after: Some(after) });
    if work.change(Change::one("find the face's points", edit)) {
        work.desk.placing = None;
        work.desk.zoom = 0;
    }
}

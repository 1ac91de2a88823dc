//! Four points of a face placed by hand, where the search fails.

use super::desk::Placing;
use super::finding;
use super::work::FaceWork;
use crate::face::Anchors;
use crate::geometry::{Point, Vec2};

/// Begins to place four points by hand, or gives that up.
pub(super) fn begin(work: &mut FaceWork<'_, '_>) {
    if !work.may_change() {
        return;
    }
    let desk = &mut *work.desk;
    let Some(photo) = &desk.photo else {
        work.cx.shell.refuse("this face has no photo to look at");
        return;
    };
    desk.placing = match desk.placing {
        Some(_) => None,
        None => {
            let cross = Point::new((photo.width() as f64 * 0.4).round(), (photo.height() as f64 * 0.45).round());
            Some(Placing { given: Vec::new(), cross })
        }
    };
    desk.zoom = 0;
    desk.stage = None;
}

/// Takes the place of the cross; with the fourth the search begins.
pub(super) fn place(work: &mut FaceWork<'_, '_>) {
    let desk = &mut *work.desk;
    let Some(placing) = &mut desk.placing else { return };
    placing.given.push(placing.cross);
    // The next cross starts where its goal usually is.
    if let [left, right, ..] = placing.given[..] {
        let (middle, across) = (left.midpoint(right), right - left);
        let down = Vec2::new(-across.y, across.x);
        placing.cross = middle + down * if placing.given.len() == 2 { 1.1 } else { 1.85 };
    } else {
        placing.cross.x += (desk.photo.as_ref().map_or(0, |p| p.width()) as f64 * 0.16).round();
    }
    let [left_eye, right_eye, mouth, chin] = placing.given[..] else { return };
    desk.placing = None;
    finding::again(work, Some(Anchors { left_eye, right_eye, mouth, chin }));
}

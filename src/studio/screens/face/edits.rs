//! What the keys do on the page of a face. Each edit becomes one change of the project.

use super::desk::{FaceDesk, mirrored};
use super::work::FaceWork;
use super::{calibrating, finding, placing};
use crate::disk::nearest;
use crate::face::{FeaturePoint, HairKind, How};
use crate::geometry::{Point, Vec2};
use crate::pose::{Emotion, MouthShape};
use crate::project::{Change, Edit, FaceEdit, LessonFace, Spot};
use crate::studio::app::action::Action;
use crate::studio::screens::typing::TypingScreen;
use crate::studio::widgets::prompt::Purpose;

/// Carries out what is asked for on the page of a face; whether the action means something there.
pub(super) fn execute(work: &mut FaceWork<'_, '_>, action: Action) -> bool {
    let is_shot = work.desk.shot != Emotion::Neutral;
    match action {
        Action::Shot(by) => calibrating::turn(work, by),
        Action::Calibrate => calibrating::ask(work),
        Action::FindAgain if is_shot => work.refuse("r is for the neutral photo: C finds the points of the shots"),
        Action::Anchors | Action::Stage(_) if is_shot => work.refuse("that is for the neutral photo: [ goes there"),
        Action::Release if is_shot => release_of_shot(work),
        Action::Move(x, y) => shift(work, Vec2::new(f64::from(x), f64::from(y))),
        Action::FindAgain => finding::again(work, None),
        Action::Cross => placing::place(work),
        Action::Anchors => placing::begin(work),
        Action::Release => finding::release(work),
        Action::Hair => next_hair(work),
        Action::GoTo => ask_point(work),
        _ => return look(work, action),
    }
    true
}

/// Carries out what changes only what is looked at; whether the action does.
fn look(work: &mut FaceWork<'_, '_>, action: Action) -> bool {
    let face = &work.project.lesson.faces[work.desk.face];
    let desk = &mut *work.desk;
    let turned = |at: usize, by: i32, length: usize| (at as i32 + by).rem_euclid(length as i32) as usize;
    match action {
        Action::Point(by) => match desk.points(face) {
            points if points.is_empty() => {
                let why = no_points(desk, face);
                work.cx.shell.refuse(why);
            }
            points => desk.choose(by, &points),
        },
        Action::Both => {
            desk.both = !desk.both;
            let said = if desk.both { "both sides move" } else { "one side moves" };
            work.cx.shell.say(said);
        }
        Action::Zoom(by) => desk.zoom_by(by),
        Action::Fit => desk.zoom = 0,
        Action::Emotion(by) => desk.emotion = Emotion::ALL[turned(desk.emotion as usize, by, 7)],
        Action::Mouth(by) => {
            let at = desk.mouth.and_then(|m| MouthShape::ALL.iter().position(|s| *s == m)).map_or(0, |i| i + 1);
            desk.mouth = turned(at, by, 10).checked_sub(1).map(|i| MouthShape::ALL[i]);
        }
        Action::Stage(by) => {
            let count = desk.stages.len() as i32 + 1;
            let at = desk.stage.map_or(0, |s| s as i32 + 1);
            desk.stage = ((at + by).rem_euclid(count) as usize).checked_sub(1);
        }
        _ => return false,
    }
    true
}

/// Why a shot has no points to choose or move, and what to do.
fn no_points(desk: &FaceDesk, face: &LessonFace) -> String {
    match face.shot(desk.shot) {
        None => "there are no points yet: r finds them".into(),
        Some(shot) => match (&shot.photo, &shot.foreign) {
            (None, _) => format!("there is no photo of {}: it is modelled", desk.shot),
            (_, Some(path)) => {
                let name = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
                format!("these points have no names: change them in {name}")
            }
            (Some(_), None) => "there are no points yet: C finds them".into(),
        },
    }
}

/// Moves the chosen point, or the cross.
fn shift(work: &mut FaceWork<'_, '_>, step: Vec2) {
    let desk = &mut *work.desk;
    if let Some(placing) = &mut desk.placing {
        let size = desk.photo.as_ref().map_or((0, 0), |p| (p.width(), p.height()));
        let cross = placing.cross + step;
        placing.cross = Point::new(cross.x.clamp(0.0, size.0 as f64 - 1.0), cross.y.clamp(0.0, size.1 as f64 - 1.0));
        return;
    }
    if !work.may_change() {
        return;
    }
    let (desk, lesson_face) = (&*work.desk, work.face());
    let points = desk.points(lesson_face);
    if points.is_empty() {
        let why = no_points(desk, lesson_face);
        work.refuse(why);
        return;
    }
    let (number, shot) = (desk.face, desk.shot);
    let edit = |point: FeaturePoint, by: Vec2| {
        let (_, placed) = points.iter().find(|p| p.0 == point)?;
        let to = placed.at + by;
        // As the file has it, so that what is read again is what was set.
        let at = [(to.x * 10.0).round() / 10.0, (to.y * 10.0).round() / 10.0];
        let after = Spot { at, confidence: 1.0, how: How::Hand };
        Some(Edit::Face(number, FaceEdit::Point { shot, point: point.name(), before: Spot::from(*placed), after }))
    };
    let mut edits: Vec<Edit> = edit(desk.point, step).into_iter().collect();
    let other = desk.point.mirror();
    if desk.both && other != desk.point {
        edits.extend(edit(other, mirrored(step, &points)));
    }
    let of = if shot == Emotion::Neutral { String::new() } else { format!(" of {shot}") };
    let label = match edits.len() {
        2 => format!("move {} and {other}{of}", desk.point),
        _ => format!("move {}{of}", desk.point),
    };
    work.change(Change { label, edits });
}

/// Gives the chosen point of a shot back to the search, which the next calibration is.
fn release_of_shot(work: &mut FaceWork<'_, '_>) {
    if !work.may_change() {
        return;
    }
    let (desk, lesson_face) = (&*work.desk, work.face());
    let (face, shot, point) = (desk.face, desk.shot, desk.point);
    let asked = [Some(point), desk.both.then(|| point.mirror())];
    let set =
        desk.points(lesson_face).into_iter().filter(|(p, placed)| asked.contains(&Some(*p)) && placed.how == How::Hand);
    let edits: Vec<Edit> = set
        .map(|(point, placed)| {
            let before = Spot::from(placed);
            let after = Spot { how: How::Rule, confidence: 0.0, ..before };
            Edit::Face(face, FaceEdit::Point { shot, point: point.name(), before, after })
        })
        .collect();
    if edits.is_empty() {
        work.refuse(format!("{point} was not set by hand"));
    } else if work.change(Change { label: format!("give {point} of {shot} back to the search"), edits }) {
        work.say(format!("{point} of {shot} is free again: C finds it"));
    }
}

fn next_hair(work: &mut FaceWork<'_, '_>) {
    if !work.may_change() {
        return;
    }
    let (desk, lesson_face) = (&*work.desk, work.face());
    let Some(face) = &lesson_face.face else {
        work.refuse("there are no points yet: r finds them");
        return;
    };
    const KINDS: [(HairKind, &str); 5] = [
        (HairKind::Straight, "straight"),
        (HairKind::Wavy, "wavy"),
        (HairKind::Curly, "curly"),
        (HairKind::Shaved, "shaved"),
        (HairKind::Bald, "bald"),
    ];
    let at = KINDS.iter().position(|(k, _)| *k == face.hair.kind).unwrap_or(0);
    let (kind, name) = KINDS[(at + 1) % KINDS.len()];
    let mut after = face.clone();
    after.hair.kind = kind;
    let edit = Edit::Face(desk.face, FaceEdit::Face { before: Some(face.to_toml()), after: Some(after.to_toml()) });
    work.change(Change::one(format!("hair: {name}"), edit));
}

fn ask_point(work: &mut FaceWork<'_, '_>) {
    let (title, help) = ("Go to the point".into(), "a name such as 8.4, 4.4a or h.7");
    work.cx.push(TypingScreen::new(Purpose::Point, title, help, work.desk.point.name()));
}

/// Takes the name of a point that was typed.
pub(super) fn take_point(work: &mut FaceWork<'_, '_>, typed: &str) -> Result<(), String> {
    let (desk, lesson_face) = (&*work.desk, work.face());
    let points = desk.points(lesson_face);
    if points.is_empty() {
        return Err(no_points(desk, lesson_face));
    }
    let names: Vec<String> = points.iter().map(|p| p.0.name()).collect();
    match FeaturePoint::named(typed).filter(|p| points.iter().any(|q| q.0 == *p)) {
        Some(point) => {
            work.desk.point = point;
            Ok(())
        }
        None => {
            let known: Vec<&str> = names.iter().map(String::as_str).collect();
            let near = nearest(typed, &known).map(|n| format!(": did you mean {n}?")).unwrap_or_default();
            Err(format!("this face has no point {typed}{near}"))
        }
    }
}

//! What the keys do on the page of a face: points are moved, found again, placed by hand. Each edit becomes one change
//! of the lesson.

use super::action::Action;
use super::calibrating;
use super::face_desk::{FaceDesk, Placing, mirrored};
use super::job::Job;
use super::line::Line;
use super::overlay::{Overlay, Prompt, Purpose};
use super::state::State;
use crate::disk::nearest;
use crate::face::{Anchors, Face, FeaturePoint, HairKind, How};
use crate::geometry::{Point, Vec2};
use crate::pose::{Emotion, MouthShape};
use crate::project::{Change, Edit, LessonFace, Spot};

/// Puts the face of the chosen clip on the desk; its photo is read in a thread.
pub(super) fn open(state: &mut State) -> Option<Job> {
    let lesson = state.lesson()?;
    let clip = state.editor.as_ref().map_or_else(|| state.open.as_ref().map_or(0, |o| o.chosen), |e| e.clip);
    let entry = match lesson.clips.get(clip) {
        Some(clip) => lesson.manifest.face_of(&clip.entry),
        None => lesson.manifest.faces.first(),
    };
    let Some(number) = entry.and_then(|e| lesson.faces.iter().position(|f| f.entry.name == e.name)) else {
        state.refuse("the lesson has no face: add a [[face]] to lianpu.toml");
        return None;
    };
    let face = &lesson.faces[number];
    if face.photo.is_none() && face.face.is_none() {
        let folder = format!("faces/{}/neutral.png", face.entry.name);
        state.refuse(format!("this face has no photo: put one there as {folder}"));
        return None;
    }
    let drawn = face.face.is_some().then(|| lesson.cartoon_of(face)).transpose();
    let mut desk = FaceDesk::new(number, face.entry.mouths, None);
    match drawn {
        Ok(figure) => desk.figure = figure,
        Err(fault) => desk.remarks.push(format!("the cartoon cannot be drawn: {}", fault.what())),
    }
    let path = face.photo.clone();
    let eyes = eyes(face);
    desk.is_stale = face.is_stale();
    if face.face.is_none() {
        desk.remarks.push("the points have not been found yet: r finds them".into());
    }
    let why = lesson.read_only.clone();
    let root = lesson.root.clone();
    state.face = Some(desk);
    if let Some(why) = why {
        state.say(format!("you can look but not change: {why}"));
    }
    let shot = Emotion::Neutral;
    path.map(|path| Job::Photo { root, face: number, shot, path, eyes, dots: None, stages: true })
}

/// The pupils of a face in its neutral photo.
pub(super) fn eyes(face: &LessonFace) -> Option<[Point; 2]> {
    face.face.as_ref().map(|f| [FeaturePoint::P3_6, FeaturePoint::P3_5].map(|p| f.points[p.index()].at))
}

/// Carries out what is asked for on the page of a face.
pub(super) fn execute(state: &mut State, action: Action) -> Option<Job> {
    let is_shot = state.face.as_ref().is_some_and(|desk| desk.shot != Emotion::Neutral);
    match action {
        Action::Shot(by) => return calibrating::turn(state, by),
        Action::Calibrate => return calibrating::ask(state),
        Action::FindAgain if is_shot => state.refuse("r is for the neutral photo: C finds the points of the shots"),
        Action::Anchors | Action::Stage(_) if is_shot => state.refuse("that is for the neutral photo: [ goes there"),
        Action::Release if is_shot => release_of_shot(state),
        Action::Move(x, y) => shift(state, Vec2::new(f64::from(x), f64::from(y))),
        Action::FindAgain => return find_again(state, None),
        Action::Cross => return place(state),
        Action::Anchors => anchors(state),
        Action::Release => return release(state),
        Action::Hair => next_hair(state),
        Action::GoTo => ask_point(state),
        _ => look(state, action),
    }
    None
}

/// What changes only what is looked at.
fn look(state: &mut State, action: Action) {
    let lesson = state.open.as_ref().and_then(|o| o.lesson.as_ref().ok());
    let (Some(lesson), Some(desk)) = (lesson, &mut state.face) else { return };
    let Some(face) = lesson.faces.get(desk.face) else { return };
    let turned = |at: usize, by: i32, length: usize| (at as i32 + by).rem_euclid(length as i32) as usize;
    match action {
        Action::Point(by) => match desk.points(face) {
            points if points.is_empty() => {
                let why = no_points(desk, face);
                state.refuse(why);
            }
            points => desk.choose(by, &points),
        },
        Action::Both => {
            desk.both = !desk.both;
            let said = if desk.both { "both sides move" } else { "one side moves" };
            state.say(said);
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
        _ => {}
    }
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

/// Whether the lesson can be changed; says why not.
pub(super) fn may_change(state: &mut State) -> bool {
    if state.busy.is_some() {
        state.refuse("the face is still being looked for");
        return false;
    }
    let why = state.lesson().and_then(|l| l.read_only.clone());
    if let Some(why) = &why {
        state.refuse(format!("the lesson cannot be changed: {why}"));
    }
    why.is_none()
}

/// Makes a change and shows it; whether it could be made.
fn change(state: &mut State, change: Change) -> bool {
    let label = change.label.clone();
    let Some(lesson) = state.lesson_mut() else { return false };
    match lesson.change(change) {
        Ok(()) => {
            show(state);
            state.say(label);
            true
        }
        Err(fault) => {
            state.say_fault(&fault);
            false
        }
    }
}

/// Draws the face on the desk as the lesson has it now, and the clip's face where it is the same.
pub(super) fn show(state: &mut State) {
    let Some(lesson) = state.open.as_ref().and_then(|o| o.lesson.as_ref().ok()) else { return };
    if let Some(desk) = &mut state.face
        && let Some(face) = lesson.faces.get(desk.face)
    {
        desk.figure = face.face.is_some().then(|| lesson.cartoon_of(face).ok()).flatten();
        let points = desk.points(face);
        if !points.is_empty() && points.iter().all(|p| p.0 != desk.point) {
            desk.point = FeaturePoint::P3_6;
        }
        desk.is_stale = face.is_stale();
    }
    if let Some(editor) = &mut state.editor
        && let Ok(figure) = lesson.figure_of(&lesson.clips[editor.clip].entry)
    {
        editor.figure = figure;
    }
}

fn on_desk(state: &State) -> Option<(&FaceDesk, &LessonFace)> {
    let desk = state.face.as_ref()?;
    Some((desk, state.lesson()?.faces.get(desk.face)?))
}

/// Moves the chosen point, or the cross.
fn shift(state: &mut State, step: Vec2) {
    if let Some(desk) = &mut state.face
        && let Some(placing) = &mut desk.placing
    {
        let size = desk.photo.as_ref().map_or((0, 0), |p| (p.width(), p.height()));
        let cross = placing.cross + step;
        placing.cross = Point::new(cross.x.clamp(0.0, size.0 as f64 - 1.0), cross.y.clamp(0.0, size.1 as f64 - 1.0));
        return;
    }
    if !may_change(state) {
        return;
    }
    let Some((desk, lesson_face)) = on_desk(state) else { return };
    let points = desk.points(lesson_face);
    if points.is_empty() {
        let why = no_points(desk, lesson_face);
        state.refuse(why);
        return;
    }
    let (number, shot) = (desk.face, desk.shot);
    let edit = |point: FeaturePoint, by: Vec2| {
        let (_, placed) = points.iter().find(|p| p.0 == point)?;
        let to = placed.at + by;
        // As the file has it, so that what is read again is what was set.
        let at = [(to.x * 10.0).round() / 10.0, (to.y * 10.0).round() / 10.0];
        let after = Spot { at, confidence: 1.0, how: How::Hand };
        Some(Edit::Point { face: number, shot, point: point.name(), before: Spot::from(*placed), after })
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
    change(state, Change { label, edits });
}

/// Gives the chosen point back to the search: it is found again with everything else.
fn release(state: &mut State) -> Option<Job> {
    let (desk, lesson_face) = on_desk(state)?;
    let face = lesson_face.face.as_ref()?;
    let points = [Some(desk.point), desk.both.then(|| desk.point.mirror())];
    let free: Vec<FeaturePoint> =
        points.into_iter().flatten().filter(|p| face.placed(*p).is_some_and(|p| p.how == How::Hand)).collect();
    if free.is_empty() {
        state.refuse(format!("{} was not set by hand", desk.point));
        return None;
    }
    let mut kept = face.clone();
    for point in free {
        if let Some(placed) = kept.placed_mut(point) {
            placed.how = How::Rule;
        }
    }
    find(state, Some(kept), None)
}

/// Gives the chosen point of a shot back to the search, which the next calibration is.
fn release_of_shot(state: &mut State) {
    if !may_change(state) {
        return;
    }
    let Some((desk, lesson_face)) = on_desk(state) else { return };
    let (face, shot, point) = (desk.face, desk.shot, desk.point);
    let asked = [Some(point), desk.both.then(|| point.mirror())];
    let set =
        desk.points(lesson_face).into_iter().filter(|(p, placed)| asked.contains(&Some(*p)) && placed.how == How::Hand);
    let edits: Vec<Edit> = set
        .map(|(point, placed)| {
            let before = Spot::from(placed);
            let after = Spot { how: How::Rule, confidence: 0.0, ..before };
            Edit::Point { face, shot, point: point.name(), before, after }
        })
        .collect();
    if edits.is_empty() {
        state.refuse(format!("{point} was not set by hand"));
    } else if change(state, Change { label: format!("give {point} of {shot} back to the search"), edits }) {
        state.say(format!("{point} of {shot} is free again: C finds it"));
    }
}

fn find_again(state: &mut State, anchors: Option<Anchors>) -> Option<Job> {
    let kept = on_desk(state)?.1.face.clone();
    find(state, kept, anchors)
}

/// Starts the search. What a hand has set in `kept` stays.
fn find(state: &mut State, kept: Option<Face>, anchors: Option<Anchors>) -> Option<Job> {
    if !may_change(state) {
        return None;
    }
    let (desk, lesson_face) = on_desk(state)?;
    let Some(path) = lesson_face.photo.clone() else {
        state.refuse("this face has no photo to look at");
        return None;
    };
    let face = desk.face;
    let root = state.lesson()?.root.clone();
    state.busy = Some("looking for the face…".into());
    Some(Job::FindFace { root, face, path, kept: kept.map(Box::new), anchors })
}

/// Takes what a search has found.
pub(super) fn found(state: &mut State, number: usize, face: &Face) {
    let Some(before) = state.lesson().and_then(|l| l.faces.get(number)).map(|f| f.face.as_ref().map(Face::to_toml))
    else {
        return;
    };
    let after = face.to_toml();
    if before.as_ref() == Some(&after) {
        state.say("found the same points again");
        return;
    }
    let edit = Edit::Face { face: number, before, after: Some(after) };
    if change(state, Change::one("find the face's points", edit))
        && let Some(desk) = &mut state.face
    {
        desk.placing = None;
        desk.zoom = 0;
    }
}

/// Begins to place four points by hand, or gives that up.
fn anchors(state: &mut State) {
    if !may_change(state) {
        return;
    }
    let Some(desk) = &mut state.face else { return };
    let Some(photo) = &desk.photo else {
        state.refuse("this face has no photo to look at");
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
fn place(state: &mut State) -> Option<Job> {
    let desk = state.face.as_mut()?;
    let placing = desk.placing.as_mut()?;
    placing.given.push(placing.cross);
    // The next cross starts where its goal usually is.
    if let [left, right, ..] = placing.given[..] {
        let (middle, across) = (left.midpoint(right), right - left);
        let down = Vec2::new(-across.y, across.x);
        placing.cross = middle + down * if placing.given.len() == 2 { 1.1 } else { 1.85 };
    } else {
        placing.cross.x += (desk.photo.as_ref().map_or(0, |p| p.width()) as f64 * 0.16).round();
    }
    let [left_eye, right_eye, mouth, chin] = placing.given[..] else { return None };
    let job = find_again(state, Some(Anchors { left_eye, right_eye, mouth, chin }));
    if let Some(desk) = &mut state.face {
        desk.placing = None;
    }
    job
}

fn next_hair(state: &mut State) {
    if !may_change(state) {
        return;
    }
    let Some((desk, lesson_face)) = on_desk(state) else { return };
    let Some(face) = &lesson_face.face else {
        state.refuse("there are no points yet: r finds them");
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
    let edit = Edit::Face { face: desk.face, before: Some(face.to_toml()), after: Some(after.to_toml()) };
    change(state, Change::one(format!("hair: {name}"), edit));
}

fn ask_point(state: &mut State) {
    let Some(desk) = &state.face else { return };
    state.overlays.push(Overlay::Prompt(Box::new(Prompt {
        purpose: Purpose::Point,
        title: "Go to the point".into(),
        help: "a name such as 8.4, 4.4a or h.7".into(),
        line: Line::new(desk.point.name()),
        fault: None,
    })));
}

/// Takes the name of a point that was typed.
pub(super) fn take_point(state: &mut State, typed: &str) -> Result<(), String> {
    let (desk, lesson_face) = on_desk(state).ok_or("there is no face on the desk")?;
    let points = desk.points(lesson_face);
    if points.is_empty() {
        return Err(no_points(desk, lesson_face));
    }
    let names: Vec<String> = points.iter().map(|p| p.0.name()).collect();
    match FeaturePoint::named(typed).filter(|p| points.iter().any(|q| q.0 == *p)) {
        Some(point) => {
            if let Some(desk) = &mut state.face {
                desk.point = point;
            }
            Ok(())
        }
        None => {
            let known: Vec<&str> = names.iter().map(String::as_str).collect();
            let near = nearest(typed, &known).map(|n| format!(": did you mean {n}?")).unwrap_or_default();
            Err(format!("this face has no point {typed}{near}"))
        }
    }
}

//! Moving and playing: the cursor, the window, the lane.

use super::desk::ClipDesk;
use super::window::Window;
use crate::studio::app::action::Action;
use crate::studio::app::lane::Lane;

/// The message when something is played for the first time. It stands only while it plays.
const SILENT: &str = "playing without sound: this version has none yet";

/// Carries out a movement; whether the action was one.
pub(super) fn execute(desk: &mut ClipDesk<'_, '_>, action: Action) -> bool {
    let clip = &desk.project.lesson.clips[desk.editor.clip];
    let editor = &mut *desk.editor;
    let duration = editor.timeline.duration();
    match action {
        Action::Frames(by) => editor.step(clip, by),
        Action::Centis(by) => editor.go(clip, ((editor.cursor * 100.0).round() + f64::from(by)) / 100.0),
        Action::Screens(by) => editor.go(clip, editor.cursor + f64::from(by) * editor.window.span),
        Action::First => editor.go(clip, 0.0),
        Action::Last => editor.go(clip, f64::MAX),
        Action::Lane(by) => editor.lane = editor.lane.moved(by),
        Action::Zoom(by) => editor.window = editor.window.zoomed(by, editor.cursor, duration),
        Action::Fit => editor.window = Window::whole(duration),
        Action::Syllable(by) if !editor.places.is_empty() => editor.step_syllable_or_place(clip, by),
        Action::Syllable(by) => to_syllable(desk, by),
        Action::Key(by) => to_key(desk, by),
        Action::Play => play(desk),
        _ => return false,
    }
    true
}

fn to_syllable(desk: &mut ClipDesk<'_, '_>, by: i32) {
    let intervals = desk.clip().intervals();
    let Some(last) = intervals.len().checked_sub(1) else {
        desk.refuse("this clip has no syllables: m marks where they are heard, or write its script.txt");
        return;
    };
    // From outside a syllable the selected one is the nearest, which is the first step's goal.
    let here = desk.editor.syllable.unwrap_or(0);
    let start = intervals[here].start;
    let before = by > 0 && desk.editor.cursor < start - 1e-9;
    let after = by < 0 && desk.editor.cursor > start + 1e-9;
    let goal = if before || after { here } else { (here as i32 + by).clamp(0, last as i32) as usize };
    desk.go(intervals[goal].start);
    desk.editor.syllable = Some(goal);
}

fn to_key(desk: &mut ClipDesk<'_, '_>, by: i32) {
    let Lane::Keys(track) = desk.editor.lane else {
        desk.say("keys lie on the lanes below: ↓");
        return;
    };
    let keys = desk.editor.keys_on(desk.clip(), track);
    let is_beyond = |time: &f64| (time - desk.editor.cursor) * f64::from(by) > 1e-6;
    let mut beyond = keys.iter().map(|k| k.time()).filter(is_beyond);
    match if by > 0 { beyond.next() } else { beyond.next_back() } {
        Some(time) => desk.go(time),
        None => {
            desk.say(format!("no more keys on this lane {}", if by > 0 { "after here" } else { "before here" }));
        }
    }
}

fn play(desk: &mut ClipDesk<'_, '_>) {
    let editor = &mut *desk.editor;
    if editor.playing.take().is_some() {
        return;
    }
    editor.playing = Some(if editor.cursor >= editor.last() - 1e-6 { 0.0 } else { editor.cursor });
    if !std::mem::replace(&mut desk.cx.shell.said_silent, true) {
        desk.say(SILENT);
    }
}

/// Lets seconds of playing pass; whether another frame is shown.
pub(super) fn advance(desk: &mut ClipDesk<'_, '_>, seconds: f64) -> bool {
    let clip = &desk.project.lesson.clips[desk.editor.clip];
    let editor = &mut *desk.editor;
    let Some(at) = editor.playing.map(|t| t + seconds) else { return false };
    let before = editor.frame();
    let over = at >= editor.timeline.duration();
    let frame = (at * editor.timeline.fps()).floor() / editor.timeline.fps();
    editor.go(clip, frame);
    editor.playing = (!over).then_some(at);
    let new = over || editor.frame() != before;
    super::footage::missing(desk.project, desk.editor, desk.cx);
    if over {
        desk.cx.shell.message.take_if(|m| m.text == SILENT);
    }
    new
}

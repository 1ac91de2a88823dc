//! The one place where actions are carried out. It changes the state and names the work that a thread is to do; it
//! draws nothing, waits for nothing and knows no terminal.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::editor::Editor;
use super::export::{ExportRequest, Progress};
use super::job::Job;
use super::line::Line;
use super::overlay::{Overlay, Prompt, Purpose};
use super::state::State;
use super::{Action, Place, aligning, edits, face_edits, following, listening, places, tap_desk};
use crate::export::Format;

/// What is said when something is played for the first time. It stands only while it plays.
pub(super) const SILENT: &str = "playing without sound: this version has none yet";

/// Carries out an action. What takes long is left to the jobs that are returned.
#[must_use]
pub fn execute(state: &mut State, action: Action) -> Vec<Job> {
    if !matches!(action, Action::Redraw) {
        state.message = None;
    }
    // Whatever is pressed besides play and zoom takes the author's hand to the cursor: it stops.
    if !matches!(
        action,
        Action::Play | Action::Zoom(_) | Action::Fit | Action::SoundView | Action::Tone | Action::Redraw
    ) && let Some(editor) = &mut state.editor
    {
        editor.playing = None;
    }
    let job = match action {
        Action::Redraw => {
            state.redraw = true;
            None
        }
        Action::Help => {
            tap_desk::pause(state);
            state.overlays.push(Overlay::Help { of: state.place(), scrolled: 0 });
            None
        }
        Action::Choose(by) => {
            choose(state, by);
            None
        }
        Action::Save => save(state).then(|| state.lesson().map(|l| Job::Check(l.root.clone()))).flatten(),
        Action::Quit | Action::Back | Action::Export | Action::Undo | Action::Redo => {
            whole(state, action);
            None
        }
        Action::Open => return open(state),
        Action::SoundView | Action::Tone => {
            match action {
                Action::SoundView => state.view = state.view.next(),
                _ => state.tone = !state.tone,
            }
            return listening::missing(state);
        }
        Action::Face => face_edits::open(state),
        _ if !state.overlays.is_empty() => on_top(state, action),
        Action::Align => aligning::ask(state),
        Action::Follow => following::ask(state),
        Action::Video => following::show(state),
        _ if state.face.is_some() => face_edits::execute(state, action),
        _ if state.place() == Place::Tapping => tap_desk::execute(state, action),
        Action::Places => places::mark(state),
        _ => {
            on_timeline(state, action);
            None
        }
    };
    // The frame of the video follows the cursor.
    job.into_iter().chain(following::missing(state)).collect()
}

/// What concerns the whole lesson or the way one came.
fn whole(state: &mut State, action: Action) {
    match action {
        Action::Quit => leave(state, Action::Quit),
        Action::Back => back(state),
        Action::Export => ask_export(state),
        _ => edits::retrace(state, action),
    }
}

fn choose(state: &mut State, by: i32) {
    let moved = |at: usize, length: usize| (at as i32 + by).clamp(0, length.saturating_sub(1) as i32) as usize;
    if let Some(Overlay::Doubts { list, chosen }) = state.overlays.last_mut() {
        *chosen = moved(*chosen, list.len());
        return;
    }
    match &mut state.open {
        Some(open) => open.chosen = moved(open.chosen, open.lesson.as_ref().map_or(0, |l| l.clips.len())),
        None => state.chosen = moved(state.chosen, state.lessons.len()),
    }
}

fn open(state: &mut State) -> Vec<Job> {
    match state.screen() {
        Place::Projects => {
            let Some(listed) = state.lessons.get(state.chosen) else { return Vec::new() };
            state.busy = Some(format!("opening {}…", listed.name));
            vec![Job::Open(listed.root.clone())]
        }
        Place::Lesson => {
            let Some((clip, outline)) = open_clip(state) else { return Vec::new() };
            let mut jobs: Vec<Job> = outline.into_iter().collect();
            jobs.extend(listening::missing(state));
            jobs.extend(aligning::of_itself(state, clip));
            jobs.extend(following::of_itself(state, clip));
            jobs
        }
        _ => Vec::new(),
    }
}

/// Puts the chosen clip on the desk. Its sound goes to a thread that makes the outline.
fn open_clip(state: &mut State) -> Option<(usize, Option<Job>)> {
    let chosen = state.open.as_ref()?.chosen;
    let figure = {
        let lesson = state.lesson()?;
        lesson.figure_of(&lesson.clips.get(chosen)?.entry)
    };
    let figure = match figure {
        Ok(figure) => figure,
        Err(fault) => {
            state.say_fault(&fault);
            return None;
        }
    };
    following::forget(state);
    let mut editor = Editor::new(state.lesson()?, chosen, figure);
    if let Some(left) = state.open.as_ref()?.left.get(&chosen) {
        editor.go_back(&state.lesson()?.clips[chosen], *left);
    }
    let sound = state.lesson()?.clips[chosen].sound.clone();
    if sound.is_none() {
        editor.loudest = Some(0.0);
    }
    let why = state.lesson()?.read_only.clone();
    state.editor = Some(editor);
    if let Some(why) = why {
        state.say(format!("you can look but not change: {why}"));
    }
    let root = state.lesson()?.root.clone();
    Some((chosen, sound.map(|sound| Job::Outline { root, clip: chosen, sound })))
}

fn back(state: &mut State) {
    match state.screen() {
        Place::Timeline if state.editor.as_ref().is_some_and(|e| e.mark.is_some()) => {
            if let Some(editor) = &mut state.editor {
                editor.mark = None;
            }
            state.say("the mark is gone");
        }
        Place::Face => {
            let placing = state.face.as_mut().and_then(|desk| desk.placing.take());
            if placing.is_none() {
                state.face = None;
            }
        }
        // The changes stay with the lesson; they are asked about when the lesson is left.
        Place::Timeline => {
            if let (Some(editor), Some(open)) = (state.editor.take(), &mut state.open) {
                open.left.insert(editor.clip, editor.left());
            }
        }
        _ => leave(state, Action::Back),
    }
}

/// Leaves the lesson or the studio, after a question where something would be lost.
fn leave(state: &mut State, by: Action) {
    if state.overlays.iter().any(|o| matches!(o, Overlay::Export { .. })) {
        state.refuse("an export is running: Esc stops it");
        return;
    }
    state.overlays.clear();
    if !tap_desk::leave(state) {
        return;
    }
    if state.is_unsaved() {
        state.overlays.push(Overlay::Confirm(by));
        return;
    }
    go(state, by);
}

fn go(state: &mut State, by: Action) {
    state.overlays.clear();
    match by {
        Action::Quit => state.leaving = true,
        _ => {
            state.face = None;
            state.editor = None;
            state.open = None;
            state.footage = Default::default();
        }
    }
}

/// Writes the lesson's files; whether any of them changed.
pub(super) fn save(state: &mut State) -> bool {
    let Some(lesson) = state.lesson_mut() else { return false };
    let done = lesson.save();
    let any = done.as_ref().is_ok_and(|written| !written.is_empty());
    match done {
        Ok(_) if !any => state.say("saved: nothing had changed"),
        Ok(written) => {
            let names: Vec<String> =
                written.iter().filter_map(|p| p.file_name()).map(|n| n.to_string_lossy().into_owned()).collect();
            state.say(format!("saved {}", names.join(", ")));
        }
        Err(fault) => state.say_fault(&fault),
    }
    any
}

fn ask_export(state: &mut State) {
    let Some(lesson) = state.lesson() else { return };
    let what = state.clip().map_or_else(|| lesson.manifest.title.clone(), |c| c.entry.name.clone());
    state.overlays.push(Overlay::Prompt(Box::new(Prompt {
        purpose: Purpose::Export,
        title: format!("Export {what} as"),
        help: format!("one or more of {}; what is unsaved is saved first", known_formats()).into(),
        line: Line::new("png"),
        fault: None,
    })));
}

/// What the things on top understand.
fn on_top(state: &mut State, action: Action) -> Option<Job> {
    match (state.overlays.last_mut()?, action) {
        (Overlay::Export { cancel, .. }, Action::Close) => {
            cancel.store(true, Ordering::Relaxed);
            state.say("stopping the export…");
        }
        (Overlay::Help { scrolled, .. } | Overlay::Notes { scrolled, .. }, Action::Scroll(by)) => {
            *scrolled = (*scrolled as i32 + by).clamp(0, 100) as usize;
        }
        (Overlay::Doubts { .. }, Action::GoThere) => aligning::go_there(state),
        (Overlay::Confirm(by), Action::DropAndGo) => {
            let by = *by;
            state.face = None;
            state.editor = None;
            match state.open.take().map(|open| open.lesson) {
                Some(Ok(lesson)) => match lesson.discard() {
                    Ok(()) => go(state, by),
                    Err(fault) => state.say_fault(&fault),
                },
                _ => go(state, by),
            }
        }
        (Overlay::Confirm(by), Action::KeepAndGo) => {
            let by = *by;
            go(state, by);
        }
        (Overlay::Confirm(by), Action::SaveAndGo) => {
            let by = *by;
            save(state);
            match state.is_unsaved() {
                false => go(state, by),
                // What went wrong stays on the screen, and so do the changes.
                true => state.overlays.clear(),
            }
        }
        (Overlay::Prompt(prompt), action) => match action {
            Action::Accept => return accept(state),
            Action::Close => {
                state.overlays.pop();
            }
            Action::Type(letter) => prompt.line.put(letter.encode_utf8(&mut [0; 4])),
            Action::Rub => prompt.line.rub(),
            Action::RubAhead => prompt.line.rub_ahead(),
            Action::RubLine => prompt.line.rub_line(),
            Action::Caret(by) => prompt.line.move_caret(by),
            _ => {}
        },
        (_, Action::Close) => {
            state.overlays.pop();
        }
        _ => {}
    }
    None
}

/// Takes what was typed, or says in the prompt what is wrong with it.
fn accept(state: &mut State) -> Option<Job> {
    let Some(Overlay::Prompt(mut prompt)) = state.overlays.pop() else { return None };
    if prompt.purpose == Purpose::Export {
        return match formats(prompt.line.text()) {
            Ok(formats) => start_export(state, formats),
            Err(fault) => {
                prompt.fault = Some(fault);
                state.overlays.push(Overlay::Prompt(prompt));
                None
            }
        };
    }
    if prompt.purpose == Purpose::Point {
        if let Err(fault) = face_edits::take_point(state, prompt.line.text().trim()) {
            prompt.fault = Some(fault);
            state.overlays.push(Overlay::Prompt(prompt));
        }
        return None;
    }
    if let Err(fault) = edits::take(state, prompt.purpose, prompt.line.text().trim()) {
        prompt.fault = Some(fault);
        state.overlays.push(Overlay::Prompt(prompt));
    }
    None
}

fn known_formats() -> String {
    Format::ALL.map(Format::name).join(" ")
}

/// The formats that were typed, with a comma between them; what is none is told while it can still be mended.
fn formats(typed: &str) -> Result<Vec<Format>, String> {
    let words: Vec<String> = typed
        .split([' ', ',', '，', '、', ';'])
        .filter(|word| !word.is_empty())
        .map(|word| word.trim_start_matches('.').to_lowercase())
        .collect();
    if words.is_empty() {
        return Err(format!("type one or more of {}", known_formats()));
    }
    match words.iter().find(|word| Format::ALL.iter().all(|format| format.name() != word.as_str())) {
        Some(word) => Err(format!("`{word}` is no format: {}", known_formats())),
        None => Ok(words.iter().filter_map(|word| word.parse().ok()).collect()),
    }
}

fn start_export(state: &mut State, formats: Vec<Format>) -> Option<Job> {
    if state.is_unsaved() {
        save(state);
        if state.is_unsaved() {
            return None;
        }
    }
    let request = ExportRequest {
        project: state.lesson()?.root.clone(),
        clip: state.clip().map(|c| c.entry.name.clone()),
        formats,
    };
    let cancel = Arc::new(AtomicBool::new(false));
    state.overlays.push(Overlay::Export { progress: Progress::default(), cancel: Arc::clone(&cancel) });
    Some(Job::Export { request, cancel })
}

/// What the timeline understands.
fn on_timeline(state: &mut State, action: Action) {
    if edits::execute(state, action) {
        return;
    }
    let clips = state.open.as_ref().and_then(|o| o.lesson.as_ref().ok()).map(|l| &l.clips);
    let (Some(clips), Some(editor)) = (clips, &mut state.editor) else { return };
    let clip = &clips[editor.clip];
    let duration = editor.timeline.duration();
    match action {
        Action::Frames(by) => editor.step(clip, by),
        Action::Centis(by) => editor.go(clip, ((editor.cursor * 100.0).round() + f64::from(by)) / 100.0),
        Action::Screens(by) => editor.go(clip, editor.cursor + f64::from(by) * editor.window.span),
        Action::First => editor.go(clip, 0.0),
        Action::Last => editor.go(clip, f64::MAX),
        Action::Lane(by) => editor.lane = editor.lane.moved(by),
        Action::Zoom(by) => editor.window = editor.window.zoomed(by, editor.cursor, duration),
        Action::Fit => editor.window = super::window::Window::whole(duration),
        Action::Syllable(by) if !editor.places.is_empty() => editor.to_syllable_or_place(clip, by),
        Action::Syllable(by) => {
            let Some(last) = clip.intervals().len().checked_sub(1) else {
                state.refuse("this clip has no syllables: m marks where they are heard, or write its script.txt");
                return;
            };
            // From outside a syllable the selected one is the nearest, which is the first step's goal.
            let here = editor.syllable.unwrap_or(0);
            let start = clip.intervals()[here].start;
            let before = by > 0 && editor.cursor < start - 1e-9;
            let after = by < 0 && editor.cursor > start + 1e-9;
            let goal = if before || after { here } else { (here as i32 + by).clamp(0, last as i32) as usize };
            editor.go(clip, clip.intervals()[goal].start);
            editor.syllable = Some(goal);
        }
        Action::Doubt(_) | Action::Doubts => aligning::look(state, action),
        Action::Tap => tap_desk::open(state),
        Action::Key(by) => {
            let super::Lane::Keys(track) = editor.lane else {
                state.say("keys lie on the lanes below: ↓");
                return;
            };
            let keys = editor.keys_on(clip, track);
            let mut beyond = keys.iter().map(|k| k.time()).filter(|t| {
                let away = t - editor.cursor;
                away * f64::from(by) > 1e-6
            });
            match if by > 0 { beyond.next() } else { beyond.next_back() } {
                Some(time) => editor.go(clip, time),
                None => state
                    .say(format!("no more keys on this lane {}", if by > 0 { "after here" } else { "before here" })),
            }
        }
        Action::Play => match editor.playing {
            Some(_) => editor.playing = None,
            None => {
                let from = if editor.cursor >= editor.last() - 1e-6 { 0.0 } else { editor.cursor };
                editor.playing = Some(from);
                if !state.said_silent {
                    state.said_silent = true;
                    state.say(SILENT);
                }
            }
        },
        _ => {}
    }
}

//! Edits of a clip: boundaries, readings, keys, stretches. Each becomes one change of the lesson, with its inverse, in
//! its list for undo and in its journal.

use super::action::{Action, Nudge};
use super::editor::{Editor, LaneKey, value_text};
use super::line::Line;
use super::overlay::{Overlay, Prompt, Purpose};
use super::state::State;
use super::{Lane, boundary, places, typed};
use crate::project::{Change, Clip, Edit};
use crate::script::{Lang, System, reading};
use crate::timeline::{Key, KeyValue, Range, Track};

/// Carries out an edit or asks for what it needs; whether the action was one.
pub(super) fn execute(state: &mut State, action: Action) -> bool {
    match action {
        Action::Start(by) => nudge(state, by, (boundary::Side::Start, false)),
        Action::End(by) => nudge(state, by, (boundary::Side::End, false)),
        Action::Gap(-1) => nudge(state, Nudge::Centis(1), (boundary::Side::Start, true)),
        Action::Gap(_) => nudge(state, Nudge::Centis(-1), (boundary::Side::End, true)),
        Action::Reading => ask_reading(state),
        Action::Edit => edit(state),
        Action::Add => add(state),
        Action::MoveKey(by) => move_key(state, by),
        Action::Delete => delete_key(state),
        Action::Mark => mark(state),
        Action::DeleteRange => delete_range(state),
        _ => return false,
    }
    true
}

const NO_SYLLABLES: &str = "this clip has no syllables: m marks where they are heard, or write its script.txt";

/// Makes a change and shows it. What cannot be done is said.
pub(super) fn change(state: &mut State, change: Change) -> bool {
    let label = change.label.clone();
    let Some(lesson) = state.lesson_mut() else { return false };
    match lesson.change(change) {
        Ok(()) => {
            rebuild(state);
            state.say(label);
            true
        }
        Err(fault) => {
            state.say_fault(&fault);
            false
        }
    }
}

fn rebuild(state: &mut State) {
    let lesson = state.open.as_ref().and_then(|o| o.lesson.as_ref().ok());
    if let (Some(lesson), Some(editor)) = (lesson, &mut state.editor) {
        editor.rebuild(lesson);
    }
}

/// Undoes or makes again.
pub(super) fn retrace(state: &mut State, action: Action) {
    if state.face.is_some() && state.busy.is_some() {
        state.refuse("the face is still being looked for");
        return;
    }
    let Some(lesson) = state.lesson_mut() else { return };
    let (done, word) = match action {
        Action::Redo => (lesson.redo(), "again"),
        _ => (lesson.undo(), "undone"),
    };
    match done {
        Ok(Some(label)) => {
            rebuild(state);
            super::face_edits::show(state);
            state.say(format!("{word}: {label}"));
        }
        Ok(None) if action == Action::Redo => state.say("nothing to make again"),
        Ok(None) => state.say("nothing to undo"),
        Err(fault) => state.say_fault(&fault),
    }
}

fn nudge(state: &mut State, by: Nudge, side: (boundary::Side, bool)) {
    let (Some(editor), Some(clip)) = (&state.editor, state.clip()) else { return };
    let Some(syllable) = editor.syllable else {
        state.refuse(NO_SYLLABLES);
        return;
    };
    let seconds = match by {
        Nudge::Centis(n) => f64::from(n) * 0.01,
        Nudge::Frames(n) => f64::from(n) / editor.timeline.fps(),
    };
    match boundary::moved(clip, editor.clip, syllable, side, seconds) {
        Ok(moved) => {
            change(state, moved);
            if let Some(editor) = &mut state.editor {
                editor.syllable = Some(syllable);
            }
        }
        Err(why) => state.refuse(why),
    }
}

pub(super) fn prompt(state: &mut State, purpose: Purpose, title: String, help: &'static str, text: String) {
    if let Some(why) = state.lesson().and_then(|l| l.read_only.clone()) {
        state.refuse(format!("the lesson cannot be changed: {why}"));
        return;
    }
    let line = Line::new(text);
    state.overlays.push(Overlay::Prompt(Box::new(Prompt { purpose, title, help: help.into(), line, fault: None })));
}

fn ask_reading(state: &mut State) {
    let (Some(editor), Some(clip)) = (&state.editor, state.clip()) else { return };
    let Some((index, syllable)) = editor.syllable.and_then(|i| Some((i, clip.syllables.get(i)?))) else {
        state.refuse(NO_SYLLABLES);
        return;
    };
    if syllable.lang == Lang::En {
        state.refuse(format!(
            "`{}` is English: its sounds come from the dictionary; set its mouth with keys on the mouth lane",
            syllable.text
        ));
        return;
    }
    let (title, text) = (format!("How is {} read?", syllable.text), syllable.pinyin.clone());
    prompt(state, Purpose::Reading { syllable: index }, title, READING_HELP, text);
}

const READING_HELP: &str = "one syllable: hang2, háng or ㄏㄤˊ; empty: as the dictionary has it";

/// The key at the cursor where there is one, else the reading or the edit of a stretch, else a new key.
fn edit(state: &mut State) {
    if state.editor.as_ref().is_some_and(|e| e.lane == Lane::Syllables) && places::ask(state) {
        return;
    }
    let (Some(editor), Some(clip)) = (&state.editor, state.clip()) else { return };
    match (editor.lane, editor.key_here(clip)) {
        (Lane::Syllables, _) => ask_reading(state),
        (Lane::Keys(Track::Emotion), None) => match range_here(editor, clip) {
            Some((at, old)) => {
                let title = format!("The edit from {:.2} to {:.2} s", old.from, old.to);
                let purpose = Purpose::Range { from: old.from, to: old.to, old: Some((at, old)) };
                prompt(state, purpose, title, typed::RANGE_HELP, typed::range_text(&old));
            }
            None => ask_key(state, None),
        },
        (_, key) => ask_key(state, key),
    }
}

/// A new key at the cursor. Where the author has one at that very time it is changed instead.
fn add(state: &mut State) {
    let (Some(editor), Some(clip)) = (&state.editor, state.clip()) else { return };
    let there = editor.key_here(clip).filter(|k| (k.time() - editor.cursor).abs() < 1e-3);
    ask_key(state, there);
}

fn ask_key(state: &mut State, old: Option<LaneKey>) {
    let Some(editor) = &state.editor else { return };
    let Lane::Keys(track) = editor.lane else {
        state.say("choose a lane for the key first: ↓");
        return;
    };
    let (time, own, replaces, text) = match old {
        Some(LaneKey::Own(key)) => (key.time, Some(key), key.replaces, typed::key_text(&key)),
        Some(LaneKey::Spoken(key)) => {
            (key.time, None, Some(key.time), key.shape.map_or("rest".into(), |s| s.to_string()))
        }
        // What is there already: a key that changes nothing yet is the start of one that does.
        None => (editor.cursor, None, None, value_text(&value_here(editor, track)).trim_end_matches(" s").to_owned()),
    };
    let title = match old {
        Some(LaneKey::Own(_)) => format!("The {} key at {time:.3} s", editor.lane.name()),
        Some(LaneKey::Spoken(_)) => format!("Change the mouth that speech has at {time:.3} s"),
        None => format!("A new {} key at {time:.3} s", editor.lane.name()),
    };
    prompt(state, Purpose::Key { track, time, old: own, replaces }, title, typed::key_help(track), text);
}

/// What a track has at the cursor.
fn value_here(editor: &Editor, track: Track) -> KeyValue {
    let pose = editor.pose();
    match track {
        Track::Emotion => KeyValue::Emotion(pose.ratios),
        Track::Mouth => KeyValue::Mouth(pose.shape),
        Track::Blink => KeyValue::Blink(0.24),
        Track::Gaze => KeyValue::Gaze(pose.gaze),
        Track::Head => KeyValue::Head(pose.head),
    }
}

/// Does what a typed line asks for.
pub(super) fn take(state: &mut State, purpose: Purpose, text: &str) -> Result<(), String> {
    let number = state.editor.as_ref().map_or(0, |e| e.clip);
    match purpose {
        Purpose::Reading { syllable } => take_reading(state, number, syllable, text),
        Purpose::Key { track, time, old, replaces } => {
            let key = Key { replaces, ..typed::key(track, text, time)? };
            let mut edits: Vec<Edit> = old.map(|key| Edit::RemoveKey { clip: number, key }).into_iter().collect();
            edits.push(Edit::AddKey { clip: number, key });
            let mut label = format!("{} {} at {time:.2} s", track_name(track), typed::key_text(&key));
            // Before its first key a track has that key's value: an emotion meant for here colours all that came before.
            let first = track == Track::Emotion && state.clip().is_some_and(is_first_emotion);
            if first && state.clip().is_some_and(|c| c.record.is_some()) {
                label.push_str(", for this instant; add another, and the record gives way from one to the other");
            } else if first && time > 1e-6 {
                label.push_str(", and from the start too; add `neutral` at 0 to begin otherwise");
            }
            change(state, Change { label, edits });
            Ok(())
        }
        Purpose::Range { from, to, old } => {
            let range = typed::range(text, from, to)?;
            let at = old.map_or_else(|| state.clip().map_or(0, |c| c.score.ranges.len()), |(at, _)| at);
            let label = format!("{} from {from:.2} to {to:.2} s", typed::range_text(&range));
            let removed = old.map(|(at, range)| Edit::RemoveRange { clip: number, at, range });
            let edits = removed.into_iter().chain([Edit::AddRange { clip: number, at, range }]).collect();
            if change(state, Change { label, edits })
                && let Some(editor) = &mut state.editor
            {
                editor.mark = None;
            }
            Ok(())
        }
        Purpose::Words => places::take(state, text),
        Purpose::Export | Purpose::Point => Ok(()),
    }
}

/// Whether an emotion key would be the clip's first.
fn is_first_emotion(clip: &Clip) -> bool {
    clip.score.keys.iter().all(|k| k.value.track() != Track::Emotion)
}

fn take_reading(state: &mut State, number: usize, index: usize, text: &str) -> Result<(), String> {
    let found = state.clip().and_then(|c| Some((c.syllables.get(index)?, c.intervals().get(index)?)));
    let Some((syllable, interval)) = found else { return Ok(()) };
    let (written, is_now) = (syllable.text.clone(), syllable.reading());
    let before = interval.label.clone();
    let (after, label) = match text {
        "" => (written.clone(), format!("{written} read as usual")),
        _ => {
            let read = reading(text, System::Auto).ok_or_else(|| {
                format!(
                    "`{text}` is no one syllable of Mandarin: type Pinyin with a tone, as hang2, or Zhuyin, as ㄏㄤˊ"
                )
            })?;
            let tone = if read.tone().is_none() { ", neutral tone or no tone given" } else { "" };
            // What the prompt came with, taken as it is, is no change.
            let after = if Some(read) == is_now { before.clone() } else { format!("{written}{{{read}}}") };
            (after, format!("{written} read {read}{tone}"))
        }
    };
    if after == before {
        state.say("it is read so already");
        return Ok(());
    }
    change(state, Change::one(label, Edit::Label { clip: number, index, before, after }));
    Ok(())
}

fn move_key(state: &mut State, by: i32) {
    let Some((number, found)) = key_here(state) else { return };
    let Some(editor) = &state.editor else { return };
    let seconds = f64::from(by) / editor.timeline.fps();
    let time = (found.time() + seconds).clamp(0.0, editor.last());
    let (old, key) = match found {
        LaneKey::Own(key) => (Some(key), Key { time, ..key }),
        // Moving a key of speech makes it the author's, and speech's own gives way to it.
        LaneKey::Spoken(key) => (None, Key { replaces: Some(key.time), ..Key::new(time, KeyValue::Mouth(key.shape)) }),
    };
    if (key.time - found.time()).abs() < 1e-9 {
        state.refuse("the clip ends here");
        return;
    }
    let mut edits: Vec<Edit> = old.map(|key| Edit::RemoveKey { clip: number, key }).into_iter().collect();
    edits.push(Edit::AddKey { clip: number, key });
    let label = format!("{} key to {time:.3} s", track_name(key.value.track()));
    if change(state, Change { label, edits }) {
        go(state, time);
    }
}

/// The key at the cursor with the clip's number; where there is none, that is said.
fn key_here(state: &mut State) -> Option<(usize, LaneKey)> {
    let (editor, clip) = (state.editor.as_ref()?, state.clip()?);
    let found = editor.key_here(clip).map(|key| (editor.clip, key));
    if found.is_none() {
        let how = match editor.lane {
            Lane::Syllables => "keys lie on the lanes below: ↓",
            Lane::Keys(_) => "no key here: n and p go to keys, a adds one",
        };
        state.say(how);
    }
    found
}

fn go(state: &mut State, time: f64) {
    let clips = state.open.as_ref().and_then(|o| o.lesson.as_ref().ok()).map(|l| &l.clips);
    if let (Some(clips), Some(editor)) = (clips, &mut state.editor) {
        editor.go(&clips[editor.clip], time);
    }
}

fn delete_key(state: &mut State) {
    match key_here(state) {
        Some((clip, LaneKey::Own(key))) => {
            let label = format!("{} key at {:.2} s deleted", track_name(key.value.track()), key.time);
            change(state, Change::one(label, Edit::RemoveKey { clip, key }));
        }
        Some((_, LaneKey::Spoken(_))) => {
            state.refuse("this key is speech's: Enter changes it, r changes how the syllable is read");
        }
        None => {}
    }
}

fn mark(state: &mut State) {
    let (Some(editor), Some(clip)) = (&mut state.editor, &state.open) else { return };
    let has_record = clip.lesson.as_ref().is_ok_and(|l| l.clips[editor.clip].record.is_some());
    match editor.mark {
        _ if !has_record => {
            state.refuse("a stretch is an edit of a ratio record, and this clip has none: use emotion keys");
        }
        None => {
            editor.mark = Some(editor.cursor);
            state.say("marked: move to the other end and press v again; Esc unmarks");
        }
        Some(mark) if (mark - editor.cursor).abs() < 0.5 / editor.timeline.fps() => {
            editor.mark = None;
            state.say("the mark is gone");
        }
        Some(mark) => {
            let (from, to) = (mark.min(editor.cursor), mark.max(editor.cursor));
            let title = format!("Change the ratios from {from:.2} to {to:.2} s");
            prompt(state, Purpose::Range { from, to, old: None }, title, typed::RANGE_HELP, String::new());
        }
    }
}

fn delete_range(state: &mut State) {
    let (Some(editor), Some(clip)) = (&state.editor, state.clip()) else { return };
    match range_here(editor, clip) {
        Some((at, range)) => {
            let label = format!("{} from {:.2} s deleted", typed::range_text(&range), range.from);
            change(state, Change::one(label, Edit::RemoveRange { clip: editor.clip, at, range }));
        }
        None => state.say("no edited stretch at the cursor"),
    }
}

/// The last edit of a stretch that the cursor is in, with its place among the edits.
fn range_here(editor: &Editor, clip: &Clip) -> Option<(usize, Range)> {
    let holds = |r: &Range| (r.from - 1e-9..=r.to + 1e-9).contains(&editor.cursor);
    clip.score.ranges.iter().rposition(holds).map(|at| (at, clip.score.ranges[at]))
}

/// What is said of the edited stretch at the cursor, for the panel beside the face.
pub(super) fn range_line(editor: &Editor, clip: &Clip) -> Option<String> {
    let (_, range) = range_here(editor, clip)?;
    Some(format!("edit {:.2} to {:.2} s: {}", range.from, range.to, typed::range_text(&range)))
}

const fn track_name(track: Track) -> &'static str {
    Lane::Keys(track).name()
}

/// What is said of the key at the cursor, for the panel beside the face.
pub(super) fn key_line(editor: &Editor, clip: &Clip) -> Option<String> {
    match editor.key_here(clip)? {
        LaneKey::Own(key) => Some(format!("{} key: {}", editor.lane.name(), typed::key_text(&key))),
        LaneKey::Spoken(key) => {
            let shape = key.shape.map_or("rest".into(), |s| s.to_string());
            Some(format!("mouth key of speech: {shape}"))
        }
    }
}

//! Edits of a clip: boundaries, readings, keys, stretches. Each becomes one change of the lesson, with its inverse, in
//! its list for undo and in its journal.

use super::desk::ClipDesk;
use super::editor::{Editor, LaneKey, value_text};
use super::{boundary, places, typed};
use crate::project::{Change, Clip, ClipEdit, Edit};
use crate::script::{Lang, System, reading};
use crate::studio::app::action::{Action, Nudge};
use crate::studio::app::lane::Lane;
use crate::studio::widgets::prompt::Purpose;
use crate::timeline::{Key, KeyValue, Range, Track};

/// Carries out an edit or asks for what it needs; whether the action was one.
pub(super) fn execute(desk: &mut ClipDesk<'_, '_>, action: Action) -> bool {
    match action {
        Action::Start(by) => nudge(desk, by, (boundary::Side::Start, false)),
        Action::End(by) => nudge(desk, by, (boundary::Side::End, false)),
        Action::Gap(-1) => nudge(desk, Nudge::Centis(1), (boundary::Side::Start, true)),
        Action::Gap(_) => nudge(desk, Nudge::Centis(-1), (boundary::Side::End, true)),
        Action::Reading => ask_reading(desk),
        Action::Edit => edit(desk),
        Action::Add => add(desk),
        Action::MoveKey(by) => move_key(desk, by),
        Action::Delete => delete_key(desk),
        Action::Mark => mark(desk),
        Action::DeleteRange => delete_range(desk),
        _ => return false,
    }
    true
}

const NO_SYLLABLES: &str = "this clip has no syllables: m marks where they are heard, or write its script.txt";

fn nudge(desk: &mut ClipDesk<'_, '_>, by: Nudge, side: (boundary::Side, bool)) {
    let (editor, clip) = (&*desk.editor, desk.clip());
    let Some(syllable) = editor.syllable else {
        desk.refuse(NO_SYLLABLES);
        return;
    };
    let seconds = match by {
        Nudge::Centis(n) => f64::from(n) * 0.01,
        Nudge::Frames(n) => f64::from(n) / editor.timeline.fps(),
    };
    match boundary::moved(clip, editor.clip, syllable, side, seconds) {
        Ok(moved) => {
            desk.change(moved);
            desk.editor.syllable = Some(syllable);
        }
        Err(why) => desk.refuse(why),
    }
}

fn ask_reading(desk: &mut ClipDesk<'_, '_>) {
    let (editor, clip) = (&*desk.editor, desk.clip());
    let Some((index, syllable)) = editor.syllable.and_then(|i| Some((i, clip.syllables.get(i)?))) else {
        desk.refuse(NO_SYLLABLES);
        return;
    };
    if syllable.lang == Lang::En {
        desk.refuse(format!(
            "`{}` is English: its sounds come from the dictionary; set its mouth with keys on the mouth lane",
            syllable.text
        ));
        return;
    }
    let (title, text) = (format!("How is {} read?", syllable.text), syllable.pinyin.clone());
    desk.prompt(Purpose::Reading { syllable: index }, title, READING_HELP, text);
}

const READING_HELP: &str = "one syllable: hang2, háng or ㄏㄤˊ; empty: as the dictionary has it";

/// The key at the cursor where there is one, else the reading or the edit of a stretch, else a new key.
fn edit(desk: &mut ClipDesk<'_, '_>) {
    if desk.editor.lane == Lane::Syllables && places::ask(desk) {
        return;
    }
    let (editor, clip) = (&*desk.editor, desk.clip());
    match (editor.lane, editor.key_here(clip)) {
        (Lane::Syllables, _) => ask_reading(desk),
        (Lane::Keys(Track::Emotion), None) => match range_here(editor, clip) {
            Some((at, old)) => {
                let title = format!("The edit from {:.2} to {:.2} s", old.from, old.to);
                let purpose = Purpose::Range { from: old.from, to: old.to, old: Some((at, old)) };
                desk.prompt(purpose, title, typed::RANGE_HELP, typed::range_text(&old));
            }
            None => ask_key(desk, None),
        },
        (_, key) => ask_key(desk, key),
    }
}

/// A new key at the cursor. Where the author has one at that very time it is changed instead.
fn add(desk: &mut ClipDesk<'_, '_>) {
    let (editor, clip) = (&*desk.editor, desk.clip());
    let there = editor.key_here(clip).filter(|k| (k.time() - editor.cursor).abs() < 1e-3);
    ask_key(desk, there);
}

fn ask_key(desk: &mut ClipDesk<'_, '_>, old: Option<LaneKey>) {
    let editor = &*desk.editor;
    let Lane::Keys(track) = editor.lane else {
        desk.say("choose a lane for the key first: ↓");
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
    desk.prompt(Purpose::Key { track, time, old: own, replaces }, title, typed::key_help(track), text);
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
pub(super) fn take(desk: &mut ClipDesk<'_, '_>, purpose: Purpose, text: &str) -> Result<(), String> {
    let number = desk.editor.clip;
    match purpose {
        Purpose::Reading { syllable } => take_reading(desk, number, syllable, text),
        Purpose::Key { track, time, old, replaces } => {
            let key = Key { replaces, ..typed::key(track, text, time)? };
            let mut edits: Vec<Edit> =
                old.map(|key| Edit::Clip(number, ClipEdit::RemoveKey { key })).into_iter().collect();
            edits.push(Edit::Clip(number, ClipEdit::AddKey { key }));
            let mut label = format!("{} {} at {time:.2} s", track_name(track), typed::key_text(&key));
            // Before its first key a track has that key's value: an emotion meant for here colours all that came before.
            let first = track == Track::Emotion && is_first_emotion(desk.clip());
            if first && desk.clip().record.is_some() {
                label.push_str(", for this instant; add another, and the record gives way from one to the other");
            } else if first && time > 1e-6 {
                label.push_str(", and from the start too; add `neutral` at 0 to begin otherwise");
            }
            desk.change(Change { label, edits });
            Ok(())
        }
        Purpose::Range { from, to, old } => {
            let range = typed::range(text, from, to)?;
            let at = old.map_or_else(|| desk.clip().score.ranges.len(), |(at, _)| at);
            let label = format!("{} from {from:.2} to {to:.2} s", typed::range_text(&range));
            let removed = old.map(|(at, range)| Edit::Clip(number, ClipEdit::RemoveRange { at, range }));
            let edits = removed.into_iter().chain([Edit::Clip(number, ClipEdit::AddRange { at, range })]).collect();
            if desk.change(Change { label, edits }) {
                desk.editor.mark = None;
            }
            Ok(())
        }
        Purpose::Words => places::take(desk, text),
        Purpose::Export | Purpose::Point => Ok(()),
    }
}

/// Whether an emotion key would be the clip's first.
fn is_first_emotion(clip: &Clip) -> bool {
    clip.score.keys.iter().all(|k| k.value.track() != Track::Emotion)
}

fn take_reading(desk: &mut ClipDesk<'_, '_>, number: usize, index: usize, text: &str) -> Result<(), String> {
    let clip = desk.clip();
    // A search that came to its end while the reading was typed may have taken it.
    let Some((syllable, interval)) = clip.syllables.get(index).zip(clip.intervals().get(index)) else { return Ok(()) };
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
        desk.say("it is read so already");
        return Ok(());
    }
    desk.change(Change::one(label, Edit::Clip(number, ClipEdit::Label { index, before, after })));
    Ok(())
}

fn move_key(desk: &mut ClipDesk<'_, '_>, by: i32) {
    let Some((number, found)) = key_here(desk) else { return };
    let editor = &*desk.editor;
    let seconds = f64::from(by) / editor.timeline.fps();
    let time = (found.time() + seconds).clamp(0.0, editor.last());
    let (old, key) = match found {
        LaneKey::Own(key) => (Some(key), Key { time, ..key }),
        // Moving a key of speech makes it the author's, and speech's own gives way to it.
        LaneKey::Spoken(key) => (None, Key { replaces: Some(key.time), ..Key::new(time, KeyValue::Mouth(key.shape)) }),
    };
    if (key.time - found.time()).abs() < 1e-9 {
        desk.refuse("the clip ends here");
        return;
    }
    let mut edits: Vec<Edit> = old.map(|key| Edit::Clip(number, ClipEdit::RemoveKey { key })).into_iter().collect();
    edits.push(Edit::Clip(number, ClipEdit::AddKey { key }));
    let label = format!("{} key to {time:.3} s", track_name(key.value.track()));
    if desk.change(Change { label, edits }) {
        desk.go(time);
    }
}

/// The key at the cursor with the clip's number; where there is none, that is said.
fn key_here(desk: &mut ClipDesk<'_, '_>) -> Option<(usize, LaneKey)> {
    let (editor, clip) = (&*desk.editor, desk.clip());
    let found = editor.key_here(clip).map(|key| (editor.clip, key));
    if found.is_none() {
        let how = match editor.lane {
            Lane::Syllables => "keys lie on the lanes below: ↓",
            Lane::Keys(_) => "no key here: n and p go to keys, a adds one",
        };
        desk.say(how);
    }
    found
}

fn delete_key(desk: &mut ClipDesk<'_, '_>) {
    match key_here(desk) {
        Some((clip, LaneKey::Own(key))) => {
            let label = format!("{} key at {:.2} s deleted", track_name(key.value.track()), key.time);
            desk.change(Change::one(label, Edit::Clip(clip, ClipEdit::RemoveKey { key })));
        }
        Some((_, LaneKey::Spoken(_))) => {
            desk.refuse("this key is speech's: Enter changes it, r changes how the syllable is read");
        }
        None => {}
    }
}

fn mark(desk: &mut ClipDesk<'_, '_>) {
    let has_record = desk.clip().record.is_some();
    let editor = &mut *desk.editor;
    match editor.mark {
        _ if !has_record => {
            desk.refuse("a stretch is an edit of a ratio record, and this clip has none: use emotion keys");
        }
        None => {
            editor.mark = Some(editor.cursor);
            desk.say("marked: move to the other end and press v again; Esc unmarks");
        }
        Some(mark) if (mark - editor.cursor).abs() < 0.5 / editor.timeline.fps() => {
            editor.mark = None;
            desk.say("the mark is gone");
        }
        Some(mark) => {
            let (from, to) = (mark.min(editor.cursor), mark.max(editor.cursor));
            let title = format!("Change the ratios from {from:.2} to {to:.2} s");
            desk.prompt(Purpose::Range { from, to, old: None }, title, typed::RANGE_HELP, String::new());
        }
    }
}

fn delete_range(desk: &mut ClipDesk<'_, '_>) {
    let (editor, clip) = (&*desk.editor, desk.clip());
    match range_here(editor, clip) {
        Some((at, range)) => {
            let label = format!("{} from {:.2} s deleted", typed::range_text(&range), range.from);
            desk.change(Change::one(label, Edit::Clip(editor.clip, ClipEdit::RemoveRange { at, range })));
        }
        None => desk.say("no edited stretch at the cursor"),
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

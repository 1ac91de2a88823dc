//! Words for a recording without a script: the places where syllables are heard are marked, and typed words are laid
//! onto them, a syllable each.

use std::path::Path;

use super::edits;
use super::job::Job;
use super::overlay::Purpose;
use super::state::State;
use crate::project::Clip;
use crate::project::counted;
use crate::speech::Heard;

/// A place that overlaps a syllable by more than this, in seconds, is that syllable's.
const OVERLAP: f64 = 0.02;

/// A place shorter than this, in seconds, is none.
const SHORTEST: f64 = 0.03;

/// Marks where syllables are heard.
pub(super) fn mark(state: &mut State) -> Option<Job> {
    let clip = state.clip()?;
    let Some(sound) = clip.sound.clone() else {
        state.refuse("this clip has no sound to listen to");
        return None;
    };
    if let Some(why) = state.lesson().and_then(|l| l.read_only.clone()) {
        state.refuse(format!("the lesson cannot be changed: {why}"));
        return None;
    }
    if state.editor.as_ref().is_some_and(|e| !e.places.is_empty()) {
        if let Some(editor) = &mut state.editor {
            editor.places.clear();
        }
        state.say("the marks are gone");
        return None;
    }
    let root = state.lesson()?.root.clone();
    state.say("listening for syllables…");
    Some(Job::Nuclei { root, clip: state.editor.as_ref()?.clip, sound })
}

/// Takes the places where syllables were heard.
pub(super) fn found(state: &mut State, root: &Path, number: usize, heard: &Heard) {
    if state.lesson().is_none_or(|l| l.root != root) || state.editor.as_ref().is_none_or(|e| e.clip != number) {
        return;
    }
    let Some(clip) = state.clip() else { return };
    let places = free(clip, &heard.syllables);
    let (many, none_yet) = (places.len(), clip.syllables.is_empty());
    if let Some(editor) = &mut state.editor {
        editor.places = places;
        editor.lane = super::Lane::Syllables;
    }
    match (many, none_yet) {
        (0, true) => state.refuse("no syllables are heard in this sound"),
        (0, false) => state.say("no syllables are heard beside those of the script"),
        (_, true) => {
            go_to_place(state, 0);
            state.say(format!("{} marked: Enter types words onto them, Tab goes on", counted(many, "place")));
        }
        (_, false) => {
            state.say(format!("{} beside the script marked (○): Enter types words onto them", counted(many, "place")));
        }
    }
}

/// The places that no syllable has, by rising time.
pub(super) fn free(clip: &Clip, heard: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let taken = clip.intervals();
    let mut free = Vec::new();
    for (from, to) in heard {
        let middle = f64::midpoint(*from, *to);
        let over = |i: &&crate::timing::Interval| i.end.min(*to) - i.start.max(*from) > OVERLAP;
        if taken.iter().filter(over).any(|i| i.start <= middle && middle < i.end) {
            continue;
        }
        // What reaches a little into a neighbour is cut there.
        let from = taken.iter().filter(|i| i.start <= middle).map(|i| i.end).fold(*from, f64::max);
        let to = taken.iter().filter(|i| i.start > middle).map(|i| i.start).fold(*to, f64::min);
        if to - from >= SHORTEST {
            free.push((from, to));
        }
    }
    free
}

/// The place at the cursor.
pub(super) fn here(state: &State) -> Option<usize> {
    let editor = state.editor.as_ref()?;
    editor.places.iter().position(|(from, to)| *from - 1e-6 <= editor.cursor && editor.cursor < *to)
}

/// Asks for the words of the place at the cursor and those after it.
pub(super) fn ask(state: &mut State) -> bool {
    let Some(from) = here(state) else { return false };
    let rest = state.editor.as_ref().map_or(0, |e| e.places.len() - from);
    let title = format!("Words from here on ({} left)", counted(rest, "place"));
    edits::prompt(state, Purpose::Words, title, HELP, String::new());
    true
}

const HELP: &str = "characters, Pinyin, Zhuyin or English: each syllable takes the next place; as many as you like";

/// Lays typed words onto the places, from the one at the cursor on.
pub(super) fn take(state: &mut State, text: &str) -> Result<(), String> {
    // A search that came to its end while the words were typed may have taken it.
    let from = here(state).ok_or("a syllable lies here now: Esc, then m marks anew where others are heard")?;
    let (Some(editor), Some(lesson)) = (&state.editor, state.lesson()) else { return Ok(()) };
    let number = editor.clip;
    let places = editor.places.get(from..).unwrap_or_default().to_vec();
    let before = lesson.clips[number].syllables.len();
    let change = lesson.lay_words(number, text, &places).map_err(|fault| super::wording::in_a_line(&fault))?;
    if !edits::change(state, change) {
        return Ok(());
    }
    let laid = state.clip().map_or(0, |c| c.syllables.len()).saturating_sub(before);
    let Some(editor) = &state.editor else { return Ok(()) };
    // Those that have a syllable now went with the change.
    let until = places.get(laid.saturating_sub(1)).map_or(0.0, |p| p.1);
    let next = editor.places.iter().position(|p| p.0 >= until - 1e-6);
    let left = counted(editor.places.len(), "place");
    let words = counted(laid, "syllable");
    if let Some(next) = next {
        go_to_place(state, next);
        state.say(format!("{words} laid; Enter goes on here, {left} left"));
    } else {
        state.say(format!("{words} laid; A finds their exact times in the sound"));
    }
    Ok(())
}

fn go_to_place(state: &mut State, place: usize) {
    let clips = state.open.as_ref().and_then(|o| o.lesson.as_ref().ok()).map(|l| &l.clips);
    let (Some(clips), Some(editor)) = (clips, &mut state.editor) else { return };
    if let Some((from, _)) = editor.places.get(place).copied() {
        editor.go(&clips[editor.clip], from);
    }
}

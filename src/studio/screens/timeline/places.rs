//! Words for a recording without a script: the places where syllables are heard are marked, and typed words are laid
//! onto them, a syllable each.

use std::path::PathBuf;
use std::sync::Arc;

use super::desk::ClipDesk;
use super::free_places::free;
use crate::disk::Result;
use crate::media::Sound;
use crate::project::counted;
use crate::speech::{Heard, nuclei};
use crate::studio::app::lane::Lane;
use crate::studio::app::stack::{Job, Reporter, Stack};
use crate::studio::app::wording;
use crate::studio::widgets::prompt::Purpose;

/// Marks where syllables are heard, or takes the marks away.
pub(super) fn mark(desk: &mut ClipDesk<'_, '_>) {
    let Some(sound) = desk.clip().sound.clone() else {
        desk.refuse("this clip has no sound to listen to");
        return;
    };
    if !desk.project.may_change(desk.cx.shell) {
        return;
    }
    if !desk.editor.places.is_empty() {
        desk.editor.places.clear();
        desk.say("the marks are gone");
        return;
    }
    desk.say("listening for syllables…");
    desk.cx.start(NucleiJob { root: desk.project.lesson.root.clone(), clip: desk.editor.clip, sound });
}

/// Marks where syllables are heard in a clip's sound.
struct NucleiJob {
    root: PathBuf,
    clip: usize,
    sound: Arc<Sound>,
}

impl Job for NucleiJob {
    type Made = Heard;
    const BROKEN: [&'static str; 2] = super::listening::BROKEN;

    fn run(&mut self, _: &Reporter) -> Result<Heard> {
        Ok(nuclei(&self.sound))
    }

    fn done(self, made: Result<Heard>, stack: &mut Stack) {
        // The author may have gone to another clip in the meantime.
        let Some((project, editor)) = stack.editor(&self.root, self.clip) else { return };
        let cx = &mut stack.context();
        match made {
            Ok(heard) => {
                let (project, editor) = (&mut *project.borrow_mut(), &mut *editor.borrow_mut());
                found(&mut ClipDesk { project, editor, cx }, &heard);
            }
            Err(fault) => cx.shell.refuse(fault.what()),
        }
    }
}

/// Takes the places where syllables were heard.
fn found(desk: &mut ClipDesk<'_, '_>, heard: &Heard) {
    let clip = desk.clip();
    let places = free(clip, &heard.syllables);
    let (many, none_yet) = (places.len(), clip.syllables.is_empty());
    desk.editor.places = places;
    desk.editor.lane = Lane::Syllables;
    match (many, none_yet) {
        (0, true) => desk.refuse("no syllables are heard in this sound"),
        (0, false) => desk.say("no syllables are heard beside those of the script"),
        (_, true) => {
            go_to_place(desk, 0);
            desk.say(format!("{} marked: Enter types words onto them, Tab goes on", counted(many, "place")));
        }
        (_, false) => {
            desk.say(format!("{} beside the script marked (○): Enter types words onto them", counted(many, "place")));
        }
    }
}

/// The place at the cursor.
pub(super) fn here(desk: &ClipDesk<'_, '_>) -> Option<usize> {
    let editor = &*desk.editor;
    editor.places.iter().position(|(from, to)| *from - 1e-6 <= editor.cursor && editor.cursor < *to)
}

/// Asks for the words of the place at the cursor and those after it.
pub(super) fn ask(desk: &mut ClipDesk<'_, '_>) -> bool {
    let Some(from) = here(desk) else { return false };
    let rest = desk.editor.places.len() - from;
    let title = format!("Words from here on ({} left)", counted(rest, "place"));
    desk.prompt(Purpose::Words, title, HELP, String::new());
    true
}

const HELP: &str = "characters, Pinyin, Zhuyin or English: each syllable takes the next place; as many as you like";

/// Lays typed words onto the places, from the one at the cursor on.
pub(super) fn take(desk: &mut ClipDesk<'_, '_>, text: &str) -> Result<(), String> {
    // A search that came to its end while the words were typed may have taken it.
    let from = here(desk).ok_or("a syllable lies here now: Esc, then m marks anew where others are heard")?;
    let (number, lesson) = (desk.editor.clip, &desk.project.lesson);
    let places = desk.editor.places.get(from..).unwrap_or_default().to_vec();
    let before = lesson.clips[number].syllables.len();
    let change = lesson.lay_words(number, text, &places).map_err(|fault| wording::in_a_line(&fault))?;
    if !desk.change(change) {
        return Ok(());
    }
    let laid = desk.clip().syllables.len().saturating_sub(before);
    let editor = &*desk.editor;
    // Those that have a syllable now went with the change.
    let until = places.get(laid.saturating_sub(1)).map_or(0.0, |p| p.1);
    let next = editor.places.iter().position(|p| p.0 >= until - 1e-6);
    let left = counted(editor.places.len(), "place");
    let words = counted(laid, "syllable");
    if let Some(next) = next {
        go_to_place(desk, next);
        desk.say(format!("{words} laid; Enter goes on here, {left} left"));
    } else {
        desk.say(format!("{words} laid; A finds their exact times in the sound"));
    }
    Ok(())
}

fn go_to_place(desk: &mut ClipDesk<'_, '_>, place: usize) {
    if let Some((from, _)) = desk.editor.places.get(place).copied() {
        desk.go(from);
    }
}

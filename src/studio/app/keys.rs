//! The one key table: which keys ask for what, where, and what the help says of it. Dispatch, the hints at the foot of
//! the screen, the help and `lianpu keys` are made from it.

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use super::action::Action::{self, *};
use super::action::Nudge;
use Place::{
    Confirm, Doubts as Doubting, Export as Exporting, Face as Facing, Help as Helping, Lesson, Player, Projects,
    Prompt, Tapping, Timeline,
};

/// Where a key is pressed: a screen, or what lies on top of one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// The list of lessons.
    Projects,
    /// A lesson and its clips.
    Lesson,
    /// A clip's timeline.
    Timeline,
    /// A clip's timeline while syllables are tapped.
    Tapping,
    /// The list of what there is to look at.
    Doubts,
    /// A face: its photo, its points, its cartoon.
    Face,
    /// The full-terminal player.
    Player,
    /// The help.
    Help,
    /// A line being typed.
    Prompt,
    /// The question about unsaved changes.
    Confirm,
    /// A running export.
    Export,
}

impl Place {
    /// The screens, as `lianpu keys` lists them.
    const LISTED: [(Self, &'static str); 10] = [
        (Self::Projects, "Lessons"),
        (Self::Lesson, "A lesson"),
        (Self::Timeline, "The timeline of a clip"),
        (Self::Doubts, "The list of what there is to look at"),
        (Self::Tapping, "Tapping syllables"),
        (Self::Face, "The points of a face"),
        (Self::Player, "`lianpu play`"),
        (Self::Prompt, "A line being typed"),
        (Self::Confirm, "Leaving with unsaved changes"),
        (Self::Export, "A running export"),
    ];
}

/// A row of the table: keys that belong together.
#[derive(Debug)]
pub(crate) struct Row {
    /// Where it holds.
    pub places: &'static [Place],
    /// The keys and what each asks for.
    pub keys: &'static [(&'static str, Action)],
    /// What they do, in one line.
    pub help: &'static str,
    /// The same in a word, for the foot of the screen; empty where it is not shown there.
    pub hint: &'static str,
}

const fn row(
    places: &'static [Place],
    keys: &'static [(&'static str, Action)],
    hint: &'static str,
    help: &'static str,
) -> Row {
    Row { places, keys, help, hint }
}

/// The rows of the lists and of the timeline, in the order in which the help shows them.
pub(crate) const TABLE: &[Row] = &[
    row(
        &[Projects, Lesson],
        &[("Up", Choose(-1)), ("Down", Choose(1)), ("k", Choose(-1)), ("j", Choose(1))],
        "choose",
        "choose",
    ),
    row(&[Projects, Lesson], &[("Enter", Open), ("Right", Open), ("l", Open)], "open", "open what is chosen"),
    row(&[Timeline, Player], &[("Space", Play)], "play", "play from the cursor, stop"),
    row(
        &[Timeline],
        &[("Left", Frames(-1)), ("Right", Frames(1)), ("h", Frames(-1)), ("l", Frames(1))],
        "",
        "one frame back, on",
    ),
    row(&[Player], &[("Left", Frames(-1)), ("Right", Frames(1))], "", "one frame back, on"),
    row(
        &[Timeline],
        &[("Shift-Left", Centis(-1)), ("Shift-Right", Centis(1)), ("H", Centis(-1)), ("L", Centis(1))],
        "",
        "10 ms back, on",
    ),
    row(
        &[Timeline],
        &[("Tab", Syllable(1)), ("Shift-Tab", Syllable(-1)), ("w", Syllable(1)), ("b", Syllable(-1))],
        "syllable",
        "next, previous syllable",
    ),
    row(&[Timeline], &[("n", Key(1)), ("p", Key(-1))], "key", "next, previous key on the lane"),
    row(
        &[Timeline],
        &[("Up", Lane(-1)), ("Down", Lane(1)), ("k", Lane(-1)), ("j", Lane(1))],
        "lane",
        "lane above, below (▸)",
    ),
    row(
        &[Timeline],
        &[("Home", First), ("End", Last), ("PageUp", Screens(-1)), ("PageDown", Screens(1))],
        "",
        "start, end, a screen back, on",
    ),
    row(&[Player], &[("Home", First), ("End", Last)], "", "to the start, to the end"),
    row(&[Player], &[("Down", Frames(-25)), ("Up", Frames(25))], "", "25 frames back, on"),
    row(&[Player], &[("l", Loop)], "loop", "begin again at the end, or stop there"),
    row(
        &[Timeline],
        &[("+", Zoom(1)), ("=", Zoom(1)), ("-", Zoom(-1)), ("0", Fit)],
        "zoom",
        "nearer, farther, the whole clip",
    ),
    row(
        &[Timeline],
        &[("[", Start(Nudge::Centis(-1))), ("]", Start(Nudge::Centis(1)))],
        "start",
        "start 10 ms back, on (a touching neighbour follows)",
    ),
    row(&[Timeline], &[("{", Start(Nudge::Frames(-1))), ("}", Start(Nudge::Frames(1)))], "", "the same by one frame"),
    row(
        &[Timeline],
        &[(",", End(Nudge::Centis(-1))), (".", End(Nudge::Centis(1)))],
        "end",
        "end 10 ms back, on (a touching neighbour follows)",
    ),
    row(&[Timeline], &[("<", End(Nudge::Frames(-1))), (">", End(Nudge::Frames(1)))], "", "the same by one frame"),
    row(&[Timeline], &[("G", Gap(-1)), ("g", Gap(1))], "", "10 ms of pause before, after the syllable"),
    row(&[Timeline], &[("r", Reading)], "read", "set how the syllable is read"),
    row(&[Lesson], &[("A", Align)], "align", "find the times of the clip in its sound"),
    row(&[Timeline], &[("A", Align)], "align", "find the times in the sound (those set by hand stay)"),
    row(&[Lesson, Timeline], &[("T", Follow)], "", "follow the face in the video; stop that"),
    row(&[Timeline], &[("V", Video)], "", "the video beside the drawing, or not"),
    row(&[Timeline], &[("d", Doubt(1)), ("D", Doubt(-1))], "look at", "next, previous place to look at (!)"),
    row(&[Timeline], &[("o", Doubts)], "", "list the places to look at"),
    row(&[Timeline], &[("S", SoundView)], "", "the sound as a wave, as a spectrogram, or both"),
    row(&[Timeline], &[("P", Tone)], "", "the pitch of the voice, or not"),
    row(&[Timeline], &[("t", Tap)], "tap", "tap the syllables along with the sound"),
    row(&[Timeline], &[("m", Places)], "mark", "mark where syllables are heard; Enter types words"),
    row(&[Timeline], &[("Enter", Edit)], "change", "change the key, stretch or reading; type words (○)"),
    row(&[Timeline], &[("a", Add)], "add", "add a key to the lane"),
    row(&[Timeline], &[("(", MoveKey(-1)), (")", MoveKey(1))], "", "move the key one frame back, on"),
    row(&[Timeline], &[("x", Delete), ("Delete", Delete)], "delete", "delete the key"),
    row(&[Timeline], &[("v", Mark)], "", "mark a stretch: from here, to here"),
    row(&[Timeline], &[("X", DeleteRange)], "", "delete the edit of a stretch"),
    row(&[Tapping], &[("Enter", TapStart)], "start", "begin; then: the next syllable starts now"),
    row(&[Tapping], &[("Space", TapEnd)], "pause", "the syllable ends now, a pause follows"),
    row(&[Tapping], &[("Backspace", TapBack)], "back", "take the last one back, and go a second back"),
    row(&[Tapping], &[("Tab", TapNext(1)), ("Shift-Tab", TapNext(-1))], "syllable", "another syllable comes next"),
    row(&[Tapping], &[("r", TapSpeed)], "speed", "at full speed, at half"),
    row(&[Tapping], &[("c", TapMeasure)], "measure", "measure how late your taps come, with 8 flashes"),
    row(&[Tapping], &[("q", TapKeep), ("Esc", TapKeep)], "done", "keep what was tapped, and go back to the timeline"),
    row(&[Tapping], &[("x", TapDrop)], "drop", "drop what was tapped"),
    row(
        &[Facing],
        &[("Left", Move(-1, 0)), ("Right", Move(1, 0)), ("Up", Move(0, -1)), ("Down", Move(0, 1))],
        "",
        "move the point by 1 pixel of the photo",
    ),
    row(
        &[Facing],
        &[
            ("Shift-Left", Move(-10, 0)),
            ("Shift-Right", Move(10, 0)),
            ("Shift-Up", Move(0, -10)),
            ("Shift-Down", Move(0, 10)),
        ],
        "",
        "move it by 10 pixels",
    ),
    row(
        &[Facing],
        &[("h", Move(-1, 0)), ("l", Move(1, 0)), ("k", Move(0, -1)), ("j", Move(0, 1))],
        "",
        "the same by letters: 1 pixel",
    ),
    row(
        &[Facing],
        &[("H", Move(-10, 0)), ("L", Move(10, 0)), ("K", Move(0, -10)), ("J", Move(0, 10))],
        "",
        "the same by letters: 10 pixels",
    ),
    row(&[Facing], &[("[", Shot(-1)), ("]", Shot(1))], "shot", "previous, next shot: neutral, then the six emotions"),
    row(&[Facing], &[("Tab", Point(1)), ("Shift-Tab", Point(-1))], "point", "next, previous point"),
    row(&[Facing], &[("g", GoTo), ("/", GoTo)], "go to", "go to a point by its name"),
    row(&[Facing], &[("b", Both)], "both", "move both sides of the face, or one"),
    row(
        &[Facing],
        &[("+", Zoom(1)), ("=", Zoom(1)), ("-", Zoom(-1)), ("0", Fit)],
        "zoom",
        "nearer, farther, the whole face",
    ),
    row(&[Facing], &[("r", FindAgain)], "find", "find the neutral points again (those set by hand stay)"),
    row(&[Facing], &[("C", Calibrate)], "calibrate", "save, and calibrate the face from its shots"),
    row(&[Facing], &[("x", Release), ("Delete", Release)], "", "give a point that was set by hand back to the search"),
    row(&[Facing], &[("o", Anchors)], "", "place eyes, mouth and chin by hand, where the search fails; give that up"),
    row(&[Facing], &[("Enter", Cross)], "", "take the place of the cross"),
    row(&[Facing], &[("v", Stage(1)), ("V", Stage(-1))], "stages", "next, previous stage of the search; the photo"),
    row(&[Facing], &[("e", Emotion(1)), ("E", Emotion(-1))], "emotion", "show the next, previous emotion"),
    row(&[Facing], &[("m", Mouth(1)), ("M", Mouth(-1))], "mouth", "show the next, previous mouth shape"),
    row(&[Facing], &[("c", Hair)], "hair", "hair: straight, wavy, curly, shaved, bald"),
    row(
        &[Doubting],
        &[("Up", Choose(-1)), ("Down", Choose(1)), ("k", Choose(-1)), ("j", Choose(1))],
        "choose",
        "choose",
    ),
    row(&[Doubting], &[("Enter", GoThere)], "go there", "go there"),
    row(&[Doubting], &[("q", Close), ("Esc", Close), ("o", Close)], "close", "close the list"),
    row(&[Timeline, Facing], &[("u", Undo), ("Ctrl-r", Redo)], "undo", "undo, redo"),
    row(&[Timeline, Lesson, Facing], &[("s", Save), ("Ctrl-s", Save)], "save", "save the lesson"),
    row(&[Timeline, Lesson], &[("e", Export)], "export", "export"),
    row(&[Lesson], &[("f", Face)], "face", "the face: its photo, its points, its cartoon"),
    row(&[Timeline], &[("f", Face)], "", "the face: its photo, its points, its cartoon"),
    row(&[Projects, Lesson, Timeline, Tapping, Facing, Player], &[("?", Help)], "help", "all keys of this place"),
    row(&[Projects, Lesson, Timeline, Tapping, Facing, Player], &[("Ctrl-l", Redraw)], "", "draw the screen anew"),
    row(&[Projects, Player], &[("q", Quit), ("Esc", Quit), ("Ctrl-c", Quit)], "quit", "quit"),
    row(&[Lesson], &[("q", Back), ("Esc", Back), ("Left", Back)], "back", "back to the lessons"),
    row(&[Timeline], &[("q", Back), ("Esc", Back)], "back", "back to the lesson"),
    row(&[Facing], &[("q", Back), ("Esc", Back)], "back", "back to where one was"),
    row(
        &[Lesson, Timeline, Doubting, Tapping, Facing, Helping, Prompt, Confirm, Exporting],
        &[("Ctrl-c", Quit)],
        "",
        "quit the studio",
    ),
    row(
        &[Helping],
        &[("Up", Scroll(-1)), ("Down", Scroll(1)), ("k", Scroll(-1)), ("j", Scroll(1))],
        "scroll",
        "scroll",
    ),
    row(&[Helping], &[("q", Close), ("Esc", Close), ("?", Close), ("Enter", Close)], "close", "close the help"),
    row(&[Prompt], &[("Enter", Accept)], "done", "take what was typed"),
    row(&[Prompt], &[("Esc", Close)], "leave it", "leave everything as it is"),
    row(&[Prompt], &[("Backspace", Rub), ("Delete", RubAhead)], "", "take away the letter before, after"),
    row(&[Prompt], &[("Ctrl-u", RubLine)], "clear", "take away everything before"),
    row(
        &[Prompt],
        &[("Left", Caret(-1)), ("Right", Caret(1)), ("Home", Caret(i32::MIN)), ("End", Caret(i32::MAX))],
        "",
        "move in the line",
    ),
    row(&[Confirm], &[("s", SaveAndGo), ("y", SaveAndGo), ("Enter", SaveAndGo)], "save", "save, then go"),
    row(&[Confirm], &[("d", DropAndGo), ("n", DropAndGo)], "discard", "discard the changes, then go"),
    row(
        &[Confirm],
        &[("k", KeepAndGo)],
        "keep",
        "leave the changes in the journal, then go: they are back when the lesson is opened again",
    ),
    row(&[Confirm], &[("Esc", Close), ("q", Close), ("c", Close)], "stay", "stay and change nothing"),
    row(&[Exporting], &[("Esc", Close), ("q", Close)], "stop", "stop the export"),
];

/// What a key asks for in a place; none where it means nothing there.
#[must_use]
pub(crate) fn action_of(place: Place, key: &str) -> Option<Action> {
    let rows = TABLE.iter().filter(|r| r.places.contains(&place));
    let found = rows.flat_map(|r| r.keys).find(|(k, _)| *k == key).map(|(_, action)| *action);
    let mut letters = key.chars();
    match (found, letters.next(), letters.next()) {
        (None, Some(letter), None) if place == Prompt => Some(Type(letter)),
        (None, ..) if place == Prompt && key == "Space" => Some(Type(' ')),
        _ => found,
    }
}

/// The name of a key in the table: `l`, `Space`, `Ctrl-r`, `Shift-Left`; none for keys that have no name there.
#[must_use]
pub(crate) fn name_of(key: &KeyEvent) -> Option<String> {
    let bare = match key.code {
        KeyCode::Char(' ') => "Space".to_owned(),
        KeyCode::Char(c) => c.to_string(),
        KeyCode::Left => "Left".to_owned(),
        KeyCode::Right => "Right".to_owned(),
        KeyCode::Up => "Up".to_owned(),
        KeyCode::Down => "Down".to_owned(),
        KeyCode::Home => "Home".to_owned(),
        KeyCode::End => "End".to_owned(),
        KeyCode::PageUp => "PageUp".to_owned(),
        KeyCode::PageDown => "PageDown".to_owned(),
        KeyCode::Enter => "Enter".to_owned(),
        KeyCode::Esc => "Esc".to_owned(),
        KeyCode::Tab => "Tab".to_owned(),
        KeyCode::BackTab => return Some("Shift-Tab".to_owned()),
        KeyCode::Backspace => "Backspace".to_owned(),
        KeyCode::Delete => "Delete".to_owned(),
        _ => return None,
    };
    // Enter that was typed before the terminal was ours arrives as a line feed, which is Ctrl-J.
    if key.code == KeyCode::Char('j') && key.modifiers == KeyModifiers::CONTROL {
        return Some("Enter".to_owned());
    }
    let is_letter = matches!(key.code, KeyCode::Char(_));
    Some(match key.modifiers {
        m if m.contains(KeyModifiers::CONTROL) => format!("Ctrl-{}", bare.to_lowercase()),
        m if m.contains(KeyModifiers::ALT) => format!("Alt-{bare}"),
        // A letter has its shift in itself.
        m if m.contains(KeyModifiers::SHIFT) && !is_letter => format!("Shift-{bare}"),
        _ => bare,
    })
}

/// A key as it is shown: arrows as arrows.
#[must_use]
pub(crate) fn shown(key: &str) -> String {
    const SIGNS: [(&str, &str); 7] = [
        ("PageUp", "PgUp"),
        ("PageDown", "PgDn"),
        ("Left", "←"),
        ("Right", "→"),
        ("Up", "↑"),
        ("Down", "↓"),
        ("Delete", "Del"),
    ];
    let (held, key) = key.split_once('-').filter(|(_, key)| !key.is_empty()).unwrap_or(("", key));
    let sign = |key: &str| {
        let found = SIGNS.iter().find(|(name, _)| *name == key);
        found.map_or_else(|| key.to_owned(), |(_, sign)| (*sign).to_owned())
    };
    if held.is_empty() { sign(key) } else { format!("{}-{}", sign(held), sign(key)) }
}

/// The rows of a place: their keys as shown, and their help.
pub(crate) fn help_of(place: Place) -> impl Iterator<Item = (String, &'static str)> {
    let keys = |r: &Row| r.keys.iter().map(|(k, _)| shown(k)).collect::<Vec<_>>().join(" ");
    TABLE.iter().filter(move |r| r.places.contains(&place)).map(move |r| (keys(r), r.help))
}

/// The hints at the foot of a place: the two first keys of every row that has one, and the hint.
pub(crate) fn hints_of(place: Place) -> impl Iterator<Item = (String, &'static str)> {
    let keys = |r: &Row| {
        // A pair of opposites is shown as a pair, a single thing by its first key.
        let mut shown_keys: Vec<(&str, Action)> = Vec::new();
        for (key, action) in r.keys {
            if shown_keys.iter().all(|(_, a)| a != action) && shown_keys.len() < 2 {
                shown_keys.push((key, *action));
            }
        }
        if matches!(r.hint, "undo" | "syllable" | "look at" | "point" | "stages" | "emotion" | "mouth") {
            shown_keys.truncate(1);
        }
        shown_keys.iter().map(|(k, _)| shown(k)).collect::<String>()
    };
    TABLE.iter().filter(move |r| r.places.contains(&place) && !r.hint.is_empty()).map(move |r| (keys(r), r.hint))
}

/// The whole table as text: each place with its keys and what they do.
#[must_use]
pub fn key_list() -> String {
    let mut out = String::new();
    for (place, title) in Place::LISTED {
        out.push_str(&format!("{title}\n"));
        let rows: Vec<(String, &str)> = help_of(place).collect();
        let widest = rows.iter().map(|(keys, _)| keys.chars().count()).max().unwrap_or(0);
        for (keys, help) in rows {
            out.push_str(&format!("  {keys:widest$}  {help}\n"));
        }
        out.push('\n');
    }
    out.truncate(out.trim_end().len());
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_key_asks_for_two_things_in_one_place() {
        for place in
            [Projects, Lesson, Timeline, Doubting, Tapping, Facing, Player, Helping, Prompt, Confirm, Exporting]
        {
            let mut keys: Vec<&str> =
                TABLE.iter().filter(|r| r.places.contains(&place)).flat_map(|r| r.keys).map(|(k, _)| *k).collect();
            keys.sort_unstable();
            let mut once = keys.clone();
            once.dedup();
            assert_eq!(keys, once, "{place:?}");
        }
    }

    #[test]
    fn the_list_of_keys_has_every_place_and_every_key() {
        let text = key_list();
        for (place, title) in Place::LISTED {
            assert!(text.contains(title), "{title}");
            assert!(help_of(place).all(|(keys, help)| text.contains(&keys) && text.contains(help)), "{title}: {text}");
        }
    }

    #[test]
    fn keys_are_called_as_the_table_calls_them() {
        let name = |code, modifiers| name_of(&KeyEvent::new(code, modifiers)).unwrap();
        assert_eq!(name(KeyCode::Char('R'), KeyModifiers::CONTROL), "Ctrl-r");
        assert_eq!(name(KeyCode::Char('{'), KeyModifiers::SHIFT), "{");
        assert_eq!(name(KeyCode::Left, KeyModifiers::SHIFT), "Shift-Left");
        assert_eq!(name(KeyCode::BackTab, KeyModifiers::SHIFT), "Shift-Tab");
        assert_eq!(action_of(Timeline, "Ctrl-r"), Some(Redo));
        assert_eq!(action_of(Prompt, "q"), Some(Type('q')));
        assert_eq!(action_of(Projects, "x"), None);
    }
}

//! The two lists: the lessons of a folder, and the clips of a lesson with what a check found.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};

use super::{BOLD, CHOSEN, DIM, cells, head, put, put_short};
use crate::project::{Clip, Finding, Lesson};
use crate::studio::aligning;
use crate::studio::look::Colours;
use crate::studio::state::{Open, State};
use crate::studio::wording;

/// The lessons of the folder.
pub(super) fn lessons(buffer: &mut Buffer, area: Rect, state: &State) {
    head(buffer, area, &[&state.folder.display().to_string()], "", Style::new());
    let list = Rect::new(area.x + 1, area.y + 2, area.width - 2, area.height - 4);
    if state.lessons.is_empty() {
        put(buffer, list.x, list.y, list.width, "There are no lessons here yet.", BOLD);
        let help = "lianpu new NAME --speech FILE --script FILE  makes one.";
        put(buffer, list.x, list.y + 1, list.width, help, Style::new());
        return;
    }
    let names = state.lessons.iter().map(|l| cells(&l.name)).max().unwrap_or(0).min(24) + 3;
    for (index, (y, listed)) in rows(list, state.chosen, &state.lessons) {
        let style = chosen_row(buffer, list, y, index == state.chosen);
        put_short(buffer, list.x + 1, y, names, &listed.name, style.patch(BOLD));
        let (text, style) = match &listed.manifest {
            Ok((title, 1)) => (format!("{title}   1 clip"), style),
            Ok((title, clips)) => (format!("{title}   {clips} clips"), style),
            Err(fault) => (format!("✗ {}", fault.what()), style.patch(state.colours.fault())),
        };
        put_short(buffer, list.x + 1 + names, y, list.width.saturating_sub(names + 2), &text, style);
    }
}

/// A lesson: its clips, and what is there, missing or wrong.
pub(super) fn lesson(buffer: &mut Buffer, area: Rect, state: &State) {
    let Some(open) = &state.open else { return };
    let (title, standing) = match &open.lesson {
        Ok(lesson) => (lesson.manifest.title.as_str(), standing(lesson, state.colours)),
        Err(_) => (open.name.as_str(), ("it does not open", state.colours.fault())),
    };
    head(buffer, area, &[title], standing.0, standing.1);
    let inner = Rect::new(area.x + 1, area.y + 2, area.width - 2, area.height - 4);
    let mut y = inner.y;
    match &open.lesson {
        Ok(lesson) => {
            put(buffer, inner.x, y, inner.width, "Clips", BOLD.add_modifier(Modifier::UNDERLINED));
            let room = (lesson.clips.len() as u16).clamp(1, inner.height / 2);
            let list = Rect { y: y + 1, height: room, ..inner };
            clips(buffer, list, open, lesson);
            y = list.bottom() + 1;
        }
        Err(fault) => {
            put(buffer, inner.x, y, inner.width, "This lesson does not open.", BOLD);
            y += 1;
            // A check finds the same and more, as a rule.
            let told = open.findings.iter().any(|f| matches!(f, Finding::Wrong(_)));
            for line in fault.to_string().lines().filter(|_| !told) {
                put_short(buffer, inner.x, y, inner.width, line, state.colours.fault());
                y += 1;
            }
            y += 1;
        }
    }
    if y < inner.bottom() {
        put(buffer, inner.x, y, inner.width, "What is there", BOLD.add_modifier(Modifier::UNDERLINED));
        findings(buffer, Rect { y: y + 1, height: inner.bottom() - y - 1, ..inner }, &open.findings, state);
    }
}

/// How a lesson stands, for the line at the top.
pub(super) fn standing(lesson: &Lesson, colours: Colours) -> (&'static str, Style) {
    match (&lesson.read_only, lesson.is_unsaved()) {
        (Some(_), _) => ("read-only", colours.warning()),
        (None, true) => ("● unsaved: s saves", colours.warning().add_modifier(Modifier::BOLD)),
        (None, false) => ("saved", DIM),
    }
}

fn clips(buffer: &mut Buffer, list: Rect, open: &Open, lesson: &Lesson) {
    if lesson.clips.is_empty() {
        put(buffer, list.x + 1, list.y, list.width, "no clips yet: add a [[clip]] to lianpu.toml", DIM);
    }
    let names = lesson.clips.iter().map(|c| cells(&c.entry.name)).max().unwrap_or(0).min(20) + 2;
    for (index, (y, clip)) in rows(list, open.chosen, &lesson.clips) {
        let style = chosen_row(buffer, list, y, index == open.chosen);
        let x = list.x + 1;
        put_short(buffer, x, y, names, &clip.entry.name, style.patch(BOLD));
        let facts = format!("{:>7.2} s   {}", clip.duration(), facts(clip));
        let used = names + put(buffer, x + names, y, list.width.saturating_sub(names + 2), &facts, style);
        let said = clip.script.split_whitespace().collect::<Vec<_>>().join(" ");
        put_short(buffer, x + used + 3, y, list.width.saturating_sub(used + 5), &said, style);
    }
}

fn facts(clip: &Clip) -> String {
    let mut facts = vec![match clip.syllables.len() {
        1 => "1 syllable".to_owned(),
        many => format!("{many} syllables"),
    }];
    let origin = aligning::origin(clip);
    if !origin.is_empty() {
        facts.push(origin);
    }
    match clip.score.keys.len() {
        0 => {}
        1 => facts.push("1 key".into()),
        many => facts.push(format!("{many} keys")),
    }
    facts.join(", ")
}

fn findings(buffer: &mut Buffer, area: Rect, findings: &[Finding], state: &State) {
    let warning = state.colours.warning();
    let mut y = area.y;
    // What is wrong first, then what is odd: the rest may be cut off below.
    let rank = |f: &&Finding| match f {
        Finding::Wrong(_) => 0,
        Finding::Odd(_) => 1,
        Finding::Fine(_) => 2,
    };
    let mut sorted: Vec<&Finding> = findings.iter().collect();
    sorted.sort_by_key(rank);
    for finding in sorted {
        let (mark, style, text) = match finding {
            Finding::Fine(text) => ("✓", Style::new(), text.clone()),
            Finding::Odd(text) => ("!", warning, wording::worded(text)),
            Finding::Wrong(fault) => {
                ("✗", state.colours.fault().add_modifier(Modifier::BOLD), fault.worded(&wording::word))
            }
        };
        for (index, line) in text.lines().flat_map(|l| folded(l.trim(), area.width.saturating_sub(3))).enumerate() {
            if y >= area.bottom() {
                return;
            }
            if index == 0 {
                put(buffer, area.x, y, 1, mark, style);
            }
            put(buffer, area.x + 2, y, area.width - 2, &line, style);
            y += 1;
        }
    }
}

/// A text in lines of at most `width` cells, broken at spaces where there are any.
pub(super) fn folded(text: &str, width: u16) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        let line = lines.last_mut().map_or(0, |l| cells(l));
        if line > 0 && line + 1 + cells(word) > width {
            lines.push(String::new());
        }
        if let Some(line) = lines.last_mut() {
            if !line.is_empty() {
                line.push(' ');
            }
            line.push_str(word);
        }
    }
    lines
}

/// The rows of a list that are on the screen, so that the chosen one is among them.
fn rows<T>(list: Rect, chosen: usize, items: &[T]) -> impl Iterator<Item = (usize, (u16, &T))> {
    let height = usize::from(list.height);
    let first = (chosen + 1).saturating_sub(height);
    (first..).zip((list.y..list.bottom()).zip(&items[first.min(items.len())..]))
}

/// Marks the chosen row.
fn chosen_row(buffer: &mut Buffer, list: Rect, y: u16, chosen: bool) -> Style {
    if !chosen {
        return Style::new();
    }
    buffer.set_style(Rect::new(list.x, y, list.width, 1), CHOSEN);
    put(buffer, list.x, y, 1, "▸", CHOSEN);
    CHOSEN
}

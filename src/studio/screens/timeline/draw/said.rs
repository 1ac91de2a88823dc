//! What is said, syllable by syllable, under the sound: its text between its boundaries, its Pinyin below.

use ratatui::buffer::Buffer;
use ratatui::style::{Modifier, Style};

use super::Layout;
use crate::project::Clip;
use crate::studio::app::colours::Colours;
use crate::studio::screens::timeline::editor::Editor;
use crate::studio::widgets::text::{BOLD, CHOSEN, DIM, cells, put};

pub(super) fn syllables(buffer: &mut Buffer, layout: &Layout, editor: &Editor, clip: &Clip, colours: Colours) {
    let (window, columns) = (editor.window, layout.columns());
    if clip.intervals().is_empty() && editor.places.is_empty() {
        let how = if clip.sound.is_some() {
            "no script: m marks where syllables are heard"
        } else {
            "no script: write a script.txt"
        };
        put(buffer, layout.said.x, layout.said.y, columns, how, DIM);
        return;
    }
    places(buffer, layout, editor);
    let doubts = clip.doubts();
    beside(buffer, layout, editor, &doubts, colours);
    let inside = |i: &&crate::timing::Interval| i.end > window.from && i.start < window.to();
    let many = clip.intervals().iter().filter(inside).count();
    if many > usize::from(columns) {
        let text = format!("{many} syllables: + shows fewer, closer");
        put(buffer, layout.said.x + 1, layout.said.y, columns - 1, &text, DIM);
        return;
    }
    let needs_all = |(s, i): (&crate::script::Syllable, &crate::timing::Interval)| {
        let room = window.column(i.end, columns) - window.column(i.start, columns);
        room <= 2 && room <= i32::from(cells(&s.text))
    };
    // A few boundaries among many would group syllables that do not belong together: it is all of them or none, and
    // then every second syllable is underlined.
    let crowded = clip.syllables.iter().zip(clip.intervals()).filter(|(_, i)| inside(i)).any(needs_all);
    let mut row = Row { layout, editor, clip, colours, crowded, last_end: -1 };
    let mut any_guessed = false;
    // Both lists rise.
    let mut unsure = doubts.iter().filter_map(|d| d.syllable).peekable();
    for (index, interval) in clip.intervals().iter().enumerate().take(clip.syllables.len()) {
        let is_unsure = unsure.next_if_eq(&index).is_some();
        let (start, end) = (window.column(interval.start, columns), window.column(interval.end, columns));
        if end < 0 || start >= i32::from(columns) {
            continue;
        }
        any_guessed |= row.syllable(buffer, index, (start, end), is_unsure);
    }
    // Where there is no room for the marks, the margin has one.
    let margin = match doubts.len() {
        _ if any_guessed => "guessed?".to_owned(),
        0 => return,
        many => format!("{many} ! (d)"),
    };
    put(buffer, layout.area.x + 1, layout.pinyin.y, layout.pinyin.x - 1, &margin, colours.warning());
}

/// The two rows of the syllables, drawn from left to right.
struct Row<'a> {
    layout: &'a Layout,
    editor: &'a Editor,
    clip: &'a Clip,
    colours: Colours,
    /// Whether there is no room for boundaries.
    crowded: bool,
    /// The column where the Pinyin so far ends.
    last_end: i32,
}

impl Row<'_> {
    fn at(&self, column: i32) -> u16 {
        self.layout.said.x + column.clamp(0, i32::from(self.layout.columns())) as u16
    }

    /// Draws a syllable between two columns, and its Pinyin. Returns whether its times are guessed.
    fn syllable(&mut self, buffer: &mut Buffer, index: usize, (start, end): (i32, i32), is_unsure: bool) -> bool {
        let row = self.layout.said;
        let chosen = self.editor.syllable == Some(index);
        let guessed = Editor::is_guessed(self.clip, index);
        let doubtful = !guessed && is_unsure;
        let line = if self.crowded && index % 2 == 1 { Modifier::UNDERLINED } else { Modifier::empty() };
        let style = if chosen { CHOSEN } else { Style::new() }.add_modifier(line);
        let (left, right) = (self.at(start), self.at(end));
        if chosen || !line.is_empty() {
            for x in left..right.max(left + 1).min(row.right()) {
                put(buffer, x, row.y, 1, " ", style);
            }
        }
        // The boundary, then the text.
        let bounded = start >= 0 && !self.crowded;
        if bounded {
            put(buffer, left, row.y, 1, "│", style);
        }
        let inside = self.at(start + i32::from(bounded));
        self.text(buffer, index, (inside, right), style, (doubtful, guessed));
        // Where nothing follows at once, the end is drawn too.
        let (window, columns) = (self.editor.window, self.layout.columns());
        let next = self.clip.intervals().get(index + 1);
        let follows = next.is_some_and(|next| window.column(next.start, columns) <= end);
        if !follows && !self.crowded && (0..i32::from(columns)).contains(&end) {
            put(buffer, right, row.y, 1, "│", Style::new());
        }
        self.pinyin(buffer, &self.clip.syllables[index].pinyin, (inside, right), guessed);
        guessed
    }

    /// Draws the text of a syllable between two columns of the screen, and the sign of a doubt or a guess.
    fn text(
        &self,
        buffer: &mut Buffer,
        index: usize,
        (left, right): (u16, u16),
        style: Style,
        (doubtful, guessed): (bool, bool),
    ) {
        let (y, text, warning) = (self.layout.said.y, &self.clip.syllables[index].text, self.colours.warning());
        let room = right.saturating_sub(left);
        let mut used = put(buffer, left, y, room, text, style.patch(BOLD));
        if used == 0 && room > 0 {
            let sign = if doubtful { ("!", style.patch(warning)) } else { ("·", style) };
            used = put(buffer, left, y, 1, sign.0, sign.1);
        } else if doubtful {
            used += put(buffer, left + used, y, room - used, "!", style.patch(warning));
            if used <= cells(text) {
                // Where there is no room for the sign, the text itself is marked.
                let marked = warning.add_modifier(Modifier::ITALIC | Modifier::UNDERLINED);
                buffer.set_style(ratatui::layout::Rect::new(left, y, used, 1), marked);
            }
        } else if guessed {
            used += put(buffer, left + used, y, room - used, "?", style.patch(warning));
        }
        debug_assert!(used <= room.max(1), "a syllable stays inside its time");
    }

    /// Draws the Pinyin of a syllable between two columns of the screen, where it fits behind the one before.
    fn pinyin(&mut self, buffer: &mut Buffer, pinyin: &str, (left, right): (u16, u16), guessed: bool) {
        let left = left.max(self.at(self.last_end));
        let free = right.saturating_sub(left);
        if cells(pinyin) <= free.max(1) && !pinyin.is_empty() {
            let style = if guessed { Style::new().add_modifier(Modifier::ITALIC) } else { Style::new() };
            let used = put(buffer, left, self.layout.pinyin.y, free, pinyin, style);
            self.last_end = i32::from(left + used + 1) - i32::from(self.layout.said.x);
        }
    }
}

/// The places where syllables are heard and no words are yet.
fn places(buffer: &mut Buffer, layout: &Layout, editor: &Editor) {
    let (window, columns, row) = (editor.window, layout.columns(), layout.said);
    for (from, to) in &editor.places {
        let (start, end) = (window.column(*from, columns), window.column(*to, columns));
        if end < 0 || start >= i32::from(columns) {
            continue;
        }
        let at = |column: i32| row.x + column.clamp(0, i32::from(columns)) as u16;
        let here = *from - 1e-6 <= editor.cursor && editor.cursor < *to;
        let style = if here { CHOSEN } else { Style::new() };
        for x in at(start)..at(end).max(at(start) + 1).min(row.right()) {
            put(buffer, x, row.y, 1, " ", style);
        }
        if start >= 0 {
            put(buffer, at(start), row.y, 1, "│", style);
        }
        let follows = editor.places.iter().any(|p| (p.0 - to).abs() < 0.02);
        if !follows && (0..i32::from(columns)).contains(&end) {
            put(buffer, at(end), row.y, 1, "│", Style::new());
        }
        let middle = i32::midpoint(start + 1, end);
        if (0..i32::from(columns)).contains(&middle) && middle > start {
            put(buffer, at(middle), row.y, 1, "○", style);
        }
    }
}

/// Stretches where something is said that the script does not have.
fn beside(buffer: &mut Buffer, layout: &Layout, editor: &Editor, doubts: &[crate::project::Doubt], colours: Colours) {
    const WORDS: &str = "not in the script";
    let (window, columns, row) = (editor.window, layout.columns(), layout.said);
    for doubt in doubts.iter().filter(|d| d.what == crate::project::Concern::NotInScript) {
        let (start, end) = (window.column(doubt.start, columns), window.column(doubt.end, columns));
        let (first, last) = (start.max(0), end.min(i32::from(columns)));
        for column in first..last {
            put(buffer, row.x + column as u16, row.y, 1, "░", colours.warning());
        }
        let room = u16::try_from(last - first).unwrap_or(0);
        if room > cells(WORDS) + 2 {
            put(buffer, row.x + first as u16 + 1, row.y, room, WORDS, colours.warning());
        }
    }
}

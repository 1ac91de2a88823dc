//! What is said, syllable by syllable, under the sound: its text between its boundaries, its Pinyin below.

use ratatui::buffer::Buffer;
use ratatui::style::{Modifier, Style};

use super::{BOLD, CHOSEN, DIM, Layout, cells, put};
use crate::project::Clip;
use crate::studio::editor::Editor;
use crate::studio::look::Colours;

pub(super) fn syllables(buffer: &mut Buffer, layout: &Layout, editor: &Editor, clip: &Clip, colours: Colours) {
    let (window, columns) = (editor.window, layout.columns());
    if clip.intervals().is_empty() {
        put(buffer, layout.said.x, layout.said.y, columns, "no script: write a script.txt", DIM);
        return;
    }
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
    let mut last_end = -1;
    let mut any_guessed = false;
    for (index, (syllable, interval)) in clip.syllables.iter().zip(clip.intervals()).enumerate() {
        let (start, end) = (window.column(interval.start, columns), window.column(interval.end, columns));
        if end < 0 || start >= i32::from(columns) {
            continue;
        }
        let chosen = editor.syllable == Some(index);
        let guessed = Editor::is_guessed(clip, index);
        let row = layout.said;
        let at = |column: i32| row.x + column.clamp(0, i32::from(columns)) as u16;
        let line = if crowded && index % 2 == 1 { Modifier::UNDERLINED } else { Modifier::empty() };
        let style = if chosen { CHOSEN } else { Style::new() }.add_modifier(line);
        if chosen || !line.is_empty() {
            for x in at(start)..at(end).max(at(start) + 1).min(row.right()) {
                put(buffer, x, row.y, 1, " ", style);
            }
        }
        // The boundary, then the text.
        let bounded = start >= 0 && !crowded;
        if bounded {
            put(buffer, at(start), row.y, 1, "│", style);
        }
        let inside = at(start + i32::from(bounded));
        let room = at(end).saturating_sub(inside);
        let mut used = put(buffer, inside, row.y, room, &syllable.text, style.patch(BOLD));
        if used == 0 && room > 0 {
            used = put(buffer, inside, row.y, 1, "·", style);
        } else if guessed {
            used += put(buffer, inside + used, row.y, room - used, "?", style.patch(colours.warning()));
        }
        any_guessed |= guessed;
        debug_assert!(used <= room.max(1), "a syllable stays inside its time");
        // Where nothing follows at once, the end is drawn too.
        let follows = clip.intervals().get(index + 1).is_some_and(|next| window.column(next.start, columns) <= end);
        if !follows && !crowded && (0..i32::from(columns)).contains(&end) {
            put(buffer, at(end), row.y, 1, "│", Style::new());
        }
        let below = layout.pinyin;
        let free = at(end).saturating_sub(inside.max(at(last_end)));
        if cells(&syllable.pinyin) <= free.max(1) && !syllable.pinyin.is_empty() {
            let style = if guessed { Style::new().add_modifier(Modifier::ITALIC) } else { Style::new() };
            let used = put(buffer, inside.max(at(last_end)), below.y, free, &syllable.pinyin, style);
            last_end = i32::from(inside.max(at(last_end)) + used + 1) - i32::from(row.x);
        }
    }
    // Where there is no room for the marks, the margin has one.
    if any_guessed {
        put(buffer, layout.area.x + 1, layout.pinyin.y, layout.pinyin.x - 1, "guessed?", colours.warning());
    }
}

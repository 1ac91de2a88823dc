//! Text in cells: put, cut, folded, in lists; the line at the top of a page.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};
use unicode_width::UnicodeWidthStr;

/// The smallest terminal that a studio fits into.
pub(in crate::studio) const LEAST: (u16, u16) = (60, 20);

pub(in crate::studio) const BOLD: Style = Style::new().add_modifier(Modifier::BOLD);
pub(in crate::studio) const DIM: Style = Style::new().add_modifier(Modifier::DIM);
pub(in crate::studio) const CHOSEN: Style = Style::new().add_modifier(Modifier::REVERSED);

/// Whether a terminal is too small for anything.
pub(in crate::studio) fn has_no_room(area: Rect) -> bool {
    area.width < LEAST.0 || area.height < LEAST.1
}

/// Says so where a terminal is too small for anything else.
pub(in crate::studio) fn is_too_small(buffer: &mut Buffer, area: Rect) -> bool {
    let too_small = has_no_room(area);
    if too_small {
        let what = folded(&format!("{} × {} is too small", area.width, area.height), area.width);
        let help = format!("make it {} × {} or larger; Ctrl-c quits", LEAST.0, LEAST.1);
        let lines = what.into_iter().map(|l| (l, BOLD));
        let lines = lines.chain(folded(&help, area.width).into_iter().map(|l| (l, Style::new())));
        for ((line, style), y) in lines.zip(area.y..area.bottom()) {
            put(buffer, area.x, y, area.width, &line, style);
        }
    }
    too_small
}

/// Puts text into at most `width` cells and says how many it took. Wide letters are not cut in half, and what is no
/// letter is left out.
pub(in crate::studio) fn put(buffer: &mut Buffer, x: u16, y: u16, width: u16, text: &str, style: Style) -> u16 {
    if !buffer.area.contains((x, y).into()) || width == 0 {
        return 0;
    }
    let (end, _) = buffer.set_stringn(x, y, text, usize::from(width), style);
    end.saturating_sub(x)
}

/// The same, with an ellipsis where it does not fit.
pub(in crate::studio) fn put_short(buffer: &mut Buffer, x: u16, y: u16, width: u16, text: &str, style: Style) -> u16 {
    if cells(text) <= width || width == 0 {
        return put(buffer, x, y, width, text, style);
    }
    let used = put(buffer, x, y, width - 1, text, style);
    used + put(buffer, x + used, y, 1, "…", style)
}

/// How many cells a text takes.
pub(in crate::studio) fn cells(text: &str) -> u16 {
    u16::try_from(text.width()).unwrap_or(u16::MAX)
}

/// The line at the top: where one is, and at the right how it stands.
pub(in crate::studio) fn head(buffer: &mut Buffer, area: Rect, path: &[&str], standing: &str, standing_style: Style) {
    let right = cells(standing);
    let mut x = area.x + put(buffer, area.x, area.y, area.width, " 臉譜 Lianpu", BOLD);
    let room = area.right().saturating_sub(right + 2);
    for part in path {
        x += put(buffer, x, area.y, room.saturating_sub(x), " › ", DIM);
        x += put_short(buffer, x, area.y, room.saturating_sub(x), part, BOLD);
    }
    put(buffer, area.right().saturating_sub(right + 1), area.y, right, standing, standing_style);
}

/// A text in lines of at most `width` cells, broken at spaces where there are any.
pub(in crate::studio) fn folded(text: &str, width: u16) -> Vec<String> {
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
pub(in crate::studio) fn rows<T>(list: Rect, chosen: usize, items: &[T]) -> impl Iterator<Item = (usize, (u16, &T))> {
    let height = usize::from(list.height);
    let first = (chosen + 1).saturating_sub(height);
    (first..).zip((list.y..list.bottom()).zip(&items[first.min(items.len())..]))
}

/// Marks the chosen row.
pub(in crate::studio) fn chosen_row(buffer: &mut Buffer, list: Rect, y: u16, chosen: bool) -> Style {
    if !chosen {
        return Style::new();
    }
    buffer.set_style(Rect::new(list.x, y, list.width, 1), CHOSEN);
    put(buffer, list.x, y, 1, "▸", CHOSEN);
    CHOSEN
}

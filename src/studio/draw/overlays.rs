//! What lies on top of a screen: the help, a line to type, a question, a running export.

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::style::{Modifier, Style};
use ratatui::widgets::{Block, BorderType, Clear, Widget};

use super::lists::folded;
use super::{BOLD, CHOSEN, DIM, Layout, cells, put, put_short};
use crate::studio::aligning::Spotted;
use crate::studio::export::Progress;
use crate::studio::keys::{Place, help_of};
use crate::studio::overlay::{Overlay, Prompt};
use crate::studio::state::State;

/// Draws what lies on top, in order; where the caret stands, if a line is being typed.
pub(super) fn overlays(buffer: &mut Buffer, area: Rect, layout: Option<&Layout>, state: &State) -> Option<Position> {
    let mut caret = None;
    for overlay in &state.overlays {
        caret = match overlay {
            Overlay::Help { of, scrolled } => {
                help(buffer, area, *of, *scrolled);
                None
            }
            Overlay::Notes { title, lines, scrolled } => {
                notes(buffer, area, title, lines, *scrolled);
                None
            }
            Overlay::Doubts { list, chosen } => {
                doubts(buffer, area, list, *chosen);
                None
            }
            Overlay::Prompt(asked) => Some(prompt(buffer, area, layout, asked, state)),
            Overlay::Confirm(_) => {
                confirm(buffer, area);
                None
            }
            Overlay::Export { progress, .. } => {
                export(buffer, area, progress);
                None
            }
        };
    }
    caret
}

/// A box in the middle, empty; its inside. It stands in the upper half, where it does not cover the lanes.
fn boxed(buffer: &mut Buffer, area: Rect, width: u16, height: u16, title: &str) -> Rect {
    let (width, height) = ((width + 4).min(area.width), (height + 2).min(area.height));
    let place = Rect::new(area.x + (area.width - width) / 2, area.y + (area.height - height) / 3, width, height);
    boxed_at(buffer, place, title)
}

/// An empty box at a place; its inside.
fn boxed_at(buffer: &mut Buffer, place: Rect, title: &str) -> Rect {
    // A wide letter whose half lies under the edge would leave the edge one cell off.
    if place.x > buffer.area.x {
        for y in place.y..place.bottom() {
            if let Some(cell) = buffer.cell_mut((place.x - 1, y))
                && cells(cell.symbol()) > 1
            {
                cell.set_char(' ');
            }
        }
    }
    Clear.render(place, buffer);
    let block = Block::bordered().border_type(BorderType::Rounded).title(format!(" {title} ")).title_style(BOLD);
    block.render(place, buffer);
    Rect::new(place.x + 2, place.y + 1, place.width.saturating_sub(4), place.height.saturating_sub(2))
}

/// Every key of a place.
pub(in crate::studio) fn help(buffer: &mut Buffer, area: Rect, of: Place, scrolled: usize) {
    let rows: Vec<(String, &str)> = help_of(of).collect();
    let keys = rows.iter().map(|r| cells(&r.0)).max().unwrap_or(0) + 2;
    let width = rows.iter().map(|r| keys + cells(r.1)).max().unwrap_or(0);
    // Two lines above and below stay free, so that one sees that something lies below.
    let height = (rows.len() as u16).min(area.height.saturating_sub(4));
    let first = scrolled.min(rows.len() - usize::from(height));
    let more = rows.len() > usize::from(height);
    let title = if more { "Keys: ↑ ↓ for more, Esc closes" } else { "Keys: Esc closes" };
    let inside = boxed(buffer, area, width, height, title);
    for ((names, help), y) in rows[first..].iter().zip(inside.y..inside.bottom()) {
        put(buffer, inside.x, y, keys, names, BOLD);
        put_short(buffer, inside.x + keys, y, inside.width.saturating_sub(keys), help, Style::new());
    }
}

/// Lines to read, a mark before each.
fn notes(buffer: &mut Buffer, area: Rect, title: &str, lines: &[String], scrolled: usize) {
    const WIDEST: u16 = 100;
    let width = area.width.saturating_sub(8).min(WIDEST);
    let mut rows: Vec<String> = Vec::new();
    for line in lines.iter().flat_map(|text| text.lines().take(1).chain(text.lines().skip(1))) {
        let folded = folded(line.trim(), width.saturating_sub(2));
        rows.extend(
            folded.into_iter().enumerate().map(|(n, row)| format!("{}{row}", if n == 0 { "· " } else { "  " })),
        );
    }
    let height = (rows.len() as u16).min(area.height.saturating_sub(4));
    let first = scrolled.min(rows.len().saturating_sub(usize::from(height)));
    let more = rows.len() > usize::from(height);
    let title = if more { format!("{title}: ↑ ↓ for more, Esc closes") } else { format!("{title}: Esc closes") };
    let inside = boxed(buffer, area, width, height, &title);
    for (row, y) in rows[first..].iter().zip(inside.y..inside.bottom()) {
        put_short(buffer, inside.x, y, inside.width, row, Style::new());
    }
}

/// The box of a prompt and the text below its line. Beside the face where that has room, so that what is being changed
/// stays in sight.
fn prompt_box(
    buffer: &mut Buffer,
    area: Rect,
    layout: Option<&Layout>,
    title: &str,
    below: &str,
) -> (Vec<String>, Rect) {
    const WIDEST: u16 = 70;
    if let Some(panel) = layout.map(|l| l.panel) {
        let width = panel.width.min(WIDEST + 4);
        let lines = folded(below, width.saturating_sub(4));
        let height = 4 + lines.len() as u16;
        if height <= panel.height && cells(title) + 4 <= width {
            let inside = boxed_at(buffer, Rect { width, height, ..panel }, title);
            return (lines, inside);
        }
    }
    let width = area.width.saturating_sub(8).min(WIDEST);
    let lines = folded(below, width);
    let inside = boxed(buffer, area, width, 2 + lines.len() as u16, title);
    (lines, inside)
}

/// A line to type; where its caret stands.
fn prompt(buffer: &mut Buffer, area: Rect, layout: Option<&Layout>, prompt: &Prompt, state: &State) -> Position {
    let below = prompt.fault.as_deref().unwrap_or(&prompt.help);
    let (lines, inside) = prompt_box(buffer, area, layout, &prompt.title, below);
    // Of a long line the part before the caret is shown.
    let room = inside.width.saturating_sub(3);
    let mut start = 0;
    let before = prompt.line.before_caret();
    while cells(&before[start..]) > room {
        start += before[start..].chars().next().map_or(1, char::len_utf8);
    }
    let typed = if prompt.line.is_proposed() { CHOSEN } else { BOLD };
    put(buffer, inside.x, inside.y, 2, "> ", DIM);
    put(buffer, inside.x + 2, inside.y, inside.width - 2, &prompt.line.text()[start..], typed);
    let style = if prompt.fault.is_some() { state.colours.fault() } else { DIM };
    for (line, y) in lines.iter().zip(inside.y + 2..inside.bottom()) {
        put(buffer, inside.x, y, inside.width, line, style);
    }
    Position::new(inside.x + 2 + cells(&before[start..]), inside.y)
}

/// The places to look at, one a line.
fn doubts(buffer: &mut Buffer, area: Rect, list: &[Spotted], chosen: usize) {
    const WIDEST: u16 = 60;
    let time = |s: &Spotted| s.at.map_or(String::new(), |at| format!("{at:.2} s"));
    let times = list.iter().map(|s| cells(&time(s))).max().unwrap_or(0) + 2;
    let texts = list.iter().map(|s| cells(&s.text)).max().unwrap_or(0);
    let width = (times + texts).clamp(40, WIDEST.min(area.width.saturating_sub(8)).max(40));
    let height = (list.len() as u16).min(area.height.saturating_sub(4));
    let title = format!("{} to look at: Enter goes there", list.len());
    let inside = boxed(buffer, area, width, height, &title);
    let first = (chosen + 1).saturating_sub(usize::from(height));
    for ((index, spotted), y) in list.iter().enumerate().skip(first).zip(inside.y..inside.bottom()) {
        let style = if index == chosen { CHOSEN } else { Style::new() };
        if index == chosen {
            buffer.set_style(Rect::new(inside.x, y, inside.width, 1), CHOSEN);
        }
        put(buffer, inside.x, y, times, &time(spotted), style);
        put_short(buffer, inside.x + times, y, inside.width.saturating_sub(times), &spotted.text, style.patch(BOLD));
    }
}

fn confirm(buffer: &mut Buffer, area: Rect) {
    let rows = [
        ("s", "save them, then go"),
        ("d", "discard them, then go"),
        ("k", "keep them for the next time, and go"),
        ("Esc", "stay here"),
    ];
    let inside = boxed(buffer, area, 44, rows.len() as u16, "There are unsaved changes");
    for ((key, text), y) in rows.into_iter().zip(inside.y..inside.bottom()) {
        put(buffer, inside.x, y, 4, key, BOLD);
        put(buffer, inside.x + 5, y, inside.width.saturating_sub(5), text, Style::new());
    }
}

fn export(buffer: &mut Buffer, area: Rect, progress: &Progress) {
    let inside = boxed(buffer, area, 50, 2, "Exporting: Esc stops it");
    let share = if progress.total == 0 { 0.0 } else { progress.done as f64 / progress.total as f64 };
    let full = (share.clamp(0.0, 1.0) * f64::from(inside.width)).round() as u16;
    for column in 0..inside.width {
        let text = if column < full { "█" } else { "░" };
        put(buffer, inside.x + column, inside.y, 1, text, Style::new().remove_modifier(Modifier::DIM));
    }
    let text = match progress.total {
        0 => progress.what.clone(),
        total => format!("{} of {total}   {}", progress.done, progress.what),
    };
    put_short(buffer, inside.x, inside.y + 1, inside.width, &text, Style::new());
}

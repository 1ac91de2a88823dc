//! Boxes on top of a page, and the list of keys in one.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::widgets::{Block, BorderType, Clear, Widget};

use super::text::{BOLD, cells, put, put_short};
use crate::studio::app::keys::{Place, help_of};

/// A box in the middle, empty; its inside. It stands in the upper half, where it does not cover the lanes.
pub(in crate::studio) fn boxed(buffer: &mut Buffer, area: Rect, width: u16, height: u16, title: &str) -> Rect {
    let (width, height) = ((width + 4).min(area.width), (height + 2).min(area.height));
    let place = Rect::new(area.x + (area.width - width) / 2, area.y + (area.height - height) / 3, width, height);
    boxed_at(buffer, place, title)
}

/// An empty box at a place; its inside.
pub(in crate::studio) fn boxed_at(buffer: &mut Buffer, place: Rect, title: &str) -> Rect {
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

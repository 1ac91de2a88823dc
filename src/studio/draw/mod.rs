//! Drawing: a read-only look at the state becomes cells. Nothing is decided here.

mod bars;
mod curves;
mod face;
mod foot;
mod keyrows;
mod layout;
mod lists;
mod overlays;
mod phones;
mod said;
mod sound;
mod spectrum;
mod tap;
mod timeline;
mod tone;

pub(super) use face::FaceLayout;
pub(super) use foot::{Foot, foot};
pub(super) use layout::Layout;
pub(super) use overlays::help;

use ratatui::Frame;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};
use unicode_width::UnicodeWidthStr;

use super::Place;
use super::picture::FacePicture;
use super::state::State;

/// The smallest terminal that a studio fits into.
pub(super) const LEAST: (u16, u16) = (60, 20);

pub(super) const BOLD: Style = Style::new().add_modifier(Modifier::BOLD);
pub(super) const DIM: Style = Style::new().add_modifier(Modifier::DIM);
pub(super) const CHOSEN: Style = Style::new().add_modifier(Modifier::REVERSED);

/// What was painted for this frame.
#[derive(Clone, Copy)]
pub(super) struct Pictures<'a> {
    /// The face of the clip.
    pub face: &'a FacePicture,
    /// The cartoon on the page of a face.
    pub cartoon: &'a FacePicture,
    /// The stage of the search.
    pub stage: &'a FacePicture,
}

/// Draws everything.
pub(super) fn screen(frame: &mut Frame<'_>, state: &State, layout: Option<&Layout>, pictures: Pictures<'_>) {
    let area = frame.area();
    let buffer = frame.buffer_mut();
    if is_too_small(buffer, area) {
        return;
    }
    match (state.screen(), layout) {
        (Place::Timeline, Some(layout)) => timeline::timeline(buffer, layout, state, pictures.face),
        (Place::Face, _) => face::face(buffer, area, state, pictures),
        (Place::Lesson, _) => lists::lesson(buffer, area, state),
        _ => lists::lessons(buffer, area, state),
    }
    let at_foot = Foot {
        place: state.place(),
        lane: state.editor.as_ref().map(|e| e.lane),
        opens: state.lesson().is_some(),
        message: state.message.as_ref(),
        busy: state.busy.as_deref(),
    };
    foot(buffer, area, at_foot, state.colours);
    if let Some(caret) = overlays::overlays(buffer, area, layout, state) {
        frame.set_cursor_position(caret);
    }
}

/// Whether a terminal is too small for anything.
pub(super) fn has_no_room(area: Rect) -> bool {
    area.width < LEAST.0 || area.height < LEAST.1
}

/// Says so where a terminal is too small for anything else.
pub(super) fn is_too_small(buffer: &mut Buffer, area: Rect) -> bool {
    let too_small = has_no_room(area);
    if too_small {
        let what = lists::folded(&format!("{} × {} is too small", area.width, area.height), area.width);
        let help = format!("make it {} × {} or larger; Ctrl-c quits", LEAST.0, LEAST.1);
        let lines = what.into_iter().map(|l| (l, BOLD));
        let lines = lines.chain(lists::folded(&help, area.width).into_iter().map(|l| (l, Style::new())));
        for ((line, style), y) in lines.zip(area.y..area.bottom()) {
            put(buffer, area.x, y, area.width, &line, style);
        }
    }
    too_small
}

/// Puts text into at most `width` cells and says how many it took. Wide letters are not cut in half, and what is no
/// letter is left out.
pub(super) fn put(buffer: &mut Buffer, x: u16, y: u16, width: u16, text: &str, style: Style) -> u16 {
    if !buffer.area.contains((x, y).into()) || width == 0 {
        return 0;
    }
    let (end, _) = buffer.set_stringn(x, y, text, usize::from(width), style);
    end.saturating_sub(x)
}

/// The same, with an ellipsis where it does not fit.
pub(super) fn put_short(buffer: &mut Buffer, x: u16, y: u16, width: u16, text: &str, style: Style) -> u16 {
    if cells(text) <= width || width == 0 {
        return put(buffer, x, y, width, text, style);
    }
    let used = put(buffer, x, y, width - 1, text, style);
    used + put(buffer, x + used, y, 1, "…", style)
}

/// How many cells a text takes.
pub(super) fn cells(text: &str) -> u16 {
    u16::try_from(text.width()).unwrap_or(u16::MAX)
}

/// The line at the top: where one is, and at the right how it stands.
pub(super) fn head(buffer: &mut Buffer, area: Rect, path: &[&str], standing: &str, standing_style: Style) {
    let right = cells(standing);
    let mut x = area.x + put(buffer, area.x, area.y, area.width, " 臉譜 Lianpu", BOLD);
    let room = area.right().saturating_sub(right + 2);
    for part in path {
        x += put(buffer, x, area.y, room.saturating_sub(x), " › ", DIM);
        x += put_short(buffer, x, area.y, room.saturating_sub(x), part, BOLD);
    }
    put(buffer, area.right().saturating_sub(right + 1), area.y, right, standing, standing_style);
}

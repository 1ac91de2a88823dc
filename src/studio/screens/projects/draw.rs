//! Drawing the list of projects.

use std::path::Path;

use ratatui::layout::Rect;
use ratatui::style::Style;

use super::listed::Listed;
use crate::studio::app::stack::View;
use crate::studio::widgets::text::{BOLD, cells, chosen_row, head, put, put_short, rows};

/// The projects of the folder.
pub(super) fn projects(view: &mut View<'_>, folder: &Path, projects: &[Listed], chosen: usize) {
    let (area, colours) = (view.area, view.shell.colours);
    let buffer = &mut *view.buffer;
    head(buffer, area, &[&folder.display().to_string()], "", Style::new());
    let list = Rect::new(area.x + 1, area.y + 2, area.width - 2, area.height - 4);
    if projects.is_empty() {
        put(buffer, list.x, list.y, list.width, "There are no lessons here yet.", BOLD);
        let help = "lianpu new NAME --speech FILE --script FILE  makes one.";
        put(buffer, list.x, list.y + 1, list.width, help, Style::new());
        return;
    }
    let names = projects.iter().map(|l| cells(&l.name)).max().unwrap_or(0).min(24) + 3;
    for (index, (y, listed)) in rows(list, chosen, projects) {
        let style = chosen_row(buffer, list, y, index == chosen);
        put_short(buffer, list.x + 1, y, names, &listed.name, style.patch(BOLD));
        let (text, style) = match &listed.manifest {
            Ok((title, 1)) => (format!("{title}   1 clip"), style),
            Ok((title, clips)) => (format!("{title}   {clips} clips"), style),
            Err(fault) => (format!("✗ {}", fault.what()), style.patch(colours.fault())),
        };
        put_short(buffer, list.x + 1 + names, y, list.width.saturating_sub(names + 2), &text, style);
    }
}

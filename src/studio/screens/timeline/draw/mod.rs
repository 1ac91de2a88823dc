//! The screen of a clip's timeline: face and ratios above, the lanes over one ruler below.

mod bars;
mod curves;
mod keyrows;
mod layout;
mod phones;
mod said;
mod sound;
mod spectrum;
mod tone;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Color, Modifier, Style};

pub(in crate::studio) use self::layout::Layout;
use super::editor::Editor;
use crate::project::{Clip, Concern};
use crate::studio::app::colours::Colours;
use crate::studio::app::lane::Lane;
use crate::studio::app::project::OpenProject;
use crate::studio::app::stack::View;
use crate::studio::widgets::photo_picture;
use crate::studio::widgets::picture::FacePicture;
use crate::studio::widgets::text::{BOLD, DIM, cells, head, put};
use crate::timeline::Track;

/// What a screen above the timeline draws on it, in place of the panel and on the ruler.
pub(in crate::studio) struct Over<'a> {
    /// Draws in place of the panel.
    pub panel: &'a dyn Fn(&mut Buffer, Rect),
    /// Draws on the ruler.
    pub marks: &'a dyn Fn(&mut Buffer, &Layout),
}

/// Draws the timeline of a clip, with the picture of its face.
pub(in crate::studio) fn timeline(
    view: &mut View<'_>,
    project: &OpenProject,
    editor: &Editor,
    face: &FacePicture,
    over: Option<&Over<'_>>,
) {
    let (lesson, shell) = (&project.lesson, view.shell);
    let (clip, colours) = (&lesson.clips[editor.clip], shell.colours);
    let layout = &Layout::of(view.area, editor, clip, shell);
    let buffer = &mut *view.buffer;
    let (standing, style) = project.standing(colours);
    let standing = match (&project.following, &shell.aligning) {
        (Some(following), _) => format!("{}   {standing}", following.told()),
        (None, Some(_)) => format!("aligning…   {standing}"),
        (None, None) => standing.to_owned(),
    };
    head(buffer, layout.area, &[&lesson.manifest.title, &clip.entry.name], &standing, style);
    face.put(buffer, layout.face);
    if let Some(photo) = editor.footage.picture().filter(|_| layout.video.width > 0) {
        photo_picture::frame(buffer, layout.video, photo, colours);
    }
    match over {
        Some(over) => (over.panel)(buffer, layout.panel),
        None => bars::panel(buffer, layout.panel, editor, clip, colours),
    }
    let heard = project.heard.get(&editor.clip);
    let on = |lane| editor.lane == lane;
    ruler(buffer, layout, editor);
    lost(buffer, layout, editor, clip, colours);
    if let Some(over) = over {
        (over.marks)(buffer, layout);
    }
    if layout.wave.height > 0 {
        name(buffer, layout.wave, "sound", false);
        sound::wave(buffer, layout.wave, editor, clip);
    }
    if layout.spectrum.height > 0 {
        name(buffer, layout.spectrum, "spectrum", false);
        spectrum::spectrum(
            buffer,
            layout.spectrum,
            heard.and_then(|h| h.spectrogram.as_deref()),
            editor,
            clip,
            colours,
        );
    }
    if layout.tone.height > 0 {
        name(buffer, layout.tone, "pitch", false);
        tone::tone(buffer, layout.tone, heard.and_then(|h| h.tone.as_deref()), editor, clip);
    }
    name(buffer, layout.said, "said", on(Lane::Syllables));
    said::syllables(buffer, layout, editor, clip, colours);
    if layout.phones.height > 0 {
        name(buffer, layout.phones, "phones", false);
        phones::phones(buffer, layout.phones, editor, clip);
    }
    name(buffer, layout.mouth, "mouth", on(Lane::Keys(Track::Mouth)));
    keyrows::mouth(buffer, layout.mouth, editor, colours);
    name(buffer, layout.curves, "ratio", false);
    curves::curves(buffer, layout.curves, editor, clip, colours);
    for (lane, row) in &layout.keys {
        name(buffer, *row, lane.map_or("keys", Lane::name), lane.is_some_and(on));
        keyrows::keys(buffer, *row, *lane, editor, clip, colours);
    }
    cursor(buffer, layout, editor);
}

/// The name of a lane at its left, marked where one stands on it.
fn name(buffer: &mut Buffer, lane: Rect, text: &str, here: bool) {
    let (mark, style) = if here { ("▸", BOLD) } else { (" ", DIM) };
    let x = buffer.area.x;
    let used = put(buffer, x, lane.y, lane.x - x, mark, BOLD);
    put(buffer, x + used, lane.y, lane.x - x - used, text, style);
}

/// The ruler: seconds at round steps, and the marked stretch.
fn ruler(buffer: &mut Buffer, layout: &Layout, editor: &Editor) {
    const STEPS: [f64; 15] = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 30.0, 60.0, 120.0, 300.0, 600.0];
    let (row, window, columns) = (layout.ruler, editor.window, layout.columns());
    name(buffer, row, "seconds", false);
    if let Some(mark) = editor.mark {
        let (from, to) = (mark.min(editor.cursor), mark.max(editor.cursor));
        let (first, last) = (window.column(from, columns), window.column(to, columns));
        for column in first.max(0)..=last.min(i32::from(columns) - 1) {
            put(buffer, row.x + column as u16, row.y, 1, "═", Style::new());
        }
    }
    let per_column = window.span / f64::from(columns);
    let step = STEPS.into_iter().find(|s| s / per_column >= 9.0).unwrap_or(1200.0);
    let mut number = (window.from / step - 1e-6).ceil().max(0.0);
    while number * step < window.to().min(editor.timeline.duration()) {
        let time = number * step;
        if let Some(column) = window.shown_column(time, columns) {
            let text = format!("╷{}", clock(time, step));
            if column + cells(&text) <= columns + 5 {
                put(buffer, row.x + column, row.y, cells(&text), &text, Style::new());
            }
        }
        number += 1.0;
    }
}

/// Stretches of the video without a face, on the ruler too: on low screens the curves cover their marks.
fn lost(buffer: &mut Buffer, layout: &Layout, editor: &Editor, clip: &Clip, colours: Colours) {
    let (row, columns) = (layout.ruler, layout.columns());
    for doubt in clip.lost().into_iter().filter(|d| d.what == Concern::FaceLost) {
        let (start, end) = (editor.window.column(doubt.start, columns), editor.window.column(doubt.end, columns));
        for column in start.max(0)..end.max(start + 1).min(i32::from(columns)) {
            let x = row.x + column as u16;
            if buffer.cell((x, row.y)).is_some_and(|cell| cell.symbol() == " ") {
                put(buffer, x, row.y, 1, "░", colours.warning());
            }
        }
    }
}

/// A time of the ruler, as exact as its step: `0.25`, `1:05`.
fn clock(time: f64, step: f64) -> String {
    let decimals = if step < 0.1 { 2 } else { usize::from(step < 1.0) };
    if time < 60.0 {
        return format!("{time:.decimals$}");
    }
    let minutes = (time / 60.0 + 1e-9).floor();
    let seconds = time - minutes * 60.0;
    let width = if decimals > 0 { 3 + decimals } else { 2 };
    format!("{minutes}:{seconds:0width$.decimals$}")
}

/// The cursor: a line through all lanes. Where something stands, it is turned over instead of being covered.
fn cursor(buffer: &mut Buffer, layout: &Layout, editor: &Editor) {
    let Some(column) = editor.window.shown_column(editor.cursor, layout.columns()) else { return };
    let x = layout.ruler.x + column;
    for y in layout.ruler.y..layout.bottom() {
        let Some(cell) = buffer.cell_mut((x, y)) else { continue };
        let style = cell.style();
        if y == layout.ruler.y {
            cell.set_char('▼').set_style(Style::new().add_modifier(Modifier::BOLD));
        } else if layout.spectrum.contains((x, y).into()) && matches!(style.bg, Some(Color::Indexed(_))) {
            cell.set_char('│').set_style(style.fg(Color::Indexed(255)).remove_modifier(Modifier::REVERSED));
        } else if cell.symbol() == " " && !style.add_modifier.contains(Modifier::REVERSED) {
            cell.set_char('│').set_style(Style::new());
        } else {
            let turned = style.add_modifier.contains(Modifier::REVERSED);
            let change =
                if turned { style.remove_modifier(Modifier::REVERSED) } else { style.add_modifier(Modifier::REVERSED) };
            cell.set_style(change);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_as_exact_as_the_step_of_the_ruler() {
        assert_eq!(clock(0.25, 0.05), "0.25");
        assert_eq!(clock(3.0, 1.0), "3");
        assert_eq!(clock(65.0, 5.0), "1:05");
        assert_eq!(clock(65.5, 0.5), "1:05.5");
        assert_eq!(clock(600.0, 60.0), "10:00");
    }
}

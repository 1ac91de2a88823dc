//! Several drawings on one sheet, each over its caption.

use super::axes::{TEXT, chart};
use super::{GREY, INK};
use crate::drawing::{Anchor, Colour, Drawing, Item};
use crate::geometry::{Point, Rect, Shape};

/// How wide a drawing's place is.
const CELL: f64 = 300.0;
/// Between places, and round the sheet.
const GAP: f64 = 22.0;
/// From one line of a caption to the next.
const LINE: f64 = 1.38 * TEXT;
/// What lies behind the places, so that white drawings have an edge.
const PAPER: Colour = Colour::rgb(0xF6, 0xF5, 0xF2);

/// A contact sheet: drawings in rows of `columns`, all of one width, each over its caption. The first line of a caption,
/// up to its first full stop or colon, stands out.
#[must_use]
pub fn sheet(parts: &[(String, Drawing)], columns: usize) -> Drawing {
    let columns = columns.clamp(1, parts.len().max(1));
    let width = columns as f64 * (CELL + GAP) + GAP;
    let mut items = Vec::new();
    let mut y = GAP;
    for row in parts.chunks(columns) {
        let height_of = |d: &Drawing| (CELL * d.view.height() / d.view.width()).min(1.6 * CELL);
        let height = row.iter().map(|(_, d)| height_of(d)).fold(0.0, f64::max);
        let mut lines_below = 0;
        for (column, (caption, drawing)) in row.iter().enumerate() {
            let x = GAP + column as f64 * (CELL + GAP);
            let frame = Rect::new(x, y, x + CELL, y + height_of(drawing));
            if let Some(colour) = drawing.background {
                items.push(Item::area("", frame.to_path(0.1), colour));
            }
            items.push(drawing.placed_in(frame));
            let (head, rest) = split(caption);
            let top = y + height_of(drawing) + LINE;
            let head = wrapped(head, CELL, TEXT + 1.0).into_iter().map(|l| (l, TEXT + 1.0, INK));
            let lines = head.chain(wrapped(rest, CELL, TEXT).into_iter().map(|l| (l, TEXT, GREY)));
            for (i, (line, size, colour)) in lines.enumerate() {
                items.push(Item::text(Point::new(x, top + i as f64 * LINE), size, Anchor::Start, colour, line));
                lines_below = lines_below.max(i + 1);
            }
        }
        y += height + lines_below as f64 * LINE + 1.4 * GAP;
    }
    let captions: Vec<&str> = parts.iter().map(|(caption, _)| split(caption).0).collect();
    let mut drawing = chart("Contact sheet", &captions.join(", "), width, y.max(2.0 * GAP), items);
    drawing.background = Some(PAPER);
    drawing
}

/// A caption's first few words and what follows them.
fn split(caption: &str) -> (&str, &str) {
    let (head, rest) = caption.split_once([':', '.']).unwrap_or((caption, ""));
    (head, rest.trim_start())
}

/// Lines of text that fit into `width`. Letters are taken as half as wide as high, which the sheet's font keeps on
/// average and texts of more than a few words do not exceed.
fn wrapped(text: &str, width: f64, size: f64) -> Vec<String> {
    let fits = (width / (0.52 * size)) as usize;
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= fits => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn captions_break_between_words_and_keep_them_all() {
        let text = "binary edges with the three lines that divide brows, eyes, nose and mouth";
        let lines = wrapped(text, 200.0, 13.0);
        assert!(lines.len() > 1 && lines.iter().all(|l| l.chars().count() <= 29), "{lines:?}");
        assert_eq!(lines.join(" "), text);
        assert_eq!(split("Fig. 3"), ("Fig", "3"));
        assert!(wrapped("", 200.0, 13.0).is_empty());
    }

    #[test]
    fn a_sheet_grows_by_rows() {
        let part = || ("a: b".to_owned(), chart("", "", 100.0, 100.0, Vec::new()));
        let (one, two) = (sheet(&[part(), part()], 2), sheet(&[part(), part(), part()], 2));
        assert_eq!(one.view.width(), two.view.width());
        assert!(two.view.height() > 1.8 * one.view.height());
        assert!(sheet(&[], 3).view.height() > 0.0);
    }
}

//! The feature points of a face on its photo, as letters.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect as Cells;
use ratatui::style::{Modifier, Style};

use super::desk::FaceDesk;
use crate::face::{FeaturePoint, How, Placed};
use crate::geometry::{Point, Vec2};
use crate::photo::Photo;
use crate::studio::app::colours::Colours;
use crate::studio::widgets::photo_picture::{ground, size_in};

/// Puts the desk's part of the photo into the middle of an area, and the shot's points on it.
pub(crate) fn put(
    buffer: &mut Buffer,
    area: Cells,
    photo: &Photo,
    desk: &FaceDesk,
    points: &[(FeaturePoint, Placed)],
    colours: Colours,
) {
    let view = desk.view(points, Vec2::new(photo.width() as f64, photo.height() as f64));
    let size = size_in(view, area.as_size());
    let place = Cells::new(
        area.x + (area.width - size.width) / 2,
        area.y + (area.height - size.height) / 2,
        size.width,
        size.height,
    );
    let step = ground(buffer, place, photo, view, colours);
    let cell_of = |p: Point| {
        let x = ((p.x - view.x0) / step.x).floor();
        let y = ((p.y - view.y0) / step.y / 2.0).floor();
        let inside = x >= 0.0 && y >= 0.0 && x < f64::from(size.width) && y < f64::from(size.height);
        inside.then(|| (place.x + x as u16, place.y + y as u16))
    };
    let mut mark = |at: Point, sign: char, style: Style| {
        if let Some(cell) = cell_of(at).and_then(|at| buffer.cell_mut(at)) {
            let ground = cell.bg;
            cell.set_char(sign).set_style(style.bg(ground));
        }
    };
    if let Some(placing) = &desk.placing {
        for given in &placing.given {
            mark(*given, '●', colours.ink(SET));
        }
        mark(placing.cross, '╋', colours.ink(CHOSEN).add_modifier(Modifier::BOLD));
        return;
    }
    for dot in &desk.dots {
        mark(*dot, '·', colours.ink(SET).add_modifier(Modifier::BOLD));
    }
    for (_, placed) in points {
        let (sign, colour) = match placed.how {
            How::Found => ('•', FOUND),
            How::Rule => ('◦', RULE),
            How::Hand => ('■', SET),
        };
        mark(placed.at, sign, colours.ink(colour).add_modifier(Modifier::BOLD));
    }
    let other = desk.point.mirror();
    if desk.both
        && let Some((_, placed)) = points.iter().find(|p| p.0 == other)
    {
        mark(placed.at, '◇', colours.ink(CHOSEN).add_modifier(Modifier::BOLD));
    }
    if let Some((_, placed)) = points.iter().find(|p| p.0 == desk.point) {
        mark(placed.at, '◆', colours.ink(CHOSEN).add_modifier(Modifier::BOLD));
    }
}

/// Found in the photo: bright green shows on skin and on hair.
pub(crate) const FOUND: [u8; 3] = [80, 255, 130];
/// Placed by rule.
pub(crate) const RULE: [u8; 3] = [255, 230, 80];
/// Set by hand.
pub(crate) const SET: [u8; 3] = [90, 190, 255];
/// The chosen one.
pub(crate) const CHOSEN: [u8; 3] = [255, 60, 220];

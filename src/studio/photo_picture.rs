//! A photo in cells, with feature points on it as letters.

use ratatui::buffer::Buffer;
use ratatui::layout::{Rect as Cells, Size};
use ratatui::style::{Modifier, Style};

use super::face_desk::FaceDesk;
use super::look::Colours;
use crate::face::{Face, FeaturePoint, How};
use crate::geometry::{Point, Rect, Vec2};
use crate::photo::Photo;

/// The photo's part as large as an area allows, in cells: its shape is kept, a cell being twice as high as wide.
#[must_use]
pub fn size_in(view: Rect, area: Size) -> Size {
    let aspect = (view.width() / view.height().max(1e-6)).clamp(0.1, 10.0);
    let wide = (f64::from(area.height) * 2.0 * aspect).round().clamp(1.0, f64::from(area.width.max(1))) as u16;
    let high = (f64::from(wide) / aspect / 2.0).round().clamp(1.0, f64::from(area.height.max(1))) as u16;
    Size::new(wide, high)
}

/// Puts the desk's part of the photo into the middle of an area, and the face's points on it.
pub fn put(buffer: &mut Buffer, area: Cells, photo: &Photo, desk: &FaceDesk, face: Option<&Face>, colours: Colours) {
    let view = desk.view(face, Vec2::new(photo.width() as f64, photo.height() as f64));
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
    let Some(face) = face else { return };
    for point in FeaturePoint::all() {
        let Some(placed) = face.placed(point) else { continue };
        let (sign, colour) = match placed.how {
            How::Found => ('•', FOUND),
            How::Rule => ('◦', RULE),
            How::Hand => ('■', SET),
        };
        mark(placed.at, sign, colours.ink(colour).add_modifier(Modifier::BOLD));
    }
    let other = desk.point.mirror();
    if desk.both
        && let Some(placed) = face.placed(other)
    {
        mark(placed.at, '◇', colours.ink(CHOSEN).add_modifier(Modifier::BOLD));
    }
    if let Some(placed) = face.placed(desk.point) {
        mark(placed.at, '◆', colours.ink(CHOSEN).add_modifier(Modifier::BOLD));
    }
}

/// Puts a whole photo into the middle of an area.
pub fn frame(buffer: &mut Buffer, area: Cells, photo: &Photo, colours: Colours) {
    let view = Rect::new(0.0, 0.0, photo.width() as f64, photo.height() as f64);
    let size = size_in(view, area.as_size());
    let (x, y) = (area.x + (area.width - size.width) / 2, area.y + (area.height - size.height) / 2);
    ground(buffer, Cells::new(x, y, size.width, size.height), photo, view, colours);
}

/// Fills cells with a part of a photo, two pixels a cell; how large such a pixel is in the photo.
fn ground(buffer: &mut Buffer, place: Cells, photo: &Photo, view: Rect, colours: Colours) -> Vec2 {
    let step = Vec2::new(view.width() / f64::from(place.width), view.height() / f64::from(place.height) / 2.0);
    for y in 0..place.height {
        for x in 0..place.width {
            let pixel = |half: u16| {
                let corner = view.origin() + Vec2::new(f64::from(x) * step.x, f64::from(y * 2 + half) * step.y);
                mean(photo, corner, step)
            };
            let (above, below) = (pixel(0), pixel(1));
            if let Some(cell) = buffer.cell_mut((place.x + x, place.y + y)) {
                if colours == Colours::None {
                    cell.set_char(shade(above, below));
                } else {
                    cell.set_char('▀');
                    cell.set_style(Style::new().fg(colours.colour(above)).bg(colours.colour(below)));
                }
            }
        }
    }
    step
}

/// Found in the photo: bright green shows on skin and on hair.
pub const FOUND: [u8; 3] = [80, 255, 130];
/// Placed by rule.
pub const RULE: [u8; 3] = [255, 230, 80];
/// Set by hand.
pub const SET: [u8; 3] = [90, 190, 255];
/// The chosen one.
pub const CHOSEN: [u8; 3] = [255, 60, 220];

/// The mean colour of a part of the photo, at most four samples each way.
fn mean(photo: &Photo, corner: Point, step: Vec2) -> [u8; 3] {
    let count = |length: f64| (length.round() as i32).clamp(1, 4);
    let (columns, rows) = (count(step.x), count(step.y));
    let mut sum = [0_u32; 3];
    for row in 0..rows {
        for column in 0..columns {
            let x = corner.x + (f64::from(column) + 0.5) * step.x / f64::from(columns);
            let y = corner.y + (f64::from(row) + 0.5) * step.y / f64::from(rows);
            let pixel = photo.at(x.round() as isize, y.round() as isize);
            sum.iter_mut().zip(pixel).for_each(|(s, v)| *s += u32::from(v));
        }
    }
    sum.map(|s| (s / (columns * rows) as u32) as u8)
}

/// How light a cell is, where there are no colours.
fn shade(above: [u8; 3], below: [u8; 3]) -> char {
    let light = |[r, g, b]: [u8; 3]| (u32::from(r) * 3 + u32::from(g) * 6 + u32::from(b)) / 10;
    [' ', '░', '▒', '▓', '█'][((light(above) + light(below)) / 2 * 5 / 256) as usize]
}

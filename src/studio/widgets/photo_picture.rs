//! A photo in cells.

use ratatui::buffer::Buffer;
use ratatui::layout::{Rect as Cells, Size};
use ratatui::style::Style;

use crate::geometry::{Point, Rect, Vec2};
use crate::photo::Photo;
use crate::studio::app::colours::Colours;

/// The photo's part as large as an area allows, in cells: its shape is kept, a cell being twice as high as wide.
#[must_use]
pub(crate) fn size_in(view: Rect, area: Size) -> Size {
    let aspect = (view.width() / view.height().max(1e-6)).clamp(0.1, 10.0);
    let wide = (f64::from(area.height) * 2.0 * aspect).round().clamp(1.0, f64::from(area.width.max(1))) as u16;
    let high = (f64::from(wide) / aspect / 2.0).round().clamp(1.0, f64::from(area.height.max(1))) as u16;
    Size::new(wide, high)
}

/// Puts a whole photo into the middle of an area.
pub(crate) fn frame(buffer: &mut Buffer, area: Cells, photo: &Photo, colours: Colours) {
    let view = Rect::new(0.0, 0.0, photo.width() as f64, photo.height() as f64);
    let size = size_in(view, area.as_size());
    let (x, y) = (area.x + (area.width - size.width) / 2, area.y + (area.height - size.height) / 2);
    ground(buffer, Cells::new(x, y, size.width, size.height), photo, view, colours);
}

/// Fills cells with a part of a photo, two pixels a cell; how large such a pixel is in the photo.
pub(crate) fn ground(buffer: &mut Buffer, place: Cells, photo: &Photo, view: Rect, colours: Colours) -> Vec2 {
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

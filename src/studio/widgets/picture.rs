//! The face in cells: painted several times finer than it is shown, averaged, and kept until pose or size changes.

use ratatui::buffer::Buffer;
use ratatui::layout::{Rect, Size};
use ratatui::style::Style;

use super::photo_picture;
use crate::drawing::{Drawing, Picture};
use crate::figure::Figure;
use crate::pose::Pose;
use crate::render::Painter;
use crate::studio::app::colours::Colours;

/// Paint this many pixels each way for one that is shown.
const FINER: u32 = 4;

/// Colour levels of a channel that are told apart: steps finer than this cost bytes at every move and show nothing.
const LEVELS: u32 = 32;

/// In a picture of fewer rows than this, what differs a little from white is made to differ by up to so much more:
/// averaged over a cell, lines are pale.
const SMALL: u16 = 20;
const STRONGER: f32 = 0.9;

/// How dark a dot must be to be drawn where there are no colours.
const DARK: u32 = 190;

/// The picture of a face and what it shows.
#[derive(Default)]
pub(crate) struct FacePicture {
    painter: Option<Painter>,
    shown: Option<Shown>,
    size: Size,
    /// The figure as it is painted: the face alone, bold enough for so few pixels.
    close: Option<Figure>,
    cells: Vec<Cell>,
}

/// What a picture shows. The key tells one figure or drawing from another.
#[derive(Debug, Clone, PartialEq)]
struct Shown {
    key: u64,
    pose: Option<Pose>,
    size: Size,
    colours: Colours,
}

/// A cell: two pixels above each other, or eight dots.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Cell {
    Pixels([[u8; 3]; 2]),
    Dots(char),
}

impl FacePicture {
    /// How many cells a figure takes of an area: as high as it is, as wide as the figure then is.
    #[must_use]
    pub(crate) fn size_in(figure: &Figure, area: Size) -> Size {
        let view = figure.face_view();
        let aspect = (view.width() / view.height().max(1e-6)).clamp(0.1, 10.0);
        // A cell is twice as high as it is wide.
        let wide = (f64::from(area.height) * 2.0 * aspect).ceil().min(f64::from(area.width)) as u16;
        let high = (f64::from(wide) / aspect / 2.0).ceil().min(f64::from(area.height)) as u16;
        Size::new(wide, high)
    }

    /// Paints the figure, unless it is painted so already.
    pub(crate) fn show(&mut self, figure: &Figure, pose: &Pose, area: Rect, colours: Colours) {
        let size = Self::size_in(figure, area.as_size());
        let wanted = Shown { key: figure.key(), pose: Some(*pose), size, colours };
        if self.shown.as_ref() == Some(&wanted) {
            return;
        }
        let other = |s: &Shown| s.key != wanted.key || s.colours != colours;
        if self.size != size || self.shown.as_ref().is_none_or(other) {
            let (wide, high) = (u32::from(size.width) * FINER, u32::from(size.height) * 2 * FINER);
            self.painter = Painter::new(wide, high).ok();
            // A line thinner than a pixel is a grey haze.
            let bolder = (40.0 / (2.0 * f64::from(size.height.max(1)))).clamp(1.0, 1.8);
            self.close = Some(figure.close_up(bolder));
        }
        self.cells.clear();
        let contrast = if size.height < SMALL { STRONGER } else { 0.0 };
        if let (Some(painter), Some(close)) = (&mut self.painter, &self.close) {
            let picture = painter.paint(&close.draw(pose));
            self.take(&picture, size, contrast, colours);
        }
        self.size = size;
        self.shown = Some(wanted);
    }

    /// Paints a drawing as large as an area allows, unless it is painted so already.
    pub(crate) fn show_drawing(&mut self, drawing: &Drawing, area: Rect, colours: Colours) {
        let size = photo_picture::size_in(drawing.view, area.as_size());
        let wanted = Shown { key: drawing.fingerprint(), pose: None, size, colours };
        if self.shown.as_ref() == Some(&wanted) {
            return;
        }
        self.cells.clear();
        let (wide, high) = (u32::from(size.width) * FINER, u32::from(size.height) * 2 * FINER);
        if let Ok(mut painter) = Painter::new(wide, high) {
            let picture = painter.paint(drawing);
            self.take(&picture, size, 0.0, colours);
        }
        self.size = size;
        self.shown = Some(wanted);
    }

    fn take(&mut self, picture: &Picture, size: Size, contrast: f32, colours: Colours) {
        for y in 0..u32::from(size.height) {
            for x in 0..u32::from(size.width) {
                self.cells.push(cell(picture, x * FINER, y * 2 * FINER, contrast, colours));
            }
        }
    }

    /// Puts the picture into the middle of an area.
    pub(crate) fn put(&self, buffer: &mut Buffer, area: Rect) {
        let (wide, high) = (self.size.width.min(area.width), self.size.height.min(area.height));
        let left = area.x + (area.width - wide) / 2;
        let top = area.y + (area.height - high) / 2;
        let colours = self.shown.as_ref().map_or(Colours::None, |s| s.colours);
        for y in 0..high {
            for x in 0..wide {
                let at = usize::from(y) * usize::from(self.size.width) + usize::from(x);
                let (Some(cell), Some(place)) = (self.cells.get(at), buffer.cell_mut((left + x, top + y))) else {
                    continue;
                };
                match *cell {
                    Cell::Dots(dots) => {
                        place.set_char(dots);
                    }
                    // One colour: a space needs no second one.
                    Cell::Pixels([above, below]) if above == below => {
                        place.set_char(' ').set_style(Style::new().bg(colours.colour(above)));
                    }
                    Cell::Pixels([above, below]) => {
                        let style = Style::new().fg(colours.colour(above)).bg(colours.colour(below));
                        place.set_char('▀').set_style(style);
                    }
                }
            }
        }
    }
}

/// The cell whose pixels start at (x, y): 4 across and 8 down.
fn cell(picture: &Picture, x: u32, y: u32, contrast: f32, colours: Colours) -> Cell {
    if colours != Colours::None {
        return Cell::Pixels([0, FINER].map(|down| {
            let mean = mean(picture, x, y + down, FINER, FINER);
            mean.map(|v| {
                // Pale things gain most; what is dark already keeps its colour.
                let dark = (255 - v) as f32 / 255.0;
                let v = 255 - (255.0 * dark * (1.0 + contrast * (1.0 - dark))).min(255.0) as u32;
                ((v * (LEVELS - 1) + 127) / 255 * 255 / (LEVELS - 1)) as u8
            })
        }));
    }
    // Braille: two columns of four dots; the bits run down the left column, down the right, then the bottom row.
    const BITS: [[u32; 4]; 2] = [[0x01, 0x02, 0x04, 0x40], [0x08, 0x10, 0x20, 0x80]];
    let mut dots = 0;
    for (column, bits) in (0..).zip(BITS) {
        for (row, bit) in (0..).zip(bits) {
            let [r, g, b] = mean(picture, x + 2 * column, y + 2 * row, 2, 2);
            if (r * 3 + g * 6 + b) / 10 < DARK {
                dots |= bit;
            }
        }
    }
    Cell::Dots(if dots == 0 { ' ' } else { char::from_u32(0x2800 + dots).unwrap_or(' ') })
}

/// The mean colour of a rectangle of pixels.
fn mean(picture: &Picture, x: u32, y: u32, wide: u32, high: u32) -> [u32; 3] {
    let mut sum = [0; 3];
    for (dx, dy) in (0..high).flat_map(|dy| (0..wide).map(move |dx| (dx, dy))) {
        let pixel = picture.get((x + dx) as usize, (y + dy) as usize).copied().unwrap_or([255; 4]);
        for (sum, v) in sum.iter_mut().zip(pixel) {
            *sum += u32::from(v);
        }
    }
    sum.map(|v| v / (wide * high))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::LineFigure;
    use crate::pose::{Emotion, Ratios};

    fn line() -> Figure {
        LineFigure::built_in("line").unwrap().into()
    }

    fn painted(pose: &Pose, colours: Colours) -> (FacePicture, Buffer) {
        let figure = line();
        let area = Rect::new(0, 0, 28, 12);
        let mut picture = FacePicture::default();
        picture.show(&figure, pose, area, colours);
        let mut buffer = Buffer::empty(area);
        picture.put(&mut buffer, area);
        (picture, buffer)
    }

    #[test]
    fn without_colours_the_face_is_dots_in_the_terminals_own_colour() {
        let (_, buffer) = painted(&Pose::default(), Colours::None);
        assert!(buffer.content().iter().all(|c| c.style() == Buffer::empty(buffer.area).content()[0].style()));
        assert!(buffer.content().iter().filter(|c| c.symbol() != " ").count() > 40);
    }

    #[test]
    fn another_emotion_is_another_picture_and_the_same_one_is_not_painted_again() {
        let (mut neutral, first) = painted(&Pose::default(), Colours::True);
        let (_, other) = painted(&Pose::of(Ratios::pure(Emotion::Surprised)), Colours::True);
        assert_ne!(first, other);
        neutral.painter = None;
        neutral.show(&line(), &Pose::default(), Rect::new(0, 0, 28, 12), Colours::True);
        assert!(!neutral.cells.is_empty());
    }

    #[test]
    fn the_picture_has_the_figures_shape() {
        let figure = line();
        let size = FacePicture::size_in(&figure, Size::new(80, 12));
        assert!((18..=26).contains(&size.width) && size.height == 12, "{size:?}");
        let narrow = FacePicture::size_in(&figure, Size::new(10, 40));
        assert!(narrow.width == 10 && narrow.height < 10, "{narrow:?}");
    }
}

//! The line drawing of the paper: seven drawings over one set of points and lines, blended by the seven ratios.
//!
//! Around that blend the figure does what its table cannot say: the lids close, the eyes look, the mouth takes the
//! nine mouth shapes on top of the emotion and shows teeth and tongue.

mod draw;
mod eye;
mod file;
mod lips;
mod mouth;
mod widths;

use std::collections::BTreeMap;

pub use widths::Widths;

use crate::disk::{Fault, FileFault, Result, suggestion};
use crate::drawing::{Colour, Item};
use crate::geometry::{Knot, Rect, Ribbon};
use crate::pose::Ratios;

/// A line figure, read and checked: every index in it is within bounds.
#[derive(Debug, Clone)]
pub struct LineFigure {
    title: String,
    view: Rect,
    /// The part of the view with the face.
    close: Rect,
    /// Pixels of the figure per unit of stroke width.
    pen: f64,
    /// How widths run between control points.
    widths: Widths,
    colours: Colours,
    lines: Vec<Line>,
    /// One list of knots an emotion, in canonical order, all of one length.
    drawings: [Vec<Knot>; 7],
    behind: Vec<Backdrop>,
    before: Vec<Backdrop>,
    fills: Vec<Fill>,
    eyes: Vec<eye::Eye>,
    mouth: mouth::Mouth,
    /// What the head turns about.
    pivot: crate::geometry::Point,
}

/// A line of the table: its name and its four control points (paper table 2).
#[derive(Debug, Clone)]
struct Line {
    name: String,
    points: [usize; 4],
}

/// The colours of a figure.
#[derive(Debug, Clone, Copy, serde::Deserialize)]
#[serde(deny_unknown_fields, default)]
struct Colours {
    ink: Colour,
    eye_white: Colour,
    iris: Colour,
    pupil: Colour,
    mouth: Colour,
    teeth: Colour,
    tongue: Colour,
}

impl Default for Colours {
    fn default() -> Self {
        Self {
            ink: Colour::rgb(0x1d, 0x1b, 0x20),
            eye_white: Colour::WHITE,
            iris: Colour::rgb(0x1d, 0x1b, 0x20),
            pupil: Colour::rgb(0x1d, 0x1b, 0x20),
            mouth: Colour::rgb(0x4a, 0x1d, 0x24),
            teeth: Colour::WHITE,
            tongue: Colour::rgb(0xc8, 0x6b, 0x6b),
        }
    }
}

/// A part that is the same in all seven drawings (paper sec. 3.2, "face background").
#[derive(Debug, Clone)]
struct Backdrop {
    name: String,
    strokes: Vec<Ribbon>,
    fill: Option<Colour>,
    ink: Option<Colour>,
    /// Whether it moves with the head.
    head: bool,
}

/// An area that moves with the lines round it.
#[derive(Debug, Clone)]
struct Fill {
    name: String,
    lines: Vec<usize>,
    colour: Colour,
}

impl LineFigure {
    /// The figures that come with the program.
    pub const BUILT_IN: [&'static str; 2] = ["line", "cat"];

    /// A figure that comes with the program: `line`, the paper's, or `cat`.
    ///
    /// # Errors
    /// When there is none of that name; says which there are.
    pub fn built_in(name: &str) -> Result<Self> {
        match name {
            "line" => Self::parse(include_str!("line.toml")),
            "cat" => Self::parse(include_str!("cat.toml")),
            _ => {
                let near = suggestion(name, "figures", &Self::BUILT_IN);
                Err(Fault::of(FileFault::Unknown, format!("there is no figure `{name}`"))
                    .help(format!("{near}, or a file figures/NAME.toml")))
            }
        }
    }

    /// What the figure is called.
    #[must_use]
    pub(crate) fn title(&self) -> &str {
        &self.title
    }

    /// The part of its plane that it fills.
    #[must_use]
    pub fn view(&self) -> Rect {
        self.view
    }

    /// The part of its plane with the face.
    #[must_use]
    pub fn face_view(&self) -> Rect {
        self.close
    }

    /// The figure as small pictures need it: the face without what is round it, its lines `bolder` times as wide.
    #[must_use]
    pub(crate) fn close_up(&self, bolder: f64) -> Self {
        let mut figure = self.clone();
        figure.view = self.close;
        figure.pen *= bolder;
        for part in figure.behind.iter_mut().chain(&mut figure.before) {
            for knot in part.strokes.iter_mut().flat_map(|s| &mut s.0) {
                knot.w *= bolder;
            }
        }
        figure
    }

    /// The names of its lines.
    pub fn line_names(&self) -> impl Iterator<Item = &str> {
        self.lines.iter().map(|l| l.name.as_str())
    }

    /// The points of the seven drawings mixed, Σ αᵢ Eᵢ (paper eq. 6 read backwards). Any real ratios that sum to 1
    /// do; a pure emotion gives its own drawing back exactly. Widths are in the table's units.
    #[must_use]
    pub fn blend(&self, ratios: &Ratios) -> Vec<Knot> {
        let mut mixed = vec![Knot::default(); self.drawings[0].len()];
        for (drawing, ratio) in self.drawings.iter().zip(ratios.0) {
            for (sum, knot) in mixed.iter_mut().zip(drawing) {
                sum.x += ratio * knot.x;
                sum.y += ratio * knot.y;
                sum.w += ratio * knot.w;
            }
        }
        mixed
    }

    /// A line of the table as a stroke in the figure's pixels.
    fn ribbon(&self, line: usize, knots: &[Knot]) -> Ribbon {
        Ribbon(self.lines[line].points.map(|p| {
            let knot = knots[p];
            Knot { w: knot.w.max(0.0) * self.pen, ..knot }
        }))
    }

    /// The figure with widths that run so between control points, instead of as its file says.
    #[must_use]
    pub fn with_widths(mut self, widths: Widths) -> Self {
        self.widths = widths;
        self
    }

    /// Strokes that form one line, in ink.
    fn ink(&self, name: &str, strokes: &[Ribbon], colour: Colour) -> Item {
        Item::ink(name, self.widths.of(strokes), colour)
    }

    fn is_of_eye_or_mouth(&self, line: usize) -> bool {
        self.mouth.has(line) || self.eyes.iter().any(|e| e.has(line))
    }

    /// Where each line name is in the list.
    fn index_of_lines(lines: &[Line]) -> BTreeMap<String, usize> {
        lines.iter().enumerate().map(|(i, l)| (l.name.clone(), i)).collect()
    }
}

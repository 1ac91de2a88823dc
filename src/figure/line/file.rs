//! A line figure as a file: what an author writes to make her own.
//!
//! ```toml
//! format = 1
//! title = "A line face"
//! view = [0, 40, 498, 560]        # x, y, width, height of what is shown
//! pen = 2.0                       # pixels per unit of width
//! widths = "bezier"               # how widths run between points: bezier, or paper (straight from point to point)
//! pivot = [249, 560]              # what the head turns about
//! close = [20, 50, 458, 520]      # the part with the face, for pictures too small for the rest
//! lines = [ { name = "rbow", points = [0, 1, 2, 3] } ]
//! [drawings]                      # x, y, width of every point, for each of the seven
//! neutral = [[365, 270, 1]]
//! [[behind]]                      # the same in all seven, back to front; `before` is drawn over the lines
//! name = "face"
//! knots = [[249, 92, 1], [342, 92, 2], [414, 168, 2], [416, 276, 2]]   # 4, 7, 10 … points of a chain of cubics
//! fill = "#ffffff"
//! [[fill]]                        # an area that moves with the lines round it
//! name = "left-ear"
//! lines = ["ear-outer", "ear-inner"]
//! colour = "#ffffff"
//! [[eye]]
//! upper = "leyeulid"
//! lower = "leyeblid"
//! iris = 14
//! [mouth]
//! nose = [249, 404]               # the base of the nose, from which MNS0 is measured
//! upper = ["lmu", "rmulink", "rmu"]
//! lower = ["lmb", "rmblink", "rmb"]
//! ```

use serde::Deserialize;

use super::eye::Eye;
use super::mouth::Mouth;
use super::{Backdrop, Colours, Fill, Line, LineFigure, Widths};
use crate::disk::{Fault, FileFault, Result, from_toml, plain_name, suggestion};
use crate::drawing::Colour;
use crate::geometry::{Knot, Point, Rect, Ribbon};
use crate::pose::Emotion;

/// The version of the format that is read.
pub(crate) const FIGURE_FORMAT: u32 = 1;

/// Coordinates beyond this are a slip of the hand.
const FARTHEST: f64 = 100_000.0;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    format: u32,
    title: String,
    view: [f64; 4],
    #[serde(default = "two")]
    pen: f64,
    #[serde(default)]
    widths: Widths,
    pivot: Option<[f64; 2]>,
    close: Option<[f64; 4]>,
    #[serde(default)]
    colours: Colours,
    lines: Vec<FileLine>,
    drawings: Drawings,
    #[serde(default)]
    behind: Vec<FileBackdrop>,
    #[serde(default)]
    before: Vec<FileBackdrop>,
    #[serde(default, rename = "fill")]
    fills: Vec<FileFill>,
    #[serde(default, rename = "eye")]
    eyes: Vec<FileEye>,
    mouth: FileMouth,
}

fn two() -> f64 {
    2.0
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileLine {
    name: String,
    points: [usize; 4],
}

type Triples = Vec<[f64; 3]>;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Drawings {
    neutral: Triples,
    happy: Triples,
    anger: Triples,
    disgust: Triples,
    sadness: Triples,
    fear: Triples,
    surprised: Triples,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileBackdrop {
    name: String,
    knots: Triples,
    fill: Option<Colour>,
    ink: Option<Colour>,
    #[serde(default)]
    no_ink: bool,
    #[serde(default = "yes")]
    head: bool,
}

fn yes() -> bool {
    true
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileFill {
    name: String,
    lines: Vec<String>,
    colour: Colour,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileEye {
    upper: String,
    lower: String,
    iris: f64,
    #[serde(default)]
    slit: bool,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileMouth {
    nose: [f64; 2],
    upper: Vec<String>,
    lower: Vec<String>,
}

impl LineFigure {
    /// Reads a figure from the text of its file.
    ///
    /// # Errors
    /// When it is no such file, or names lines and points that are not there.
    pub fn parse(text: &str) -> Result<Self> {
        let file: File = from_toml(text)?;
        if file.format != FIGURE_FORMAT {
            return Err(Fault::of(FileFault::Version, format!("`format` is {}", file.format))
                .help(format!("this program reads figures of format {FIGURE_FORMAT}")));
        }
        let (drawings, count) = file.drawings.read()?;
        let lines: Vec<Line> = file.lines.into_iter().map(|l| Line { name: l.name, points: l.points }).collect();
        check_lines(&lines, count)?;
        if let Some([x, y]) = file.pivot.filter(|p| p.iter().any(|v| !v.is_finite() || v.abs() > FARTHEST)) {
            return Err(Fault::of(FileFault::OutOfRange, format!("`pivot` is [{x}, {y}]"))
                .help(format!("give numbers up to {FARTHEST}")));
        }
        if file.mouth.upper.is_empty() || file.mouth.lower.is_empty() {
            return Err(
                Fault::new("a lip of the mouth has no lines").help("name the lines of both `upper` and `lower`")
            );
        }
        let view = area(file.view, "view")?;
        let close = file.close.map_or(Ok(view), |close| area(close, "close"))?;
        if !(file.pen > 0.0 && file.pen <= 100.0) {
            return Err(Fault::of(FileFault::OutOfRange, format!("`pen` is {}", file.pen))
                .help("give a number above 0 and at most 100"));
        }
        let names = Self::index_of_lines(&lines);
        let line = |name: &String| {
            names.get(name).copied().ok_or_else(|| {
                let known: Vec<&str> = lines.iter().map(|l| l.name.as_str()).collect();
                Fault::new(format!("there is no line `{name}`")).help(suggestion(name, "lines", &known))
            })
        };
        let mut eyes = Vec::new();
        for eye in &file.eyes {
            eyes.push(Eye::new((line(&eye.upper)?, line(&eye.lower)?), eye.iris, eye.slit, &drawings[0], &lines)?);
        }
        let mut fills = Vec::new();
        for fill in &file.fills {
            plain_name(&fill.name)?;
            let lines = fill.lines.iter().map(line).collect::<Result<Vec<_>>>()?;
            fills.push(Fill { name: fill.name.clone(), lines, colour: fill.colour });
        }
        let m = &file.mouth;
        let upper = m.upper.iter().map(line).collect::<Result<Vec<_>>>()?;
        let lower = m.lower.iter().map(line).collect::<Result<Vec<_>>>()?;
        let mouth = Mouth::new(upper, lower, Point::new(m.nose[0], m.nose[1]), &drawings[0], &lines)?;
        for eye in &mut eyes {
            eye.mark_side(mouth.middle());
        }
        let pivot = file.pivot.map_or(Point::new(view.center().x, view.y1), |p| Point::new(p[0], p[1]));
        Ok(Self {
            title: crate::disk::clean_line(&file.title, 200),
            view,
            close,
            pen: file.pen,
            widths: file.widths,
            colours: file.colours,
            behind: backdrops(file.behind, file.pen, file.colours.ink)?,
            before: backdrops(file.before, file.pen, file.colours.ink)?,
            lines,
            drawings,
            fills,
            eyes,
            mouth,
            pivot,
        })
    }
}

impl Drawings {
    /// The seven drawings in the order of the emotions, and how many points each has.
    fn read(self) -> Result<([Vec<Knot>; 7], usize)> {
        let lists = [self.neutral, self.happy, self.anger, self.disgust, self.sadness, self.fear, self.surprised];
        let count = lists[0].len();
        let mut drawings: [Vec<Knot>; 7] = Default::default();
        for ((list, emotion), drawing) in lists.into_iter().zip(Emotion::ALL).zip(&mut drawings) {
            if list.len() != count {
                let what = format!("the drawing `{emotion}` has {} points, `neutral` has {count}", list.len());
                return Err(Fault::new(what).help("the seven drawings need the same points"));
            }
            *drawing = knots(&list, emotion.name())?;
        }
        Ok((drawings, count))
    }
}

/// Checks the names of lines, and that their points are among the `count` of a drawing.
fn check_lines(lines: &[Line], count: usize) -> Result<()> {
    for line in lines {
        plain_name(&line.name)?;
        if let Some(point) = line.points.iter().find(|p| **p >= count) {
            return Err(Fault::new(format!("the line `{}` has a point {point}", line.name))
                .help(format!("points are numbered 0 to {}", count.saturating_sub(1))));
        }
    }
    Ok(())
}

/// An area that shows something: x, y, width and height.
fn area([x, y, width, height]: [f64; 4], name: &str) -> Result<Rect> {
    let near = [x, y, width, height].iter().all(|v| v.is_finite() && v.abs() <= FARTHEST);
    if near && width > 0.0 && height > 0.0 {
        return Ok(Rect::new(x, y, x + width, y + height));
    }
    Err(Fault::of(FileFault::OutOfRange, format!("`{name}` is [{x}, {y}, {width}, {height}]"))
        .help(format!("give x, y, width and height, up to {FARTHEST}, the last two above 0")))
}

fn knots(list: &Triples, of: &str) -> Result<Vec<Knot>> {
    list.iter()
        .enumerate()
        .map(|(i, [x, y, w])| {
            let fine = [x, y, w].iter().all(|v| v.is_finite() && v.abs() <= FARTHEST) && *w >= 0.0;
            fine.then_some(Knot::new(*x, *y, *w)).ok_or_else(|| {
                Fault::of(FileFault::OutOfRange, format!("point {i} of `{of}` is [{x}, {y}, {w}]"))
                    .help(format!("give numbers up to {FARTHEST}, the width not below 0"))
            })
        })
        .collect()
}

fn backdrops(list: Vec<FileBackdrop>, pen: f64, usual: Colour) -> Result<Vec<Backdrop>> {
    let read = |part: FileBackdrop| {
        plain_name(&part.name)?;
        let mut knots = knots(&part.knots, &part.name)?;
        if knots.len() < 4 || knots.len() % 3 != 1 {
            return Err(Fault::new(format!("`{}` has {} knots", part.name, knots.len()))
                .help("a chain of cubics has 4, 7, 10 … knots"));
        }
        for knot in &mut knots {
            knot.w *= pen;
        }
        let strokes = knots.windows(4).step_by(3).map(|k| Ribbon([k[0], k[1], k[2], k[3]])).collect();
        let ink = if part.no_ink { None } else { Some(part.ink.unwrap_or(usual)) };
        Ok(Backdrop { name: part.name, strokes, fill: part.fill, ink, head: part.head })
    };
    list.into_iter().map(read).collect()
}

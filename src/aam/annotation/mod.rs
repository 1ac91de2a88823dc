//! Points that were marked in pictures, as other programs write them down, a file a format: iBUG's `.pts`, IMM's
//! `.asf`, dlib's XML; and our own `face.toml`, which is only read.
//!
//! What a file is of is told by its content. Of every format, what is read may be written again. Tracks that other
//! programs made of whole clips are another matter: they have times.

mod asf;
mod dlib;
mod face_toml;
mod number;
mod pts;

use std::path::Path;

use crate::disk::{Fault, FileFault, Result, read_text};
use crate::geometry::{Point, Rect};

/// The most points that one annotation may have.
pub(crate) const MAX_POINTS: usize = 1000;
/// The most pictures that one file may annotate.
pub(crate) const MAX_PICTURES: usize = 100_000;

/// The points of one face in one picture.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Annotation {
    /// The picture's file, as it is written in the annotation; none where the format does not say.
    pub picture: Option<String>,
    /// The points, in the order that means something to whoever marked them.
    pub points: Vec<Point>,
    /// What the coordinates are counted in.
    pub unit: Unit,
    /// Which points are joined to lines; empty where the format does not say.
    pub lines: Vec<Line>,
    /// The face's box in pixels; none where the format does not say.
    pub face: Option<Rect>,
}

/// What coordinates are counted in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Unit {
    /// Pixels of the picture, as they stand in the file. (iBUG's own files count pixels from 1; that is a shift of
    /// one pixel, the same in all of them, and is left as it is.)
    #[default]
    Pixels,
    /// Shares of the picture's width and height.
    Shares,
}

/// Points that follow each other and are joined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Line {
    /// Its first point.
    pub first: usize,
    /// How many points it has.
    pub count: usize,
    /// Whether its last point is joined to its first.
    pub closed: bool,
}

/// A format that annotations are written in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// iBUG's and VOSM's `.pts`: a picture a file.
    Pts,
    /// The `.asf` of the IMM face database (Stegmann's AAM-API): a picture a file, in shares of its size.
    Asf,
    /// The XML of dlib's imglab: many pictures, with boxes and named parts.
    Dlib,
    /// Our own `face.toml`: a face's 72 points, 47 where it has no hair. Only read.
    Face,
}

impl Format {
    /// What a text is; none where it is none of them.
    #[must_use]
    pub fn of(text: &str) -> Option<Self> {
        let first = text.lines().map(str::trim).find(|l| !l.is_empty())?;
        if first.starts_with('<') {
            return text.contains("<dataset").then_some(Self::Dlib);
        }
        if first.starts_with("version") || first.starts_with("n_points") {
            return first.contains(':').then_some(Self::Pts);
        }
        if text.lines().any(|l| l.trim() == "[points]" || l.trim().starts_with("[points.")) {
            return Some(Self::Face);
        }
        let asf = text.contains("AAM Shape File") || text.contains("number of model points");
        (asf || is_count(text)).then_some(Self::Asf)
    }
}

/// Whether the first line that is no comment is a bare number, as in an `.asf` without its comments.
fn is_count(text: &str) -> bool {
    let first = text.lines().map(str::trim).find(|l| !l.is_empty() && !l.starts_with('#'));
    first.is_some_and(|l| l.len() < 6 && l.parse::<usize>().is_ok())
}

impl Annotation {
    /// Bare points in pixels.
    #[must_use]
    pub fn of_points(points: Vec<Point>) -> Self {
        Self { points, ..Self::default() }
    }

    /// The annotations in a text of any of the formats, at least one.
    ///
    /// # Errors
    /// When it is of none of them, damaged, or too large, with the line and what to do.
    pub fn parse(text: &str) -> Result<Vec<Self>> {
        match Format::of(text) {
            Some(Format::Pts) => pts::parse(text).map(|a| vec![a]),
            Some(Format::Asf) => asf::parse(text).map(|a| vec![a]),
            Some(Format::Dlib) => dlib::parse(text),
            Some(Format::Face) => face_toml::parse(text).map(|a| vec![a]),
            None => Err(Fault::of(FileFault::Unsupported, "this is no annotation that can be read")
                .help("give an iBUG .pts, an IMM .asf, a dlib .xml or a face.toml")),
        }
    }

    /// The annotations in a file; see [`parse`](Self::parse).
    ///
    /// # Errors
    /// As [`parse`](Self::parse), and when the file cannot be read.
    pub fn read(path: &Path) -> Result<Vec<Self>> {
        Self::parse(&read_text(path)?).map_err(|fault| fault.at(path))
    }

    /// The annotations of a list of pictures in a format. `.pts` and `.asf` hold one picture.
    ///
    /// # Errors
    /// When the format cannot hold them, or is only read.
    pub fn write(list: &[Self], format: Format) -> Result<String> {
        match (format, list) {
            (Format::Pts, [one]) => pts::write(one),
            (Format::Asf, [one]) => asf::write(one),
            (Format::Dlib, list) => dlib::write(list),
            (Format::Face, _) => {
                Err(Fault::of(FileFault::TooLarge, "a face.toml holds more than points")
                    .help("write .pts, .asf or .xml"))
            }
            _ => Err(Fault::new("this format holds the points of one picture").help("write .xml, or a file a picture")),
        }
    }

    /// The points in pixels of a picture of this width and height.
    #[must_use]
    pub fn in_pixels(&self, [width, height]: [usize; 2]) -> Vec<Point> {
        match self.unit {
            Unit::Pixels => self.points.clone(),
            Unit::Shares => self.points.iter().map(|p| Point::new(p.x * width as f64, p.y * height as f64)).collect(),
        }
    }
}

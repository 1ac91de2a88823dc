//! `calibration.toml`: the seven shapes, how each came to be, what they were made of, and how good they are.

use std::collections::BTreeMap;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::quality::Quality;
use super::{Calibration, Shape, Source};
use crate::calibration::Binding;
use crate::disk::{Fault, FileFault, Message, Result, Task, from_toml, message, read_text};
use crate::face::{FeaturePoint, MAX_COORDINATE};
use crate::geometry::Point;
use crate::pose::Emotion;

/// The only `format` there is.
const FORMAT: u32 = 1;
/// The most points of a shape.
const MOST: usize = 1000;

/// What a `calibration.toml` holds.
#[derive(Debug, Clone)]
pub struct CalibrationFile {
    /// The shapes.
    pub calibration: Calibration,
    /// How good they are.
    pub quality: Quality,
    /// The SHA-256 of the model that was trained with them.
    pub model: String,
    /// The files that they were made of, by name, with their SHA-256. Where one differs the calibration is stale.
    pub inputs: BTreeMap<String, String>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    format: u32,
    points: usize,
    model: String,
    inputs: BTreeMap<String, String>,
    shapes: BTreeMap<Emotion, ShapeTable>,
    binding: BTreeMap<String, Vec<(usize, f64)>>,
    quality: Quality,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ShapeTable {
    source: Word,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    confidence: Option<f64>,
    points: Vec<[f64; 2]>,
}

#[derive(Serialize, Deserialize, Clone, Copy, PartialEq)]
#[serde(rename_all = "lowercase")]
enum Word {
    Marked,
    Found,
    Modelled,
}

impl CalibrationFile {
    /// The text of the file.
    ///
    /// # Errors
    /// When a number in it cannot be written.
    pub fn to_toml(&self) -> Result<String> {
        let shapes = self.calibration.shapes();
        let shape = |s: &Shape| {
            let (source, confidence) = match s.source {
                Source::Marked => (Word::Marked, None),
                Source::Found(c) => (Word::Found, Some(c)),
                Source::Modelled => (Word::Modelled, None),
            };
            ShapeTable { source, confidence, points: s.points.iter().map(|p| [p.x, p.y]).collect() }
        };
        let table = Table {
            format: FORMAT,
            points: shapes[0].points.len(),
            model: self.model.clone(),
            inputs: self.inputs.clone(),
            shapes: Emotion::ALL.into_iter().zip(shapes).map(|(e, s)| (e, shape(s))).collect(),
            binding: self.calibration.binding().rows().iter().map(|(p, sum)| (p.name(), sum.clone())).collect(),
            quality: self.quality.clone(),
        };
        toml::to_string(&table)
            .map_err(|e| Fault::of(FileFault::OutOfRange, format!("the calibration cannot be written: {e}")))
    }

    /// Reads the text of the file.
    ///
    /// # Errors
    /// When it is damaged, of another format, or its numbers cannot be, with the line.
    pub fn parse(text: &str) -> Result<Self> {
        let table: Table = from_toml(text).map_err(|fault| fault.help(again()))?;
        let line = |what: &str| text.lines().position(|l| l.trim_start().starts_with(what)).map_or(1, |l| l + 1);
        if table.format != FORMAT {
            return Err(Fault::of(FileFault::Version, format!("format {} is not known to this version", table.format))
                .line(line("format"))
                .help(again()));
        }
        let n = table.points;
        if !(3..=MOST).contains(&n) {
            return Err(Fault::of(FileFault::OutOfRange, format!("a shape cannot have {n} points"))
                .line(line("points"))
                .help(again()));
        }
        let mut shapes = Vec::with_capacity(7);
        for emotion in Emotion::ALL {
            let head = format!("[shapes.{emotion}]");
            let Some(shape) = table.shapes.get(&emotion) else {
                return Err(Fault::of(FileFault::Missing, format!("the shape of {emotion} is missing"))
                    .line(line("[shapes"))
                    .help(again()));
            };
            let fault = |what: String| Fault::new(what).line(line(&head)).help(again());
            if shape.points.len() != n {
                return Err(fault(format!("the shape of {emotion} has {} points, not {n}", shape.points.len())));
            }
            if !shape.points.iter().flatten().all(|v| v.abs() <= MAX_COORDINATE) {
                return Err(fault(format!("a point of {emotion} lies nowhere near a photo")));
            }
            let source = match (shape.source, shape.confidence) {
                (Word::Marked, None) => Source::Marked,
                (Word::Modelled, None) => Source::Modelled,
                (Word::Found, Some(c)) if (0.0..=1.0).contains(&c) => Source::Found(c),
                _ => return Err(fault(format!("the confidence of {emotion} cannot be"))),
            };
            shapes.push(Shape { points: shape.points.iter().map(|[x, y]| Point::new(*x, *y)).collect(), source });
        }
        let mut rows = Vec::new();
        for (name, sum) in &table.binding {
            let fault = |what: &str| {
                let key = format!("\"{name}\"");
                let at = text.lines().position(|l| l.starts_with(&key) || l.starts_with(name.as_str()));
                Fault::new(format!("{what} `{name}` of [binding]"))
                    .line(at.map_or(line("[binding]"), |l| l + 1))
                    .help(again())
            };
            let point = FeaturePoint::named(name).ok_or_else(|| fault("there is no feature point"))?;
            let whole: f64 = sum.iter().map(|s| s.1).sum();
            if sum.is_empty() || sum.iter().any(|(i, _)| *i >= n) || !(1.0 - 1e-6..1.0 + 1e-6).contains(&whole) {
                return Err(fault("the shares do not sum to 1 over points that there are:"));
            }
            rows.push((point, sum.clone()));
        }
        rows.sort_by_key(|r| r.0);
        for (name, sum) in &table.inputs {
            if sum.len() != 64 || !sum.bytes().all(|b| b.is_ascii_hexdigit()) {
                let at = text.lines().position(|l| l.contains(name.as_str())).map_or(line("[inputs]"), |l| l + 1);
                return Err(Fault::new(format!("`{name}` has no SHA-256 of 64 hexadecimal digits"))
                    .line(at)
                    .help(again()));
            }
        }
        if table.quality.shots.len() != 7 {
            return Err(Fault::of(FileFault::Mismatch, "[quality] does not tell of seven shots")
                .line(line("[quality]"))
                .help(again()));
        }
        let shapes: [Shape; 7] =
            shapes.try_into().map_err(|_| Fault::of(FileFault::Empty, "there are not seven shapes"))?;
        let calibration = Calibration::new(shapes, Binding::of_rows(n, rows)).map_err(|f| f.line(line("[shapes")))?;
        Ok(Self { calibration, quality: table.quality, model: table.model, inputs: table.inputs })
    }

    /// Reads a file.
    ///
    /// # Errors
    /// When it cannot be read, and as [`parse`](Self::parse).
    pub fn read(path: &Path) -> Result<Self> {
        Self::parse(&read_text(path)?).map_err(|fault| fault.at(path))
    }
}

fn again() -> Message {
    message![Task::Calibrate, " makes it anew"]
}

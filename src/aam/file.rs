//! A model's file: `LPAM`, a version, then numbers, all little-endian, and a checksum in the end.
//!
//! | what | how |
//! | --- | --- |
//! | `LPAM`, version 1 | 4 bytes, `u32` |
//! | points L, those outside the border included, shape modes M, levels K | three `u32` |
//! | 1 where shape and look are fitted at once, else 0; border points B; their numbers | two `u32`; B `u32` |
//! | mean shape; modes; deviations | 2 L, M × 2 L, M `f32` |
//! | at this residual a fit is as likely right as wrong; how fast that falls | two `f32` |
//! | K levels: width; modes used, smoothing, 1 for edges and 0 for luma, textures T, values N | `f32`; five `u32` |
//! | of a level T textures: worth of a step and deviation; values | two `f32`; N `i16` |
//! | columns C and rows R of what is learned of the detector, both 0 where nothing is | two `u32` |
//! | its mean; its rows | C, R × (C + 1) `f32` |
//! | CRC-32 of everything before | `u32` |
//!
//! Lengths are held against what a model may have and against what is left before anything is made of them; triangles,
//! pixels and all that is made ready to fit are made anew.

use std::path::Path;

use super::detected::{Detected, NUMBERS};
use super::ground::Channels;
use super::level::{Look, Texture};
use super::model::{Model, Parts};
use super::shape::Shapes;
use super::trust::Trust;
use crate::aam::annotation::MAX_POINTS;
use crate::disk::{Fault, FileFault, Result, Task, message, read_bytes, write_output};

const MAGIC: &[u8; 4] = b"LPAM";
const VERSION: u32 = 1;
/// The largest file that is read.
const MAX_BYTES: u64 = 16 << 20;
const MAX_MODES: u32 = 64;
const MAX_LEVELS: u32 = 4;
const MAX_TEXTURES: u32 = 128;
const MAX_PIXELS: u32 = 400_000;
/// How wide a level may be, in pixels.
pub(super) const WIDTHS: std::ops::RangeInclusive<f32> = 8.0..=512.0;

impl Model {
    /// The bytes of its file.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut out = Bytes(MAGIC.to_vec());
        out.counts(&[VERSION as usize, self.shapes.count(), self.shapes.modes().len(), self.stored.len()]);
        out.counts(&[usize::from(self.simultaneous), self.border.len()]);
        out.counts(&self.border);
        out.numbers(self.shapes.mean_vector());
        self.shapes.modes().iter().for_each(|m| out.numbers(m));
        out.numbers(self.shapes.deviations());
        out.numbers(&[self.trust.even, self.trust.steep]);
        for look in &self.stored {
            let pixels = look.textures.first().map_or(0, |t| t.values.len());
            out.numbers(&[look.width]);
            let edges = usize::from(look.channels == Channels::Edges);
            out.counts(&[look.modes, look.smooth as usize, edges, look.textures.len(), pixels]);
            for texture in &look.textures {
                out.numbers(&[texture.step, texture.deviation]);
                texture.values.iter().for_each(|v| out.0.extend(v.to_le_bytes()));
            }
        }
        let (mean, rows) = self.detected.as_ref().map_or((&[][..], &[][..]), |d| (&d.mean[..], &d.rows[..]));
        out.counts(&[mean.len(), rows.len() / (mean.len() + 1)]);
        out.numbers(mean);
        out.numbers(rows);
        let sum = crc32fast::hash(&out.0);
        out.0.extend(sum.to_le_bytes());
        out.0
    }

    /// Reads the bytes of a model's file.
    ///
    /// # Errors
    /// When they are of another kind or version, or damaged.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self> {
        let damaged = || {
            Fault::new("the model is damaged").help(message!["copy it again, or make it again by ", Task::TrainModel])
        };
        if !bytes.starts_with(MAGIC) {
            return Err(Fault::of(FileFault::Unsupported, "this is not a trained model")
                .help(message!["make one by ", Task::TrainModel]));
        }
        let version = bytes.get(4..8).and_then(|b| b.try_into().ok()).map(u32::from_le_bytes);
        if let Some(v) = version.filter(|v| *v != VERSION) {
            return Err(Fault::of(FileFault::Version, format!("the model is of version {v}, and {VERSION} is known"))
                .help("train it again with this program"));
        }
        let (body, sum) = bytes.split_last_chunk::<4>().ok_or_else(damaged)?;
        if crc32fast::hash(body) != u32::from_le_bytes(*sum) {
            return Err(damaged());
        }
        let mut left = Left(&body[8.min(body.len())..]);
        let model = left.model().filter(|_| left.0.is_empty());
        model.ok_or_else(damaged)
    }

    /// Reads a model's file.
    ///
    /// # Errors
    /// When it cannot be read, and as [`from_bytes`](Self::from_bytes).
    pub(crate) fn read(path: &Path) -> Result<Self> {
        Self::from_bytes(&read_bytes(path, MAX_BYTES)?).map_err(|f| f.at(path))
    }

    /// Writes a model's file, whole or not at all.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn write(&self, path: &Path) -> Result<()> {
        write_output(path, &self.to_bytes())
    }
}

/// A file as it is written.
struct Bytes(Vec<u8>);

impl Bytes {
    fn counts(&mut self, counts: &[usize]) {
        counts.iter().for_each(|n| self.0.extend((*n as u32).to_le_bytes()));
    }

    fn numbers(&mut self, numbers: &[f32]) {
        numbers.iter().for_each(|v| self.0.extend(v.to_le_bytes()));
    }
}

/// What is left of a file.
struct Left<'a>(&'a [u8]);

impl Left<'_> {
    fn take(&mut self, count: usize) -> Option<&[u8]> {
        let (taken, rest) = self.0.split_at_checked(count)?;
        self.0 = rest;
        Some(taken)
    }

    fn count(&mut self, most: u32) -> Option<usize> {
        let n = u32::from_le_bytes(self.take(4)?.try_into().ok()?);
        (n <= most).then_some(n as usize)
    }

    fn numbers(&mut self, count: usize) -> Option<Vec<f32>> {
        let (parts, _) = self.take(count.checked_mul(4)?)?.as_chunks::<4>();
        let numbers: Vec<f32> = parts.iter().map(|b| f32::from_le_bytes(*b)).collect();
        numbers.iter().all(|v| v.is_finite()).then_some(numbers)
    }

    fn number(&mut self) -> Option<f32> {
        self.numbers(1)?.first().copied()
    }

    fn model(&mut self) -> Option<Model> {
        let count = self.count(2 * MAX_POINTS as u32)?;
        let modes = self.count(MAX_MODES)?;
        let levels = self.count(MAX_LEVELS)?;
        let simultaneous = self.count(1)? == 1;
        let border = self.count(MAX_POINTS as u32)?;
        let border = (0..border).map(|_| self.count(MAX_POINTS as u32)).collect::<Option<Vec<_>>>()?;
        let mean = self.numbers(2 * count)?;
        let vectors = (0..modes).map(|_| self.numbers(2 * count)).collect::<Option<Vec<_>>>()?;
        let deviations = self.numbers(modes)?;
        let shapes = Shapes::of(count, mean, vectors, deviations)?;
        let trust = Trust { even: self.number()?, steep: self.number()? };
        if !(trust.even > 0.0 && trust.even <= 1.0 && (1.0..=100.0).contains(&trust.steep)) {
            return None;
        }
        let stored = (0..levels).map(|_| self.look()).collect::<Option<Vec<_>>>()?;
        let columns = self.count(NUMBERS as u32)?;
        let rows = self.count(4 + MAX_MODES)?;
        let detected = match (columns, rows) {
            (0, 0) => None,
            (NUMBERS, n) if n == 4 + modes => {
                Some(Detected { mean: self.numbers(columns)?, rows: self.numbers(n * (columns + 1))? })
            }
            _ => return None,
        };
        Model::of(Parts { shapes, stored, trust, detected, border, simultaneous })
    }

    fn look(&mut self) -> Option<Look> {
        let width = self.number()?;
        let modes = self.count(MAX_MODES)?;
        let smooth = self.count(8)? as u32;
        let channels = if self.count(1)? == 1 { Channels::Edges } else { Channels::Luma };
        let textures = self.count(MAX_TEXTURES)?;
        let pixels = self.count(MAX_PIXELS)?;
        let texture = |left: &mut Self| {
            let (step, deviation) = (left.number()?, left.number()?);
            let (parts, _) = left.take(2 * pixels)?.as_chunks::<2>();
            Some(Texture { step, deviation, values: parts.iter().map(|b| i16::from_le_bytes(*b)).collect() })
        };
        let textures = (0..textures).map(|_| texture(self)).collect::<Option<Vec<_>>>()?;
        WIDTHS.contains(&width).then_some(Look { width, modes, smooth, channels, textures })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::aam::{Kind, Options, Start};
    use crate::geometry::Point;
    use crate::photo::Grey;

    /// Three pictures of a blob with a cross of points on it.
    fn model() -> (Model, Grey, Vec<Point>) {
        let shot = |by: f64| {
            let pixel = |i: usize| {
                let (x, y) = ((i % 90) as f64 - 45.0, (i / 90) as f64 - 40.0);
                (120.0 + 60.0 * (x / (9.0 + by)).cos() + 40.0 * ((y + by * x / 40.0) / 7.0).sin()) as u8
            };
            let grey = Grey::new(90, 80, (0..90 * 80).map(pixel).collect());
            let points: Vec<Point> = (0..16)
                .map(|i| {
                    Point::new(20.0 + 16.0 * f64::from(i % 4) + by * f64::from(i / 4), 16.0 + 15.0 * f64::from(i / 4))
                })
                .collect();
            (grey, points)
        };
        let shots = [shot(0.0), shot(1.0), shot(2.2)];
        let pairs: Vec<(&Grey, &[Point])> = shots.iter().map(|(g, p)| (g, &p[..])).collect();
        let options = Options { pixels: vec![500, 1500], detect: false, ..Options::of(Kind::Person) };
        let model = Model::train(&pairs, &options).unwrap();
        let [(grey, points), ..] = shots;
        (model, grey, points)
    }

    #[test]
    fn a_model_read_back_fits_as_the_one_that_was_written() {
        let (model, grey, points) = model();
        let bytes = model.to_bytes();
        let again = Model::from_bytes(&bytes).unwrap();
        assert_eq!(again.to_bytes(), bytes);
        assert_eq!(again.fit(&grey, Start::Points(&points)), model.fit(&grey, Start::Points(&points)));
    }

    #[test]
    fn every_cut_and_every_wrong_length_is_refused() {
        let (model, ..) = model();
        let bytes = model.to_bytes();
        for cut in (0..bytes.len()).step_by(61).chain(bytes.len() - 9..bytes.len()) {
            assert!(Model::from_bytes(&bytes[..cut]).is_err(), "{cut}");
        }
        // A wrong number with a right checksum, which only a program could write.
        for at in (4..400).chain((400..bytes.len() - 4).step_by(97)) {
            for with in [0x00, 0x7F, 0xFF] {
                let mut wrong = bytes[..bytes.len() - 4].to_vec();
                wrong[at] = with;
                let sum = crc32fast::hash(&wrong);
                wrong.extend(sum.to_le_bytes());
                let _ = Model::from_bytes(&wrong);
            }
        }
        let fault = Model::from_bytes(b"LPAM\x02\0\0\0").unwrap_err();
        assert!(fault.to_string().contains("version 2"), "{fault}");
    }
}

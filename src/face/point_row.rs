//! A point in a table `[points]`, as `face.toml` and the marks of calibration shots have it: a place in pixels, how far it
//! can be trusted, and how it came to be.

use serde::Deserialize;

use super::{How, Placed};
use crate::disk::{Fault, FileFault, Result};
use crate::geometry::Point;

/// The farthest that a coordinate may lie from a photo's corner, in pixels.
pub const MAX_COORDINATE: f64 = 100_000.0;

/// The value of one key of the table.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PointRow {
    x: f64,
    y: f64,
    #[serde(default = "sure")]
    confidence: f64,
    how: How,
}

fn sure() -> f64 {
    1.0
}

impl PointRow {
    /// The point.
    ///
    /// # Errors
    /// Without a line: coordinates beyond [`MAX_COORDINATE`], or a confidence that is not from 0 to 1.
    pub(crate) fn placed(&self, name: &str) -> Result<Placed> {
        if ![self.x, self.y].iter().all(|v| v.abs() <= MAX_COORDINATE) {
            return Err(Fault::of(FileFault::OutOfRange, format!("point {name} lies nowhere near a photo"))
                .help("give pixels of the photo"));
        }
        if !(0.0..=1.0).contains(&self.confidence) {
            return Err(Fault::of(FileFault::OutOfRange, format!("the confidence of point {name} is not from 0 to 1"))
                .help("write 1 for a point that you have set, or leave it out"));
        }
        Ok(Placed { at: Point::new(self.x, self.y), confidence: self.confidence, how: self.how })
    }

    /// The line of a point, with that many decimals of a pixel.
    pub(crate) fn line(name: &str, point: &Placed, decimals: usize) -> String {
        let how = match point.how {
            How::Found => "found",
            How::Rule => "rule",
            How::Hand => "hand",
        };
        format!(
            "\"{name}\" = {{ x = {:.decimals$}, y = {:.decimals$}, confidence = {:.2}, how = \"{how}\" }}\n",
            point.at.x, point.at.y, point.confidence
        )
    }
}

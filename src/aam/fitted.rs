//! The result of a fit.

use crate::geometry::{Point, Similarity};

/// A fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// The points in pixels of the picture, in the order of the training annotation.
    pub points: Vec<Point>,
    /// The shape without its pose: along each mode, in widths of the mean shape (paper eq. 5).
    pub p: Vec<f64>,
    /// The pose: from the mean shape, whose width is 1, to pixels.
    pub q: Similarity,
    /// 0 to 1: from 0.5 on the fit can be used. Made so that fits with an error of more than 3 % of the pupil distance lie
    /// below.
    pub confidence: f64,
    /// Share of the contrast under the shape that the model cannot reproduce, 0 to 1.
    pub residual: f64,
    /// Steps at all levels together.
    pub iterations: usize,
    /// True where the last step was shorter than a tenth of a pixel.
    pub converged: bool,
    /// The points before anything was held: where the next frame begins.
    pub(super) ended: Vec<Point>,
}

//! Pixels as a thing in a drawing.

use std::sync::Arc;

use super::fit;
use crate::geometry::{Affine, Rect};

/// A picture of pixels, moved to its place in a drawing. Copies share their pixels.
#[derive(Debug, Clone, PartialEq)]
pub struct Raster {
    /// What it is; may be empty.
    pub name: String,
    width: usize,
    height: usize,
    rgba: Arc<[u8]>,
    place: Affine,
}

impl Raster {
    /// Straight sRGB with alpha, row by row from the top, four bytes a pixel; drawn from (0, 0), a unit a pixel.
    ///
    /// # Panics
    /// When there are not exactly `width × height × 4` bytes, or none.
    #[must_use]
    pub fn new(name: impl Into<String>, width: usize, height: usize, rgba: impl Into<Arc<[u8]>>) -> Self {
        let rgba = rgba.into();
        assert!(width > 0 && height > 0 && rgba.len() == width * height * 4, "a raster has width × height pixels");
        Self { name: name.into(), width, height, rgba, place: Affine::IDENTITY }
    }

    /// The same pixels, whole and centred in `frame`.
    #[must_use]
    pub fn placed_in(self, frame: Rect) -> Self {
        let place = fit(self.bounds(), frame);
        Self { place, ..self }
    }

    /// The same pixels moved by `place` from where a pixel is a unit.
    #[must_use]
    pub fn placed(self, place: Affine) -> Self {
        Self { place, ..self }
    }

    /// Pixels in a row.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    #[must_use]
    pub fn height(&self) -> usize {
        self.height
    }

    /// Straight sRGB with alpha, row by row from the top, four bytes a pixel.
    #[must_use]
    pub fn rgba(&self) -> &[u8] {
        &self.rgba
    }

    /// The move from pixels, whose corners are whole numbers, to the drawing.
    #[must_use]
    pub fn place(&self) -> Affine {
        self.place
    }

    /// Its own box, a unit a pixel.
    #[must_use]
    pub fn bounds(&self) -> Rect {
        Rect::new(0.0, 0.0, self.width as f64, self.height as f64)
    }
}

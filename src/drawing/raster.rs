//! Pixels as a thing in a drawing.

use std::sync::Arc;

use super::{Picture, fit};
use crate::geometry::{Affine, Rect};

/// A picture of pixels, moved to its place in a drawing. Copies share their pixels.
#[derive(Debug, Clone, PartialEq)]
pub struct Raster {
    /// What it is; may be empty.
    pub name: String,
    picture: Arc<Picture>,
    place: Affine,
}

impl Raster {
    /// A picture, drawn from (0, 0), a unit a pixel.
    #[must_use]
    pub fn new(name: impl Into<String>, picture: impl Into<Arc<Picture>>) -> Self {
        Self { name: name.into(), picture: picture.into(), place: Affine::IDENTITY }
    }

    /// The same pixels, whole and centred in `frame`.
    #[must_use]
    pub fn placed_in(self, frame: Rect) -> Self {
        let place = fit(self.bounds(), frame);
        Self { place, ..self }
    }

    /// The same pixels moved by `place` from where a pixel is a unit.
    #[must_use]
    pub(crate) fn placed(self, place: Affine) -> Self {
        Self { place, ..self }
    }

    /// The pixels.
    #[must_use]
    pub(crate) fn picture(&self) -> &Picture {
        &self.picture
    }

    /// The move from pixels, whose corners are whole numbers, to the drawing.
    #[must_use]
    pub(crate) fn place(&self) -> Affine {
        self.place
    }

    /// Its own box, a unit a pixel.
    #[must_use]
    pub(crate) fn bounds(&self) -> Rect {
        Rect::new(0.0, 0.0, self.picture.width() as f64, self.picture.height() as f64)
    }
}

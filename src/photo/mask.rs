//! Binary images, and boxes in them.

use crate::drawing::Image;
use crate::geometry::Point;

/// A yes or no a pixel.
pub type Mask = Image<bool>;

/// A box of whole pixels: from `x0`, `y0` up to, not including, `x1`, `y1`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Bounds {
    /// First column.
    pub x0: usize,
    /// First row.
    pub y0: usize,
    /// The column after the last.
    pub x1: usize,
    /// The row after the last.
    pub y1: usize,
}

impl Bounds {
    /// The pixels whose centres lie from (`x0`, `y0`) to (`x1`, `y1`) of an image; never none: where nothing of the
    /// image lies between, the nearest pixels.
    #[must_use]
    pub(crate) fn between(from: Point, to: Point, width: usize, height: usize) -> Self {
        let first = |v: f64, side: usize| (v.ceil().max(0.0) as usize).min(side - 1);
        let past = |v: f64, side: usize, first: usize| ((v.floor() + 1.0).max(0.0) as usize).clamp(first + 1, side);
        let (x0, y0) = (first(from.x, width), first(from.y, height));
        Self { x0, y0, x1: past(to.x, width, x0), y1: past(to.y, height, y0) }
    }

    /// All of an image.
    #[must_use]
    pub(crate) fn whole(width: usize, height: usize) -> Self {
        Self { x0: 0, y0: 0, x1: width, y1: height }
    }

    /// Columns.
    #[must_use]
    pub(crate) fn width(&self) -> usize {
        self.x1 - self.x0
    }

    /// Rows.
    #[must_use]
    pub(crate) fn height(&self) -> usize {
        self.y1 - self.y0
    }

    /// Width times height.
    #[must_use]
    pub(crate) fn area(&self) -> usize {
        self.width() * self.height()
    }

    /// The middle, where the centres of pixels are whole numbers.
    #[must_use]
    pub(crate) fn centre(&self) -> Point {
        Point::new((self.x0 + self.x1 - 1) as f64 / 2.0, (self.y0 + self.y1 - 1) as f64 / 2.0)
    }

    /// Whether a pixel lies in it.
    #[must_use]
    pub(crate) fn holds(&self, x: usize, y: usize) -> bool {
        (self.x0..self.x1).contains(&x) && (self.y0..self.y1).contains(&y)
    }

    /// Its pixels, row by row.
    pub(crate) fn pixels(self) -> impl Iterator<Item = (usize, usize)> {
        (self.y0..self.y1).flat_map(move |y| (self.x0..self.x1).map(move |x| (x, y)))
    }

    /// What two boxes share; none where they are apart.
    #[must_use]
    pub(crate) fn shared(&self, other: &Self) -> Option<Self> {
        let (x0, y0) = (self.x0.max(other.x0), self.y0.max(other.y0));
        let (x1, y1) = (self.x1.min(other.x1), self.y1.min(other.y1));
        (x0 < x1 && y0 < y1).then_some(Self { x0, y0, x1, y1 })
    }

    /// Grown to hold a pixel.
    pub(super) fn take(&mut self, x: usize, y: usize) {
        (self.x0, self.y0) = (self.x0.min(x), self.y0.min(y));
        (self.x1, self.y1) = (self.x1.max(x + 1), self.y1.max(y + 1));
    }
}

impl Mask {
    /// Whether a pixel is set; outside none is.
    #[must_use]
    pub(crate) fn is_set(&self, x: isize, y: isize) -> bool {
        x >= 0 && y >= 0 && self.get(x as usize, y as usize) == Some(&true)
    }

    /// Pixels that are set.
    #[must_use]
    pub(crate) fn count(&self) -> usize {
        self.pixels().iter().filter(|b| **b).count()
    }

    /// The indices of the pixels that are set, row by row.
    pub(crate) fn indices(&self) -> impl Iterator<Item = usize> {
        self.pixels().iter().enumerate().filter(|(_, set)| **set).map(|(i, _)| i)
    }

    /// The pixels set in both.
    ///
    /// # Panics
    /// When the sizes differ.
    #[must_use]
    pub(crate) fn and(&self, other: &Self) -> Self {
        self.with(other, |a, b| *a && *b)
    }

    /// The pixels set in either.
    ///
    /// # Panics
    /// When the sizes differ.
    #[must_use]
    pub(crate) fn or(&self, other: &Self) -> Self {
        self.with(other, |a, b| *a || *b)
    }

    /// The pixels set in this and not in the other.
    ///
    /// # Panics
    /// When the sizes differ.
    #[must_use]
    pub(crate) fn without(&self, other: &Self) -> Self {
        self.with(other, |a, b| *a && !*b)
    }

    /// The pixels not set.
    #[must_use]
    pub(crate) fn not(&self) -> Self {
        self.map(|b| !b)
    }
}

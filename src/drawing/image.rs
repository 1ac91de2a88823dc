//! Pixels in rows: the one grid of photos, planes, masks and painted pictures.
//!
//! It owns storage, indexing, cropping and the neighbours between which is interpolated. The meaning of a pixel belongs
//! to the rooms that use it.

use std::ops::{Index, IndexMut, Range};

/// `width × height` pixels, row by row from the top; the centres of pixels are whole numbers.
///
/// `image[(x, y)]` is the pixel in column `x` of row `y`; outside the image it panics.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Image<T> {
    width: usize,
    height: usize,
    pixels: Vec<T>,
}

/// Straight sRGB with alpha, 8 bits each: red, green, blue, alpha.
pub type Picture = Image<[u8; 4]>;

impl<T> Image<T> {
    /// An image of `width` × `height` pixels, row by row.
    ///
    /// # Panics
    /// When there are not exactly `width * height` pixels, or none.
    #[must_use]
    pub fn new(width: usize, height: usize, pixels: Vec<T>) -> Self {
        assert!(width > 0 && height > 0 && pixels.len() == width * height, "an image has width × height pixels");
        Self { width, height, pixels }
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

    /// The pixels, row by row.
    #[must_use]
    pub fn pixels(&self) -> &[T] {
        &self.pixels
    }

    /// The pixels, row by row, to be changed.
    pub fn pixels_mut(&mut self) -> &mut [T] {
        &mut self.pixels
    }

    /// One row.
    #[must_use]
    #[inline]
    pub(crate) fn row(&self, y: usize) -> &[T] {
        &self.pixels[y * self.width..(y + 1) * self.width]
    }

    /// One row, to be changed.
    #[inline]
    pub fn row_mut(&mut self, y: usize) -> &mut [T] {
        &mut self.pixels[y * self.width..(y + 1) * self.width]
    }

    /// The rows from the top.
    pub(crate) fn rows(&self) -> std::slice::ChunksExact<'_, T> {
        self.pixels.chunks_exact(self.width)
    }

    /// The pixel in column `x` of row `y`; none outside.
    #[must_use]
    pub fn get(&self, x: usize, y: usize) -> Option<&T> {
        if x < self.width && y < self.height { self.pixels.get(y * self.width + x) } else { None }
    }

    /// An image of the same size, of `make` of each pixel.
    #[must_use]
    pub fn map<U>(&self, make: impl FnMut(&T) -> U) -> Image<U> {
        Image { width: self.width, height: self.height, pixels: self.pixels.iter().map(make).collect() }
    }

    /// An image of the same size, of `join` of each pixel of both.
    ///
    /// # Panics
    /// When the sizes differ.
    #[must_use]
    pub fn with<U, V>(&self, other: &Image<U>, mut join: impl FnMut(&T, &U) -> V) -> Image<V> {
        assert!(self.width == other.width && self.height == other.height, "images of one size");
        let pixels = self.pixels.iter().zip(&other.pixels).map(|(a, b)| join(a, b)).collect();
        Image { width: self.width, height: self.height, pixels }
    }

    /// The four pixels round a position, for bilinear interpolation: upper left, upper right, lower left, lower right;
    /// and its distances from the left and from the upper ones, 0 to 1. Positions beyond the border are moved to it.
    #[inline]
    #[must_use]
    pub(crate) fn around(&self, x: f64, y: f64) -> ([&T; 4], [f64; 2]) {
        let x = x.clamp(0.0, (self.width - 1) as f64);
        let y = y.clamp(0.0, (self.height - 1) as f64);
        let (x0, y0) = (x as usize, y as usize);
        let x1 = (x0 + 1).min(self.width - 1);
        let (above, below) = (self.row(y0), self.row((y0 + 1).min(self.height - 1)));
        ([&above[x0], &above[x1], &below[x0], &below[x1]], [x - x0 as f64, y - y0 as f64])
    }
}

impl<T: Clone> Image<T> {
    /// An image of one value.
    ///
    /// # Panics
    /// When it has no pixels.
    #[must_use]
    pub fn filled(width: usize, height: usize, value: T) -> Self {
        Self::new(width, height, vec![value; width * height])
    }

    /// Some columns of some rows.
    ///
    /// # Panics
    /// When they do not lie within the image, or are none.
    #[must_use]
    pub(crate) fn crop(&self, columns: Range<usize>, rows: Range<usize>) -> Self {
        let size = (columns.len(), rows.len());
        Self::new(size.0, size.1, rows.flat_map(|y| &self.row(y)[columns.clone()]).cloned().collect())
    }
}

impl<T: Copy> Image<T> {
    /// The pixel at `x`, `y`; beyond the border the nearest one.
    #[inline]
    #[must_use]
    pub fn at(&self, x: isize, y: isize) -> T {
        let x = x.clamp(0, self.width as isize - 1) as usize;
        let y = y.clamp(0, self.height as isize - 1) as usize;
        self.pixels[y * self.width + x]
    }
}

impl<T> Index<(usize, usize)> for Image<T> {
    type Output = T;

    #[inline]
    fn index(&self, (x, y): (usize, usize)) -> &T {
        &self.row(y)[x]
    }
}

impl<T> IndexMut<(usize, usize)> for Image<T> {
    #[inline]
    fn index_mut(&mut self, (x, y): (usize, usize)) -> &mut T {
        &mut self.row_mut(y)[x]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counted(width: usize, height: usize) -> Image<u8> {
        Image::new(width, height, (0..(width * height) as u8).collect())
    }

    #[test]
    fn a_pixel_is_found_by_column_and_row_and_the_border_goes_on() {
        let image = counted(4, 3);
        assert_eq!((image[(1, 2)], image.row(1), image.get(3, 2)), (9, &[4, 5, 6, 7][..], Some(&11)));
        assert_eq!([image.get(4, 0), image.get(0, 3)], [None, None]);
        assert_eq!([image.at(-5, 1), image.at(9, 9), image.at(2, -1)], [4, 11, 2]);
    }

    #[test]
    #[should_panic(expected = "out of bounds")]
    fn a_column_beyond_the_row_is_no_pixel_of_the_next() {
        let _ = counted(4, 3)[(4, 0)];
    }

    #[test]
    #[should_panic(expected = "width × height pixels")]
    fn too_few_pixels_are_no_image() {
        let _ = Image::new(2, 2, vec![0; 3]);
    }

    #[test]
    fn a_crop_has_the_columns_of_the_rows() {
        assert_eq!(counted(4, 3).crop(1..3, 1..3), Image::new(2, 2, vec![5, 6, 9, 10]));
    }

    #[test]
    fn a_position_between_pixels_has_four_round_it() {
        let image = counted(4, 3);
        assert_eq!(image.around(1.25, 0.5), ([&1, &2, &5, &6], [0.25, 0.5]));
        assert_eq!(image.around(9.0, -3.0), ([&3, &3, &7, &7], [0.0, 0.0]));
    }
}

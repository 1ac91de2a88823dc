//! Sheets of pixels, and how one colour is laid over another: in whole numbers, so that every processor gives the same.

/// A pixel: premultiplied sRGB, red in the lowest byte, alpha in the highest.
pub(super) type Pixel = u32;

/// A box of whole pixels; the right and lower edges are outside.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Area {
    pub(super) x0: i32,
    pub(super) y0: i32,
    pub(super) x1: i32,
    pub(super) y1: i32,
}

impl Area {
    pub(super) const NONE: Self = Self { x0: 0, y0: 0, x1: 0, y1: 0 };

    pub(super) const fn of_size(width: u32, height: u32) -> Self {
        Self { x0: 0, y0: 0, x1: width as i32, y1: height as i32 }
    }

    pub(super) fn is_empty(self) -> bool {
        self.x0 >= self.x1 || self.y0 >= self.y1
    }

    pub(super) fn meet(self, other: Self) -> Self {
        let met = Self {
            x0: self.x0.max(other.x0),
            y0: self.y0.max(other.y0),
            x1: self.x1.min(other.x1),
            y1: self.y1.min(other.y1),
        };
        if met.is_empty() { Self::NONE } else { met }
    }

    pub(super) fn join(self, other: Self) -> Self {
        if self.is_empty() {
            return other;
        }
        if other.is_empty() {
            return self;
        }
        Self {
            x0: self.x0.min(other.x0),
            y0: self.y0.min(other.y0),
            x1: self.x1.max(other.x1),
            y1: self.y1.max(other.y1),
        }
    }

    pub(super) fn width(self) -> usize {
        (self.x1 - self.x0).max(0) as usize
    }

    pub(super) fn height(self) -> usize {
        (self.y1 - self.y0).max(0) as usize
    }
}

/// Pixels of a part of the picture, in the picture's own coordinates.
#[derive(Default)]
pub(super) struct Canvas {
    area: Area,
    pixels: Vec<Pixel>,
}

impl Canvas {
    /// A transparent sheet.
    pub(super) fn new(area: Area) -> Self {
        Self { area, pixels: vec![0; area.width() * area.height()] }
    }

    pub(super) fn area(&self) -> Area {
        self.area
    }

    /// The same in memory that was used before.
    pub(super) fn renew(&mut self, area: Area) {
        self.area = area;
        self.pixels.clear();
        self.pixels.resize(area.width() * area.height(), 0);
    }

    /// The pixels `x0..x1` of row `y`, which lie on the sheet.
    pub(super) fn row(&self, y: i32, x0: i32, x1: i32) -> &[Pixel] {
        let start = (y - self.area.y0) as usize * self.area.width();
        &self.pixels[start + (x0 - self.area.x0) as usize..start + (x1 - self.area.x0) as usize]
    }

    /// The same to be written to.
    pub(super) fn row_mut(&mut self, y: i32, x0: i32, x1: i32) -> &mut [Pixel] {
        let start = (y - self.area.y0) as usize * self.area.width();
        &mut self.pixels[start + (x0 - self.area.x0) as usize..start + (x1 - self.area.x0) as usize]
    }

    /// Fills a part that lies on the sheet with one pixel.
    pub(super) fn fill(&mut self, part: Area, pixel: Pixel) {
        for y in part.y0..part.y1 {
            self.row_mut(y, part.x0, part.x1).fill(pixel);
        }
    }

    /// Takes a part that lies on both sheets from another one.
    pub(super) fn copy_from(&mut self, other: &Self, part: Area) {
        for y in part.y0..part.y1 {
            self.row_mut(y, part.x0, part.x1).copy_from_slice(other.row(y, part.x0, part.x1));
        }
    }
}

/// Two channels at a time, in every other byte.
const PAIR: u32 = 0x00FF_00FF;

/// Every channel of a pixel by `part / 255`, rounded.
#[inline]
pub(super) fn scaled(pixel: Pixel, part: u32) -> Pixel {
    let pair = |two: u32| {
        let product = two * part + 0x0080_0080;
        (product + ((product >> 8) & PAIR)) >> 8 & PAIR
    };
    pair(pixel & PAIR) | pair(pixel >> 8 & PAIR) << 8
}

/// One premultiplied pixel over another.
#[inline]
pub(super) fn over(source: Pixel, below: Pixel) -> Pixel {
    source + scaled(below, 255 - (source >> 24))
}

/// An opaque pixel over another one, with `part / 255` of it covering.
#[inline]
pub(super) fn mixed(source: Pixel, below: Pixel, part: u32) -> Pixel {
    let pair = |two: u32, under: u32| {
        let sum = two * part + under * (255 - part) + 0x0080_0080;
        (sum + ((sum >> 8) & PAIR)) >> 8 & PAIR
    };
    pair(source & PAIR, below & PAIR) | pair(source >> 8 & PAIR, below >> 8 & PAIR) << 8
}

/// One pixel over all of a row.
#[inline]
pub(super) fn lay(row: &mut [Pixel], source: Pixel) {
    match source >> 24 {
        0 => {}
        255 => row.fill(source),
        alpha => {
            // What is below is often alike for long.
            let (mut below, mut laid) = (0, source);
            for pixel in row {
                if *pixel != below {
                    below = *pixel;
                    laid = source + scaled(below, 255 - alpha);
                }
                *pixel = laid;
            }
        }
    }
}

/// A straight colour as a premultiplied pixel.
pub(super) fn pixel_of([r, g, b, a]: [u8; 4]) -> Pixel {
    scaled(u32::from_le_bytes([r, g, b, 255]), u32::from(a))
}

/// A premultiplied pixel as a straight one. With alpha 255 the two are the same.
#[inline]
pub(super) fn straight(pixel: Pixel) -> Pixel {
    let alpha = pixel >> 24;
    if alpha == 255 || alpha == 0 {
        return pixel;
    }
    let [r, g, b, a] = pixel.to_le_bytes();
    let channel = |v: u8| ((u32::from(v) * 255 + alpha / 2) / alpha).min(255) as u8;
    u32::from_le_bytes([channel(r), channel(g), channel(b), a])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn channels_are_scaled_as_if_one_by_one_and_rounded() {
        for value in 0..=255_u32 {
            for part in 0..=255_u32 {
                let wanted = (value * part * 2 + 255) / 510;
                assert_eq!(scaled(value * 0x0101_0101, part), wanted * 0x0101_0101, "{value} × {part}");
            }
        }
    }

    #[test]
    fn a_mixture_is_rounded_once_and_stays_opaque() {
        for (a, b) in (0..=255_u32).flat_map(|a| [0, 1, 77, 128, 254, 255].map(|b| (a, b))) {
            for part in 0..=255_u32 {
                let wanted = ((a * part + b * (255 - part)) * 2 + 255) / 510;
                assert_eq!(mixed(a * 0x0101_0101, b * 0x0101_0101, part), wanted * 0x0101_0101, "{a} {b} {part}");
            }
        }
    }

    #[test]
    fn what_is_opaque_stays_so_whatever_is_laid_over_it() {
        for alpha in 0..=255_u8 {
            for below in [0_u8, 1, 127, 254, 255] {
                let pixel = over(pixel_of([255, 3, 128, alpha]), u32::from_le_bytes([below, below, below, 255]));
                assert_eq!(pixel >> 24, 255);
            }
        }
    }
}

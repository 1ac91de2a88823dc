//! A number that tells one drawing from another, the same on every machine.

use super::{Drawing, Item};
use crate::geometry::{BezPath, Point, each_element};

impl Drawing {
    /// 64 bits of everything that is drawn; titles are not. Drawings that look alike have equal ones.
    #[must_use]
    pub fn fingerprint(&self) -> u64 {
        let mut sum = Sum(0xCBF2_9CE4_8422_2325);
        for v in [self.view.x0, self.view.y0, self.view.x1, self.view.y1] {
            sum.number(v);
        }
        sum.word(self.background.map_or(u64::MAX, |c| u64::from(u32::from_be_bytes([c.r, c.g, c.b, c.a]))));
        for layer in &self.layers {
            sum.word(u64::from(layer.name == "static"));
            layer.items.iter().for_each(|item| sum.item(item));
        }
        sum.0
    }
}

/// The same of items alone.
pub(super) fn of_items(items: &[Item]) -> u64 {
    let mut sum = Sum(0xCBF2_9CE4_8422_2325);
    items.iter().for_each(|item| sum.item(item));
    sum.0
}

/// FNV-1a over words instead of bytes, with a rotation so that the high bits of numbers reach the low ones.
struct Sum(u64);

impl Sum {
    fn word(&mut self, word: u64) {
        self.0 = (self.0 ^ word).wrapping_mul(0x0000_0100_0000_01B3).rotate_left(23);
        self.0 ^= self.0 >> 29;
    }

    /// To a ten-thousandth, far below what can be seen and far above what mathematics libraries disagree on.
    fn number(&mut self, number: f64) {
        // Rounded by hand: processors without an instruction for it call a function.
        let scaled = number * 1e4;
        self.word((scaled + 0.5_f64.copysign(scaled)) as i64 as u64);
    }

    fn point(&mut self, point: Point) {
        self.number(point.x);
        self.number(point.y);
    }

    fn text(&mut self, text: &str) {
        self.word(text.len() as u64);
        text.bytes().for_each(|b| self.word(u64::from(b)));
    }

    fn colour(&mut self, c: super::Colour) {
        self.word(u64::from(u32::from_be_bytes([c.r, c.g, c.b, c.a])));
    }

    fn path(&mut self, path: &BezPath) {
        self.word(path.elements().len() as u64);
        each_element(path, |kind, points| {
            self.word(kind);
            points.iter().for_each(|p| self.point(*p));
        });
    }

    fn item(&mut self, item: &Item) {
        match item {
            Item::Area(area) => {
                self.word(11);
                self.path(&area.path);
                self.colour(area.colour);
            }
            Item::Ink(ink) => {
                self.word(12);
                self.colour(ink.colour);
                self.word(ink.strokes.len() as u64);
                for knot in ink.strokes.iter().flat_map(|r| r.0) {
                    self.point(knot.point());
                    self.number(knot.w);
                }
            }
            Item::Text(text) => {
                self.word(13 + ((text.anchor as u64) << 8));
                self.point(text.at);
                self.number(text.size);
                self.colour(text.colour);
                self.text(&text.text);
            }
            Item::Glow(glow) => {
                self.word(15);
                self.point(glow.at);
                self.point(glow.radii.to_point());
                self.colour(glow.colour);
            }
            Item::Shared(shared) => {
                self.word(16);
                self.word(shared.fingerprint());
            }
            Item::Group(group) => {
                self.word(14);
                group.transform.as_coeffs().into_iter().for_each(|v| self.number(v));
                self.word(u64::from(group.clip.is_some()));
                if let Some(clip) = &group.clip {
                    self.path(clip);
                }
                self.word(group.items.len() as u64);
                group.items.iter().for_each(|item| self.item(item));
            }
            Item::Picture(raster) => {
                self.word(15);
                raster.place().as_coeffs().into_iter().for_each(|v| self.number(v));
                self.word(raster.picture().width() as u64);
                self.word(raster.picture().height() as u64);
                for pair in raster.picture().pixels().as_flattened().chunks(8) {
                    self.word(pair.iter().fold(0, |word, byte| word << 8 | u64::from(*byte)));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::figure::LineFigure;
    use crate::pose::{Gaze, Pose};

    #[test]
    fn what_looks_different_has_another_fingerprint() {
        let figure = LineFigure::built_in("line").unwrap();
        let print = |pose: &Pose| figure.draw(pose).fingerprint();
        let still = Pose::default();
        assert_eq!(print(&still), print(&still));
        assert_ne!(print(&still), print(&Pose { gaze: Gaze { x: 1e-3, y: 0.0 }, ..still }));
    }
}

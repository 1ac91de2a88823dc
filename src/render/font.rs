//! The one small font that pictures with text carry: a subset of Inter (`font/OFL.txt`), Latin with the marks of
//! Hanyu Pinyin. No installed font is looked at, so that the same text gives the same pixels everywhere.

use std::sync::LazyLock;

use ttf_parser::{Face, GlyphId, OutlineBuilder};

use crate::drawing::{Drawing, Item};
use crate::geometry::{Affine, BezPath, Point};

static FACE: LazyLock<Option<Face<'static>>> =
    LazyLock::new(|| Face::parse(include_bytes!("font/inter-latin.otf"), 0).ok());

/// The outline of a line of text that starts at (0, 0) on the baseline with an em of `size`. A character that the
/// font lacks is drawn as its empty box.
#[must_use]
pub fn text_outline(text: &str, size: f64) -> BezPath {
    let mut path = BezPath::new();
    let Some(face) = FACE.as_ref() else { return path };
    let scale = size / f64::from(face.units_per_em());
    let mut x = 0.0;
    for c in text.chars() {
        let glyph = face.glyph_index(c).unwrap_or(GlyphId(0));
        let mut pen = Pen(BezPath::new());
        face.outline_glyph(glyph, &mut pen);
        // Fonts have y upward.
        path.extend((Affine::translate((x, 0.0)) * Affine::scale_non_uniform(scale, -scale) * pen.0).iter());
        x += advance(face, glyph) * scale;
    }
    path
}

/// How wide that line is.
#[must_use]
pub fn text_width(text: &str, size: f64) -> f64 {
    let Some(face) = FACE.as_ref() else { return 0.0 };
    let scale = size / f64::from(face.units_per_em());
    text.chars().map(|c| advance(face, face.glyph_index(c).unwrap_or(GlyphId(0))) * scale).sum()
}

/// The first character of `text` that the font has no shape for.
#[must_use]
pub fn uncovered(text: &str) -> Option<char> {
    let face = FACE.as_ref()?;
    text.chars().find(|c| face.glyph_index(*c).is_none())
}

/// The first character in a drawing's texts that the font has no shape for.
#[must_use]
pub fn uncovered_in(drawing: &Drawing) -> Option<char> {
    fn of(item: &Item) -> Option<char> {
        match item {
            Item::Text(text) => uncovered(&text.text),
            Item::Group(group) => group.items.iter().find_map(of),
            Item::Area(_) | Item::Ink(_) => None,
        }
    }
    drawing.layers.iter().flat_map(|l| &l.items).find_map(of)
}

fn advance(face: &Face<'_>, glyph: GlyphId) -> f64 {
    f64::from(face.glyph_hor_advance(glyph).unwrap_or(0))
}

struct Pen(BezPath);

fn point(x: f32, y: f32) -> Point {
    Point::new(f64::from(x), f64::from(y))
}

impl OutlineBuilder for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.0.move_to(point(x, y));
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.0.line_to(point(x, y));
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.0.quad_to(point(x1, y1), point(x, y));
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.0.curve_to(point(x1, y1), point(x2, y2), point(x, y));
    }

    fn close(&mut self) {
        self.0.close_path();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_font_has_every_letter_of_pinyin_and_says_what_it_lacks() {
        assert_eq!(uncovered("nǐ hǎo, lǜ ér ǖǘǚ Xī'ān – 0.25 s"), None);
        assert_eq!(uncovered("a您"), Some('您'));
        assert!(text_width("mm", 10.0) > text_width("ii", 10.0));
    }
}

//! The one small font that pictures with text carry: a subset of Inter (`font/OFL.txt`), Latin with the marks of
//! Hanyu Pinyin. No installed font is looked at, so that the same text gives the same pixels everywhere.

use std::sync::LazyLock;

use ttf_parser::{Face, GlyphId, OutlineBuilder};

use crate::disk::{Fault, FileFault, Result};
use crate::drawing::{Drawing, Item};
use crate::geometry::{Affine, BezPath, Point};

static OURS: LazyLock<Option<Face<'static>>> =
    LazyLock::new(|| Face::parse(include_bytes!("font/inter-latin.otf"), 0).ok());

/// A font file that a person gives for what ours lacks, such as Chinese.
#[derive(Debug, Clone)]
pub struct FontFile(Vec<u8>);

impl FontFile {
    /// Takes the bytes of a TrueType or OpenType file, or of a collection (its first font).
    ///
    /// # Errors
    /// When they are no such file.
    pub fn new(bytes: Vec<u8>) -> Result<Self> {
        match Face::parse(&bytes, 0) {
            Ok(_) => Ok(Self(bytes)),
            Err(e) => Err(Fault::of(FileFault::Unsupported, format!("this is no font that can be read: {e}"))
                .help("give a .ttf, .otf or .ttc file")),
        }
    }

    fn face(&self) -> Option<Face<'_>> {
        Face::parse(&self.0, 0).ok()
    }
}

/// The outline of a line of text that starts at (0, 0) on the baseline with an em of `size`. What our font lacks is
/// taken from `other`; what both lack is an empty box.
#[must_use]
pub fn text_outline(text: &str, size: f64, other: Option<&FontFile>) -> BezPath {
    let mut path = BezPath::new();
    walk(text, size, other, &mut |face, glyph, x, scale| {
        let mut pen = Pen(BezPath::new());
        face.outline_glyph(glyph, &mut pen);
        // Fonts have y upward.
        path.extend((Affine::translate((x, 0.0)) * Affine::scale_non_uniform(scale, -scale) * pen.0).iter());
    });
    path
}

/// How wide that line is.
#[must_use]
pub fn text_width(text: &str, size: f64, other: Option<&FontFile>) -> f64 {
    walk(text, size, other, &mut |_, _, _, _| {})
}

/// Goes through a line glyph by glyph: face, glyph, place and scale. Returns where it ends.
fn walk(text: &str, size: f64, other: Option<&FontFile>, each: &mut dyn FnMut(&Face<'_>, GlyphId, f64, f64)) -> f64 {
    let Some(ours) = OURS.as_ref() else { return 0.0 };
    let other = other.and_then(FontFile::face);
    let mut x = 0.0;
    for c in text.chars() {
        let found = ours.glyph_index(c).map(|g| (ours, g));
        let found = found.or_else(|| other.as_ref().and_then(|face| Some((face, face.glyph_index(c)?))));
        let (face, glyph) = found.unwrap_or((ours, GlyphId(0)));
        let scale = size / f64::from(face.units_per_em());
        each(face, glyph, x, scale);
        x += f64::from(face.glyph_hor_advance(glyph).unwrap_or(0)) * scale;
    }
    x
}

/// The first character of `text` that our font has no shape for.
#[must_use]
pub fn uncovered(text: &str) -> Option<char> {
    let face = OURS.as_ref()?;
    text.chars().find(|c| face.glyph_index(*c).is_none())
}

/// The first character in a drawing's texts that the font has no shape for.
#[must_use]
pub fn uncovered_in(drawing: &Drawing) -> Option<char> {
    fn of(item: &Item) -> Option<char> {
        match item {
            Item::Text(text) => uncovered(&text.text),
            Item::Group(group) => group.items.iter().find_map(of),
            Item::Shared(shared) => shared.items().iter().find_map(of),
            Item::Area(_) | Item::Ink(_) | Item::Glow(_) | Item::Picture(_) => None,
        }
    }
    drawing.layers.iter().flat_map(|l| &l.items).find_map(of)
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
        assert!(text_width("mm", 10.0, None) > text_width("ii", 10.0, None));
    }
}

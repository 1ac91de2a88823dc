//! A drawing as pixels, by tiny-skia. Layers named `static` are painted once and copied while they stay the same.

use tiny_skia::{FillRule, GradientStop, Mask, Paint, PathBuilder, Pixmap, RadialGradient, SpreadMode, Transform};

use super::{FontFile, MAX_SIDE, TOLERANCE, text_outline, text_width};
use crate::disk::{Fault, Result};
use crate::drawing::{Anchor, Colour, Drawing, Glow, Item, Layer, fit};
use crate::geometry::{Affine, BezPath, Ellipse, PathEl, Rect, Shape, outline};

/// Pixels, row by row from the top: straight sRGB with alpha, 8 bits each, in the order red, green, blue, alpha.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Picture {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// `width × height × 4` bytes.
    pub rgba: Vec<u8>,
}

impl Picture {
    /// The four channels of one pixel; `None` outside.
    #[must_use]
    pub fn pixel(&self, x: u32, y: u32) -> Option<[u8; 4]> {
        if x >= self.width || y >= self.height {
            return None;
        }
        let start = (y as usize * self.width as usize + x as usize) * 4;
        self.rgba.get(start..start + 4).and_then(|p| p.try_into().ok())
    }
}

/// Paints drawings of one size. Keeps the static layers' pixels from one drawing to the next.
pub struct Painter {
    width: u32,
    height: u32,
    canvas: Pixmap,
    kept: Option<Kept>,
    font: Option<FontFile>,
}

/// What the start of every drawing so far had in common, painted.
struct Kept {
    view: Rect,
    background: Option<Colour>,
    layers: Vec<Layer>,
    pixels: Pixmap,
}

impl Painter {
    /// A painter of pictures of this size.
    ///
    /// # Errors
    /// When a side is 0 or larger than [`MAX_SIDE`].
    pub fn new(width: u32, height: u32) -> Result<Self> {
        let fits = |side| (1..=MAX_SIDE).contains(&side);
        Pixmap::new(width, height)
            .filter(|_| fits(width) && fits(height))
            .map(|canvas| Self { width, height, canvas, kept: None, font: None })
            .ok_or_else(|| {
                Fault::new(format!("a picture cannot be {width} × {height} pixels"))
                    .help(format!("give sides from 1 to {MAX_SIDE}"))
            })
    }

    /// The same painter, with a font for what ours lacks.
    #[must_use]
    pub fn with_font(mut self, font: Option<FontFile>) -> Self {
        self.font = font;
        self
    }

    /// Paints one drawing.
    #[must_use]
    pub fn paint(&mut self, drawing: &Drawing) -> Picture {
        let frame = Rect::new(0.0, 0.0, f64::from(self.width), f64::from(self.height));
        let place = fit(drawing.view, frame);
        let still = drawing.layers.iter().take_while(|l| l.name == "static").count();
        let (still, moving) = drawing.layers.split_at(still);
        let same = self
            .kept
            .as_ref()
            .is_some_and(|k| k.view == drawing.view && k.background == drawing.background && k.layers == still);
        if !same {
            self.canvas.fill(drawing.background.map_or(tiny_skia::Color::TRANSPARENT, skia_colour));
            paint_layers(&mut self.canvas, still, place, self.font.as_ref());
            self.kept = Some(Kept {
                view: drawing.view,
                background: drawing.background,
                layers: still.to_vec(),
                pixels: self.canvas.clone(),
            });
        } else if let Some(kept) = &self.kept {
            self.canvas.data_mut().copy_from_slice(kept.pixels.data());
        }
        paint_layers(&mut self.canvas, moving, place, self.font.as_ref());
        let opaque = drawing.background.is_some_and(|c| c.a == 255);
        Picture { width: self.width, height: self.height, rgba: straight(&self.canvas, opaque) }
    }
}

/// Premultiplied pixels as straight ones. With alpha 255 everywhere the two are the same.
fn straight(canvas: &Pixmap, opaque: bool) -> Vec<u8> {
    if opaque {
        return canvas.data().to_vec();
    }
    let mut rgba = Vec::with_capacity(canvas.data().len());
    for pixel in canvas.pixels() {
        let c = pixel.demultiply();
        rgba.extend_from_slice(&[c.red(), c.green(), c.blue(), c.alpha()]);
    }
    rgba
}

fn skia_colour(c: Colour) -> tiny_skia::Color {
    tiny_skia::Color::from_rgba8(c.r, c.g, c.b, c.a)
}

fn paint_layers(canvas: &mut Pixmap, layers: &[Layer], place: Affine, font: Option<&FontFile>) {
    for layer in layers {
        for item in &layer.items {
            paint_item(canvas, item, place, font);
        }
    }
}

fn paint_item(canvas: &mut Pixmap, item: &Item, place: Affine, font: Option<&FontFile>) {
    match item {
        Item::Area(area) => fill(canvas, &area.path, area.colour, place),
        Item::Ink(ink) => fill(canvas, &outline(&ink.strokes, TOLERANCE), ink.colour, place),
        Item::Text(text) => {
            let share = match text.anchor {
                Anchor::Start => 0.0,
                Anchor::Middle => 0.5,
                Anchor::End => 1.0,
            };
            let start =
                text.at.to_vec2() - crate::geometry::Vec2::new(share * text_width(&text.text, text.size, font), 0.0);
            let path = Affine::translate(start) * text_outline(&text.text, text.size, font);
            fill(canvas, &path, text.colour, place);
        }
        Item::Glow(glow) => paint_glow(canvas, glow, place),
        Item::Shared(shared) => shared.items().iter().for_each(|item| paint_item(canvas, item, place, font)),
        Item::Group(group) => {
            let place = place * group.transform;
            match &group.clip {
                Some(clip) => paint_clipped(canvas, clip, &group.items, place, font),
                None => group.items.iter().for_each(|item| paint_item(canvas, item, place, font)),
            }
        }
        Item::Picture(raster) => super::raster::paint(canvas, raster, place),
    }
}

/// Paints what is seen through `clip`: on a sheet of the clip's own size, which is cut by it and then laid down. So
/// the edges of what lies over each other inside do not show through at the clip's.
fn paint_clipped(canvas: &mut Pixmap, clip: &BezPath, items: &[Item], place: Affine, font: Option<&FontFile>) {
    let frame = Rect::new(0.0, 0.0, f64::from(canvas.width()), f64::from(canvas.height()));
    let bounds = (place * clip).control_box().expand().intersect(frame);
    // An empty path's box is not finite; outside the canvas nothing is left of it.
    if !bounds.is_finite() || bounds.width() < 1.0 || bounds.height() < 1.0 {
        return;
    }
    let (wide, high) = (bounds.width() as u32, bounds.height() as u32);
    let (Some(mut sheet), Some(mut mask)) = (Pixmap::new(wide, high), Mask::new(wide, high)) else { return };
    let place = Affine::translate(-bounds.origin().to_vec2()) * place;
    let Some(path) = skia_path(clip, place) else { return };
    mask.fill_path(&path, FillRule::Winding, true, Transform::identity());
    items.iter().for_each(|item| paint_item(&mut sheet, item, place, font));
    lay_down(canvas, &sheet, &mask, bounds.x0 as usize, bounds.y0 as usize);
}

/// Lays a sheet on the canvas at (`x`, `y`), where it fits whole, as far as its mask lets through: source over, on
/// premultiplied bytes. tiny-skia's own ways, which do more, take ten times as long.
fn lay_down(canvas: &mut Pixmap, sheet: &Pixmap, mask: &Mask, x: usize, y: usize) {
    let (wide, across) = (sheet.width() as usize, canvas.width() as usize);
    let rows = sheet.data().chunks_exact(4 * wide).zip(mask.data().chunks_exact(wide));
    let below = canvas.data_mut()[4 * across * y..].chunks_exact_mut(4 * across);
    for ((row, cover), onto) in rows.zip(below) {
        let onto = onto[4 * x..4 * (x + wide)].chunks_exact_mut(4);
        for ((source, cover), pixel) in row.chunks_exact(4).zip(cover).zip(onto) {
            let alpha = share(source[3], *cover);
            match alpha {
                0 => {}
                255 => pixel.copy_from_slice(source),
                _ => {
                    for (to, from) in pixel.iter_mut().zip(source) {
                        *to = share(*from, *cover) + share(*to, 255 - alpha);
                    }
                }
            }
        }
    }
}

/// `value × part / 255`, rounded.
fn share(value: u8, part: u8) -> u8 {
    let product = u32::from(value) * u32::from(part) + 128;
    ((product + (product >> 8)) >> 8) as u8
}

fn fill(canvas: &mut Pixmap, path: &BezPath, colour: Colour, place: Affine) {
    if colour.a == 0 {
        return;
    }
    if let Some(path) = skia_path(path, place) {
        let mut paint = Paint::default();
        paint.set_color(skia_colour(colour));
        canvas.fill_path(&path, &paint, FillRule::Winding, Transform::identity(), None);
    }
}

/// A colour that fades from the middle of an ellipse to nothing at its rim.
fn paint_glow(canvas: &mut Pixmap, glow: &Glow, place: Affine) {
    let radii = glow.radii;
    if glow.colour.a == 0 || radii.x <= 0.0 || radii.y <= 0.0 {
        return;
    }
    // The gradient is a unit disc's, brought to the ellipse.
    let to_ellipse = place * Affine::translate(glow.at.to_vec2()) * Affine::scale_non_uniform(radii.x, radii.y);
    let [a, b, c, d, e, f] = to_ellipse.as_coeffs().map(|v| v as f32);
    let colour = skia_colour(glow.colour);
    let mut clear = colour;
    clear.set_alpha(0.0);
    let stops = vec![GradientStop::new(0.0, colour), GradientStop::new(1.0, clear)];
    let (middle, moved) = (tiny_skia::Point::zero(), Transform::from_row(a, b, c, d, e, f));
    let Some(shader) = RadialGradient::new(middle, 0.0, middle, 1.0, stops, SpreadMode::Pad, moved) else { return };
    let ellipse = Ellipse::new(glow.at, radii, 0.0).to_path(1e-3);
    if let Some(path) = skia_path(&ellipse, place) {
        let paint = Paint { shader, ..Paint::default() };
        canvas.fill_path(&path, &paint, FillRule::Winding, Transform::identity(), None);
    }
}

/// The path in pixels. Moved in 64 bits and rounded once.
pub(super) fn skia_path(path: &BezPath, place: Affine) -> Option<tiny_skia::Path> {
    let mut builder = PathBuilder::with_capacity(path.elements().len(), path.elements().len() * 2);
    let at = |p: crate::geometry::Point| {
        let q = place * p;
        (q.x as f32, q.y as f32)
    };
    for element in path.elements() {
        match *element {
            PathEl::MoveTo(p) => {
                let (x, y) = at(p);
                builder.move_to(x, y);
            }
            PathEl::LineTo(p) => {
                let (x, y) = at(p);
                builder.line_to(x, y);
            }
            PathEl::QuadTo(a, p) => {
                let ((x1, y1), (x, y)) = (at(a), at(p));
                builder.quad_to(x1, y1, x, y);
            }
            PathEl::CurveTo(a, b, p) => {
                let ((x1, y1), (x2, y2), (x, y)) = (at(a), at(b), at(p));
                builder.cubic_to(x1, y1, x2, y2, x, y);
            }
            PathEl::ClosePath => builder.close(),
        }
    }
    builder.finish()
}

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
            paint_item(canvas, item, place, None, font);
        }
    }
}

fn paint_item(canvas: &mut Pixmap, item: &Item, place: Affine, mask: Option<&Mask>, font: Option<&FontFile>) {
    match item {
        Item::Area(area) => fill(canvas, &area.path, area.colour, place, mask),
        Item::Ink(ink) => fill(canvas, &outline(&ink.strokes, TOLERANCE), ink.colour, place, mask),
        Item::Text(text) => {
            let share = match text.anchor {
                Anchor::Start => 0.0,
                Anchor::Middle => 0.5,
                Anchor::End => 1.0,
            };
            let start =
                text.at.to_vec2() - crate::geometry::Vec2::new(share * text_width(&text.text, text.size, font), 0.0);
            let path = Affine::translate(start) * text_outline(&text.text, text.size, font);
            fill(canvas, &path, text.colour, place, mask);
        }
        Item::Glow(glow) => paint_glow(canvas, glow, place, mask),
        Item::Shared(shared) => shared.items().iter().for_each(|item| paint_item(canvas, item, place, mask, font)),
        Item::Group(group) => {
            let place = place * group.transform;
            let clip = group.clip.as_ref().map(|path| clip_mask(canvas, path, place, mask));
            for item in &group.items {
                paint_item(canvas, item, place, clip.as_ref().or(mask), font);
            }
        }
        Item::Picture(raster) => super::raster::paint(canvas, raster, place, mask),
    }
}

/// What may be painted inside `path`, and inside the mask that holds outside it.
fn clip_mask(canvas: &Pixmap, path: &BezPath, place: Affine, outer: Option<&Mask>) -> Mask {
    let path = skia_path(path, place);
    let mask = match outer {
        Some(outer) => {
            let mut mask = outer.clone();
            match path {
                Some(path) => mask.intersect_path(&path, FillRule::Winding, true, Transform::identity()),
                None => mask.clear(),
            }
            Some(mask)
        }
        None => Mask::new(canvas.width(), canvas.height()).map(|mut mask| {
            if let Some(path) = path {
                mask.fill_path(&path, FillRule::Winding, true, Transform::identity());
            }
            mask
        }),
    };
    // A mask has the size of a canvas that exists, so it can be made; one pixel stands for none.
    mask.unwrap_or_else(|| Mask::from_pixmap(canvas.as_ref(), tiny_skia::MaskType::Alpha))
}

fn fill(canvas: &mut Pixmap, path: &BezPath, colour: Colour, place: Affine, mask: Option<&Mask>) {
    if colour.a == 0 {
        return;
    }
    if let Some(path) = skia_path(path, place) {
        let mut paint = Paint::default();
        paint.set_color(skia_colour(colour));
        canvas.fill_path(&path, &paint, FillRule::Winding, Transform::identity(), mask);
    }
}

/// A colour that fades from the middle of an ellipse to nothing at its rim.
fn paint_glow(canvas: &mut Pixmap, glow: &Glow, place: Affine, mask: Option<&Mask>) {
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
        canvas.fill_path(&path, &paint, FillRule::Winding, Transform::identity(), mask);
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

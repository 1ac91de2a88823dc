//! The things of a drawing one by one: where each may touch the picture, what tells it from others, and, made ready
//! only when it is painted, its edges.

use std::sync::{Arc, OnceLock};

use super::canvas::{Area, Pixel, pixel_of};
use super::edges::{Edges, FAR};
use super::print::Print;
use super::raster::Sampler;
use super::tiles::{Grid, Touch};
use super::{FontFile, TOLERANCE, text_outline, text_width};
use crate::drawing::{Anchor, Colour, Glow, Item, Text};
use crate::geometry::{Affine, BezPath, Point, Shape as _, Vec2, each_element, outline};

/// A thing ready to be painted.
pub(super) struct Leaf {
    /// It touches no other pixels.
    pub(super) bounds: Area,
    pub(super) print: Print,
    pub(super) shape: Shape,
    touched: OnceLock<Vec<(u32, Touch)>>,
}

/// What is painted.
pub(super) enum Shape {
    Fill {
        edges: Edges,
        pixel: Pixel,
    },
    /// Brings the middle of a pixel to the unit disc over which the colour fades.
    Glow {
        to_disc: Affine,
        colour: Colour,
    },
    /// Things seen through an outline.
    Clipped {
        edges: Edges,
        leaves: Vec<Leaf>,
    },
    Picture {
        edges: Edges,
        sampler: Sampler,
    },
    Nothing,
}

/// A part of a drawing, back to front: one thing of this drawing alone, or things that many have in common.
pub(super) enum Part {
    One(Arc<Leaf>),
    Kept(Print, Arc<[Leaf]>),
}

impl Leaf {
    /// Makes a thing ready that is neither shared nor a group without a clip. `print` is that of [`print_of`].
    pub(super) fn new(item: &Item, print: Print, place: Affine, font: Option<&FontFile>) -> Self {
        let shape = shape(item, place, font);
        let bounds = match &shape {
            Shape::Nothing => Area::NONE,
            Shape::Glow { to_disc, .. } => disc_bounds(to_disc.inverse()),
            Shape::Fill { edges, .. } | Shape::Clipped { edges, .. } | Shape::Picture { edges, .. } => edges.bounds(),
        };
        Self { bounds, print, shape, touched: OnceLock::new() }
    }

    /// The tiles that it touches.
    pub(super) fn touched(&self, grid: Grid) -> &[(u32, Touch)] {
        self.touched.get_or_init(|| match &self.shape {
            Shape::Nothing => Vec::new(),
            Shape::Glow { .. } => grid.of_box(self.bounds),
            Shape::Fill { edges, .. } | Shape::Clipped { edges, .. } | Shape::Picture { edges, .. } => {
                grid.of_edges(edges, self.bounds)
            }
        })
    }
}

/// The things of `items` moved by `place`, all made ready.
pub(super) fn leaves(items: &[Item], place: Affine, font: Option<&FontFile>) -> Vec<Leaf> {
    let mut all = Vec::with_capacity(items.len());
    single(items, place, &mut |item, place| all.push(Leaf::new(item, print_of(item, place), place, font)));
    all
}

/// All that a thing at a place looks like, but for the font of its texts.
pub(super) fn print_of(item: &Item, place: Affine) -> Print {
    let mut print = Print::START;
    print.numbers(&place.as_coeffs());
    put(item, &mut print);
    print
}

fn put(item: &Item, print: &mut Print) {
    let colour = |print: &mut Print, kind: u64, c: Colour| {
        print.word(kind << 32 | u64::from(u32::from_be_bytes([c.r, c.g, c.b, c.a])));
    };
    match item {
        Item::Area(area) => {
            colour(print, 1, area.colour);
            path(&area.path, print);
        }
        Item::Ink(ink) => {
            colour(print, 2, ink.colour);
            for stroke in &ink.strokes {
                print.word(stroke.0.len() as u64);
                stroke.0.iter().for_each(|knot| print.numbers(&[knot.x, knot.y, knot.w]));
            }
        }
        Item::Text(text) => {
            colour(print, 3 + ((text.anchor as u64) << 8), text.colour);
            print.numbers(&[text.at.x, text.at.y, text.size]);
            print.word(text.text.len() as u64);
            text.text.bytes().for_each(|b| print.word(b.into()));
        }
        Item::Glow(glow) => {
            colour(print, 4, glow.colour);
            print.numbers(&[glow.at.x, glow.at.y, glow.radii.x, glow.radii.y]);
        }
        Item::Group(group) => {
            print.word(5 << 32 | u64::from(group.clip.is_some()));
            print.numbers(&group.transform.as_coeffs());
            group.clip.iter().for_each(|clip| path(clip, print));
            print.word(group.items.len() as u64);
            group.items.iter().for_each(|item| put(item, print));
        }
        Item::Shared(shared) => {
            print.word(6 << 32);
            print.word(shared.fingerprint());
        }
        Item::Picture(raster) => {
            print.word(7 << 32);
            print.numbers(&raster.place().as_coeffs());
            let picture = raster.picture();
            print.word((picture.width() as u64) << 32 | picture.height() as u64);
            for eight in picture.pixels().as_flattened().chunks(8) {
                print.word(eight.iter().fold(0, |word, byte| word << 8 | u64::from(*byte)));
            }
        }
    }
}

fn path(path: &BezPath, print: &mut Print) {
    print.word(path.elements().len() as u64);
    each_element(path, |kind, points| {
        print.word(kind);
        points.iter().for_each(|p| print.numbers(&[p.x, p.y]));
    });
}

/// Calls `each` for everything in `items` that is one thing: shared things and groups without a clip are opened.
fn single<'a>(items: &'a [Item], place: Affine, each: &mut dyn FnMut(&'a Item, Affine)) {
    for item in items {
        match item {
            Item::Shared(shared) => single(shared.items(), place, each),
            Item::Group(group) if group.clip.is_none() => single(&group.items, place * group.transform, each),
            _ => each(item, place),
        }
    }
}

/// The pixels of the unit disc moved to the picture.
fn disc_bounds(from_disc: Affine) -> Area {
    let [a, b, c, d, e, f] = from_disc.as_coeffs();
    let (wide, high) = (a.hypot(c), b.hypot(d));
    let whole = |v: f64| v.clamp(-FAR, FAR).floor() as i32;
    Area { x0: whole(e - wide) - 1, y0: whole(f - high) - 1, x1: whole(e + wide) + 2, y1: whole(f + high) + 2 }
}

/// Where the baseline of a text starts.
fn text_start(text: &Text, font: Option<&FontFile>) -> Point {
    let share = match text.anchor {
        Anchor::Start => return text.at,
        Anchor::Middle => 0.5,
        Anchor::End => 1.0,
    };
    text.at - Vec2::new(share * text_width(&text.text, text.size, font), 0.0)
}

fn shape(item: &Item, place: Affine, font: Option<&FontFile>) -> Shape {
    let filled = |edges: &dyn Fn() -> Edges, c: Colour| match c.a {
        0 => Shape::Nothing,
        _ => Shape::Fill { edges: edges(), pixel: pixel_of([c.r, c.g, c.b, c.a]) },
    };
    let fill = |path: &BezPath, place: Affine, c: Colour| filled(&|| Edges::of(path, place), c);
    match item {
        Item::Area(area) => fill(&area.path, place, area.colour),
        Item::Ink(ink) => filled(&|| Edges::of_lines(&outline(&ink.strokes, TOLERANCE), place), ink.colour),
        Item::Text(text) => {
            let start = Affine::translate(text_start(text, font).to_vec2());
            fill(&text_outline(&text.text, text.size, font), place * start, text.colour)
        }
        Item::Glow(glow) => glow_shape(glow, place),
        Item::Picture(raster) => match Sampler::new(raster, place) {
            Some(sampler) => {
                let edges = Edges::of(&raster.bounds().to_path(0.1), place * raster.place());
                Shape::Picture { edges, sampler }
            }
            None => Shape::Nothing,
        },
        Item::Group(group) => {
            let place = place * group.transform;
            let edges = group.clip.as_ref().map(|clip| Edges::of(clip, place)).unwrap_or_default();
            Shape::Clipped { edges, leaves: leaves(&group.items, place, font) }
        }
        // Shared things are opened before they come here.
        Item::Shared(_) => Shape::Nothing,
    }
}

fn glow_shape(glow: &Glow, place: Affine) -> Shape {
    let radii = glow.radii;
    // Not so where one is not a number, either.
    let seen = glow.colour.a > 0 && radii.x > 0.0 && radii.y > 0.0;
    let from_disc = place * Affine::translate(glow.at.to_vec2()) * Affine::scale_non_uniform(radii.x, radii.y);
    if !seen || from_disc.determinant().abs() < 1e-12 || !from_disc.is_finite() {
        return Shape::Nothing;
    }
    Shape::Glow { to_disc: from_disc.inverse(), colour: glow.colour }
}

//! What a picture is made of before it is pixels: filled shapes, strokes of varying width, text, groups and layers.
//!
//! It owns no format: `render` turns a drawing into SVG text or pixels.

mod colour;
mod fingerprint;
mod image;
mod oklab;
mod raster;
mod shared;

pub use colour::Colour;
pub use image::{Image, Picture};
pub(crate) use oklab::{Oklab, Oklch};
pub use raster::Raster;
pub use shared::Shared;

use crate::geometry::{Affine, BezPath, Point, Rect, Ribbon, Vec2};

/// A whole picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    /// The part of the plane that is shown, fitted whole into the output and centred.
    pub view: Rect,
    /// What it is, in a few words, for screen readers and window titles.
    pub title: String,
    /// What can be seen, in a sentence.
    pub description: String,
    /// What lies behind everything, also beyond the view; none is transparent.
    pub background: Option<Colour>,
    /// Back to front.
    pub layers: Vec<Layer>,
}

/// A sheet of a drawing. Which ones stay the same from frame to frame is what lets a renderer draw them once
/// (thesis 7.3.1).
#[derive(Debug, Clone, PartialEq)]
pub struct Layer {
    /// `static`, `dynamic`, or an author's own.
    pub name: String,
    /// Back to front.
    pub items: Vec<Item>,
}

/// One thing on a layer.
#[derive(Debug, Clone, PartialEq)]
pub enum Item {
    /// A filled area.
    Area(Area),
    /// A stroke, or several that form one line.
    Ink(Ink),
    /// A line of text.
    Text(Text),
    /// A spot of colour without an edge.
    Glow(Glow),
    /// Several things moved or clipped together.
    Group(Group),
    /// Things that many drawings have in common.
    Shared(Shared),
    /// Pixels, such as a photo.
    Picture(Raster),
}

/// A filled area, non-zero winding.
#[derive(Debug, Clone, PartialEq)]
pub struct Area {
    /// What it is, in the words of the figure; may be empty.
    pub name: String,
    /// Its outline.
    pub path: BezPath,
    /// Its colour.
    pub colour: Colour,
}

/// Strokes of varying width, drawn as one filled outline so that their joints have no seams.
#[derive(Debug, Clone, PartialEq)]
pub struct Ink {
    /// The line's name.
    pub name: String,
    /// The strokes of the chain.
    pub strokes: Vec<Ribbon>,
    /// Its colour.
    pub colour: Colour,
}

/// A line of text.
#[derive(Debug, Clone, PartialEq)]
pub struct Text {
    /// Where the baseline starts, is centred, or ends.
    pub at: Point,
    /// Height of the em.
    pub size: f64,
    /// Which of the three.
    pub anchor: Anchor,
    /// Its colour.
    pub colour: Colour,
    /// What it says.
    pub text: String,
}

/// Which part of a line of text stands at its point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// Its left end.
    Start,
    /// Its middle.
    Middle,
    /// Its right end.
    End,
}

/// A spot of colour without an edge: an ellipse whose colour fades from its middle out to nothing at its rim, evenly.
#[derive(Debug, Clone, PartialEq)]
pub struct Glow {
    /// What it is; may be empty.
    pub name: String,
    /// Its middle.
    pub at: Point,
    /// How far it reaches to the side and down.
    pub radii: Vec2,
    /// Its colour in the middle.
    pub colour: Colour,
}

/// Several things moved or clipped together.
#[derive(Debug, Clone, PartialEq)]
pub struct Group {
    /// What it is; may be empty.
    pub name: String,
    /// How the inside is moved.
    pub transform: Affine,
    /// Only what falls inside is seen; in the group's own coordinates.
    pub clip: Option<BezPath>,
    /// Back to front.
    pub items: Vec<Item>,
}

impl Item {
    /// A named area.
    #[must_use]
    pub fn area(name: impl Into<String>, path: BezPath, colour: Colour) -> Self {
        Self::Area(Area { name: name.into(), path, colour })
    }

    /// A named line.
    #[must_use]
    pub fn ink(name: impl Into<String>, strokes: Vec<Ribbon>, colour: Colour) -> Self {
        Self::Ink(Ink { name: name.into(), strokes, colour })
    }

    /// A line of text.
    #[must_use]
    pub fn text(at: Point, size: f64, anchor: Anchor, colour: Colour, text: impl Into<String>) -> Self {
        Self::Text(Text { at, size, anchor, colour, text: text.into() })
    }

    /// A spot of colour that fades to nothing at its rim.
    #[must_use]
    pub fn glow(name: impl Into<String>, at: Point, radii: Vec2, colour: Colour) -> Self {
        Self::Glow(Glow { name: name.into(), at, radii, colour })
    }

    /// Things that many drawings have in common: cloning and comparing them costs next to nothing.
    #[must_use]
    pub fn shared(items: Vec<Self>) -> Self {
        Self::Shared(Shared::new(items))
    }

    /// Things seen only through `clip`.
    #[must_use]
    pub fn clipped(name: impl Into<String>, clip: BezPath, items: Vec<Self>) -> Self {
        Self::Group(Group { name: name.into(), transform: Affine::IDENTITY, clip: Some(clip), items })
    }

    /// Things moved together.
    #[must_use]
    pub fn moved(name: impl Into<String>, transform: Affine, items: Vec<Self>) -> Self {
        Self::Group(Group { name: name.into(), transform, clip: None, items })
    }
}

impl Drawing {
    /// The same drawing with every text put through `say`.
    #[must_use]
    pub fn with_texts(mut self, say: &dyn Fn(&str) -> String) -> Self {
        fn change(item: &mut Item, say: &dyn Fn(&str) -> String) {
            match item {
                Item::Text(text) => text.text = say(&text.text),
                Item::Group(group) => group.items.iter_mut().for_each(|item| change(item, say)),
                Item::Shared(shared) => {
                    let mut items = shared.items().to_vec();
                    items.iter_mut().for_each(|item| change(item, say));
                    *shared = Shared::new(items);
                }
                Item::Area(_) | Item::Ink(_) | Item::Glow(_) | Item::Picture(_) => {}
            }
        }
        self.layers.iter_mut().flat_map(|l| &mut l.items).for_each(|item| change(item, say));
        self
    }

    /// The drawing as one thing that fits into `frame` of another drawing, centred: how sheets are made.
    #[must_use]
    pub fn placed_in(&self, frame: Rect) -> Item {
        use crate::geometry::Shape;
        let items = self.layers.iter().flat_map(|layer| layer.items.iter().cloned()).collect();
        Item::Group(Group {
            name: String::new(),
            transform: fit(self.view, frame),
            clip: Some(self.view.to_path(0.1)),
            items,
        })
    }
}

/// The move and scale that brings `view` whole and centred into `frame`.
#[must_use]
pub(crate) fn fit(view: Rect, frame: Rect) -> Affine {
    let scale = (frame.width() / view.width()).min(frame.height() / view.height());
    Affine::translate(frame.center().to_vec2()) * Affine::scale(scale) * Affine::translate(-view.center().to_vec2())
}

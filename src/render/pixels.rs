//! A drawing as pixels. The picture is cut into tiles, and a tile whose things are those of before is not painted again:
//! a still face stays, and of a talking one only the mouth is new. Every pixel is the same as if all were painted.

use std::sync::Arc;

use super::canvas::{Area, Canvas, Pixel, pixel_of, straight};
use super::leaf::{Leaf, Part, leaves, print_of};
use super::paint::{Room, paint};
use super::print::{ByPrint, Print};
use super::prints::mark;
use super::tiles::Grid;
use super::{FontFile, MAX_SIDE};
use crate::disk::{Fault, FileFault, Result};
use crate::drawing::{Drawing, Item, Layer, Picture, fit};
use crate::geometry::{Affine, Rect};

/// Paints drawings of one size. Keeps its pixels from one drawing to the next.
pub struct Painter {
    width: u32,
    height: u32,
    grid: Grid,
    font: Option<FontFile>,
    room: Room,
    /// What was made ready for the last drawing.
    ready: Ready,
    still_print: Option<Print>,
    still_prints: Arc<[Print]>,
    /// The still layers alone.
    still: Sheet,
    whole: Sheet,
}

/// Things made ready, alone and those that drawings share.
#[derive(Default)]
struct Ready {
    alone: ByPrint<Arc<Leaf>>,
    shared: ByPrint<Arc<[Leaf]>>,
}

/// A canvas and what is on each of its tiles.
struct Sheet {
    canvas: Canvas,
    prints: Vec<Option<Print>>,
}

/// A drawing cut up: what is to be painted, and the print of every tile.
pub(super) struct Plan {
    background: Pixel,
    still: Vec<Part>,
    moving: Vec<Part>,
    /// The same of the still layers alone.
    pub(super) still_prints: Arc<[Print]>,
    pub(super) prints: Vec<Print>,
}

impl Plan {
    /// Whether no pixel lets through what is behind the picture.
    pub(super) fn is_opaque(&self) -> bool {
        self.background >> 24 == 255
    }
}

impl Sheet {
    fn new(grid: Grid, area: Area) -> Self {
        Self { canvas: Canvas::new(area), prints: vec![None; grid.len()] }
    }
}

impl Painter {
    /// A painter of pictures of this size.
    ///
    /// # Errors
    /// When a side is 0 or larger than [`MAX_SIDE`].
    pub fn new(width: u32, height: u32) -> Result<Self> {
        let fits = |side| (1..=MAX_SIDE).contains(&side);
        if !fits(width) || !fits(height) {
            return Err(Fault::of(FileFault::OutOfRange, format!("a picture cannot be {width} × {height} pixels"))
                .help(format!("give sides from 1 to {MAX_SIDE}")));
        }
        let area = Area::of_size(width, height);
        let grid = Grid::new(area);
        Ok(Self {
            width,
            height,
            grid,
            font: None,
            room: Room::default(),
            ready: Ready::default(),
            still_print: None,
            still_prints: Arc::new([]),
            still: Sheet::new(grid, area),
            whole: Sheet::new(grid, area),
        })
    }

    /// The same painter, with a font for what ours lacks.
    #[must_use]
    pub fn with_font(self, font: Option<FontFile>) -> Self {
        let area = self.whole.canvas.area();
        let (still, whole) = (Sheet::new(self.grid, area), Sheet::new(self.grid, area));
        Self { font, ready: Ready::default(), still_print: None, still, whole, ..self }
    }

    /// Paints one drawing.
    #[must_use]
    pub fn paint(&mut self, drawing: &Drawing) -> Picture {
        let opaque = self.update(drawing);
        let mut picture = self.empty();
        self.hand_out(&mut picture, Area::of_size(self.width, self.height), opaque);
        picture
    }

    /// A picture of this size without colour.
    pub(super) fn empty(&self) -> Picture {
        Picture::filled(self.width as usize, self.height as usize, [0; 4])
    }

    /// Copies some pixels to a picture of this size, as they are now.
    pub(super) fn hand_out(&self, picture: &mut Picture, part: Area, opaque: bool) {
        for y in part.y0..part.y1 {
            let row = &mut picture.row_mut(y as usize)[part.x0 as usize..part.x1 as usize];
            for (out, pixel) in row.iter_mut().zip(self.whole.canvas.row(y, part.x0, part.x1)) {
                let pixel = if opaque { *pixel } else { straight(*pixel) };
                *out = pixel.to_le_bytes();
            }
        }
    }

    /// Paints one drawing without handing it out. Returns whether no pixel lets through what is behind it.
    pub(crate) fn update(&mut self, drawing: &Drawing) -> bool {
        let plan = self.plan(drawing);
        self.refresh(&plan, |_| true);
        plan.is_opaque()
    }

    pub(super) fn grid(&self) -> Grid {
        self.grid
    }

    /// The pixels, premultiplied. Those of tiles that have not been asked for may be of an earlier drawing.
    pub(super) fn canvas(&self) -> &Canvas {
        &self.whole.canvas
    }

    /// Cuts a drawing up, without painting it.
    pub(super) fn plan(&mut self, drawing: &Drawing) -> Plan {
        let frame = Rect::new(0.0, 0.0, f64::from(self.width), f64::from(self.height));
        let place = fit(drawing.view, frame);
        let count = drawing.layers.iter().take_while(|l| l.name == "static").count();
        let (still, moving) = drawing.layers.split_at(count);
        let mut now = Ready::default();
        let still = self.parts(still, place, &mut now);
        let moving = self.parts(moving, place, &mut now);
        self.ready = now;

        let background = drawing.background.map_or(0, |c| pixel_of([c.r, c.g, c.b, c.a]));
        let mut still_print = Print::START;
        still_print.word(u64::from(background));
        for part in &still {
            still_print.print(match part {
                Part::One(leaf) => leaf.print,
                Part::Kept(print, _) => *print,
            });
        }
        if self.still_print != Some(still_print) {
            let mut prints = self.grid.filled(background);
            mark(self.grid, &mut prints, &still);
            self.still_prints = prints.into();
            self.still_print = Some(still_print);
        }
        let mut prints = self.still_prints.to_vec();
        mark(self.grid, &mut prints, &moving);
        Plan { background, still, moving, still_prints: Arc::clone(&self.still_prints), prints }
    }

    fn parts(&self, layers: &[Layer], place: Affine, now: &mut Ready) -> Vec<Part> {
        let mut parts = Vec::with_capacity(64);
        for item in layers.iter().flat_map(|l| &l.items) {
            self.part(item, place, now, &mut parts);
        }
        parts
    }

    fn part(&self, item: &Item, place: Affine, now: &mut Ready, parts: &mut Vec<Part>) {
        match item {
            Item::Shared(shared) => {
                let mut print = Print::START;
                print.numbers(&place.as_coeffs());
                print.word(shared.fingerprint());
                let ready = || {
                    let old = self.ready.shared.get(&print).cloned();
                    old.unwrap_or_else(|| leaves(shared.items(), place, self.font.as_ref()).into())
                };
                parts.push(Part::Kept(print, Arc::clone(now.shared.entry(print).or_insert_with(ready))));
            }
            Item::Group(group) if group.clip.is_none() => {
                let place = place * group.transform;
                group.items.iter().for_each(|item| self.part(item, place, now, parts));
            }
            _ => {
                let print = print_of(item, place);
                let ready = || match self.ready.alone.get(&print) {
                    Some(leaf) => Arc::clone(leaf),
                    None => Arc::new(Leaf::new(item, print, place, self.font.as_ref())),
                };
                parts.push(Part::One(Arc::clone(now.alone.entry(print).or_insert_with(ready))));
            }
        }
    }

    /// Brings those tiles up to date that `wanted` says. Returns what was painted.
    pub(super) fn refresh(&mut self, plan: &Plan, wanted: impl Fn(usize) -> bool) -> Vec<Area> {
        let Self { grid, room, still, whole, .. } = self;
        let blocks = grid.blocks(|i| wanted(i) && whole.prints[i] != Some(plan.prints[i]));
        // A block may hold a tile that is right already: it is painted again, to the same pixels.
        let inside = |blocks: &[Area], i: usize| blocks.iter().any(|b| !b.meet(grid.tile(i)).is_empty());
        let blocks_below = grid.blocks(|i| still.prints[i] != Some(plan.still_prints[i]) && inside(&blocks, i));
        for block in &blocks_below {
            still.canvas.fill(*block, plan.background);
            paint_parts(&mut still.canvas, &plan.still, *block, room);
        }
        for block in &blocks {
            whole.canvas.copy_from(&still.canvas, *block);
            paint_parts(&mut whole.canvas, &plan.moving, *block, room);
        }
        for i in 0..grid.len() {
            if inside(&blocks_below, i) {
                still.prints[i] = Some(plan.still_prints[i]);
            }
            if inside(&blocks, i) {
                whole.prints[i] = Some(plan.prints[i]);
            }
        }
        blocks
    }
}

fn paint_parts(canvas: &mut Canvas, parts: &[Part], within: Area, room: &mut Room) {
    for part in parts {
        match part {
            Part::One(leaf) => paint(canvas, leaf, within, room),
            Part::Kept(_, leaves) => leaves.iter().for_each(|leaf| paint(canvas, leaf, within, room)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::Colour;
    use crate::geometry::BezPath;
    use proptest::prelude::*;

    fn shapes(outlines: &[Vec<(i32, i32)>]) -> Drawing {
        let outline = |points: &Vec<(i32, i32)>| {
            let mut path = BezPath::new();
            let at = |p: &(i32, i32)| (8.0 * f64::from(p.0), 8.0 * f64::from(p.1));
            path.move_to(at(&points[0]));
            points[1..].iter().for_each(|p| path.line_to(at(p)));
            path
        };
        let colours = [Colour::BLACK, Colour::rgb(200, 30, 30), Colour::rgb(10, 10, 200).faded(0.5)];
        let items = outlines.iter().zip(colours).map(|(o, c)| Item::area("", outline(o), c)).collect();
        Drawing {
            view: Rect::new(0.0, 0.0, 200.0, 136.0),
            title: String::new(),
            description: String::new(),
            background: Some(Colour::WHITE),
            layers: vec![Layer { name: "dynamic".into(), items }],
        }
    }

    proptest! {
        /// Corners lie on borders of tiles and pixels often, and edges are level often.
        #[test]
        fn what_was_painted_before_leaves_nothing_behind(
            drawings in prop::collection::vec(
                prop::collection::vec(prop::collection::vec((-4..30_i32, -4..22_i32), 3..7), 1..4), 2..6),
        ) {
            let mut painter = Painter::new(200, 136).unwrap();
            for drawing in drawings.iter().map(|d| shapes(d)) {
                prop_assert!(painter.paint(&drawing) == Painter::new(200, 136).unwrap().paint(&drawing));
            }
        }
    }

    #[test]
    fn a_level_edge_through_a_tile_is_seen() {
        let mut painter = Painter::new(200, 136).unwrap();
        let _ = painter.paint(&shapes(&[vec![(0, 0), (25, 0), (25, 17), (0, 17)]]));
        let lower = painter.paint(&shapes(&[vec![(0, 9), (25, 9), (25, 17), (0, 17)]]));
        assert_eq!((lower[(100, 71)], lower[(100, 72)]), ([255; 4], [0, 0, 0, 255]));
    }
}

//! What becomes of every item of a figure over all frames: its states, and which of them it is in when.
//!
//! Items are told by their names and their order. What a group only moves, as a head does, keeps its states and has its
//! moves apart.

use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::Arc;

use super::mark::{Mark, are_near};
use crate::drawing::{Drawing, Item};
use crate::geometry::Affine;

/// In a frame where an item is not there.
pub(crate) const ABSENT: u32 = u32::MAX;

/// A turn and a shift, by which a part moves whole.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub(crate) struct Move {
    /// On the grid.
    pub x: i32,
    /// On the grid.
    pub y: i32,
    /// Thousandths of a degree, clockwise as seen, about the grid's origin, before the shift.
    pub turn: i32,
}

/// One item over all frames.
#[derive(Debug)]
pub(crate) struct Tracked {
    /// What the figure calls it.
    pub name: String,
    /// Its different looks, in the order they are first seen. A look may be of several marks, or of none.
    pub states: Vec<Arc<[Mark]>>,
    /// Which of them it has in each frame; [`ABSENT`] where it is not there.
    pub at: Vec<u32>,
    /// Which move of [`Survey::moves`] it has in each frame; [`ABSENT`] where it is not there.
    pub moved: Vec<u32>,
    /// Looks that were met, by a sum of theirs, and the state that each was taken for: the looks themselves would fill
    /// the memory over an hour.
    known: HashMap<u64, u32>,
    /// The item as it was last, the place of its group, and its state: most do not change from frame to frame.
    last: Option<(Item, Affine, u32)>,
}

/// All items over all frames, back to front.
#[derive(Debug)]
pub(crate) struct Survey {
    /// The items.
    pub items: Vec<Tracked>,
    /// The different moves; the first is none.
    pub moves: Vec<Move>,
    /// How many frames were taken in.
    pub frames: usize,
    known: HashMap<Move, u32>,
    named: HashMap<String, Vec<usize>>,
    /// Places of the items by their numbers, and numbers by their places.
    order: Vec<usize>,
    place: Vec<usize>,
    scale: f64,
    near: i32,
}

impl Survey {
    /// Nothing yet; `scale` is the grid's steps in a unit of the figure, and looks of an item within `near` steps of each
    /// other are one.
    pub(crate) fn new(scale: f64, near: i32) -> Self {
        Self {
            items: Vec::new(),
            moves: vec![Move::default()],
            frames: 0,
            known: HashMap::from([(Move::default(), 0)]),
            named: HashMap::new(),
            order: Vec::new(),
            place: Vec::new(),
            scale,
            near,
        }
    }

    /// Takes in the next frame.
    pub(crate) fn take(&mut self, drawing: &Drawing) {
        for tracked in &mut self.items {
            tracked.at.push(ABSENT);
            tracked.moved.push(ABSENT);
        }
        self.frames += 1;
        let mut next = 0;
        for layer in &drawing.layers {
            for item in &layer.items {
                self.walk(item, 0, Affine::IDENTITY, &mut next);
            }
        }
    }

    /// Takes in a frame that looks like the one before.
    pub(crate) fn repeat(&mut self) {
        for tracked in &mut self.items {
            let last = |list: &[u32]| list.last().copied().unwrap_or(ABSENT);
            let (at, moved) = (last(&tracked.at), last(&tracked.moved));
            tracked.at.push(at);
            tracked.moved.push(moved);
        }
        self.frames += 1;
    }

    /// The items, back to front, when all frames are in.
    pub(crate) fn done(mut self) -> (Vec<Tracked>, Vec<Move>) {
        let mut items: Vec<Option<Tracked>> = self.items.drain(..).map(Some).collect();
        (self.order.iter().filter_map(|id| items[*id].take()).collect(), self.moves)
    }

    /// `next` is the first place that the item may have in the order.
    fn walk(&mut self, item: &Item, moved: u32, place: Affine, next: &mut usize) {
        match item {
            Item::Shared(shared) => shared.items().iter().for_each(|item| self.walk(item, moved, place, next)),
            Item::Group(group) if group.clip.is_none() => {
                // One group may move what is in it; a move within a move is part of the look.
                let own = if moved == 0 && place == Affine::IDENTITY { self.rigid(group.transform) } else { None };
                let (moved, place) = match own {
                    Some(own) => (own, place),
                    None => (moved, place * group.transform),
                };
                group.items.iter().for_each(|item| self.walk(item, moved, place, next));
            }
            _ => {
                let id = self.number_of(name_of(item), *next);
                *next = self.place[id] + 1;
                let (scale, near) = (self.scale, self.near);
                let tracked = &mut self.items[id];
                let state = tracked.state_of(item, place, scale, near);
                if let (Some(at), Some(moves)) = (tracked.at.last_mut(), tracked.moved.last_mut()) {
                    (*at, *moves) = (state, moved);
                }
            }
        }
    }

    /// The item of that name at or behind a place of the order; a new one where there is none.
    fn number_of(&mut self, name: &str, next: usize) -> usize {
        let known = self.named.get(name).map(Vec::as_slice).unwrap_or_default();
        let behind = known.iter().copied().filter(|id| self.place[*id] >= next).min_by_key(|id| self.place[*id]);
        if let Some(id) = behind {
            return id;
        }
        let id = self.items.len();
        self.items.push(Tracked {
            name: name.to_owned(),
            states: Vec::new(),
            at: vec![ABSENT; self.frames],
            moved: vec![ABSENT; self.frames],
            known: HashMap::new(),
            last: None,
        });
        self.named.entry(name.to_owned()).or_default().push(id);
        self.order.insert(next, id);
        self.place.push(0);
        for (place, id) in self.order.iter().enumerate() {
            self.place[*id] = place;
        }
        id
    }

    /// The number of a move that neither scales nor bends.
    fn rigid(&mut self, affine: Affine) -> Option<u32> {
        const NEAR: f64 = 1e-6;
        let [a, b, c, d, e, f] = affine.as_coeffs();
        let is_rigid = (a - d).abs() < NEAR && (b + c).abs() < NEAR && (a.hypot(b) - 1.0).abs() < NEAR;
        if !is_rigid {
            return None;
        }
        let whole = |v: f64| v.round().clamp(-1e8, 1e8) as i32;
        let moved =
            Move { x: whole(e * self.scale), y: whole(f * self.scale), turn: whole(b.atan2(a).to_degrees() * 1000.0) };
        let moves = &mut self.moves;
        Some(*self.known.entry(moved).or_insert_with(|| {
            moves.push(moved);
            moves.len() as u32 - 1
        }))
    }
}

/// What the figure calls an item.
fn name_of(item: &Item) -> &str {
    match item {
        Item::Area(area) => &area.name,
        Item::Ink(ink) => &ink.name,
        Item::Glow(glow) => &glow.name,
        Item::Group(group) => &group.name,
        Item::Picture(raster) => &raster.name,
        Item::Text(_) | Item::Shared(_) => "",
    }
}

impl Tracked {
    fn state_of(&mut self, item: &Item, place: Affine, scale: f64, near: i32) -> u32 {
        if let Some((last, at, state)) = &self.last
            && *at == place
            && last == item
        {
            return *state;
        }
        let mut marks = Vec::with_capacity(1);
        Mark::of(item, Affine::scale(scale) * place, &mut marks);
        let mut sum = DefaultHasher::new();
        marks.hash(&mut sum);
        let sum = sum.finish();
        let is = |state: u32| self.states.get(state as usize).is_some_and(|old| are_near(old, &marks, near));
        // Sums of different looks may be the same, once in a very long while.
        let state = match self.known.get(&sum).copied().filter(|state| is(*state)) {
            Some(state) => state,
            None => {
                // The latest is the likeliest.
                let met = self.states.iter().rposition(|old| are_near(old, &marks, near));
                let state = met.unwrap_or(self.states.len()) as u32;
                self.known.insert(sum, state);
                if met.is_none() {
                    self.states.push(marks.into());
                }
                state
            }
        };
        self.last = Some((item.clone(), place, state));
        state
    }
}

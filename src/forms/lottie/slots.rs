//! The looks of an item side by side: its first outline over all keys, its second, and so on.

use super::keyed::keyed;
use super::ring::Ring;
use crate::drawing::Colour;
use crate::forms::parts::{ABSENT, Mark, OneItem};
use crate::geometry::{Affine, Point};
use crate::render::{text_outline, text_width};

/// What one mark of an item is in one of its looks.
#[derive(Default, Clone)]
pub(super) struct Slot {
    rings: Vec<Ring>,
    colour: Option<Colour>,
    /// Middle and radii, of a glow.
    glow: Option<([i32; 2], [i32; 2])>,
}

/// An item's shapes and its mask, as JSON.
pub(super) struct Slots {
    /// Back to front.
    pub marks: Vec<String>,
    /// What it is seen through.
    pub mask: Option<String>,
}

impl Slot {
    /// All looks of an item.
    pub(crate) fn of_item(item: &OneItem) -> Slots {
        let looks: Vec<(Vec<Self>, Option<Self>)> = item.states.iter().map(|marks| look(marks)).collect();
        let keys = keys_of(item);
        let count = looks.iter().map(|l| l.0.len()).max().unwrap_or(0);
        let none = Self::default();
        let marks = (0..count).map(|slot| {
            let own = |state: u32| looks.get(state as usize).and_then(|l| l.0.get(slot)).unwrap_or(&none);
            let is_glow = looks.iter().any(|l| l.0.get(slot).is_some_and(|s| s.glow.is_some()));
            if is_glow { glow(&keys, &own) } else { area(&keys, &own) }
        });
        let masked = looks.iter().any(|l| l.1.is_some());
        let mask = masked.then(|| {
            let own = |state: u32| looks.get(state as usize).and_then(|l| l.1.as_ref()).unwrap_or(&none);
            ring_keys(&keys, &own, 0)
        });
        Slots { marks: marks.collect(), mask }
    }
}

/// The marks of a look, and the clip they are seen through. A clip within a clip is not known to players: what is in it
/// is seen through the outer one alone.
fn look(marks: &[Mark]) -> (Vec<Slot>, Option<Slot>) {
    match marks {
        [Mark::Clip { path, inside }] => {
            let mut slots = Vec::new();
            inside.iter().for_each(|mark| add(mark, &mut slots));
            (slots, Some(Slot { rings: Ring::of_path(path), ..Slot::default() }))
        }
        marks => {
            let mut slots = Vec::new();
            marks.iter().for_each(|mark| add(mark, &mut slots));
            (slots, None)
        }
    }
}

fn add(mark: &Mark, slots: &mut Vec<Slot>) {
    match mark {
        Mark::Path { path, colour } => {
            slots.push(Slot { rings: Ring::of_path(path), colour: Some(*colour), glow: None });
        }
        Mark::Glow { at, radii, colour } => {
            slots.push(Slot { rings: Vec::new(), colour: Some(*colour), glow: Some((*at, *radii)) });
        }
        Mark::Text { at, size, anchor, colour, text } => {
            let size = f64::from(*size);
            let back = text_width(text, size, None) * f64::from(*anchor) / 2.0;
            let place = Affine::translate(Point::new(f64::from(at[0]) - back, f64::from(at[1])).to_vec2());
            if let Some(path) = crate::forms::parts::Path::of(&text_outline(text, size, None), place) {
                slots.push(Slot { rings: Ring::of_path(&path), colour: Some(*colour), glow: None });
            }
        }
        Mark::Clip { inside, .. } => inside.iter().for_each(|mark| add(mark, slots)),
        Mark::Picture { .. } => {}
    }
}

/// From which pose on an item is in which state.
fn keys_of(item: &OneItem) -> Vec<(u32, u32)> {
    let mut keys: Vec<(u32, u32)> = Vec::new();
    for (pose, state) in item.at.iter().enumerate() {
        if keys.last().is_none_or(|(_, last)| last != state) {
            keys.push((pose as u32, *state));
        }
    }
    keys
}

/// What of a slot changes from key to key. Where the item is not there it keeps what it was, and is seen through.
fn property<'a>(
    keys: &[(u32, u32)],
    own: &dyn Fn(u32) -> &'a Slot,
    value: &dyn Fn(&Slot) -> Option<String>,
) -> Vec<(u32, String)> {
    let mut all: Vec<(u32, Option<String>)> =
        keys.iter().map(|(frame, state)| (*frame, if *state == ABSENT { None } else { value(own(*state)) })).collect();
    let mut last = all.iter().find_map(|(_, v)| v.clone());
    for (_, value) in &mut all {
        match value {
            Some(value) => last = Some(value.clone()),
            None => value.clone_from(&last),
        }
    }
    all.into_iter().filter_map(|(frame, value)| Some((frame, value?))).collect()
}

/// The keys of one ring of a slot, all with the same number of points.
fn ring_keys<'a>(keys: &[(u32, u32)], own: &dyn Fn(u32) -> &'a Slot, ring: usize) -> String {
    let of = |slot: &Slot| slot.rings.get(ring).map(Ring::len);
    let count = keys.iter().filter(|k| k.1 != ABSENT).filter_map(|k| of(own(k.1))).max().unwrap_or(1);
    // A ring that a look does not have is a point.
    let value = |slot: &Slot| {
        let ring = slot.rings.get(ring).cloned().unwrap_or_default();
        Some(format!("[{}]", ring.json(count)))
    };
    keyed(&property(keys, own, &value))
}

fn opacity<'a>(keys: &[(u32, u32)], own: &dyn Fn(u32) -> &'a Slot) -> String {
    let value = |state: u32| {
        let alpha = if state == ABSENT { 0 } else { own(state).colour.map_or(0, |c| c.a) };
        format!("[{}]", (f64::from(alpha) / 2.55 * 100.0).round() / 100.0)
    };
    keyed(&keys.iter().map(|(frame, state)| (*frame, value(*state))).collect::<Vec<_>>())
}

fn channels(colour: Colour) -> String {
    // Some players cut what is behind the point of 255 times this.
    let share = |v: u8| (f64::from(v) / 255.0 * 1e4).ceil() / 1e4;
    format!("{},{},{}", share(colour.r), share(colour.g), share(colour.b))
}

fn area<'a>(keys: &[(u32, u32)], own: &dyn Fn(u32) -> &'a Slot) -> String {
    let rings = keys.iter().filter(|k| k.1 != ABSENT).map(|k| own(k.1).rings.len()).max().unwrap_or(0);
    let mut items: Vec<String> =
        (0..rings).map(|ring| format!("{{\"ty\":\"sh\",\"ks\":{}}}", ring_keys(keys, own, ring))).collect();
    let colour = keyed(&property(keys, own, &|slot| slot.colour.map(|c| format!("[{},1]", channels(c)))));
    items.push(format!("{{\"ty\":\"fl\",\"r\":1,\"c\":{colour},\"o\":{}}}", opacity(keys, own)));
    group(&items, "{\"a\":0,\"k\":[0,0]}", "{\"a\":0,\"k\":[100,100]}")
}

/// A circle of a thousand steps, placed and stretched, with a gradient from its middle to its rim.
fn glow<'a>(keys: &[(u32, u32)], own: &dyn Fn(u32) -> &'a Slot) -> String {
    let gradient = property(keys, own, &|slot| slot.colour.map(|c| format!("[0,{0},1,{0},0,1,1,0]", channels(c))));
    let items = [
        "{\"ty\":\"el\",\"p\":{\"a\":0,\"k\":[0,0]},\"s\":{\"a\":0,\"k\":[2000,2000]}}".to_owned(),
        format!(
            "{{\"ty\":\"gf\",\"t\":2,\"r\":1,\"s\":{{\"a\":0,\"k\":[0,0]}},\"e\":{{\"a\":0,\"k\":[1000,0]}},\"g\":{{\"p\":2,\"k\":{}}},\"o\":{}}}",
            keyed(&gradient),
            opacity(keys, own)
        ),
    ];
    let place = property(keys, own, &|slot| slot.glow.map(|(at, _)| format!("[{},{}]", at[0], at[1])));
    let size = property(keys, own, &|slot| {
        slot.glow.map(|(_, r)| format!("[{},{}]", f64::from(r[0]) / 10.0, f64::from(r[1]) / 10.0))
    });
    group(&items, &keyed(&place), &keyed(&size))
}

fn group(items: &[String], place: &str, size: &str) -> String {
    format!(
        "{{\"ty\":\"gr\",\"it\":[{},{{\"ty\":\"tr\",\"p\":{place},\"a\":{{\"a\":0,\"k\":[0,0]}},\"s\":{size},\"r\":{{\"a\":0,\"k\":0}},\"o\":{{\"a\":0,\"k\":100}}}}]}}",
        items.join(",")
    )
}

//! A clip as a Lottie animation: a layer an item, whose outlines are held from one key to the next.
//!
//! Every frame looks as it does elsewhere: nothing is left to the player to interpolate. Outlines of one shape have one
//! number of points over all keys, as players want it; those with fewer repeat their last point, which draws nothing.

mod ring;
mod slots;

use std::fmt::Write;

use super::base64::data_uri_of;
use crate::drawing::Colour;
use crate::export::parts::{ABSENT, Grid, Mark, Move, Tracked};
use slots::Slot;

/// Looks of an item within so many steps of the grid are one: a quarter of a pixel, and half as many keys.
pub(super) const ONE_LOOK: i32 = 2;

/// What is drawn.
pub(super) struct Film<'a> {
    /// What it is called.
    pub title: &'a str,
    /// Where the grid lies.
    pub grid: Grid,
    /// Frames a second.
    pub fps: f64,
    /// What lies behind everything; none is transparent.
    pub background: Option<Colour>,
    /// Back to front.
    pub items: &'a [Tracked],
    /// What moves are.
    pub moves: &'a [Move],
    /// How many frames there are.
    pub frames: usize,
}

/// The animation as JSON.
pub(super) fn lottie(film: &Film<'_>) -> String {
    let [width, height] = film.grid.size;
    let mut layers = Vec::new();
    let mut assets = Vec::new();
    if let Some(colour) = film.background {
        layers.push(format!(
            "\"ty\":1,\"nm\":\"ground\",\"sw\":{width},\"sh\":{height},\"sc\":\"{}\",\"ks\":{{\"o\":{{\"a\":0,\"k\":100}},\"r\":{{\"a\":0,\"k\":0}},\"p\":{{\"a\":0,\"k\":[0,0,0]}},\"a\":{{\"a\":0,\"k\":[0,0,0]}},\"s\":{{\"a\":0,\"k\":[100,100,100]}}}}",
            colour.hex()
        ));
    }
    for item in film.items {
        layers.extend(layer(item, film, &mut assets));
    }
    let count = layers.len();
    // The first layer of the file lies on top.
    let layers: Vec<String> = layers
        .iter()
        .rev()
        .enumerate()
        .map(|(i, body)| {
            let number = count - i;
            format!("{{\"ddd\":0,\"ind\":{number},\"ip\":0,\"op\":{},\"st\":0,\"sr\":1,\"bm\":0,{body}}}", film.frames)
        })
        .collect();
    format!(
        "{{\"v\":\"5.7.0\",\"nm\":{},\"fr\":{},\"ip\":0,\"op\":{},\"w\":{width},\"h\":{height},\"ddd\":0,\"assets\":[{}],\"layers\":[\n{}\n]}}\n",
        quoted(film.title),
        film.fps,
        film.frames,
        assets.join(","),
        layers.join(",\n")
    )
}

fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

/// The layer of an item; none where it draws nothing.
fn layer(item: &Tracked, film: &Film<'_>, assets: &mut Vec<String>) -> Option<String> {
    if let Some([Mark::Picture { pixels, place }]) = item.states.first().map(|s| &**s) {
        let id = assets.len();
        assets.push(format!(
            "{{\"id\":\"i{id}\",\"w\":{},\"h\":{},\"u\":\"\",\"e\":1,\"p\":\"{}\"}}",
            pixels.0.width(),
            pixels.0.height(),
            data_uri_of(&pixels.0)
        ));
        let [a, b, c, d, e, f] = place.map(|v| v as f64 / 1e5 / 8.0);
        let at = [e + film.grid.origin[0], f + film.grid.origin[1]];
        let (scale, turn) = ([a.hypot(b) * 100.0, c.hypot(d) * 100.0], b.atan2(a).to_degrees());
        return Some(format!(
            "\"ty\":2,\"nm\":{},\"refId\":\"i{id}\",\"ks\":{{\"p\":{{\"a\":0,\"k\":[{},{},0]}},\"s\":{{\"a\":0,\"k\":[{},{},100]}},\"r\":{{\"a\":0,\"k\":{turn}}}}}",
            quoted(&item.name),
            at[0],
            at[1],
            scale[0],
            scale[1]
        ));
    }
    let slots = Slot::of_item(item);
    if slots.marks.is_empty() {
        return None;
    }
    let mut text = format!("\"ty\":4,\"nm\":{},\"ks\":{}", quoted(&item.name), placed(item, film));
    if let Some(mask) = &slots.mask {
        let _ = write!(
            text,
            ",\"hasMask\":true,\"masksProperties\":[{{\"inv\":false,\"mode\":\"a\",\"o\":{{\"a\":0,\"k\":100}},\"x\":{{\"a\":0,\"k\":0}},\"pt\":{mask}}}]"
        );
    }
    // The first shape lies on top here too.
    let shapes: Vec<&str> = slots.marks.iter().rev().map(String::as_str).collect();
    let _ = write!(text, ",\"shapes\":[{}]", shapes.join(","));
    Some(text)
}

/// Where a layer is: an eighth of the grid's size, at its origin, moved as the item is.
fn placed(item: &Tracked, film: &Film<'_>) -> String {
    let mut keys: Vec<(u32, Move)> = Vec::new();
    for (frame, moved) in item.moved.iter().enumerate() {
        let Some(moved) = film.moves.get(*moved as usize).filter(|_| *moved != ABSENT) else { continue };
        match keys.last() {
            None => keys.push((0, *moved)),
            Some((_, last)) if last != moved => keys.push((frame as u32, *moved)),
            Some(_) => {}
        }
    }
    let [x, y] = film.grid.origin;
    let short = |v: f64| (v * 1e4).round() / 1e4;
    let at = |m: &Move| format!("[{},{},0]", short(x + f64::from(m.x) / 8.0), short(y + f64::from(m.y) / 8.0));
    let turn = |m: &Move| format!("[{}]", f64::from(m.turn) / 1000.0);
    let place = keyed(&keys.iter().map(|(t, m)| (*t, at(m))).collect::<Vec<_>>());
    let turn = keyed(&keys.iter().map(|(t, m)| (*t, turn(m))).collect::<Vec<_>>());
    format!(
        "{{\"o\":{{\"a\":0,\"k\":100}},\"a\":{{\"a\":0,\"k\":[0,0,0]}},\"p\":{place},\"r\":{turn},\"s\":{{\"a\":0,\"k\":[12.5,12.5,100]}}}}"
    )
}

/// A property whose values, each an array in JSON, are held from key to key; keys that change nothing are left out.
fn keyed(keys: &[(u32, String)]) -> String {
    let mut text = String::new();
    let mut last: Option<&str> = None;
    let mut count = 0;
    for (frame, value) in keys {
        if last != Some(value.as_str()) {
            let _ = write!(text, "{}{{\"t\":{frame},\"h\":1,\"s\":{value}}}", if count > 0 { "," } else { "" });
            (last, count) = (Some(value.as_str()), count + 1);
        }
    }
    match (count, last) {
        (0, _) | (_, None) => "{\"a\":0,\"k\":0}".to_owned(),
        (1, Some(value)) => format!("{{\"a\":0,\"k\":{}}}", alone(value)),
        _ => format!("{{\"a\":1,\"k\":[{text}]}}"),
    }
}

/// A value that never changes: a shape and a single number stand for themselves, not in an array.
fn alone(value: &str) -> &str {
    let inner = value.strip_prefix('[').and_then(|v| v.strip_suffix(']')).unwrap_or(value);
    if inner.starts_with('{') || !inner.contains(',') { inner } else { value }
}

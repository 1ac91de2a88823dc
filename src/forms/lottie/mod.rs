//! A clip as a Lottie animation: a composition a part, in which each of its poses has a frame, and the times of the clip
//! lead into it (`tm`, time remapping). An item is a layer, whose outlines are held from one key to the next.
//!
//! Every frame looks as it does elsewhere: nothing is left to the player to interpolate. Outlines of one shape have one
//! number of points over all keys, as players want it; those with fewer repeat their last point, which draws nothing.

mod keyed;
mod ring;
mod slots;

use std::fmt::Write;

use super::base64::data_uri_of;
use crate::forms::parts::{Mark, Move, OneItem, Part, Parts, Sheet};
use keyed::keyed;
use slots::Slot;

/// What layers refer to, in JSON.
#[derive(Default)]
struct Film {
    assets: Vec<String>,
}

/// The animation as JSON.
pub(crate) fn lottie(parts: &Parts, title: &str) -> String {
    let [width, height] = parts.grid.size;
    let mut film = Film::default();
    let mut layers = Vec::new();
    if let Some(colour) = parts.background {
        layers.push(format!(
            "\"ty\":1,\"nm\":\"ground\",\"sw\":{width},\"sh\":{height},\"sc\":\"{}\",\"ks\":{{\"o\":{{\"a\":0,\"k\":100}},\"r\":{{\"a\":0,\"k\":0}},\"p\":{{\"a\":0,\"k\":[0,0,0]}},\"a\":{{\"a\":0,\"k\":[0,0,0]}},\"s\":{{\"a\":0,\"k\":[100,100,100]}}}}",
            colour.hex()
        ));
    }
    for sheet in &parts.sheets {
        for part in &sheet.parts {
            if part.is_still() && !is_moved(sheet) {
                layers.extend(part.items.iter().filter_map(|item| film.layer(item, parts.grid.origin)));
            } else {
                layers.push(film.part(part, sheet, parts));
            }
        }
    }
    format!(
        "{{\"v\":\"5.7.0\",\"nm\":{},\"fr\":{},\"ip\":0,\"op\":{},\"w\":{width},\"h\":{height},\"ddd\":0,\"assets\":[{}],\"layers\":[\n{}\n]}}\n",
        quoted(title),
        parts.fps,
        parts.frames,
        film.assets.join(",\n"),
        stacked(&layers, parts.frames)
    )
}

/// Layers in a file's order: the first lies on top.
fn stacked(layers: &[String], frames: u32) -> String {
    let one = |(i, body): (usize, &String)| {
        let number = layers.len() - i;
        format!("{{\"ddd\":0,\"ind\":{number},\"ip\":0,\"op\":{frames},\"st\":0,\"sr\":1,\"bm\":0,{body}}}")
    };
    layers.iter().rev().enumerate().map(one).collect::<Vec<_>>().join(",\n")
}

fn is_moved(sheet: &Sheet) -> bool {
    sheet.moves.iter().any(|m| m.1 != Move::default())
}

fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

impl Film {
    /// The layer of a part that changes; its composition goes to the assets.
    fn part(&mut self, part: &Part, sheet: &Sheet, parts: &Parts) -> String {
        let count = part.poses.len() as u32;
        // What is moved must not be cut where the picture ends before it is.
        let room = if is_moved(sheet) { parts.grid.size[0].max(parts.grid.size[1]) } else { 0 };
        let [width, height] = parts.grid.size.map(|side| side + 2 * room);
        let origin = parts.grid.origin.map(|v| v + f64::from(room));
        let layers: Vec<String> = part.items.iter().filter_map(|item| self.layer(item, origin)).collect();
        let id = self.assets.len();
        self.assets.push(format!(
            "{{\"id\":\"p{id}\",\"nm\":{},\"fr\":{},\"layers\":[\n{}\n]}}",
            quoted(&part.name),
            parts.fps,
            stacked(&layers, count)
        ));
        // The middle of a pose's frame, in seconds: no rounding leads to the one beside it.
        let time = |pose: u32| (f64::from(2 * pose + 1) / (2.0 * parts.fps) * 1e5).round() / 1e5;
        let times: Vec<(u32, String)> =
            part.runs.iter().map(|(frame, pose)| (*frame, format!("[{}]", time(*pose)))).collect();
        format!(
            "\"ty\":0,\"nm\":{},\"refId\":\"p{id}\",\"w\":{width},\"h\":{height},\"ks\":{},\"tm\":{}",
            quoted(&part.name),
            placed(&sheet.moves, parts.grid.origin, origin, 100.0),
            keyed(&times)
        )
    }

    /// The layer of an item, the grid's origin at some pixels; none where it draws nothing.
    fn layer(&mut self, item: &OneItem, origin: [f64; 2]) -> Option<String> {
        if let Some([Mark::Picture { pixels, place }]) = item.states.first().map(|s| &**s) {
            let id = self.assets.len();
            self.assets.push(format!(
                "{{\"id\":\"i{id}\",\"w\":{},\"h\":{},\"u\":\"\",\"e\":1,\"p\":\"{}\"}}",
                pixels.0.picture().width(),
                pixels.0.picture().height(),
                data_uri_of(&pixels.0)
            ));
            let [a, b, c, d, e, f] = place.map(|v| v as f64 / 1e5 / 8.0);
            let at = [e + origin[0], f + origin[1]];
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
        let place = placed(&[(0, Move::default())], origin, [0.0; 2], 12.5);
        let mut text = format!("\"ty\":4,\"nm\":{},\"ks\":{place}", quoted(&item.name));
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
}

fn short(v: f64) -> f64 {
    (v * 1e4).round() / 1e4
}

/// Where a layer is: at so many per cent of its size, its anchor at the origin, moved from frame to frame about it.
fn placed(moves: &[(u32, Move)], origin: [f64; 2], anchor: [f64; 2], percent: f64) -> String {
    let [x, y] = origin;
    let at = |m: &Move| format!("[{},{},0]", short(x + f64::from(m.x) / 8.0), short(y + f64::from(m.y) / 8.0));
    let turn = |m: &Move| format!("[{}]", f64::from(m.turn) / 1000.0);
    let place = keyed(&moves.iter().map(|(t, m)| (*t, at(m))).collect::<Vec<_>>());
    let turn = keyed(&moves.iter().map(|(t, m)| (*t, turn(m))).collect::<Vec<_>>());
    format!(
        "{{\"o\":{{\"a\":0,\"k\":100}},\"a\":{{\"a\":0,\"k\":[{},{},0]}},\"p\":{place},\"r\":{turn},\"s\":{{\"a\":0,\"k\":[{percent},{percent},100]}}}}",
        short(anchor[0]),
        short(anchor[1])
    )
}

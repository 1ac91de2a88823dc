//! Parts as few bytes: what poses are made of once, and their numbers as differences from pose to pose, deflated. The
//! page's script takes them apart again.
//!
//! The numbers, in order: for every sheet the count of its moves and for each the frames since the one before and the
//! changes of x, y and turn; for every part of it the count of its poses, for each the number of what it is made of
//! and its values less those of the last pose made of the same; then the count of its runs, for each the frames since the
//! one before and the change of the pose's number. All are varints of seven bits, low first, after a zigzag. The values of
//! a mark are its alpha, then its points, each from the one before.

use serde_json::{Value, json};

use super::base64::{base64, data_uri_of};
use crate::forms::parts::{Mark, Part, Parts, Path};

/// The parts as a JSON value for the page.
pub(crate) fn packed(parts: &Parts) -> Value {
    let mut bytes = Vec::new();
    let mut sheets = Vec::new();
    for sheet in &parts.sheets {
        number(&mut bytes, sheet.moves.len() as i64);
        let mut last = [0_i64; 4];
        for (frame, m) in &sheet.moves {
            let now = [i64::from(*frame), m.x.into(), m.y.into(), m.turn.into()];
            now.iter().zip(last).for_each(|(a, b)| number(&mut bytes, a - b));
            last = now;
        }
        let own: Vec<Value> = sheet.parts.iter().map(|part| pack(part, &mut bytes)).collect();
        sheets.push(json!(own));
    }
    let deflated = miniz_oxide::deflate::compress_to_vec(&bytes, 9);
    json!({
        "size": parts.grid.size,
        "origin": parts.grid.origin.map(|v| (v * 1e4).round() / 1e4),
        "ground": parts.background.map(|c| c.to_string()),
        "fps": parts.fps,
        "frames": parts.frames,
        "mouth": parts.mouth,
        "sheets": sheets,
        "bytes": base64(&deflated),
    })
}

/// A part's name and what its poses are made of; their numbers go to `bytes`.
fn pack(part: &Part, bytes: &mut Vec<u8>) -> Value {
    let mut kinds: Vec<(String, Value, Vec<i64>)> = Vec::new();
    number(bytes, part.poses.len() as i64);
    for pose in 0..part.poses.len() as u32 {
        let mut values = Vec::new();
        let made = json!(part.marks(pose).map(|mark| made_of(mark, &mut values)).collect::<Vec<_>>());
        let key = made.to_string();
        let kind = kinds.iter().position(|(k, ..)| *k == key).unwrap_or(kinds.len());
        if kind == kinds.len() {
            kinds.push((key, made, vec![0; values.len()]));
        }
        number(bytes, kind as i64);
        if let Some((_, _, last)) = kinds.get_mut(kind) {
            values.iter().zip(last.iter()).for_each(|(a, b)| number(bytes, a - b));
            *last = values;
        }
    }
    number(bytes, part.runs.len() as i64);
    let mut last = (0, 0);
    for (frame, pose) in &part.runs {
        let now = (i64::from(*frame), i64::from(*pose));
        number(bytes, now.0 - last.0);
        number(bytes, now.1 - last.1);
        last = now;
    }
    json!({ "name": part.name, "kinds": kinds.into_iter().map(|k| k.1).collect::<Vec<_>>() })
}

/// What a mark is made of, without its numbers.
fn made_of(mark: &Mark, values: &mut Vec<i64>) -> Value {
    match mark {
        Mark::Path { path, colour } => {
            values.push(colour.a.into());
            json!([0, colour.hex(), verbs(path, values)])
        }
        Mark::Glow { at, radii, colour } => {
            values.push(colour.a.into());
            values.extend([at[0], at[1], radii[0], radii[1]].map(i64::from));
            json!([1, colour.hex()])
        }
        Mark::Text { at, size, anchor, colour, text } => {
            values.push(colour.a.into());
            values.extend([at[0], at[1], *size].map(i64::from));
            let anchor = ["start", "center", "end"][usize::from(*anchor).min(2)];
            json!([2, colour.hex(), anchor, text])
        }
        Mark::Picture { pixels, place } => {
            json!([3, data_uri_of(&pixels.0), place.map(|v| v as f64 / 1e5)])
        }
        Mark::Clip { path, inside } => {
            let clip = verbs(path, values);
            json!([4, clip, inside.iter().map(|mark| made_of(mark, values)).collect::<Vec<_>>()])
        }
    }
}

fn verbs(path: &Path, values: &mut Vec<i64>) -> String {
    let mut last = [0, 0];
    for point in &path.points {
        values.extend([i64::from(point[0] - last[0]), i64::from(point[1] - last[1])]);
        last = *point;
    }
    path.verbs.iter().map(|v| char::from(*v)).collect()
}

fn number(bytes: &mut Vec<u8>, value: i64) {
    let mut rest = ((value << 1) ^ (value >> 63)) as u64;
    while rest > 0x7F {
        bytes.push(rest as u8 | 0x80);
        rest >>= 7;
    }
    bytes.push(rest as u8);
}

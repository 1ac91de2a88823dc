//! JSON of mediapipe's face landmarker, in the forms that people write it: its results one by one in an array, an array
//! under some name, or a result a line.

use serde_json::Value;

use super::arkit::in_seconds;
use super::blendshapes::plain;
use super::frame::Seen;
use crate::disk::{Fault, FileFault, Result};
use crate::geometry::Point;
use crate::pose::Head;

/// Centimetres between the pupils of mediapipe's canonical face.
const PUPILS: f64 = 6.3;
/// Frames a second where the results say no time.
const FPS: f64 = 30.0;

const SHAPES: [&str; 4] = ["faceBlendshapes", "face_blendshapes", "blendshapes", "blendShapes"];
const POINTS: [&str; 5] =
    ["faceLandmarks", "face_landmarks", "landmarks", "multi_face_landmarks", "multiFaceLandmarks"];
const MATRICES: [&str; 3] = ["facialTransformationMatrixes", "facial_transformation_matrixes", "transformMatrix"];
const MILLISECONDS: [&str; 2] = ["timestamp_ms", "timestampMs"];
const TIMES: [&str; 4] = ["timestamp", "time", "t", "seconds"];

/// Whether a JSON text is such results rather than a record of ours.
pub(super) fn is_likely(head: &str) -> bool {
    SHAPES.iter().chain(&POINTS).any(|key| head.contains(&format!("\"{key}\"")))
}

/// Frames of results. Results without a face are lost frames.
pub(super) fn read(text: &str) -> Result<Vec<Seen>> {
    let results = results(text)?;
    let mut frames = Vec::with_capacity(results.len());
    let mut times = Vec::with_capacity(results.len());
    for (index, result) in results.iter().enumerate() {
        let seen = seen(result).ok_or_else(|| {
            let what = format!("result {}: it has neither blendshapes nor landmarks", index + 1);
            Fault::new(what).help("write what the face landmarker gives, `faceBlendshapes` or `faceLandmarks`")
        })?;
        let number = |keys: &[&str]| keys.iter().find_map(|k| result.get(*k)).and_then(Value::as_f64);
        times.push(number(&MILLISECONDS).map(|t| t / 1e3).or_else(|| number(&TIMES)));
        frames.push(seen);
    }
    let said: Option<Vec<f64>> = times.into_iter().collect();
    let times = match said {
        // Milliseconds were divided already: what is left large is another's milliseconds.
        Some(times) => in_seconds(times),
        None => (0..frames.len()).map(|i| i as f64 / FPS).collect(),
    };
    let mut kept: Vec<Seen> = Vec::with_capacity(frames.len());
    for (mut frame, time) in frames.into_iter().zip(times) {
        if kept.last().is_none_or(|f| time - f.time > 1e-6) {
            (frame.frame, frame.time) = (kept.len() as u32, time);
            kept.push(frame);
        }
    }
    Ok(kept)
}

/// The results, one by one.
fn results(text: &str) -> Result<Vec<Value>> {
    let is_result = |v: &Value| SHAPES.iter().chain(&POINTS).any(|k| v.get(*k).is_some());
    let fault = |error: &serde_json::Error| {
        Fault::new(format!("no JSON that can be read: {error}")).line(error.line()).help("was it written to the end?")
    };
    let whole = match serde_json::from_str::<Value>(text) {
        Ok(whole) => whole,
        // A result a line; the last may be cut.
        Err(error) => {
            let lines: Vec<&str> = text.lines().filter(|l| !l.trim().is_empty()).collect();
            let mut list = Vec::with_capacity(lines.len());
            for (index, line) in lines.iter().enumerate() {
                match serde_json::from_str(line) {
                    Ok(value) => list.push(value),
                    Err(_) if index > 0 && index + 1 == lines.len() => {}
                    Err(_) => return Err(fault(&error)),
                }
            }
            Value::Array(list)
        }
    };
    match whole {
        Value::Array(list) if !list.is_empty() => Ok(list),
        Value::Object(map) => {
            let whole = Value::Object(map.clone());
            if let Some(list) = map.into_iter().find_map(|(_, v)| match v {
                Value::Array(list) if list.first().is_some_and(is_result) => Some(list),
                _ => None,
            }) {
                return Ok(list);
            }
            Ok(vec![whole])
        }
        _ => Err(Fault::of(FileFault::Empty, "the file has no results")
            .help("write what the face landmarker gives for each frame")),
    }
}

/// What one result has of the first face; none where it is no result.
fn seen(result: &Value) -> Option<Seen> {
    let get = |keys: &[&str]| keys.iter().find_map(|k| result.get(*k));
    let (shapes, points) = (get(&SHAPES), get(&POINTS));
    if shapes.is_none() && points.is_none() {
        return None;
    }
    let mut seen = Seen::default();
    if let Some(shapes) = shapes {
        add_shapes(&mut seen, shapes);
    }
    if let Some(points) = points {
        add_points(&mut seen.points, points, 0);
    }
    seen.head = get(&MATRICES).and_then(head);
    seen.confidence = if seen.shapes.is_empty() && seen.points.is_empty() { 0.0 } else { 1.0 };
    Some(seen)
}

/// Blendshapes as a map, as a list of name and score, or as a list of faces of these.
fn add_shapes(seen: &mut Seen, value: &Value) {
    match value {
        Value::Object(map) => {
            if let Some(inner) = map.get("categories") {
                return add_shapes(seen, inner);
            }
            for (name, score) in map {
                if let Some(score) = score.as_f64() {
                    seen.shapes.insert(plain(name), score.clamp(0.0, 1.0));
                }
            }
        }
        Value::Array(list) => {
            for entry in list {
                let name = ["categoryName", "category_name", "name", "displayName"]
                    .iter()
                    .find_map(|k| entry.get(*k)?.as_str());
                let score = ["score", "value"].iter().find_map(|k| entry.get(*k)?.as_f64());
                match name.zip(score) {
                    Some((name, score)) => {
                        seen.shapes.insert(plain(name), score.clamp(0.0, 1.0));
                    }
                    // A list of faces: the first counts.
                    None => {
                        if list.first() == Some(entry) {
                            add_shapes(seen, entry);
                        }
                        return;
                    }
                }
            }
        }
        _ => {}
    }
}

/// Points as a list of {x, y} or [x, y], or a list of faces of these.
fn add_points(points: &mut Vec<Point>, value: &Value, deep: usize) {
    if let Some(inner) = value.get("landmark").or_else(|| value.get("landmarks")) {
        return add_points(points, inner, deep + 1);
    }
    let Value::Array(list) = value else { return };
    for entry in list {
        let pair = |x: Option<&Value>, y: Option<&Value>| Some(Point::new(x?.as_f64()?, y?.as_f64()?));
        let point = match entry {
            Value::Object(map) => pair(map.get("x"), map.get("y")),
            Value::Array(cells) => pair(cells.first(), cells.get(1)),
            _ => None,
        };
        match point.filter(|p| p.is_finite()) {
            Some(point) => points.push(point),
            None if points.is_empty() && deep < 3 => return add_points(points, entry, deep + 1),
            None => return,
        }
    }
}

/// The head's place from a 4 × 4 matrix by columns, whose y is up.
fn head(value: &Value) -> Option<Head> {
    let list = value.as_array()?;
    let first = list.first()?;
    let inner = first.get("data").or(if first.is_array() { Some(first) } else { None });
    let cells = inner.and_then(Value::as_array).unwrap_or(list);
    let cells: Option<Vec<f64>> = if cells.first()?.is_array() {
        // By rows, as Python prints it: brought to columns.
        (0..16).map(|i| cells.get(i % 4)?.get(i / 4)?.as_f64()).collect()
    } else {
        cells.iter().map(Value::as_f64).collect()
    };
    let m = cells.filter(|m| m.len() == 16)?;
    Some(Head { x: m[12] / PUPILS, y: -m[13] / PUPILS, roll: -m[1].atan2(m[0]).to_degrees() })
}

//! The CSV of OpenFace: 68 points, action units, gaze and the head's place.

use super::blendshapes::UNITS;
use super::csv;
use super::frame::Seen;
use crate::disk::{Fault, FileFault, Result};
use crate::geometry::Point;
use crate::pose::{Gaze, Head};

/// An intensity of so much, of 5, is a full emotion's.
const FULL: f64 = 3.5;
/// Millimetres between the pupils of an average adult, by which OpenFace's millimetres become pupil distances.
const PUPILS: f64 = 63.0;
/// Eye heights that the iris moves for a radian of gaze: an eyeball has a radius of 12 mm, an open eye 11 mm height.
const LOOK: f64 = 1.1;

/// Whether a CSV's heading is OpenFace's.
pub(super) fn is_header(names: &[String]) -> bool {
    let has = |name: &str| names.iter().any(|n| n == name);
    has("frame") && has("timestamp") && (has("AU12_r") || has("x_0") || has("gaze_angle_x"))
}

/// Frames of one face: the first that the file names where there are several.
pub(super) fn read(text: &str) -> Result<Vec<Seen>> {
    let table = csv::read(text)?;
    let need = |name: &str| {
        table
            .column(name)
            .ok_or_else(|| Fault::of(FileFault::Missing, format!("the column `{name}` is missing")).line(1))
    };
    let exact = |name: &str| table.names.iter().position(|n| *n == name);
    let (frame, time) = (need("frame")?, need("timestamp")?);
    let (sure, success, face) = (table.column("confidence"), table.column("success"), table.column("face_id"));
    let units: Vec<(usize, &str)> =
        UNITS.iter().filter_map(|(unit, name)| Some((table.column(&format!("{unit}_r"))?, *name))).collect();
    // Small x and y are pixels, capital ones millimetres.
    let points: Option<Vec<[usize; 2]>> =
        (0..68).map(|i| Some([exact(&format!("x_{i}"))?, exact(&format!("y_{i}"))?])).collect();
    let gaze = [table.column("gaze_angle_x"), table.column("gaze_angle_y")];
    let head = ["pose_Tx", "pose_Ty", "pose_Rz"].map(|n| table.column(n));
    let mut frames: Vec<Seen> = Vec::new();
    let mut first = None;
    let mut who = None;
    for row in &table.rows {
        let number = |column: usize| csv::number(&table, row, column);
        let maybe = |column: Option<usize>| column.map(number).transpose().map(Option::flatten);
        let id = maybe(face)?;
        if *who.get_or_insert(id) != id {
            continue;
        }
        let at = |column, name: &str| -> Result<f64> {
            number(column)?.ok_or_else(|| Fault::new(format!("the row has no {name}")).line(row.line))
        };
        let (n, seconds) = (at(frame, "frame")?, at(time, "timestamp")?);
        let n = n - *first.get_or_insert(n);
        if n < 0.0 || n > f64::from(u32::MAX) || frames.last().is_some_and(|f| n as u32 <= f.frame || seconds <= f.time)
        {
            return Err(Fault::new("frames and times do not rise").line(row.line).help("give the file of one video"));
        }
        let found = maybe(success)?.unwrap_or(1.0) > 0.0;
        let confidence = if found { maybe(sure)?.unwrap_or(1.0).clamp(0.0, 1.0) } else { 0.0 };
        let mut seen = Seen { frame: n as u32, time: seconds.max(0.0), confidence, ..Seen::default() };
        for (column, name) in &units {
            if let Some(value) = number(*column)? {
                seen.shapes.insert((*name).to_owned(), (value / FULL).clamp(0.0, 1.0));
            }
        }
        for [x, y] in points.iter().flatten() {
            if let (Some(x), Some(y)) = (number(*x)?, number(*y)?) {
                seen.points.push(Point::new(x, y));
            }
        }
        if let [Some(x), Some(y)] = [maybe(gaze[0])?, maybe(gaze[1])?] {
            seen.gaze = Some(Gaze { x: LOOK * x.clamp(-1.0, 1.0), y: LOOK * y.clamp(-1.0, 1.0) });
        }
        if let [Some(x), Some(y), Some(roll)] = [maybe(head[0])?, maybe(head[1])?, maybe(head[2])?] {
            seen.head = Some(Head { x: x / PUPILS, y: y / PUPILS, roll: roll.to_degrees() });
        }
        frames.push(seen);
    }
    Ok(frames)
}

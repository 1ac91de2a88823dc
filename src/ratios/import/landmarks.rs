//! From points of somebody else's tracker to ratios, through a person's calibration.

use super::frame::{Seen, median, record};
use crate::calibration::{Binding, Calibration, Choice, Decomposition};
use crate::disk::{Fault, FileFault, Result};
use crate::face::FeaturePoint;
use crate::geometry::{Point, Similarity, Vec2};
use crate::pose::Ratios;
use crate::ratios::Record;

/// Widths of pictures for a height of 1, for points in shares of a picture whose size is not said.
const ASPECTS: [f64; 7] = [16.0 / 9.0, 4.0 / 3.0, 1.0, 3.0 / 2.0, 5.0 / 4.0, 9.0 / 16.0, 3.0 / 4.0];

/// Fewer named points in common tell too little.
const ENOUGH: usize = 12;

/// Ratios by a calibration. Where the calibration has the same points they are read as they are. Else the feature points
/// that both have are compared, by how they move from the middle shape of the clip: two annotations never mark quite the
/// same places.
///
/// # Errors
/// When the points are of a kind that is not known, or too few are common to both.
pub(super) fn by_calibration(frames: &[Seen], calibration: &Calibration, notes: &mut Vec<String>) -> Result<Record> {
    let Some(count) = frames.iter().map(|f| f.points.len()).find(|n| *n > 0) else {
        return Err(Fault::of(FileFault::Empty, "no frame has any points").help("was a face found in the video?"));
    };
    let mut frames = frames.to_vec();
    for frame in &mut frames {
        if frame.points.len() != count {
            frame.confidence = 0.0;
        }
    }
    if count == calibration.binding().count() {
        return Ok(record(&frames, |f| {
            calibration.read_apart(&f.points, Choice::NonNegative).map_or(Ratios::NEUTRAL, |r| r.ratios)
        }));
    }
    let theirs = match count {
        68 => Binding::ibug68(),
        468 | 478 => Binding::mediapipe(count),
        _ => {
            let what = format!(
                "faces of {count} points are not known, and the calibration has {}",
                calibration.binding().count()
            );
            return Err(Fault::new(what).help("known are 68 points (iBUG), 468 and 478 (mediapipe)"));
        }
    };
    let names: Vec<FeaturePoint> = theirs
        .rows()
        .iter()
        .map(|(name, _)| *name)
        .filter(|name| calibration.binding().at(&calibration.shapes()[0].points, *name).is_some())
        .collect();
    if names.len() < ENOUGH {
        return Err(Fault::of(
            FileFault::Mismatch,
            format!("the calibration and the file have only {} points in common", names.len()),
        ));
    }
    let pick = |binding: &Binding, shape: &[Point]| -> Vec<Point> {
        names.iter().filter_map(|n| binding.at(shape, *n)).collect()
    };
    let full = calibration.laid().each_ref().map(|shape| pick(calibration.binding(), shape));
    let neutral = full[0].clone();
    let lay = |shape: &[Point]| -> Vec<Point> {
        match Similarity::between(shape, &neutral) {
            Some(q) => shape.iter().map(|p| q.apply(*p)).collect(),
            None => neutral.clone(),
        }
    };
    let shapes = full.each_ref().map(|shape| lay(shape));
    let decomposition = Decomposition::new(&shapes)?;
    let found: Vec<Vec<Point>> =
        frames.iter().filter(|f| f.confidence > 0.0).map(|f| pick(&theirs, &f.points)).collect();
    let wide = aspect(&found, &neutral);
    let shape_of = |points: &[Point]| lay(&points.iter().map(|p| Point::new(wide * p.x, p.y)).collect::<Vec<_>>());
    let laid: Vec<Vec<Point>> = found.iter().map(|points| shape_of(points)).collect();
    let off: Vec<Vec2> = (0..neutral.len())
        .map(|k| {
            let middle = |pick: fn(&Point) -> f64| median(laid.iter().map(|s| pick(&s[k])).collect());
            neutral[k] - Point::new(middle(|p| p.x), middle(|p| p.y))
        })
        .collect();
    notes.push(format!(
        "{} points are common to the file and the calibration; the middle shape of the file counts as neutral",
        names.len()
    ));
    Ok(record(&frames, |f| {
        let shape: Vec<Point> = shape_of(&pick(&theirs, &f.points)).iter().zip(&off).map(|(p, by)| *p + *by).collect();
        decomposition.read(&shape, Choice::NonNegative).ratios
    }))
}

/// What x is to be multiplied by: 1 for pixels, the picture's form for shares of it, by which the face is most like
/// itself.
fn aspect(found: &[Vec<Point>], neutral: &[Point]) -> f64 {
    let Some(first) = found.first() else { return 1.0 };
    if found.iter().take(100).flatten().any(|p| p.x.abs() > 3.0 || p.y.abs() > 3.0) {
        return 1.0;
    }
    let misfit = |wide: &f64| {
        let shape: Vec<Point> = first.iter().map(|p| Point::new(wide * p.x, p.y)).collect();
        Similarity::between(&shape, neutral)
            .map_or(f64::INFINITY, |q| shape.iter().zip(neutral).map(|(p, n)| (q.apply(*p) - *n).hypot2()).sum::<f64>())
    };
    ASPECTS.into_iter().min_by(|a, b| misfit(a).total_cmp(&misfit(b))).unwrap_or(1.0)
}

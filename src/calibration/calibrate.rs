//! From seven shots, or fewer, to a calibration and the person's model.

use super::finding::{Seeing, Seen};
use super::inputs::Inputs;
use super::known::{Ground, Known, trusted};
use super::person;
use super::quality::Quality;
use super::settle::Settling;
use super::{Calibration, Shape, Source};
use crate::aam::Model;
use crate::disk::{Fault, Result};
use crate::face::find::find;
use crate::face::{FeaturePoint as P, How, Placed};
use crate::geometry::{Point, Similarity, Vec2};
use crate::photo::Grey;
use crate::pose::Emotion;

/// What calibrating gives.
#[derive(Debug, Clone)]
pub struct Calibrated {
    /// The seven shapes.
    pub calibration: Calibration,
    /// The person's own model.
    pub model: Model,
    /// How good it is.
    pub quality: Quality,
    /// The points of each shot that there is, in its own pixels; none of an emotion that is modelled.
    pub shots: [Option<Vec<Placed>>; 7],
}

/// Calibrates: finds the points of shots that are not marked, models the emotions that have no shot, trains the
/// person's model, and says how good it all is.
///
/// # Errors
/// When the neutral points cannot be, or no model can be trained on them.
pub fn calibrate(inputs: &Inputs) -> Result<Calibrated> {
    let ground = Ground::of(inputs)?;
    let mut known: [Option<Known>; 7] = Default::default();
    let mut refused: [Option<String>; 7] = Default::default();
    for (i, shot) in inputs.shots.iter().enumerate() {
        let Some(shot) = shot else { continue };
        if i > 0 && (shot.points.is_empty() || shot.points.iter().any(|p| p.how != How::Hand)) {
            continue;
        }
        let pixels: Vec<Point> = shot.points.iter().map(|p| p.at).collect();
        let no_extent = || Fault::new(format!("the points of {} lie all in one place", Emotion::ALL[i]));
        known[i] = Some(Known {
            grey: shot.grey,
            place: Similarity::between(&ground.points, &pixels).ok_or_else(no_extent)?,
            errors: vec![0.0; pixels.len()],
            hands: vec![true; pixels.len()],
            points: pixels,
            turned: 0.0,
            look: 1.0,
        });
    }
    if let Some(neutral) = known[0].clone() {
        let left: Vec<usize> = (1..7).filter(|i| inputs.shots[*i].is_some() && known[*i].is_none()).collect();
        if !left.is_empty() {
            let seeing = Seeing::new(neutral.grey, &ground.frame, &ground.named, &ground.moves);
            let settling = Settling::new(&ground, &neutral);
            for i in left {
                match found(inputs, i, &ground, seeing.as_ref(), &settling, &neutral) {
                    Some(Ok(shot)) => known[i] = Some(shot),
                    Some(Err(why)) => refused[i] = Some(why),
                    None => {}
                }
            }
        }
    }
    finish(inputs, &ground, known, &refused)
}

/// A shot whose points are found; why not, where there is no face to be seen. None where there is no shot.
fn found<'a>(
    inputs: &Inputs<'a>,
    i: usize,
    ground: &Ground,
    seeing: Option<&Seeing>,
    settling: &Settling,
    neutral: &Known,
) -> Option<Result<Known<'a>, String>> {
    let shot = inputs.shots[i].as_ref()?;
    let hands = hands_of(inputs, i);
    let named: Vec<(P, Point)> = if inputs.own {
        hands.iter().filter_map(|(k, at)| Some((ground.named.get(*k)?.0, *at))).collect()
    } else {
        Vec::new()
    };
    let first = match (find(&shot.grey.to_photo(), &named), seeing) {
        (Ok(found), Some(seeing)) => seeing.look(&found, &named).ok_or_else(|| "its eyes coincide".to_owned()),
        (Ok(_), None) => Err("no face is found in the neutral photo".to_owned()),
        (Err(refusal), _) => Err(refusal.to_string()),
    };
    match first {
        Ok(seen) => {
            let mut known = placed(shot.grey, ground, &seen, &hands);
            settling.settle(&mut known, false);
            Some(Ok(known))
        }
        Err(why) => {
            // Shots of one person are taken from one place: the face may be where it was in the neutral one.
            let share = shot.grey.width() as f64 / neutral.grey.width().max(1) as f64;
            let f = ground.frame;
            let origin = (f.origin.to_vec2() * share).to_point();
            let place = Similarity { a: f.a * share, b: f.b * share, origin };
            let seen = Seen {
                place,
                moves: vec![Vec2::ZERO; ground.named.len()],
                errors: vec![0.1; ground.named.len()],
                turned: 0.0,
            };
            let mut known = placed(shot.grey, ground, &seen, &hands);
            Some(if settling.settle(&mut known, true) { Ok(known) } else { Err(why) })
        }
    }
}

/// The points of a shot that a hand has set, by their place among the model's.
fn hands_of(inputs: &Inputs, i: usize) -> Vec<(usize, Point)> {
    let shot = inputs.shots[i].as_ref();
    let points = shot.map_or(&[][..], |s| &s.points[..]).iter().enumerate();
    points.filter(|(_, p)| p.how == How::Hand).map(|(k, p)| (k, p.at)).collect()
}

/// A shot as the finder has it.
fn placed<'a>(grey: &'a Grey, ground: &Ground, seen: &Seen, hands: &[(usize, Point)]) -> Known<'a> {
    let mut points: Vec<Point> = ground.moved(&seen.moves).into_iter().map(|p| seen.place.apply(p)).collect();
    let doubts: Vec<Vec2> = seen.errors.iter().map(|e| Vec2::new(*e, 0.0)).collect();
    let mut errors: Vec<f64> = ground.spread.over(&doubts).iter().map(|v| v.x.max(0.005)).collect();
    let mut set = vec![false; points.len()];
    for (k, at) in hands {
        (points[*k], errors[*k], set[*k]) = (*at, 0.0, true);
    }
    Known { grey, place: seen.place, points, errors, hands: set, turned: seen.turned, look: 1.0 }
}

fn finish(
    inputs: &Inputs,
    ground: &Ground,
    known: [Option<Known>; 7],
    refused: &[Option<String>; 7],
) -> Result<Calibrated> {
    let shapes: [Shape; 7] = std::array::from_fn(|i| match &known[i] {
        Some(shot) => Shape {
            points: shot.points.clone(),
            source: if shot.is_marked() { Source::Marked } else { Source::Found(shot.confidence()) },
        },
        None => Shape { points: ground.on_neutral(&ground.moves.emotion(Emotion::ALL[i])), source: Source::Modelled },
    });
    let calibration = Calibration::new(shapes, inputs.binding.clone())?;
    let model = person::train(ground, &known)?;
    let quality = Quality::of(&calibration, &known, refused, &model);
    let shots = known.map(|shot| {
        shot.map(|shot| {
            let each = shot.points.iter().zip(&shot.errors).zip(&shot.hands);
            each.map(|((at, error), hand)| Placed {
                at: *at,
                confidence: trusted(*error),
                how: if *hand { How::Hand } else { How::Found },
            })
            .collect()
        })
    });
    // The neutral points are those of the face, who set them how.
    let mut shots: [Option<Vec<Placed>>; 7] = shots;
    shots[0] = inputs.shots[0].as_ref().map(|s| s.points.clone());
    Ok(Calibrated { calibration, model, quality, shots })
}

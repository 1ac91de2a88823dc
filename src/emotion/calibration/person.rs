//! The person's own model: trained on the shots, and on what the rig makes of them where they are few.

use super::calibrate::{Ground, Known};
use super::closer::{Flesh, Laid};
use super::patches::{Patches, View};
use super::warped::bent;
use crate::aam::{Fitter, Grey, Kind, Model, Options, Start};
use crate::disk::Result;
use crate::geometry::{Point, Vec2};
use crate::pose::{Emotion, MouthShape};

/// A trained model.
pub(super) struct Taught {
    pub model: Model,
}

/// Made pictures have a face of about so many pixels between the pupils: what a model looks at is smaller still.
const MADE: f64 = 60.0;

/// The moves of named points of which pictures are made: emotions, speech, blinks, glances, a head that turns.
fn made_moves(ground: &Ground) -> Vec<Vec<Vec2>> {
    let m = &ground.moves;
    let mut list: Vec<Vec<Vec2>> = Emotion::ALL[1..].iter().map(|e| m.emotion(*e)).collect();
    list.extend(MouthShape::ALL.iter().map(|s| m.mouth(*s, 0.8)));
    list.extend([m.lids(0.0, 0.0), m.lids(0.5, 0.5)]);
    list.extend([m.gaze(0.5, 0.0), m.gaze(-0.5, 0.0), m.gaze(0.0, 0.4)]);
    list.extend([m.head(0.12, 0.0), m.head(-0.12, 0.0), m.head(0.0, 0.12), m.head(0.0, -0.12)]);
    list
}

/// Pictures that the rig makes of the neutral shot.
fn made(ground: &Ground, neutral: &Known) -> Vec<(Grey, Vec<Point>)> {
    let scale = (MADE / ground.frame.scale()).min(1.0);
    let moves = made_moves(ground);
    moves.iter().map(|m| bent(neutral.grey, &neutral.points, &ground.on_neutral(m), scale)).collect()
}

/// Lets the points of found shots settle where the person's own look agrees.
pub(super) fn settle(ground: &Ground, known: &mut [Option<Known>; 7]) -> Result<()> {
    let Some(neutral) = known[0].clone() else { return Ok(()) };
    if known.iter().flatten().all(|k| k.hands.iter().all(|h| *h)) {
        return Ok(());
    }
    let var = |n: &str| std::env::var(n).unwrap_or_default();
    if var("CLM") != "0" {
        let flesh = Flesh::new(&ground.points, &ground.ways());
        let view = View::of(neutral.grey, ground.frame.scale());
        let mut looks = vec![Patches::of(&view, &ground.frame, &ground.points)];
        if var("BENT") == "1" {
            let m = &ground.moves;
            let scale = (56.0 / ground.frame.scale()).min(1.0);
            let list: Vec<Vec<Vec2>> = vec![m.emotion(Emotion::Happy), m.emotion(Emotion::Surprised), m.mouth(MouthShape::E, 0.8)];
            let of_mouth: Vec<bool> = ground.points.iter().map(|p| {
                let near = ground.named.iter().min_by(|a, b| a.1.distance(*p).total_cmp(&b.1.distance(*p)));
                near.is_some_and(|n| n.0.part() == crate::face::Part::Mouth)
            }).collect();
            for by in list {
                let (grey, points) = bent(neutral.grey, &neutral.points, &ground.on_neutral(&by), scale);
                let to = ground.moved(&by);
                if let Some(place) = crate::aam::Similarity::between(&to, &points) {
                    looks.push(Patches::of(&View::of(&grey, place.scale()), &place, &to).only(&of_mouth));
                }
            }
        }
        for shot in known.iter_mut().flatten().filter(|k| k.hands.iter().any(|h| !*h)) {
            let view = View::of(shot.grey, shot.place.scale());
            let start = Laid { place: shot.place, points: shot.points.iter().map(|p| shot.place.undo(*p)).collect(), errors: shot.errors.clone(), like: 0.0 };
            let fixed: Vec<(usize, Point)> = shot.points.iter().copied().enumerate().filter(|(i, _)| shot.hands[*i]).collect();
            let m = &ground.moves;
            let mut starts = vec![start.clone()];
            if var("MULTI") != "0" {
                for by in [m.lids(1.0, 1.0), m.emotion(Emotion::Happy), m.emotion(Emotion::Surprised)] {
                    starts.push(Laid { points: ground.moved(&by), ..start.clone() });
                }
            }
            let mut best: Option<Laid> = None;
            for start in &starts {
                let laid = flesh.closer(&view, &looks, start, &fixed, &[0.16, 0.12, 0.1, 0.08]);
                if best.as_ref().is_none_or(|b| laid.like > b.like) {
                    best = Some(laid);
                }
            }
            let laid = best.unwrap_or(start);
            let laid = flesh.closer(&view, &looks, &laid, &fixed, &[0.08, 0.06, 0.06]);
            shot.place = laid.place;
            for (i, p) in laid.points.iter().enumerate() {
                if !shot.hands[i] {
                    shot.points[i] = laid.place.apply(*p);
                    shot.errors[i] = laid.errors[i];
                }
            }
            shot.look = laid.like;
        }
    }
    let made = made(ground, &neutral);
    let mut pairs: Vec<(&Grey, &[Point])> = vec![(neutral.grey, &neutral.points)];
    pairs.extend(made.iter().map(|(g, p)| (g, &p[..])));
    let mut options = Options { detect: false, mirror: false, ..Options::of(if var("KIND") == "any" { Kind::Anyone } else { Kind::Person }) };
    if let Ok(m) = var("MODES").parse() { options.modes[1] = m; }
    if let Ok(m) = var("MODES0").parse() { options.modes[0] = m; }
    if let Ok(m) = var("PX").parse() { options.pixels[1] = m; }
    if let Ok(m) = var("SHARE").parse() { options.shape_share = m; }
    if let Ok(m) = var("SMOOTH").parse() { options.smooth[1] = m; }
    if let Ok(m) = var("TEX").parse() { options.texture_most = m; }
    if var("EDGES") == "1" { options.edges = true; }
    if var("SKIRT") == "1" { options.skirt = true; }
    if var("SIM") == "1" { options.simultaneous = true; }
    if var("SIM") == "0" { options.simultaneous = false; }
    let model = Model::train(&pairs, &options)?;
    let mut fitter = Fitter::new(&model);
    for shot in known.iter_mut().flatten().filter(|k| k.hands.iter().any(|h| !*h)) {
        let mut fit = if var("NEAR") == "1" { fitter.fit(shot.grey, Start::Near(&shot.points)) } else { fitter.fit(shot.grey, Start::Points(&shot.points)) };
        if var("REFINE") == "1" { fit = fitter.refine(shot.grey, &fit); }
        if !var("AAM").is_empty() {
            for ((p, to), hand) in shot.points.iter_mut().zip(&fit.points).zip(&shot.hands) {
                if !hand {
                    *p = *to;
                }
            }
        }
    }
    Ok(())
}

/// Trains on the shots and on what the rig makes of the neutral one.
pub(super) fn train(ground: &Ground, known: &[Option<Known>; 7]) -> Result<Taught> {
    let shots: Vec<&Known> = known.iter().flatten().collect();
    let made = known[0].as_ref().map(|n| made(ground, n)).unwrap_or_default();
    let mut pairs: Vec<(&Grey, &[Point])> = shots.iter().map(|k| (k.grey, &k.points[..])).collect();
    pairs.extend(made.iter().map(|(g, p)| (g, &p[..])));
    let model = Model::train(&pairs, &Options { detect: false, ..Options::of(Kind::Person) })?;
    Ok(Taught { model })
}

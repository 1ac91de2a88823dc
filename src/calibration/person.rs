//! The person's own model: trained on the shots, and on what the rig makes of the neutral one. A video has speech,
//! blinks and glances that seven shots of emotions do not have.

use super::known::{Ground, Known};
use super::warped::bent;
use crate::aam::{Kind, Model, Options};
use crate::disk::Result;
use crate::face::FeaturePoint as P;
use crate::geometry::{Point, Vec2};
use crate::photo::Grey;
use crate::pose::{Emotion, MouthShape};

/// Inner edges of the lips farther apart than this, in pupil distances, are an open mouth.
const OPEN: f64 = 0.08;

/// Made pictures have a face of about so many pixels between the pupils: what a model looks at is smaller still.
const MADE: f64 = 60.0;

/// The moves of named points of which pictures are made: emotions without a shot, speech, blinks and glances.
fn made_moves(ground: &Ground, known: &[Option<Known>; 7]) -> Vec<Vec<Vec2>> {
    let m = &ground.moves;
    let missing = Emotion::ALL[1..].iter().filter(|e| known[e.index()].is_none());
    let mut list: Vec<Vec<Vec2>> = missing.map(|e| m.emotion(*e)).collect();
    // A bent picture of speech shows less of how a mouth opens than a photo of an open one, and beside such photos it
    // teaches a model to explain an open mouth as a look of closed lips: it is only better than nothing.
    if !known.iter().flatten().any(|k| opens(ground, k)) {
        list.extend(MouthShape::ALL.iter().map(|s| m.mouth(*s, 0.8)));
    }
    list.extend([m.lids(0.0, 0.0), m.lids(0.5, 0.5)]);
    list.extend([m.gaze(0.5, 0.0), m.gaze(-0.5, 0.0), m.gaze(0.0, 0.4)]);
    list
}

/// Whether a shot shows an open mouth.
fn opens(ground: &Ground, shot: &Known) -> bool {
    let at = |p: P| ground.binding.at(&shot.points, p);
    let (Some(upper), Some(lower), Some(left), Some(right)) = (at(P::P2_2), at(P::P2_3), at(P::P3_6), at(P::P3_5))
    else {
        return false;
    };
    lower.y - upper.y > OPEN * left.distance(right)
}

/// Whether all seven shots are there and a hand has set all their points. Such a model is better left alone: what is
/// made of the neutral shot crowds the true shapes and looks out of its modes.
fn all_marked(known: &[Option<Known>; 7]) -> bool {
    known.iter().all(|k| k.as_ref().is_some_and(Known::is_marked))
}

/// Trains on the shots and, where they are not all marked, on what the rig makes of the neutral one.
pub(super) fn train(ground: &Ground, known: &[Option<Known>; 7]) -> Result<Model> {
    let shots: Vec<&Known> = known.iter().flatten().collect();
    let mut made = Vec::new();
    if let (Some(neutral), false) = (&known[0], all_marked(known)) {
        let scale = (MADE / ground.frame.scale()).min(1.0);
        let moves = made_moves(ground, known);
        made.extend(moves.iter().map(|m| bent(neutral.grey, &neutral.points, &ground.on_neutral(m), scale)));
    }
    // Made pictures are many and all of one look. Taken once, the shots would be rarities among them, farther out than a
    // fit may go; taken so often that they weigh as much, they are not.
    let often = if shots.len() > 1 { made.len().div_ceil(shots.len()).max(1) } else { 1 };
    let taken = shots.iter().map(|k| (k.grey, &k.points[..]));
    let mut pairs: Vec<(&Grey, &[Point])> = (0..often).flat_map(|_| taken.clone()).collect();
    pairs.extend(made.iter().map(|(g, p)| (g, &p[..])));
    let not_new = pairs.len() - shots.len();
    Model::train(&pairs, &Options { made: not_new, ..Options::of(Kind::Person) })
}

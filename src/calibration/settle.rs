//! Found points settle where the person's face looks as it does at rest round each of them.

use super::closer::{Flesh, Laid};
use super::known::{Ground, Known};
use super::patches::{Patches, View};
use super::warped::bent;
use crate::face::Part;
use crate::geometry::{Point, Similarity};
use crate::pose::{Emotion, MouthShape};

/// How far round each point is looked, step by step, in pupil distances.
const REACHES: [f64; 7] = [0.16, 0.12, 0.1, 0.08, 0.08, 0.06, 0.06];
/// The same where the finder has seen no face, before those.
const FAR: [f64; 5] = [0.4, 0.4, 0.3, 0.25, 0.2];
/// Pictures are bent at so many pixels between the pupils.
const BENT: f64 = 56.0;
/// Below this correlation a face that the finder did not see is not believed.
const BELIEVED: f64 = 0.62;
/// Mean correlations of shots whose points are wrong, and of such as are right: measured on twelve people.
const LIKE: (f64, f64) = (0.45, 0.75);

/// What the points of a shot are sought by.
pub(super) struct Settling {
    flesh: Flesh,
    looks: Vec<Patches>,
}

impl Settling {
    /// From the neutral shot.
    pub(crate) fn new(ground: &Ground, neutral: &Known) -> Self {
        let flesh = Flesh::new(&ground.points, &ground.ways());
        let view = View::of(neutral.grey, ground.frame.scale());
        let mut looks = vec![Patches::of(&view, &ground.frame, &ground.points)];
        // A mouth looks too different when it moves, so it is also sought as it looks bent. Eyes are not: what a bent
        // lid looks like is found everywhere.
        let of_mouth: Vec<bool> = ground.points.iter().map(|p| ground.part_near(*p) == Some(Part::Mouth)).collect();
        let moves = &ground.moves;
        let scale = (BENT / ground.frame.scale()).min(1.0);
        for by in [moves.emotion(Emotion::Happy), moves.emotion(Emotion::Surprised), moves.mouth(MouthShape::E, 0.8)] {
            let (grey, points) = bent(neutral.grey, &neutral.points, &ground.on_neutral(&by), scale);
            let to = ground.moved(&by);
            if let Some(place) = Similarity::between(&to, &points) {
                looks.push(Patches::of(&View::of(&grey, place.scale()), &place, &to).only(&of_mouth));
            }
        }
        Self { flesh, looks }
    }

    /// Moves the points of a shot that no hand has set. `blind` where they lie as on the neutral shot, since the finder
    /// saw no face; then false where no face is seen now either.
    pub(crate) fn settle(&self, shot: &mut Known, blind: bool) -> bool {
        let view = View::of(shot.grey, shot.place.scale());
        let points = shot.points.iter().map(|p| shot.place.undo(*p)).collect();
        let mut laid = Laid { place: shot.place, points, errors: shot.errors.clone(), like: 0.0 };
        let fixed: Vec<(usize, Point)> =
            shot.points.iter().copied().enumerate().filter(|(i, _)| shot.hands[*i]).collect();
        if blind {
            laid = self.flesh.closer(&view, &self.looks, &laid, &fixed, &FAR);
        }
        laid = self.flesh.closer(&view, &self.looks, &laid, &fixed, &REACHES);
        if blind && laid.like < BELIEVED {
            return false;
        }
        shot.place = laid.place;
        shot.look = ((laid.like - LIKE.0) / (LIKE.1 - LIKE.0)).clamp(0.02, 1.0);
        for (i, p) in laid.points.iter().enumerate().filter(|(i, _)| !shot.hands[*i]) {
            shot.points[i] = laid.place.apply(*p);
            shot.errors[i] = laid.errors[i];
        }
        true
    }
}

//! How good a calibration is, as numbers and in words.

use serde::{Deserialize, Serialize};

use super::known::Known;
use super::{Calibration, Source};
use crate::aam::{Fitter, Model, Start};
use crate::face::FeaturePoint as P;
use crate::geometry::{Point, Vec2};
use crate::pose::Emotion;

/// How good a calibration is.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Quality {
    /// Of the six differences to the neutral shape, the largest singular value over the smallest: 1 is best, above 20
    /// noise is read as emotion.
    pub condition: f64,
    /// The two emotions that are hardest to tell apart, and the angle between their differences to neutral, in degrees.
    pub nearest: (Emotion, Emotion, f64),
    /// The shots in canonical order.
    pub shots: Vec<ShotQuality>,
    /// What there is to say, the most important first; empty where all is well.
    pub notes: Vec<String>,
    /// The shot to take anew first; none where all are good enough.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub retake: Option<Retake>,
}

/// How good a shot is.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ShotQuality {
    /// Which emotion it shows.
    pub emotion: Emotion,
    /// How well its points could be found: 0 to 1; 1 where they were marked, 0 where it is modelled.
    pub confidence: f64,
    /// How far its points lie from where the person's own model fits them, in per cent of the pupil distance; 0 of what is
    /// modelled.
    pub residual: f64,
    /// How far its points have moved from neutral, root mean square, in per cent of the pupil distance.
    pub strength: f64,
    /// How far the eyes are open against the neutral shot: 1 as there.
    pub eyes: f64,
    /// How far the head is turned against the neutral shot, in degrees, as far as the finder told.
    pub turned: f64,
}

/// Which shot to take anew, and why.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Retake {
    /// Which.
    pub emotion: Emotion,
    /// Why, as a sentence.
    pub why: String,
}

/// Below this a shot's points must be looked at.
const POOR: f64 = 0.5;
/// A shot that has moved by less, in per cent of the pupil distance, is hardly an emotion.
const LITTLE: f64 = 1.2;
/// Differences nearer to each other than this, in degrees, are hardly told apart.
const NEAR: f64 = 25.0;
/// Eyes open by less than this share of the neutral ones are shut.
const SHUT: f64 = 0.35;
/// A head turned by more, in degrees, moves points as much as an emotion does.
const TURNED: f64 = 10.0;
/// A condition above this makes ratios tremble.
const ILL: f64 = 20.0;

impl Quality {
    pub(super) fn of(
        calibration: &Calibration,
        known: &[Option<Known>; 7],
        refused: &[Option<String>; 7],
        model: &Model,
    ) -> Self {
        let laid = calibration.laid();
        let n = laid[0].len().max(1) as f64;
        let moves: Vec<Vec<Vec2>> =
            laid.iter().map(|s| s.iter().zip(&laid[0]).map(|(a, b)| *a - *b).collect()).collect();
        let size = |m: &[Vec2]| m.iter().map(|v| v.hypot2()).sum::<f64>().sqrt();
        let mut fitter = Fitter::new(model);
        let open = |s: &[Point]| {
            let at = |p| calibration.binding().at(s, p);
            let eye = |a, b| Some(at(a)?.distance(at(b)?));
            Some(eye(P::P3_2, P::P3_4)? + eye(P::P3_1, P::P3_3)?)
        };
        let shots: Vec<ShotQuality> = Emotion::ALL
            .into_iter()
            .map(|emotion| {
                let i = emotion.index();
                let residual = known[i].as_ref().map_or(0.0, |shot| {
                    let fit = fitter.fit(shot.grey, Start::Near(&shot.points));
                    let far: f64 = fit.points.iter().zip(&shot.points).map(|(a, b)| a.distance(*b)).sum();
                    100.0 * far / n / shot.place.scale().max(1e-6)
                });
                ShotQuality {
                    emotion,
                    confidence: match calibration.shapes()[i].source {
                        Source::Marked => 1.0,
                        Source::Found(c) => c,
                        Source::Modelled => 0.0,
                    },
                    residual,
                    strength: 100.0 * size(&moves[i]) / n.sqrt(),
                    eyes: match (open(&laid[i]), open(&laid[0])) {
                        (Some(now), Some(rest)) if rest > 1e-6 => now / rest,
                        _ => 1.0,
                    },
                    turned: known[i].as_ref().map_or(0.0, |k| k.turned),
                }
            })
            .collect();
        let mut nearest = (Emotion::Happy, Emotion::Anger, 180.0);
        for a in 1..7 {
            for b in a + 1..7 {
                let dot: f64 = moves[a].iter().zip(&moves[b]).map(|(u, v)| u.dot(*v)).sum();
                let angle = (dot / (size(&moves[a]) * size(&moves[b])).max(1e-12)).clamp(-1.0, 1.0).acos().to_degrees();
                if angle < nearest.2 {
                    nearest = (Emotion::ALL[a], Emotion::ALL[b], angle);
                }
            }
        }
        let columns = nalgebra::DMatrix::from_fn(2 * laid[0].len(), 6, |r, c| {
            let v = moves[c + 1][r / 2];
            if r % 2 == 0 { v.x } else { v.y }
        });
        let values = columns.svd(false, false).singular_values;
        let condition = (values.max() / values.min().max(1e-9 * values.max()).max(1e-300)).min(1e9);
        let mut quality = Self { condition, nearest, shots, notes: Vec::new(), retake: None };
        quality.speak(calibration, refused);
        quality
    }

    /// What there is to say of the numbers.
    fn speak(&mut self, calibration: &Calibration, refused: &[Option<String>; 7]) {
        let mut wrong: Vec<(f64, Emotion, String)> = Vec::new();
        let source = |e: Emotion| calibration.shapes()[e.index()].source;
        for shot in &self.shots[1..] {
            let e = shot.emotion;
            if let Some(why) = &refused[e.index()] {
                wrong.push((4.0, e, format!("in the photo of {e} the face could not be followed: {why}")));
                continue;
            }
            if source(e) == Source::Modelled {
                continue;
            }
            if shot.eyes < SHUT {
                wrong.push((3.0, e, format!("in the photo of {e} the eyes are shut")));
            }
            if shot.turned.abs() > TURNED {
                wrong.push((
                    2.5 + shot.turned.abs() / 100.0,
                    e,
                    format!("in the photo of {e} the head is turned by about {:.0}°", shot.turned.abs()),
                ));
            }
            if shot.confidence < POOR {
                wrong.push((
                    2.0 + POOR - shot.confidence,
                    e,
                    format!("the points of {e} are not sure: look at them and correct them"),
                ));
            }
            if shot.strength < LITTLE {
                wrong.push((3.5, e, format!("the photo of {e} hardly differs from the neutral one: show it more")));
            }
        }
        let (a, b, angle) = self.nearest;
        if angle < NEAR {
            let strength = |e: Emotion| self.shots[e.index()].strength;
            let weaker = [a, b].into_iter().filter(|e| source(*e) != Source::Modelled);
            if let Some(which) = weaker.min_by(|x, y| strength(*x).total_cmp(&strength(*y))) {
                let what = format!(
                    "{a} and {b} look nearly the same ({angle:.0}° apart): they will be mistaken for each other"
                );
                wrong.push((2.2, which, what));
            }
        }
        wrong.sort_by(|x, y| y.0.total_cmp(&x.0));
        self.retake = wrong.first().map(|(_, emotion, why)| Retake { emotion: *emotion, why: why.clone() });
        self.notes = wrong.into_iter().map(|w| w.2).collect();
        if self.condition > ILL {
            self.notes.push(format!(
                "small errors of the points grow {:.0} times in the weakest emotion: ratios will tremble",
                self.condition
            ));
        }
        let modelled: Vec<&str> =
            Emotion::ALL[1..].iter().filter(|e| source(**e) == Source::Modelled).map(|e| e.name()).collect();
        match modelled.len() {
            0 => {}
            6 => self.notes.push(
                "there is no photo of an emotion, so all six are everybody's: ratios say what moves, but not how much of \
                 this person's own emotion it is. Take the six photos to make them right"
                    .into(),
            ),
            _ => self.notes.push(format!(
                "no photo of {}: modelled after everybody's face, so {} ratios are rough",
                modelled.join(", "),
                if modelled.len() == 1 { "its" } else { "their" }
            )),
        }
    }
}

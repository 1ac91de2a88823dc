//! From blendshapes to ratios: the 52 names of ARKit, which mediapipe and Live Link Face use too.
//!
//! `blendshapes.csv` says how far each is moved by a full emotion, after the units of EMFACS (Friesen and Ekman 1983): happy 6 + 12,
//! sadness 1 + 4 + 15, surprise 1 + 2 + 5 + 26, fear 1 + 2 + 4 + 5 + 20 + 26, anger 4 + 5 + 7 + 23, disgust 9 + 15 + 16; where a blendshape
//! stands for a unit is [`UNITS`]. A frame is read as a mix of the seven as in eq. 6, not negative, apart from what speech
//! does to a mouth.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use crate::calibration::{Choice, Decomposition};
use crate::disk::Result;
use crate::geometry::Point;
use crate::pose::Ratios;

/// Values by blendshape, their names in small letters without anything between: `eyeblinkleft`.
pub(super) type Shapes = BTreeMap<String, f64>;

/// Action units and the blendshape that each is, with what OpenFace's intensity (0 to 5) is divided by: 3.5, between
/// *marked* and *severe*, is a full emotion's.
pub(super) const UNITS: [(&str, &str); 16] = [
    ("au01", "browinnerup"),
    ("au02", "browouterup"),
    ("au04", "browdown"),
    ("au05", "eyewide"),
    ("au06", "cheeksquint"),
    ("au07", "eyesquint"),
    ("au09", "nosesneer"),
    ("au10", "mouthupperup"),
    ("au12", "mouthsmile"),
    ("au14", "mouthdimple"),
    ("au15", "mouthfrown"),
    ("au17", "mouthshruglower"),
    ("au20", "mouthstretch"),
    ("au23", "mouthpress"),
    ("au26", "jawopen"),
    ("au45", "eyeblink"),
];

/// What speech does, as blendshapes: open, rounded, spread, bitten and pressed lips; any mix of them may be there.
const SPEECH: [&[(&str, f64)]; 6] = [
    &[("jawopen", 0.5), ("mouthlowerdown", 0.3)],
    &[("mouthfunnel", 0.6), ("jawopen", 0.15)],
    &[("mouthpucker", 0.7)],
    &[("mouthstretch", 0.25), ("mouthdimple", 0.2), ("mouthupperup", 0.2), ("mouthlowerdown", 0.3)],
    &[("mouthupperup", 0.25), ("mouthlowerdown", 0.35)],
    &[("mouthpress", 0.3), ("mouthshruglower", 0.25)],
];

/// How far a tracker's values are off, of 1.
const NOISE: f64 = 0.12;

/// What mediapipe has the names of and never tells (its cheeks and sneers stay near 0): where no frame has more than
/// this, they were not measured. Of the others, none at all says something: brows that stay down are no surprise.
const NOT_TOLD: [&str; 2] = ["cheeksquint", "nosesneer"];
const NOTHING: f64 = 0.02;

struct Feature {
    name: String,
    sides: [String; 2],
    /// By emotion.
    full: [f64; 7],
    weight: f64,
}

/// `blendshapes.csv`, which is part of the program.
static FEATURES: LazyLock<Vec<Feature>> = LazyLock::new(|| {
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        let text = |i: usize| cells.get(i).map_or(String::new(), |c| plain(c));
        let number = |i: usize| cells.get(i).and_then(|c| c.parse().ok()).unwrap_or(0.0);
        Feature {
            name: text(0),
            sides: [text(1), text(2)],
            full: std::array::from_fn(|e| number(3 + e)),
            weight: number(10),
        }
    };
    include_str!("blendshapes.csv").lines().skip(1).map(row).collect()
});

/// A name without capitals and marks: `eyeBlink_L`, `EyeBlinkLeft` and `eyeblinkleft` are one.
pub(super) fn plain(name: &str) -> String {
    let (body, side) = match name.trim() {
        n if n.ends_with("_L") => (&n[..n.len() - 2], "left"),
        n if n.ends_with("_R") => (&n[..n.len() - 2], "right"),
        n => (n, ""),
    };
    body.chars().filter(char::is_ascii_alphanumeric).map(|c| c.to_ascii_lowercase()).chain(side.chars()).collect()
}

/// A blendshape's value: itself, else the mean of its sides; 0 where it is not there.
pub(super) fn value(shapes: &Shapes, name: &str) -> f64 {
    let side = |end: &str| shapes.get(&format!("{name}{end}")).copied();
    let both = || match (side("left"), side("right")) {
        (Some(a), Some(b)) => Some(f64::midpoint(a, b)),
        (one, other) => one.or(other),
    };
    shapes.get(name).copied().or_else(both).unwrap_or(0.0)
}

/// Whether a name is one of those that are read.
pub(super) fn is_known(name: &str) -> bool {
    let name = plain(name);
    FEATURES.iter().any(|f| f.sides.contains(&name)) || name.starts_with("eyeblink") || name.starts_with("eyelook")
}

/// Reads frames of blendshapes as ratios.
pub(super) struct Reader {
    decomposition: Decomposition,
    /// Features that no frame tells.
    pub unseen: Vec<&'static str>,
}

impl Reader {
    /// For a clip of these frames: what none of them tells, does not count.
    pub(crate) fn of<'a>(frames: impl Iterator<Item = &'a Shapes>) -> Result<Self> {
        let mut seen = vec![false; FEATURES.len()];
        for shapes in frames {
            for (seen, feature) in seen.iter_mut().zip(FEATURES.iter()) {
                let is_there = feature.sides.iter().chain([&feature.name]).any(|name| shapes.contains_key(name));
                let least = if NOT_TOLD.contains(&feature.name.as_str()) { NOTHING } else { 0.0 };
                *seen |= is_there && value(shapes, &feature.name) >= least;
            }
        }
        let seen = |i: usize| seen[i];
        let shapes: [Vec<Point>; 7] =
            std::array::from_fn(|e| FEATURES.iter().map(|f| Point::new(f.full[e], 0.0)).collect());
        let weights: Vec<f64> =
            FEATURES.iter().enumerate().map(|(i, f)| if seen(i) { f.weight } else { 0.0 }).collect();
        let all: Vec<f64> = FEATURES.iter().map(|f| f.weight).collect();
        let speech: Vec<Vec<Point>> = SPEECH
            .iter()
            .map(|moves| {
                let by = |f: &Feature| moves.iter().find(|(name, _)| *name == f.name).map_or(0.0, |(_, by)| *by);
                FEATURES.iter().map(|f| Point::new(by(f), 0.0)).collect()
            })
            .collect();
        let plain = Decomposition::new(&shapes)?;
        // A face that never moves shows nothing by any weights.
        let weighed = plain.weighed(&weights).or_else(|_| plain.weighed(&all))?;
        let unseen = FEATURES.iter().enumerate().filter(|(i, _)| !seen(*i)).map(|(_, f)| f.name.as_str()).collect();
        Ok(Self { decomposition: weighed.apart_from(&speech, NOISE)?, unseen })
    }

    pub(crate) fn ratios(&self, shapes: &Shapes) -> Ratios {
        let values: Vec<Point> = FEATURES.iter().map(|f| Point::new(value(shapes, &f.name), 0.0)).collect();
        self.decomposition.read(&values, Choice::NonNegative).ratios
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pose::Emotion;

    fn of(emotion: Emotion, amount: f64) -> Shapes {
        let sides = |f: &Feature| f.sides.clone().map(|s| (s, amount * f.full[emotion.index()]));
        FEATURES.iter().flat_map(sides).collect()
    }

    #[test]
    fn full_and_half_emotions_are_read_as_themselves_and_speech_as_nothing() {
        let full: Vec<Shapes> = Emotion::ALL.map(|e| of(e, 1.0)).into_iter().collect();
        let reader = Reader::of(full.iter()).unwrap();
        for emotion in Emotion::ALL {
            for amount in [1.0, 0.5] {
                let ratios = reader.ratios(&of(emotion, amount));
                let wanted = Ratios::some(emotion, amount);
                assert!((0..7).all(|i| (ratios.0[i] - wanted.0[i]).abs() < 1e-6), "{emotion} {ratios:?}");
            }
        }
        for moves in SPEECH {
            let shapes: Shapes = moves.iter().map(|(name, by)| ((*name).to_owned(), *by)).collect();
            let ratios = reader.ratios(&shapes);
            assert!(ratios[Emotion::Neutral] > 0.8, "{moves:?} {ratios:?}");
        }
    }

    #[test]
    fn names_are_one_however_they_are_written() {
        assert!(
            ["eyeBlinkLeft", "EyeBlinkLeft", "eyeBlink_L", " eyeblinkleft"].iter().all(|n| plain(n) == "eyeblinkleft")
        );
        assert_eq!(plain("browInnerUp"), "browinnerup");
        assert!(is_known("MouthSmile_R") && !is_known("TimeCode"));
    }
}

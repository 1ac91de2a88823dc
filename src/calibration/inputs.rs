//! What a calibration is made of.

use crate::calibration::Binding;
use crate::disk::{Fault, FileFault, Result};
use crate::face::{FeaturePoint as P, How, Placed};
use crate::geometry::Point;
use crate::photo::Grey;
use crate::pose::Emotion;

/// A shot of an emotion: its picture and what is known of its points.
#[derive(Debug, Clone)]
pub(crate) struct ShotInput<'a> {
    /// Its luma.
    pub grey: &'a Grey,
    /// Its points in pixels, as many as the neutral shot has; empty where nothing is known. Those that a hand has set
    /// stand and pull the others, which are found anew.
    pub points: Vec<Placed>,
}

/// What a calibration is made of: a marked neutral shot, and shots of the other emotions, as many as there are.
#[derive(Debug, Clone)]
pub struct Inputs<'a> {
    /// The shots by emotion; the neutral one is there and all its points are known.
    pub(super) shots: [Option<ShotInput<'a>>; 7],
    /// Named points of the neutral shot, in pixels.
    pub(super) named: Vec<(P, Point)>,
    /// How those hang on the points of the shots.
    pub(super) binding: Binding,
    /// Whether the points are our own 41.
    pub(super) own: bool,
}

impl<'a> Inputs<'a> {
    /// A neutral photo with our own points: those of its `face.toml`.
    #[must_use]
    pub fn own(neutral: &'a Grey, points: &[Placed; P::FIXED]) -> Self {
        let points: Vec<Placed> = Binding::own_points().map(|p| points[p.index()]).collect();
        let named = Binding::own_points().zip(points.iter().map(|p| p.at)).collect();
        let shots = std::array::from_fn(|i| (i == 0).then(|| ShotInput { grey: neutral, points: points.clone() }));
        Self { shots, named, binding: Binding::own(), own: true }
    }

    /// A neutral photo with somebody's own annotation. `named` are the named points of the same photo, of which there
    /// must be the pupils: those of its `face.toml`, or as they were found.
    ///
    /// # Errors
    /// When the pupils are not among the named points or coincide, or the annotation has no extent.
    pub fn foreign(neutral: &'a Grey, points: &[Point], named: &[(P, Point)]) -> Result<Self> {
        let named: Vec<(P, Point)> =
            Binding::own_points().filter_map(|p| named.iter().find(|(n, _)| *n == p).copied()).collect();
        let at = |p: P| named.iter().find(|(n, _)| *n == p).map(|n| n.1);
        let pupils = match (at(P::P3_6), at(P::P3_5)) {
            (Some(left), Some(right)) => left.distance(right),
            _ => return Err(Fault::of(FileFault::Missing, "the pupils of the neutral photo are not known").help(LOOK)),
        };
        if pupils.is_nan() || pupils <= 1.0 || points.len() < 3 {
            return Err(Fault::new("the pupils of the neutral photo coincide").help(LOOK));
        }
        let binding = Binding::by_place(points, &named, pupils);
        let sure = |p: &Point| Placed { at: *p, confidence: 1.0, how: How::Hand };
        let first = ShotInput { grey: neutral, points: points.iter().map(sure).collect() };
        let mut shots: [Option<ShotInput<'a>>; 7] = Default::default();
        shots[0] = Some(first);
        Ok(Self { shots, named, binding, own: false })
    }

    /// With the shot of an emotion. Points may be empty, or as many as the neutral shot has.
    ///
    /// # Errors
    /// When there are other points, or a place is none.
    pub fn with(mut self, emotion: Emotion, grey: &'a Grey, points: Vec<Placed>) -> Result<Self> {
        let n = self.shots[0].as_ref().map_or(0, |s| s.points.len());
        if !points.is_empty() && points.len() != n {
            return Err(Fault::of(
                FileFault::Mismatch,
                format!("the shot `{emotion}` has {} points, the neutral one {n}", points.len()),
            )
            .help("mark the same points in every shot"));
        }
        if points.iter().any(|p| !(p.at.x.is_finite() && p.at.y.is_finite())) {
            return Err(Fault::new(format!("a point of the shot `{emotion}` is no place")).help("mark it again"));
        }
        if emotion == Emotion::Neutral {
            return Err(Fault::of(FileFault::Duplicate, "there are two neutral shots").help("give one"));
        }
        self.shots[emotion.index()] = Some(ShotInput { grey, points });
        Ok(self)
    }
}

const LOOK: &str = "set 3.6 and 3.5 in the face's points";

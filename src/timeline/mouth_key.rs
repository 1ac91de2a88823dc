//! Key frames of the mouth, and the spoken syllables that they come from.

use super::Ease;
use crate::pose::{MouthPose, MouthShape};

/// The longest way from one shape to the next, in seconds. Lips need 60 to 120 ms between targets.
pub(super) const TRAVEL: f64 = 0.10;

/// Seconds before the first sound at which a resting mouth starts to move, and after the last at which it rests.
pub(super) const PREPARE: f64 = 0.12;
pub(super) const RELEASE: f64 = 0.18;

/// A syllable or word with its mouth shapes, in time.
#[derive(Debug, Clone, PartialEq)]
pub struct Spoken {
    /// Seconds.
    pub start: f64,
    /// Seconds.
    pub end: f64,
    /// Shapes in order, each with the share of the whole at which it starts: 0 for the first, growing, below 1.
    pub shapes: Vec<(f64, MouthShape)>,
    /// Whether the shapes' times were found in the sound and not shared out: lips are then closed until the next
    /// shape starts, and open from there.
    pub exact: bool,
}

/// Who set a key of the mouth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Origin {
    /// A syllable (by its number).
    Speech(usize),
    /// The author.
    Author,
    /// The pause before, between or after what is said.
    Pause,
}

/// A key frame of the mouth: a target and how long it is held.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MouthKey {
    /// When it is reached, in seconds.
    pub time: f64,
    /// Until when it is held.
    pub until: f64,
    /// The shape; none at rest.
    pub shape: Option<MouthShape>,
    /// What the mouth does there.
    pub pose: MouthPose,
    /// Who set it.
    pub origin: Origin,
    pub(super) ease: Ease,
}

impl MouthKey {
    pub(super) const REST: Self =
        Self { time: 0.0, until: 0.0, shape: None, pose: MouthPose::REST, origin: Origin::Pause, ease: Ease::Smooth };
}

/// *n* keeps the corners of the shape before it, the neutral ones at the start of an utterance (thesis 5.2.3).
pub(super) fn corners_of_n(keys: &mut [MouthKey]) {
    for i in 1..keys.len() {
        if keys[i].shape == Some(MouthShape::N) && keys[i - 1].shape.is_some() {
            keys[i].pose = keys[i].pose.with_corners_of(&keys[i - 1].pose);
        }
    }
}

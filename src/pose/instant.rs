//! The pose: everything a figure needs to know to draw one instant.

use serde::{Deserialize, Serialize};

use super::{MouthPose, MouthShape, Ratios};

/// Where the eyes look, in eye heights from straight ahead; x to the image's right, y down.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Gaze {
    /// To the image's right.
    pub x: f64,
    /// Down.
    pub y: f64,
}

/// How far each eye is open: 1 as the emotion has it, 0 closed. Left is the image's left.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Lids {
    /// The eye at the image's left.
    pub left: f64,
    /// The eye at the image's right.
    pub right: f64,
}

impl Default for Lids {
    fn default() -> Self {
        Self { left: 1.0, right: 1.0 }
    }
}

/// Where the head is, away from rest.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Head {
    /// To the image's right, in pupil distances.
    pub x: f64,
    /// Down, in pupil distances.
    pub y: f64,
    /// Clockwise as seen, in degrees.
    pub roll: f64,
}

/// The score read at one instant.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Pose {
    /// The mix of the seven emotions.
    pub ratios: Ratios,
    /// What the mouth does on top of the emotion.
    pub mouth: MouthPose,
    /// The shape the mouth is nearest to in time; none at rest.
    pub shape: Option<MouthShape>,
    /// Where the eyes look.
    pub gaze: Gaze,
    /// How far the eyes are open.
    pub lids: Lids,
    /// Where the head is.
    pub head: Head,
}

impl Pose {
    /// A face at rest that shows `ratios`.
    #[must_use]
    pub fn of(ratios: Ratios) -> Self {
        Self { ratios, ..Self::default() }
    }
}

//! What a drawing changes about a face before it moves: eyes, and for some styles nose, mouth, brows and chin.

use serde::{Deserialize, Serialize};

/// How a style draws a neutral face, against how it was measured (recipe parts 0 and 7). Everything is a factor of the
/// face's own lengths or a share of its units.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Proportions {
    /// How far the two sides are brought together: 0 as found, 1 mirror images. Raw points make wry faces, mirror
    /// images kill likeness.
    pub symmetry: f64,
    /// The same for the ears, which photos show worst.
    pub ear_symmetry: f64,
    /// Width of the eyes, about the eyeball's middle.
    pub eye_width: f64,
    /// Height of the lids over the eyeball's middle.
    pub eye_height: f64,
    /// Size of the iris; 1 is a radius of 0.117 ES0.
    pub iris: f64,
    /// Height of the crease over the upper lid, in heights of the eye.
    pub crease: f64,
    /// Size of the nose, about the middle of its base.
    pub nose: f64,
    /// The nose up, in ENS0.
    pub nose_up: f64,
    /// Width of the mouth, about its middle.
    pub mouth_wide: f64,
    /// Height of the mouth, about its middle.
    pub mouth_high: f64,
    /// The mouth up, in ENS0.
    pub mouth_up: f64,
    /// The brows up, in ES0.
    pub brow_up: f64,
    /// The chin up, in ES0.
    pub chin_up: f64,
    /// The jaw up, in ES0.
    pub jaw_up: f64,
}

impl Proportions {
    /// A likeness: eyes a little larger, everything else as measured.
    pub const NORMAL: Self = Self {
        symmetry: 0.65,
        ear_symmetry: 0.9,
        eye_width: 1.16,
        eye_height: 1.26,
        iris: 1.0,
        crease: 0.30,
        nose: 1.0,
        nose_up: 0.0,
        mouth_wide: 1.0,
        mouth_high: 1.0,
        mouth_up: 0.0,
        brow_up: 0.0,
        chin_up: 0.0,
        jaw_up: 0.0,
    };

    /// Large eyes in a child's face.
    pub const CUTE: Self = Self {
        eye_width: 1.42,
        eye_height: 1.75,
        iris: 1.38,
        crease: 0.22,
        nose: 0.72,
        nose_up: 0.10,
        mouth_wide: 0.82,
        mouth_high: 0.85,
        mouth_up: 0.12,
        brow_up: 0.07,
        chin_up: 0.12,
        jaw_up: 0.10,
        ..Self::NORMAL
    };
}

impl Default for Proportions {
    fn default() -> Self {
        Self::NORMAL
    }
}

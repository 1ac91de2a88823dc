//! The face's own units: distances between neutral points (thesis sec. 4.4.1), and the frame in which a face is
//! drawn.

use super::{FeaturePoint as P, Points};
use crate::geometry::{Affine, Point, Vec2};

/// The distances of the neutral face that its animation is measured in, in the unit of the points they are taken from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Units {
    /// ES0: between the eyeball centres, 3.6 to 3.5.
    pub eye_separation: f64,
    /// ENS0: from the eye line to 9.15.
    pub eye_nose: f64,
    /// MNS0: 9.15 to 8.1.
    pub mouth_nose: f64,
    /// MW0: 8.4 to 8.3.
    pub mouth_width: f64,
    /// LeftEyeH: 3.2 to 3.4.
    pub left_eye_height: f64,
    /// RightEyeH: 3.1 to 3.3.
    pub right_eye_height: f64,
    /// UpperLipH: 8.1 to 2.2.
    pub upper_lip_height: f64,
    /// LowerLipH: 2.3 to 8.2.
    pub lower_lip_height: f64,
    /// JawH: 8.2 to 2.1.
    pub jaw_height: f64,
}

impl Units {
    /// The units of neutral points.
    #[must_use]
    pub fn of(points: &Points) -> Self {
        let between = |a: P, b: P| points[a].distance(points[b]);
        Self {
            eye_separation: between(P::P3_6, P::P3_5),
            eye_nose: points[P::P9_15].distance(points[P::P3_6].midpoint(points[P::P3_5])),
            mouth_nose: between(P::P9_15, P::P8_1),
            mouth_width: between(P::P8_4, P::P8_3),
            left_eye_height: between(P::P3_2, P::P3_4),
            right_eye_height: between(P::P3_1, P::P3_3),
            upper_lip_height: between(P::P8_1, P::P2_2),
            lower_lip_height: between(P::P2_3, P::P8_2),
            jaw_height: between(P::P8_2, P::P2_1),
        }
    }
}

/// The move from photo pixels to the frame that a face is drawn in: pupil distance 100, origin midway between the
/// pupils, eye line level, y down.
///
/// Where the pupils are one point the scale is that of a pupil distance of one pixel.
#[must_use]
pub fn to_face_frame(left_eye: Point, right_eye: Point) -> Affine {
    let across: Vec2 = right_eye - left_eye;
    let distance = across.hypot().max(1.0);
    Affine::scale(100.0 / distance)
        * Affine::rotate(-across.atan2())
        * Affine::translate(-left_eye.midpoint(right_eye).to_vec2())
}

//! The points of brows and eyes, and the unit of the face frame.

use crate::face::FeaturePoint as P;

/// Pupil distance in the face frame.
pub(super) const ES0: f64 = 100.0;

/// Brows of the left and the right side, from the inner to the outer end.
pub(super) const BROWS: [[P; 4]; 2] = [[P::P4_2, P::P4_4, P::P4_4A, P::P4_6], [P::P4_1, P::P4_3, P::P4_3A, P::P4_5]];

/// Eyes of the left and the right side: inner and outer corner, upper and lower lid, middle.
pub(super) const EYES: [[P; 5]; 2] =
    [[P::P3_8, P::P3_12, P::P3_2, P::P3_4, P::P3_6], [P::P3_11, P::P3_7, P::P3_1, P::P3_3, P::P3_5]];

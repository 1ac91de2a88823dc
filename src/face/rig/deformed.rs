//! A face in a pose.

use super::{Expression, Eye, Mouth};
use crate::face::Points;
use crate::geometry::{Affine, Point};

/// A face in a pose, in the face frame: what a figure draws.
#[derive(Debug, Clone, PartialEq)]
pub struct Deformed {
    /// All 47 points. Those of ears, temples, forehead and nose rest.
    pub points: Points,
    /// The lips.
    pub mouth: Mouth,
    /// The eyes at the image's left and right.
    pub eyes: [Eye; 2],
    /// The brows at the image's left and right, each from its inner to its outer end.
    pub brows: [[Point; 4]; 2],
    /// What the emotions ask for, for creases, cheeks and frown.
    pub expression: Expression,
    /// How far the chin has come down, in face units; at least 0.
    pub chin_drop: f64,
    /// The move of the whole head; everything else here is before it.
    pub head: Affine,
}

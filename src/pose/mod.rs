//! The plain values every room shares: the seven emotions and their ratios, the nine mouth shapes and what
//! each does to a mouth, and the pose, which is the whole score read at one instant.
//!
//! It owns no time and no drawing: when a pose holds is the `timeline`'s business, what it looks like a `figure`'s.

mod emotion;
mod instant;
mod mouth;

pub use emotion::{Emotion, Ratios};
pub use instant::{Gaze, Head, Lids, Pose};
pub use mouth::{MouthPose, MouthPreset, MouthShape};

//! Figures: what turns a pose into a drawing. So far the line figures, which blend seven drawings made of Bézier
//! strokes (paper sec. 2); two come with the program and an author can write more as files.
//!
//! A figure owns no time: it draws the pose it is given and remembers nothing.

pub mod cartoon;
pub mod line;

pub use line::LineFigure;

use crate::pose::Pose;

/// What a pose shows, in a sentence.
pub(crate) fn describe(pose: &Pose) -> String {
    let (emotion, ratio) = pose.ratios.strongest();
    let mood = if ratio >= 0.2 { format!("{emotion} {ratio:.2}") } else { "neutral".to_owned() };
    match pose.shape {
        Some(shape) => format!("A face: {mood}, mouth {shape}."),
        None => format!("A face: {mood}."),
    }
}

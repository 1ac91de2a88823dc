//! How a face deforms: from its neutral points and a pose to the points, lips and lids of that pose (thesis 4.4, 5.5).
//!
//! A [`Neutral`] is made once a face: its points symmetrised, its eyes made a drawing's, its mouth closed. Its
//! [`pose`](Neutral::pose) is a pure function of the [`Pose`](crate::pose::Pose): what the emotions do to each part
//! is data (`emotions.csv`), speech comes on top. It owns no ink and no colour; those are the `figure`'s.
//!
//! Everything is in the face frame: pupil distance 100, origin midway between the pupils, y down.

mod deformed;
mod emotions;
mod eye;
mod landmarks;
mod lips;
mod mouth;
mod neutral;
mod prepare;
mod proportions;

pub use deformed::Deformed;
pub(crate) use emotions::EXPRESSION_NUMBERS;
pub use emotions::{Expression, Expressions};
pub use eye::Eye;
pub use mouth::Mouth;
pub use neutral::Neutral;
pub use proportions::Proportions;

/// `v` brought between `low` and `high`; what is no number counts as 0.
fn within(v: f64, low: f64, high: f64) -> f64 {
    if v.is_nan() { 0f64.max(low).min(high) } else { v.max(low).min(high) }
}

/// 0 below `from`, 1 above `to`, and a smooth way between.
fn smoothstep(from: f64, to: f64, v: f64) -> f64 {
    let t = within((v - from) / (to - from), 0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

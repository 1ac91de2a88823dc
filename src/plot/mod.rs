//! Charts of a clip (paper figs. 4 to 7): ratios, change, timeline, faces with their ratios. And what is seen in a photo:
//! the stages of finding a face (thesis figs. 3.6 to 3.18), its points, contact sheets; and what a model has learned.
//!
//! It makes drawings from plain values; where the values come from and what file the chart goes to is not its
//! business. Colours are told apart by colour-blind eyes (Okabe and Ito 2008), and every curve carries its letter.

mod axes;
mod curves;
mod faces;
mod model;
mod pixels;
mod points;
mod score;
mod sheet;
mod shots;
mod stages;

pub use curves::{Samples, change, ratios};
pub use faces::{faces, frame};
pub use model::model;
pub use points::{face_over, points_over};
pub use score::{Row, timeline};
pub use sheet::sheet;
pub use shots::shots;
pub use stages::stages;

use crate::drawing::Colour;
use crate::pose::Emotion;

/// The colour of an emotion's curve.
#[must_use]
pub(crate) const fn colour_of(emotion: Emotion) -> Colour {
    match emotion {
        Emotion::Neutral => Colour::rgb(0x55, 0x55, 0x55),
        Emotion::Happy => Colour::rgb(0xE6, 0x9F, 0x00),
        Emotion::Anger => Colour::rgb(0xD5, 0x5E, 0x00),
        Emotion::Disgust => Colour::rgb(0x00, 0x9E, 0x73),
        Emotion::Sadness => Colour::rgb(0x00, 0x72, 0xB2),
        Emotion::Fear => Colour::rgb(0xCC, 0x79, 0xA7),
        Emotion::Surprised => Colour::rgb(0x56, 0xB4, 0xE9),
    }
}

const INK: Colour = Colour::rgb(0x22, 0x22, 0x26);
const GREY: Colour = Colour::rgb(0x6E, 0x6E, 0x76);
const RULE: Colour = Colour::rgb(0xE2, 0xE2, 0xE6);

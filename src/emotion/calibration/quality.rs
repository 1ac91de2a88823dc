//! How good a calibration is, as numbers and in words.

use super::calibrate::Known;
use super::{Calibration, Source};
use crate::aam::Model;
use crate::pose::Emotion;

/// How good a calibration is.
#[derive(Debug, Clone, PartialEq)]
pub struct Quality {
    /// How the shape of each emotion came to be.
    pub sources: [Source; 7],
    /// What there is to say, the most important first.
    pub notes: Vec<String>,
}

impl Quality {
    pub(super) fn of(
        calibration: &Calibration,
        _known: &[Option<Known>; 7],
        refused: &[Option<String>; 7],
        _model: &Model,
    ) -> Self {
        let sources = calibration.shapes().each_ref().map(|s| s.source);
        let mut notes = Vec::new();
        for (why, emotion) in refused.iter().zip(Emotion::ALL) {
            if let Some(why) = why {
                notes.push(format!("{emotion}: {why}"));
            }
        }
        Self { sources, notes }
    }
}

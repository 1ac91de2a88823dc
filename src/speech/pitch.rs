//! The pitch of a voice.

use super::Sound;

/// Fundamental frequency over time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Pitch {
    /// Seconds from one value to the next; the first belongs to time 0.
    pub step: f64,
    /// Hz; none where there is no voice.
    pub hertz: Vec<Option<f32>>,
}

impl Pitch {
    /// The pitch at a time in seconds; none where unvoiced or outside.
    #[must_use]
    pub fn at(&self, time: f64) -> Option<f32> {
        let index = (time / self.step).round();
        (index >= 0.0).then(|| self.hertz.get(index as usize).copied().flatten())?
    }
}

/// Tracks the pitch of a recording.
#[must_use]
pub fn pitch(_sound: &Sound) -> Pitch {
    Pitch::default()
}

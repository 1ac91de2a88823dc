//! What a spectrogram strip is drawn from.

use super::Sound;

/// Energy by time and frequency.
#[derive(Debug, Clone, Default)]
pub struct Spectrogram {}

impl Spectrogram {
    /// Computes it, once for a recording.
    #[must_use]
    pub fn of(_sound: &Sound) -> Self {
        Self {}
    }

    /// A picture of the time from `from` to `to`, in seconds: `columns` columns of `rows` values each, from the highest
    /// band to the lowest, 0 (as quiet as the noise) to 1 (the loudest).
    #[must_use]
    pub fn picture(&self, _from: f64, _to: f64, columns: usize, rows: usize) -> Vec<Vec<f32>> {
        vec![vec![0.0; rows]; columns]
    }
}

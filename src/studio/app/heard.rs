//! What is known of a clip's sound besides its wave, and how it is shown.

use std::sync::Arc;

use crate::speech::{Pitch, Spectrogram};

/// The range of a voice shown at least, in semitones: below it a monotone would look like a song.
const LEAST_RANGE: f64 = 9.0;

/// The pitch from which semitones are counted, in Hz; any would do.
const ORIGIN: f64 = 100.0;

/// How sound is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SoundView {
    /// Its outline.
    #[default]
    Wave,
    /// Its frequencies.
    Spectrogram,
    /// One above the other, where there is room.
    Both,
}

impl SoundView {
    /// The one after it.
    #[must_use]
    pub(crate) const fn next(self) -> Self {
        match self {
            Self::Wave => Self::Spectrogram,
            Self::Spectrogram => Self::Both,
            Self::Both => Self::Wave,
        }
    }
}

/// The pitch of a clip, and the range of its speaker.
#[derive(Debug, Clone, PartialEq)]
pub struct Tone {
    pitch: Pitch,
    /// The lowest and the highest that is shown, in semitones above 100 Hz.
    range: (f64, f64),
}

impl Tone {
    /// Measures the speaker's own range: from the 3rd to the 97th hundredth of all voiced moments, so that single
    /// errors an octave off do not stretch it.
    #[must_use]
    pub(crate) fn new(pitch: Pitch) -> Self {
        let mut all: Vec<f64> = pitch.hertz.iter().flatten().map(|h| semitones(*h)).collect();
        all.sort_by(f64::total_cmp);
        let at = |share: f64| all.get(((all.len().max(1) - 1) as f64 * share).round() as usize).copied();
        let (low, high) = (at(0.03).unwrap_or(0.0) - 1.0, at(0.97).unwrap_or(0.0) + 1.0);
        let more = ((LEAST_RANGE - (high - low)) / 2.0).max(0.0);
        Self { pitch, range: (low - more, high + more) }
    }

    /// Where the voice is in the speaker's range between two instants in seconds, 0 (lowest) to 1: the mean of what is
    /// voiced there; none where nothing is.
    #[must_use]
    pub(crate) fn between(&self, from: f64, to: f64) -> Option<f64> {
        let step = self.pitch.step;
        if step <= 0.0 || step.is_nan() {
            return None;
        }
        let first = (from / step).round().max(0.0) as usize;
        let last = ((to / step).round() as usize).max(first + 1).min(self.pitch.hertz.len());
        let voiced: Vec<f64> = self.pitch.hertz.get(first..last)?.iter().flatten().map(|h| semitones(*h)).collect();
        // Half of it unvoiced is a gap.
        if voiced.is_empty() || voiced.len() * 2 < last - first {
            return None;
        }
        let mean = voiced.iter().sum::<f64>() / voiced.len() as f64;
        Some(((mean - self.range.0) / (self.range.1 - self.range.0)).clamp(0.0, 1.0))
    }

    /// The lowest and the highest pitch that is shown, in Hz; none where there is no voice at all.
    #[must_use]
    pub(crate) fn hertz(&self) -> Option<(f64, f64)> {
        let hertz = |semitones: f64| ORIGIN * 2.0_f64.powf(semitones / 12.0);
        self.pitch.hertz.iter().any(Option::is_some).then(|| (hertz(self.range.0), hertz(self.range.1)))
    }
}

fn semitones(hertz: f32) -> f64 {
    12.0 * (f64::from(hertz.max(1.0)) / ORIGIN).log2()
}

/// What was heard of a clip so far.
#[derive(Debug, Clone, Default)]
pub struct Listened {
    /// Its frequencies.
    pub spectrogram: Option<Arc<Spectrogram>>,
    /// Its pitch.
    pub tone: Option<Arc<Tone>>,
    /// Whether threads make the spectrogram and the pitch already.
    pub(in crate::studio) under_way: (bool, bool),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_voice_is_shown_in_semitones_of_its_own_range_with_gaps_left_open() {
        let voiced = (0..100).map(|i| Some(200.0 * 2.0_f32.powf(i as f32 / 100.0)));
        let pitch = Pitch { step: 0.01, hertz: voiced.chain([None; 20]).collect() };
        let tone = Tone::new(pitch);
        let (low, high) = tone.hertz().unwrap();
        assert!((180.0..=200.0).contains(&low) && (400.0..=425.0).contains(&high), "{low} {high}");
        let middle = tone.between(0.5, 0.51).unwrap();
        assert!((middle - 0.5).abs() < 0.05, "half an octave up is half way up: {middle}");
        assert_eq!(tone.between(1.05, 1.1), None);
        assert_eq!(tone.between(9.0, 9.1), None);
        assert_eq!(Tone::new(Pitch::default()).between(0.0, 1.0), None);
    }

    #[test]
    fn a_monotone_does_not_fill_the_lane() {
        let pitch = Pitch { step: 0.01, hertz: (0..50).map(|i| Some(150.0 + (i % 2) as f32)).collect() };
        let (low, high) = Tone::new(pitch).hertz().unwrap();
        assert!(high / low > 1.6, "{low} {high}");
    }
}

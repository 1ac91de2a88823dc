//! How likely a unit is to last so and so long.

use super::features::FRAMES;
use super::units::{UNITS, Unit};

/// How much the times count against the sound: frames that follow each other say much the same, times say something
/// new.
const WEIGHT: f32 = 3.0;

/// The last syllable before a pause is drawn out by so much.
const DRAWN: f32 = 1.35;

/// The longest a unit may last, in frames: a second. What is longer is no longer speech.
const LONGEST: usize = 200;

/// The logarithms of how likely each number of frames is.
#[derive(Debug, Clone)]
pub(crate) struct Lasting {
    /// The fewest frames; the first of the values.
    pub least: usize,
    /// For this number of frames, one more, and so on.
    pub values: Vec<f32>,
}

impl Lasting {
    /// Of a unit: the logarithm of its time is spread normally. `rate` is how many times slower than usual is spoken;
    /// `last`: at the end of the script.
    #[must_use]
    pub(crate) fn of(unit: Unit, rate: f32, last: bool) -> Self {
        let kind = UNITS[usize::from(unit)];
        let frame = 1000.0 / FRAMES as f32;
        let usual = kind.usual * rate * if last { DRAWN } else { 1.0 };
        let least = ((kind.least * rate.min(1.0) / frame).ceil() as usize).max(1);
        let most = ((usual * (3.2 * kind.spread).exp() / frame) as usize).clamp(least + 3, LONGEST);
        let value = |frames: usize| {
            let z = ((frames as f32 * frame).ln() - usual.ln()) / kind.spread;
            WEIGHT * (-0.5 * z * z - kind.spread.ln() - 0.9)
        };
        Self { least, values: (least..=most).map(value).collect() }
    }

    /// For so many frames; far less than anything where they are too few or too many.
    #[must_use]
    pub(crate) fn at(&self, frames: usize) -> f32 {
        frames.checked_sub(self.least).and_then(|i| self.values.get(i)).copied().unwrap_or(-60.0)
    }
}

#[cfg(test)]
mod tests {
    use super::super::units::{CLOSURE, UNITS};
    use super::*;

    #[test]
    fn the_usual_time_is_the_likeliest_and_moves_with_the_rate() {
        for (rate, frames) in [(0.7, 6), (1.0, 9), (2.0, 18)] {
            let lasting = Lasting::of(CLOSURE, rate, false);
            let best = (1..200).max_by(|a, b| lasting.at(*a).total_cmp(&lasting.at(*b)));
            assert_eq!(best, Some(frames));
        }
    }

    #[test]
    fn every_unit_has_times_at_every_rate() {
        for unit in 0..UNITS.len() {
            for rate in [0.4, 1.0, 2.5] {
                let lasting = Lasting::of(unit as Unit, rate, true);
                assert!(lasting.least >= 1 && lasting.values.len() > 3 && lasting.values.iter().all(|v| v.is_finite()));
                assert_eq!((lasting.at(0), lasting.at(1000)), (-60.0, -60.0));
            }
        }
    }
}

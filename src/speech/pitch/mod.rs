//! The pitch of a voice.
//!
//! Every 5 ms the sound is compared with itself some time later: where it is most like itself is a period (`yin`).
//! Several periods may do, a half and a double of the true one among them; the likeliest way through all of them is taken
//! (`path`). This is pYIN (Mauch and Dixon, ICASSP 2014) but for that way, which goes over the candidates themselves, as
//! Boersma's (1993) does, and not over a grid of pitches.

mod path;
mod yin;

use crate::media::Sound;
use crate::media::decimated;

/// Seconds from one value to the next.
const STEP: f64 = 0.005;

/// Samples a second that are looked at, at least: all that a period of 600 Hz needs to be known to 1 %.
const RATE: u32 = 7000;

/// A step this much below the loudest, in dB, has no voice: what is periodic there is hum.
const DEEPEST: f32 = 45.0;

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
    pub(crate) fn at(&self, time: f64) -> Option<f32> {
        let index = (time / self.step).round();
        (index >= 0.0).then(|| self.hertz.get(index as usize).copied().flatten())?
    }

    /// The pitch that lies in the middle of all, in Hz: where a speaker's voice is at home. None without voice.
    #[must_use]
    pub fn median(&self) -> Option<f32> {
        quantile(&self.sorted(), 0.5)
    }

    /// From where to where a speaker's voice goes, in Hz: 95 of 100 values lie between, so that a few wrong ones do not
    /// count. None without voice.
    #[must_use]
    pub fn range(&self) -> Option<(f32, f32)> {
        let sorted = self.sorted();
        Some((quantile(&sorted, 0.025)?, quantile(&sorted, 0.975)?))
    }

    /// The contour of a tone: pitch at `points` times from `from` to `to`, in seconds, both among them, in semitones above
    /// the speaker's median. None where there is no voice.
    #[must_use]
    pub fn contour(&self, from: f64, to: f64, points: usize) -> Vec<Option<f32>> {
        let Some(median) = self.median() else { return vec![None; points] };
        let gap = (to - from) / points.saturating_sub(1).max(1) as f64;
        let time = |point: usize| from + gap * point as f64;
        (0..points).map(|p| self.between(time(p)).map(|hertz| 12.0 * (hertz / median).log2())).collect()
    }

    /// The pitch at a time between two steps, by a straight line; that of the nearer one where the other has no voice.
    fn between(&self, time: f64) -> Option<f32> {
        let place = time / self.step;
        let value = |index: f64| (index >= 0.0).then(|| self.hertz.get(index as usize).copied().flatten())?;
        match (value(place.floor()), value(place.ceil())) {
            (Some(before), Some(after)) => Some(before + (after - before) * place.fract() as f32),
            _ => self.at(time),
        }
    }

    fn sorted(&self) -> Vec<f32> {
        let mut voiced: Vec<f32> = self.hertz.iter().flatten().copied().collect();
        voiced.sort_by(f32::total_cmp);
        voiced
    }
}

fn quantile(sorted: &[f32], share: f64) -> Option<f32> {
    sorted.get((share * sorted.len().saturating_sub(1) as f64).round() as usize).copied()
}

/// Tracks the pitch of a recording from 50 to 600 Hz.
///
/// A recording of fewer than 2000 samples a second has none.
#[must_use]
pub fn pitch(sound: &Sound) -> Pitch {
    let (samples, rate) = decimated(&sound.samples, sound.rate, RATE);
    let count = (sound.duration() / STEP).ceil() as usize;
    if rate < 2000.0 {
        return Pitch { step: STEP, hertz: vec![None; count] };
    }
    let frames = yin::frames(&samples, rate, STEP, count);
    let loudest = frames.iter().map(|f| f.level).fold(f32::MIN, f32::max);
    let heard = frames.into_iter().map(|f| if f.level < loudest - DEEPEST { Vec::new() } else { f.candidates });
    Pitch { step: STEP, hertz: path::without_chance(path::likeliest(&heard.collect::<Vec<_>>()), STEP) }
}

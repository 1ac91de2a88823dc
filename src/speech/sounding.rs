//! Where a recording is not silent.

use super::levels::{LOWEST, STEPS, levels};
use crate::media::Sound;

/// The share of a file's quietest steps that its noise is judged by.
const QUIET: f64 = 0.06;

/// A voice is judged by its loudest steps: this many seconds of them, so that one click does not count.
const LOUD_SECONDS: f64 = 0.2;

/// Noise is taken to be at most this far below the voice, in dB: in a quiet recording what lies lower is breath and the
/// dying away of a room, which people do not count as speech. At 45 the pauses of a real reading are found within
/// 27 ms of where a person set them; at 60 two of its seven pauses are lost in breaths.
const DEEPEST: f64 = 45.0;

/// A voice is at least this loud, in dB below full; dither and a dead cable are not.
const FAINTEST: f64 = -75.0;

/// A file whose voice is less than this above its noise has no silence in it, in dB.
const LEAST_RANGE: f64 = 10.0;

/// Sound begins this share of the way from noise to voice, but from 5 to 12 dB above the noise: steady noise moves
/// by 2 dB, and the weakest consonants lie some 35 dB below a loud vowel.
const SHARE: f64 = 0.25;

/// Sound that has begun goes on until it is this much weaker than where it began, in dB.
const HYSTERESIS: f64 = 2.0;

/// What is shorter is a click, in seconds: 30 ms, and 10 by which the levels widen whatever is in them.
const CLICK: f64 = 0.04;

/// What is nearer to each other is one span, in seconds: longer than the closure of most stops.
const NEAR: f64 = 0.15;

impl Sound {
    /// The spans that are not silence, in seconds, by rising time. The noise of the file
    /// itself decides what silence is; ends are good to 5 ms, spans less than 0.15 s apart are one, clicks are none.
    #[must_use]
    pub fn sounding(&self) -> Vec<(f64, f64)> {
        spans(&self.samples, self.rate)
    }
}

/// The spans that are not silence, in seconds, by rising time; none where all is silent.
///
/// The noise of the file is the level of its quietest 6 %, its voice that of its loudest 0.2 s. A span is where the
/// level stays above a threshold between them and somewhere passes one 2 dB higher. Clicks shorter than 30 ms are
/// dropped, then spans less than 0.15 s apart are joined. Ends are good to the step of 5 ms, not to what a listener
/// would set: a fading vowel ends where it sinks into the noise.
pub(super) fn spans(samples: &[f32], rate: u32) -> Vec<(f64, f64)> {
    let levels = levels(samples, rate);
    let mut sorted = levels.clone();
    sorted.sort_by(f64::total_cmp);
    let Some(last) = sorted.len().checked_sub(1) else { return Vec::new() };
    let loud = ((LOUD_SECONDS * STEPS) as usize).min(sorted.len() / 20);
    let voice = sorted[last - loud];
    let noise = sorted[(sorted.len() as f64 * QUIET) as usize].max(voice - DEEPEST).max(LOWEST);
    if voice < FAINTEST {
        return Vec::new();
    }
    let duration = samples.len() as f64 / f64::from(rate.max(1));
    if voice - noise < LEAST_RANGE {
        return vec![(0.0, duration)];
    }
    let begins = noise + (SHARE * (voice - noise)).clamp(5.0, 12.0);
    let mut spans: Vec<(f64, f64)> = Vec::new();
    for (from, to) in runs(&levels, begins - HYSTERESIS) {
        let (start, end) = (from as f64 / STEPS, (to as f64 / STEPS).min(duration));
        if end - start < CLICK || !levels[from..to].iter().any(|l| *l >= begins) {
            continue;
        }
        match spans.last_mut() {
            Some(before) if start - before.1 < NEAR => before.1 = end,
            _ => spans.push((start, end)),
        }
    }
    spans
}

/// The longest runs of steps at or above a level.
fn runs(levels: &[f64], above: f64) -> Vec<(usize, usize)> {
    let mut runs = Vec::new();
    let mut began = None;
    for (index, level) in levels.iter().chain(std::iter::once(&f64::NEG_INFINITY)).enumerate() {
        match (began, *level >= above) {
            (None, true) => began = Some(index),
            (Some(from), false) => {
                runs.push((from, index));
                began = None;
            }
            _ => {}
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    const RATE: u32 = 16_000;

    /// Two seconds of weak noise with tones of the given spans and loudness over it.
    fn sound(noise: f32, tones: &[(f64, f64, f32)]) -> Vec<f32> {
        let mut state = 1_u32;
        let sample = |i: usize| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let t = i as f64 / f64::from(RATE);
            let tone = tones.iter().find(|(from, to, _)| (*from..*to).contains(&t)).map_or(0.0, |tone| tone.2);
            noise * ((state >> 8) as f32 / (1 << 23) as f32 - 1.0) + tone * (t * 1400.0).sin() as f32
        };
        (0..2 * RATE as usize).map(sample).collect()
    }

    fn near(found: &[(f64, f64)], expected: &[(f64, f64)]) {
        let close = found.len() == expected.len()
            && found.iter().zip(expected).all(|(a, b)| (a.0 - b.0).abs() < 0.011 && (a.1 - b.1).abs() < 0.016);
        assert!(close, "{found:?}, not {expected:?}");
    }

    #[test]
    fn sound_is_found_in_digital_silence_and_in_noise_within_fifteen_milliseconds() {
        for noise in [0.0, 0.001, 0.02] {
            near(&spans(&sound(noise, &[(0.5, 0.9, 0.5), (1.3, 1.7, 0.3)]), RATE), &[(0.5, 0.9), (1.3, 1.7)]);
        }
    }

    #[test]
    fn near_spans_are_one_and_clicks_are_none() {
        near(&spans(&sound(0.001, &[(0.5, 0.9, 0.5), (1.0, 1.2, 0.5), (1.7, 1.71, 0.9)]), RATE), &[(0.5, 1.2)]);
    }

    #[test]
    fn silence_has_no_spans_and_sound_without_silence_is_one() {
        assert!(spans(&sound(0.0, &[]), RATE).is_empty());
        assert!(spans(&[], RATE).is_empty());
        assert!(spans(&sound(0.000_05, &[]), RATE).is_empty(), "dither");
        near(&spans(&sound(0.0, &[(0.0, 2.0, 0.5)]), RATE), &[(0.0, 2.0)]);
    }

    #[test]
    fn any_rate_does() {
        for rate in [1, 7, 200, 1000, 192_000] {
            let samples: Vec<f32> =
                (0..rate * 2).map(|i| if i > rate { 0.5 } else { 0.0 } * (-1_f32).powi(i as i32)).collect();
            let _ = spans(&samples, rate);
        }
    }

    #[test]
    fn a_steady_offset_and_hum_are_silence() {
        let mut samples = sound(0.001, &[(0.5, 0.9, 0.4)]);
        for (i, s) in samples.iter_mut().enumerate() {
            *s += 0.2 + 0.05 * (i as f32 / RATE as f32 * 50.0 * std::f32::consts::TAU * 0.4).sin();
        }
        near(&spans(&samples, RATE), &[(0.5, 0.9)]);
    }
}

//! How good a recording is for finding speech in it, in figures and in words to whoever recorded it.

use std::f64::consts::TAU;

use super::levels::{LOWEST, STEPS, levels};
use crate::media::Sound;

/// How good a recording is. Levels are in dB below full scale, root mean square unless they are called peaks.
#[derive(Debug, Clone, PartialEq)]
pub struct Quality {
    /// The largest sample; [`f64::NEG_INFINITY`] where all are 0.
    pub peak_db: f64,
    /// The mean level where there is speech, above 70 Hz, noise included.
    pub voice_db: f64,
    /// The level of the noise between speech, above 70 Hz, at least −120.
    pub noise_db: f64,
    /// How far the voice stands out of the noise, in dB. A recording without any pause, in which noise cannot be
    /// told from voice, has less than it deserves.
    pub snr_db: f64,
    /// The share of samples, 0 to 1, in which the sound was too loud for its recorder: at the largest size, at least
    /// three in a row.
    pub clipped: f64,
    /// The mean of all samples, −1 to 1; 0 where a recorder works as it should.
    pub offset: f64,
    /// The hum of mains: its frequency, 50 or 60 Hz, and its level with its first harmonics, where it stands out of
    /// what is beside it.
    pub hum: Option<(f64, f64)>,
    /// Channels in which there is nothing while there is something in others, counted from 1.
    pub silent_channels: Vec<usize>,
    /// Samples a second.
    pub rate: u32,
}

/// The share of steps that are taken for the noise: those at and below it are quieter.
const QUIET: f64 = 0.08;

/// Steady noise moves about its mean; its quietest tenth of 10 ms lies this much below it, in dB.
const BELOW_MEAN: f64 = 1.5;

/// What stands this share of the way from noise to the loudest above the noise is speech, in dB.
const SPEECH: f64 = 0.5;

/// Below this the voice is too weak to be well recorded, in dB.
const WEAK: f64 = -45.0;

/// Below this the noise is in the way of weak consonants, in dB. Speech with noise mixed to 20 dB measures 21 to 23
/// here, to 10 dB 12 to 15.5, real rooms 27 and more.
const NOISY: f64 = 17.0;

/// As many samples of a million may lie at the largest size by chance.
const CHANCE: f64 = 100e-6;

/// A mean beyond this is a fault of the recorder.
const OFFSET: f64 = 0.02;

/// A hum matters where it comes this near to the voice, in dB.
const HUM: f64 = 35.0;

/// Samples a second below which s, x and sh can hardly be told apart.
const POOR_RATE: u32 = 11_000;

impl Sound {
    /// Measures how good the recording is.
    #[must_use]
    pub fn quality(&self) -> Quality {
        let levels = levels(&self.samples, self.rate);
        let (noise_db, voice_db) = noise_and_voice(&levels);
        let peak = self.samples.iter().fold(0.0_f32, |peak, s| peak.max(s.abs()));
        let count = self.samples.len().max(1) as f64;
        let loudest = self.sides.iter().copied().fold(0.0, f64::max);
        let silent = |side: &f64| loudest > 1e-4 && *side < loudest * 1e-3;
        Quality {
            peak_db: 20.0 * f64::from(peak).log10(),
            voice_db,
            noise_db,
            snr_db: (voice_db - noise_db).max(0.0),
            clipped: clipped(&self.samples, peak) as f64 / count,
            offset: self.samples.iter().map(|s| f64::from(*s)).sum::<f64>() / count,
            hum: hum(&self.samples, self.rate, &levels),
            silent_channels: (1..)
                .zip(&self.sides)
                .filter(|(_, side)| silent(side))
                .map(|(number, _)| number)
                .collect(),
            rate: self.rate,
        }
    }
}

impl Quality {
    /// Whether the noise is in the way of weak consonants.
    #[must_use]
    pub(crate) fn is_noisy(&self) -> bool {
        self.snr_db < NOISY
    }

    /// What is not as it should be, a sentence each, the worst first; nothing where all is well.
    #[must_use]
    pub fn remarks(&self) -> Vec<String> {
        let mut remarks = Vec::new();
        if self.voice_db < -75.0 {
            return vec!["there is nothing to be heard: was the microphone on?".to_owned()];
        }
        if self.clipped > CHANCE {
            let share = self.clipped * 100.0;
            let said = if share < 0.1 { "some loud places are".to_owned() } else { format!("{share:.1} % of it is") };
            remarks.push(format!("{said} clipped: record again with the microphone turned down"));
        }
        if self.is_noisy() {
            let snr = self.snr_db.round();
            remarks.push(format!(
                "noisy: the voice stands only {snr} dB above the noise, and times of weak sounds may be wrong; 20 dB are good"
            ));
        }
        if self.voice_db < WEAK {
            let below = -self.voice_db.round();
            remarks.push(format!("very quiet: the voice lies {below} dB below full; 20 to 30 are good"));
        }
        if let Some((hertz, level)) = self.hum.filter(|(_, level)| *level > self.voice_db - HUM) {
            let below = (self.voice_db - level).round();
            remarks.push(format!("a hum of {hertz} Hz lies {below} dB below the voice: look at cables and supplies"));
        }
        if self.offset.abs() > OFFSET {
            remarks.push(format!("its middle lies at {:.3} and not at 0: the recorder is at fault", self.offset));
        }
        match self.silent_channels.as_slice() {
            [] => {}
            [one] => remarks.push(format!("channel {one} is silent")),
            several => {
                let numbers: Vec<String> = several.iter().map(usize::to_string).collect();
                remarks.push(format!("channels {} are silent", numbers.join(", ")));
            }
        }
        if self.rate < POOR_RATE {
            remarks.push(format!(
                "{} samples a second are few: s, x and sh sound alike; 16000 or more are good",
                self.rate
            ));
        }
        remarks
    }
}

/// The level of the noise, from the quietest steps, and the mean level of speech.
fn noise_and_voice(levels: &[f64]) -> (f64, f64) {
    let mut sorted = levels.to_vec();
    sorted.sort_by(f64::total_cmp);
    let Some(last) = sorted.last() else { return (LOWEST, LOWEST) };
    // Levels of exact nothing are before and behind the recording, or a cut.
    let heard = sorted.partition_point(|level| *level <= LOWEST);
    let quiet = sorted.get(heard + ((sorted.len() - heard) as f64 * QUIET) as usize).copied().unwrap_or(LOWEST);
    let noise = if heard as f64 > QUIET * sorted.len() as f64 { LOWEST } else { quiet + BELOW_MEAN };
    let loud = last - (last - noise) * SPEECH;
    let power = |level: &f64| 10.0_f64.powf(level / 10.0);
    let speech: Vec<f64> = levels.iter().filter(|level| **level >= loud).map(power).collect();
    let voice = 10.0 * (speech.iter().sum::<f64>() / speech.len().max(1) as f64).log10();
    (noise.max(LOWEST), voice.max(LOWEST))
}

/// How many samples lie at the largest size, three or more in a row: the flat tops of what was cut off.
fn clipped(samples: &[f32], peak: f32) -> usize {
    // What is weak is not cut off; of 8 bits the last step is 1/128.
    if peak < 0.25 {
        return 0;
    }
    let edge = peak * (1.0 - 2e-4);
    let (mut count, mut run, mut side) = (0, 0, 0.0_f32);
    for sample in samples.iter().chain(std::iter::once(&0.0)) {
        let at_edge = sample.abs() >= edge;
        if at_edge && (run == 0 || sample.signum() == side) {
            run += 1;
        } else {
            count += if run >= 3 { run } else { 0 };
            run = usize::from(at_edge);
        }
        side = sample.signum();
    }
    count
}

/// The hum of mains in the quietest half second: 50 or 60 Hz with two harmonics, where each of at least two of them
/// stands 10 dB above what lies 7 Hz beside it.
fn hum(samples: &[f32], rate: u32, levels: &[f64]) -> Option<(f64, f64)> {
    let window = rate as usize / 2;
    let steps = (STEPS / 2.0) as usize;
    if samples.len() < window || window < 500 {
        return None;
    }
    let quietest = levels.windows(steps).step_by(steps / 4).enumerate().min_by(|(_, a), (_, b)| {
        let power = |levels: &[f64]| levels.iter().map(|level| 10.0_f64.powf(level / 10.0)).sum::<f64>();
        power(a).total_cmp(&power(b))
    });
    let at = quietest.map_or(0, |(index, _)| index * (steps / 4)) as f64 / STEPS * f64::from(rate);
    let part = &samples[(at as usize).min(samples.len() - window)..][..window];
    let mean = part.iter().map(|s| f64::from(*s)).sum::<f64>() / window as f64;
    // The power of a tone of that frequency, under a Hann window, whose main lobe is 8 Hz wide.
    let power = |hertz: f64| {
        let (mut re, mut im) = (0.0, 0.0);
        for (index, sample) in part.iter().enumerate() {
            let place = index as f64 / window as f64;
            let value = (f64::from(*sample) - mean) * (1.0 - (TAU * place).cos());
            let angle = TAU * hertz * index as f64 / f64::from(rate);
            re += value * angle.cos();
            im += value * angle.sin();
        }
        2.0 * (re * re + im * im) / (window as f64 * window as f64)
    };
    let found = [50.0, 60.0].into_iter().filter_map(|mains| {
        let mut clear = 0;
        let mut sum = 0.0;
        for harmonic in [1.0, 2.0, 3.0] {
            let hertz = mains * harmonic;
            let tone = power(hertz);
            let beside = power(hertz - 7.0).max(power(hertz + 7.0));
            clear += usize::from(tone > 10.0 * beside);
            sum += tone;
        }
        (clear >= 2 && sum > 1e-10).then(|| (mains, 10.0 * sum.log10()))
    });
    found.max_by(|a, b| a.1.total_cmp(&b.1))
}

#[cfg(test)]
mod tests {
    use super::*;

    const RATE: u32 = 16_000;

    /// Two seconds: bursts of a voice of 150 Hz with harmonics, 0.2 s on and 0.2 s off, and steady noise.
    fn speech(size: f32, noise: f32) -> Vec<f32> {
        let mut state = 1_u32;
        let sample = |i: usize| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let t = i as f64 / f64::from(RATE);
            let voice: f64 =
                (1..12).map(|k| (t * 150.0 * TAU * f64::from(k) + f64::from(k * k)).sin() / f64::from(k)).sum();
            let on = if (t * 5.0).fract() < 0.5 { size } else { 0.0 };
            noise * ((state >> 8) as f32 / (1 << 23) as f32 - 1.0) + on * voice as f32
        };
        (0..2 * RATE as usize).map(sample).collect()
    }

    fn remarks(samples: Vec<f32>) -> Vec<String> {
        Sound::new(RATE, samples).quality().remarks()
    }

    #[test]
    fn a_good_recording_is_passed_without_remark() {
        assert!(remarks(speech(0.2, 0.001)).is_empty(), "{:?}", remarks(speech(0.2, 0.001)));
        assert!(remarks(speech(0.2, 0.0)).is_empty());
    }

    #[test]
    fn what_is_wrong_is_said_and_nothing_else() {
        let clipped = speech(0.5, 0.001).iter().map(|s| s.clamp(-0.6, 0.6)).collect();
        let offset = speech(0.2, 0.001).iter().map(|s| s + 0.05).collect();
        let hum = speech(0.2, 0.001).into_iter().enumerate().map(|(i, s)| {
            let angle = i as f64 / f64::from(RATE) * 50.0 * TAU;
            s + (0.02 * angle.sin() + 0.01 * (2.0 * angle).sin()) as f32
        });
        for (samples, said) in [
            (clipped, "clipped"),
            (speech(0.2, 0.2), "noisy"),
            (speech(0.004, 0.000_02), "very quiet"),
            (hum.collect(), "hum of 50 Hz"),
            (offset, "middle lies at 0.050"),
            (vec![0.0; 8_000], "nothing to be heard"),
            (Vec::new(), "nothing to be heard"),
        ] {
            let found = remarks(samples);
            assert!(found.len() == 1 && found[0].contains(said), "{said}: {found:?}");
        }
        let low = Sound::new(8_000, speech(0.2, 0.001)).quality().remarks();
        assert!(low.len() == 1 && low[0].contains("8000 samples"), "{low:?}");
    }

    #[test]
    fn the_distance_of_voice_and_noise_is_what_was_mixed() {
        for noise in [0.003_f32, 0.01, 0.03, 0.1] {
            let samples = speech(0.2, noise);
            let voice = speech(0.2, 0.0);
            let on: Vec<f64> = voice.iter().filter(|s| **s != 0.0).map(|s| f64::from(*s).powi(2)).collect();
            let truth = 10.0 * (on.iter().sum::<f64>() / on.len() as f64 / (f64::from(noise).powi(2) / 3.0)).log10();
            let found = Sound::new(RATE, samples).quality().snr_db;
            assert!((found - truth).abs() < 2.0, "{found} instead of {truth}");
        }
    }

    #[test]
    fn any_samples_at_any_rate_have_a_quality() {
        for rate in [1, 999, 1_000, 8_000, 768_000] {
            for samples in [vec![1.0; 2_000], vec![0.0; 3], [-1.0, 1.0].repeat(4_000)] {
                let quality = Sound::new(rate, samples).quality();
                assert!(quality.snr_db >= 0.0 && quality.clipped <= 1.0 && !quality.remarks().is_empty());
            }
        }
    }
}

//! Where syllables are, without knowing which: nuclei and pauses, for an author to type words onto.
//!
//! A syllable has a vowel, and a vowel is loud and has a voice (after de Jong and Wempe 2009). So its nucleus is a peak of
//! sonority between two dips, with pitch at it.

use super::Pitch;
use super::pitch::pitch;
use super::sonority::{STEPS, sonority};
use crate::media::Sound;

/// How far sonority falls between two syllables at least, in dB.
const DIP: f32 = 2.0;

/// A nucleus is at most so much weaker than the loudest, in dB.
const RANGE: f32 = 25.0;

/// A nucleus without pitch is at most so much weaker than the loudest, in dB: voices creak and whisper, but what is both
/// weak and without pitch is a consonant.
const ROUGH: f32 = 12.0;

/// What counts as the loudest: this share of what sounds is weaker.
const LOUD: f64 = 0.95;

/// A syllable begins where sonority comes within this share of the depth of the dip, measured from its bottom: the bottom
/// lies in the middle of a consonant.
const ONSET: f32 = 0.2;

/// What is heard in a recording without a script.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Heard {
    /// Each syllable's start and end, in seconds, by rising time.
    pub syllables: Vec<(f64, f64)>,
    /// Where each is most a vowel, in seconds.
    pub nuclei: Vec<f64>,
    /// The pauses between, before and after them, in seconds.
    pub pauses: Vec<(f64, f64)>,
}

/// Marks the syllables of a recording.
#[must_use]
pub fn nuclei(sound: &Sound) -> Heard {
    let curve = sonority(&sound.samples, sound.rate);
    let pitch = pitch(sound);
    let spans = sound.sounding();
    let step = |time: f64| ((time * STEPS).round() as usize).min(curve.len());
    let mut levels: Vec<f32> =
        spans.iter().flat_map(|(from, to)| curve[step(*from)..step(*to)].iter().copied()).collect();
    levels.sort_by(f32::total_cmp);
    let loud = levels.get((levels.len() as f64 * LOUD) as usize).copied().unwrap_or(0.0);
    let mut heard = Heard::default();
    for span in &spans {
        let (first, last) = (step(span.0), step(span.1));
        let peaks: Vec<usize> = peaks(&curve[first..last], DIP)
            .into_iter()
            .map(|p| p + first)
            .filter(|p| curve[*p] > loud - if voiced(&pitch, *p) { RANGE } else { ROUGH })
            .collect();
        let dips: Vec<f64> = peaks.windows(2).map(|pair| onset(&curve, pair[0], pair[1]) as f64 / STEPS).collect();
        let edges: Vec<f64> = std::iter::once(span.0).chain(dips).chain(std::iter::once(span.1)).collect();
        if peaks.is_empty() {
            continue;
        }
        heard.syllables.extend(edges.windows(2).map(|pair| (pair[0], pair[1])));
        heard.nuclei.extend(peaks.iter().map(|p| *p as f64 / STEPS));
    }
    let mut at = 0.0;
    for (start, end) in heard.syllables.iter().copied().chain([(sound.duration(), sound.duration())]) {
        if start - at > 1e-9 {
            heard.pauses.push((at, start));
        }
        at = end;
    }
    heard
}

/// The peaks between which the curve falls at least so far below both.
fn peaks(curve: &[f32], dip: f32) -> Vec<usize> {
    let mut out = Vec::new();
    let (mut high, mut low, mut rising) = (0, 0, true);
    for (i, value) in curve.iter().enumerate() {
        if rising {
            if *value > curve[high] {
                high = i;
            } else if *value < curve[high] - dip {
                out.push(high);
                (low, rising) = (i, false);
            }
        } else if *value < curve[low] {
            low = i;
        } else if *value > curve[low] + dip {
            (high, rising) = (i, true);
        }
    }
    if rising && !curve.is_empty() {
        out.push(high);
    }
    out
}

fn voiced(pitch: &Pitch, peak: usize) -> bool {
    (peak.saturating_sub(4)..=peak + 4).filter(|i| pitch.hertz.get(*i).copied().flatten().is_some()).count() >= 3
}

/// Where between two peaks the second syllable begins.
fn onset(curve: &[f32], from: usize, to: usize) -> usize {
    let low = curve[from..to].iter().copied().fold(f32::INFINITY, f32::min);
    let enough = low + ONSET * (curve[from].min(curve[to]) - low);
    (from..to).find(|i| curve[*i] <= enough).unwrap_or(from)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Vowels of a fifth of a second each, with a tenth of weak sound between, in silence.
    fn said(count: usize, rate: u32) -> Sound {
        let samples = (0..rate as usize * (count + 2) * 3 / 10).map(|i| {
            let time = i as f64 / f64::from(rate) - 0.3;
            let (number, inside) = (time / 0.3, time.rem_euclid(0.3));
            let loud = if !(0.0..count as f64).contains(&number) {
                0.0
            } else if inside < 0.2 {
                0.4 * (inside / 0.2 * std::f64::consts::PI).sin()
            } else {
                0.01
            };
            let harmonics = (1..20).map(|h| (std::f64::consts::TAU * 150.0 * f64::from(h) * time).sin() / f64::from(h));
            (loud * harmonics.sum::<f64>()) as f32
        });
        Sound::new(rate, samples.collect())
    }

    #[test]
    fn each_vowel_is_a_syllable_at_any_rate() {
        for rate in [8000, 16_000, 44_100, 48_000] {
            let heard = nuclei(&said(5, rate));
            assert_eq!(heard.nuclei.len(), 5, "{rate}: {heard:?}");
            for (number, (nucleus, (start, end))) in heard.nuclei.iter().zip(&heard.syllables).enumerate() {
                let middle = 0.4 + 0.3 * number as f64;
                assert!((nucleus - middle).abs() < 0.03 && *start < middle && *end > middle, "{rate}: {heard:?}");
            }
            assert_eq!(heard.pauses.len(), 2, "before and after");
            assert!(heard.pauses[0].0 == 0.0 && (heard.pauses[1].1 - 2.1).abs() < 1e-3);
        }
    }

    #[test]
    fn silence_and_nothing_have_none() {
        assert_eq!(nuclei(&Sound::default()), Heard::default());
        let silence = nuclei(&Sound::new(16_000, vec![0.0; 16_000]));
        assert_eq!((silence.syllables.len(), silence.pauses), (0, vec![(0.0, 1.0)]));
        let _ = nuclei(&Sound::new(1, vec![0.5; 3]));
    }
}

//! The pitch of a voice: against sounds made with a pitch that is known, against another method on speech, and in the
//! shapes of Mandarin's tones.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use crate::support::test_data;
use std::f64::consts::TAU;
use std::path::Path;

use lianpu::media::Sound;
use lianpu::speech::{Pitch, pitch};

/// Semitones above the middle of a voice, from the start to the end of a syllable: the four tones in Chao's five levels
/// (55, 35, 214, 51), a level for 2.5 semitones.
const TONES: [&[f64]; 4] = [&[5.0, 5.0], &[0.0, 5.0], &[-2.5, -5.0, -5.0, 2.5], &[5.0, -5.0]];

/// Seconds of a syllable's vowel, and of the hiss or silence before the next.
const VOWEL: f64 = 0.25;
const GAP: f64 = 0.15;

/// Formants of a, i, u: frequency and bandwidth in Hz.
const VOWELS: [[(f64, f64); 3]; 3] = [
    [(800.0, 80.0), (1200.0, 90.0), (2600.0, 120.0)],
    [(300.0, 60.0), (2300.0, 100.0), (3000.0, 120.0)],
    [(350.0, 60.0), (700.0, 80.0), (2500.0, 120.0)],
];

struct Dice(u32);

impl Dice {
    /// From −1 to 1.
    fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(self.0 >> 8) / f64::from(1 << 23) - 1.0
    }
}

/// The pitch at a time of a voice that says the four tones one after the other.
fn known(home: f64, time: f64) -> Option<f64> {
    let (syllable, inside) = ((time / (VOWEL + GAP)) as usize, time % (VOWEL + GAP));
    let tone = TONES[syllable % 4];
    let place = inside / VOWEL * (tone.len() - 1) as f64;
    let at = (place as usize).min(tone.len() - 2);
    (inside < VOWEL).then(|| home * 2.0_f64.powf((tone[at] + (tone[at + 1] - tone[at]) * (place - at as f64)) / 12.0))
}

/// A voice made by a pulse train of that pitch through formants, hiss of consonants between, and steady noise `snr` dB
/// below it.
fn voice(rate: u32, home: f64, snr: f64) -> Sound {
    let mut dice = Dice(home as u32);
    let count = (12.0 * (VOWEL + GAP) * f64::from(rate)) as usize;
    let (mut phase, mut tilt) = (0.0_f64, 0.0_f64);
    let mut formants = [[0.0_f64; 2]; 3];
    let mut samples: Vec<f64> = (0..count)
        .map(|i| {
            let time = i as f64 / f64::from(rate);
            let syllable = (time / (VOWEL + GAP)) as usize;
            let source = known(home, time).map_or(0.0, |hertz| {
                phase = (phase + hertz / f64::from(rate)).fract();
                // A saw as a glottis: harmonics that fall by 6 dB an octave, without those above half the rate.
                let most = (0.45 * f64::from(rate) / hertz) as usize;
                let inside = time % (VOWEL + GAP);
                let loud = (inside / 0.03).min((VOWEL - inside) / 0.05).clamp(0.0, 1.0);
                loud * (1..=most.min(60)).map(|h| (TAU * phase * h as f64).sin() / h as f64).sum::<f64>()
            });
            tilt += 0.3 * (source - tilt);
            let mut out = tilt;
            for (state, (hertz, width)) in formants.iter_mut().zip(VOWELS[syllable % 3]) {
                let pole = (-std::f64::consts::PI * width / f64::from(rate)).exp();
                let a = 2.0 * pole * (TAU * hertz / f64::from(rate)).cos();
                let y = (1.0 - a + pole * pole) * out + a * state[0] - pole * pole * state[1];
                *state = [y, state[0]];
                out = y;
            }
            out
        })
        .collect();
    let voiced: Vec<f64> =
        (0..count).filter(|i| known(home, *i as f64 / f64::from(rate)).is_some()).map(|i| samples[i]).collect();
    let loudness = (voiced.iter().map(|s| s * s).sum::<f64>() / voiced.len() as f64).sqrt();
    for (i, sample) in samples.iter_mut().enumerate() {
        let inside = (i as f64 / f64::from(rate)) % (VOWEL + GAP) - VOWEL;
        let hiss = if inside > 0.05 && inside < 0.12 { 0.3 } else { 0.0 };
        *sample += loudness * dice.roll() * 3.0_f64.sqrt() * (10.0_f64.powf(-snr / 20.0) + hiss);
    }
    Sound::new(rate, samples.iter().map(|s| (0.1 * s / loudness) as f32).collect())
}

/// Steps that were compared, those wrong by more than 20 %, those voiced and not found so, those found so and not voiced.
#[derive(Default, Debug)]
struct Errors {
    both: usize,
    gross: usize,
    missed: usize,
    made: usize,
    steps: usize,
    /// The sum of differences of those that are not wrong, in semitones.
    fine: f64,
}

impl Errors {
    fn count(&mut self, truth: Option<f64>, found: Option<f32>) {
        self.steps += 1;
        match (truth, found.map(f64::from)) {
            (Some(truth), Some(found)) => {
                self.both += 1;
                if (found / truth - 1.0).abs() > 0.2 {
                    self.gross += 1;
                } else {
                    self.fine += (12.0 * (found / truth).log2()).abs();
                }
            }
            (Some(_), None) => self.missed += 1,
            (None, Some(_)) => self.made += 1,
            (None, None) => {}
        }
    }

    fn gross(&self) -> f64 {
        self.gross as f64 / self.both.max(1) as f64
    }

    fn voicing(&self) -> f64 {
        (self.missed + self.made) as f64 / self.steps.max(1) as f64
    }

    fn say(&self, what: &str) {
        let fine = self.fine / (self.both - self.gross).max(1) as f64;
        let [gross, voicing] = [self.gross(), self.voicing()].map(|share| share * 100.0);
        println!(
            "pitch, {what}: {} steps, gross error {gross:.2} %, of the others {fine:.2} semitones, voicing wrong {voicing:.1} % ({} missed, {} made)",
            self.both, self.missed, self.made
        );
    }
}

#[test]
fn tones_of_every_voice_are_followed_in_quiet_and_in_noise() {
    for (snr, gross, voicing) in [(60.0, 0.01, 0.10), (20.0, 0.01, 0.10), (10.0, 0.03, 0.20)] {
        let mut all = Errors::default();
        for (rate, homes) in [(16_000, vec![80.0, 110.0, 160.0, 220.0, 300.0, 400.0]), (44_100, vec![100.0, 200.0])] {
            for home in homes {
                let found = pitch(&voice(rate, home, snr));
                let mut own = Errors::default();
                for (step, hertz) in found.hertz.iter().enumerate() {
                    let time = step as f64 * found.step;
                    own.count(known(home, time), *hertz);
                    all.count(known(home, time), *hertz);
                }
                assert!(own.gross() <= 0.03, "{home} Hz at {snr} dB: {own:?}");
            }
        }
        all.say(&format!("tones at {snr:.0} dB"));
        assert!(all.gross() <= gross && all.voicing() <= voicing, "{all:?}");
        assert!(all.both > 2000);
    }
}

#[test]
fn noise_hum_and_silence_have_no_pitch() {
    let mut dice = Dice(7);
    let noise = pitch(&Sound::new(16_000, (0..32_000).map(|_| (0.3 * dice.roll()) as f32).collect()));
    assert!(noise.hertz.iter().flatten().count() < noise.hertz.len() / 20, "{:?}", noise.range());
    let silence = pitch(&Sound::new(16_000, vec![0.0; 16_000]));
    assert_eq!(silence.hertz, vec![None; 200]);
    assert_eq!((silence.median(), silence.range()), (None, None));
    assert_eq!(silence.contour(0.0, 1.0, 3), vec![None; 3]);
    assert_eq!(pitch(&Sound::default()).hertz, Vec::new());
    // Hum under a voice that speaks from 0.25 s on, 40 dB below it.
    let said = voice(16_000, 200.0, 90.0);
    let hum = |i: usize| 0.001 * (TAU * 50.0 * i as f64 / 16_000.0).sin() as f32;
    let pause = (0..8000).map(hum);
    let with_hum = pause.chain(said.samples.iter().enumerate().map(|(i, s)| s + hum(i))).collect();
    let found = pitch(&Sound::new(16_000, with_hum));
    assert!(found.range().unwrap().0 > 120.0, "{:?}", found.range());
}

#[test]
fn a_contour_is_in_semitones_about_the_median_and_leaves_gaps_open() {
    let found = pitch(&voice(16_000, 150.0, 40.0));
    let start = |syllable: f64| syllable * (VOWEL + GAP);
    let level = found.contour(start(0.0) + 0.05, start(0.0) + 0.2, 4);
    assert_eq!(level.len(), 4);
    assert!(level.iter().all(|p| (p.unwrap() - level[0].unwrap()).abs() < 0.3), "{level:?}");
    let rising = found.contour(start(1.0) + 0.05, start(1.0) + 0.2, 4);
    assert!((rising[3].unwrap() - rising[0].unwrap() - 3.0).abs() < 0.4, "{rising:?}");
    let falling = found.contour(start(3.0) + 0.05, start(3.0) + 0.2, 4);
    assert!((falling[3].unwrap() - falling[0].unwrap() + 6.0).abs() < 0.6, "{falling:?}");
    let across = found.contour(start(0.0), start(2.0), 81);
    // The end of a syllable, and the silence after its hiss.
    assert!(across[20].is_some() && across[38].is_none(), "{across:?}");
    let (low, high) = found.range().unwrap();
    assert!((low - 113.0).abs() < 8.0 && (high - 200.0).abs() < 12.0, "{low} {high}");
}

/// Boersma's (1993) autocorrelation of a window divided by that of the window itself, where it leaves no doubt: an
/// independent way to a period, for strongly voiced places only.
fn by_autocorrelation(sound: &Sound, time: f64) -> Option<f64> {
    let rate = f64::from(sound.rate);
    let (middle, half) = ((time * rate) as usize, (0.03 * rate) as usize);
    let part = sound.samples.get(middle.checked_sub(half)?..middle + half)?;
    let mean = part.iter().sum::<f32>() / part.len() as f32;
    let window: Vec<f64> = (0..part.len()).map(|i| 0.5 - 0.5 * (TAU * i as f64 / part.len() as f64).cos()).collect();
    let weighed: Vec<f64> = part.iter().zip(&window).map(|(s, w)| f64::from(s - mean) * w).collect();
    let likeness = |values: &[f64], lag: usize| values.iter().zip(&values[lag..]).map(|(a, b)| a * b).sum::<f64>();
    let whole = likeness(&weighed, 0) / likeness(&window, 0);
    if whole < 1e-4 {
        return None;
    }
    let at = |lag: usize| likeness(&weighed, lag) / likeness(&window, lag) / whole;
    let (first, last) = ((rate / 500.0) as usize, (rate / 60.0) as usize);
    let values: Vec<f64> = (first..=last).map(at).collect();
    // A little is taken off for each octave down, so that of a period and its double the period is chosen.
    let worth = |i: usize| values[i] - 0.08 * ((first + i) as f64 / first as f64).log2();
    let best = (1..values.len() - 1)
        .filter(|i| values[*i] > values[i - 1] && values[*i] >= values[i + 1])
        .max_by(|a, b| worth(*a).total_cmp(&worth(*b)))?;
    (values[best] > 0.9).then(|| rate / (first + best) as f64)
}

fn recordings(folder: &Path, ending: &str) -> Vec<std::path::PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path());
    let mut found: Vec<_> = entries.filter(|p| p.to_string_lossy().ends_with(ending)).collect();
    found.sort();
    found
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn on_speech_it_agrees_with_another_method_where_that_is_sure() {
    for (kind, ending) in
        [("espeak", "_150.wav"), ("espeak", "_snr20.wav"), ("mbrola", ".wav"), ("real", ".wav"), ("self", ".wav")]
    {
        let Some(folder) = test_data::find(&format!("speech/{kind}")) else { return };
        let mut all = Errors::default();
        for file in recordings(&folder, ending) {
            let sound = Sound::read(&file).unwrap();
            // The noisy are compared with what is found in them without noise.
            let clean = file.to_string_lossy().replace("_snr20", "");
            let clean = Sound::read(Path::new(&clean)).unwrap();
            let found = pitch(&sound);
            for step in (8..found.hertz.len()).step_by(8) {
                if let Some(truth) = by_autocorrelation(&clean, step as f64 * found.step) {
                    all.count(Some(truth), found.hertz[step]);
                }
            }
        }
        all.say(&format!("{kind} (*{ending}) against autocorrelation"));
        assert!(all.both > 100 && all.gross() <= 0.03, "{kind}: {all:?}");
        assert!(all.missed * 20 <= all.steps, "{kind}: {all:?}");
    }
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn the_tones_of_espeak_have_their_shapes() {
    let Some(folder) = test_data::find("speech/espeak") else { return };
    let truth = std::fs::read_to_string(folder.join("truth.csv")).unwrap();
    let mut before: Option<(String, Pitch)> = None;
    let (mut right, mut all) = (0, 0);
    for row in truth.lines().skip(1) {
        let [file, _, _, pinyin, start, end, snr] = row.split(',').collect::<Vec<_>>().try_into().unwrap();
        if snr != "clean" || !file.ends_with("m0_150") {
            continue;
        }
        let known = before.take().filter(|(name, _)| name == file);
        let (name, found) = known
            .unwrap_or_else(|| (file.to_owned(), pitch(&Sound::read(&folder.join(format!("{file}.wav"))).unwrap())));
        let (start, end): (f64, f64) = (start.parse().unwrap(), end.parse().unwrap());
        let contour: Vec<f32> = found.contour(start, end, 40).into_iter().flatten().collect();
        if let (Some(first), Some(last)) = (contour.get(2), contour.iter().rev().nth(2)) {
            match pinyin.chars().last() {
                Some('4') => (right, all) = (right + usize::from(last < first), all + 1),
                Some('2') => (right, all) = (right + usize::from(last > first), all + 1),
                Some('1') => (right, all) = (right + usize::from((last - first).abs() < 2.0), all + 1),
                _ => {}
            }
        }
        before = Some((name, found));
    }
    println!("pitch, tones 1, 2 and 4 of espeak: {right} of {all} level, rising, falling");
    assert!(all > 50 && right * 100 >= all * 95);
}

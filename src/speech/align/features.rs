//! What the aligner hears: 26 numbers every 5 ms, from a recording at 16 kHz.
//!
//! The voice is brought to one level, freed of hum (70 Hz high-pass) and given its treble back (pre-emphasis); of every
//! 25 ms come 26 mel bands, 13 cepstra of them, and how those change over 40 ms. The mean of the loud frames is taken
//! off: most of what a room and a microphone add.

use crate::speech::fourier::Powers;

/// Samples a second that the aligner works at: all that tells phones apart lies below 8 kHz.
pub const RATE: u32 = 16_000;

/// Samples from one frame to the next: 5 ms.
pub(crate) const HOP: usize = 80;

/// Frames a second.
pub const FRAMES: f64 = 200.0;

/// Numbers a frame: 13 cepstra and their slopes.
pub const DIMS: usize = 2 * CEPSTRA;

const CEPSTRA: usize = 13;
const BANDS: usize = 26;
/// Samples that are looked at for a frame: 25 ms.
const WINDOW: usize = 400;
/// Samples of a transform: those of a window, and silence.
const SIZE: usize = 512;
const BINS: usize = SIZE / 2 + 1;
/// The mel bands lie between these, in Hz.
const LOWEST: f64 = 60.0;
const HIGHEST: f64 = 7800.0;
/// Some 55 dB below the energy of loud frames' bands: what lies lower is the same silence to the ear, and digital
/// silence would be another for every synthesiser.
const FLOOR: f32 = 1e-5;
/// Frames to either side that a slope is taken over.
const REACH: usize = 4;
/// Slopes are some three times smaller than what they are slopes of.
const SLOPE: f32 = 3.0;
/// The root mean square that the loud frames are brought to.
const LEVEL: f32 = 0.1;

/// The frames of a recording.
#[derive(Debug, Clone, Default)]
pub struct Features {
    /// [`DIMS`] numbers a frame, one frame after the other.
    pub values: Vec<f32>,
    /// The level of each frame in dB, against the loud frames.
    pub levels: Vec<f32>,
    /// Which frames are among the quietest.
    pub quiet: Vec<bool>,
    /// How loud the voice is above the noise, in dB.
    pub snr: f32,
    /// How loud the voice is, in dB below a full square wave.
    pub voice: f32,
}

impl Features {
    /// How many frames there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.levels.len()
    }

    /// True if there are none.
    #[cfg(feature = "tools")]
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.levels.is_empty()
    }

    /// One frame.
    #[must_use]
    pub fn frame(&self, at: usize) -> &[f32] {
        &self.values[at * DIMS..(at + 1) * DIMS]
    }

    /// The frames of samples at [`RATE`]; the middle of frame n is at n · 5 ms.
    #[must_use]
    pub fn of(samples: &[f32]) -> Self {
        if samples.is_empty() {
            return Self::default();
        }
        let mut heard = high_passed(samples);
        let (levels, loudness) = levels(&heard);
        let loud = loudness.loud();
        let gain = LEVEL / 10_f32.powf(loud / 20.0);
        // Pre-emphasis, in place from the end.
        for i in (1..heard.len()).rev() {
            heard[i] = gain * (heard[i] - 0.97 * heard[i - 1]);
        }
        heard[0] *= gain * 0.03;
        let count = levels.len();
        let mut values = vec![0.0; count * DIMS];
        cepstra(&heard, &mut values);
        take_off_mean(&mut values, &levels, &loudness);
        slopes(&mut values);
        let quiet = levels.iter().map(|l| *l < loudness.noise + 4.0).collect();
        let snr = loud - loudness.noise;
        Self { values, levels: levels.iter().map(|l| l - loud).collect(), quiet, snr, voice: loud }
    }

    /// How much of it is voice, in seconds.
    #[must_use]
    pub(crate) fn sounding(&self) -> f64 {
        let above = -self.snr + (0.25 * self.snr).clamp(5.0, 12.0);
        self.levels.iter().filter(|l| **l > above).count() as f64 / FRAMES
    }
}

/// A Butterworth high-pass of the second order at 70 Hz: below it lie hum and handling, above it every voice.
fn high_passed(samples: &[f32]) -> Vec<f32> {
    let k = (std::f64::consts::PI * 70.0 / f64::from(RATE)).tan();
    let norm = 1.0 / (1.0 + std::f64::consts::SQRT_2 * k + k * k);
    let (a1, a2) = (2.0 * (k * k - 1.0) * norm, (1.0 - std::f64::consts::SQRT_2 * k + k * k) * norm);
    let (mut s1, mut s2) = (0.0, 0.0);
    samples
        .iter()
        .map(|x| {
            let x = if x.is_finite() { f64::from(*x) } else { 0.0 };
            let y = norm * x + s1;
            s1 = -2.0 * norm * x - a1 * y + s2;
            s2 = norm * x - a2 * y;
            y as f32
        })
        .collect()
}

/// How loud a recording is, in dB below a full square wave.
struct Loudness {
    /// The quietest 6 %: their median.
    noise: f32,
    /// The level that 1 in 20 of the sounding frames is above.
    top: f32,
}

impl Loudness {
    fn loud(&self) -> f32 {
        self.top
    }
}

/// The level of every frame in dB, over its window.
fn levels(samples: &[f32]) -> (Vec<f32>, Loudness) {
    let count = 1 + (samples.len() - 1) / HOP;
    // Sums of blocks of one hop; a window of 400 is five of them.
    let blocks: Vec<f32> = samples.chunks(HOP).map(|b| b.iter().map(|s| s * s).sum()).collect();
    let levels: Vec<f32> = (0..count)
        .map(|n| {
            // The middle of frame n is the start of block n: two and a half blocks to either side.
            let block = |k: usize| (n + k).checked_sub(3).and_then(|i| blocks.get(i)).copied().unwrap_or(0.0);
            let sum = 0.5 * (block(0) + block(5)) + block(1) + block(2) + block(3) + block(4);
            10.0 * (sum / WINDOW as f32 + 1e-12).log10()
        })
        .collect();
    let mut sorted = levels.clone();
    sorted.sort_by(f32::total_cmp);
    let quiet = ((count as f64 * 0.06) as usize).max(8).min(count);
    let noise = sorted[quiet / 2];
    let half_second = sorted[count - (count / 20).clamp(1, 100)];
    let first = sorted.partition_point(|l| *l <= noise + 0.3 * (half_second - noise)).min(count - 1);
    let top = sorted[count - 1 - (count - first) / 20];
    (levels, Loudness { noise, top })
}

/// The cepstra of every frame, into the first half of its numbers.
fn cepstra(samples: &[f32], values: &mut [f32]) {
    let window: Vec<f32> = (0..WINDOW)
        .map(|i| (0.5 - 0.5 * (std::f64::consts::TAU * i as f64 / (WINDOW - 1) as f64).cos()) as f32)
        .collect();
    let bands = bands();
    let cosines: Vec<[f32; BANDS]> = (0..CEPSTRA)
        .map(|i| {
            std::array::from_fn(|j| {
                let angle = std::f64::consts::PI * i as f64 * (j as f64 + 0.5) / BANDS as f64;
                (angle.cos() * (2.0 / BANDS as f64).sqrt()) as f32
            })
        })
        .collect();
    let mut transform = Powers::new(SIZE);
    for (n, frame) in values.chunks_exact_mut(DIMS).enumerate() {
        let from = (n * HOP).checked_sub(WINDOW / 2);
        let power = match from.and_then(|from| samples.get(from..from + WINDOW)) {
            Some(inside) => transform.of(inside.iter().zip(&window).map(|(s, w)| s * w)),
            None => {
                let at = |i: usize| (n * HOP + i).checked_sub(WINDOW / 2).and_then(|at| samples.get(at));
                transform.of(window.iter().enumerate().map(|(i, w)| at(i).copied().unwrap_or(0.0) * w))
            }
        };
        let logs: [f32; BANDS] = std::array::from_fn(|b| {
            let (from, weights) = &bands[b];
            let sum: f32 = power[*from..*from + weights.len()].iter().zip(weights).map(|(p, w)| p * w).sum();
            (sum + FLOOR).ln()
        });
        for (o, row) in frame[..CEPSTRA].iter_mut().zip(&cosines) {
            *o = row.iter().zip(&logs).map(|(c, l)| c * l).sum();
        }
    }
}

/// The triangles of the mel bands: each its first bin and its weights.
fn bands() -> Vec<(usize, Vec<f32>)> {
    let mel = |hertz: f64| 2595.0 * (1.0 + hertz / 700.0).log10();
    let edge = |i: usize| {
        let m = mel(LOWEST) + (mel(HIGHEST) - mel(LOWEST)) * i as f64 / (BANDS + 1) as f64;
        700.0 * (10_f64.powf(m / 2595.0) - 1.0) / f64::from(RATE) * SIZE as f64
    };
    (0..BANDS)
        .map(|b| {
            let (left, middle, right) = (edge(b), edge(b + 1), edge(b + 2));
            let from = left.ceil() as usize;
            let weight = |k: usize| {
                let k = k as f64;
                ((k - left) / (middle - left)).min((right - k) / (right - middle)).max(0.0) as f32
            };
            (from, (from..=(right.floor() as usize).min(BINS - 1)).map(weight).collect())
        })
        .collect()
}

/// Takes the mean of the loud frames off the cepstra, and of the first one, which is loudness, that of the loudest.
fn take_off_mean(values: &mut [f32], levels: &[f32], loudness: &Loudness) {
    let mut sums = [0.0_f64; CEPSTRA];
    let mut number = 0_usize;
    let above = loudness.top - 0.55 * (loudness.top - loudness.noise);
    let mut first: Vec<f32> = Vec::new();
    for (frame, level) in values.chunks_exact(DIMS).zip(levels) {
        if *level > above {
            number += 1;
            first.push(frame[0]);
            for (sum, x) in sums.iter_mut().zip(frame) {
                *sum += f64::from(*x);
            }
        }
    }
    let mut means: [f32; CEPSTRA] = std::array::from_fn(|i| (sums[i] / number.max(1) as f64) as f32);
    first.sort_by(f32::total_cmp);
    means[0] = first.len().checked_sub(1).map_or(0.0, |last| first[last - last / 20]);
    for frame in values.chunks_exact_mut(DIMS) {
        for (x, mean) in frame.iter_mut().zip(&means) {
            *x -= mean;
        }
    }
}

/// The slopes of the cepstra over ±20 ms, into the second half of each frame's numbers.
fn slopes(values: &mut [f32]) {
    let count = values.len() / DIMS;
    let norm = SLOPE / (2 * (1..=REACH).map(|j| j * j).sum::<usize>()) as f32;
    for n in 0..count {
        let mut slope = [0.0_f32; CEPSTRA];
        for j in 1..=REACH {
            let (after, before) = ((n + j).min(count - 1) * DIMS, n.saturating_sub(j) * DIMS);
            let (after, before) = (&values[after..after + CEPSTRA], &values[before..before + CEPSTRA]);
            for ((s, a), b) in slope.iter_mut().zip(after).zip(before) {
                *s += j as f32 * (a - b);
            }
        }
        for (o, s) in values[n * DIMS + CEPSTRA..(n + 1) * DIMS].iter_mut().zip(&slope) {
            *o = s * norm;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tone(seconds: f64, hertz: f64, level: f32) -> Vec<f32> {
        (0..(seconds * f64::from(RATE)) as usize)
            .map(|i| level * (std::f64::consts::TAU * hertz * i as f64 / f64::from(RATE)).sin() as f32)
            .collect()
    }

    #[test]
    fn a_louder_recording_has_the_same_frames() {
        let mut samples = tone(0.3, 300.0, 0.001);
        samples.extend(tone(0.5, 900.0, 0.2));
        let (soft, loud) = (
            Features::of(&samples.iter().map(|s| s * 0.05).collect::<Vec<_>>()),
            Features::of(&samples.iter().map(|s| s * 4.0).collect::<Vec<_>>()),
        );
        assert_eq!(soft.len(), loud.len());
        let worst = soft.values.iter().zip(&loud.values).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(worst < 0.02, "{worst}");
        assert!((loud.voice - soft.voice - 38.06).abs() < 0.01, "{} {}", loud.voice, soft.voice);
        assert!((loud.snr - 46.0).abs() < 1.0, "{}", loud.snr);
    }

    #[test]
    fn the_middle_of_a_frame_is_where_its_time_says() {
        let mut samples = vec![0.0; 8000];
        samples.extend(tone(0.5, 900.0, 0.2));
        let heard = Features::of(&samples);
        let steepest = (0..heard.len()).max_by(|a, b| heard.frame(*a)[CEPSTRA].total_cmp(&heard.frame(*b)[CEPSTRA]));
        assert!(steepest.is_some_and(|at| (97..=101).contains(&at)), "{steepest:?}");
        assert!((heard.sounding() - 0.5).abs() < 0.04, "{}", heard.sounding());
    }

    #[test]
    fn nothing_and_next_to_nothing_have_frames_too() {
        assert_eq!(Features::of(&[]).len(), 0);
        for length in [1, 79, 80, 81, 400, 1000] {
            let heard = Features::of(&vec![0.0; length]);
            assert_eq!(heard.len(), 1 + (length - 1) / HOP);
            assert!(heard.values.iter().all(|v| v.is_finite()));
        }
        assert!(Features::of(&[f32::NAN; 999]).values.iter().all(|v| v.is_finite()));
    }
}

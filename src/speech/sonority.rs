//! How much a sound sounds like a vowel, step by step.

use std::f64::consts::{PI, SQRT_2, TAU};

use crate::media::decimated;

/// Steps a second.
pub(super) const STEPS: f64 = 200.0;

/// The band where vowels are much louder than consonants, in Hz: above the murmur of nasals and stops that are voiced,
/// below the hiss of fricatives.
const BAND: (f64, f64) = (300.0, 3000.0);

/// The width of the bell that values are weighed by, at half its height, in seconds: longer than two periods of any voice
/// and shorter than most vowels.
const SMOOTH: f64 = 0.05;

/// The level of every 5 ms in dB, at least −120, of the band of vowels.
pub(super) fn sonority(samples: &[f32], rate: u32) -> Vec<f32> {
    let (samples, rate) = decimated(samples, rate, 8000);
    let mut filters = [Biquad::high_pass(BAND.0, rate), Biquad::low_pass(BAND.1, rate)];
    let power: Vec<f64> = samples
        .iter()
        .map(|s| {
            let passed = filters.iter_mut().fold(f64::from(*s), |x, filter| filter.next(x));
            passed * passed
        })
        .collect();
    let half = (SMOOTH * rate) as usize;
    let bell: Vec<f64> =
        (0..2 * half + 1).map(|i| 0.5 - 0.5 * (TAU * (i + 1) as f64 / (2 * half + 2) as f64).cos()).collect();
    let sum: f64 = bell.iter().sum();
    let count = (samples.len() as f64 / rate * STEPS).ceil() as usize;
    (0..count)
        .map(|step| {
            let middle = (step as f64 / STEPS * rate) as usize;
            let (from, skip) = (middle.saturating_sub(half), half.saturating_sub(middle));
            let to = (middle + half + 1).min(power.len());
            let part = power.get(from..to).unwrap_or_default();
            let mean = part.iter().zip(&bell[skip..]).map(|(p, w)| p * w).sum::<f64>() / sum;
            (10.0 * mean.max(1e-12).log10()) as f32
        })
        .collect()
}

/// A Butterworth filter of the second order by the bilinear transform, in the second direct form, transposed.
struct Biquad {
    b: [f64; 3],
    a: [f64; 2],
    state: [f64; 2],
}

impl Biquad {
    fn low_pass(corner: f64, rate: f64) -> Self {
        // What cannot be held back at this rate is not there.
        let Some((k, norm)) = Self::warped(corner, rate) else { return Self::open() };
        Self::new([k * k * norm, 2.0 * k * k * norm, k * k * norm], k, norm)
    }

    fn high_pass(corner: f64, rate: f64) -> Self {
        let Some((k, norm)) = Self::warped(corner, rate) else { return Self::open() };
        Self::new([norm, -2.0 * norm, norm], k, norm)
    }

    fn open() -> Self {
        Self { b: [1.0, 0.0, 0.0], a: [0.0; 2], state: [0.0; 2] }
    }

    fn warped(corner: f64, rate: f64) -> Option<(f64, f64)> {
        let k = (PI * corner / rate).tan();
        (corner < 0.48 * rate).then_some((k, 1.0 / (1.0 + SQRT_2 * k + k * k)))
    }

    fn new(b: [f64; 3], k: f64, norm: f64) -> Self {
        Self { b, a: [2.0 * (k * k - 1.0) * norm, (1.0 - SQRT_2 * k + k * k) * norm], state: [0.0; 2] }
    }

    fn next(&mut self, x: f64) -> f64 {
        let y = self.b[0] * x + self.state[0];
        self.state = [self.b[1] * x - self.a[0] * y + self.state[1], self.b[2] * x - self.a[1] * y];
        y
    }
}

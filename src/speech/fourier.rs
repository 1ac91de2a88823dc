//! The powers of the frequencies in a stretch of sound, by the one Fourier transform of the house (`realfft`).
//!
//! It runs on the same scalar instructions on every processor, because what is learned and what is pinned by tests must
//! not depend on the processor; the feature flags in `Cargo.toml` see to that.

use std::sync::Arc;

use realfft::num_complex::Complex;
use realfft::{RealFftPlanner, RealToComplex};

/// A transform of a fixed number of real samples, with its working memory. A clone shares the tables.
#[derive(Clone)]
pub(super) struct Powers {
    plan: Arc<dyn RealToComplex<f32>>,
    input: Vec<f32>,
    lines: Vec<Complex<f32>>,
    scratch: Vec<Complex<f32>>,
    powers: Vec<f32>,
}

impl Powers {
    /// A transform of `size` samples.
    pub(crate) fn new(size: usize) -> Self {
        let plan = RealFftPlanner::new().plan_fft_forward(size);
        let (input, lines, scratch) = (plan.make_input_vec(), plan.make_output_vec(), plan.make_scratch_vec());
        Self { powers: vec![0.0; lines.len()], plan, input, lines, scratch }
    }

    /// The squared magnitudes of the lines from 0 to half the sample rate, `size / 2 + 1` of them. Samples that are
    /// missing at the end are 0; those beyond `size` are left out.
    pub(crate) fn of(&mut self, samples: impl Iterator<Item = f32>) -> &[f32] {
        self.input.fill(0.0);
        for (to, sample) in self.input.iter_mut().zip(samples) {
            *to = sample;
        }
        // It fails only where lengths differ, and these are of its own making.
        if self.plan.process_with_scratch(&mut self.input, &mut self.lines, &mut self.scratch).is_err() {
            self.powers.fill(0.0);
            return &self.powers;
        }
        for (power, line) in self.powers.iter_mut().zip(&self.lines) {
            *power = line.norm_sqr();
        }
        &self.powers
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_powers_are_those_of_the_sum_of_the_definition() {
        const SIZE: usize = 512;
        let mut transform = Powers::new(SIZE);
        // The second is computed in the memory of the first.
        for seed in [3, 11] {
            let signal: Vec<f32> = (0..400_u32).map(|i| ((i * i + seed * i) % 97) as f32 / 48.5 - 1.0).collect();
            let powers = transform.of(signal.iter().copied());
            assert_eq!(powers.len(), SIZE / 2 + 1);
            for k in [0, 1, 2, 17, 100, 255, 256] {
                let (mut re, mut im) = (0.0, 0.0);
                for (i, s) in signal.iter().enumerate() {
                    let angle = std::f64::consts::TAU * (k * i % SIZE) as f64 / SIZE as f64;
                    re += f64::from(*s) * angle.cos();
                    im += f64::from(*s) * angle.sin();
                }
                let expected = re * re + im * im;
                assert!((f64::from(powers[k]) - expected).abs() < 1e-3 * expected + 1e-2, "{k}");
            }
        }
    }
}

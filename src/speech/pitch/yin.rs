//! Candidates for the period of each step of a sound.

use rayon::prelude::*;
use realfft::num_complex::Complex;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use std::sync::Arc;

/// The lowest and highest pitch, in Hz.
const LOWEST: f64 = 50.0;
const HIGHEST: f64 = 600.0;

/// The seconds that are compared with what follows: two periods of a low voice.
const WINDOW: f64 = 0.022;

/// A pitch in the middle of all voices, in Hz.
const USUAL: f64 = 160.0;

/// The thresholds that a dip may have to pass to be a period: a hundred from 0.01 on.
const THRESHOLDS: usize = 100;

/// What is thought of the thresholds before: the beta distribution of parameters 2 and 11.33, mean 0.15.
const BETA: f64 = 11.33;

/// The share of a threshold's weight that goes to the deepest dip where none passes it.
const ELSE: f32 = 0.01;

/// The corner of the high-pass, in Hz: hum of 50 Hz is weakened, the lowest voices hardly.
const HUM: f64 = 40.0;

/// The corner of the low-pass, in Hz, 12 dB an octave: where pitch falls fast its high harmonics, a period later, are no
/// longer like themselves, and the low ones are all that is needed.
const DULL: f64 = 500.0;

/// A step of a sound.
#[derive(Debug, Clone, Default)]
pub(super) struct Frame {
    /// Its loudness, in dB below a full-scale square.
    pub level: f32,
    /// Pitches in Hz with the probability of each; what lacks to 1 is that of no voice.
    pub candidates: Vec<(f32, f32)>,
}

/// `count` frames, one every `step` seconds, the first around time 0. `rate` is that of the samples, at least 2000.
pub(super) fn frames(samples: &[f32], rate: f64, step: f64, count: usize) -> Vec<Frame> {
    let passed = filtered(samples, rate);
    let likeness = Likeness::new(rate);
    let mut frames = vec![Frame::default(); count];
    // Each frame is computed alone, so that their order is of no matter.
    frames.par_chunks_mut(500).enumerate().for_each(|(turn, part)| {
        let mut work = likeness.work();
        for (index, frame) in part.iter_mut().enumerate() {
            *frame = likeness.frame(&passed, ((turn * 500 + index) as f64 * step * rate) as usize, &mut work);
        }
    });
    frames
}

/// The sound without its steady part, dulled: a high-pass of the first order and a low-pass of the second.
fn filtered(samples: &[f32], rate: f64) -> Vec<f32> {
    let leak = |hertz: f64| (-std::f64::consts::TAU * hertz / rate).exp() as f32;
    let (keep, dull) = (leak(HUM), leak(DULL));
    let (mut before, mut high, mut once, mut twice) = (samples.first().copied().unwrap_or(0.0), 0.0, 0.0, 0.0);
    let mut next = |s: &f32| {
        high = keep * (high + s - before);
        before = *s;
        once = high + dull * (once - high);
        twice = once + dull * (twice - once);
        twice
    };
    samples.iter().map(&mut next).collect()
}

/// Compares a sound with itself.
struct Likeness {
    rate: f64,
    /// Samples of the part that is compared.
    window: usize,
    /// The shortest and the longest period, in samples.
    lags: (usize, usize),
    /// How likely each threshold is.
    prior: Vec<f32>,
    forward: Arc<dyn RealToComplex<f32>>,
    back: Arc<dyn ComplexToReal<f32>>,
}

struct Work {
    sound: Vec<f32>,
    short: Vec<f32>,
    long: Vec<f32>,
    a: Vec<Complex<f32>>,
    b: Vec<Complex<f32>>,
    scratch: Vec<Complex<f32>>,
    difference: Vec<f32>,
}

impl Likeness {
    fn new(rate: f64) -> Self {
        let window = (WINDOW * rate) as usize;
        let lags = ((rate / HIGHEST) as usize, (rate / LOWEST).ceil() as usize);
        let size = (window + lags.1 + 2).next_power_of_two();
        let mut planner = RealFftPlanner::new();
        let density = |i: usize| {
            let x = (i as f64 + 0.5) / THRESHOLDS as f64;
            x * (1.0 - x).powf(BETA - 1.0)
        };
        let sum: f64 = (0..THRESHOLDS).map(density).sum();
        Self {
            rate,
            window,
            lags,
            prior: (0..THRESHOLDS).map(|i| (density(i) / sum) as f32).collect(),
            forward: planner.plan_fft_forward(size),
            back: planner.plan_fft_inverse(size),
        }
    }

    fn work(&self) -> Work {
        Work {
            sound: Vec::new(),
            short: self.forward.make_input_vec(),
            long: self.forward.make_input_vec(),
            a: self.forward.make_output_vec(),
            b: self.forward.make_output_vec(),
            scratch: vec![Complex::default(); self.forward.get_scratch_len().max(self.back.get_scratch_len())],
            difference: Vec::new(),
        }
    }

    fn frame(&self, samples: &[f32], middle: usize, work: &mut Work) -> Frame {
        // What is compared and what it is compared with, a usual period later, lie around the middle together.
        let length = self.window + self.lags.1 + 1;
        let before = (self.window + (self.rate / USUAL) as usize) / 2;
        work.sound.clear();
        let from = |i: usize| (middle + i).checked_sub(before).and_then(|at| samples.get(at));
        work.sound.extend((0..length).map(|i| from(i).copied().unwrap_or(0.0)));
        let energy: f32 = work.sound.iter().map(|s| s * s).sum();
        let level = (10.0 * (energy / length as f32).log10()).max(-120.0);
        if energy <= 1e-9 || self.differ(work).is_none() {
            return Frame { level, candidates: Vec::new() };
        }
        Frame { level, candidates: self.candidates(&work.difference) }
    }

    /// The normalised difference of the window from itself at each lag (de Cheveigné and Kawahara 2002, eq. 8): 1 at
    /// first, near 0 at a period.
    fn differ(&self, work: &mut Work) -> Option<()> {
        work.short.fill(0.0);
        work.short[..self.window].copy_from_slice(&work.sound[..self.window]);
        work.long.fill(0.0);
        work.long[..work.sound.len()].copy_from_slice(&work.sound);
        self.forward.process_with_scratch(&mut work.short, &mut work.a, &mut work.scratch).ok()?;
        self.forward.process_with_scratch(&mut work.long, &mut work.b, &mut work.scratch).ok()?;
        let size = work.long.len() as f32;
        for (a, b) in work.a.iter_mut().zip(&work.b) {
            *a = a.conj() * b / size;
        }
        // Rounding leaves a trace of an imaginary part where there can be none.
        work.a[0].im = 0.0;
        let last = work.a.len() - 1;
        work.a[last].im = 0.0;
        self.back.process_with_scratch(&mut work.a, &mut work.short, &mut work.scratch).ok()?;
        let own: f64 = work.sound[..self.window].iter().map(|s| f64::from(s * s)).sum();
        let (mut shifted, mut sum) = (own, 0.0);
        work.difference.clear();
        work.difference.push(1.0);
        for lag in 1..=self.lags.1 {
            let (gone, come) = (f64::from(work.sound[lag - 1]), f64::from(work.sound[lag + self.window - 1]));
            shifted += come * come - gone * gone;
            let difference = (own + shifted - 2.0 * f64::from(work.short[lag])).max(0.0);
            sum += difference;
            work.difference.push((difference * lag as f64 / sum.max(1e-12)) as f32);
        }
        Some(())
    }

    /// Every dip with the weight of the thresholds that it is the first to pass.
    fn candidates(&self, difference: &[f32]) -> Vec<(f32, f32)> {
        let dips: Vec<(usize, f32)> = (self.lags.0.max(2)..self.lags.1)
            .filter(|i| difference[*i] < difference[i - 1] && difference[*i] <= difference[i + 1])
            .map(|i| (i, difference[i]))
            .collect();
        let Some(deepest) = (0..dips.len()).min_by(|a, b| dips[*a].1.total_cmp(&dips[*b].1)) else { return Vec::new() };
        let mut weights = vec![0.0_f32; dips.len()];
        for (index, prior) in self.prior.iter().enumerate() {
            let threshold = (index + 1) as f32 / THRESHOLDS as f32;
            match dips.iter().position(|d| d.1 < threshold) {
                Some(first) => weights[first] += prior,
                None => weights[deepest] += ELSE * prior,
            }
        }
        let found = dips.iter().zip(weights).filter(|(_, weight)| *weight > 1e-4);
        found.map(|((lag, _), weight)| ((self.rate / vertex(difference, *lag)) as f32, weight)).collect()
    }
}

/// The place of the lowest point of a parabola through three values around a dip.
fn vertex(values: &[f32], at: usize) -> f64 {
    let (before, here, after) = (f64::from(values[at - 1]), f64::from(values[at]), f64::from(values[at + 1]));
    let bend = before - 2.0 * here + after;
    at as f64 + if bend > 1e-12 { (0.5 * (before - after) / bend).clamp(-0.5, 0.5) } else { 0.0 }
}

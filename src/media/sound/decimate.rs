//! Fewer samples a second where only low frequencies are looked at.

use std::f64::consts::PI;

/// The filter reaches this many samples of the slower rate to either side.
const REACH: usize = 8;

/// The share of the slower rate's band that is kept; the rest is where the filter falls, to −60 dB at its end.
const KEPT: f64 = 0.8;

/// A sound at its rate divided by the largest whole number that leaves at least `least` samples a second, low-passed
/// before (sinc in a Blackman window), and that rate. Sample i of it is where sample i times that number was.
pub(crate) fn decimated(samples: &[f32], rate: u32, least: u32) -> (Vec<f32>, f64) {
    let factor = (rate / least.max(1)).max(1) as usize;
    if factor == 1 {
        return (samples.to_vec(), f64::from(rate.max(1)));
    }
    let half = REACH * factor;
    let mut taps: Vec<f64> = (0..=2 * half)
        .map(|i| {
            let x = i as f64 - half as f64;
            let cut = KEPT / factor as f64;
            let sinc = if x == 0.0 { cut } else { (PI * cut * x).sin() / (PI * x) };
            let turn = PI * i as f64 / half as f64;
            sinc * (0.42 - 0.5 * turn.cos() + 0.08 * (2.0 * turn).cos())
        })
        .collect();
    let sum: f64 = taps.iter().sum();
    taps.iter_mut().for_each(|t| *t /= sum);
    let taps: Vec<f32> = taps.iter().map(|t| *t as f32).collect();
    let out = (0..samples.len().div_ceil(factor))
        .map(|i| {
            let middle = i * factor;
            let (from, skip) = (middle.saturating_sub(half), half.saturating_sub(middle));
            let to = (middle + half + 1).min(samples.len());
            weighed(&samples[from..to], &taps[skip..])
        })
        .collect();
    (out, f64::from(rate) / factor as f64)
}

/// The sum of products, in eight lanes: the order is fixed, so that the result is, and a compiler can use wide
/// registers.
pub(super) fn weighed(a: &[f32], b: &[f32]) -> f32 {
    let length = a.len().min(b.len());
    let (a, b) = (&a[..length], &b[..length]);
    let mut lanes = [0.0_f32; 8];
    let (wide_a, wide_b) = (a.chunks_exact(8), b.chunks_exact(8));
    let rest: f32 = wide_a.remainder().iter().zip(wide_b.remainder()).map(|(x, y)| x * y).sum();
    for (x, y) in wide_a.zip(wide_b) {
        for i in 0..8 {
            lanes[i] += x[i] * y[i];
        }
    }
    lanes.iter().sum::<f32>() + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tone(hertz: f64, rate: u32) -> Vec<f32> {
        (0..rate).map(|i| (std::f64::consts::TAU * hertz * f64::from(i) / f64::from(rate)).sin() as f32).collect()
    }

    fn loudness(samples: &[f32]) -> f32 {
        let inner = &samples[100..samples.len() - 100];
        (inner.iter().map(|s| s * s).sum::<f32>() / inner.len() as f32).sqrt()
    }

    #[test]
    fn what_fits_in_the_slower_band_is_kept_and_what_does_not_is_gone() {
        for rate in [44_100, 48_000, 96_000] {
            let (low, slower) = decimated(&tone(1000.0, rate), rate, 7000);
            assert!((7000.0..14_000.0).contains(&slower));
            assert!((loudness(&low) - std::f32::consts::FRAC_1_SQRT_2).abs() < 0.01, "{rate}");
            let (high, _) = decimated(&tone(5000.0, rate), rate, 7000);
            assert!(loudness(&high) < 0.002, "{rate}: {}", loudness(&high));
        }
    }

    #[test]
    fn a_rate_that_is_low_enough_and_a_short_sound_stay() {
        assert_eq!(decimated(&[0.5, 0.25], 8000, 7000), (vec![0.5, 0.25], 8000.0));
        assert_eq!(decimated(&[], 48_000, 7000).0, Vec::<f32>::new());
        assert_eq!(decimated(&[1.0], 48_000, 7000).0.len(), 1);
        assert_eq!(decimated(&[1.0], 0, 7000).1, 1.0);
    }
}

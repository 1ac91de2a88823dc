//! How loud a sound is, step by step: what telling speech from silence looks at.

/// Steps a second: 5 ms each, a third of the shortest stop.
pub(super) const STEPS: f64 = 200.0;

/// The lowest level there is, in dB: below the last bit of 16 and of most 24.
pub(super) const LOWEST: f64 = -120.0;

/// The corner of the high-pass, in Hz: below it lie hum and handling, above it every voice.
const CORNER: f64 = 70.0;

/// The level of every 5 ms in dB below a full square wave, at least [`LOWEST`]: the mean square of 10 ms around its
/// middle, after a high-pass (Butterworth, second order) at 70 Hz.
pub(super) fn levels(samples: &[f32], rate: u32) -> Vec<f64> {
    let rate = f64::from(rate.max(1));
    let mut filter = HighPass::new(rate);
    let count = (samples.len() as f64 / rate * STEPS).ceil() as usize;
    let mut sums = vec![(0.0_f64, 0_u32); count];
    for (index, sample) in samples.iter().enumerate() {
        let step = (index as f64 / rate * STEPS) as usize;
        let value = filter.next(f64::from(*sample));
        if let Some((sum, number)) = sums.get_mut(step) {
            *sum += value * value;
            *number += 1;
        }
    }
    (0..count)
        .map(|i| {
            // Half of each neighbour makes 10 ms.
            let part = |at: Option<usize>| at.and_then(|at| sums.get(at)).copied().unwrap_or_default();
            let (here, before, after) = (part(Some(i)), part(i.checked_sub(1)), part(Some(i + 1)));
            let square = here.0 + 0.5 * (before.0 + after.0);
            let number = f64::from(here.1) + 0.5 * f64::from(before.1 + after.1);
            (10.0 * (square / number.max(1.0)).log10()).max(LOWEST)
        })
        .collect()
}

/// H(s) = s² / (s² + √2 s + 1) by the bilinear transform, in the second direct form, transposed.
struct HighPass {
    b: f64,
    a: [f64; 2],
    state: [f64; 2],
}

impl HighPass {
    /// Without effect where the corner is too near to half the rate to be one: zeros on the poles.
    fn new(rate: f64) -> Self {
        if rate < 8.0 * CORNER {
            return Self { b: 1.0, a: [-2.0, 1.0], state: [0.0; 2] };
        }
        let k = (std::f64::consts::PI * CORNER / rate).tan();
        let norm = 1.0 / (1.0 + std::f64::consts::SQRT_2 * k + k * k);
        let a = [2.0 * (k * k - 1.0) * norm, (1.0 - std::f64::consts::SQRT_2 * k + k * k) * norm];
        Self { b: norm, a, state: [0.0; 2] }
    }

    fn next(&mut self, x: f64) -> f64 {
        let y = self.b * x + self.state[0];
        self.state[0] = -2.0 * self.b * x - self.a[0] * y + self.state[1];
        self.state[1] = self.b * x - self.a[1] * y;
        y
    }
}

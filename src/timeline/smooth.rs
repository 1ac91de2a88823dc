//! Smoothing that keeps peaks.

/// Smooths values sampled at `times` over about `width` seconds by local quadratic regression with tricube weights
/// (Cleveland 1979): a parabola is fitted to the samples around each one. Noise goes, and a peak as wide as the
/// window keeps its height, which a moving average would cut. Constants and parabolas come back unchanged, so
/// ratios that sum to 1 still do. `width` of 0 changes nothing.
#[must_use]
pub fn smooth_keeping_peaks(times: &[f64], values: &[f64], width: f64) -> Vec<f64> {
    let count = times.len().min(values.len());
    let mut start = 0;
    (0..count)
        .map(|i| {
            while start < count && times[i] - times[start] >= width {
                start += 1;
            }
            let near = (start..count).take_while(|j| times[*j] - times[i] < width);
            local_parabola(times, values, i, near, width)
        })
        .collect()
}

/// The value at sample `i` of the parabola fitted to the samples `near`; the sample itself where they are too few.
fn local_parabola(times: &[f64], values: &[f64], i: usize, near: impl Iterator<Item = usize>, width: f64) -> f64 {
    // Normal equations in u = (t − tᵢ) / width; the wanted value is the constant term.
    let (mut s, mut y, mut count) = ([0.0; 5], [0.0; 3], 0);
    for j in near {
        let u = (times[j] - times[i]) / width;
        let w = (1.0 - u.abs().powi(3)).max(0.0).powi(3);
        let powers = [1.0, u, u * u, u * u * u, u * u * u * u];
        for (sum, p) in s.iter_mut().zip(powers) {
            *sum += w * p;
        }
        for (sum, p) in y.iter_mut().zip(powers) {
            *sum += w * p * values[j];
        }
        count += 1;
    }
    if count < 5 {
        return values[i];
    }
    // Cramer's rule for the first unknown of the symmetric 3 × 3 system.
    let det = |a: [f64; 3], b: [f64; 3], c: [f64; 3]| {
        a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
    };
    let whole = det([s[0], s[1], s[2]], [s[1], s[2], s[3]], [s[2], s[3], s[4]]);
    if whole.abs() < 1e-12 {
        return values[i];
    }
    det([y[0], s[1], s[2]], [y[1], s[2], s[3]], [y[2], s[3], s[4]]) / whole
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_goes_and_a_peak_keeps_its_height() {
        let times: Vec<f64> = (0..250).map(|i| f64::from(i) / 25.0).collect();
        // A smile of 0.6 s on a flat face, and noise of ± 0.05 that alternates in a fixed, uneven way.
        let smile = |t: f64| {
            if (t - 5.0).abs() < 0.3 { 0.5 + 0.5 * ((t - 5.0) * std::f64::consts::PI / 0.3).cos() } else { 0.0 }
        };
        let noise = |i: usize| 0.05 * (((i * 7919) % 13) as f64 / 6.0 - 1.0);
        let noisy: Vec<f64> = times.iter().enumerate().map(|(i, t)| smile(*t) + noise(i)).collect();
        let out = smooth_keeping_peaks(&times, &noisy, 0.24);
        let rms = |v: &[f64]| (v.iter().map(|x| x * x).sum::<f64>() / v.len() as f64).sqrt();
        assert!(rms(&out[..100]) < 0.45 * rms(&noisy[..100]), "{} of {}", rms(&out[..100]), rms(&noisy[..100]));
        let peak = out.iter().copied().fold(f64::MIN, f64::max);
        assert!(peak > 0.93, "{peak}");
    }

    #[test]
    fn a_parabola_comes_back_unchanged() {
        let times: Vec<f64> = (0..50).map(|i| f64::from(i) * 0.04).collect();
        let values: Vec<f64> = times.iter().map(|t| 1.0 - 2.0 * t + 3.0 * t * t).collect();
        for (a, b) in smooth_keeping_peaks(&times, &values, 0.3).iter().zip(&values) {
            assert!((a - b).abs() < 1e-9);
        }
    }
}

//! Local regression: the value at a sample of the curve fitted to the samples around it (Cleveland 1979).

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
            let (steps, weights): (Vec<f64>, Vec<f64>) =
                near.clone().map(|j| (times[j] - times[i]) / width).map(|u| (u, tricube(u))).unzip();
            match shares::<3>(&steps, &weights).filter(|_| steps.len() >= 5) {
                Some(shares) => near.zip(shares).map(|(j, share)| share * values[j]).sum(),
                None => values[i],
            }
        })
        .collect()
}

/// The weight of a sample at a distance in widths.
pub(super) fn tricube(u: f64) -> f64 {
    (1.0 - u.abs().powi(3)).max(0.0).powi(3)
}

/// The shares of samples in the value at 0 of the weighted least-squares polynomial with `TERMS` terms, 1 to 3. They sum
/// to 1, so that sums of values are kept. None where the samples do not determine it.
pub(super) fn shares<const TERMS: usize>(steps: &[f64], weights: &[f64]) -> Option<Vec<f64>> {
    // Normal equations with the right side (1, 0, 0): the wanted value is the constant term.
    let mut rows = [[0.0; 4]; TERMS];
    for (u, w) in steps.iter().zip(weights) {
        let powers = [1.0, *u, u * u];
        for (row, p) in rows.iter_mut().zip(powers) {
            for (cell, q) in row.iter_mut().zip(&powers[..TERMS]) {
                *cell += w * p * q;
            }
        }
    }
    rows[0][3] = 1.0;
    for k in 0..TERMS {
        let from = rows[k];
        // The system is symmetric and not negative: its own diagonal is pivot enough.
        if from[k] < 1e-9 {
            return None;
        }
        for row in &mut rows[k + 1..] {
            let share = row[k] / from[k];
            for (cell, value) in row.iter_mut().zip(from) {
                *cell -= share * value;
            }
        }
    }
    let mut terms = [0.0; 3];
    for k in (0..TERMS).rev() {
        let known: f64 = (k + 1..TERMS).map(|j| rows[k][j] * terms[j]).sum();
        terms[k] = (rows[k][3] - known) / rows[k][k];
    }
    Some(steps.iter().zip(weights).map(|(u, w)| w * (terms[0] + u * (terms[1] + u * terms[2]))).collect())
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

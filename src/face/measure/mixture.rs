//! Colours of a class as a mixture of Gaussians in OKLab, learned from weighted cells.

use super::frame::Lab;

/// What a class's colours look like.
pub(super) struct Mixture {
    parts: Vec<Part>,
}

struct Part {
    mean: Lab,
    /// Inverse of the Cholesky factor of the covariance, lower triangle by rows.
    whiten: [f32; 6],
    /// Logarithm of the weight over the volume.
    log_peak: f32,
    weight: f32,
}

/// The least standard deviations of a part: what noise and JPEG make of one colour.
pub(super) const LEAST: Lab = [0.02, 0.007, 0.007];

impl Mixture {
    /// A mixture of at most `parts` Gaussians for colours with weights: k-means from colours spread by lightness, then
    /// a few rounds of expectation and maximisation. None without any weight.
    pub(crate) fn of(samples: &[(Lab, f32)], parts: usize, least: Lab) -> Option<Self> {
        let total: f32 = samples.iter().map(|s| s.1).sum();
        if total < 8.0 {
            return None;
        }
        // Starts: means of equal shares by lightness.
        let mut order: Vec<usize> = (0..samples.len()).collect();
        order.sort_by(|a, b| samples[*a].0[0].total_cmp(&samples[*b].0[0]));
        let mut share = vec![0_usize; samples.len()];
        let mut gone = 0.0;
        for i in order {
            share[i] = ((gone / total * parts as f32) as usize).min(parts - 1);
            gone += samples[i].1;
        }
        let mut mixture = Self::fitted(samples, parts, least, total, |i, part| f32::from(u8::from(share[i] == part)))?;
        for _ in 0..4 {
            let mut shares = Vec::with_capacity(samples.len() * parts);
            for (lab, _) in samples {
                let logs: Vec<f32> = mixture.parts.iter().map(|p| p.log(*lab)).collect();
                let most = logs.iter().fold(f32::NEG_INFINITY, |m, v| m.max(*v));
                let sum: f32 = logs.iter().map(|v| (v - most).exp()).sum();
                shares.extend((0..parts).map(|k| logs.get(k).map_or(0.0, |v| (v - most).exp() / sum)));
            }
            mixture = Self::fitted(samples, parts, least, total, |i, part| shares[i * parts + part])?;
        }
        Some(mixture)
    }

    fn fitted(
        samples: &[(Lab, f32)],
        parts: usize,
        least: Lab,
        total: f32,
        share: impl Fn(usize, usize) -> f32,
    ) -> Option<Self> {
        let mut found = Vec::with_capacity(parts);
        for part in 0..parts {
            let (mut weight, mut sum, mut squares) = (0.0_f64, [0.0_f64; 3], [0.0_f64; 6]);
            for (i, (lab, w)) in samples.iter().enumerate() {
                let w = f64::from(w * share(i, part));
                let [l, a, b] = lab.map(f64::from);
                weight += w;
                sum.iter_mut().zip([l, a, b]).for_each(|(s, v)| *s += w * v);
                squares.iter_mut().zip([l * l, l * a, a * a, l * b, a * b, b * b]).for_each(|(s, v)| *s += w * v);
            }
            if weight < 0.01 * f64::from(total) {
                continue;
            }
            let [l, a, b] = sum.map(|s| s / weight);
            let means = [l * l, l * a, a * a, l * b, a * b, b * b];
            let mut covariance: [f64; 6] = std::array::from_fn(|k| squares[k] / weight - means[k]);
            for (k, floor) in [(0, least[0]), (2, least[1]), (5, least[2])] {
                covariance[k] = covariance[k].max(0.0) + f64::from(floor).powi(2);
            }
            found.push(Part::of([l as f32, a as f32, b as f32], covariance, (weight / f64::from(total)) as f32));
        }
        (!found.is_empty()).then_some(Self { parts: found })
    }

    /// Adds a Gaussian with its own spread along the axes.
    pub(crate) fn with(mut self, mean: Lab, spread: Lab, weight: f32) -> Self {
        let [l, a, b] = spread.map(|s| f64::from(s).powi(2));
        self.parts.push(Part::of(mean, [l, 0.0, a, 0.0, 0.0, b], weight));
        self
    }

    /// Without the parts whose means `test` holds of, as long as parts of a quarter of the weight are left.
    pub(crate) fn without(mut self, test: impl Fn(Lab) -> bool) -> Self {
        let left: f32 = self.parts.iter().filter(|p| !test(p.mean)).map(|p| p.weight).sum();
        if left > 0.25 {
            self.parts.retain(|p| !test(p.mean));
        }
        self
    }

    /// One Gaussian with its own spread along the axes.
    pub(crate) fn single(mean: Lab, spread: Lab) -> Self {
        Self { parts: Vec::new() }.with(mean, spread, 1.0)
    }

    /// The mean of its heaviest part.
    pub(crate) fn heaviest(&self) -> Lab {
        self.parts.iter().max_by(|a, b| a.weight.total_cmp(&b.weight)).map_or([0.5, 0.0, 0.0], |p| p.mean)
    }

    /// The logarithm of the density, that of the strongest part.
    pub(crate) fn log(&self, lab: Lab) -> f32 {
        self.parts.iter().fold(f32::NEG_INFINITY, |m, p| m.max(p.log(lab)))
    }
}

impl Part {
    /// `covariance` is ll, la, aa, lb, ab, bb.
    fn of(mean: Lab, covariance: [f64; 6], weight: f32) -> Self {
        let [ll, la, aa, lb, ab, bb] = covariance;
        let c00 = ll.sqrt();
        let (c10, c20) = (la / c00, lb / c00);
        let c11 = (aa - c10 * c10).max(1e-9).sqrt();
        let c21 = (ab - c20 * c10) / c11;
        let c22 = (bb - c20 * c20 - c21 * c21).max(1e-9).sqrt();
        let (i0, i1, i2) = (1.0 / c00, 1.0 / c11, 1.0 / c22);
        let i10 = -c10 * i0 * i1;
        let i21 = -c21 * i1 * i2;
        let i20 = -(c20 * i0 + c21 * i10) * i2;
        // ln (2π)^(3/2) = 2.757.
        let log_peak = f64::from(weight.max(1e-6)).ln() - 2.757 + i0.ln() + i1.ln() + i2.ln();
        Self { mean, whiten: [i0, i10, i1, i20, i21, i2].map(|v| v as f32), log_peak: log_peak as f32, weight }
    }

    fn log(&self, lab: Lab) -> f32 {
        let [l, a, b] = [lab[0] - self.mean[0], lab[1] - self.mean[1], lab[2] - self.mean[2]];
        let w = &self.whiten;
        let (x, y, z) = (w[0] * l, w[1] * l + w[2] * a, w[3] * l + w[4] * a + w[5] * b);
        self.log_peak - 0.5 * (x * x + y * y + z * z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mixture_finds_the_two_colours_that_it_was_made_of() {
        let wave = |i: usize, k: f32| ((i as f32 * k).sin() * 0.02, (i as f32 * k * 1.7).cos() * 0.01);
        let samples: Vec<(Lab, f32)> = (0..400)
            .map(|i| {
                let (u, v) = wave(i, 1.3);
                if i % 4 == 0 { ([0.3 + u, 0.02 + v, 0.03], 1.0) } else { ([0.7 + u, 0.05, 0.06 + v], 1.0) }
            })
            .collect();
        let mixture = Mixture::of(&samples, 2, LEAST).unwrap_or_else(|| panic!("there are colours"));
        assert!((mixture.heaviest()[0] - 0.7).abs() < 0.02);
        assert!(mixture.log([0.3, 0.02, 0.03]) > mixture.log([0.5, 0.03, 0.05]) + 5.0);
        assert!(Mixture::of(&[], 2, LEAST).is_none());
    }
}

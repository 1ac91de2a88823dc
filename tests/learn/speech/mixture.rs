//! Mixtures of Gaussians from frames, by splitting and expectation maximisation.

use lianpu::speech::training::{DIMS, Gaussian, Terms};

/// Frames one after the other.
#[derive(Default, Clone)]
pub struct Frames(pub Vec<f32>);

impl Frames {
    pub fn len(&self) -> usize {
        self.0.len() / DIMS
    }

    pub fn iter(&self) -> impl Iterator<Item = &[f32]> {
        self.0.chunks_exact(DIMS)
    }
}

/// One Gaussian of all frames; variances are at least `floor`.
pub fn single(frames: &Frames, floor: &[f32; DIMS]) -> Gaussian {
    let n = frames.len().max(1) as f64;
    let (mut sum, mut square) = ([0.0_f64; DIMS], [0.0_f64; DIMS]);
    for frame in frames.iter() {
        for d in 0..DIMS {
            sum[d] += f64::from(frame[d]);
            square[d] += f64::from(frame[d]) * f64::from(frame[d]);
        }
    }
    Gaussian {
        weight: 0.0,
        mean: std::array::from_fn(|d| (sum[d] / n) as f32),
        variance: std::array::from_fn(|d| ((square[d] / n - (sum[d] / n).powi(2)) as f32).max(0.0) + floor[d]),
    }
}

/// Up to `most` Gaussians, each with at least 60 frames.
pub fn mixture(frames: &Frames, most: usize, floor: &[f32; DIMS]) -> Vec<Gaussian> {
    let most = most.min(frames.len() / 60).max(1);
    let mut all = vec![single(frames, floor)];
    while all.len() < most {
        // The heaviest are split in two, along where they are widest.
        let mut order: Vec<usize> = (0..all.len()).collect();
        order.sort_by(|a, b| all[*b].weight.total_cmp(&all[*a].weight));
        for at in order.into_iter().take(most - all.len()) {
            let g = &mut all[at];
            g.weight -= std::f32::consts::LN_2;
            let mut other = g.clone();
            for d in 0..DIMS {
                let step = 0.4 * g.variance[d].sqrt() * if (d * 7 + at) % 3 == 0 { -1.0 } else { 1.0 };
                g.mean[d] += step;
                other.mean[d] -= step;
            }
            all.push(other);
        }
        for _ in 0..5 {
            all = again(frames, &all, floor);
        }
    }
    for _ in 0..4 {
        all = again(frames, &all, floor);
    }
    all
}

fn again(frames: &Frames, old: &[Gaussian], floor: &[f32; DIMS]) -> Vec<Gaussian> {
    let terms: Vec<Terms> = old.iter().map(Terms::of).collect();
    let mut sums = vec![(0.0_f64, [0.0_f64; DIMS], [0.0_f64; DIMS]); old.len()];
    let mut values = vec![0.0_f32; old.len()];
    for frame in frames.iter() {
        for (v, t) in values.iter_mut().zip(&terms) {
            *v = t.at(frame);
        }
        let best = values.iter().copied().fold(f32::MIN, f32::max);
        let total: f32 = values.iter().map(|v| (v - best).exp()).sum();
        for (v, (n, sum, square)) in values.iter().zip(&mut sums) {
            let share = f64::from((v - best).exp() / total);
            if share < 1e-4 {
                continue;
            }
            *n += share;
            for d in 0..DIMS {
                let x = f64::from(frame[d]);
                sum[d] += share * x;
                square[d] += share * x * x;
            }
        }
    }
    let all: f64 = sums.iter().map(|s| s.0).sum();
    old.iter()
        .zip(&sums)
        .map(|(g, (n, sum, square))| {
            if *n < 10.0 {
                return Gaussian { weight: -7.0, ..g.clone() };
            }
            Gaussian {
                weight: (n / all).ln() as f32,
                mean: std::array::from_fn(|d| (sum[d] / n) as f32),
                variance: std::array::from_fn(|d| ((square[d] / n - (sum[d] / n).powi(2)) as f32).max(0.0) + floor[d]),
            }
        })
        .collect()
}

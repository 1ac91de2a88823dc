//! What every unit sounds like: mixtures of Gaussians with a diagonal covariance, as they are learned, kept in a file,
//! and made ready for a recording.

use std::sync::LazyLock;

use super::confidence::SIGNS;
use super::features::{DIMS, Features};
use super::units::{UNITS, Unit};

/// What was learned of speech; `NOTES.md` beside it says from what.
static LEARNED: &[u8] = include_bytes!("learned.bin");

/// Frames that are judged at a time.
const BLOCK: usize = 16;

/// One Gaussian of a mixture.
#[derive(Debug, Clone, PartialEq)]
pub struct Gaussian {
    /// The logarithm of its weight.
    pub weight: f32,
    /// Its mean.
    pub mean: [f32; DIMS],
    /// Its variances.
    pub variance: [f32; DIMS],
}

/// What every unit sounds like.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    /// The Gaussians of each of [`UNITS`].
    pub mixtures: Vec<Vec<Gaussian>>,
    /// How the signs of a syllable tell how sure its times are.
    pub confidence: [f32; SIGNS],
}

/// The terms of a Gaussian, worked out: its logarithm is constant + Σ x (linear + square · x).
#[derive(Debug, Clone)]
pub struct Terms {
    constant: f32,
    linear: [f32; DIMS],
    square: [f32; DIMS],
}

impl Terms {
    /// Of a Gaussian.
    #[must_use]
    pub fn of(gaussian: &Gaussian) -> Self {
        let mut constant = gaussian.weight;
        for (m, v) in gaussian.mean.iter().zip(&gaussian.variance) {
            constant -= 0.5 * (m * m / v + (std::f32::consts::TAU * v).ln());
        }
        let linear = std::array::from_fn(|d| gaussian.mean[d] / gaussian.variance[d]);
        let square = std::array::from_fn(|d| -0.5 / gaussian.variance[d]);
        Self { constant, linear, square }
    }

    /// The logarithm of its density at a frame.
    #[must_use]
    pub fn at(&self, frame: &[f32]) -> f32 {
        let terms = self.linear.iter().zip(&self.square).zip(frame);
        self.constant + terms.map(|((l, s), x)| x * (l + s * x)).sum::<f32>()
    }
}

/// The logarithm of the density of every unit asked for at every frame, unit by unit: of a mixture its best Gaussian
/// counts, which is most of the sum and needs no logarithms.
#[must_use]
pub(crate) fn judge(mixtures: &[Vec<Terms>], heard: &Features) -> Vec<Vec<f32>> {
    let count = heard.len();
    let mut out: Vec<Vec<f32>> = mixtures.iter().map(|_| Vec::with_capacity(count + BLOCK)).collect();
    let mut block = [[0.0_f32; BLOCK]; DIMS];
    for from in (0..count).step_by(BLOCK) {
        for i in 0..BLOCK {
            let frame = heard.frame((from + i).min(count - 1));
            for (row, x) in block.iter_mut().zip(frame) {
                row[i] = *x;
            }
        }
        for (terms, out) in mixtures.iter().zip(&mut out) {
            let mut best = [f32::NEG_INFINITY; BLOCK];
            for term in terms {
                let mut sum = [term.constant; BLOCK];
                for ((row, l), s) in block.iter().zip(&term.linear).zip(&term.square) {
                    for i in 0..BLOCK {
                        sum[i] += row[i] * (l + s * row[i]);
                    }
                }
                for i in 0..BLOCK {
                    best[i] = if sum[i] > best[i] { sum[i] } else { best[i] };
                }
            }
            out.extend_from_slice(&best);
        }
    }
    for row in &mut out {
        row.truncate(count);
    }
    out
}

impl Model {
    /// The one that comes with the program.
    #[must_use]
    pub(crate) fn learned() -> &'static Self {
        static MODEL: LazyLock<Model> = LazyLock::new(|| {
            // The file is part of the program: a fault in it is ours and the tests'.
            Model::read(LEARNED)
                .unwrap_or_else(|| Model { mixtures: vec![Vec::new(); UNITS.len()], confidence: [0.0; SIGNS] })
        });
        &MODEL
    }

    /// The Gaussians of a unit.
    #[must_use]
    pub fn of(&self, unit: Unit) -> &[Gaussian] {
        &self.mixtures[usize::from(unit)]
    }

    /// Reads what [`Self::write`] wrote; none where it is something else.
    #[must_use]
    pub fn read(bytes: &[u8]) -> Option<Self> {
        let mut at = 0;
        let mut take = |n: usize| {
            at += n;
            bytes.get(at - n..at)
        };
        if take(4)? != b"LPS1" || usize::from(take(1)?[0]) != UNITS.len() || usize::from(take(1)?[0]) != DIMS {
            return None;
        }
        let mut scales = [(0.0, 0.0, 0.0, 0.0); DIMS];
        for scale in &mut scales {
            let mut number = || Some(f32::from_le_bytes(take(4)?.try_into().ok()?));
            *scale = (number()?, number()?, number()?, number()?);
        }
        let mut confidence = [0.0; SIGNS];
        for weight in &mut confidence {
            *weight = f32::from_le_bytes(take(4)?.try_into().ok()?);
        }
        let mut mixtures = Vec::new();
        for _ in UNITS {
            let count = take(1)?[0];
            let mut mixture = Vec::new();
            for _ in 0..count {
                let weight = -f32::from(take(1)?[0]) / 32.0;
                let (mut mean, mut variance) = ([0.0; DIMS], [0.0; DIMS]);
                for (m, scale) in mean.iter_mut().zip(&scales) {
                    *m = scale.0 + scale.1 * f32::from(u16::from_le_bytes(take(2)?.try_into().ok()?)) / 65535.0;
                }
                for (v, scale) in variance.iter_mut().zip(&scales) {
                    *v = (scale.2 + scale.3 * f32::from(take(1)?[0]) / 255.0).exp();
                }
                mixture.push(Gaussian { weight, mean, variance });
            }
            mixtures.push(mixture);
        }
        take(1).is_none().then_some(Self { mixtures, confidence })
    }

    /// In bytes: a mean in two, a variance and a weight in one, each dimension with a scale of its own.
    #[cfg(any(test, feature = "tools"))]
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let mut out = b"LPS1".to_vec();
        out.extend([self.mixtures.len() as u8, DIMS as u8]);
        let all = || self.mixtures.iter().flatten();
        let range = |of: &dyn Fn(&Gaussian) -> f32| {
            let (low, high) = all().map(of).fold((f32::MAX, f32::MIN), |(l, h), x| (l.min(x), h.max(x)));
            (low, (high - low).max(1e-6))
        };
        let scales: Vec<_> = (0..DIMS).map(|d| (range(&|g| g.mean[d]), range(&|g| g.variance[d].ln()))).collect();
        for (m, v) in &scales {
            for number in [m.0, m.1, v.0, v.1] {
                out.extend(number.to_le_bytes());
            }
        }
        for weight in self.confidence {
            out.extend(weight.to_le_bytes());
        }
        for mixture in &self.mixtures {
            out.push(mixture.len() as u8);
            for gaussian in mixture {
                out.push((-gaussian.weight * 32.0).round().clamp(0.0, 255.0) as u8);
                for (x, (scale, _)) in gaussian.mean.iter().zip(&scales) {
                    out.extend((((x - scale.0) / scale.1 * 65535.0).round() as u16).to_le_bytes());
                }
                for (x, (_, scale)) in gaussian.variance.iter().zip(&scales) {
                    out.push(((x.ln() - scale.0) / scale.1 * 255.0).round() as u8);
                }
            }
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gaussian(seed: f32) -> Gaussian {
        Gaussian {
            weight: -1.0,
            mean: std::array::from_fn(|d| (seed + d as f32).sin() * 3.0),
            variance: std::array::from_fn(|d| 1.0 + (seed * 3.0 + d as f32).cos().abs()),
        }
    }

    #[test]
    fn what_is_written_is_read() {
        let model = Model {
            mixtures: (0..UNITS.len()).map(|u| (0..u % 3).map(|k| gaussian((u + k) as f32)).collect()).collect(),
            confidence: [0.5; SIGNS],
        };
        let bytes = model.write();
        let read = Model::read(&bytes).unwrap();
        for (a, b) in model.mixtures.iter().flatten().zip(read.mixtures.iter().flatten()) {
            assert!((a.weight - b.weight).abs() < 0.02);
            for d in 0..DIMS {
                assert!((a.mean[d] - b.mean[d]).abs() < 1e-3, "{} {}", a.mean[d], b.mean[d]);
                assert!((a.variance[d] / b.variance[d] - 1.0).abs() < 0.01);
            }
        }
        for cut in [0, 3, 100, bytes.len() - 1] {
            assert!(Model::read(&bytes[..cut]).is_none());
        }
    }

    #[test]
    fn the_learned_model_has_every_unit() {
        let model = Model::learned();
        for (kind, mixture) in UNITS.iter().zip(&model.mixtures) {
            assert!(!mixture.is_empty(), "{}", kind.name);
        }
    }

    #[test]
    fn frames_are_judged_as_one_by_one() {
        let heard = Features {
            values: (0..37 * DIMS).map(|i| ((i * i) as f32 * 0.37).sin() * 4.0).collect(),
            levels: vec![0.0; 37],
            ..Features::default()
        };
        let terms: Vec<Vec<Terms>> =
            vec![vec![Terms::of(&gaussian(1.0)), Terms::of(&gaussian(2.0))], vec![Terms::of(&gaussian(5.0))]];
        let judged = judge(&terms, &heard);
        for (row, terms) in judged.iter().zip(&terms) {
            assert_eq!(row.len(), 37);
            for (n, value) in row.iter().enumerate() {
                let best = terms.iter().map(|t| t.at(heard.frame(n))).fold(f32::MIN, f32::max);
                assert!((value - best).abs() < 1e-3 * best.abs().max(1.0));
            }
        }
    }
}

//! Curves through key frames: linear, smooth, or held, chosen per key.

use serde::{Deserialize, Serialize};

/// How a value travels from its key to the next one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Ease {
    /// In a straight line.
    Linear,
    /// Along a monotone cubic: no corner at a key between two smooth stretches, and never beyond the two keys.
    #[default]
    Smooth,
    /// Not at all, until the next key.
    Hold,
}

/// A value of N numbers over time. Before the first key it is the first key's, after the last the last's.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Curve<const N: usize> {
    keys: Vec<(f64, [f64; N], Ease)>,
    /// Change per second at every key, of the smooth stretches.
    slopes: Vec<[f64; N]>,
}

impl<const N: usize> Curve<N> {
    /// A curve through keys, which are put in order; of two at one time the later given holds.
    pub(super) fn new(keys: impl IntoIterator<Item = (f64, [f64; N], Ease)>) -> Self {
        let mut keys: Vec<_> = keys.into_iter().collect();
        keys.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut distinct: Vec<(f64, [f64; N], Ease)> = Vec::with_capacity(keys.len());
        for key in keys {
            match distinct.last_mut() {
                Some(last) if key.0 - last.0 < 1e-9 => *last = key,
                _ => distinct.push(key),
            }
        }
        let slopes = (0..distinct.len()).map(|i| slope(&distinct, i)).collect();
        Self { keys: distinct, slopes }
    }

    /// The value at `t`; none without keys.
    pub(super) fn at(&self, t: f64) -> Option<[f64; N]> {
        let after = self.keys.partition_point(|k| k.0 <= t);
        if after == 0 {
            return self.keys.first().map(|k| k.1);
        }
        let (Some(a), Some(b)) = (self.keys.get(after - 1), self.keys.get(after)) else {
            return self.keys.last().map(|k| k.1);
        };
        let span = b.0 - a.0;
        let u = ((t - a.0) / span).clamp(0.0, 1.0);
        Some(match a.2 {
            Ease::Hold => a.1,
            Ease::Linear => std::array::from_fn(|i| a.1[i] + (b.1[i] - a.1[i]) * u),
            Ease::Smooth => {
                let (u2, u3) = (u * u, u * u * u);
                let (from, to) = (&self.slopes[after - 1], &self.slopes[after]);
                std::array::from_fn(|i| {
                    (2.0 * u3 - 3.0 * u2 + 1.0) * a.1[i]
                        + (u3 - 2.0 * u2 + u) * span * from[i]
                        + (3.0 * u2 - 2.0 * u3) * b.1[i]
                        + (u3 - u2) * span * to[i]
                })
            }
        })
    }

    /// Time of the first and of the last key.
    pub(super) fn span(&self) -> Option<(f64, f64)> {
        Some((self.keys.first()?.0, self.keys.last()?.0))
    }
}

/// The slope at a key by Fritsch and Carlson (1980): the weighted harmonic mean of the slopes on both sides, 0 at a
/// peak, at an end, and where a side is not smooth. It keeps every stretch between its two keys.
fn slope<const N: usize>(keys: &[(f64, [f64; N], Ease)], i: usize) -> [f64; N] {
    let (Some(before), Some(after)) = (i.checked_sub(1).and_then(|j| keys.get(j)), keys.get(i + 1)) else {
        return [0.0; N];
    };
    let key = &keys[i];
    if before.2 != Ease::Smooth || key.2 != Ease::Smooth {
        return [0.0; N];
    }
    let (h0, h1) = (key.0 - before.0, after.0 - key.0);
    std::array::from_fn(|n| {
        let (d0, d1) = ((key.1[n] - before.1[n]) / h0, (after.1[n] - key.1[n]) / h1);
        if d0 * d1 <= 0.0 {
            return 0.0;
        }
        let (w0, w1) = (2.0 * h1 + h0, h1 + 2.0 * h0);
        (w0 + w1) / (w0 / d0 + w1 / d1)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn each_ease_meets_its_keys_and_holds_beyond_the_ends() {
        for ease in [Ease::Linear, Ease::Smooth, Ease::Hold] {
            let curve = Curve::new(vec![(1.0, [0.0], ease), (2.0, [4.0], ease), (3.0, [1.0], ease)]);
            for (t, v) in [(0.0, 0.0), (1.0, 0.0), (2.0, 4.0), (3.0, 1.0), (9.0, 1.0)] {
                assert_eq!(curve.at(t), Some([v]), "{ease:?} at {t}");
            }
        }
    }

    proptest! {
        #[test]
        fn a_smooth_curve_has_no_corner_and_never_leaves_its_two_keys(
            values in prop::collection::vec((0.1..1.0f64, -2.0..2.0f64), 3..9),
        ) {
            let mut t = 0.0;
            let keys: Vec<_> = values.iter().map(|(dt, v)| { t += dt; (t, [*v], Ease::Smooth) }).collect();
            let curve = Curve::new(keys.clone());
            for pair in keys.windows(2) {
                let (low, high) = (pair[0].1[0].min(pair[1].1[0]), pair[0].1[0].max(pair[1].1[0]));
                for i in 0..=50 {
                    let v = curve.at(pair[0].0 + (pair[1].0 - pair[0].0) * f64::from(i) / 50.0).unwrap()[0];
                    prop_assert!(v >= low - 1e-9 && v <= high + 1e-9);
                }
            }
            for key in &keys[1..keys.len() - 1] {
                let h = 1e-6;
                let at = |t| curve.at(t).unwrap()[0];
                let (left, right) = ((at(key.0) - at(key.0 - h)) / h, (at(key.0 + h) - at(key.0)) / h);
                prop_assert!((left - right).abs() < 1e-2 * (1.0 + left.abs()), "{left} {right}");
            }
        }
    }
}

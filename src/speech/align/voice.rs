//! The model made ready for one voice: the silence of its recording beside the learned one, and the means moved towards
//! what is heard where each unit was found (MAP).

use super::features::{DIMS, Features};
use super::model::{Gaussian, Model, Terms};
use super::units::{ANY, SILENCE, UNITS, Unit};

/// What is learned counts as much as so many frames of the recording.
const TAU: f32 = 40.0;

/// A unit that was found in fewer frames is left as it is.
const FEWEST: f32 = 3.0;

/// The silence of a recording: its quietest frames, spread a little more widely than they are.
#[must_use]
pub(crate) fn silence(heard: &Features) -> Option<Gaussian> {
    let count = heard.len();
    let spread = |only: Option<&[bool]>| {
        let (mut sum, mut square, mut number) = ([0.0_f64; DIMS], [0.0_f64; DIMS], 0.0_f64);
        for n in 0..count {
            if only.is_some_and(|o| !o[n]) {
                continue;
            }
            number += 1.0;
            for (d, x) in heard.frame(n).iter().enumerate() {
                sum[d] += f64::from(*x);
                square[d] += f64::from(*x) * f64::from(*x);
            }
        }
        let mean: [f64; DIMS] = std::array::from_fn(|d| sum[d] / number.max(1.0));
        let variance: [f64; DIMS] = std::array::from_fn(|d| square[d] / number.max(1.0) - mean[d] * mean[d]);
        (mean, variance, number)
    };
    let (mean, quiet, number) = spread(Some(&heard.quiet));
    let (_, all, _) = spread(None);
    (number > 0.0).then(|| Gaussian {
        weight: 0.0,
        mean: mean.map(|m| m as f32),
        variance: std::array::from_fn(|d| (1.5 * quiet[d]).max(0.15 * all[d]).max(1e-3) as f32),
    })
}

/// What was heard where each unit was found: for each of its Gaussians how many frames, and their sum.
#[derive(Debug, Clone)]
pub struct Heard {
    units: Vec<Vec<(f32, [f32; DIMS])>>,
}

impl Heard {
    /// Nothing yet.
    #[must_use]
    pub(crate) fn nothing(model: &Model) -> Self {
        Self { units: model.mixtures.iter().map(|m| vec![(0.0, [0.0; DIMS]); m.len()]).collect() }
    }

    /// What a recording has of each unit: `labels` has one for each frame.
    #[must_use]
    pub(crate) fn of(model: &Model, heard: &Features, labels: &[Unit]) -> Self {
        let mut out = Self::nothing(model);
        let terms: Vec<Vec<Terms>> = model.mixtures.iter().map(|m| m.iter().map(Terms::of).collect()).collect();
        for (n, label) in labels.iter().enumerate() {
            if *label == SILENCE {
                continue;
            }
            let frame = heard.frame(n);
            // All that is said is any voice too.
            for unit in [*label, ANY] {
                out.add(usize::from(unit), &terms[usize::from(unit)], frame);
                if *label == ANY {
                    break;
                }
            }
        }
        out
    }

    fn add(&mut self, unit: usize, terms: &[Terms], frame: &[f32]) {
        let mut values = [0.0_f32; 64];
        let values = &mut values[..terms.len().min(64)];
        let mut best = f32::NEG_INFINITY;
        for (value, term) in values.iter_mut().zip(terms) {
            *value = term.at(frame);
            best = best.max(*value);
        }
        let mut sum = 0.0;
        for value in values.iter_mut() {
            // What is e⁻¹² as likely has no part in it.
            *value = if *value > best - 12.0 { (*value - best).exp() } else { 0.0 };
            sum += *value;
        }
        for (value, (number, total)) in values.iter().zip(&mut self.units[unit]) {
            let share = value / sum;
            if share > 0.0 {
                *number += share;
                for (t, x) in total.iter_mut().zip(frame) {
                    *t += share * x;
                }
            }
        }
    }

    /// How many frames there were, each counted once.
    #[must_use]
    pub(crate) fn frames(&self) -> f32 {
        self.units[usize::from(ANY)].iter().map(|h| h.0).sum()
    }

    /// Together with what was heard elsewhere.
    pub(crate) fn and(&mut self, other: &Self, times: f32) {
        for (mine, theirs) in self.units.iter_mut().flatten().zip(other.units.iter().flatten()) {
            mine.0 += times * theirs.0;
            for (m, t) in mine.1.iter_mut().zip(&theirs.1) {
                *m += times * t;
            }
        }
    }

    /// The model with its means moved towards what was heard.
    #[must_use]
    pub(crate) fn moved(&self, model: &Model) -> Model {
        let mixtures = model.mixtures.iter().zip(&self.units).map(|(mixture, heard)| {
            let frames: f32 = heard.iter().map(|h| h.0).sum();
            if frames < FEWEST {
                return mixture.clone();
            }
            let moved = |(gaussian, (number, sum)): (&Gaussian, &(f32, [f32; DIMS]))| Gaussian {
                mean: std::array::from_fn(|d| (TAU * gaussian.mean[d] + sum[d]) / (TAU + number)),
                ..gaussian.clone()
            };
            mixture.iter().zip(heard).map(moved).collect()
        });
        Model { mixtures: mixtures.collect(), ..*model }
    }
}

/// Terms of silence, of any voice, and of each unit asked for; and for each unit its row.
#[must_use]
pub(crate) fn ready(model: &Model, units: &[Unit], silence: Option<&Gaussian>) -> (Vec<Vec<Terms>>, Vec<usize>) {
    let mut rows = vec![1; UNITS.len()];
    rows[usize::from(SILENCE)] = 0;
    let terms = |unit: Unit| -> Vec<Terms> { model.of(unit).iter().map(Terms::of).collect() };
    let mut out = vec![terms(SILENCE), terms(ANY)];
    out[0].extend(silence.map(Terms::of));
    for unit in units {
        if !matches!(*unit, SILENCE | ANY) {
            rows[usize::from(*unit)] = out.len();
            out.push(terms(*unit));
        }
    }
    (out, rows)
}

/// How much better a model fits what was found than another, in logarithms a frame.
#[must_use]
pub(crate) fn gain(before: &Model, after: &Model, heard: &Features, labels: &[Unit]) -> f32 {
    let terms =
        |m: &Model| -> Vec<Vec<Terms>> { m.mixtures.iter().map(|m| m.iter().map(Terms::of).collect()).collect() };
    let (before, after) = (terms(before), terms(after));
    let (mut sum, mut frames) = (0.0_f64, 0_usize);
    // Every third frame says as much as all.
    for (n, label) in labels.iter().enumerate().step_by(3).filter(|l| *l.1 != SILENCE) {
        let frame = heard.frame(n);
        let fit = |t: &[Vec<Terms>]| t[usize::from(*label)].iter().map(|t| t.at(frame)).fold(f32::MIN, f32::max);
        sum += f64::from(fit(&after) - fit(&before));
        frames += 1;
    }
    (sum / frames.max(1) as f64) as f32
}

#[cfg(test)]
mod tests {
    use super::super::units::CLOSURE;
    use super::*;

    fn model() -> Model {
        let gaussian = |m: f32| Gaussian { weight: 0.0, mean: [m; DIMS], variance: [1.0; DIMS] };
        let mixtures = (0..UNITS.len()).map(|u| vec![gaussian(u as f32)]).collect();
        Model { mixtures, confidence: [0.0; super::super::confidence::SIGNS] }
    }

    fn heard(value: f32, frames: usize) -> Features {
        Features { values: vec![value; frames * DIMS], levels: vec![0.0; frames], ..Features::default() }
    }

    #[test]
    fn the_mean_moves_half_way_after_as_many_frames_as_the_learned_counts_for() {
        let model = model();
        let heard = Heard::of(&model, &heard(4.0, 40), &[CLOSURE; 40]);
        let moved = heard.moved(&model);
        assert!((moved.of(CLOSURE)[0].mean[3] - 3.0).abs() < 1e-5);
        assert!((moved.of(ANY)[0].mean[0] - 2.5).abs() < 1e-5, "what is said is any voice too");
        assert_eq!(moved.of(SILENCE), model.of(SILENCE));
    }

    #[test]
    fn a_voice_of_the_same_kind_is_a_gain_and_another_is_none() {
        let model = model();
        let others = Heard::of(&model, &heard(4.0, 400), &[CLOSURE; 400]).moved(&model);
        assert!(gain(&model, &others, &heard(4.1, 30), &[CLOSURE; 30]) > 1.0);
        assert!(gain(&model, &others, &heard(0.5, 30), &[CLOSURE; 30]) < 0.0);
    }
}

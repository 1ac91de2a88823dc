//! How far found times are from true ones.

use lianpu::speech::Alignment;

/// A gap between two syllables that is shorter than this is the closure of a stop, or nothing: a boundary may lie anywhere
/// in it. Seconds.
const GAP: f64 = 0.08;

/// Distances from the truth, in seconds, later than it above 0.
#[derive(Default, Clone)]
pub struct Errors(pub Vec<f64>);

/// The distances of the start and of the end of each syllable.
pub fn per_syllable(truth: &[(f64, f64)], found: &[(f64, f64)]) -> Vec<[f64; 2]> {
    assert_eq!(truth.len(), found.len());
    let off = |at: f64, from: f64, to: f64| if at < from { at - from } else { (at - to).max(0.0) };
    let all = truth.iter().zip(found).enumerate();
    all.map(|(i, (t, f))| {
        let before = i.checked_sub(1).map(|b| truth[b].1).filter(|end| (0.0..GAP).contains(&(t.0 - end)));
        let after = truth.get(i + 1).map(|next| next.0).filter(|start| (0.0..GAP).contains(&(start - t.1)));
        [off(f.0, before.unwrap_or(t.0), t.0), off(f.1, t.1, after.unwrap_or(t.1))]
    })
    .collect()
}

pub fn times(alignment: &Alignment) -> Vec<(f64, f64)> {
    alignment.syllables.iter().map(|s| (s.start, s.end)).collect()
}

impl Errors {
    pub fn add(&mut self, truth: &[(f64, f64)], found: &Alignment) {
        self.0.extend(per_syllable(truth, &times(found)).into_iter().flatten());
    }

    /// Mean distance, in milliseconds.
    pub fn mean(&self) -> f64 {
        1000.0 * self.0.iter().map(|e| e.abs()).sum::<f64>() / self.0.len().max(1) as f64
    }

    /// Of a hundred, how many are within some seconds.
    pub fn within(&self, limit: f64) -> f64 {
        // What is written in truth to a tenth of a millisecond is not told apart more finely.
        let near = self.0.iter().filter(|e| e.abs() <= limit + 1e-4).count();
        100.0 * near as f64 / self.0.len().max(1) as f64
    }

    /// What the middle of all is off by, taken off.
    pub fn without_offset(&self) -> (Self, f64) {
        let mut sorted = self.0.clone();
        sorted.sort_by(f64::total_cmp);
        let offset = sorted.get(sorted.len() / 2).copied().unwrap_or(0.0);
        (Self(self.0.iter().map(|e| e - offset).collect()), offset)
    }

    pub fn say(&self, what: &str) {
        let worst = self.0.iter().fold(0.0_f64, |a, e| a.max(e.abs()));
        println!(
            "{what}: {} boundaries, mean {:.1} ms, within 20 ms {:.1} %, 50 ms {:.1} %, 100 ms {:.1} %, worst {:.0} ms",
            self.0.len(),
            self.mean(),
            self.within(0.02),
            self.within(0.05),
            self.within(0.1),
            worst * 1000.0
        );
    }
}

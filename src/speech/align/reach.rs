//! How far a search has come: the best score of each frame within a band, and the step from the beginnings of a unit to
//! its ends, which is where a search spends its time.

use super::lasting::Lasting;

/// The score of what cannot be.
pub(crate) const NEVER: f64 = f64::NEG_INFINITY;

/// Where an end may lie: frames, both included.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Band {
    /// The first.
    pub low: usize,
    /// The last.
    pub high: usize,
}

/// The best scores of reaching each frame of a band.
pub(crate) struct Reached {
    /// The frames.
    pub band: Band,
    /// A score for each.
    pub scores: Vec<f64>,
}

impl Reached {
    /// The score of a frame; [`NEVER`] outside the band.
    #[must_use]
    pub(crate) fn at(&self, t: usize) -> f64 {
        if t < self.band.low { NEVER } else { self.scores.get(t - self.band.low).copied().unwrap_or(NEVER) }
    }
}

/// From the beginnings of a unit to its ends: the best score of each end, and how many frames it lasts then.
#[must_use]
pub(crate) fn extend(before: &Reached, to: Band, row: &[f32], lasting: &Lasting) -> (Reached, Vec<u16>) {
    let from = before.band.low;
    let width = to.high + 1 - to.low;
    // Sums within the band are small enough for f32; what came before is kept apart.
    let base = before.scores.iter().copied().fold(NEVER, f64::max);
    if base == NEVER {
        return (Reached { band: to, scores: vec![NEVER; width] }, vec![0; width]);
    }
    let mut sums = Vec::with_capacity(to.high + 1 - from);
    let mut sum = 0.0_f32;
    sums.push(0.0);
    for t in from..to.high {
        sum += row.get(t).copied().unwrap_or(0.0);
        sums.push(sum);
    }
    let entered: Vec<f32> = before.scores.iter().zip(&sums).map(|(s, c)| (s - base) as f32 - c).collect();
    let mut best = vec![f32::NEG_INFINITY; width];
    let mut lengths = vec![0_u16; width];
    for (i, value) in lasting.values.iter().enumerate() {
        let length = lasting.least + i;
        // Ends t with a beginning t − length inside the band of beginnings.
        let first = (from + length).max(to.low);
        let last = (before.band.high + length).min(to.high);
        if first > last {
            continue;
        }
        let beginnings = &entered[first - length - from..=last - length - from];
        let (ends, long) = (&mut best[first - to.low..=last - to.low], &mut lengths[first - to.low..=last - to.low]);
        for ((b, e), l) in beginnings.iter().zip(ends).zip(long) {
            let candidate = b + value;
            *l = if candidate > *e { length as u16 } else { *l };
            *e = if candidate > *e { candidate } else { *e };
        }
    }
    let scores = best.iter().enumerate().map(|(i, b)| f64::from(*b + sums[to.low + i - from]) + base).collect();
    (Reached { band: to, scores }, lengths)
}

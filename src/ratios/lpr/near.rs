//! Which whole numbers are written for values: near enough, and cheap.

use super::channel::Group;

/// Each of the seven ratios comes back within so many hundredths. A hair less than 1, for the rounding of what is read.
const RATIO_REACH: f64 = 1.0 - 1e-7;

/// What the square of an error of a hundredth is worth, in 256ths of a bit: the mean error stays below 0.004.
const WORTH: f64 = 512.0;

/// Hundredths of the six ratios after neutral, so that neutral too is within a hundredth.
pub(super) fn ratios(group: &Group, ratios: &[f64; 7]) -> [i64; 6] {
    let aims: [f64; 6] = std::array::from_fn(|i| 100.0 * ratios[i + 1]);
    let choices = aims.map(|aim| {
        let (low, high) = ((aim - RATIO_REACH).ceil() as i64, (aim + RATIO_REACH).floor() as i64);
        (low..=high.min(low + 1)).collect::<Vec<_>>()
    });
    let costs = group.costs(&choices);
    let mut best: Option<(f64, [i64; 6])> = None;
    for set in 0..64_usize {
        let mut values = [0; 6];
        let (mut cost, mut sum) = (0.0, 0.0);
        let is_there = (0..6).all(|i| {
            let pick = set >> i & 1;
            let Some(value) = choices[i].get(pick) else { return false };
            let off = *value as f64 - aims[i];
            values[i] = *value;
            sum += off;
            cost += f64::from(costs[i][pick]) + WORTH * off * off;
            true
        });
        cost += WORTH * sum * sum;
        if is_there && sum.abs() <= RATIO_REACH && best.is_none_or(|(least, _)| cost < least) {
            best = Some((cost, values));
        }
    }
    best.map_or(aims.map(|aim| aim.round() as i64), |(_, values)| values)
}

/// Whole numbers of other channels, `aims` in steps: within a step of each, a value on a step as it is.
pub(super) fn others(group: &Group, aims: &[f64]) -> Vec<i64> {
    let choices: Vec<Vec<i64>> = aims
        .iter()
        .map(|aim| {
            let (low, high) = (aim.floor() as i64, aim.ceil() as i64);
            (low..=high).collect()
        })
        .collect();
    let costs = group.costs(&choices);
    let pick = |(i, aim): (usize, &f64)| {
        let cost = |k: &usize| f64::from(costs[i][*k]) + WORTH * (choices[i][*k] as f64 - aim).powi(2);
        let best = (0..choices[i].len()).min_by(|a, b| cost(a).total_cmp(&cost(b)));
        best.map_or(0, |k| choices[i][k])
    };
    aims.iter().enumerate().map(pick).collect()
}

/// A confidence in 32nds; only a lost frame has none.
pub(super) fn confidence(group: &Group, confidence: f64) -> i64 {
    if confidence <= 0.0 {
        return 0;
    }
    others(group, &[32.0 * confidence.clamp(1.0 / 32.0, 1.0)])[0]
}

//! The nearest mix without a negative ratio: least squares over the simplex of the seven.

/// A member counts as outside the mix below this ratio.
const NOTHING: f64 = 1e-13;

/// Every step makes the misfit smaller, so no set of members comes twice, and there are 127.
const SETS: usize = 127;

/// The six ratios α ≥ 0 with Σ ≤ 1 (the rest is neutral's) that minimise `αᵀGα − 2bᵀα`: the solution itself, by active
/// sets (Lawson and Hanson 1974, ch. 23, with the sum held at 1), not an approach to it. `G` must be symmetric and not
/// negative; where it leaves the solution open, the members that came first are kept.
pub(super) fn nearest_mix(gram: &[[f64; 6]; 6], right: &[f64; 6]) -> [f64; 6] {
    // With neutral as a member of its own whose difference is zero, the seven sum to 1.
    let g = |i: usize, j: usize| if i == 0 || j == 0 { 0.0 } else { gram[i - 1][j - 1] };
    let b = |i: usize| if i == 0 { 0.0 } else { right[i - 1] };
    let scale = (0..6).map(|i| gram[i][i]).fold(f64::MIN_POSITIVE, f64::max);
    let alone = |i: usize| g(i, i) - 2.0 * b(i);
    let first = (1..7).fold(0, |best, i| if alone(i) < alone(best) { i } else { best });
    let mut mix = [0.0; 7];
    let mut inside = [false; 7];
    mix[first] = 1.0;
    inside[first] = true;
    for _ in 0..SETS {
        let slope: [f64; 7] = std::array::from_fn(|i| (0..7).map(|j| g(i, j) * mix[j]).sum::<f64>() - b(i));
        // Inside, all slopes are one and the same where the sum may not change.
        let level = (0..7).map(|i| slope[i] * mix[i]).sum::<f64>();
        let outside = (0..7).filter(|i| !inside[*i] && slope[*i] < level - 1e-12 * scale);
        let Some(next) = outside.reduce(|best, i| if slope[i] < slope[best] { i } else { best }) else { break };
        inside[next] = true;
        let mut comes_in = true;
        while let Some(aim) = solve(&inside, &g, &b, scale) {
            // A member that would leave at once is there by rounding alone.
            if std::mem::take(&mut comes_in) && aim[next] <= 0.0 {
                inside[next] = false;
                break;
            }
            let leaving = (0..7).filter(|i| inside[*i] && aim[*i] <= NOTHING);
            let reach = |i: usize| mix[i] / (mix[i] - aim[i]).max(f64::MIN_POSITIVE);
            let Some(stop) = leaving.reduce(|best, i| if reach(i) < reach(best) { i } else { best }) else {
                mix = aim;
                break;
            };
            let step = reach(stop).clamp(0.0, 1.0);
            for (now, aim) in mix.iter_mut().zip(aim) {
                *now += step * (aim - *now);
            }
            inside[stop] = false;
            for (member, now) in inside.iter_mut().zip(&mut mix) {
                *member = *member && *now > NOTHING;
                if !*member {
                    *now = 0.0;
                }
            }
        }
        if !inside[next] && mix[next] == 0.0 {
            break;
        }
    }
    let sum: f64 = mix.iter().sum();
    std::array::from_fn(|i| mix[i + 1].max(0.0) / sum)
}

/// The best mix of some members, of whatever sign, that sums to 1; none without members.
fn solve(
    inside: &[bool; 7],
    g: &impl Fn(usize, usize) -> f64,
    b: &impl Fn(usize) -> f64,
    scale: f64,
) -> Option<[f64; 7]> {
    let members: Vec<usize> = (0..7).filter(|i| inside[*i]).collect();
    let (&base, others) = members.split_first()?;
    // In differences to one of them: (Gij − Gi0 − G0j + G00) y = bi − b0 − Gi0 + G00.
    let n = others.len();
    let mut rows = [[0.0; 7]; 6];
    for (row, &i) in rows.iter_mut().zip(others) {
        for (cell, &j) in row.iter_mut().zip(others) {
            *cell = g(i, j) - g(i, base) - g(base, j) + g(base, base);
            // What the shapes leave open is closed by a hair.
            if i == j {
                *cell += 1e-13 * scale;
            }
        }
        row[6] = b(i) - b(base) - g(i, base) + g(base, base);
    }
    for k in 0..n {
        let pivot = (k..n).fold(k, |best, i| if rows[i][k].abs() > rows[best][k].abs() { i } else { best });
        rows.swap(k, pivot);
        let from = rows[k];
        if from[k].abs() < f64::MIN_POSITIVE {
            return None;
        }
        for row in &mut rows[k + 1..n] {
            let share = row[k] / from[k];
            for j in (k..n).chain([6]) {
                row[j] -= share * from[j];
            }
        }
    }
    let mut mix = [0.0; 7];
    mix[base] = 1.0;
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|j| rows[k][j] * mix[others[j]]).sum();
        mix[others[k]] = (rows[k][6] - known) / rows[k][k];
    }
    mix[base] = 1.0 - others.iter().map(|i| mix[*i]).sum::<f64>();
    Some(mix)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn cost(gram: &[[f64; 6]; 6], right: &[f64; 6], mix: &[f64; 6]) -> f64 {
        let square: f64 =
            (0..6).flat_map(|i| (0..6).map(move |j| (i, j))).map(|(i, j)| mix[i] * gram[i][j] * mix[j]).sum();
        square - 2.0 * mix.iter().zip(right).map(|(a, b)| a * b).sum::<f64>()
    }

    /// The best of all 127 sets of members, one by one.
    fn exhaustive(gram: &[[f64; 6]; 6], right: &[f64; 6]) -> f64 {
        let g = |i: usize, j: usize| if i == 0 || j == 0 { 0.0 } else { gram[i - 1][j - 1] };
        let b = |i: usize| if i == 0 { 0.0 } else { right[i - 1] };
        let scale = (0..6).map(|i| gram[i][i]).fold(f64::MIN_POSITIVE, f64::max);
        (1..128_u32)
            .filter_map(|set| solve(&std::array::from_fn(|i| set >> i & 1 == 1), &g, &b, scale))
            .filter(|mix| mix.iter().all(|m| *m >= -1e-12))
            .map(|mix| cost(gram, right, &std::array::from_fn(|i| mix[i + 1])))
            .fold(f64::INFINITY, f64::min)
    }

    proptest! {
        #[test]
        fn no_other_mix_is_nearer(
            cells in prop::collection::vec(-1.0..1.0_f64, 60),
            aim in prop::collection::vec(-2.0..2.0_f64, 10),
            equal in 0..3_usize,
        ) {
            let mut columns: Vec<&[f64]> = cells.chunks(10).collect();
            // Two emotions that are one and the same leave the solution open, and it is found all the same.
            if equal == 1 {
                columns[4] = columns[1];
            }
            let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
            let gram = std::array::from_fn(|i| std::array::from_fn(|j| dot(columns[i], columns[j])));
            let right = std::array::from_fn(|i| dot(columns[i], &aim));
            let mix = nearest_mix(&gram, &right);
            prop_assert!(mix.iter().all(|m| *m >= 0.0) && mix.iter().sum::<f64>() <= 1.0 + 1e-12);
            let (found, best) = (cost(&gram, &right, &mix), exhaustive(&gram, &right));
            prop_assert!(found <= best + 1e-9, "{found} {best}");
        }
    }
}

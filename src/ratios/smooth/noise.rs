//! How large the noise in a row of values is.

/// Fewer values say nothing of their noise.
pub(super) const ENOUGH: usize = 12;

/// The third difference at the last of four values: movement is smooth and leaves little of itself in it.
pub(super) fn third_difference(v: [f64; 4]) -> f64 {
    v[3] - 3.0 * v[2] + 3.0 * v[1] - v[0]
}

/// The deviation of white noise whose third differences these are: by their median, so that blinks and closures, which
/// are rare, do not count; 0 where they are too few. Of white noise a third difference has √20 times the deviation, and the median
/// size is 0.6745 deviations.
pub(super) fn deviation(differences: impl Iterator<Item = f64>) -> f64 {
    let mut sizes: Vec<f64> = differences.map(f64::abs).filter(|d| d.is_finite()).collect();
    if sizes.len() < ENOUGH {
        return 0.0;
    }
    let middle = sizes.len() / 2;
    let (_, median, _) = sizes.select_nth_unstable_by(middle, f64::total_cmp);
    *median / (0.6745 * 20_f64.sqrt())
}

//! What is said of frames: as times that an author finds again.

use std::fmt::Write;

/// So many stretches are named.
const NAMED: usize = 6;

/// Times of frames, rising, that are `step` seconds apart where they follow each other, as stretches: `1.20 to 1.64 s,
/// 3.08 s`.
pub(super) fn ranges(times: &[f64], step: f64) -> String {
    let mut stretches: Vec<(f64, f64)> = Vec::new();
    for t in times {
        match stretches.last_mut() {
            Some((_, last)) if t - *last < 1.5 * step => *last = *t,
            _ => stretches.push((*t, *t)),
        }
    }
    let mut text = String::new();
    for (n, (from, to)) in stretches.iter().take(NAMED).enumerate() {
        text.push_str(if n > 0 { ", " } else { "" });
        // Writing to a string cannot fail.
        let _ = if to > from { write!(text, "{from:.2} to {to:.2} s") } else { write!(text, "{from:.2} s") };
    }
    if stretches.len() > NAMED {
        let _ = write!(text, " and {} more", stretches.len() - NAMED);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_that_follow_each_other_are_one_stretch() {
        let times: Vec<f64> = [3, 4, 5, 9, 20, 21].map(|n| f64::from(n) / 25.0).into();
        assert_eq!(ranges(&times, 0.04), "0.12 to 0.20 s, 0.36 s, 0.80 to 0.84 s");
        let many: Vec<f64> = (0..9).map(f64::from).collect();
        assert!(ranges(&many, 0.04).ends_with("5.00 s and 3 more"));
    }
}

//! Syllables found without a script.

use lianpu::speech::nuclei;

use super::edits;
use super::recordings::{self, Recording};

/// Counts of nuclei.
#[derive(Default)]
struct Count {
    truth: usize,
    found: usize,
    /// True syllables with a nucleus inside.
    right: usize,
    /// Distances of the starts that were found from the true ones of the same syllables.
    starts: Vec<f64>,
    /// Differences of numbers, recording by recording.
    numbers: usize,
}

impl Count {
    fn of(what: &str, recordings: &[Recording]) -> Self {
        let mut all = Self::default();
        for recording in recordings {
            let heard = nuclei(&recording.sound);
            all.truth += recording.truth.len();
            all.found += heard.nuclei.len();
            all.numbers += recording.truth.len().abs_diff(heard.nuclei.len());
            for (start, end) in &recording.truth {
                if let Some(own) = heard.nuclei.iter().position(|n| (*start..=*end).contains(n)) {
                    all.right += 1;
                    all.starts.push((heard.syllables[own].0 - start).abs());
                }
            }
        }
        let start = all.starts.iter().sum::<f64>() / all.starts.len().max(1) as f64 * 1000.0;
        println!(
            "without a script, {what}: {} syllables, {} found, F {:.3}, numbers off by {:.1} %, starts by {start:.0} ms",
            all.truth,
            all.found,
            all.f(),
            100.0 * all.numbers as f64 / all.truth as f64
        );
        all
    }

    /// The harmonic mean of the share of what was found that is right and that of the truth that was found.
    fn f(&self) -> f64 {
        2.0 * self.right as f64 / (self.truth + self.found) as f64
    }
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn syllables_are_found_without_a_script() {
    for (ending, least) in [("m0_150", 0.97), ("mf3_110", 0.97), ("m0_150_snr20", 0.97)] {
        let Some(recordings) = recordings::espeak(ending) else { return };
        assert!(Count::of(&format!("espeak {ending}"), &recordings).f() >= least);
    }
    let Some(recordings) = recordings::mbrola() else { return };
    assert!(Count::of("mbrola", &recordings).f() >= 0.97);
    for source in ["htk", "neural"] {
        let Some(recordings) = recordings::real(source) else { return };
        assert!(Count::of(&format!("real, {source}"), &recordings).f() >= 0.9);
    }
    let Some(clean) = recordings::espeak("m0_150") else { return };
    let noisy: Vec<Recording> = clean.iter().step_by(2).zip(1..).map(|(r, seed)| edits::noisy(r, 10.0, seed)).collect();
    assert!(Count::of("espeak, noise at 10 dB", &noisy).f() >= 0.85);
}

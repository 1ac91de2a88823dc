//! The tiers of a clip's times that this program writes, and the meaning of tiers of phones, shapes and words.

use crate::script::{self, Syllable};
use crate::timeline::Spoken;
use crate::timing::{self, Interval, Tier};

/// The tier in which an alignment says how sure it is of each syllable: `0.98`.
pub(in crate::project) const CONFIDENCE: &str = "confidence";
/// What that tier says of a syllable that was not heard, after its confidence.
pub(in crate::project) const NOT_HEARD: &str = "not heard";
/// What that tier says of a stretch between syllables that the script does not have.
pub(in crate::project) const NOT_IN_SCRIPT: &str = "not in the script";

/// The tiers that an alignment writes; all others are somebody else's.
pub(in crate::project) const OWN_TIERS: [&str; 4] = ["words", "syllables", "phones", CONFIDENCE];

/// Words in time: what the script writes without a space or mark between.
pub(in crate::project) fn words(script: &str, syllables: &[Syllable], times: &Tier) -> Tier {
    let mut tier = Tier::new("words");
    for word in script::written_words(script, syllables) {
        let at = &times.intervals;
        if let (Some(first), Some(last)) = (at.get(word.syllables.start), at.get(word.syllables.end - 1)) {
            tier.intervals.push(Interval::new(first.start, last.end, word.text));
        }
    }
    tier
}

/// Start and end of each phone of a syllable, where the tier has them all, under the names they have here.
pub(in crate::project) fn phones_of(tier: &Tier, syllable: &Syllable, interval: &Interval) -> Option<Vec<(f64, f64)>> {
    let from = tier.intervals.partition_point(|i| f64::midpoint(i.start, i.end) < interval.start);
    let names = script::segments(syllable);
    let inside = tier.intervals[from..].iter().take_while(|i| f64::midpoint(i.start, i.end) < interval.end);
    let inside: Vec<&Interval> = inside.take(names.len() + 1).collect();
    let same = inside.len() == names.len() && inside.iter().zip(&names).all(|(i, n)| i.label == *n);
    (same && !names.is_empty()).then(|| inside.iter().map(|i| (i.start, i.end)).collect())
}

/// Mouth shapes with times of their own: touching ones are one utterance.
pub(in crate::project) fn of_shapes(tier: &Tier) -> Vec<Spoken> {
    const TOUCHING: f64 = 1e-3;
    let mut runs: Vec<Vec<&Interval>> = Vec::new();
    for interval in tier.spoken() {
        match runs.last_mut() {
            Some(run) if run.last().is_some_and(|l| interval.start - l.end < TOUCHING) => run.push(interval),
            _ => runs.push(vec![interval]),
        }
    }
    runs.iter()
        .filter_map(|run| {
            let (start, end) = (run.first()?.start, run.last()?.end);
            let share = |t: f64| if end > start { (t - start) / (end - start) } else { 0.0 };
            let shapes =
                run.iter().filter_map(|i| timing::mouth_shape(&i.label).map(|s| (share(i.start), s))).collect();
            Some(Spoken { start, end, shapes, exact: true })
        })
        .collect()
}

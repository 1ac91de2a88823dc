//! How sure the times of a clip are, and where an author should look.

use super::Clip;
use crate::speech::SURE;

/// The tier in which an alignment says how sure it is of each syllable: `0.98`.
pub(super) const CONFIDENCE: &str = "confidence";
/// What that tier says of a syllable that was not heard, after its confidence.
pub(super) const NOT_HEARD: &str = "not heard";
/// What that tier says of a stretch between syllables that the script does not have.
pub(super) const NOT_IN_SCRIPT: &str = "not in the script";

/// A place that an author should look at.
#[derive(Debug, Clone, PartialEq)]
pub struct Doubt {
    /// Seconds.
    pub start: f64,
    /// Seconds.
    pub end: f64,
    /// The syllable; none where something is said that the script does not have.
    pub syllable: Option<usize>,
    /// How sure the alignment is of its times, 0 to 1.
    pub confidence: f64,
    /// Whether anything was heard: false for a syllable that the speaker left out.
    pub heard: bool,
}

impl Clip {
    /// How sure a syllable's times are, 0 to 1: what an alignment found, 1 where a hand has set them. None where
    /// nothing is known of it.
    #[must_use]
    pub fn confidence(&self, syllable: usize) -> Option<f64> {
        if self.score.pins.binary_search(&syllable).is_ok() {
            return Some(1.0);
        }
        let said = self.label_of_confidence(syllable)?;
        said.split(' ').next()?.parse().ok().filter(|c| (0.0..=1.0).contains(c))
    }

    fn label_of_confidence(&self, syllable: usize) -> Option<&str> {
        let interval = self.intervals().get(syllable)?;
        let said = self.timing.tier(CONFIDENCE)?.at(f64::midpoint(interval.start, interval.end))?;
        Some(said.label.as_str())
    }

    /// The places that an author should look at, by rising time: syllables of which the alignment is not sure, or that
    /// were not heard, and what is said beside the script.
    #[must_use]
    pub fn doubts(&self) -> Vec<Doubt> {
        let unsure = self.intervals().iter().enumerate().filter_map(|(i, interval)| {
            let confidence = self.confidence(i).filter(|c| *c < SURE)?;
            let heard = self.label_of_confidence(i).is_none_or(|l| !l.ends_with(NOT_HEARD));
            Some(Doubt { start: interval.start, end: interval.end, syllable: Some(i), confidence, heard })
        });
        let beside = self.timing.tier(CONFIDENCE).into_iter().flat_map(|t| &t.intervals);
        let beside = beside.filter(|i| i.label == NOT_IN_SCRIPT && i.end > i.start);
        let beside = beside.map(|i| Doubt { start: i.start, end: i.end, syllable: None, confidence: 0.0, heard: true });
        let mut doubts: Vec<Doubt> = unsure.chain(beside).collect();
        doubts.sort_by(|a, b| a.start.total_cmp(&b.start));
        doubts
    }
}

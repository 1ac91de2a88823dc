//! How sure the times of a clip are and what was found in its video, and where an author should look.

use crate::project::files::{CONFIDENCE, Clip, NOT_HEARD, NOT_IN_SCRIPT};
use crate::speech::SURE;

/// A place that an author should look at.
#[derive(Debug, Clone, PartialEq)]
pub struct Doubt {
    /// Seconds.
    pub start: f64,
    /// Seconds.
    pub end: f64,
    /// The syllable it is about; none where it is about none.
    pub syllable: Option<usize>,
    /// How sure the search is of what it found there, 0 to 1.
    pub confidence: f64,
    /// What there is to look at.
    pub what: Concern,
}

/// What an author should look at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Concern {
    /// A syllable whose times are not sure.
    Unsure,
    /// A syllable that was not heard.
    NotHeard,
    /// Something is said that the script does not have.
    NotInScript,
    /// No face was found in the video's frames; what they show is bridged from those around them.
    FaceLost,
    /// The face in the video's frames was followed, but not surely.
    FaceUnsure,
}

/// Below this a frame's ratios are to be looked at.
const SURE_OF_FACE: f64 = 0.6;
/// Stretches of a face this near to each other, in seconds, are looked at as one.
const NEAR: f64 = 0.12;

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
            let unheard = self.label_of_confidence(i).is_some_and(|l| l.ends_with(NOT_HEARD));
            let what = if unheard { Concern::NotHeard } else { Concern::Unsure };
            Some(Doubt { start: interval.start, end: interval.end, syllable: Some(i), confidence, what })
        });
        let beside = self.timing.tier(CONFIDENCE).into_iter().flat_map(|t| &t.intervals);
        let beside = beside.filter(|i| i.label == NOT_IN_SCRIPT && i.end > i.start);
        let beside = beside.map(|i| Doubt {
            start: i.start,
            end: i.end,
            syllable: None,
            confidence: 0.0,
            what: Concern::NotInScript,
        });
        let mut doubts: Vec<Doubt> = unsure.chain(beside).collect();
        doubts.sort_by(|a, b| a.start.total_cmp(&b.start));
        doubts
    }

    /// The stretches of its video in which the face was lost, or followed unsurely, by rising time. Of a
    /// record that somebody else made only those without a face.
    #[must_use]
    pub fn lost(&self) -> Vec<Doubt> {
        let Some(record) = &self.record else { return Vec::new() };
        // How another program counts its confidence, only that program knows; 0 is a frame without a face everywhere.
        let sure = if self.score.tracked.is_some() { SURE_OF_FACE } else { f64::MIN_POSITIVE };
        let mut found: Vec<Doubt> = Vec::new();
        for (i, row) in record.rows.iter().enumerate().filter(|(_, row)| row.confidence < sure) {
            let what = if row.confidence > 0.0 { Concern::FaceUnsure } else { Concern::FaceLost };
            let end = record.rows.get(i + 1).map_or_else(|| record.duration(), |next| next.time);
            match found.last_mut().filter(|last| last.what == what && row.time - last.end < NEAR) {
                Some(last) => {
                    last.end = end;
                    last.confidence = last.confidence.min(row.confidence);
                }
                None => {
                    let confidence = row.confidence;
                    found.push(Doubt { start: row.time, end, syllable: None, confidence, what });
                }
            }
        }
        found
    }

    /// What there is to look at, in words.
    #[must_use]
    pub(crate) fn told(&self, doubt: &Doubt) -> String {
        let sure = 100.0 * doubt.confidence;
        let syllable = doubt.syllable.and_then(|i| self.syllables.get(i));
        let name = syllable.map_or_else(String::new, |s| format!("{} {}", s.text, s.pinyin).trim_end().to_owned());
        match doubt.what {
            Concern::Unsure => format!("{name}: {sure:.0} % sure"),
            Concern::NotHeard => format!("{name} is not heard"),
            Concern::NotInScript => format!("{:.2} s are not in the script", doubt.end - doubt.start),
            Concern::FaceLost => format!("no face for {:.2} s: bridged", doubt.end - doubt.start),
            Concern::FaceUnsure => {
                format!("the face is followed unsurely for {:.2} s: {sure:.0} %", doubt.end - doubt.start)
            }
        }
    }

    /// Everything that an author should look at, by rising time.
    #[must_use]
    pub(crate) fn to_look_at(&self) -> Vec<Doubt> {
        let mut all = self.doubts();
        all.extend(self.lost());
        all.sort_by(|a, b| a.start.total_cmp(&b.start));
        all
    }
}

//! What times look like once they are read: intervals in tiers, tiers in a timing.

use serde::{Deserialize, Serialize};

use crate::disk::{Fault, FileFault, Result};

/// As many tiers as a file may have. People use fewer than ten; names are looked for one by one.
pub(super) const MAX_TIERS: usize = 256;

/// The order in which the tiers we know stand in a file; others follow.
const KNOWN: [&str; 4] = ["words", "syllables", "phones", "shapes"];

/// One label and when it holds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Interval {
    /// Seconds from the start of the sound.
    pub start: f64,
    /// Seconds from the start of the sound, not before `start`.
    pub end: f64,
    /// What is said: characters, a romanisation, a phone, a shape. Never empty; may hold line breaks.
    pub label: String,
}

impl Interval {
    /// An interval from `start` to `end` seconds.
    #[must_use]
    pub fn new(start: f64, end: f64, label: impl Into<String>) -> Self {
        Self { start, end, label: label.into() }
    }

    /// How long it is, in seconds.
    #[must_use]
    pub(crate) fn duration(&self) -> f64 {
        self.end - self.start
    }
}

/// Labels of one kind, in order and not overlapping. What lies between them is silence.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Tier {
    /// `words`, `syllables`, `phones`, `shapes`, or what another program called it.
    pub name: String,
    /// By rising time.
    pub intervals: Vec<Interval>,
}

impl Tier {
    /// A tier with nothing in it.
    #[must_use]
    pub fn new(name: impl Into<String>) -> Self {
        Self { name: name.into(), intervals: Vec::new() }
    }

    /// The interval that holds at a time in seconds; its start belongs to it, its end does not.
    #[must_use]
    pub fn at(&self, time: f64) -> Option<&Interval> {
        let after = self.intervals.partition_point(|i| i.start <= time);
        self.intervals[..after].last().filter(|i| time < i.end)
    }

    /// Where its last interval ends, in seconds; 0 without one.
    #[must_use]
    pub fn end(&self) -> f64 {
        self.intervals.last().map_or(0.0, |i| i.end)
    }

    /// Whether its labels are all of points in time: intervals that end where they start.
    #[must_use]
    pub fn is_of_points(&self) -> bool {
        !self.intervals.is_empty() && self.intervals.iter().all(|i| i.start == i.end)
    }

    /// The intervals that say something: without those that only mark silence, such as `sil` and `#`.
    pub fn spoken(&self) -> impl Iterator<Item = &Interval> {
        self.intervals.iter().filter(|i| !is_silence_mark(&i.label))
    }
}

/// Whether a label is one of the marks by which aligners and annotators write silence.
#[must_use]
pub fn is_silence_mark(label: &str) -> bool {
    let inner = label.trim().trim_matches(['<', '>', '[', ']', '(', ')']).to_ascii_lowercase();
    matches!(inner.as_str(), "" | "sil" | "sp" | "spn" | "pau" | "p:" | "#" | "_" | "silence" | "eps")
}

/// Everything that is known of when a recording says what.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Timing {
    /// How long the recording is, in seconds, as far as the file tells: SRT and WebVTT only know their last cue.
    pub duration: f64,
    /// The tiers, with names that differ.
    pub tiers: Vec<Tier>,
    /// The times were not found in the sound but shared out; wherever they are shown they are marked so.
    /// Only the JSON form keeps this.
    pub guessed: bool,
}

impl Timing {
    /// The tier of that name.
    #[must_use]
    pub fn tier(&self, name: &str) -> Option<&Tier> {
        self.tiers.iter().find(|t| t.name == name)
    }

    /// The tier of that name, to change.
    pub(crate) fn tier_mut(&mut self, name: &str) -> Option<&mut Tier> {
        self.tiers.iter_mut().find(|t| t.name == name)
    }

    /// The syllables: the tier called so, or the only one there is, whatever its name. One of points beside it does not
    /// count, and one of mouth shapes never does.
    #[must_use]
    pub fn syllables(&self) -> Option<&Tier> {
        let only = |points: bool| {
            let mut others = self.tiers.iter().filter(|t| t.name != "shapes" && (points || !t.is_of_points()));
            others.next().filter(|_| others.next().is_none())
        };
        self.tier("syllables").or_else(|| only(false)).or_else(|| only(true))
    }

    /// The mouth shapes: the tier `shapes`.
    #[must_use]
    pub fn shapes(&self) -> Option<&Tier> {
        self.tier("shapes")
    }

    /// What formats of one tier are made of: the words where they are words, else the syllables, else the first tier;
    /// one with nothing in it only where all are so. Where a script is written without spaces its words are whole
    /// phrases, and the syllables say more.
    #[must_use]
    pub fn subtitles(&self) -> Option<&Tier> {
        const LONGEST: usize = 5;
        let says = |tier: &&Tier| !tier.intervals.is_empty();
        let syllables = self.syllables().filter(says);
        let count = syllables.map_or(0, |t| t.intervals.len());
        // Words of Mandarin have two syllables in the mean, and rarely four.
        let are_words = |tier: &&Tier| 2 * count <= LONGEST * tier.intervals.len();
        let words = self.tier("words").filter(says).filter(are_words);
        words.or(syllables).or_else(|| self.tiers.iter().find(says)).or_else(|| self.tiers.first())
    }

    /// Puts a tier in the place of the one of its name, or where it belongs: words, syllables, phones, shapes,
    /// then others as they come. The duration grows to hold it.
    pub fn set_tier(&mut self, tier: Tier) {
        self.duration = self.duration.max(tier.end());
        if let Some(old) = self.tier_mut(&tier.name) {
            *old = tier;
            return;
        }
        let rank = |name: &str| KNOWN.iter().position(|k| *k == name).unwrap_or(KNOWN.len());
        let at = self.tiers.iter().position(|t| rank(&t.name) > rank(&tier.name)).unwrap_or(self.tiers.len());
        self.tiers.insert(at, tier);
    }

    /// Makes every time `factor` times as long, a number above 0: for times that were counted at another rate.
    pub fn stretch(&mut self, factor: f64) {
        self.duration *= factor;
        for interval in self.tiers.iter_mut().flat_map(|tier| &mut tier.intervals) {
            interval.start *= factor;
            interval.end *= factor;
        }
    }

    /// Adds a tier that was read, under its name, or under `name 2`, `name 3`… where that is taken.
    ///
    /// # Errors
    /// When there are more than [`MAX_TIERS`].
    pub(super) fn add_read(&mut self, mut tier: Tier, until: f64) -> Result<()> {
        if self.tiers.len() >= MAX_TIERS {
            return Err(too_many_tiers());
        }
        if self.tier(&tier.name).is_some() {
            let free = (2..).map(|n| format!("{} {n}", tier.name)).find(|name| self.tier(name).is_none());
            tier.name = free.unwrap_or_default();
        }
        self.duration = self.duration.max(until);
        self.tiers.push(tier);
        Ok(())
    }
}

pub(super) fn too_many_tiers() -> Fault {
    Fault::of(FileFault::TooLarge, format!("there are more than {MAX_TIERS} tiers")).help("is it a timing file?")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiers_find_their_place_and_replace_their_namesake() {
        let mut timing = Timing::default();
        for name in ["mine", "shapes", "syllables", "words"] {
            timing.set_tier(Tier::new(name));
        }
        timing.set_tier(Tier { name: "syllables".into(), intervals: vec![Interval::new(0.0, 2.0, "a")] });
        let names: Vec<&str> = timing.tiers.iter().map(|t| t.name.as_str()).collect();
        assert_eq!(names, ["words", "syllables", "shapes", "mine"]);
        assert_eq!((timing.duration, timing.syllables().unwrap().intervals.len()), (2.0, 1));
    }

    #[test]
    fn an_instant_belongs_to_the_interval_that_starts_there() {
        let tier =
            Tier { name: "t".into(), intervals: vec![Interval::new(0.0, 1.0, "a"), Interval::new(1.0, 2.0, "b")] };
        assert_eq!(tier.at(1.0).unwrap().label, "b");
        assert!(tier.at(2.0).is_none() && tier.at(-1.0).is_none());
    }
}

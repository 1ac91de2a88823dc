//! Words laid onto places that were marked in a sound: script, times and pins change together, as one edit.

use serde::{Deserialize, Serialize};

use super::change::{Times, in_order, same_times, stale, take_own};
use super::doubts::{CONFIDENCE, NOT_IN_SCRIPT};
use super::label::label_fits;
use super::{Change, Clip, Edit, Lesson, ProjectFault, counted};
use crate::disk::{Fault, Result, clean_line};
use crate::script::{self, Syllable, System};
use crate::timing::{self, Interval, Tier};

/// The longest piece of text that a change is called after, in characters.
const SHOWN: usize = 20;

/// What is said in a clip, when, and which times a hand has set.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Said {
    /// The script, as written.
    pub script: String,
    /// The tiers, and what they were made from.
    pub times: Times,
    /// The numbers of the syllables whose times are the author's, rising.
    pub pins: Vec<usize>,
}

impl Clip {
    fn said(&self) -> Said {
        Said { script: self.script.clone(), times: self.times(), pins: self.score.pins.clone() }
    }

    fn system(&self) -> System {
        self.entry.script_system.unwrap_or(System::Auto)
    }

    /// Puts one script with its times in the place of another.
    pub(super) fn say(&mut self, before: &Said, after: &Said) -> Result<()> {
        let now = self.times();
        let is_so = self.script == before.script
            && self.score.pins == before.pins
            && same_times(&now.timing, &before.times.timing)
            && now.aligned == before.times.aligned;
        if !is_so {
            return Err(stale());
        }
        let plain = read(&after.script, self.system())?;
        let none = Tier::new("syllables");
        let tier = after.times.timing.syllables().unwrap_or(&none);
        timing::match_labels(&plain, tier, label_fits, |s| s.text.clone())?;
        in_order(tier)?;
        self.plain = plain;
        self.script.clone_from(&after.script);
        take_own(&mut self.timing, &after.times.timing);
        self.score.aligned.clone_from(&after.times.aligned);
        self.score.pins.clone_from(&after.pins);
        self.read_labels();
        Ok(())
    }
}

/// The syllables of a script that may be empty.
fn read(text: &str, system: System) -> Result<Vec<Syllable>> {
    if text.trim().is_empty() { Ok(Vec::new()) } else { script::syllables(text, system) }
}

impl Lesson {
    /// The change that lays typed words onto places in time, a syllable each, from the first place on: they become part
    /// of the script, between the syllables that are said before and after them. `places` are starts and ends in
    /// seconds, rising, where no syllable is yet.
    ///
    /// # Errors
    /// In one line: nothing in the text can be read, it has more syllables than there are places, or a syllable that
    /// is there already lies between them.
    pub fn lay_words(&self, number: usize, text: &str, places: &[(f64, f64)]) -> Result<Change> {
        let clip = self.clips.get(number).ok_or_else(stale)?;
        let text = clean_line(text, 4000);
        let own = read(&text, clip.system())?.len();
        if own == 0 {
            return Err(Fault::of(ProjectFault::Edit, "there is no syllable in it")
                .help("type characters, Pinyin, Zhuyin or English"));
        }
        if own > places.len() {
            let places = counted(places.len(), "place");
            return Err(Fault::of(
                ProjectFault::Edit,
                format!("{}, and {places} from here on", counted(own, "syllable")),
            )
            .help("type fewer, or go back to an earlier place"));
        }
        let places = &places[..own];
        let (Some(first), Some(last)) = (places.first(), places.last()) else { return Err(stale()) };
        let at = clip.intervals().partition_point(|i| f64::midpoint(i.start, i.end) < first.0);
        if let Some((syllable, next)) = clip.syllables.get(at).zip(clip.intervals().get(at))
            && next.start < last.1 - 1e-6
        {
            let room = places.iter().filter(|p| p.1 <= next.start + 1e-6).count();
            return Err(Fault::of(
                ProjectFault::Edit,
                format!("there is room for {} before {}", counted(room, "syllable"), syllable.text),
            )
            .help("type fewer"));
        }
        if let Some(before) = at.checked_sub(1).and_then(|i| clip.intervals().get(i))
            && before.end > first.0 + 1e-6
        {
            return Err(Fault::of(ProjectFault::Edit, format!("`{}` is said until {:.2} s", before.label, before.end))
                .help("go to a place after it, or mark the places anew"));
        }
        let mut later = clip.clone();
        later.script = inserted(clip, at, &text);
        later.plain = read(&later.script, clip.system())?;
        let texts = |s: &[Syllable]| s.iter().map(|s| s.text.clone()).collect::<Vec<_>>();
        let (old, new) = (texts(&clip.plain), texts(&later.plain));
        if new.len() != old.len() + own || new[..at] != old[..at] || new[at + own..] != old[at..] {
            return Err(Fault::of(
                ProjectFault::Edit,
                "together with what is said before and after it, it is read in another way",
            )
            .help("write it as characters, or all of it in one romanisation"));
        }
        let mut tier = Tier::new("syllables");
        tier.intervals = clip.intervals().to_vec();
        let laid = places.iter().zip(&later.plain[at..]).map(|(p, s)| Interval::new(p.0, p.1, s.text.clone()));
        tier.intervals.splice(at..at, laid);
        later.timing.duration = clip.duration();
        later.timing.guessed = clip.timing.guessed && !clip.syllables.is_empty();
        later.timing.set_tier(tier.clone());
        later.read_labels();
        let words = later.words(&tier);
        later.timing.set_tier(words);
        // What was laid is what was said beside the script.
        if let Some(tier) = later.timing.tier_mut(CONFIDENCE) {
            tier.intervals.retain(|i| i.label != NOT_IN_SCRIPT || i.end <= first.0 || i.start >= last.1);
        }
        if later.score.aligned.is_some() {
            later.score.aligned = later.fingerprint();
        }
        later.score.pins = clip.score.pins.iter().map(|p| if *p >= at { p + own } else { *p }).collect();
        let edit = Edit::Said { clip: number, before: Box::new(clip.said()), after: Box::new(later.said()) };
        let shown: String = text.chars().take(SHOWN).collect();
        let more = if text.chars().count() > SHOWN { "…" } else { "" };
        Ok(Change::one(format!("`{shown}{more}` from {:.2} s on", first.0), edit))
    }
}

/// The script with a text before its syllable `at`.
fn inserted(clip: &Clip, at: usize, text: &str) -> String {
    let script = &clip.script;
    let place = clip.plain.get(at).map_or(script.trim_end().len(), |s| s.span.start.min(script.len()));
    let (before, after) = script.split_at(place);
    let gap = |a: Option<char>, b: Option<char>| match (a, b) {
        (Some(a), Some(b)) if parts(a) && parts(b) && !(script::is_han(a) && script::is_han(b)) => " ",
        _ => "",
    };
    let left = gap(before.chars().next_back(), text.chars().next());
    let right = gap(text.chars().next_back(), after.chars().next());
    format!("{before}{left}{text}{right}{after}")
}

/// Whether a letter would run into the one beside it.
fn parts(c: char) -> bool {
    c.is_alphanumeric()
}

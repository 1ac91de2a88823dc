//! Typed words put at marked times of a recording, as one change of script, times and pins.

use super::change::{Change, Edit};
use super::clip::ClipEdit;
use super::lesson::Lesson;
use super::script::{Said, syllables_of};
use crate::disk::{Fault, Result, clean_line};
use crate::project::ProjectFault;
use crate::project::count::counted;
use crate::project::fault::stale;
use crate::project::files::{CONFIDENCE, Clip, NOT_IN_SCRIPT, words};
use crate::script::{self, Syllable};
use crate::timing::{Interval, Tier};

/// The longest piece of text that a change is called after, in characters.
const SHOWN: usize = 20;

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
        let own = syllables_of(&text, clip)?.len();
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
        later.plain = syllables_of(&later.script, clip)?;
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
        let words = words(&later.script, &later.syllables, &tier);
        later.timing.set_tier(words);
        // What was laid is what was said beside the script.
        if let Some(tier) = later.timing.tier_mut(CONFIDENCE) {
            tier.intervals.retain(|i| i.label != NOT_IN_SCRIPT || i.end <= first.0 || i.start >= last.1);
        }
        if later.score.aligned.is_some() {
            later.score.aligned = later.fingerprint();
        }
        later.score.pins = clip.score.pins.iter().map(|p| if *p >= at { p + own } else { *p }).collect();
        let edit =
            Edit::Clip(number, ClipEdit::Said { before: Box::new(Said::of(clip)), after: Box::new(Said::of(&later)) });
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

//! Times as a clip takes them from a file: the tier that holds its syllables, and whether they are its script's.

use super::clip::Clip;
use super::label::label_fits;
use crate::disk::{Fault, FileFault, Result, Setting, Task, message};
use crate::script::{self, System};
use crate::timing::{self, Interval, Tier, Timing};

/// A syllable needs at least this long to be said, in seconds.
const LEAST_ROOM: f64 = 0.05;

impl Clip {
    /// Checks times against the script and takes them.
    pub(in crate::project) fn take_timing(&mut self, mut timing: Timing) -> Result<()> {
        timing.shapes().map_or(Ok(()), timing::check_shapes)?;
        let Some(tier) = self.syllable_tier(&timing).cloned() else {
            if timing.shapes().is_none() {
                let names: Vec<&str> = timing.tiers.iter().map(|t| t.name.as_str()).collect();
                return Err(Fault::of(FileFault::Unknown, "there is no tier `syllables`")
                    .help(format!("name the tier with the syllables so; its tiers are {}", names.join(", "))));
            }
            // Shapes alone, as other programs of lip movement write them.
            self.timing = timing;
            self.guess_beside();
            return Ok(());
        };
        if self.plain.is_empty() && self.script.trim().is_empty() {
            // Times without a script: the labels are the script.
            let labels: Vec<&str> = tier.spoken().map(|i| i.label.as_str()).collect();
            self.script = labels.join(" ");
            self.plain = script::syllables(&self.script, self.entry.script_system.unwrap_or(System::Auto))?;
            self.labels_are_script = true;
            if self.found_for_another() {
                let lacks = if self.seen.script.is_some() { "its script.txt is empty" } else { "it has no script.txt" };
                self.warnings.push(format!("{lacks}: its script is what its times say, and they stay").into());
            }
        }
        let mut syllables = Tier::new("syllables");
        match timing::match_labels(&self.plain, &tier, label_fits, |s| s.text.clone()) {
            Ok(()) => syllables.intervals = tier.spoken().cloned().collect(),
            Err(fault) => {
                syllables.intervals = self.shared_out(&tier).ok_or_else(|| {
                    let help = fault.advice().clone().then("; correct one of them, or move timing.TextGrid away: ");
                    fault.help(help.then(Task::Align).then(" finds the times anew"))
                })?;
                self.warnings.push(message![
                    format!(
                        "its times are those of words or phrases (tier `{}`), which their syllables share; ",
                        tier.name
                    ),
                    Task::Align.with(Setting::Clip, &self.entry.name),
                    " finds them in the sound"
                ]);
            }
        }
        // The tier of syllables may have any name in a file; here it has its own. Words and phrases stay beside it.
        if tier.name != "syllables" && syllables.intervals.len() == tier.spoken().count() {
            timing.tiers.retain(|t| t.name != tier.name);
        }
        timing.set_tier(syllables);
        self.timing = timing;
        Ok(())
    }

    /// The tier that holds what is said: `syllables`, else the one that says the script, syllable by syllable or in
    /// larger pieces, else the likeliest. None where there are only shapes.
    fn syllable_tier<'a>(&self, timing: &'a Timing) -> Option<&'a Tier> {
        let found = timing::fitting_tier(timing, &self.plain, label_fits);
        let fits = |t: &&Tier| t.name == "syllables" || timing::first_parting(&self.plain, t, label_fits).is_none();
        if self.plain.is_empty() || found.is_some_and(|t| fits(&t)) {
            return found;
        }
        timing.tiers.iter().find(|t| self.shared_out(t).is_some()).or(found)
    }

    /// The syllables of labels that hold several each, as words and subtitles do: they share their label's time. None
    /// where the labels are not the script.
    fn shared_out(&self, tier: &Tier) -> Option<Vec<Interval>> {
        let bare = |text: &str| -> String {
            script::without_braces(text).chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
        };
        let mut out = Vec::with_capacity(self.plain.len());
        let mut rest = self.plain.as_slice();
        for interval in tier.spoken() {
            let wanted = bare(&interval.label);
            let mut text = String::new();
            let mut count = 0;
            while text.len() < wanted.len() {
                text.push_str(&bare(&rest.get(count)?.text));
                count += 1;
            }
            if text != wanted {
                return None;
            }
            let share = interval.duration() / count.max(1) as f64;
            for (k, syllable) in rest[..count].iter().enumerate() {
                let start = interval.start + k as f64 * share;
                out.push(Interval::new(start, start + share, syllable.text.clone()));
            }
            rest = &rest[count..];
        }
        (rest.is_empty() && !out.is_empty()).then_some(out)
    }

    /// Whether times were found by an alignment to a script that was changed afterwards. Times that came otherwise are
    /// somebody's work, and a script that does not fit them is a mistake to be told.
    pub(in crate::project) fn is_of_an_older_script(&self, timing: &Timing) -> bool {
        let Some(tier) = timing.syllables().filter(|_| !self.plain.is_empty()) else { return false };
        let parts = timing::first_parting(&self.plain, tier, label_fits).is_some();
        parts && self.found_for_another()
    }

    /// Takes times that were found for an older script: what a hand has set stays where the script still has it, the rest
    /// is shared out between. The checksum stays what it was, so that the change of the script is still seen.
    pub(in crate::project) fn carry_over(&mut self, timing: Timing) {
        let labels: Vec<Interval> = timing.syllables().map(|t| t.spoken().cloned().collect()).unwrap_or_default();
        let same = timing::common(&self.plain, &labels, |s, i| label_fits(s, &i.label));
        let set = same.into_iter().filter(|(_, old)| self.score.pins.binary_search(old).is_ok());
        let mut kept: Vec<(usize, Interval)> = set.map(|(new, old)| (new, labels[old].clone())).collect();
        self.timing = timing;
        self.guess();
        let (count, duration) = (self.plain.len(), self.timing.duration);
        let room = |from: f64, to: f64, syllables: usize| to - from >= LEAST_ROOM * syllables as f64;
        // Syllables between two that stay need room; where there is none the later one goes.
        let (mut edge, mut next) = (0.0, 0);
        kept.retain(|(place, interval)| {
            let fits = room(edge, interval.start, place - next) && interval.end > interval.start;
            if fits {
                (edge, next) = (interval.end, place + 1);
            }
            fits
        });
        while kept.last().is_some_and(|(place, i)| !room(i.end, duration, count - 1 - place)) {
            kept.pop();
        }
        self.score.pins = kept.iter().map(|k| k.0).collect();
        let Some(tier) = self.timing.tier_mut("syllables").filter(|_| !kept.is_empty()) else { return };
        let (mut edge, mut next) = (0.0, 0);
        for (place, interval) in kept.into_iter().chain([(count, Interval::new(duration, duration, ""))]) {
            let share = (interval.start - edge) / (place - next).max(1) as f64;
            for (k, between) in tier.intervals[next..place].iter_mut().enumerate() {
                (between.start, between.end) = (edge + share * k as f64, edge + share * (k + 1) as f64);
            }
            if let Some(own) = tier.intervals.get_mut(place) {
                *own = Interval { label: interval.label, ..interval };
            }
            (edge, next) = (interval.end, place + 1);
        }
    }
}

//! The script of a clip as an edit takes it: text, times and pins change together.

use serde::{Deserialize, Serialize};

use super::times::{Times, in_order, same_times, take_own};
use crate::disk::Result;
use crate::project::fault::stale;
use crate::project::files::{Clip, label_fits};
use crate::script::{self, Syllable, System};
use crate::timing::{self, Tier};

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

impl Said {
    /// That of a clip as it is.
    pub(super) fn of(clip: &Clip) -> Self {
        Self { script: clip.script.clone(), times: Times::of(clip), pins: clip.score.pins.clone() }
    }

    /// Puts this script with its times in the place of that of a clip, which must be `before`.
    pub(super) fn put(&self, before: &Self, clip: &mut Clip) -> Result<()> {
        let now = Times::of(clip);
        let is_so = clip.script == before.script
            && clip.score.pins == before.pins
            && same_times(&now.timing, &before.times.timing)
            && now.aligned == before.times.aligned;
        if !is_so {
            return Err(stale());
        }
        let plain = syllables_of(&self.script, clip)?;
        let none = Tier::new("syllables");
        let tier = self.times.timing.syllables().unwrap_or(&none);
        timing::match_labels(&plain, tier, label_fits, |s| s.text.clone())?;
        in_order(tier)?;
        clip.plain = plain;
        clip.script.clone_from(&self.script);
        take_own(&mut clip.timing, &self.times.timing);
        clip.score.aligned.clone_from(&self.times.aligned);
        clip.score.pins.clone_from(&self.pins);
        clip.read_labels();
        Ok(())
    }
}

/// The syllables of a text in the writing system of a clip; none of an empty text.
pub(super) fn syllables_of(text: &str, clip: &Clip) -> Result<Vec<Syllable>> {
    let system = clip.entry.script_system.unwrap_or(System::Auto);
    if text.trim().is_empty() { Ok(Vec::new()) } else { script::syllables(text, system) }
}

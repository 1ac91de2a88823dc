//! The times of a lesson's clips found in their sound: what it takes as something that can go to a thread, and what
//! comes of it as a change like any other.
//!
//! How sound is aligned is the business of `speech`; here are the author's pins, one speaker's clips pooled, the tiers
//! that are written, and whether they still are of this sound and this script.

use std::sync::Arc;

use crate::disk::{Fault, Result};
use crate::media::Sound;
use crate::project::ProjectFault;
use crate::project::count::counted;
use crate::project::edit::{Change, ClipEdit, Edit, Lesson, Times};
use crate::project::files::{CONFIDENCE, Clip, NOT_HEARD, NOT_IN_SCRIPT, words};
use crate::script::Syllable;
use crate::speech::{self, Alignment, Note, Pin, Take};
use crate::timing::{Interval, Tier, Timing};

/// Clips of one face are listened to together, as many in the manifest's order as have so much sound, in seconds: the
/// gain of pooling grows little after a minute of speech, and a lesson of hours need not be heard for one clip of it.
const TOGETHER: f64 = 300.0;

/// Clips to be aligned, apart from their lesson.
#[derive(Debug, Clone)]
pub struct AlignJob {
    /// Takes of one speaker each.
    groups: Vec<Vec<OwnTake>>,
    /// The clips that are asked for; the others help to learn the voice.
    wanted: Vec<usize>,
}

#[derive(Debug, Clone)]
struct OwnTake {
    clip: usize,
    sound: Arc<Sound>,
    script: Vec<Syllable>,
    pins: Vec<Pin>,
}

impl OwnTake {
    fn of(number: usize, clip: &Clip) -> Option<Self> {
        let sound = clip.sound.clone().filter(|_| !clip.syllables.is_empty())?;
        Some(Self { clip: number, sound, script: clip.syllables.clone(), pins: clip.pins() })
    }
}

impl AlignJob {
    /// What it takes to align these clips. Other clips of the same face help to learn the voice: always the same
    /// ones, so that what is found in a clip does not depend on which others are asked for.
    ///
    /// # Errors
    /// When one of them has no sound or no script.
    pub fn of(lesson: &Lesson, wanted: &[usize]) -> Result<Self> {
        for clip in wanted.iter().filter_map(|n| lesson.clips.get(*n)) {
            let lacks = match (&clip.sound, clip.syllables.is_empty()) {
                (None, _) => ("recording", "speech.wav"),
                (_, true) => ("script", "script.txt"),
                _ => continue,
            };
            return Err(Fault::of(
                ProjectFault::Incomplete,
                format!("the clip `{}` has no {} to align", clip.entry.name, lacks.0),
            )
            .at(&clip.folder)
            .help(format!("put it there as {}", lacks.1)));
        }
        let mut groups: Vec<(Option<&str>, f64, Vec<OwnTake>)> = Vec::new();
        for (number, clip) in lesson.clips.iter().enumerate() {
            let Some(take) = OwnTake::of(number, clip) else { continue };
            let (face, length) = (face_of(lesson, number), take.sound.duration());
            // The last group of a face is the one that is still filled. Without a face nobody knows whose voice it is.
            let open = groups.iter_mut().rev().find(|g| face.is_some() && g.0 == face);
            match open.filter(|g| g.1 + length <= TOGETHER) {
                Some(group) => {
                    group.1 += length;
                    group.2.push(take);
                }
                None => groups.push((face, length, vec![take])),
            }
        }
        let asked = |group: &Vec<OwnTake>| group.iter().any(|t| wanted.contains(&t.clip));
        Ok(Self { groups: groups.into_iter().map(|g| g.2).filter(asked).collect(), wanted: wanted.to_vec() })
    }

    /// Aligns them. Each wanted clip's number comes with what was found, or why nothing was.
    #[must_use]
    pub fn run(&self) -> Vec<(usize, Result<Alignment>)> {
        let mut found = Vec::new();
        for group in &self.groups {
            let takes: Vec<Take<'_>> =
                group.iter().map(|t| Take { sound: &t.sound, script: &t.script, pins: &t.pins }).collect();
            found.extend(group.iter().map(|t| t.clip).zip(speech::align(&takes)));
        }
        found.retain(|(clip, _)| self.wanted.contains(clip));
        found.sort_by_key(|(clip, _)| *clip);
        found
    }
}

fn face_of(lesson: &Lesson, clip: usize) -> Option<&str> {
    lesson.manifest.face_of(&lesson.clips.get(clip)?.entry).map(|f| f.name.as_str())
}

impl Lesson {
    /// The change that gives a clip the times that were found; none where they are what it has.
    #[must_use]
    pub fn aligned(&self, number: usize, alignment: &Alignment) -> Option<Change> {
        let clip = self.clips.get(number)?;
        let before = Times::of(clip);
        let after = Times { timing: timing_of(clip, alignment), aligned: clip.fingerprint() };
        if before == after {
            return None;
        }
        let edit = Edit::Clip(number, ClipEdit::Timing { before: Box::new(before), after: Box::new(after) });
        Some(Change::one(format!("{} aligned", counted(alignment.syllables.len(), "syllable")), edit))
    }

    /// Gives a clip the times that were found, in memory only: for an export of a lesson that has never been aligned.
    pub(crate) fn take_alignment(&mut self, number: usize, alignment: &Alignment) {
        if let Some(clip) = self.clips.get_mut(number) {
            clip.timing = timing_of(clip, alignment);
            clip.score.aligned = clip.fingerprint();
            clip.read_labels();
        }
    }
}

/// What a clip has once the times that were found are its own. The labels of syllables stay as they are, and so do
/// tiers that this program does not write.
fn timing_of(clip: &Clip, alignment: &Alignment) -> Timing {
    let mut timing = Timing { guessed: false, ..clip.timing.clone() };
    let labels: Vec<String> = clip.intervals().iter().map(|i| i.label.clone()).collect();
    for tier in tiers_of(&clip.script, &clip.syllables, &labels, alignment) {
        timing.set_tier(tier);
    }
    timing
}

/// The tiers of an alignment: words, syllables under their labels, phones, and how sure each syllable is.
#[must_use]
pub fn tiers_of(script: &str, syllables: &[Syllable], labels: &[String], alignment: &Alignment) -> [Tier; 4] {
    let mut tier = Tier::new("syllables");
    let mut phones = Tier::new("phones");
    let mut confidence = Tier::new(CONFIDENCE);
    for (found, label) in alignment.syllables.iter().zip(labels) {
        tier.intervals.push(Interval::new(found.start, found.end, label.clone()));
        phones.intervals.extend(found.phones.iter().map(|p| Interval::new(p.start, p.end, p.phone)));
        let sure = format!("{:.2}", found.confidence);
        let label = if found.heard { sure } else { format!("{sure} {NOT_HEARD}") };
        confidence.intervals.push(Interval::new(found.start, found.end, label));
    }
    for note in &alignment.notes {
        if let Note::NotInScript { start, end, .. } = note {
            lay_between(&mut confidence, *start, *end);
        }
    }
    [words(script, syllables, &tier), tier, phones, confidence]
}

/// Puts a stretch that the script does not have into the gap it lies in, as far as there is room.
fn lay_between(tier: &mut Tier, start: f64, end: f64) {
    let after = tier.intervals.partition_point(|i| i.start < start);
    let start = after.checked_sub(1).map_or(start, |i| start.max(tier.intervals[i].end));
    let end = tier.intervals.get(after).map_or(end, |i| end.min(i.start));
    if end > start {
        tier.intervals.insert(after, Interval::new(start, end, NOT_IN_SCRIPT));
    }
}

//! The times of a lesson's clips found in their sound: what it takes as something that can go to a thread, and what
//! comes of it as a change like any other.
//!
//! How sound is aligned is the business of `speech`; here are the author's pins, one speaker's clips pooled, the tiers
//! that are written, and whether they still are of this sound and this script.

use std::sync::Arc;

use super::change::Times;
use super::doubts::{CONFIDENCE, NOT_HEARD, NOT_IN_SCRIPT};
use super::{Change, Clip, Edit, Lesson};
use crate::disk::{Fault, Result};
use crate::script::{self, Syllable};
use crate::speech::{self, Alignment, Note, Pin, Sound, Take};
use crate::timing::{Interval, Tier, Timing};

/// As much sound of the same speaker's other clips is listened to as well, in seconds. The gain of pooling grows little
/// after a minute of speech.
const POOLED: f64 = 120.0;

/// Clips to be aligned, apart from their lesson.
#[derive(Debug, Clone)]
pub struct AlignJob {
    /// Those that are wanted first, then others of the same speaker.
    takes: Vec<OwnTake>,
    wanted: usize,
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
    /// What it takes to align these clips, all with the same face; other clips of that face help to learn the voice.
    ///
    /// # Errors
    /// When one of them has no sound or no script.
    pub fn of(lesson: &Lesson, wanted: &[usize]) -> Result<Self> {
        let mut takes = Vec::new();
        for number in wanted {
            let Some(clip) = lesson.clips.get(*number) else { continue };
            let take = OwnTake::of(*number, clip).ok_or_else(|| {
                let lacks = if clip.sound.is_none() { "recording" } else { "script" };
                let file = if clip.sound.is_none() { "speech.wav" } else { "script.txt" };
                Fault::new(format!("the clip `{}` has no {lacks} to align", clip.entry.name))
                    .at(&clip.folder)
                    .help(format!("put it there as {file}"))
            })?;
            takes.push(take);
        }
        let faces: Vec<_> = takes.iter().map(|t| face_of(lesson, t.clip)).collect();
        let wanted = takes.len();
        let mut sound = 0.0;
        for (number, clip) in lesson.clips.iter().enumerate() {
            if takes.iter().any(|t| t.clip == number) || !faces.contains(&face_of(lesson, number)) {
                continue;
            }
            if let Some(take) = OwnTake::of(number, clip) {
                sound += take.sound.duration();
                if sound > POOLED {
                    break;
                }
                takes.push(take);
            }
        }
        Ok(Self { takes, wanted })
    }

    /// Aligns them. Each wanted clip's number comes with what was found, or why nothing was.
    #[must_use]
    pub fn run(&self) -> Vec<(usize, Result<Alignment>)> {
        let takes: Vec<Take<'_>> =
            self.takes.iter().map(|t| Take { sound: &t.sound, script: &t.script, pins: &t.pins }).collect();
        let numbers = self.takes.iter().map(|t| t.clip);
        numbers.zip(speech::align(&takes)).take(self.wanted).collect()
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
        let before = clip.times();
        let after = Times { timing: timing_of(clip, alignment), aligned: clip.fingerprint() };
        if before == after {
            return None;
        }
        let mut edits = Vec::new();
        // Pins that were carried over from an older script.
        for pin in clip.pins() {
            if !clip.score.pins.contains(&pin.syllable) {
                edits.push(Edit::Pin { clip: number, index: pin.syllable, pinned: true });
            }
        }
        edits.push(Edit::Timing { clip: number, before: Box::new(before), after: Box::new(after) });
        Some(Change { label: format!("{} aligned", counted(alignment.syllables.len())), edits })
    }

    /// Gives a clip the times that were found, in memory only: for an export of a lesson that has never been aligned.
    pub fn take_alignment(&mut self, number: usize, alignment: &Alignment) {
        if let Some(clip) = self.clips.get_mut(number) {
            clip.timing = timing_of(clip, alignment);
            clip.score.aligned = clip.fingerprint();
            clip.read_labels();
        }
    }
}

fn counted(syllables: usize) -> String {
    if syllables == 1 { "1 syllable".into() } else { format!("{syllables} syllables") }
}

/// The tiers of an alignment. The labels of syllables stay as they are; tiers that this program does not write stay.
fn timing_of(clip: &Clip, alignment: &Alignment) -> Timing {
    let mut timing = Timing { guessed: false, ..clip.timing.clone() };
    let labels = clip.intervals();
    let mut syllables = Tier::new("syllables");
    let mut phones = Tier::new("phones");
    let mut confidence = Tier::new(CONFIDENCE);
    for (i, found) in alignment.syllables.iter().enumerate() {
        let label = labels.get(i).map_or_else(String::new, |l| l.label.clone());
        syllables.intervals.push(Interval::new(found.start, found.end, label));
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
    let words = clip.words(&syllables);
    for tier in [words, syllables, phones, confidence] {
        timing.set_tier(tier);
    }
    timing
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

impl Clip {
    /// The syllables whose times are the author's.
    #[must_use]
    pub fn pins(&self) -> Vec<Pin> {
        let own = self.score.pins.iter().filter_map(|p| {
            let interval = self.intervals().get(*p)?;
            Some(Pin { syllable: *p, start: interval.start, end: interval.end })
        });
        let mut pins: Vec<Pin> = if self.carried.is_empty() { own.collect() } else { self.carried.clone() };
        pins.retain(|p| p.syllable < self.syllables.len() && p.end > p.start);
        pins
    }

    /// Words in time: what the script writes without a space or mark between.
    pub(super) fn words(&self, syllables: &Tier) -> Tier {
        let mut tier = Tier::new("words");
        for word in script::written_words(&self.script, &self.syllables) {
            let at = &syllables.intervals;
            if let (Some(first), Some(last)) = (at.get(word.syllables.start), at.get(word.syllables.end - 1)) {
                tier.intervals.push(Interval::new(first.start, last.end, word.text));
            }
        }
        tier
    }

    /// What the times were made from: a checksum of the sound and the script. None without a sound.
    pub(super) fn fingerprint(&self) -> Option<String> {
        let sound = self.sound.as_ref()?;
        let mut hash = crc32fast::Hasher::new();
        hash.update(&sound.rate.to_le_bytes());
        let mut bytes = Vec::with_capacity(4 << 12);
        for block in sound.samples.chunks(1 << 12) {
            bytes.clear();
            bytes.extend(block.iter().flat_map(|s| s.to_le_bytes()));
            hash.update(&bytes);
        }
        hash.update(self.script.trim().as_bytes());
        Some(format!("{:08x}", hash.finalize()))
    }
}

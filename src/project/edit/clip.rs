//! Edits of a clip, each with its inverse.

use serde::{Deserialize, Serialize};

use super::footage::Footage;
use super::script::Said;
use super::times::{Times, set_times};
use crate::disk::{Fault, Result};
use crate::project::ProjectFault;
use crate::project::fault::stale;
use crate::project::files::Clip;
use crate::timeline::{Key, Marker, Range};

/// An edit of one clip. It says what was and what is to be, so that it can be taken back.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ClipEdit {
    /// Start and end of neighbouring syllables, in seconds.
    Times {
        /// Number of the first syllable.
        first: usize,
        /// As it was.
        before: Vec<(f64, f64)>,
        /// As it is to be.
        after: Vec<(f64, f64)>,
    },
    /// All the tiers of a clip, as an alignment makes them.
    Timing {
        /// As they were.
        before: Box<Times>,
        /// As they are to be.
        after: Box<Times>,
    },
    /// The script with its times and pins, where words are put in.
    Said {
        /// As it was.
        before: Box<Said>,
        /// As it is to be.
        after: Box<Said>,
    },
    /// The ratios and tracks of the clip's video.
    Tracked {
        /// As they were.
        before: Box<Footage>,
        /// As they are to be.
        after: Box<Footage>,
    },
    /// A syllable's label: its text, or text and reading as `行{hang2}`.
    Label {
        /// Number of the syllable.
        index: usize,
        /// As it was.
        before: String,
        /// As it is to be.
        after: String,
    },
    /// The pin of a syllable: its times are the author's.
    Pin {
        /// Number of the syllable.
        index: usize,
        /// As it is to be; it was the other.
        pinned: bool,
    },
    /// A key more.
    AddKey {
        /// The key.
        key: Key,
    },
    /// A key less.
    RemoveKey {
        /// The key.
        key: Key,
    },
    /// A range edit more.
    AddRange {
        /// Its position in the list.
        at: usize,
        /// The range edit.
        range: Range,
    },
    /// A range edit less.
    RemoveRange {
        /// Its position in the list.
        at: usize,
        /// The range edit.
        range: Range,
    },
    /// A marker more.
    AddMarker {
        /// The marker.
        marker: Marker,
    },
    /// A marker less.
    RemoveMarker {
        /// The marker.
        marker: Marker,
    },
}

impl ClipEdit {
    /// The edit that takes it back.
    #[must_use]
    pub(crate) fn inverse(&self) -> Self {
        match self.clone() {
            Self::Times { first, before, after } => Self::Times { first, before: after, after: before },
            Self::Timing { before, after } => Self::Timing { before: after, after: before },
            Self::Said { before, after } => Self::Said { before: after, after: before },
            Self::Tracked { before, after } => Self::Tracked { before: after, after: before },
            Self::Label { index, before, after } => Self::Label { index, before: after, after: before },
            Self::Pin { index, pinned } => Self::Pin { index, pinned: !pinned },
            Self::AddKey { key } => Self::RemoveKey { key },
            Self::RemoveKey { key } => Self::AddKey { key },
            Self::AddRange { at, range } => Self::RemoveRange { at, range },
            Self::RemoveRange { at, range } => Self::AddRange { at, range },
            Self::AddMarker { marker } => Self::RemoveMarker { marker },
            Self::RemoveMarker { marker } => Self::AddMarker { marker },
        }
    }

    /// Makes the edit. What it says was must be what is.
    pub(super) fn apply(&self, clip: &mut Clip) -> Result<()> {
        let score = &mut clip.score;
        match self {
            Self::Times { first, before, after } => set_times(clip, *first, before, after),
            Self::Timing { before, after } => after.put(before, clip),
            Self::Said { before, after } => after.put(before, clip),
            Self::Tracked { before, after } => after.put(before, clip),
            Self::Label { index, before, after } => set_label(clip, *index, before, after),
            Self::Pin { index, pinned } => set_pin(&mut score.pins, *index, *pinned),
            Self::AddKey { key } if !(key.time.is_finite() && key.time >= 0.0) => {
                Err(Fault::of(ProjectFault::Edit, format!("a key cannot be at {} s", key.time))
                    .help("give a time from 0 on"))
            }
            Self::AddKey { key } => add(&mut score.keys, key),
            Self::RemoveKey { key } => remove(&mut score.keys, |k| k.is_same(key)),
            Self::AddRange { at, range } => {
                if *at > score.ranges.len() {
                    return Err(stale());
                }
                score.ranges.insert(*at, *range);
                Ok(())
            }
            Self::RemoveRange { at, range } => {
                if !score.ranges.get(*at).is_some_and(|r| r.is_same(range)) {
                    return Err(stale());
                }
                score.ranges.remove(*at);
                Ok(())
            }
            Self::AddMarker { marker } => add(&mut score.markers, marker),
            Self::RemoveMarker { marker } => remove(&mut score.markers, |m| m.is_same(marker)),
        }
    }
}

fn set_label(clip: &mut Clip, index: usize, before: &str, after: &str) -> Result<()> {
    let interval = clip.timing.tier_mut("syllables").and_then(|t| t.intervals.get_mut(index));
    let label = interval.map(|i| &mut i.label).filter(|l| *l == before).ok_or_else(stale)?;
    after.clone_into(label);
    clip.read_labels();
    Ok(())
}

fn set_pin(pins: &mut Vec<usize>, index: usize, pinned: bool) -> Result<()> {
    match (pins.binary_search(&index), pinned) {
        (Err(place), true) => pins.insert(place, index),
        (Ok(place), false) => {
            pins.remove(place);
        }
        _ => return Err(stale()),
    }
    Ok(())
}

/// Adds what is not there: the same thing twice would be one change made twice, as by a journal read again.
fn add<T: PartialEq + Clone>(list: &mut Vec<T>, item: &T) -> Result<()> {
    if list.contains(item) {
        return Err(Fault::of(ProjectFault::Edit, "it is there already").help("move or change the one that is there"));
    }
    list.push(item.clone());
    Ok(())
}

fn remove<T>(list: &mut Vec<T>, is_it: impl FnMut(&T) -> bool) -> Result<()> {
    // The last one: adding puts it there, so that undoing leaves the list as it was.
    let place = list.iter().rposition(is_it).ok_or_else(stale)?;
    list.remove(place);
    Ok(())
}

//! Changes: lists of edits, each with its inverse. Undo, redo, the journal and every editor use this one list.

use serde::{Deserialize, Serialize};

use super::doubts::CONFIDENCE;
use super::footage::Footage;
use super::said::Said;
use super::shots::near_the_photo;
use super::times::OWN_TIERS;
use super::{Clip, LessonFace, ProjectFault};
use crate::calibration::Marks;
use crate::disk::{Fault, Result};
use crate::face::{Face, FeaturePoint, How, Placed};
use crate::geometry::Point;
use crate::pose::Emotion;
use crate::timeline::{Key, Marker, Range};
use crate::timing::{Tier, Timing};

/// Something an author did, in one step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Change {
    /// What was done, in a few words.
    pub label: String,
    /// What it changes, in order.
    pub edits: Vec<Edit>,
}

/// The smallest change: it says what was and what is to be, so that it can be turned round.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Edit {
    /// Start and end of neighbouring syllables, in seconds.
    Times {
        /// Number of the clip.
        clip: usize,
        /// Number of the first syllable.
        first: usize,
        /// As it was.
        before: Vec<(f64, f64)>,
        /// As it is to be.
        after: Vec<(f64, f64)>,
    },
    /// All the tiers of a clip, as an alignment makes them.
    Timing {
        /// Number of the clip.
        clip: usize,
        /// As they were.
        before: Box<Times>,
        /// As they are to be.
        after: Box<Times>,
    },
    /// What is said in a clip: its script, its times and its pins, where words are put in.
    Said {
        /// Number of the clip.
        clip: usize,
        /// As it was.
        before: Box<Said>,
        /// As it is to be.
        after: Box<Said>,
    },
    /// What was found in a clip's video.
    Tracked {
        /// Number of the clip.
        clip: usize,
        /// As it was.
        before: Box<Footage>,
        /// As it is to be.
        after: Box<Footage>,
    },
    /// A syllable's label: its text, or text and reading as `行{hang2}`.
    Label {
        /// Number of the clip.
        clip: usize,
        /// Number of the syllable.
        index: usize,
        /// As it was.
        before: String,
        /// As it is to be.
        after: String,
    },
    /// Whether the author vouches for a syllable's times.
    Pin {
        /// Number of the clip.
        clip: usize,
        /// Number of the syllable.
        index: usize,
        /// As it is to be; it was the other.
        pinned: bool,
    },
    /// A key more.
    AddKey {
        /// Number of the clip.
        clip: usize,
        /// The key.
        key: Key,
    },
    /// A key less.
    RemoveKey {
        /// Number of the clip.
        clip: usize,
        /// The key.
        key: Key,
    },
    /// A range edit more.
    AddRange {
        /// Number of the clip.
        clip: usize,
        /// Its place in the list.
        at: usize,
        /// The range edit.
        range: Range,
    },
    /// A range edit less.
    RemoveRange {
        /// Number of the clip.
        clip: usize,
        /// Its place in the list.
        at: usize,
        /// The range edit.
        range: Range,
    },
    /// A marker more.
    AddMarker {
        /// Number of the clip.
        clip: usize,
        /// The marker.
        marker: Marker,
    },
    /// A marker less.
    RemoveMarker {
        /// Number of the clip.
        clip: usize,
        /// The marker.
        marker: Marker,
    },
    /// Where a feature point of a face is.
    Point {
        /// Number of the face.
        face: usize,
        /// In which of its shots; a journal that does not say means the neutral one.
        #[serde(default = "neutral")]
        shot: Emotion,
        /// The point's name.
        point: String,
        /// As it was.
        before: Spot,
        /// As it is to be.
        after: Spot,
    },
    /// A face as a whole, as the text of its `face.toml`; none is a face without points.
    Face {
        /// Number of the face.
        face: usize,
        /// As it was.
        before: Option<String>,
        /// As it is to be.
        after: Option<String>,
    },
    /// The points of a shot as a whole, as the text of its `happy.toml`; none is a shot without points.
    Marks {
        /// Number of the face.
        face: usize,
        /// Which of its shots.
        shot: Emotion,
        /// As it was.
        before: Option<String>,
        /// As it is to be.
        after: Option<String>,
    },
}

fn neutral() -> Emotion {
    Emotion::Neutral
}

/// The tiers of a clip, and what they were made from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Times {
    /// The tiers.
    pub timing: Timing,
    /// The checksum of sound and script they were found with, where they were found by an alignment.
    pub aligned: Option<String>,
}

/// A feature point's place, as an edit keeps it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Spot {
    /// Pixels of the photo.
    pub at: [f64; 2],
    /// 0 to 1.
    pub confidence: f64,
    /// How it came to be.
    pub how: How,
}

impl Spot {
    /// Whether a point is there, as exactly as a file says it.
    fn is_of(&self, placed: &Placed) -> bool {
        let near = (placed.at - Point::new(self.at[0], self.at[1])).hypot() < 0.1;
        near && (placed.confidence - self.confidence).abs() < 0.01 && placed.how == self.how
    }
}

impl From<Placed> for Spot {
    fn from(placed: Placed) -> Self {
        Self { at: [placed.at.x, placed.at.y], confidence: placed.confidence, how: placed.how }
    }
}

impl From<Spot> for Placed {
    fn from(spot: Spot) -> Self {
        Self { at: Point::new(spot.at[0], spot.at[1]), confidence: spot.confidence, how: spot.how }
    }
}

impl Change {
    /// A change of one edit.
    #[must_use]
    pub fn one(label: impl Into<String>, edit: Edit) -> Self {
        Self { label: label.into(), edits: vec![edit] }
    }

    /// What takes it back.
    #[must_use]
    pub fn inverse(&self) -> Self {
        Self { label: self.label.clone(), edits: self.edits.iter().rev().map(Edit::inverse).collect() }
    }
}

impl Edit {
    /// What takes it back.
    #[must_use]
    pub fn inverse(&self) -> Self {
        match self.clone() {
            Self::Times { clip, first, before, after } => Self::Times { clip, first, before: after, after: before },
            Self::Timing { clip, before, after } => Self::Timing { clip, before: after, after: before },
            Self::Said { clip, before, after } => Self::Said { clip, before: after, after: before },
            Self::Tracked { clip, before, after } => Self::Tracked { clip, before: after, after: before },
            Self::Label { clip, index, before, after } => Self::Label { clip, index, before: after, after: before },
            Self::Pin { clip, index, pinned } => Self::Pin { clip, index, pinned: !pinned },
            Self::AddKey { clip, key } => Self::RemoveKey { clip, key },
            Self::RemoveKey { clip, key } => Self::AddKey { clip, key },
            Self::AddRange { clip, at, range } => Self::RemoveRange { clip, at, range },
            Self::RemoveRange { clip, at, range } => Self::AddRange { clip, at, range },
            Self::AddMarker { clip, marker } => Self::RemoveMarker { clip, marker },
            Self::RemoveMarker { clip, marker } => Self::AddMarker { clip, marker },
            Self::Point { face, shot, point, before, after } => {
                Self::Point { face, shot, point, before: after, after: before }
            }
            Self::Face { face, before, after } => Self::Face { face, before: after, after: before },
            Self::Marks { face, shot, before, after } => Self::Marks { face, shot, before: after, after: before },
        }
    }

    /// Whether what it says is to be is what is, so that it can be taken back.
    pub(super) fn is_made(&self, clips: &[Clip], faces: &[LessonFace]) -> bool {
        self.inverse().apply(&mut clips.to_vec(), &mut faces.to_vec()).is_ok()
    }

    /// Makes the edit. What it says was must be what is.
    pub(super) fn apply(&self, clips: &mut [Clip], faces: &mut [LessonFace]) -> Result<()> {
        match self {
            Self::Times { clip, first, before, after } => set_times(clip_of(clips, *clip)?, *first, before, after),
            Self::Timing { clip, before, after } => {
                let clip = clip_of(clips, *clip)?;
                if !same_times(&clip.timing, &before.timing) || clip.score.aligned != before.aligned {
                    return Err(stale());
                }
                in_order(after.timing.syllables().unwrap_or(&Tier::default()))?;
                take_own(&mut clip.timing, &after.timing);
                clip.score.aligned.clone_from(&after.aligned);
                clip.read_labels();
                Ok(())
            }
            Self::Said { clip, before, after } => clip_of(clips, *clip)?.say(before, after),
            Self::Tracked { clip, before, after } => clip_of(clips, *clip)?.take_footage(before, after),
            Self::Label { clip, index, before, after } => {
                let clip = clip_of(clips, *clip)?;
                let label = clip
                    .timing
                    .tier_mut("syllables")
                    .and_then(|t| t.intervals.get_mut(*index))
                    .map(|i| &mut i.label)
                    .filter(|l| *l == before)
                    .ok_or_else(stale)?;
                label.clone_from(after);
                clip.read_labels();
                Ok(())
            }
            Self::Pin { clip, index, pinned } => {
                let pins = &mut clip_of(clips, *clip)?.score.pins;
                match (pins.binary_search(index), pinned) {
                    (Err(place), true) => pins.insert(place, *index),
                    (Ok(place), false) => {
                        pins.remove(place);
                    }
                    _ => return Err(stale()),
                }
                Ok(())
            }
            Self::AddKey { clip, key } => {
                if !(key.time.is_finite() && key.time >= 0.0) {
                    return Err(Fault::of(ProjectFault::Edit, format!("a key cannot be at {} s", key.time))
                        .help("give a time from 0 on"));
                }
                add(&mut clip_of(clips, *clip)?.score.keys, key)
            }
            Self::RemoveKey { clip, key } => remove(&mut clip_of(clips, *clip)?.score.keys, |k| k.is_same(key)),
            Self::AddRange { clip, at, range } => {
                let ranges = &mut clip_of(clips, *clip)?.score.ranges;
                if *at > ranges.len() {
                    return Err(stale());
                }
                ranges.insert(*at, *range);
                Ok(())
            }
            Self::RemoveRange { clip, at, range } => {
                let ranges = &mut clip_of(clips, *clip)?.score.ranges;
                if !ranges.get(*at).is_some_and(|r| r.is_same(range)) {
                    return Err(stale());
                }
                ranges.remove(*at);
                Ok(())
            }
            Self::AddMarker { clip, marker } => add(&mut clip_of(clips, *clip)?.score.markers, marker),
            Self::RemoveMarker { clip, marker } => {
                remove(&mut clip_of(clips, *clip)?.score.markers, |m| m.is_same(marker))
            }
            Self::Point { face, shot, point, before, after } => {
                let face = faces.get_mut(*face).ok_or_else(stale)?;
                let point = FeaturePoint::named(point).ok_or_else(stale)?;
                let placed = match shot {
                    Emotion::Neutral => face.face.as_mut().and_then(|f| f.placed_mut(point)),
                    emotion => face.shots[emotion.index()].placed_mut(point),
                };
                let placed = placed.filter(|p| before.is_of(p)).ok_or_else(stale)?;
                near_the_photo(after.at)?;
                *placed = (*after).into();
                Ok(())
            }
            Self::Face { face, before, after } => {
                let face = faces.get_mut(*face).ok_or_else(stale)?;
                if face.face.as_ref().map(Face::to_toml) != *before {
                    return Err(stale());
                }
                face.face = after.as_deref().map(Face::parse).transpose()?;
                Ok(())
            }
            Self::Marks { face, shot, before, after } => {
                let face = faces.get_mut(*face).ok_or_else(stale)?;
                let shot = face.shots.get_mut(shot.index()).filter(|_| *shot != Emotion::Neutral).ok_or_else(stale)?;
                if shot.marks.as_ref().map(Marks::to_toml) != *before {
                    return Err(stale());
                }
                shot.marks = after.as_deref().map(Marks::parse).transpose()?;
                Ok(())
            }
        }
    }
}

fn clip_of(clips: &mut [Clip], clip: usize) -> Result<&mut Clip> {
    clips.get_mut(clip).ok_or_else(stale)
}

pub(super) fn stale() -> Fault {
    Fault::of(ProjectFault::Changed, "the change does not fit the lesson as it is now")
        .help("the files were changed by other means")
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

/// Whether two sets of tiers have the same syllables at the same times: a file keeps microseconds, memory more. The
/// other tiers follow the syllables.
pub(super) fn same_times(a: &Timing, b: &Timing) -> bool {
    let near = |a: f64, b: f64| (a - b).abs() < 2e-6;
    let intervals = |t: &Timing| t.syllables().map(|t| t.intervals.clone()).unwrap_or_default();
    let (a, b) = (intervals(a), intervals(b));
    a.len() == b.len()
        && a.iter().zip(&b).all(|(a, b)| a.label == b.label && near(a.start, b.start) && near(a.end, b.end))
}

/// Gives a clip the tiers that this program writes, from others. Everybody else's stay as they are now.
pub(super) fn take_own(timing: &mut Timing, from: &Timing) {
    let is_own = |t: &&Tier| OWN_TIERS.contains(&t.name.as_str());
    timing.tiers.retain(|t| !is_own(&t));
    for tier in from.tiers.iter().filter(is_own) {
        timing.set_tier(tier.clone());
    }
    timing.guessed = from.guessed;
}

/// Makes sure that syllables follow each other: what does not could be written and not read again.
pub(super) fn in_order(tier: &Tier) -> Result<()> {
    let mut edge = 0.0;
    for interval in tier.spoken() {
        let rises = interval.start >= edge - 1e-6 && interval.end >= interval.start && interval.end.is_finite();
        if !rises {
            return Err(Fault::of(
                ProjectFault::Edit,
                format!(
                    "`{}` cannot be said from {:.3} to {:.3} s, where the one before ends at {edge:.3} s",
                    interval.label, interval.start, interval.end
                ),
            )
            .help("syllables follow each other"));
        }
        edge = interval.end;
    }
    Ok(())
}

/// Moves what lies in or ends with syllables along with them: an edge at a syllable's edge stays there, one inside
/// keeps its share of the syllable. Turning the edit round brings it back. What stands between syllables gives way to
/// them for good.
fn follow(tier: &mut Tier, before: &[(f64, f64)], after: &[(f64, f64)]) {
    const NEAR: f64 = 2e-6;
    let moved = |t: f64, is_start: bool| {
        // Where two syllables touch, a start belongs to the later one and an end to the earlier.
        let holds = |(from, to): &(f64, f64)| {
            if is_start { *from - NEAR <= t && t < *to - NEAR } else { *from + NEAR < t && t <= *to + NEAR }
        };
        // Syllables rise, so the one that may hold a time is the last that starts before it, or the one before that.
        let after_it = before.partition_point(|(from, _)| *from <= t + NEAR);
        let place = (after_it.saturating_sub(2)..after_it).find(|p| holds(&before[*p]))?;
        let ((a, b), (c, d)) = (before[place], after[place]);
        Some(c + ((t - a) / (b - a)).clamp(0.0, 1.0) * (d - c))
    };
    for interval in &mut tier.intervals {
        interval.start = moved(interval.start, true).unwrap_or(interval.start);
        interval.end = moved(interval.end, false).unwrap_or(interval.end).max(interval.start);
    }
    // What stands between syllables, such as something that is not in the script, gives way.
    for i in 1..tier.intervals.len() {
        let until = tier.intervals[i - 1].end;
        let interval = &mut tier.intervals[i];
        if interval.start < until {
            interval.start = until;
            interval.end = interval.end.max(until);
        }
    }
}

/// Sets times that stay in order: no syllable ends before it starts or overlaps its neighbour.
fn set_times(clip: &mut Clip, first: usize, before: &[(f64, f64)], after: &[(f64, f64)]) -> Result<()> {
    let duration = clip.duration();
    let Some(tier) = clip.timing.tier_mut("syllables") else { return Err(stale()) };
    let end = first + before.len();
    let now = tier.intervals.get(first..end).filter(|_| before.len() == after.len()).ok_or_else(stale)?;
    // A file keeps microseconds, memory more.
    let near = |a: f64, b: f64| (a - b).abs() < 2e-6;
    if now.iter().zip(before).any(|(i, b)| !near(i.start, b.0) || !near(i.end, b.1)) {
        return Err(stale());
    }
    let left = first.checked_sub(1).and_then(|i| tier.intervals.get(i)).map_or(0.0, |i| i.end);
    let right = tier.intervals.get(end).map_or(duration, |i| i.start);
    let mut edge = left;
    for (start, end) in after {
        if !(start.is_finite() && end.is_finite() && *start >= edge - 1e-9 && end > start && *end <= right + 1e-9) {
            return Err(Fault::of(ProjectFault::Edit, format!("a syllable cannot last from {start:.3} to {end:.3} s"))
                .help(format!("there is room from {left:.3} to {right:.3} s")));
        }
        edge = *end;
    }
    for (interval, (start, end)) in tier.intervals[first..end].iter_mut().zip(after) {
        (interval.start, interval.end) = (*start, *end);
    }
    for tier in clip.timing.tiers.iter_mut().filter(|t| matches!(t.name.as_str(), "words" | "phones" | CONFIDENCE)) {
        follow(tier, before, after);
    }
    Ok(())
}

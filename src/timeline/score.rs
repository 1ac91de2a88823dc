//! What an author set on a clip: keys, edits of ranges of the record, markers, and the seed of what is random.

use serde::{Deserialize, Serialize};

use super::Ease;
use crate::pose::{Gaze, Head, MouthShape, Ratios};

/// Which track a key lies on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Track {
    /// The seven ratios.
    Emotion,
    /// The mouth shape.
    Mouth,
    /// A blink.
    Blink,
    /// Where the eyes look.
    Gaze,
    /// Where the head is.
    Head,
}

/// What a key sets.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum KeyValue {
    /// The seven ratios.
    Emotion(Ratios),
    /// A mouth shape, or none: the mouth at rest.
    Mouth(Option<MouthShape>),
    /// A blink of so many seconds whose lids meet at the key's time.
    Blink(f64),
    /// Where the eyes look.
    Gaze(Gaze),
    /// Where the head is.
    Head(Head),
}

impl KeyValue {
    /// The track it lies on.
    #[must_use]
    pub const fn track(&self) -> Track {
        match self {
            Self::Emotion(_) => Track::Emotion,
            Self::Mouth(_) => Track::Mouth,
            Self::Blink(_) => Track::Blink,
            Self::Gaze(_) => Track::Gaze,
            Self::Head(_) => Track::Head,
        }
    }
}

/// A key frame of the author's.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Key {
    /// Seconds.
    pub time: f64,
    /// What holds then.
    pub value: KeyValue,
    /// How it goes on from here.
    pub ease: Ease,
    /// The last emotion key of its span: after it the record holds again.
    pub ends: bool,
    /// For a mouth key that was made by moving a key of speech: when that one was.
    pub replaces: Option<f64>,
}

impl Key {
    /// A key with the usual ease.
    #[must_use]
    pub fn new(time: f64, value: KeyValue) -> Self {
        Self { time, value, ease: Ease::Smooth, ends: false, replaces: None }
    }

    /// Whether both are one key, of which a file keeps millionths and memory more.
    #[must_use]
    pub fn is_same(&self, other: &Self) -> bool {
        let value = match (&self.value, &other.value) {
            (KeyValue::Emotion(a), KeyValue::Emotion(b)) => are_near(&a.0, &b.0),
            (KeyValue::Blink(a), KeyValue::Blink(b)) => is_near(*a, *b),
            (KeyValue::Gaze(a), KeyValue::Gaze(b)) => is_near(a.x, b.x) && is_near(a.y, b.y),
            (KeyValue::Head(a), KeyValue::Head(b)) => are_near(&[a.x, a.y, a.roll], &[b.x, b.y, b.roll]),
            (a, b) => a == b,
        };
        let replaces = match (self.replaces, other.replaces) {
            (Some(a), Some(b)) => is_near(a, b),
            (a, b) => a.is_none() && b.is_none(),
        };
        value && replaces && is_near(self.time, other.time) && (self.ease, self.ends) == (other.ease, other.ends)
    }
}

/// Numbers nearer than this are one in a file, neutral's share among them, which takes up the roundings of six others.
const NEAR: f64 = 1e-5;

fn is_near(a: f64, b: f64) -> bool {
    (a - b).abs() < NEAR
}

fn are_near(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| is_near(*a, *b))
}

/// An edit of the ratio record between two times. Each emotion's ratio becomes ratio × scale + offset; neutral takes
/// up what the others gain or lose.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Range {
    /// Seconds.
    pub from: f64,
    /// Seconds.
    pub to: f64,
    /// By emotion in canonical order; neutral's is not used.
    pub scale: [f64; 7],
    /// By emotion in canonical order; neutral's is not used.
    pub offset: [f64; 7],
    /// Width of the smoothing in seconds, 0 for none.
    pub smooth: f64,
}

/// Seconds over which a range edit fades in and out inside its ends, so that it leaves no step.
const FADE: f64 = 0.08;

impl Range {
    /// Whether both are one edit, of which a file keeps millionths and memory more.
    #[must_use]
    pub(crate) fn is_same(&self, other: &Self) -> bool {
        let numbers = |r: &Self| [r.from, r.to, r.smooth];
        let lists = |r: &Self| -> Vec<f64> { r.scale[1..].iter().chain(&r.offset[1..]).copied().collect() };
        are_near(&numbers(self), &numbers(other)) && are_near(&lists(self), &lists(other))
    }

    /// An edit that changes nothing yet.
    #[must_use]
    pub fn new(from: f64, to: f64) -> Self {
        Self { from, to, scale: [1.0; 7], offset: [0.0; 7], smooth: 0.0 }
    }

    /// How much of the edit holds at `t`, 0 to 1.
    #[must_use]
    pub(crate) fn weight(&self, t: f64) -> f64 {
        if t < self.from || t > self.to {
            return 0.0;
        }
        let fade = FADE.min((self.to - self.from) / 2.0).max(1e-9);
        ((t - self.from).min(self.to - t) / fade).clamp(0.0, 1.0)
    }
}

/// A named moment.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Marker {
    /// Seconds.
    pub time: f64,
    /// What it says.
    pub text: String,
}

impl Marker {
    /// Whether both are one marker, of which a file keeps millionths and memory more.
    #[must_use]
    pub(crate) fn is_same(&self, other: &Self) -> bool {
        is_near(self.time, other.time) && self.text == other.text
    }
}

/// Everything an author set on a clip.
#[derive(Debug, Clone, PartialEq)]
pub struct Score {
    /// Her keys, in any order.
    pub keys: Vec<Key>,
    /// Her range edits, in the order they were made.
    pub ranges: Vec<Range>,
    /// Her markers.
    pub markers: Vec<Marker>,
    /// Syllables (by number, from 0) whose boundaries she set: a new alignment keeps them.
    pub pins: Vec<usize>,
    /// Whether the times of the syllables that are not pinned are guesses.
    pub guessed: bool,
    /// The checksum of the sound and the script that an alignment found the times with; none where they came
    /// otherwise.
    pub aligned: Option<String>,
    /// The checksum of the video and the calibration that the record was tracked with, and that of the record; none
    /// where it came otherwise.
    pub tracked: Option<String>,
    /// Seed of what is random.
    pub seed: u64,
    /// Whether blinks are made up between her own.
    pub auto_blink: bool,
}

impl Default for Score {
    fn default() -> Self {
        Self {
            keys: Vec::new(),
            ranges: Vec::new(),
            markers: Vec::new(),
            pins: Vec::new(),
            guessed: false,
            aligned: None,
            tracked: None,
            seed: 1,
            auto_blink: true,
        }
    }
}

impl Score {
    /// The keys in order of time.
    pub fn sorted_keys(&self) -> impl Iterator<Item = &Key> {
        let mut keys: Vec<&Key> = self.keys.iter().collect();
        keys.sort_by(|a, b| a.time.total_cmp(&b.time));
        keys.into_iter()
    }
}

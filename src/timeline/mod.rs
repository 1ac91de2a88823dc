//! The score of a clip: the tracks of mouth, ratios, blinks, gaze and head at real times, and the pose they give at
//! any instant.
//!
//! A timeline is built once from what speech, video and the author say, by the rules of who wins where they meet
//! (mouth: author, then tracked video, then speech; ratios: the author's keys over the record, range edits in it).
//! Built, it only answers: `pose(t)` is a pure function. Time is in seconds; frames appear only in [`Timeline::frames`].

mod blink;
mod coarticulation;
mod ease;
mod mouth;
mod mouth_key;
mod ratios;
mod score;
mod score_file;

pub use blink::Blink;
pub use ease::Ease;
pub use mouth_key::{MouthKey, Origin, Spoken};
pub use score::{Key, KeyValue, Marker, Range, Score, Track};

use crate::pose::{Gaze, Head, Lids, MouthPose, MouthPreset, MouthShape, Pose, Ratios};
use crate::ratios::{Record, TrackRow, Tracks};
use ease::Curve;

/// What a timeline is built from.
#[derive(Debug, Clone, Copy)]
pub struct Sources<'a> {
    /// Length of the clip in seconds.
    pub duration: f64,
    /// Frames a second it is built for: a closure lasts at least one of them.
    pub fps: f64,
    /// What is said, in order.
    pub spoken: &'a [Spoken],
    /// The ratio record of a video.
    pub record: Option<&'a Record>,
    /// Eyes, mouth and head of a video.
    pub tracks: Option<&'a Tracks>,
    /// What the author set.
    pub score: &'a Score,
    /// Which nine mouth shapes.
    pub mouths: MouthPreset,
}

/// A built score.
#[derive(Debug, Clone)]
pub struct Timeline {
    duration: f64,
    fps: f64,
    mouth: mouth::MouthTrack,
    ratios: ratios::RatioTrack,
    blinks: Vec<Blink>,
    gaze: Layered<2>,
    head: Layered<3>,
    lids: Curve<2>,
}

impl Timeline {
    /// Builds the score of a clip.
    #[must_use]
    pub fn build(sources: &Sources<'_>) -> Self {
        let score = sources.score;
        let gaze = Layered {
            own: Curve::new(score.keys.iter().filter_map(|k| match k.value {
                KeyValue::Gaze(g) => Some((k.time, [g.x, g.y], k.ease)),
                _ => None,
            })),
            tracked: tracked(sources.tracks, |r| [r.gaze.x, r.gaze.y]),
        };
        let head = Layered {
            own: Curve::new(score.keys.iter().filter_map(|k| match k.value {
                KeyValue::Head(h) => Some((k.time, [h.x, h.y, h.roll], k.ease)),
                _ => None,
            })),
            tracked: tracked(sources.tracks, |r| [r.head.x, r.head.y, r.head.roll]),
        };
        // A video has the blinks of its speaker, so none are made up.
        let lids = tracked(sources.tracks, |r| [r.lids.left, r.lids.right]);
        let blinks = blink::blinks(score, sources.duration, sources.tracks.is_none());
        Self {
            duration: sources.duration.max(0.0),
            fps: sources.fps,
            mouth: mouth::MouthTrack::build(sources),
            ratios: ratios::RatioTrack::build(sources.record, score),
            blinks,
            gaze,
            head,
            lids,
        }
    }

    /// Length in seconds.
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.duration
    }

    /// Frames a second.
    #[must_use]
    pub(crate) fn fps(&self) -> f64 {
        self.fps
    }

    /// How many frames the clip has: ⌈duration × fps⌉. Frame k shows the time k / fps.
    #[must_use]
    pub fn frames(&self) -> u32 {
        // A length that is a whole number of frames up to rounding is that number.
        (self.duration * self.fps - 1e-6).ceil().clamp(0.0, f64::from(u32::MAX)) as u32
    }

    /// The time that a frame shows.
    #[must_use]
    pub fn time_of(&self, frame: u32) -> f64 {
        f64::from(frame) / self.fps
    }

    /// Everything a figure needs at time `t`.
    #[must_use]
    pub fn pose(&self, t: f64) -> Pose {
        let (mouth, shape) = self.mouth.at(t);
        let closed = self.blinks.iter().map(|b| b.closed_at(t)).fold(0.0, f64::max);
        let [left, right] = self.lids.at(t).unwrap_or([1.0, 1.0]);
        let [x, y] = self.gaze.at(t);
        let [head_x, head_y, roll] = self.head.at(t);
        Pose {
            ratios: self.ratios.at(t),
            mouth,
            shape,
            gaze: Gaze { x, y },
            lids: Lids { left: left * (1.0 - closed), right: right * (1.0 - closed) },
            head: Head { x: head_x, y: head_y, roll },
        }
    }

    /// The ratios alone.
    #[must_use]
    pub fn ratios(&self, t: f64) -> Ratios {
        self.ratios.at(t)
    }

    /// The mouth alone, with the shape it is nearest to.
    #[must_use]
    pub fn mouth(&self, t: f64) -> (MouthPose, Option<MouthShape>) {
        self.mouth.at(t)
    }

    /// The key frames of the mouth in order, whoever set them.
    #[must_use]
    pub fn mouth_keys(&self) -> &[MouthKey] {
        self.mouth.keys()
    }

    /// The blinks in order.
    #[must_use]
    pub fn blinks(&self) -> &[Blink] {
        &self.blinks
    }
}

/// What a video gave, from row to row.
fn tracked<const N: usize>(tracks: Option<&Tracks>, pick: fn(&TrackRow) -> [f64; N]) -> Curve<N> {
    let rows = tracks.map(|t| t.rows.as_slice()).unwrap_or_default();
    Curve::new(rows.iter().map(|r| (r.time, pick(r), Ease::Linear)))
}

/// The author's curve over a tracked one.
#[derive(Debug, Clone)]
struct Layered<const N: usize> {
    own: Curve<N>,
    tracked: Curve<N>,
}

impl<const N: usize> Layered<N> {
    /// The author's between her first and last key, else what was tracked, else her nearest key, else rest.
    fn at(&self, t: f64) -> [f64; N] {
        let hers = self.own.span().is_some_and(|(from, to)| from <= t && t <= to);
        let own = || self.own.at(t);
        let value = if hers { own() } else { self.tracked.at(t).or_else(own) };
        value.unwrap_or([0.0; N])
    }
}

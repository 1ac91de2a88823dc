//! The mouth's track: keys, whoever set them, become a continuous mouth.
//!
//! Speech gives keys (`coarticulation`), an author adds hers, a video's mouth stands in their place; who wins where they
//! meet is decided here.

use super::coarticulation::of_speech;
use super::ease::Curve;
use super::mouth_key::{MouthKey, Origin, PREPARE, RELEASE, TRAVEL, corners_of_n};
use super::{Ease, KeyValue, Sources};
use crate::pose::{MouthPose, MouthShape};

/// An author's key makes the keys of speech this near give way, in seconds.
const AUTHOR_REACH: f64 = 0.06;

/// A moved key stands for the key of speech at that time, give or take this.
const REPLACES_REACH: f64 = 0.02;

#[derive(Debug, Clone)]
pub(super) struct MouthTrack {
    keys: Vec<MouthKey>,
    curve: Curve<11>,
    tracked: bool,
}

impl MouthTrack {
    pub(super) fn build(sources: &Sources<'_>) -> Self {
        let tracked = sources.tracks.is_some();
        // A video's mouth wins over what speech would do.
        let mut keys = if tracked { Vec::new() } else { of_speech(sources.spoken, 1.0 / sources.fps, sources.mouths) };
        let mut own = Vec::new();
        for key in sources.score.sorted_keys() {
            if let KeyValue::Mouth(shape) = key.value {
                let pose = shape.map_or(MouthPose::REST, |s| MouthPose::of(s, sources.mouths));
                // A closure of the author's lasts a frame as well.
                let held = if shape.is_some_and(MouthShape::closes) { 1.0 / sources.fps } else { 0.0 };
                own.push(MouthKey {
                    time: key.time,
                    until: key.time + held,
                    shape,
                    pose,
                    origin: Origin::Author,
                    ease: key.ease,
                });
                keys.retain(|k| {
                    let near = k.time < key.time + AUTHOR_REACH && k.until > key.time - AUTHOR_REACH;
                    let replaced = key.replaces.is_some_and(|t| (k.time - t).abs() < REPLACES_REACH);
                    !near && (!replaced || k.origin == Origin::Pause)
                });
            }
        }
        keys.extend(own);
        keys.sort_by(|a, b| a.time.total_cmp(&b.time));
        corners_of_n(&mut keys);
        if !tracked {
            rest_around_the_author_s(&mut keys);
        }
        let mut points = Vec::with_capacity(2 * keys.len());
        for key in &keys {
            points.push((key.time, key.pose.to_array(), if key.until > key.time { Ease::Smooth } else { key.ease }));
            if key.until > key.time {
                points.push((key.until, key.pose.to_array(), key.ease));
            }
        }
        if let Some(tracks) = sources.tracks {
            // The author's keys and the way to and from them are hers, the rest is the video's.
            let hers = |t: f64| keys.iter().any(|k| t > k.time - TRAVEL && t < k.until + TRAVEL);
            let rows = tracks.rows.iter().filter(|r| !hers(r.time));
            points.extend(rows.map(|r| (r.time, of_track(r).to_array(), Ease::Linear)));
        }
        Self { keys, curve: Curve::new(points), tracked }
    }

    pub(super) fn at(&self, t: f64) -> (MouthPose, Option<MouthShape>) {
        let pose = self.curve.at(t).map_or(MouthPose::REST, MouthPose::from_array);
        if self.tracked {
            let hers = |k: &&MouthKey| t > k.time - TRAVEL && t < k.until + TRAVEL;
            return (pose, self.keys.iter().find(hers).and_then(|k| k.shape));
        }
        // The shape whose hold is nearest in time.
        let after = self.keys.partition_point(|k| k.time <= t);
        let (before, next) = (after.checked_sub(1).and_then(|i| self.keys.get(i)), self.keys.get(after));
        let shape = match (before, next) {
            (Some(a), Some(b)) if b.time - t < t - a.until => b.shape,
            (Some(a), _) => a.shape,
            (None, Some(b)) => b.shape,
            (None, None) => None,
        };
        (pose, shape)
    }

    pub(super) fn keys(&self) -> &[MouthKey] {
        &self.keys
    }
}

/// A key of the author's in a pause is a movement of its own: the mouth leaves rest for it and comes back. Between two
/// of her keys it goes from one to the other, however far apart they are.
fn rest_around_the_author_s(keys: &mut Vec<MouthKey>) {
    let rest = |time: f64, until: f64| MouthKey { time, until, ..MouthKey::REST };
    let mut all = Vec::with_capacity(keys.len() + 4);
    for (i, key) in keys.iter().enumerate() {
        let own = key.origin == Origin::Author && key.shape.is_some();
        let before = i.checked_sub(1).map(|i| &keys[i]);
        let after = keys.get(i + 1);
        let at_rest = |k: &MouthKey| k.origin == Origin::Pause;
        let leaves = key.time - PREPARE;
        if own && leaves > before.map_or(0.0, |b| b.until) && before.is_none_or(at_rest) {
            all.push(rest(leaves, leaves));
        }
        all.push(*key);
        let returns = key.until + RELEASE;
        if own && after.is_none_or(|a| at_rest(a) && a.time > returns) {
            all.push(rest(returns, returns));
        }
    }
    *keys = all;
}

/// What a tracked mouth does: lips and corners moved away from neutral by so much (`tracks.csv`), the emotion's part in
/// it. The table counts lips in MNS0 and a pose in M, which are one on most faces; where M is MW0's, a figure opens a
/// little less.
fn of_track(row: &crate::ratios::TrackRow) -> MouthPose {
    MouthPose {
        upper: -row.mouth.up,
        lower: row.mouth.down,
        corner_in: -f64::midpoint(row.mouth.left, row.mouth.right),
        speaking: 2.0,
        ..MouthPose::REST
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Key, Score, Spoken, Timeline};
    use super::*;
    use crate::pose::MouthPreset;
    use proptest::prelude::*;

    fn timeline(spoken: &[Spoken], fps: f64, score: &Score) -> Timeline {
        let duration = spoken.last().map_or(1.0, |s| s.end + 0.5);
        Timeline::build(&Sources {
            duration,
            fps,
            spoken,
            record: None,
            tracks: None,
            score,
            mouths: MouthPreset::Distinct,
        })
    }

    fn ba(start: f64, length: f64) -> Spoken {
        Spoken { start, end: start + length, shapes: vec![(0.0, MouthShape::M), (0.464, MouthShape::A)], exact: false }
    }

    #[test]
    fn a_mouth_rests_before_and_after_and_opens_in_between() {
        let line = timeline(&[ba(0.5, 0.3)], 25.0, &Score::default());
        assert_eq!(line.mouth(0.2).0, MouthPose::REST);
        assert_eq!(line.mouth(0.5).0.closure, 1.0);
        assert!(line.mouth(0.7).0.opening() > 1.0);
        assert_eq!(line.mouth(1.2).0, MouthPose::REST);
    }

    #[test]
    fn a_closure_whose_end_is_known_lasts_until_then_and_opens_from_there() {
        let line = timeline(&[Spoken { exact: true, ..ba(0.5, 0.4) }], 100.0, &Score::default());
        let release = 0.5 + 0.464 * 0.4;
        assert_eq!(line.mouth(release - 0.01).0.opening(), 0.0);
        assert!(line.mouth(release + 0.02).0.opening() > 0.1);
        assert!(line.mouth(release + 0.07).0.opening() > 1.0);
    }

    #[test]
    fn an_author_s_key_wins_over_speech() {
        let mut score = Score::default();
        score.keys.push(Key::new(0.66, KeyValue::Mouth(Some(MouthShape::U))));
        let line = timeline(&[ba(0.5, 0.3)], 25.0, &score);
        assert_eq!(line.mouth(0.66).1, Some(MouthShape::U));
        assert!(line.mouth(0.66).0.corner_in > 0.2);
    }

    #[test]
    fn syllables_that_touch_are_held_like_syllables_that_nearly_do() {
        let ma = |gap: f64| -> Vec<Spoken> { (0..3).map(|i| ba(0.3 + f64::from(i) * 0.6, 0.6 - gap)).collect() };
        let (touching, apart) =
            (timeline(&ma(0.0), 50.0, &Score::default()), timeline(&ma(0.001), 50.0, &Score::default()));
        for k in 0..100 {
            let t = f64::from(k) * 0.02;
            let (a, b) = (touching.mouth(t).0.opening(), apart.mouth(t).0.opening());
            assert!((a - b).abs() < 0.1, "{a} and {b} at {t}");
        }
    }

    #[test]
    fn a_key_of_the_author_s_in_a_pause_moves_the_mouth_there_and_nowhere_else() {
        let mut score = Score::default();
        score.keys.push(Key::new(5.0, KeyValue::Mouth(Some(MouthShape::A))));
        let line = Timeline::build(&Sources {
            duration: 20.0,
            fps: 25.0,
            spoken: &[],
            record: None,
            tracks: None,
            score: &score,
            mouths: MouthPreset::Distinct,
        });
        assert!(line.mouth(5.0).0.opening() > 1.0);
        for t in [0.0, 4.5, 5.5, 12.0] {
            assert_eq!(line.mouth(t).0, MouthPose::REST, "{t}");
        }
    }

    #[test]
    fn a_key_of_the_author_s_leaves_the_tracked_mouth_elsewhere_alone() {
        let rows = (0..100).map(|frame| crate::ratios::TrackRow {
            frame,
            time: f64::from(frame) * 0.04,
            gaze: crate::pose::Gaze::default(),
            lids: crate::pose::Lids::default(),
            mouth: crate::ratios::MouthMoves { down: 0.8, ..crate::ratios::MouthMoves::default() },
            head: crate::pose::Head::default(),
            confidence: 1.0,
        });
        let tracks = crate::ratios::Tracks { rows: rows.collect() };
        let mut score = Score::default();
        score.keys.push(Key::new(1.0, KeyValue::Mouth(Some(MouthShape::M))));
        let line = Timeline::build(&Sources {
            duration: 4.0,
            fps: 25.0,
            spoken: &[],
            record: None,
            tracks: Some(&tracks),
            score: &score,
            mouths: MouthPreset::Distinct,
        });
        assert_eq!(line.mouth(1.0).0.opening(), 0.0);
        for t in [0.2, 0.85, 1.2, 3.0] {
            assert!((line.mouth(t).0.opening() - 0.8).abs() < 1e-6, "{t}");
        }
    }

    #[test]
    fn n_keeps_the_corners_of_the_shape_before_it() {
        let yin =
            Spoken { start: 0.3, end: 0.7, shapes: vec![(0.0, MouthShape::I), (0.6, MouthShape::N)], exact: false };
        let line = timeline(&[yin], 25.0, &Score::default());
        let keys = line.mouth_keys();
        let n = keys.iter().find(|k| k.shape == Some(MouthShape::N)).unwrap();
        assert_eq!(n.pose.corner_in, MouthPose::of(MouthShape::I, MouthPreset::Distinct).corner_in);
    }

    proptest! {
        #[test]
        fn however_fast_the_speech_every_closure_shows_in_a_frame(
            lengths in prop::collection::vec(0.05..0.4f64, 1..12),
            fps in prop::sample::select(vec![12.0, 24.0, 25.0, 30.0, 60.0]),
        ) {
            let mut t = 0.3;
            let spoken: Vec<Spoken> = lengths.iter().map(|l| { t += l; ba(t - l, *l) }).collect();
            let line = timeline(&spoken, fps, &Score::default());
            for s in &spoken {
                let frames = (0..line.frames()).map(|k| line.time_of(k));
                let closed = frames
                    .filter(|t| (*t - s.start).abs() <= 1.0 / fps + 0.04)
                    .any(|t| line.mouth(t).0.opening() <= 0.03);
                prop_assert!(closed, "syllable at {} at {fps} fps", s.start);
            }
        }

        #[test]
        fn fast_vowels_open_less_than_slow_ones(length in 0.06..0.12f64) {
            let word = |length: f64| -> Vec<Spoken> { (0..6).map(|i| ba(0.3 + f64::from(i) * length, length)).collect() };
            let widest = |spoken: &[Spoken]| {
                let line = timeline(spoken, 25.0, &Score::default());
                // Without the last syllable, which has the pause to open in.
                let end = spoken[spoken.len() - 2].end;
                let times = (0..200).map(|i| 0.3 + f64::from(i) * 0.01).take_while(|t| *t < end);
                times.map(|t| line.mouth(t).0.opening()).fold(0.0, f64::max)
            };
            prop_assert!(widest(&word(length)) < widest(&word(0.4)));
        }
    }
}

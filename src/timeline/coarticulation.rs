//! Syllables become key frames of the mouth.
//!
//! Every shape is a target that is reached when its sound starts and held until the mouth must leave for the next.
//! Where speech is fast the targets give way to each other (coarticulation): a vowel with little time is reached in
//! part, so that the mouth does not flap. A closure never gives way: it is reached whole and lasts a frame at least.

use super::Ease;
use super::mouth_key::{MouthKey, Origin, PREPARE, RELEASE, Spoken, TRAVEL, corners_of_n};
use crate::pose::{MouthPose, MouthPreset, MouthShape};

/// The longest way from vowel to vowel within a syllable: a glide such as a-u is one slow movement.
const GLIDE: f64 = 0.18;

/// A gap between syllables shorter than this keeps the mouth speaking.
const BREATH: f64 = 0.30;

/// A target held for this long is reached whole.
const FULL_TARGET: f64 = 0.13;

/// However short its time, this much of a target is reached.
const LEAST_TARGET: f64 = 0.4;

/// How long lips need to part after a stop is released, in seconds, and the share of the next sound that this may take.
const PARTING: f64 = 0.05;
const LEAST_REST: f64 = 0.4;

/// A closure's usual length, where its slot allows.
const CLOSURE: f64 = 0.07;

/// The keys of what is said, rest before, between and after.
pub(super) fn of_speech(spoken: &[Spoken], frame: f64, preset: MouthPreset) -> Vec<MouthKey> {
    let mut keys: Vec<MouthKey> = Vec::new();
    let rest = |time: f64, until: f64| MouthKey { time, until, ..MouthKey::REST };
    let said: Vec<(usize, &Spoken)> = spoken.iter().enumerate().filter(|(_, s)| !s.shapes.is_empty()).collect();
    for (place, (number, syllable)) in said.iter().enumerate() {
        let previous = place.checked_sub(1).map(|i| said[i].1);
        let next = said.get(place + 1).map(|s| s.1);
        let gap = previous.map_or(f64::INFINITY, |p| syllable.start - p.end);
        if gap > BREATH {
            let from = previous.map_or(0.0, |p| p.end + RELEASE.min(gap / 2.0));
            let until = syllable.start - PREPARE.min(gap / 2.0);
            if until >= 0.0 {
                keys.push(rest(from.min(until), until));
            }
        }
        let length = syllable.end - syllable.start;
        for (i, (share, shape)) in syllable.shapes.iter().enumerate() {
            let mut start = syllable.start + share * length;
            let leaves = match (syllable.shapes.get(i + 1), next) {
                (Some((share, _)), _) => syllable.start + share * length,
                (None, Some(next)) if next.start - syllable.end <= BREATH => next.start,
                (None, _) => syllable.end,
            };
            let slot = leaves - start;
            // Lips that are known to be closed until here are apart only a little later.
            let parts = syllable.exact && i > 0 && syllable.shapes[i - 1].1.closes() && !shape.closes();
            if parts {
                start += PARTING.min(LEAST_REST * slot.max(0.0));
            }
            let glides = syllable.shapes.get(i + 1).is_some_and(|(_, to)| !to.closes() && !shape.closes());
            let travel = if glides { GLIDE } else { TRAVEL }.min(0.6 * slot.max(0.0));
            let last = i + 1 == syllable.shapes.len() && next.is_none_or(|n| n.start - syllable.end > BREATH);
            let until = if shape.closes() && syllable.exact && i + 1 < syllable.shapes.len() {
                start + slot.max(frame)
            } else if shape.closes() {
                start + CLOSURE.min(0.4 * slot).max(frame)
            } else if last {
                leaves
            } else {
                leaves - travel
            };
            keys.push(MouthKey {
                time: start,
                until: until.max(start),
                shape: Some(*shape),
                pose: MouthPose::of(*shape, preset),
                origin: Origin::Speech(*number),
                ease: Ease::Smooth,
            });
        }
    }
    if let Some((_, last)) = said.last() {
        keys.push(rest(last.end + RELEASE, last.end + RELEASE));
    }
    make_room(&mut keys, frame);
    corners_of_n(&mut keys);
    give_way(&mut keys);
    keys
}

/// Orders the holds: closures keep theirs, the others yield to what comes before and after. What is left with no
/// time at all goes.
fn make_room(keys: &mut Vec<MouthKey>, frame: f64) {
    let closes = |k: &MouthKey| k.shape.is_some_and(MouthShape::closes);
    for i in 1..keys.len() {
        let (before, key) = (keys[i - 1], keys[i]);
        if before.until > key.time {
            // Only a closure of a very short syllable reaches beyond its own slot.
            if closes(&before) && !closes(&key) {
                keys[i].time = before.until + 0.5 * frame;
                keys[i].until = keys[i].until.max(keys[i].time);
            } else {
                keys[i - 1].until = key.time.max(before.time);
            }
        }
    }
    let crowded = |a: &MouthKey, b: &MouthKey| b.time <= a.until && !closes(b);
    let mut kept: Vec<MouthKey> = Vec::with_capacity(keys.len());
    for key in keys.drain(..) {
        // A vowel that falls inside a neighbour's closure is not seen.
        if kept.last().is_some_and(|last| crowded(last, &key) && closes(last)) {
            continue;
        }
        while kept.last().is_some_and(|last| !closes(last) && last.time >= key.time) {
            kept.pop();
        }
        kept.push(key);
    }
    *keys = kept;
}

/// Coarticulation: a target with little time is reached in part, the rest being what lies between its neighbours.
fn give_way(keys: &mut [MouthKey]) {
    let full: Vec<MouthKey> = keys.to_vec();
    for i in 1..keys.len().saturating_sub(1) {
        let (before, key, after) = (&full[i - 1], &full[i], &full[i + 1]);
        let shape_is_open = key.shape.is_some_and(|s| !s.closes());
        if !shape_is_open || before.shape.is_none() && after.shape.is_none() {
            continue;
        }
        // The last sound of an utterance has the time until its end, and half the way to rest.
        let leaves = if after.shape.is_none() { key.until + 0.5 * RELEASE } else { after.time };
        let room = leaves - before.until;
        let reached = (room / (2.0 * FULL_TARGET)).clamp(LEAST_TARGET, 1.0);
        if reached < 1.0 {
            let between = before.pose.lerp(&after.pose, 0.5);
            let mut pose = between.lerp(&key.pose, reached);
            // In part is still open: a neighbour's closure must not spread.
            pose.closure = 0.0;
            pose.bite *= reached;
            pose.speaking = 1.0;
            keys[i].pose = pose;
        }
    }
}

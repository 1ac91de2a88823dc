//! From what was seen in each frame to the record and the tracks: what lies between frames is bridged, what a face at rest
//! looks like is told from the whole video.

use super::Tracked;
use super::measure::Measures;
use super::said::ranges;
use crate::face::rig::Expression;
use crate::geometry::{Point, Vec2};
use crate::pose::{Gaze, Head, Lids, Ratios};
use crate::ratios::{
    MouthMoves, Row, SMOOTH_WIDTH, TrackRow, Tracks, bridge_record, bridge_tracks, smooth_record, smooth_tracks,
};

/// What was seen of the face in a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Seen {
    pub ratios: Ratios,
    pub confidence: f64,
    pub measures: Measures,
    /// Where the irises are in the eyes, from the middle of the corners, in eye heights; none where they cannot be seen.
    pub iris: Option<Vec2>,
}

/// A frame, and what was seen in it; none where the face was lost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Instant {
    pub frame: u32,
    pub time: f64,
    pub seen: Option<Seen>,
}

/// Where a face rests: what its moves are counted from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rest {
    pub place: Point,
    pub pupils: f64,
    pub roll: f64,
    pub iris: Vec2,
}

/// The edges of closed lids are marked this far apart, in openings of the neutral eye.
const CLOSED: f64 = 0.1;
/// How wide lids are drawn at most.
const WIDEST: f64 = 1.2;
/// Of an open eye's height, how much lies above the middle of the eyeball.
const ABOVE: f64 = 0.55;
/// Drawn lids are this far apart at least before a blink; see the rig's eye.
const LEAST_DRAWN: f64 = 0.22;

impl Rest {
    /// The middle of a video: medians of all that was seen. None where nothing was.
    pub(crate) fn of(instants: &[Instant]) -> Option<Self> {
        let all = |pick: &dyn Fn(&Seen) -> Option<f64>| {
            let mut values: Vec<f64> = instants.iter().filter_map(|i| pick(i.seen.as_ref()?)).collect();
            values.sort_by(f64::total_cmp);
            values.get(values.len() / 2).copied()
        };
        let place = Point::new(all(&|s| Some(s.measures.place.x))?, all(&|s| Some(s.measures.place.y))?);
        let iris = all(&|s| Some(s.iris?.x)).zip(all(&|s| Some(s.iris?.y)));
        Some(Self {
            place,
            pupils: all(&|s| Some(s.measures.pupils))?,
            roll: all(&|s| Some(s.measures.roll))?,
            iris: iris.map_or(Vec2::ZERO, |(x, y)| Vec2::new(x, y)),
        })
    }

    /// The track of a frame; of a gaze that could not be seen, straight ahead.
    pub(crate) fn track(&self, frame: u32, time: f64, seen: &Seen) -> TrackRow {
        let m = &seen.measures;
        let off = (m.place - self.place) / self.pupils.max(1.0);
        let look = seen.iris.map_or(Vec2::ZERO, |at| at - self.iris);
        let drawn = drawn_opening(&seen.ratios);
        let lid = |open: f64| ((open - CLOSED) / (1.0 - CLOSED) / drawn).clamp(0.0, WIDEST);
        TrackRow {
            frame,
            time,
            gaze: Gaze { x: look.x, y: look.y },
            lids: Lids { left: lid(m.open[0]), right: lid(m.open[1]) },
            mouth: m.mouth,
            head: Head { x: off.x, y: off.y, roll: m.roll - self.roll },
            confidence: seen.confidence,
        }
    }
}

/// How far open the rig draws the eyes of a mix of emotions, 1 as neutral. Lids are divided by it, so that what is drawn,
/// the emotion's opening times the lids', is the video's.
fn drawn_opening(ratios: &Ratios) -> f64 {
    let e = Expression::of(ratios);
    (ABOVE * e.lid_upper + (1.0 - ABOVE) - e.lid_lower).max(LEAST_DRAWN)
}

/// The record and the tracks of a video in which a face was seen at least once.
pub(super) fn gathered(instants: &[Instant], rest: &Rest) -> Tracked {
    let mut tracked = Tracked::default();
    for Instant { frame, time, seen } in instants.iter().copied() {
        let confidence = seen.map_or(0.0, |s| s.confidence);
        let ratios = seen.map_or(Ratios::NEUTRAL, |s| s.ratios);
        tracked.record.rows.push(Row { frame, time, ratios, confidence });
        tracked.tracks.rows.push(seen.map_or_else(|| at_rest(frame, time), |s| rest.track(frame, time, &s)));
    }
    look_over_blinks(instants, &mut tracked.tracks);
    // Lost rows stay out of the smoothing, and are bridged between what comes out of it.
    smooth_record(&mut tracked.record, SMOOTH_WIDTH);
    smooth_tracks(&mut tracked.tracks, SMOOTH_WIDTH);
    bridge_record(&mut tracked.record);
    bridge_tracks(&mut tracked.tracks);
    let lost: Vec<f64> = instants.iter().filter(|i| i.seen.is_none()).map(|i| i.time).collect();
    if !lost.is_empty() {
        let step = step(instants);
        tracked.notes.push(
            format!(
                "the face is lost in {} of {} frames, and bridged there: {}",
                lost.len(),
                instants.len(),
                ranges(&lost, step)
            )
            .into(),
        );
    }
    tracked
}

/// Seconds from a frame to the next.
pub(super) fn step(instants: &[Instant]) -> f64 {
    instants.windows(2).map(|w| w[1].time - w[0].time).fold(f64::INFINITY, f64::min).min(1.0)
}

/// The tracks of a face that nothing is known of.
pub(super) fn at_rest(frame: u32, time: f64) -> TrackRow {
    let (gaze, lids) = (Gaze::default(), Lids::default());
    TrackRow { frame, time, gaze, lids, mouth: MouthMoves::default(), head: Head::default(), confidence: 0.0 }
}

/// While eyes are closed they look from where they looked before to where they look after.
fn look_over_blinks(instants: &[Instant], tracks: &mut Tracks) {
    let rows = &mut tracks.rows;
    let known: Vec<usize> = (0..rows.len()).filter(|n| instants[*n].seen.is_some_and(|s| s.iris.is_some())).collect();
    let mut next = 0;
    for n in 0..rows.len() {
        while known.get(next).is_some_and(|k| *k < n) {
            next += 1;
        }
        if known.get(next) == Some(&n) {
            continue;
        }
        let before = next.checked_sub(1).map(|i| known[i]);
        rows[n].gaze = match (before, known.get(next).copied()) {
            (Some(a), Some(b)) => {
                let t = (rows[n].time - rows[a].time) / (rows[b].time - rows[a].time);
                let (p, q) = (rows[a].gaze, rows[b].gaze);
                Gaze { x: p.x + (q.x - p.x) * t, y: p.y + (q.y - p.y) * t }
            }
            (Some(k), None) | (None, Some(k)) => rows[k].gaze,
            (None, None) => Gaze::default(),
        };
    }
}

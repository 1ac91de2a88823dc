//! A frame of a record: what is written of it, in which order.

use super::channel::Group;
use super::coder::{Coder, Decoder, Encoder};
use super::model::Bit;
use super::{MAX_SECONDS, MAX_VALUE, Moment, near};
use crate::disk::{Fault, Result};
use crate::pose::{Gaze, Head, Lids, Ratios};
use crate::ratios::{MouthMoves, Row, TrackRow};

/// Steps to a unit of each track: gaze, lids, mouth, head.
const GAZE: [f64; 2] = [50.0; 2];
const LIDS: [f64; 2] = [50.0; 2];
const MOUTH: [f64; 4] = [50.0, 50.0, 100.0, 100.0];
const HEAD: [f64; 3] = [200.0, 200.0, 10.0];

/// Everything that was learned of a record so far; the same in the writer and the reader.
#[derive(Debug)]
pub(super) struct State {
    fps: f64,
    with_tracks: bool,
    /// The last frame's number; −1 before the first.
    frame: i64,
    /// The time's distance from the beat, in microseconds.
    late: i64,
    /// The last frame's time.
    time: f64,
    more: Bit,
    gap: [Bit; 15],
    is_late: Bit,
    latter: Bit,
    how_late: [Bit; 15],
    ratios: Group,
    sure: Group,
    has_track: Bit,
    tracks: [Group; 4],
    track_sure: Group,
}

impl State {
    pub(crate) fn new(fps: f64, with_tracks: bool) -> Self {
        Self {
            fps,
            with_tracks,
            frame: -1,
            late: 0,
            time: -1.0,
            more: Bit::NEW,
            gap: [Bit::NEW; 15],
            is_late: Bit::NEW,
            latter: Bit::NEW,
            how_late: [Bit::NEW; 15],
            ratios: Group::new(&[0; 6]),
            sure: Group::new(&[32]),
            has_track: Bit::NEW,
            tracks: [Group::new(&[0; 2]), Group::new(&[50; 2]), Group::new(&[0; 4]), Group::new(&[0; 3])],
            track_sure: Group::new(&[32]),
        }
    }

    pub(crate) fn fps(&self) -> f64 {
        self.fps
    }

    /// The last frame's number; none before the first.
    pub(crate) fn last(&self) -> Option<u32> {
        u32::try_from(self.frame).ok()
    }

    /// Whether a frame can be written here.
    ///
    /// # Errors
    /// When numbers or times do not rise, or something is not finite or absurdly large.
    pub(crate) fn check(&self, moment: &Moment) -> Result<()> {
        let row = &moment.row;
        let fault = |what: String| Err(Fault::new(format!("frame {}: {what}", row.frame)));
        if i64::from(row.frame) <= self.frame {
            return fault(format!("it comes after frame {}", self.frame));
        }
        if !(0.0..=MAX_SECONDS).contains(&row.time) || (row.time * 1e6).round() <= (self.time * 1e6).round() {
            return fault(format!("the time {} comes after {}, or cannot be", row.time, self.time));
        }
        let values = moment.track.map(|t| values_of(&t));
        let all = row.ratios.0.into_iter().chain([row.confidence]).chain(values.into_iter().flatten());
        match all.into_iter().find(|v| !v.is_finite() || v.abs() > MAX_VALUE) {
            Some(value) => fault(format!("the value {value} cannot be")),
            None => Ok(()),
        }
    }

    /// Writes a frame that was [checked](Self::check).
    pub(crate) fn write(&mut self, to: &mut Encoder, moment: &Moment) {
        let row = &moment.row;
        to.whole(&mut self.gap, (i64::from(row.frame) - self.frame - 1).max(0).unsigned_abs());
        let late = (row.time * 1e6).round() as i64 - self.beat(i64::from(row.frame));
        self.code_late(to, late);
        self.frame = i64::from(row.frame);
        self.time = self.time_now();
        let near = near::ratios(&self.ratios, &row.ratios.closed().0);
        self.ratios.code(to, &near);
        let sure = near::confidence(&self.sure, row.confidence);
        self.sure.code(to, &[sure]);
        if !self.with_tracks {
            return;
        }
        to.bit(&mut self.has_track, moment.track.is_some());
        let Some(track) = &moment.track else { return };
        let parts = parts_of(track);
        for (group, (values, steps)) in self.tracks.iter_mut().zip(parts) {
            let aims: Vec<f64> = values.iter().zip(steps).map(|(v, s)| v * s).collect();
            let near = near::others(group, &aims);
            group.code(to, &near);
        }
        let sure = near::confidence(&self.track_sure, track.confidence);
        self.track_sure.code(to, &[sure]);
    }

    /// Reads a frame; none where it cannot be one.
    pub(crate) fn read(&mut self, from: &mut Decoder) -> Option<Moment> {
        let gap = i64::try_from(from.whole(&mut self.gap, 0)).ok()?;
        self.frame = self.frame.checked_add(gap)?.checked_add(1)?;
        let frame = u32::try_from(self.frame).ok()?;
        self.code_late(from, 0);
        let time = self.time_now();
        if !(0.0..=MAX_SECONDS).contains(&time) || time <= self.time {
            return None;
        }
        self.time = time;
        self.ratios.code(from, &[]);
        self.sure.code(from, &[]);
        let values = |group: &Group| -> Vec<i64> { group.channels.iter().map(|c| c.last).collect() };
        let six = values(&self.ratios);
        let most = (100.0 * (MAX_VALUE + 1.0)) as i64;
        if six.iter().any(|v| v.abs() > most) {
            return None;
        }
        let mut ratios = [(100 - six.iter().sum::<i64>()) as f64 / 100.0; 7];
        for (ratio, value) in ratios[1..].iter_mut().zip(&six) {
            *ratio = *value as f64 / 100.0;
        }
        let row = Row { frame, time, ratios: Ratios(ratios), confidence: sure_of(&self.sure)? };
        if !self.with_tracks || !from.bit(&mut self.has_track, false) {
            return Some(Moment { row, track: None });
        }
        let mut all = [0.0; 11];
        let mut at = all.iter_mut();
        for (group, steps) in self.tracks.iter_mut().zip([&GAZE[..], &LIDS, &MOUTH, &HEAD]) {
            group.code(from, &[]);
            for (channel, step) in group.channels.iter().zip(steps) {
                let value = channel.last as f64 / step;
                if value.abs() > MAX_VALUE + 1.0 {
                    return None;
                }
                if let Some(to) = at.next() {
                    *to = value;
                }
            }
        }
        self.track_sure.code(from, &[]);
        let track = TrackRow {
            frame,
            time,
            gaze: Gaze { x: all[0], y: all[1] },
            lids: Lids { left: all[2], right: all[3] },
            mouth: MouthMoves { up: all[4], down: all[5], left: all[6], right: all[7] },
            head: Head { x: all[8], y: all[9], roll: all[10] },
            confidence: sure_of(&self.track_sure)?,
        };
        Some(Moment { row, track: Some(track) })
    }

    /// Whether another frame follows in the packet.
    pub(crate) fn more(&mut self, coder: &mut impl Coder, more: bool) -> bool {
        coder.bit(&mut self.more, more)
    }

    fn beat(&self, frame: i64) -> i64 {
        (frame as f64 / self.fps * 1e6).round() as i64
    }

    fn time_now(&self) -> f64 {
        if self.late == 0 {
            return self.frame as f64 / self.fps;
        }
        self.beat(self.frame).saturating_add(self.late) as f64 / 1e6
    }

    fn code_late(&mut self, coder: &mut impl Coder, late: i64) {
        let change = late.saturating_sub(self.late);
        if coder.bit(&mut self.is_late, change != 0) {
            let down = coder.bit(&mut self.latter, change < 0);
            let size = coder.whole(&mut self.how_late, change.unsigned_abs().saturating_sub(1));
            let size = i64::try_from(size).unwrap_or(i64::MAX).saturating_add(1);
            self.late = self.late.saturating_add(if down { -size } else { size });
        }
    }
}

fn sure_of(group: &Group) -> Option<f64> {
    let value = group.channels.first()?.last;
    (0..=32).contains(&value).then(|| value as f64 / 32.0)
}

/// Values of a track by group, with the steps to a unit of each.
fn parts_of(t: &TrackRow) -> [(Vec<f64>, &'static [f64]); 4] {
    [
        (vec![t.gaze.x, t.gaze.y], &GAZE),
        (vec![t.lids.left, t.lids.right], &LIDS),
        (vec![t.mouth.up, t.mouth.down, t.mouth.left, t.mouth.right], &MOUTH),
        (vec![t.head.x, t.head.y, t.head.roll], &HEAD),
    ]
}

fn values_of(track: &TrackRow) -> Vec<f64> {
    parts_of(track).into_iter().flat_map(|(values, _)| values).chain([track.confidence]).collect()
}

//! The seven ratios over time: the record, the author's range edits in it, her keys over it.

use super::ease::Curve;
use super::{KeyValue, Range, Score};
use crate::pose::{Emotion, Ratios};
use crate::ratios::{Record, smooth_keeping_peaks};

#[derive(Debug, Clone)]
pub(super) struct RatioTrack {
    /// The record after range edits; empty without a record.
    record: Curve<7>,
    /// The author's keys, a curve for every span of them.
    spans: Vec<Curve<7>>,
}

impl RatioTrack {
    pub(super) fn build(record: Option<&Record>, score: &Score) -> Self {
        let edited = record.map(|r| edit(r, &score.ranges)).unwrap_or_default();
        let record = Curve::new(edited.into_iter().map(|(t, r)| (t, r.0, super::Ease::Linear)));
        let mut spans = Vec::new();
        let mut open = Vec::new();
        for key in score.sorted_keys() {
            if let KeyValue::Emotion(ratios) = key.value {
                open.push((key.time, ratios.0, key.ease));
                if key.ends {
                    spans.push(Curve::new(std::mem::take(&mut open)));
                }
            }
        }
        if !open.is_empty() {
            spans.push(Curve::new(open));
        }
        Self { record, spans }
    }

    pub(super) fn at(&self, t: f64) -> Ratios {
        let inside = |s: &&Curve<7>| s.span().is_some_and(|(from, to)| from <= t && t <= to);
        let by_key = self.spans.iter().find(inside).and_then(|s| s.at(t));
        let value = by_key.or_else(|| self.record.at(t)).or_else(|| self.held(t));
        // Interpolating seven numbers one by one may leave their sum, so neutral makes it up; a pair of keys or
        // record rows in a straight line keeps it and is not touched.
        match value.map(Ratios) {
            Some(ratios) if (ratios.sum() - 1.0).abs() > 1e-12 => ratios.closed(),
            Some(ratios) => ratios,
            None => Ratios::NEUTRAL,
        }
    }

    /// Without a record the nearest span's end holds on: there is nothing to return to.
    fn held(&self, t: f64) -> Option<[f64; 7]> {
        let before = self.spans.iter().rev().find(|s| s.span().is_some_and(|(_, to)| to < t));
        before.or_else(|| self.spans.first()).and_then(|s| s.at(t))
    }
}

/// The record's rows after the author's range edits, in the order they were made.
fn edit(record: &Record, ranges: &[Range]) -> Vec<(f64, Ratios)> {
    let times: Vec<f64> = record.rows.iter().map(|r| r.time).collect();
    let mut rows: Vec<Ratios> = record.rows.iter().map(|r| r.ratios).collect();
    for range in ranges {
        let mut changed = rows.clone();
        if range.smooth > 0.0 {
            for e in 0..7 {
                let column: Vec<f64> = rows.iter().map(|r| r.0[e]).collect();
                for (row, v) in changed.iter_mut().zip(smooth_keeping_peaks(&times, &column, range.smooth)) {
                    row.0[e] = v;
                }
            }
        }
        for ((row, changed), t) in rows.iter_mut().zip(changed).zip(&times) {
            let weight = range.weight(*t);
            if weight > 0.0 {
                let mut new = changed;
                for emotion in &Emotion::ALL[1..] {
                    new[*emotion] = changed[*emotion] * range.scale[emotion.index()] + range.offset[emotion.index()];
                }
                // What an emotion gains or loses is neutral's.
                *row = row.lerp(new.closed(), weight);
            }
        }
    }
    times.into_iter().zip(rows).collect()
}

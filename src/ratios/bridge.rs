//! Lost frames bridged: what was not seen goes smoothly from what was seen before to what was seen after.

use super::{MouthMoves, Record, TrackRow, Tracks};
use crate::pose::{Gaze, Head, Lids};

/// Gives lost rows (confidence 0) ratios on a smooth way between the nearest rows that were found: it starts and ends
/// without speed and does not go beyond them. At the ends the first and last found are held. Sums stay 1, and the
/// confidence 0. A record without any found row is left as it is. Returns how many were bridged.
pub(crate) fn bridge_record(record: &mut Record) -> usize {
    let times: Vec<(f64, bool)> = record.rows.iter().map(|r| (r.time, r.confidence > 0.0)).collect();
    let ways = ways(&times);
    for (i, way) in &ways {
        let (from, to) = (record.rows[way.from].ratios, record.rows[way.to].ratios);
        record.rows[*i].ratios = if way.from == way.to { from } else { from.lerp(to, way.share) };
    }
    ways.len()
}

/// Gives lost rows of tracks values as [`bridge_record`] gives ratios.
pub(crate) fn bridge_tracks(tracks: &mut Tracks) -> usize {
    let times: Vec<(f64, bool)> = tracks.rows.iter().map(|r| (r.time, r.confidence > 0.0)).collect();
    let ways = ways(&times);
    for (i, way) in &ways {
        let new = between(&tracks.rows[way.from], &tracks.rows[way.to], way.share);
        let row = &mut tracks.rows[*i];
        *row = TrackRow { frame: row.frame, time: row.time, confidence: row.confidence, ..new };
    }
    ways.len()
}

/// Between which rows a lost one lies, and how far on the way.
struct Way {
    from: usize,
    to: usize,
    share: f64,
}

fn ways(rows: &[(f64, bool)]) -> Vec<(usize, Way)> {
    let mut before = None;
    let mut after = 0;
    let mut ways = Vec::new();
    for (i, (time, found)) in rows.iter().enumerate() {
        if *found {
            before = Some(i);
            continue;
        }
        after = after.max(i);
        while after < rows.len() && !rows[after].1 {
            after += 1;
        }
        let next = (after < rows.len()).then_some(after);
        let Some((from, to)) = before.or(next).zip(next.or(before)) else { return Vec::new() };
        let t = if from == to { 0.0 } else { (time - rows[from].0) / (rows[to].0 - rows[from].0) };
        ways.push((i, Way { from, to, share: t * t * (3.0 - 2.0 * t) }));
    }
    ways
}

fn between(a: &TrackRow, b: &TrackRow, t: f64) -> TrackRow {
    let on = |a: f64, b: f64| if a == b { a } else { a + (b - a) * t };
    TrackRow {
        gaze: Gaze { x: on(a.gaze.x, b.gaze.x), y: on(a.gaze.y, b.gaze.y) },
        lids: Lids { left: on(a.lids.left, b.lids.left), right: on(a.lids.right, b.lids.right) },
        mouth: MouthMoves {
            up: on(a.mouth.up, b.mouth.up),
            down: on(a.mouth.down, b.mouth.down),
            left: on(a.mouth.left, b.mouth.left),
            right: on(a.mouth.right, b.mouth.right),
        },
        head: Head { x: on(a.head.x, b.head.x), y: on(a.head.y, b.head.y), roll: on(a.head.roll, b.head.roll) },
        ..*a
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pose::{Emotion, Ratios};
    use crate::ratios::Row;

    #[test]
    fn lost_rows_go_smoothly_from_the_last_found_to_the_next_and_the_ends_hold() {
        let confidences = [0.0, 1.0, 0.0, 0.0, 0.0, 0.8, 0.0];
        let row = |(i, confidence): (usize, &f64)| Row {
            frame: i as u32,
            time: i as f64,
            ratios: if i == 5 { Ratios::pure(Emotion::Fear) } else { Ratios::NEUTRAL },
            confidence: *confidence,
        };
        let mut record = Record { rows: confidences.iter().enumerate().map(row).collect() };
        assert_eq!(bridge_record(&mut record), 5);
        let fear: Vec<f64> = record.rows.iter().map(|r| r.ratios[Emotion::Fear]).collect();
        assert_eq!((fear[0], fear[1], fear[5], fear[6]), (0.0, 0.0, 1.0, 1.0));
        assert!((fear[2] - 0.156_25).abs() < 1e-12 && (fear[3] - 0.5).abs() < 1e-12 && fear[4] < 1.0, "{fear:?}");
        for (row, confidence) in record.rows.iter().zip(confidences) {
            assert!((row.ratios.sum() - 1.0).abs() < 1e-12 && row.confidence == confidence);
        }
        let mut none = Record { rows: record.rows.iter().map(|r| Row { confidence: 0.0, ..*r }).collect() };
        assert_eq!(bridge_record(&mut none), 0);
    }
}

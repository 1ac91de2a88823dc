//! The seven ratios of every frame of a clip, as the record that `convert` writes and as the compact one.

use std::path::Path;

use super::File;
use crate::disk::Result;
use crate::project::Clip;
use crate::ratios::{MouthMoves, Record, Row, TrackRow, Tracks, to_lpr};
use crate::timeline::Timeline;

/// What the score gives at every frame: the author's keys and edits are in it.
fn record(clip: &Clip, timeline: &Timeline) -> Record {
    let row = |frame: u32| {
        let time = timeline.time_of(frame);
        let confidence = clip.record.as_ref().and_then(|r| r.at(time)).map_or(1.0, |(_, sure)| sure);
        Row { frame, time, ratios: timeline.ratios(time), confidence }
    };
    Record { rows: (0..timeline.frames()).map(row).collect() }
}

/// CSV and JSON.
pub(crate) fn tables(clip: &Clip, timeline: &Timeline, base: &Path) -> Vec<File> {
    let record = record(clip, timeline);
    vec![
        File { path: super::with_ending(base, "ratios.csv"), bytes: record.to_csv().into_bytes() },
        File { path: super::with_ending(base, "ratios.json"), bytes: record.to_json().into_bytes() },
    ]
}

/// The compact record, with eyes, mouth and head.
///
/// # Errors
/// When a value in it cannot be.
pub(crate) fn compact(clip: &Clip, timeline: &Timeline, base: &Path) -> Result<Vec<File>> {
    let record = record(clip, timeline);
    let track = |row: &Row| {
        let pose = timeline.pose(row.time);
        let mouth = MouthMoves {
            up: -pose.mouth.upper,
            down: pose.mouth.lower,
            left: -pose.mouth.corner_in,
            right: -pose.mouth.corner_in,
        };
        TrackRow {
            frame: row.frame,
            time: row.time,
            gaze: pose.gaze,
            lids: pose.lids,
            mouth,
            head: pose.head,
            confidence: row.confidence,
        }
    };
    let tracks = Tracks { rows: record.rows.iter().map(track).collect() };
    let bytes = to_lpr(&record, Some(&tracks), timeline.fps())?;
    Ok(vec![File { path: super::with_ending(base, "lpr"), bytes }])
}

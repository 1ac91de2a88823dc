//! What tracking found beside the ratios: gaze, lids, mouth and head of every frame (`tracks.csv`).

use super::table::{self, Line, decimal};
use crate::disk::Result;
use crate::pose::{Gaze, Head, Lids};

const COLUMNS: [&str; 14] = [
    "frame",
    "time",
    "gaze_x",
    "gaze_y",
    "lid_left",
    "lid_right",
    "mouth_up",
    "mouth_down",
    "mouth_left",
    "mouth_right",
    "head_x",
    "head_y",
    "head_roll",
    "confidence",
];

/// How far the four ends of the mouth are from where the neutral face has them.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MouthMoves {
    /// The upper lip, in MNS0.
    pub up: f64,
    /// The lower lip, in MNS0.
    pub down: f64,
    /// The corner at the image's left, in MW0.
    pub left: f64,
    /// The corner at the image's right, in MW0.
    pub right: f64,
}

/// One frame of the tracks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrackRow {
    /// The frame's number in its source, from 0.
    pub frame: u32,
    /// When it is shown, in seconds.
    pub time: f64,
    /// Where the eyes look, in eye heights.
    pub gaze: Gaze,
    /// How far each eye is open, 1 open to 0 closed.
    pub lids: Lids,
    /// Where the mouth is.
    pub mouth: MouthMoves,
    /// Where the head is, in pupil distances and degrees.
    pub head: Head,
    /// How sure it is, 0 to 1; 0 is a lost frame, whose values are bridged.
    pub confidence: f64,
}

/// The tracks of every frame, by rising time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Tracks {
    /// The frames; their numbers and times rise.
    pub rows: Vec<TrackRow>,
}

impl Tracks {
    /// Whether a CSV text begins like these tracks.
    #[must_use]
    pub fn is_header(text: &str) -> bool {
        let header = text.lines().find(|l| !l.trim().is_empty()).unwrap_or_default();
        header.contains("gaze_x") && header.contains("lid_left")
    }

    /// Reads `tracks.csv`. Columns may stand in any order; others beside them are passed over.
    ///
    /// # Errors
    /// With the line: a column missing, a value that is no finite number, frames or times that do not rise, lids
    /// outside 0 to 2 or a confidence outside 0 to 1, no rows.
    pub(crate) fn parse(text: &str) -> Result<Self> {
        let row = |line: &Line| {
            for (at, most) in [(4, 2.0), (5, 2.0), (13, 1.0)] {
                if !(0.0..=most).contains(&line.cells[at]) {
                    let what = format!("`{}` in the column `{}` cannot be", line.cells[at], COLUMNS[at]);
                    return Err(line.place.fault(what).help(format!("it lies between 0 and {most}")));
                }
            }
            let c = &line.cells;
            Ok(TrackRow {
                frame: line.frame(),
                time: line.time(),
                gaze: Gaze { x: c[2], y: c[3] },
                lids: Lids { left: c[4], right: c[5] },
                mouth: MouthMoves { up: c[6], down: c[7], left: c[8], right: c[9] },
                head: Head { x: c[10], y: c[11], roll: c[12] },
                confidence: c[13],
            })
        };
        Ok(Self { rows: table::from_csv(text, &COLUMNS)?.iter().map(row).collect::<Result<_>>()? })
    }

    /// The tracks as `tracks.csv`, with at most 6 decimals.
    #[must_use]
    pub fn to_csv(&self) -> String {
        let mut text = COLUMNS.join(",");
        text.push('\n');
        for row in &self.rows {
            let (g, l, m, h) = (row.gaze, row.lids, row.mouth, row.head);
            let values =
                [row.time, g.x, g.y, l.left, l.right, m.up, m.down, m.left, m.right, h.x, h.y, h.roll, row.confidence];
            text.push_str(&row.frame.to_string());
            for value in values {
                text.push(',');
                text.push_str(&decimal(value, 6));
            }
            text.push('\n');
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tracks_read_back_as_they_were_written() {
        let row = |frame: u32| TrackRow {
            frame,
            time: f64::from(frame) * 0.04,
            gaze: Gaze { x: -0.125, y: 0.5 },
            lids: Lids { left: 1.0, right: 0.031_25 },
            mouth: MouthMoves { up: -0.2, down: 0.7, left: 0.0, right: 0.01 },
            head: Head { x: 0.1, y: -0.2, roll: -12.5 },
            confidence: 0.75,
        };
        let tracks = Tracks { rows: vec![row(3), row(4)] };
        assert_eq!(Tracks::parse(&tracks.to_csv()).unwrap(), tracks);
        assert!(Tracks::is_header(&tracks.to_csv()));
    }

    #[test]
    fn a_lid_that_cannot_be_is_refused_with_its_line() {
        let text = format!("{}\n0,0,0,0,-1,1,0,0,0,0,0,0,0,1\n", COLUMNS.join(","));
        let fault = Tracks::parse(&text).unwrap_err();
        assert_eq!(fault.line_number(), Some(2));
        assert!(fault.what().contains("lid_left"), "{fault}");
    }
}

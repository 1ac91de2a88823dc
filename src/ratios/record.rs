//! The ratio record: the seven ratios of every frame (`ratios.csv`).

use std::fmt::Write;

use super::table::{self, Line, decimal};
use crate::disk::Result;
use crate::pose::{Emotion, Ratios};

const COLUMNS: [&str; 10] =
    ["frame", "time", "neutral", "happy", "anger", "disgust", "sadness", "fear", "surprised", "confidence"];

/// How far the sum of a row that is read may be from 1: six printed digits, and no more.
const SUM_TOLERANCE: f64 = 1e-6;

/// Ratios are written in whole billionths, so that the printed seven sum to exactly 1.
const UNIT: f64 = 1e9;

/// One frame of a record.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// The frame's number in its source, from 0.
    pub frame: u32,
    /// When it is shown, in seconds.
    pub time: f64,
    /// What was found; bridged from the frames around where the face was lost.
    pub ratios: Ratios,
    /// How sure it is, 0 to 1; 0 is a lost frame.
    pub confidence: f64,
}

/// The ratios of every frame, by rising time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Record {
    /// The frames; their numbers and times rise.
    pub rows: Vec<Row>,
}

impl Record {
    /// Whether a CSV text begins like a ratio record rather than another table: how a file is told by its content.
    #[must_use]
    pub fn is_header(text: &str) -> bool {
        let header = text.lines().find(|l| !l.trim().is_empty()).unwrap_or_default().to_lowercase();
        Emotion::ALL.iter().filter(|e| header.contains(e.name())).count() >= 4
    }

    /// Reads `ratios.csv`. Columns may stand in any order; others beside them are passed over.
    ///
    /// # Errors
    /// With the line: a column missing, a value that is no finite number, frames or times that do not rise, a
    /// confidence outside 0 to 1, ratios whose sum is off 1 by more than 1e-6, no rows.
    pub fn parse(text: &str) -> Result<Self> {
        Self::from_lines(&table::from_csv(text, &COLUMNS)?)
    }

    /// Reads a JSON array of objects with the columns of the CSV as keys.
    ///
    /// # Errors
    /// As [`Self::parse`], with the entry's number in place of a line.
    pub(crate) fn parse_json(text: &str) -> Result<Self> {
        Self::from_lines(&table::from_json(text, &COLUMNS)?)
    }

    fn from_lines(lines: &[Line]) -> Result<Self> {
        let row = |line: &Line| {
            let ratios = Ratios(std::array::from_fn(|i| line.cells[2 + i]));
            let confidence = line.cells[9];
            let off = ratios.sum() - 1.0;
            if off.abs() > SUM_TOLERANCE {
                let what = format!("the seven ratios sum to {}", decimal(ratios.sum(), 9));
                return Err(line.place.fault(what).help("they must sum to 1, within 0.000001"));
            }
            if !(0.0..=1.0).contains(&confidence) {
                let what = format!("the confidence `{confidence}` cannot be");
                return Err(line.place.fault(what).help("it lies between 0 (lost) and 1 (sure)"));
            }
            Ok(Row { frame: line.frame(), time: line.time(), ratios, confidence })
        };
        Ok(Self { rows: lines.iter().map(row).collect::<Result<_>>()? })
    }

    /// The record as `ratios.csv`. Times have at most 6 decimals, ratios at most 9; the largest takes up what
    /// rounding leaves, so that every row sums to 1 as printed.
    #[must_use]
    pub fn to_csv(&self) -> String {
        let mut text = COLUMNS.join(",");
        text.push('\n');
        for row in &self.rows {
            text.push_str(&cells(row).join(","));
            text.push('\n');
        }
        text
    }

    /// The record as a JSON array, one frame a line, with the digits of the CSV.
    #[must_use]
    pub(crate) fn to_json(&self) -> String {
        let mut text = String::from("[");
        for (index, row) in self.rows.iter().enumerate() {
            text.push_str(if index == 0 { "\n" } else { ",\n" });
            let pairs = COLUMNS.iter().zip(cells(row)).map(|(name, value)| format!("\"{name}\":{value}"));
            // Writing to a string cannot fail.
            let _ = write!(text, "  {{{}}}", pairs.collect::<Vec<_>>().join(","));
        }
        text.push_str("\n]\n");
        text
    }

    /// The ratios and the confidence at a time in seconds: on the straight line between the two frames around it,
    /// the first and last frames held outside. Nothing where there are no frames.
    #[must_use]
    pub(crate) fn at(&self, time: f64) -> Option<(Ratios, f64)> {
        let after = self.rows.partition_point(|row| row.time <= time);
        let Some(before) = after.checked_sub(1).map(|i| &self.rows[i]) else {
            return self.rows.first().map(|row| (row.ratios, row.confidence));
        };
        let Some(next) = self.rows.get(after) else {
            return Some((before.ratios, before.confidence));
        };
        let t = (time - before.time) / (next.time - before.time);
        Some((before.ratios.lerp(next.ratios, t), before.confidence + (next.confidence - before.confidence) * t))
    }

    /// Frames a second: the usual rate that all its times keep to, within the microsecond that they are written in; else
    /// what they are on average, and 25 for a single frame.
    #[must_use]
    pub fn fps(&self) -> f64 {
        const USUAL: [f64; 13] = [
            25.0,
            30.0,
            24.0,
            30_000.0 / 1001.0,
            24_000.0 / 1001.0,
            50.0,
            60.0,
            60_000.0 / 1001.0,
            12.0,
            15.0,
            10.0,
            48.0,
            120.0,
        ];
        let (Some(first), Some(last)) = (self.rows.first(), self.rows.last()) else { return USUAL[0] };
        if last.frame == first.frame {
            return USUAL[0];
        }
        let keeps = |fps: &&f64| {
            let off = |row: &Row| row.time - first.time - f64::from(row.frame - first.frame) / **fps;
            self.rows.iter().all(|row| off(row).abs() < 1.6e-6)
        };
        let mean = f64::from(last.frame - first.frame) / (last.time - first.time);
        USUAL.iter().find(keeps).copied().unwrap_or(mean)
    }

    /// How long the record lasts, in seconds: to the end of its last frame, a frame being as long as they are on
    /// average. A single frame ends when it begins, because its length is not known.
    #[must_use]
    pub(crate) fn duration(&self) -> f64 {
        match (self.rows.first(), self.rows.last()) {
            (Some(first), Some(last)) if last.frame > first.frame => {
                last.time + (last.time - first.time) / f64::from(last.frame - first.frame)
            }
            (_, last) => last.map_or(0.0, |row| row.time),
        }
    }
}

/// The printed values of a row, in the order of the columns.
fn cells(row: &Row) -> [String; 10] {
    let mut units = row.ratios.0.map(|ratio| (ratio * UNIT).round() as i64);
    // The largest takes up what rounding leaves.
    let largest = (0..7).max_by_key(|i| units[*i]).unwrap_or(0);
    units[largest] += UNIT as i64 - units.iter().sum::<i64>();
    let mut cells: [String; 10] = std::array::from_fn(|_| String::new());
    cells[0] = row.frame.to_string();
    cells[1] = decimal(row.time, 6);
    for (cell, units) in cells[2..9].iter_mut().zip(units) {
        *cell = billionths(units);
    }
    cells[9] = decimal(row.confidence, 6);
    cells
}

/// A whole number of billionths as a decimal number: no sum of these is rounded on the way to paper.
fn billionths(units: i64) -> String {
    let (whole, part) = (units.unsigned_abs() / 1_000_000_000, units.unsigned_abs() % 1_000_000_000);
    let text = format!("{}{whole}.{part:09}", if units < 0 { "-" } else { "" });
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(rows: &[(u32, f64, Ratios)]) -> Record {
        let row = |&(frame, time, ratios)| Row { frame, time, ratios, confidence: 1.0 };
        Record { rows: rows.iter().map(row).collect() }
    }

    fn smile() -> Record {
        let third = Ratios([0.0, 1.0 / 3.0, 1.0 / 7.0, -0.123_456_789_123, 0.0, 1e-12, 0.2]).closed();
        record(&[(0, 0.0, Ratios::NEUTRAL), (1, 1.0 / 30.0, third), (2, 2.0 / 30.0, Ratios::pure(Emotion::Fear))])
    }

    #[test]
    fn what_is_written_reads_back_within_a_billionth_and_every_printed_row_sums_to_one() {
        let csv = smile().to_csv();
        for back in [Record::parse(&csv).unwrap(), Record::parse_json(&smile().to_json()).unwrap()] {
            for (row, old) in back.rows.iter().zip(&smile().rows) {
                assert!((row.ratios.sum() - 1.0).abs() < 1e-12);
                assert!((0..7).all(|i| (row.ratios.0[i] - old.ratios.0[i]).abs() < 4e-9));
                assert!((row.time - old.time).abs() < 1e-6);
            }
            assert_eq!(back.to_csv(), csv, "a second writing changes nothing");
        }
    }

    #[test]
    fn between_frames_ratios_lie_on_a_line_and_outside_the_ends_hold() {
        let record = record(&[(0, 1.0, Ratios::NEUTRAL), (1, 2.0, Ratios::pure(Emotion::Happy))]);
        assert_eq!(record.at(1.25), Some((Ratios::some(Emotion::Happy, 0.25), 1.0)));
        assert_eq!(record.at(-1.0), Some((Ratios::NEUTRAL, 1.0)));
        assert_eq!(record.at(9.0), Some((Ratios::pure(Emotion::Happy), 1.0)));
        assert_eq!(record.duration(), 3.0);
        assert_eq!(Record::default().at(0.0), None);
    }

    #[test]
    fn every_fault_names_its_line_and_what_was_found() {
        let header = COLUMNS.join(",");
        let good = "0,0,1,0,0,0,0,0,0,1";
        for (text, line, found) in [
            (String::new(), None, "empty"),
            (header.clone(), None, "no rows"),
            (header.replace("surprised", "suprised"), Some(1), "`surprised` is missing"),
            (format!("{header}\n{good}\n1,0.04,nan,0,0,0,0,0,0,1"), Some(3), "`nan` in the column `neutral`"),
            (format!("{header}\n{good}\n1,0.04,1,inf,0,0,0,0,0,1"), Some(3), "`inf` in the column `happy`"),
            (format!("{header}\n{good}\n1,0,1,0,0,0,0,0,0,1"), Some(3), "time 0 comes after 0"),
            (format!("{header}\n{good}\n0,1,1,0,0,0,0,0,0,1"), Some(3), "frame 0 comes after"),
            (format!("{header}\n{good}\n\n1,1,1,0.5,0,0,0,0,0,1"), Some(4), "sum to 1.5"),
            (format!("{header}\n{good}\n1,1,1,0,0,0,0,0,0,2"), Some(3), "confidence `2`"),
            (format!("{header}\n{good}\n1,1,1,0,0"), Some(3), "5 values"),
            (format!("{header}\n-1,0,1,0,0,0,0,0,0,1"), Some(2), "no frame"),
            (format!("{header}\n0,-1,1,0,0,0,0,0,0,1"), Some(2), "time `-1`"),
            (format!("{header}\n0,0,1e300,0,0,0,0,0,0,1"), Some(2), "cannot be"),
        ] {
            let fault = Record::parse(&text).unwrap_err();
            assert_eq!(fault.line_number(), line, "{fault}");
            assert!(fault.what().contains(found), "{fault}");
        }
        let misspelt = Record::parse(&header.replace("surprised", "suprised")).unwrap_err();
        assert!(misspelt.next_step().contains("`suprised`"), "{misspelt}");
        let json = r#"[{"frame":0,"time":0,"neutrl":1}]"#;
        let fault = Record::parse_json(json).unwrap_err();
        assert!(fault.to_string().contains("entry 1") && fault.next_step().contains("neutrl"), "{fault}");
    }

    #[test]
    fn columns_are_found_by_name_in_any_order_and_windows_line_ends_are_fine() {
        let text = "\u{FEFF}time,frame,note,neutral,happy,anger,disgust,sadness,fear,surprised,confidence\r\n\
                    0.5,7,x,1,0,0,0,0,0,0,0\r\n";
        let row = Record::parse(text).unwrap().rows[0];
        assert_eq!((row.frame, row.time, row.confidence), (7, 0.5, 0.0));
        assert!(Record::is_header(text));
    }
}

//! Blendshapes as CSV: what Live Link Face and other apps on ARKit record.

use super::blendshapes::{is_known, plain};
use super::csv;
use super::frame::Seen;
use crate::disk::{CsvTable, Fault, FileFault, Result};
use crate::pose::Head;

/// Whether a CSV's heading is one of blendshapes.
pub(super) fn is_header(names: &[String]) -> bool {
    names.iter().filter(|n| is_known(n)).count() >= 10
}

/// Frames of a table of blendshapes: `Timecode` (hours:minutes:seconds:frames, with a fraction of a frame) or a column of seconds, the
/// blendshapes under any of their names, and the head's turns in radians (`HeadRoll`) where there are any. A row without
/// values, or whose `BlendshapeCount` is 0, is a lost frame.
pub(super) fn read(text: &str) -> Result<Vec<Seen>> {
    let table = csv::read(text)?;
    let shapes: Vec<(usize, String)> = table
        .names
        .iter()
        .enumerate()
        .filter(|(_, n)| is_known(n) || plain(n).starts_with("mouth"))
        .map(|(i, n)| (i, plain(n)))
        .collect();
    let times = times(&table)?;
    let (count, roll) = (table.column("BlendshapeCount"), table.column("HeadRoll"));
    let mut frames: Vec<Seen> = Vec::new();
    for (row, time) in table.rows.iter().zip(times) {
        let mut seen = Seen { time, confidence: 1.0, ..Seen::default() };
        for (column, name) in &shapes {
            if let Some(value) = csv::number(&table, row, *column)? {
                seen.shapes.insert(name.clone(), value.clamp(0.0, 1.0));
            }
        }
        if let Some(roll) = roll.map(|c| csv::number(&table, row, c)).transpose()?.flatten() {
            seen.head = Some(Head { roll: roll.to_degrees(), ..Head::default() });
        }
        let none = count.map(|c| csv::number(&table, row, c)).transpose()?.flatten() == Some(0.0);
        if none || seen.shapes.is_empty() {
            seen.confidence = 0.0;
        }
        // Apps write a frame twice when they fall behind.
        if frames.last().is_none_or(|f| time - f.time > 1e-6) {
            seen.frame = frames.len() as u32;
            frames.push(seen);
        }
    }
    Ok(frames)
}

/// Seconds from the first row.
fn times(table: &CsvTable) -> Result<Vec<f64>> {
    let no_time = || {
        Fault::of(FileFault::Missing, "the table of blendshapes has no time")
            .line(1)
            .help("it needs a column `Timecode`, `timestamp` or `time`")
    };
    if let Some(column) = table.column("Timecode")
        && table.rows.first().is_some_and(|row| row.cell(column).contains(':'))
    {
        let mut codes = Vec::with_capacity(table.rows.len());
        for row in &table.rows {
            let parts: Option<Vec<f64>> = row.cell(column).split([':', ';']).map(|p| p.parse().ok()).collect();
            let parts = parts.filter(|p| p.len() == 4 && p.iter().all(|v| (0.0..1e6).contains(v)));
            codes.push(parts.ok_or_else(|| {
                Fault::new(format!("`{}` is no timecode", row.cell(column)))
                    .line(row.line)
                    .help("write it as 14:26:42:37.254")
            })?);
        }
        // Phones record 60 frames a second or 30; a frame's number above 30 tells.
        let fps = if codes.iter().any(|c| c[3] >= 30.5) { 60.0 } else { 30.0 };
        let seconds = codes.iter().map(|c| (c[0] * 60.0 + c[1]) * 60.0 + c[2] + c[3] / fps);
        return Ok(from_first(seconds.collect()));
    }
    let column =
        ["timestamp", "time", "timecode", "seconds", "t"].iter().find_map(|n| table.column(n)).ok_or_else(no_time)?;
    let mut times = Vec::with_capacity(table.rows.len());
    for row in &table.rows {
        times.push(csv::number(table, row, column)?.ok_or_else(|| no_time().line(row.line))?);
    }
    Ok(in_seconds(times))
}

/// Times from the first one, in seconds: a step of more than two is one in milliseconds, of more than two thousand one
/// in microseconds.
pub(super) fn in_seconds(times: Vec<f64>) -> Vec<f64> {
    let step = super::frame::median(times.windows(2).map(|w| w[1] - w[0]).collect());
    let unit = if step > 2e3 {
        1e6
    } else if step > 2.0 {
        1e3
    } else {
        1.0
    };
    from_first(times.into_iter().map(|t| t / unit).collect())
}

fn from_first(times: Vec<f64>) -> Vec<f64> {
    let first = times.first().copied().unwrap_or(0.0);
    // A clock that passes midnight goes on.
    times.into_iter().map(|t| if t < first { t + 86_400.0 - first } else { t - first }).collect()
}

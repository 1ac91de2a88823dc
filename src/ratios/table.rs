//! Tables of numbers whose first two columns are a frame and its time: reading them from CSV or JSON with faults that
//! name the line, the column and what is allowed. What the other columns mean is not known here.

use serde_json::{Map, Value};

use crate::disk::{CsvTable, Fault, FileFault, Result, nearest};

/// The latest time a row may have, in seconds: 100 hours, far beyond any lesson.
const MAX_SECONDS: f64 = 360_000.0;

/// The largest value of any other column. Ratios and moves are near 1, head angles within 360.
const MAX_VALUE: f64 = 1_000.0;

/// One row: the numbers in the order of the columns asked for, and where they stand.
pub(super) struct Line {
    pub place: Place,
    pub cells: Vec<f64>,
}

impl Line {
    /// The frame number; [`checked`] has made sure that it is one.
    pub(crate) fn frame(&self) -> u32 {
        self.cells[0] as u32
    }

    /// The time in seconds.
    pub(crate) fn time(&self) -> f64 {
        self.cells[1]
    }
}

/// Where a row stands: a line of a CSV file, or an entry of a JSON array, whose lines serde does not tell.
#[derive(Clone, Copy)]
pub(super) enum Place {
    Line(usize),
    Entry(usize),
}

impl Place {
    pub(crate) fn fault(self, what: impl Into<String>) -> Fault {
        match self {
            Self::Line(line) => Fault::new(what).line(line),
            Self::Entry(entry) => Fault::new(format!("entry {entry}: {}", what.into())),
        }
    }
}

/// The rows of a CSV file. Columns may stand in any order and others may stand beside them.
pub(super) fn from_csv(text: &str, columns: &[&str]) -> Result<Vec<Line>> {
    let table = CsvTable::read(text)?;
    let names: Vec<&str> = table.names.iter().map(String::as_str).collect();
    if names.is_empty() {
        return Err(Fault::of(FileFault::Empty, "the file is empty")
            .help(format!("its first line must be `{}`", columns.join(","))));
    }
    let places = columns
        .iter()
        .map(|column| {
            let at = names.iter().position(|name| name == column);
            at.ok_or_else(|| missing(column, &names, columns).line(table.line))
        })
        .collect::<Result<Vec<usize>>>()?;
    let mut rows = Vec::new();
    for row in &table.rows {
        let place = Place::Line(row.line);
        if row.len() != names.len() {
            return Err(place
                .fault(format!("the row has {} values where the header names {}", row.len(), names.len()))
                .help("was the file cut off, or a comma used inside a number?"));
        }
        let numbers = places.iter().zip(columns).map(|(&at, column)| {
            let number = row.cell(at).parse::<f64>().ok().filter(|v| v.is_finite());
            number.ok_or_else(|| no_number(place, row.cell(at), column))
        });
        rows.push(Line { place, cells: numbers.collect::<Result<_>>()? });
    }
    checked(rows, columns)
}

/// The rows of a JSON array of objects, whose keys are the columns.
pub(super) fn from_json(text: &str, columns: &[&str]) -> Result<Vec<Line>> {
    let entries: Vec<Map<String, Value>> = serde_json::from_str(text).map_err(|error| {
        Fault::new(format!("not an array of objects in JSON: {error}"))
            .line(error.line())
            .help(format!("each object has the keys {}", columns.join(", ")))
    })?;
    let mut rows = Vec::new();
    for (index, entry) in entries.iter().enumerate() {
        let place = Place::Entry(index + 1);
        let numbers = columns.iter().map(|column| match entry.get(*column) {
            Some(value) => value.as_f64().ok_or_else(|| no_number(place, &value.to_string(), column)),
            None => {
                let names: Vec<&str> = entry.keys().map(String::as_str).collect();
                let fault = missing(column, &names, columns);
                Err(place.fault(fault.what()).help(fault.advice()))
            }
        });
        rows.push(Line { place, cells: numbers.collect::<Result<_>>()? });
    }
    checked(rows, columns)
}

/// What holds for every such table: there are rows, frames are whole and rise, times rise, and nothing is absurd.
fn checked(rows: Vec<Line>, columns: &[&str]) -> Result<Vec<Line>> {
    if rows.is_empty() {
        return Err(Fault::of(FileFault::Empty, "the file has no rows")
            .help("there is nothing to read: was it written to the end?"));
    }
    for row in &rows {
        let (frame, time) = (row.cells[0], row.cells[1]);
        if frame.fract() != 0.0 || !(0.0..=f64::from(u32::MAX)).contains(&frame) {
            return Err(row.place.fault(format!("`{frame}` is no frame")).help("frames are whole and count from 0"));
        }
        if !(0.0..=MAX_SECONDS).contains(&time) {
            let help = format!("times are seconds from 0 to {MAX_SECONDS}");
            return Err(row.place.fault(format!("the time `{time}` cannot be")).help(help));
        }
        if let Some(at) = (2..columns.len()).find(|&at| row.cells[at].abs() > MAX_VALUE) {
            return Err(row
                .place
                .fault(format!("`{}` in the column `{}` cannot be", row.cells[at], columns[at]))
                .help(format!("values lie between -{MAX_VALUE} and {MAX_VALUE}")));
        }
    }
    for pair in rows.windows(2) {
        let (before, row) = (&pair[0], &pair[1]);
        if row.frame() <= before.frame() {
            let what = format!("frame {} comes after frame {}", row.frame(), before.frame());
            return Err(row.place.fault(what).help("frames must rise from row to row"));
        }
        // Compared as they are written, so that what was read can be saved and read again.
        if (row.time() * 1e6).round() <= (before.time() * 1e6).round() {
            let what = format!("the time {} comes after {}", row.time(), before.time());
            return Err(row.place.fault(what).help("times must rise from row to row, by a microsecond or more"));
        }
    }
    Ok(rows)
}

/// A number with at most `places` decimals, no zeros at its end, and no minus before a zero.
pub fn decimal(value: f64, places: i32) -> String {
    let scale = 10f64.powi(places);
    let rounded = (value * scale).round() / scale;
    format!("{}", if rounded == 0.0 { 0.0 } else { rounded })
}

fn no_number(place: Place, found: &str, column: &str) -> Fault {
    place
        .fault(format!("`{found}` in the column `{column}` is no finite number"))
        .help("write it with digits and a point, such as 0.25")
}

/// The fault of a column that is not there, with the name that was probably meant.
fn missing(column: &str, names: &[&str], columns: &[&str]) -> Fault {
    let others: Vec<&str> = names.iter().copied().filter(|name| !columns.contains(name)).collect();
    let in_capitals = others.iter().copied().find(|name| name.eq_ignore_ascii_case(column));
    let fault = Fault::of(FileFault::Missing, format!("the column `{column}` is missing"));
    match in_capitals.or_else(|| nearest(column, &others)) {
        Some(name) => fault.help(format!("is `{name}` meant to be it?")),
        None => fault.help(format!("the columns are {}", columns.join(","))),
    }
}

//! Tables of other programs: a heading, and rows of numbers of which some may be missing.

use crate::disk::{Fault, Result};

/// A table with its columns' names, trimmed.
pub(super) struct Table<'a> {
    pub names: Vec<&'a str>,
    /// Each with its line, counted from 1.
    pub rows: Vec<(usize, Vec<&'a str>)>,
}

impl<'a> Table<'a> {
    /// Reads a table whose cells have no commas of their own. The last row may have been cut off while it was written, and
    /// is then left out.
    pub fn read(text: &'a str) -> Result<Self> {
        let mut lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
        let cells = |line: &'a str| line.split(',').map(|c| c.trim().trim_matches('"')).collect::<Vec<_>>();
        let names = lines.next().map(|(_, line)| cells(line)).unwrap_or_default();
        let mut rows: Vec<(usize, Vec<&str>)> = lines.map(|(i, line)| (i + 1, cells(line))).collect();
        if rows.last().is_some_and(|(_, row)| row.len() < names.len()) {
            rows.pop();
        }
        if let Some((line, row)) = rows.iter().find(|(_, row)| row.len() != names.len()) {
            let what = format!("the row has {} values where the header names {}", row.len(), names.len());
            return Err(Fault::new(what).line(*line));
        }
        if rows.is_empty() {
            return Err(Fault::new("the file has no rows").help("there is nothing to read: was it written to the end?"));
        }
        Ok(Self { names, rows })
    }

    /// Where a column is, whatever its capitals.
    pub fn column(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|n| n.eq_ignore_ascii_case(name))
    }

    /// The number in a column of a row; none where the cell is empty.
    pub fn number(&self, row: &(usize, Vec<&str>), column: usize) -> Result<Option<f64>> {
        let cell = row.1.get(column).copied().unwrap_or_default();
        if cell.is_empty() {
            return Ok(None);
        }
        match cell.parse::<f64>() {
            // Some write "nan" where no face was found.
            Ok(value) if value.is_nan() => Ok(None),
            Ok(value) if value.abs() < 1e9 => Ok(Some(value)),
            _ => {
                let name = self.names.get(column).copied().unwrap_or_default();
                Err(Fault::new(format!("`{cell}` in the column `{name}` is no number that can be")).line(row.0))
            }
        }
    }
}

//! Tables of other programs: a heading, and rows of numbers of which some may be missing.

use crate::disk::{CsvRow, CsvTable, Fault, FileFault, Result};

/// Reads a table whose rows are as wide as its heading. The last row may have been cut off while it was written, and is
/// then left out.
pub(super) fn read(text: &str) -> Result<CsvTable> {
    let mut table = CsvTable::read(text)?;
    let width = table.names.len();
    table.rows.pop_if(|row| row.len() < width);
    if let Some(row) = table.rows.iter().find(|row| row.len() != width) {
        let what = format!("the row has {} values where the header names {width}", row.len());
        return Err(Fault::new(what).line(row.line));
    }
    if table.rows.is_empty() {
        return Err(Fault::of(FileFault::Empty, "the file has no rows")
            .help("there is nothing to read: was it written to the end?"));
    }
    Ok(table)
}

/// The number in a column of a row; none where the cell is empty.
pub(super) fn number(table: &CsvTable, row: &CsvRow, column: usize) -> Result<Option<f64>> {
    let cell = row.cell(column);
    if cell.is_empty() {
        return Ok(None);
    }
    match cell.parse::<f64>() {
        // Some write "nan" where no face was found.
        Ok(value) if value.is_nan() => Ok(None),
        Ok(value) if value.abs() < 1e9 => Ok(Some(value)),
        _ => {
            let name = table.names.get(column).map(String::as_str).unwrap_or_default();
            Err(Fault::new(format!("`{cell}` in the column `{name}` is no number that can be")).line(row.line))
        }
    }
}

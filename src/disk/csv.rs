//! Comma-separated tables: a header, rows with the lines they begin on, cells without their quotes and outer blanks.
//!
//! Quoted as RFC 4180 says. Accepted beyond it: a byte order mark, blank lines, and blanks before an opening quote. The
//! meaning of the columns, and rows that are shorter or longer than the header, are the caller's.

use std::borrow::Cow;

use csv::{ReaderBuilder, StringRecord, Terminator};

use super::{Fault, FileFault, Result};

/// A table whose first row names its columns.
#[derive(Debug, Default)]
pub struct CsvTable {
    /// The names of the columns; none in a text without rows.
    pub names: Vec<String>,
    /// The line of the header, counted from 1; 0 where there is none.
    pub line: usize,
    /// The rows below the header that are not blank.
    pub rows: Vec<CsvRow>,
}

/// One row of a [`CsvTable`].
#[derive(Debug)]
pub struct CsvRow {
    /// The line that the row begins on, counted from 1.
    pub line: usize,
    cells: StringRecord,
}

impl CsvTable {
    /// Reads a whole text.
    ///
    /// # Errors
    /// When it ends inside quotes, with the line that opens them.
    pub(crate) fn read(text: &str) -> Result<Self> {
        let text = with_quotes_first(text.strip_prefix('\u{FEFF}').unwrap_or(text))?;
        let mut reader = ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .terminator(Terminator::Any(b'\n'))
            .from_reader(text.as_bytes());
        let mut table = Self::default();
        for record in reader.records() {
            // Neither memory nor UTF-8 text fails to be read.
            let cells = record
                .map_err(|error| Fault::of(FileFault::OutOfRange, format!("the table cannot be read: {error}")))?;
            if cells.len() == 1 && !cells[0].is_empty() && cells[0].trim().is_empty() {
                continue;
            }
            let row = CsvRow { line: line_of(&cells, &text), cells };
            if table.names.is_empty() {
                table.names = (0..row.len()).map(|column| row.cell(column).to_owned()).collect();
                table.line = row.line;
            } else {
                table.rows.push(row);
            }
        }
        Ok(table)
    }

    /// The names of the columns that a header line gives; none where it is no header.
    pub(crate) fn names_of(line: &str) -> Vec<String> {
        Self::read(line).map(|table| table.names).unwrap_or_default()
    }

    /// The index of a column, whatever the capitals of its name.
    pub(crate) fn column(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|n| n.eq_ignore_ascii_case(name))
    }
}

impl CsvRow {
    /// The number of cells.
    pub(crate) fn len(&self) -> usize {
        self.cells.len()
    }

    /// The text of a cell without blanks around it; empty where the row ends before that column.
    pub(crate) fn cell(&self, column: usize) -> &str {
        self.cells.get(column).unwrap_or_default().trim()
    }
}

/// The line that a record begins on. The reader gives the place where the record before it ends, so the line feeds of
/// blank lines between the two are added.
fn line_of(record: &StringRecord, text: &str) -> usize {
    record.position().map_or(1, |place| {
        let rest = text.as_bytes().get(place.byte() as usize..).unwrap_or_default();
        place.line() as usize + rest.iter().take_while(|byte| **byte == b'\n').count()
    })
}

/// Removes the blanks between the start of a field and the quote that opens it (`a, "b, c"`), which RFC 4180 would read
/// as a part of the field, and the quote with them.
///
/// # Errors
/// When a quote is never closed, with its line.
fn with_quotes_first(text: &str) -> Result<Cow<'_, str>> {
    #[derive(Clone, Copy, PartialEq)]
    enum At {
        Start,
        Quoted,
        /// Behind a quote that closes the field, or is the first of two that stand for one.
        Quote,
        Plain,
    }
    if !text.contains('"') {
        return Ok(Cow::Borrowed(text));
    }
    let mut out = String::with_capacity(text.len());
    let (mut at, mut start, mut line, mut opened) = (At::Start, 0, 1, 1);
    for c in text.chars() {
        at = match (at, c) {
            (At::Start, '"') => {
                out.truncate(start);
                opened = line;
                At::Quoted
            }
            (At::Quoted, '"') => At::Quote,
            (At::Quoted, _) | (At::Quote, '"') => At::Quoted,
            (_, ',' | '\n') => {
                start = out.len() + 1;
                At::Start
            }
            (At::Start, c) if c.is_whitespace() => At::Start,
            _ => At::Plain,
        };
        line += usize::from(c == '\n');
        out.push(c);
    }
    if at == At::Quoted {
        return Err(Fault::of(FileFault::CutOff, "the file ends inside a label in quotes")
            .line(opened)
            .help("the quote opened here is never closed; a quote inside a label is written twice"));
    }
    Ok(Cow::Owned(out))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(text: &str) -> Vec<(usize, Vec<String>)> {
        let table = CsvTable::read(text).unwrap();
        let cells = |row: &CsvRow| (0..row.len()).map(|i| row.cell(i).to_owned()).collect();
        table.rows.iter().map(|row| (row.line, cells(row))).collect()
    }

    #[test]
    fn a_row_has_the_line_it_begins_on() {
        for end in ["\n", "\r\n"] {
            let text = ["\u{FEFF}", " ", "a,b", "", "1,\"two", "lines\"", "", " \t", "3,4", "", "5,6"].join(end);
            let table = CsvTable::read(&text).unwrap();
            assert_eq!((table.line, &table.names[..]), (3, &["a".to_owned(), "b".to_owned()][..]));
            let lines: Vec<usize> = table.rows.iter().map(|row| row.line).collect();
            assert_eq!(lines, [5, 9, 11], "{end:?}");
        }
    }

    #[test]
    fn quotes_and_blanks_around_cells_are_no_part_of_them() {
        let text = "h\na , \"b, \"\"c\"\"\" ,\t\"\n\",x\"y\"\n\"\"\n \"d\"e\"";
        let expected: [(usize, &[&str]); 3] = [(2, &["a", "b, \"c\"", "", "x\"y\""]), (4, &[""]), (5, &["de\""])];
        let expected = expected.map(|(line, cells)| (line, cells.iter().map(|&c| c.to_owned()).collect::<Vec<_>>()));
        assert_eq!(rows(text), expected);
    }

    #[test]
    fn a_quote_that_is_never_closed_is_named_by_its_line() {
        let fault = CsvTable::read("a,b\n\"1\n2\",3\n4, \"5\n6\n").unwrap_err();
        assert_eq!(fault.line_number(), Some(4));
    }

    #[test]
    fn columns_are_found_whatever_their_capitals_and_nothing_has_none() {
        let table = CsvTable::read("Time, \"Face_ID\"\n").unwrap();
        assert_eq!((table.column("face_id"), table.column("time"), table.column("x")), (Some(1), Some(0), None));
        assert!(CsvTable::read(" \n\n").unwrap().names.is_empty());
        assert_eq!(CsvTable::names_of("a,\"b\""), ["a", "b"]);
    }
}

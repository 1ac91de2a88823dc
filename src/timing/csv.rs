//! Times as a table: `tier,start,end,label`, quoted as RFC 4180 says.
//!
//! A row without a label is silence. One is written where a tier ends before the recording does, so that neither the
//! duration nor a tier without labels is lost.

use super::Timing;
use super::clock::seconds;
use super::layer::Layer;
use super::tiers::{MAX_TIERS, too_many_tiers};
use crate::disk::{CsvTable, Fault, FileFault, Result};

const COLUMNS: [&str; 4] = ["tier", "start", "end", "label"];

/// A row's line, start, end and label.
type Row = (usize, f64, f64, String);

/// Whether a first line is this table's header.
pub(super) fn is_header(line: &str) -> bool {
    let names = CsvTable::names_of(line);
    COLUMNS.iter().all(|c| names.iter().any(|n| n.eq_ignore_ascii_case(c)))
}

pub(super) fn parse(text: &str) -> Result<Timing> {
    let table = CsvTable::read(text)?;
    let header_fault = |fault: Fault| fault.help("the first line must be `tier,start,end,label`");
    if table.names.is_empty() {
        return Err(header_fault(Fault::of(FileFault::Empty, "the file is empty")));
    }
    let mut places = [0; 4];
    for (place, column) in places.iter_mut().zip(COLUMNS) {
        *place = table.column(column).ok_or_else(|| {
            header_fault(Fault::of(FileFault::Missing, format!("the column `{column}` is missing")).line(table.line))
        })?;
    }
    // Rows may come by tier or by time: they are gathered by tier and put in order before they are laid.
    let mut tiers: Vec<(String, Vec<Row>)> = Vec::new();
    for record in &table.rows {
        let line = record.line;
        if record.len() != table.names.len() {
            return Err(Fault::new(format!("the row has {} values, the header {}", record.len(), table.names.len()))
                .line(line)
                .help("a label with a comma or a line break must stand in double quotes"));
        }
        let number = |at: usize| {
            let found = record.cell(places[at]);
            found.parse::<f64>().ok().filter(|n| n.is_finite()).ok_or_else(|| {
                Fault::new(format!("`{found}` in the column `{}` is no finite number", COLUMNS[at]))
                    .line(line)
                    .help("write seconds with digits and a point, such as 1.25")
            })
        };
        let row = (line, number(1)?, number(2)?, record.cell(places[3]).to_owned());
        let name = record.cell(places[0]);
        match tiers.iter().position(|(n, _)| n == name) {
            Some(at) => tiers[at].1.push(row),
            None if tiers.len() >= MAX_TIERS => return Err(too_many_tiers().line(line)),
            None => tiers.push((name.to_owned(), vec![row])),
        }
    }
    let mut timing = Timing::default();
    for (name, mut rows) in tiers {
        rows.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.2.total_cmp(&b.2)));
        let mut layer = Layer::new(&name);
        for (line, start, end, label) in rows {
            layer.lay(start, end, &label).map_err(|fault| fault.line(line))?;
        }
        let (tier, until) = layer.done();
        timing.add_read(tier, until)?;
    }
    Ok(timing)
}

pub(super) fn write(timing: &Timing) -> String {
    let mut text = COLUMNS.join(",");
    text.push('\n');
    let mut row = |name: &str, start: f64, end: f64, label: &str| {
        text.push_str(&[&quoted(name), &seconds(start), &seconds(end), &quoted(label)].map(String::as_str).join(","));
        text.push('\n');
    };
    for tier in &timing.tiers {
        for i in &tier.intervals {
            row(&tier.name, i.start, i.end, &i.label);
        }
        if tier.intervals.is_empty() || tier.end() < timing.duration {
            row(&tier.name, tier.end(), timing.duration.max(tier.end()), "");
        }
    }
    text
}

/// A field in quotes where it needs them: quotes, commas, line breaks, and blanks at its ends.
fn quoted(field: &str) -> String {
    if field.contains(['"', ',', '\n', '\r']) || field != field.trim() {
        format!("\"{}\"", field.replace('"', "\"\""))
    } else {
        field.to_owned()
    }
}

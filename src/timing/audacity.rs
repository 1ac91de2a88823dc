//! Audacity's labels: `start`, `end` and label in a line, parted by tabs, in seconds.
//!
//! A second line that begins with a backslash holds the frequencies of a label and is passed over. A label of one
//! point ends where it starts; version 1.2 wrote only the start. Where several tracks were exported into one file, the
//! times begin anew with each, and each is a tier. Manual: "Importing and Exporting Labels".

use super::clock::{number, one_line};
use super::layer::Layer;
use super::{Interval, Timing};
use crate::disk::{Fault, FileFault, Result};

/// What the labels of a track are taken for.
const TIER: &str = "syllables";

/// Whether a line is one of this format.
pub(super) fn is_line(line: &str) -> bool {
    fields(line).is_some()
}

/// Start, end and label of a line.
fn fields(line: &str) -> Option<(f64, f64, &str)> {
    let (start, rest) = line.trim_start_matches(' ').split_once('\t')?;
    let start = number(start)?;
    let (end, label) = rest.split_once('\t').unwrap_or((rest, ""));
    match number(end) {
        Some(end) => Some((start, end, label)),
        None => Some((start, start, rest)),
    }
}

pub(super) fn parse(text: &str) -> Result<Timing> {
    let mut timing = Timing::default();
    let mut layer: Option<Layer> = None;
    let mut last = 0.0;
    for (index, line) in text.lines().enumerate() {
        if line.trim().is_empty() || line.starts_with('\\') {
            continue;
        }
        let Some((start, end, label)) = fields(line) else {
            let found: String = line.trim().chars().take(40).collect();
            return Err(Fault::new(format!("found `{found}` where a label's times are expected"))
                .line(index + 1)
                .help("a line is start, end and label, parted by tabs, such as `1.25⇥1.5⇥hao3`"));
        };
        if start < last
            && let Some((tier, until)) = layer.take().map(Layer::done)
        {
            timing.add_read(tier, until).map_err(|fault| fault.line(index + 1))?;
        }
        last = start;
        let layer = layer.get_or_insert_with(|| Layer::new(TIER));
        layer.lay(start, end, label).map_err(|fault| fault.line(index + 1))?;
    }
    let Some((tier, until)) = layer.map(Layer::done) else {
        return Err(Fault::of(FileFault::Empty, "there is no label in the file").help("was it written to the end?"));
    };
    timing.add_read(tier, until)?;
    Ok(timing)
}

pub(super) fn write(intervals: &[Interval]) -> String {
    let line = |i: &Interval| format!("{:.6}\t{:.6}\t{}\n", i.start, i.end, one_line(&i.label, " "));
    intervals.iter().map(line).collect()
}

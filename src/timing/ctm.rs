//! CTM, the time marks of conversations: `file channel start duration word [confidence]` in a line, in seconds.
//!
//! Each file and channel is a tier: `words`, or named after them where there are several. Lines that begin with `;;`
//! are remarks; lines may come in any order. Written is one tier, of a file `speech`, channel 1; a label with blanks
//! gets low lines instead, since a word has none. NIST SCTK, "ctm - Definition of time marked conversation scoring
//! input".

use super::clock::{number, one_line, seconds};
use super::layer::Layer;
use super::tiers::{MAX_TIERS, too_many_tiers};
use super::{Interval, Timing};
use crate::disk::{Fault, FileFault, Result};

const TIER: &str = "words";

/// A mark's line, start, end and word.
type Row<'a> = (usize, f64, f64, &'a str);

/// Whether a line is one of this format.
pub(super) fn is_line(line: &str) -> bool {
    let fields: Vec<&str> = line.split_whitespace().collect();
    matches!(fields.as_slice(), [_, _, start, duration, _] | [_, _, start, duration, _, _]
        if number(start).is_some() && number(duration).is_some())
}

/// Whether a line is a remark.
pub(super) fn is_remark(line: &str) -> bool {
    line.trim_start().starts_with(";;")
}

pub(super) fn parse(text: &str) -> Result<Timing> {
    let mut tiers: Vec<(String, Vec<Row>)> = Vec::new();
    for (index, line) in text.lines().enumerate() {
        if line.trim().is_empty() || is_remark(line) {
            continue;
        }
        let fields: Vec<&str> = line.split_whitespace().collect();
        let [file, channel, start, duration, rest @ ..] = fields.as_slice() else {
            return Err(Fault::new(format!("the line has {} values", fields.len()))
                .line(index + 1)
                .help("a line is `file channel start duration word`, and a confidence where it is known"));
        };
        let time = |text: &str, what: &str| {
            number(text).ok_or_else(|| {
                Fault::new(format!("`{text}` is no {what}"))
                    .line(index + 1)
                    .help("write seconds with digits and a point, such as 1.25")
            })
        };
        let (start, duration) = (time(start, "start")?, time(duration, "duration")?);
        let row = (index + 1, start, start + duration, rest.first().copied().unwrap_or_default());
        let name = format!("{file} {channel}");
        match tiers.iter().position(|(known, _)| *known == name) {
            Some(at) => tiers[at].1.push(row),
            None if tiers.len() >= MAX_TIERS => return Err(too_many_tiers().line(index + 1)),
            None => tiers.push((name, vec![row])),
        }
    }
    if tiers.is_empty() {
        return Err(Fault::of(FileFault::Empty, "there is no word in the file").help("was it written to the end?"));
    }
    let one = tiers.len() == 1;
    let mut timing = Timing::default();
    for (name, mut rows) in tiers {
        rows.sort_by(|a, b| a.1.total_cmp(&b.1));
        let mut layer = Layer::new(if one { TIER } else { &name });
        for (line, start, end, word) in rows {
            layer.lay(start, end, word).map_err(|fault| fault.line(line))?;
        }
        let (tier, until) = layer.done();
        timing.add_read(tier, until)?;
    }
    Ok(timing)
}

pub(super) fn write(intervals: &[Interval]) -> String {
    let line = |i: &Interval| {
        let duration = (i.end * 1e6).round() / 1e6 - (i.start * 1e6).round() / 1e6;
        format!("speech 1 {} {} {}\n", seconds(i.start), seconds(duration), one_line(&i.label, "_"))
    };
    intervals.iter().map(line).collect()
}

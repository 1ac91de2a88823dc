//! HTK's label files: `start end label` in a line, in units of 100 ns; other programs write the same in seconds with a
//! point, which are read too. What follows the label, a score or the name of a word, is passed over.
//!
//! Labels with blanks are written with low lines instead. The HTK Book, 6.2.1.

use super::clock::{number, one_line};
use super::layer::Layer;
use super::{Interval, Timing};
use crate::disk::{Fault, FileFault, Result};

const TIER: &str = "syllables";

/// Units a second.
const UNITS: f64 = 1e7;

/// Whether a line is one of this format.
pub(super) fn is_line(line: &str) -> bool {
    let mut fields = line.split_whitespace();
    let times = [fields.next(), fields.next()];
    times.iter().all(|time| time.is_some_and(|time| number(time).is_some())) && fields.next().is_some()
}

/// Whether the times of a line are whole numbers too large for seconds.
pub(super) fn in_units(line: &str) -> bool {
    let large = |time: &str| !time.contains('.') && number(time).is_some_and(|time| time >= 1e5);
    is_line(line)
        && line.split_whitespace().take(2).any(large)
        && line.split_whitespace().take(2).all(|t| !t.contains('.'))
}

pub(super) fn parse(text: &str) -> Result<Timing> {
    let lines = || text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    let mut in_seconds = false;
    for (index, line) in lines() {
        if line.starts_with("#!MLF!#") {
            return Err(Fault::new("it is a master label file, of many recordings")
                .line(index + 1)
                .help("cut out the part of this recording, without the lines of its name and of the closing point"));
        }
        if !is_line(line) {
            let found: String = line.trim().chars().take(40).collect();
            return Err(Fault::new(format!("found `{found}` where two times and a label are expected"))
                .line(index + 1)
                .help("a line is `start end label`, in units of 100 ns, such as `12500000 15000000 hao3`"));
        }
        in_seconds |= line.split_whitespace().take(2).any(|time| time.contains('.'));
    }
    let mut layer = Layer::new(TIER);
    for (index, line) in lines() {
        let mut fields = line.split_whitespace();
        let mut time = || {
            let time = fields.next().and_then(number).unwrap_or_default();
            if in_seconds { time } else { time / UNITS }
        };
        let (start, end) = (time(), time());
        layer.lay(start, end, fields.next().unwrap_or_default()).map_err(|fault| fault.line(index + 1))?;
    }
    let (tier, until) = layer.done();
    if until == 0.0 && tier.intervals.is_empty() {
        return Err(Fault::of(FileFault::Empty, "there is no label in the file").help("was it written to the end?"));
    }
    let mut timing = Timing::default();
    timing.add_read(tier, until)?;
    Ok(timing)
}

pub(super) fn write(intervals: &[Interval]) -> String {
    let units = |time: f64| (time * UNITS).round() as u64;
    let line = |i: &Interval| format!("{} {} {}\n", units(i.start), units(i.end), one_line(&i.label, "_"));
    intervals.iter().map(line).collect()
}

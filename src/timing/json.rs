//! Times as one JSON object: `{"duration", "guessed", "tiers": [{"name", "intervals": [{"start", "end", "label"}]}]}`.

use std::fmt::Write;

use serde::Deserialize;
use serde_json::Value;

use super::Timing;
use super::clock::seconds;
use super::layer::{Layer, checked};
use crate::disk::{Fault, Result};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct TimingText {
    #[serde(default)]
    duration: f64,
    #[serde(default)]
    guessed: bool,
    tiers: Vec<TierText>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct TierText {
    name: String,
    intervals: Vec<IntervalText>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct IntervalText {
    start: f64,
    end: f64,
    label: String,
}

pub(super) fn parse(text: &str) -> Result<Timing> {
    let read: TimingText = serde_json::from_str(text).map_err(|error| {
        Fault::new(format!("not times in JSON: {error}"))
            .line(error.line())
            .help("an object with `duration`, `guessed` and `tiers`, as this program writes it")
    })?;
    let mut timing = Timing { duration: checked(read.duration)?, tiers: Vec::new(), guessed: read.guessed };
    for tier in read.tiers {
        let mut layer = Layer::new(&tier.name);
        for (index, i) in tier.intervals.iter().enumerate() {
            layer
                .lay(i.start, i.end, &i.label)
                .map_err(|fault| fault.in_part(format_args!("tier `{}`, interval {}", tier.name, index + 1)))?;
        }
        let (tier, until) = layer.done();
        timing.add_read(tier, until)?;
    }
    Ok(timing)
}

pub(super) fn write(timing: &Timing) -> String {
    let quoted = |text: &str| Value::from(text).to_string();
    let mut text =
        format!("{{\n\"duration\":{},\n\"guessed\":{},\n\"tiers\":[", seconds(timing.duration), timing.guessed);
    for (t, tier) in timing.tiers.iter().enumerate() {
        let comma = if t == 0 { "" } else { "," };
        // Writing to a string cannot fail.
        let _ = write!(text, "{comma}\n {{\"name\":{},\"intervals\":[", quoted(&tier.name));
        for (n, i) in tier.intervals.iter().enumerate() {
            let comma = if n == 0 { "" } else { "," };
            let (start, end, label) = (seconds(i.start), seconds(i.end), quoted(&i.label));
            let _ = write!(text, "{comma}\n  {{\"start\":{start},\"end\":{end},\"label\":{label}}}");
        }
        text.push_str("]}");
    }
    text.push_str("]\n}\n");
    text
}

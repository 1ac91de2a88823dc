//! What Rhubarb Lip Sync writes: mouth shapes in time, as TSV, JSON or XML; see [`super::shapes`] for the shapes.
//!
//! TSV has a line `start⇥shape` for each, and one of the end; JSON and XML have starts, ends and the duration. Rhubarb
//! itself counts in hundredths of a second; more digits are written where there are more.

use std::fmt::Write;

use serde::Deserialize;

use super::clock::{number, seconds};
use super::layer::checked;
use super::shapes::{Cues, Naming, TIER, tiled};
use super::{Tier, Timing};
use crate::disk::{Fault, Result};

/// How much a last shape without an end gets, in seconds.
const LAST: f64 = 0.1;

/// Whether a line is one of the TSV.
pub(super) fn is_line(line: &str) -> bool {
    row(line).is_some_and(|(_, shape)| Naming::Rhubarb.ours(shape).is_some())
}

fn row(line: &str) -> Option<(f64, &str)> {
    let (start, shape) = line.split_once('\t')?;
    Some((number(start)?, shape.trim()))
}

pub(super) fn parse_tsv(text: &str) -> Result<Timing> {
    let mut cues = Cues::new();
    let mut rows = Vec::new();
    for (index, line) in text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()) {
        let Some((start, shape)) = row(line) else {
            let found: String = line.trim().chars().take(40).collect();
            return Err(Fault::new(format!("found `{found}` where a time and a shape are expected"))
                .line(index + 1)
                .help("a line is a time and one of A to H and X, parted by a tab"));
        };
        rows.push((index + 1, start, shape));
    }
    for (place, (line, start, shape)) in rows.iter().enumerate() {
        let silent = Naming::Rhubarb.ours(shape) == Some(None);
        let next = rows.get(place + 1).map(|(_, start, _)| *start);
        let end = next.unwrap_or(if silent { *start } else { start + LAST });
        cues.lay(*start, end, shape, Naming::Rhubarb).map_err(|fault| fault.line(*line))?;
    }
    cues.done(0.0)
}

#[derive(Deserialize)]
struct ResultText {
    #[serde(default)]
    metadata: Metadata,
    #[serde(rename = "mouthCues")]
    cues: Vec<CueText>,
}

#[derive(Deserialize, Default)]
struct Metadata {
    #[serde(default)]
    duration: f64,
}

#[derive(Deserialize)]
struct CueText {
    start: f64,
    end: f64,
    value: String,
}

pub(super) fn parse_json(text: &str) -> Result<Timing> {
    let read: ResultText = serde_json::from_str(text).map_err(|error| {
        Fault::new(format!("not mouth shapes in JSON: {error}"))
            .line(error.line())
            .help("an object with `mouthCues`, as `rhubarb -f json` writes it")
    })?;
    let mut cues = Cues::new();
    for (index, cue) in read.cues.iter().enumerate() {
        cues.lay(cue.start, cue.end, &cue.value, Naming::Rhubarb)
            .map_err(|fault| fault.in_part(format_args!("mouth cue {}", index + 1)))?;
    }
    cues.done(checked(read.metadata.duration)?)
}

pub(super) fn parse_xml(text: &str) -> Result<Timing> {
    let help = "an element `rhubarbResult` with `mouthCues`, as `rhubarb -f xml` writes it";
    let tree = roxmltree::Document::parse(text)
        .map_err(|error| Fault::new(format!("not XML: {error}")).line(error.pos().row as usize).help(help))?;
    let root = tree.root_element();
    if root.tag_name().name() != "rhubarbResult" {
        let name: String = root.tag_name().name().chars().take(40).collect();
        return Err(Fault::new(format!("found `{name}` where `rhubarbResult` is expected")).line(1).help(help));
    }
    // Rising places of nodes are asked for, so that lines are counted once.
    let (mut counted, mut line) = (0, 1);
    let mut line_of = |node: &roxmltree::Node| {
        let place = node.range().start;
        line += text.get(counted..place).map_or(0, |between| between.matches('\n').count());
        counted = place;
        line
    };
    let mut cues = Cues::new();
    let mut duration = 0.0;
    for node in root.descendants().filter(roxmltree::Node::is_element) {
        match node.tag_name().name() {
            "duration" => {
                let said = node.text().and_then(number).unwrap_or_default();
                duration = checked(said).map_err(|fault| fault.line(line_of(&node)))?;
            }
            "mouthCue" => {
                let line = line_of(&node);
                let time = |name: &str| {
                    let found = node.attribute(name).unwrap_or_default();
                    number(found).ok_or_else(|| {
                        Fault::new(format!("`{found}` is no {name} of a mouth cue"))
                            .line(line)
                            .help("`start` and `end` are seconds, such as \"1.25\"")
                    })
                };
                let (start, end) = (time("start")?, time("end")?);
                let shape = node.text().unwrap_or_default().trim();
                cues.lay(start, end, shape, Naming::Rhubarb).map_err(|fault| fault.line(line))?;
            }
            _ => {}
        }
    }
    cues.done(duration)
}

/// The cues of the tier of shapes; one of silence where there are none.
fn cues(timing: &Timing) -> (Vec<(f64, f64, &'static str)>, f64) {
    let none = Tier::new(TIER);
    let tier = timing.shapes().unwrap_or(&none);
    let end = timing.duration.max(tier.end());
    (tiled(tier, end, Naming::Rhubarb), end)
}

pub(super) fn write_tsv(timing: &Timing) -> String {
    let (cues, end) = cues(timing);
    let mut text = String::new();
    for (start, _, name) in cues {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}\t{name}", seconds(start));
    }
    text + &format!("{}\tX\n", seconds(end))
}

pub(super) fn write_json(timing: &Timing) -> String {
    let (cues, end) = cues(timing);
    let cue = |(start, end, name): &(f64, f64, &str)| {
        format!("    {{ \"start\": {}, \"end\": {}, \"value\": \"{name}\" }}", seconds(*start), seconds(*end))
    };
    let cues: Vec<String> = cues.iter().map(cue).collect();
    format!(
        "{{\n  \"metadata\": {{\n    \"soundFile\": \"\",\n    \"duration\": {}\n  }},\n  \"mouthCues\": [\n{}\n  ]\n}}\n",
        seconds(end),
        cues.join(",\n")
    )
}

pub(super) fn write_xml(timing: &Timing) -> String {
    let (cues, end) = cues(timing);
    let mut text = format!(
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<rhubarbResult>\n  <metadata>\n    <soundFile></soundFile>\n    \
         <duration>{}</duration>\n  </metadata>\n  <mouthCues>\n",
        seconds(end)
    );
    for (start, end, name) in cues {
        let (start, end) = (seconds(start), seconds(end));
        let _ = writeln!(text, "    <mouthCue start=\"{start}\" end=\"{end}\">{name}</mouthCue>");
    }
    text + "  </mouthCues>\n</rhubarbResult>\n"
}

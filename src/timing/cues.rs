//! Subtitles, SubRip and WebVTT: one tier, a cue for each interval, times to the millisecond.
//!
//! The lines of a cue are the lines of its label; a blank line would end the cue, so a label loses its blank lines.
//! The tier that is read is called `syllables`, which is what a lesson needs; cue numbers, places and colours are
//! passed over.

use super::clock::{clock, parse_clock};
use super::layer::Layer;
use super::{Interval, Timing};
use crate::disk::{Fault, FileFault, Result};

/// What a subtitle's intervals are taken for.
const TIER: &str = "syllables";

pub(super) fn parse_srt(text: &str) -> Result<Timing> {
    let mut layer = Layer::new(TIER);
    for block in blocks(text, 1) {
        cue(&block, &mut layer, str::to_owned)?;
    }
    done(layer)
}

pub(super) fn parse_vtt(text: &str) -> Result<Timing> {
    let first = text.lines().next().unwrap_or_default();
    if first.split_whitespace().next() != Some("WEBVTT") {
        return Err(Fault::new("the file does not begin with `WEBVTT`").line(1).help("is it an SRT file?"));
    }
    // What follows the first line without a blank line between belongs to the header.
    let header = text.lines().take_while(|l| !l.trim().is_empty()).count();
    let body = text.split_inclusive('\n').skip(header).collect::<String>();
    let mut layer = Layer::new(TIER);
    for block in blocks(&body, header + 1) {
        let word = block.lines[0].split_whitespace().next().unwrap_or_default();
        let aside = matches!(word, "NOTE" | "STYLE" | "REGION");
        if aside && !block.lines.iter().take(2).any(|l| l.contains("-->")) {
            continue;
        }
        cue(&block, &mut layer, unescaped)?;
    }
    done(layer)
}

fn done(layer: Layer) -> Result<Timing> {
    let (tier, until) = layer.done();
    if until == 0.0 && tier.intervals.is_empty() {
        return Err(Fault::of(FileFault::Empty, "there is no cue in the file").help("was it written to the end?"));
    }
    let mut timing = Timing::default();
    timing.add_read(tier, until)?;
    Ok(timing)
}

/// Lines between blank lines, and the number of the first.
struct Block<'a> {
    line: usize,
    lines: Vec<&'a str>,
}

fn blocks(text: &str, first_line: usize) -> Vec<Block<'_>> {
    let mut blocks: Vec<Block> = Vec::new();
    let mut open = false;
    for (index, line) in text.lines().enumerate() {
        match blocks.last_mut() {
            _ if line.trim().is_empty() => open = false,
            Some(block) if open => block.lines.push(line),
            _ => {
                blocks.push(Block { line: first_line + index, lines: vec![line] });
                open = true;
            }
        }
    }
    blocks
}

/// Lays one cue: a number or name that may be missing, the line of times, the lines of text.
fn cue(block: &Block, layer: &mut Layer, plain: fn(&str) -> String) -> Result<()> {
    let Some(at) = block.lines.iter().take(2).position(|l| l.contains("-->")) else {
        let (at, found) = block.lines.iter().enumerate().nth(1).unwrap_or((0, &block.lines[0]));
        let found: String = found.chars().take(40).collect();
        return Err(Fault::new(format!("found `{found}` where a cue's times are expected"))
            .line(block.line + at)
            .help("write them as 00:00:01,250 --> 00:00:02,000; was the file cut off?"));
    };
    let line = block.line + at;
    let time = |text: &str| {
        let text = text.trim();
        parse_clock(text).ok_or_else(|| {
            Fault::new(format!("`{text}` is no time"))
                .line(line)
                .help("write hours:minutes:seconds,milliseconds, such as 00:00:01,250")
        })
    };
    let (start, rest) = block.lines[at].split_once("-->").unwrap_or_default();
    let start = time(start)?;
    // Places and alignment may follow the end.
    let end = time(rest.split_whitespace().next().unwrap_or_default())?;
    let label = plain(&block.lines[at + 1..].join("\n"));
    layer.lay(start, end, &label).map_err(|fault| fault.line(line))
}

pub(super) fn write_srt(intervals: &[Interval]) -> String {
    let mut text = String::new();
    for (index, i) in intervals.iter().enumerate() {
        let times = format!("{} --> {}", clock(i.start, ','), clock(i.end, ','));
        text.push_str(&format!("{}\n{times}\n{}\n\n", index + 1, without_blank_lines(&i.label)));
    }
    text
}

pub(super) fn write_vtt(intervals: &[Interval]) -> String {
    let mut text = String::from("WEBVTT\n\n");
    for i in intervals {
        let label = without_blank_lines(&i.label).replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
        text.push_str(&format!("{} --> {}\n{label}\n\n", clock(i.start, '.'), clock(i.end, '.')));
    }
    text
}

fn without_blank_lines(label: &str) -> String {
    label.lines().filter(|l| !l.trim().is_empty()).collect::<Vec<_>>().join("\n")
}

/// The text of a WebVTT cue without its tags and with its escapes undone.
fn unescaped(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find(['<', '&']) {
        plain.push_str(&rest[..at]);
        rest = &rest[at..];
        let known = [("&amp;", "&"), ("&lt;", "<"), ("&gt;", ">"), ("&nbsp;", " "), ("&quot;", "\""), ("&#39;", "'")];
        let tag = if rest.starts_with('<') { rest.find('>').map(|end| (end + 1, "")) } else { None };
        let escape = known.iter().find(|(name, _)| rest.starts_with(name)).map(|(name, text)| (name.len(), *text));
        // A lone `<` or `&` is meant as it stands.
        let (length, text) = tag.or(escape).unwrap_or((1, &rest[..1]));
        plain.push_str(text);
        rest = &rest[length..];
    }
    plain + rest
}

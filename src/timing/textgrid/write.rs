//! Writing a TextGrid as Praat does. Its intervals tile the whole time: silence is an interval with an empty label.

use std::fmt::Write;

use super::super::clock::seconds;
use super::super::{Tier, Timing};

pub(in crate::timing) fn write(timing: &Timing, short: bool) -> String {
    let end = timing.tiers.iter().map(Tier::end).fold(timing.duration, f64::max);
    let mut page = Page { text: String::from("File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\n"), short };
    page.line(0, "xmin = ", "0");
    page.line(0, "xmax = ", &seconds(end));
    page.line(0, "tiers? ", "<exists>");
    page.line(0, "size = ", &timing.tiers.len().to_string());
    page.title(0, "item []:");
    for (t, tier) in timing.tiers.iter().enumerate() {
        let points = tier.is_of_points();
        page.title(1, &format!("item [{}]:", t + 1));
        page.line(2, "class = ", if points { "\"TextTier\"" } else { "\"IntervalTier\"" });
        page.line(2, "name = ", &quoted(&tier.name));
        page.line(2, "xmin = ", "0");
        page.line(2, "xmax = ", &seconds(end));
        if points {
            page.line(2, "points: size = ", &tier.intervals.len().to_string());
            for (n, point) in tier.intervals.iter().enumerate() {
                page.title(2, &format!("points [{}]:", n + 1));
                page.line(3, "number = ", &seconds(point.start));
                page.line(3, "mark = ", &quoted(&point.label));
            }
            continue;
        }
        let tiles = tiled(tier, end);
        page.line(2, "intervals: size = ", &tiles.len().to_string());
        for (n, (start, end, label)) in tiles.into_iter().enumerate() {
            page.title(2, &format!("intervals [{}]:", n + 1));
            page.line(3, "xmin = ", &seconds(start));
            page.line(3, "xmax = ", &seconds(end));
            page.line(3, "text = ", &quoted(label));
        }
    }
    page.text
}

/// The text so far, in one of the two forms: the short one is the long one without its words.
struct Page {
    text: String,
    short: bool,
}

impl Page {
    fn line(&mut self, depth: usize, word: &str, value: &str) {
        // Writing to a string cannot fail.
        let _ = match self.short {
            true => writeln!(self.text, "{value}"),
            false => writeln!(self.text, "{:1$}{word}{value}", "", depth * 4),
        };
    }

    fn title(&mut self, depth: usize, words: &str) {
        if !self.short {
            self.line(depth, words, "");
        }
    }
}

/// The intervals with those of silence between them; at least one.
fn tiled(tier: &Tier, end: f64) -> Vec<(f64, f64, &str)> {
    // Compared as they are written, so that no gap is left that cannot be seen.
    let gap = |from: f64, to: f64| (to * 1e6).round() > (from * 1e6).round();
    let mut tiles = Vec::with_capacity(tier.intervals.len() * 2 + 1);
    let mut until = 0.0;
    for i in &tier.intervals {
        if gap(until, i.start) {
            tiles.push((until, i.start, ""));
        }
        tiles.push((i.start, i.end, i.label.as_str()));
        until = i.end;
    }
    if gap(until, end) || tiles.is_empty() {
        tiles.push((until, end, ""));
    }
    tiles
}

fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('"', "\"\""))
}

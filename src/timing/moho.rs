//! Switch data of Moho, as Papagayo, Rhubarb and OpenToonz know it: `MohoSwitch1`, then a line `frame shape` wherever
//! the mouth changes. Frames count from 1. Shapes are Preston Blair's, or Rhubarb's letters; see [`super::shapes`].
//!
//! The file does not say how many frames there are in a second: 24 are taken, as these programs do, unless
//! the caller knows better or a line `FPS n` says otherwise, which Synfig wants. Written are 24. Times are those of frames.

use super::clock::number;
use super::shapes::{Cues, Naming, TIER, tiled};
use super::{Tier, Timing};
use crate::disk::{Fault, FileFault, Result};

/// Frames a second of a Moho file that does not say how many.
pub const FPS: f64 = 24.0;

/// The first line.
pub(super) const HEADER: &str = "MohoSwitch1";

/// `fps` is taken where the file does not say it.
pub(super) fn parse(text: &str, mut fps: f64) -> Result<Timing> {
    let mut lines = text.lines().enumerate().map(|(index, line)| (index + 1, line.trim()));
    if !lines.next().is_some_and(|(_, first)| first.eq_ignore_ascii_case(HEADER)) {
        return Err(Fault::new(format!("the file does not begin with `{HEADER}`"))
            .line(1)
            .help("is it another format?"));
    }
    let mut rows: Vec<(usize, f64, &str)> = Vec::new();
    for (line, row) in lines.filter(|(_, row)| !row.is_empty()) {
        let Some((frame, shape)) = row.split_once(char::is_whitespace) else {
            // Synfig wants to know of what kind the drawings are.
            if rows.is_empty() && ["bmp", "gif", "jpg", "png", "ppm", "tiff"].contains(&row) {
                continue;
            }
            return Err(expected(row).line(line));
        };
        if frame == "FPS" {
            let help = "frames a second are from 1 to 240";
            let wrong = || {
                Fault::of(FileFault::Empty, format!("`{}` are no frames a second", shape.trim())).line(line).help(help)
            };
            fps = number(shape.trim()).filter(|fps| (1.0..=240.0).contains(fps)).ok_or_else(wrong)?;
            continue;
        }
        let frame: i32 = frame.parse().map_err(|_| expected(row).line(line))?;
        // Papagayo writes 0 and -1 where it means the beginning.
        rows.push((line, f64::from(frame.max(1) - 1), shape.trim()));
    }
    // E, F and others are names of both; a file that has a letter of Rhubarb's alone has only such.
    let letters = rows.iter().all(|(_, _, shape)| Naming::Rhubarb.ours(shape).is_some());
    let naming =
        if letters && rows.iter().any(|(_, _, shape)| *shape != "E") { Naming::Rhubarb } else { Naming::PrestonBlair };
    let mut cues = Cues::new();
    for (place, (line, frame, shape)) in rows.iter().enumerate() {
        let silent = naming.ours(shape) == Some(None);
        let end = rows.get(place + 1).map_or(if silent { *frame } else { frame + 1.0 }, |(_, next, _)| *next);
        cues.lay(frame / fps, end / fps, shape, naming).map_err(|fault| fault.line(*line))?;
    }
    cues.done(0.0)
}

fn expected(row: &str) -> Fault {
    let found: String = row.chars().take(40).collect();
    Fault::new(format!("found `{found}` where a frame and a shape are expected"))
        .help("a line is the number of a frame and a shape, such as `12 MBP`")
}

pub(super) fn write(timing: &Timing) -> String {
    let none = Tier::new(TIER);
    let tier = timing.shapes().unwrap_or(&none);
    let end = timing.duration.max(tier.end());
    // The frame that shows a time, with what rounding can do.
    let frame = |time: f64| 1 + (time * FPS + 1e-4).floor() as i64;
    // Of shapes that begin in one frame, the last is what follows it.
    let mut rows: Vec<(i64, &str)> = Vec::new();
    for (start, _, name) in tiled(tier, end, Naming::PrestonBlair) {
        match rows.last_mut() {
            Some(last) if last.0 == frame(start) => last.1 = name,
            _ => rows.push((frame(start), name)),
        }
    }
    let last = rows.last().map_or(1, |(frame, _)| frame + 1);
    rows.push((frame(end).max(last), Naming::PrestonBlair.theirs(None)));
    rows.dedup_by(|next, before| next.1 == before.1 && next.1 != "rest");
    let lines: String = rows.iter().map(|(frame, name)| format!("{frame} {name}\n")).collect();
    format!("{HEADER}\n{lines}")
}

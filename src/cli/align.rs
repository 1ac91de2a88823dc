//! `lianpu align`: when each syllable of a script is spoken, in a lesson or in two files.

use std::io::Write;
use std::path::{Path, PathBuf};

use serde::Serialize;

use super::output::spare;
use super::output_fault;
use super::print::{self, say};
use super::times::{Row, json, seconds, table};
use crate::disk::{Fault, Result, write_output};
use crate::media::Sound;
use crate::project::{Clip, Lesson, read_script, tiers_of};
use crate::script::{Syllable, System};
use crate::speech::{self, Alignment, Note, Take};
use crate::timing::{self, Format, Interval, Tier, Timing};

/// Find when each syllable of a script is spoken. In a lesson the times go into timing.TextGrid; boundaries that you have
/// set stay as they are.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The lesson; its clips that have no times of their own yet.
    #[arg(value_name = "PROJECT", conflicts_with_all = ["speech", "script", "from"])]
    project: Option<PathBuf>,
    /// One clip of the lesson, whatever times it has: those not set in the studio are found anew.
    #[arg(long, requires = "project")]
    clip: Option<String>,
    /// A recording instead of a lesson.
    #[arg(long, value_name = "FILE")]
    speech: Option<PathBuf>,
    /// What is said in it.
    #[arg(long, value_name = "FILE", requires = "speech")]
    script: Option<PathBuf>,
    /// How the script is written; told from the text where left out.
    #[arg(long, value_name = "SYSTEM")]
    from: Option<System>,
    /// Mark syllables and pauses of a recording without knowing its words.
    #[arg(long, conflicts_with_all = ["script", "from"])]
    without_script: bool,
    /// A JSON array, one object a syllable, instead of a table.
    #[arg(long)]
    json: bool,
    /// Write it here instead: with --json the array, else the times in the format that the name ends in.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

/// Aligns and prints what was found.
///
/// # Errors
/// When a file cannot be read or written, or a recording and its script cannot be brought together.
pub(crate) fn run(args: &Args, out: &mut dyn Write) -> Result<()> {
    if let Some(path) = &args.out {
        let inputs: Vec<&Path> = [&args.speech, &args.script].into_iter().flatten().map(PathBuf::as_path).collect();
        spare(path, &inputs)?;
    }
    match (&args.project, &args.speech) {
        (Some(project), _) => in_lesson(project, args, out),
        (None, Some(speech)) if args.without_script => {
            let sound = Sound::read(speech)?;
            warn(&sound);
            marks(&sound, args, out)
        }
        (None, Some(speech)) => in_files(speech, args, out),
        (None, None) => Err(Fault::new("there is nothing to align")
            .help("name a lesson, or give --speech FILE --script FILE")
            .of_the_call()),
    }
}

fn in_files(speech: &Path, args: &Args, out: &mut dyn Write) -> Result<()> {
    let Some(path) = &args.script else {
        return Err(Fault::new("a recording needs its script").help("give --script FILE").of_the_call());
    };
    let (text, syllables) = read_script(path, args.from.unwrap_or_default())?;
    if syllables.is_empty() {
        return Err(Fault::new("there is nothing to say in it").at(path).help("write what is said in the recording"));
    }
    let sound = Sound::read(speech)?;
    warn(&sound);
    let take = Take { sound: &sound, script: &syllables, pins: &[] };
    let found = speech::align(&[take]).pop().unwrap_or_else(|| Err(Fault::new("nothing was found")));
    let found = found.map_err(|f| f.at(speech))?;
    for note in notes(&found) {
        print::note(note.to_string());
    }
    let rows: Vec<Row> = syllables.iter().zip(&found.syllables).map(|(s, f)| Row::found(s, f)).collect();
    let timing = || tiers(&text, &syllables, &found, sound.duration());
    give(&rows, timing, args, out)
}

fn in_lesson(project: &Path, args: &Args, out: &mut dyn Write) -> Result<()> {
    let mut lesson = open(project, args)?;
    let chosen =
        args.clip.as_deref().map(|name| lesson.clip_named(Some(name))).transpose().map_err(Fault::of_the_call)?;
    if args.without_script {
        if chosen.is_none() && lesson.clips.len() > 1 {
            let names: Vec<&str> = lesson.clips.iter().map(|c| c.entry.name.as_str()).collect();
            return Err(Fault::new("the lesson has several clips")
                .help(format!("name one by --clip: {}", names.join(", ")))
                .of_the_call());
        }
        let number = chosen.map_or_else(|| lesson.clip_named(None), Ok)?;
        let clip = &lesson.clips[number];
        let sound = clip
            .sound
            .clone()
            .ok_or_else(|| Fault::new(format!("the clip `{}` has no recording", clip.entry.name)).at(&clip.folder))?;
        return marks(&sound, args, out);
    }
    let report = lesson.align(chosen, args.out.is_none())?;
    report.notes.iter().for_each(print::note);
    if args.json || args.out.is_some() {
        let shown = if let Some(number) = chosen { vec![number] } else { lesson.spoken_clips() };
        let several = shown.len() > 1;
        let rows: Vec<Row> = shown.iter().flat_map(|n| Row::of_clip(&lesson.clips[*n], several)).collect();
        let one = shown.first().copied().filter(|_| !several);
        if args.out.is_some() && !args.json && one.is_none() {
            return Err(Fault::new("one file holds the times of one clip").help("name it by --clip").of_the_call());
        }
        let timing = || one.map(|n| lesson.clips[n].timing.clone()).unwrap_or_default();
        give(&rows, timing, args, out)?;
    } else {
        for number in report.aligned {
            say(out, summary(&lesson.clips[number]))?;
        }
    }
    let mut failed = report.failed;
    match failed.pop() {
        None => Ok(()),
        Some((last, fault)) => {
            for (number, fault) in failed {
                print::error(Some(&format!("clip {}", lesson.clips[number].entry.name)), &fault);
            }
            Err(fault.at(&lesson.clips[last].folder))
        }
    }
}

/// A project whose times are to be found: its files are written unless they go elsewhere.
fn open(project: &Path, args: &Args) -> Result<Lesson> {
    if args.without_script {
        return Lesson::open(project);
    }
    if args.out.is_some() {
        let lesson = Lesson::open(project)?;
        return lesson.check_saved().map(|()| lesson);
    }
    Lesson::open_to_write(project, "the times")
}

fn summary(clip: &Clip) -> String {
    let count = clip.syllables.len();
    let mut line = format!("clip {}: {count} syllable{} found", clip.entry.name, if count == 1 { "" } else { "s" });
    let doubts = clip.doubts();
    if !doubts.is_empty() {
        let times: Vec<String> = doubts.iter().take(5).map(|d| format!("{:.2} s", d.start)).collect();
        let more = if doubts.len() > 5 { ", …" } else { "" };
        line.push_str(&format!(", {} to look at: {}{more}", doubts.len(), times.join(", ")));
    }
    line
}

/// Says what was wrong with a recording's file and is wrong with its sound.
fn warn(sound: &Sound) {
    for warning in sound.warnings.iter().chain(&sound.quality().remarks()) {
        print::note(warning.as_str());
    }
}

/// The notes of an alignment; that a recording is noisy has been said with its other qualities.
fn notes(found: &Alignment) -> impl Iterator<Item = &Note> {
    found.notes.iter().filter(|n| !matches!(n, Note::Noisy { .. }))
}

/// The tiers of an alignment outside a lesson.
fn tiers(text: &str, syllables: &[Syllable], found: &Alignment, duration: f64) -> Timing {
    let mut timing = Timing { duration, ..Timing::default() };
    let labels: Vec<String> = syllables.iter().map(|s| s.text.clone()).collect();
    for tier in tiers_of(text, syllables, &labels, found) {
        timing.set_tier(tier);
    }
    timing
}

/// The format that a file's name ends in; a TextGrid without an ending.
fn format_of(path: &Path) -> Result<Format> {
    match (Format::from_path(path), path.extension()) {
        (Some(format), _) => Ok(format),
        (None, None) => Ok(Format::TextGrid),
        (None, Some(ending)) => {
            let mut known: Vec<&str> = Format::ALL.iter().map(|f| f.extension()).collect();
            let mut told = std::collections::BTreeSet::new();
            known.retain(|ending| told.insert(*ending));
            Err(Fault::new(format!("`{}` is the ending of no timing format", ending.to_string_lossy()))
                .at(path)
                .help(format!("endings: {}", known.join(", ")))
                .of_the_call())
        }
    }
}

/// Writes rows or times to where they were asked for.
fn give(rows: &[Row], timing: impl Fn() -> Timing, args: &Args, out: &mut dyn Write) -> Result<()> {
    let text = if args.json {
        json(rows)?
    } else if let Some(path) = &args.out {
        let format = format_of(path)?;
        let timing = timing();
        timing::writable(&timing, format).map_err(Fault::of_the_call)?;
        timing::write(&timing, format)
    } else {
        table(rows)
    };
    match &args.out {
        Some(path) => write_output(path, text.as_bytes()),
        None => out.write_all(text.as_bytes()).map_err(output_fault),
    }
}

#[derive(Debug, Serialize)]
struct Mark {
    kind: &'static str,
    start: f64,
    end: f64,
}

/// Syllables and pauses without words.
fn marks(sound: &Sound, args: &Args, out: &mut dyn Write) -> Result<()> {
    let heard = speech::nuclei(sound);
    if heard.syllables.is_empty() {
        return Err(Fault::new("no voice is heard in it").help("is it the right recording?"));
    }
    let mut marks: Vec<Mark> = Vec::new();
    for (kind, spans) in [("syllable", &heard.syllables), ("pause", &heard.pauses)] {
        marks.extend(spans.iter().map(|(a, b)| Mark { kind, start: seconds(*a), end: seconds(*b) }));
    }
    marks.sort_by(|a, b| a.start.total_cmp(&b.start));
    let text = if args.json {
        json(&marks)?
    } else if let Some(path) = &args.out {
        let mut tier = Tier::new("syllables");
        // A label must say something: a number can be typed over, and found again.
        let numbered = heard.syllables.iter().enumerate();
        tier.intervals.extend(numbered.map(|(i, (a, b))| Interval::new(*a, *b, (i + 1).to_string())));
        let mut timing = Timing { duration: sound.duration(), ..Timing::default() };
        timing.set_tier(tier);
        timing::write(&timing, format_of(path)?)
    } else {
        marks.iter().map(|m| format!("{:8.3} {:8.3}  {}\n", m.start, m.end, m.kind)).collect()
    };
    match &args.out {
        Some(path) => write_output(path, text.as_bytes()),
        None => out.write_all(text.as_bytes()).map_err(output_fault),
    }
}

//! `lianpu export`.

use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

use super::output_fault;
use crate::disk::{Fault, Result};
use crate::drawing::Colour;
use crate::export::{
    Dedupe, Format, FrameSet, Progress, Request, Shard, Written, plan, run as run_jobs, wholes, write_wholes,
};
use crate::project::Lesson;

/// Write lessons as frames, subtitles, pages, books and what other programs read. Run again, it only writes what is missing or has changed.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// The projects, or folders of them.
    #[arg(value_name = "PROJECT", required = true)]
    projects: Vec<PathBuf>,
    /// The forms, with commas between them. Frames: svg, png. Moving: mp4, webm, gif, apng, smil (an animated SVG), lottie. Whole: html (a page that plays
    /// the lesson), epub, layers. Times: textgrid, srt, vtt, rhubarb, moho. And wav, ratios, lpr, poses, mouths.
    #[arg(long = "to", value_name = "FORMAT", required = true, value_delimiter = ',')]
    formats: Vec<Format>,
    /// One clip; all of them where left out.
    #[arg(long)]
    clip: Option<String>,
    /// Where the files go; PROJECT/export where left out.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Which frames, counted from 0, the last one included: 0-24 or 0-24,50-74.
    #[arg(long, value_name = "A-B")]
    frames: Option<FrameSet>,
    /// One part of the frames, counted from 1: 2/3 is the second of three.
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
    /// Threads; as many as there are processors where left out.
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true,
        value_parser = clap::value_parser!(u16).range(0..=256), allow_negative_numbers = true)]
    jobs: u16,
    /// Width and height in pixels instead of the lesson's.
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    size: Option<[u32; 2]>,
    /// Frames a second instead of the lesson's.
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    fps: Option<f64>,
    /// #rrggbb, white, black or transparent.
    #[arg(long, value_name = "COLOR")]
    background: Option<Colour>,
    /// What is done about frames that are equal: link makes them one file under several names, copy copies, none makes
    /// each by itself.
    #[arg(long, value_name = "link|copy|none", default_value = "link", hide_default_value = true)]
    dedupe: Dedupe,
    /// Animated SVG with a group for every frame, as the thesis writes it; ten times as large.
    #[arg(long)]
    thesis: bool,
    /// Progress and result as lines of JSON.
    #[arg(long)]
    json: bool,
}

fn parse_size(text: &str) -> Result<[u32; 2], String> {
    let parsed = text.split_once(['x', 'X', '×']).and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    parsed.ok_or_else(|| format!("`{text}` is no size: write width x height, such as 1280x720"))
}

/// Exports every project and prints where the files are.
pub fn run(args: &Args, out: &mut dyn Write) -> Result<()> {
    let projects = super::lessons(&args.projects);
    let request = Request {
        formats: distinct(&args.formats),
        clip: args.clip.clone(),
        out: args.out.clone(),
        by_project: projects.len() > 1,
        frames: args.frames.clone().unwrap_or_default(),
        shard: args.shard.unwrap_or(Shard::WHOLE),
        size: args.size,
        fps: args.fps,
        background: args.background.map(|c| if c.a == 0 { None } else { Some(c) }),
        dedupe: args.dedupe,
        jobs: args.jobs.into(),
        thesis: args.thesis,
    };
    let stop = Arc::new(AtomicBool::new(false));
    for signal in [signal_hook::consts::SIGINT, signal_hook::consts::SIGTERM] {
        // A second signal ends the program at once: every file is whole at any moment.
        let _ = signal_hook::flag::register_conditional_shutdown(signal, 130, Arc::clone(&stop));
        let _ = signal_hook::flag::register(signal, Arc::clone(&stop));
    }
    check_names(&projects, args)?;
    let mut failed = 0;
    for project in &projects {
        match one(project, args, &request, &stop, out) {
            Ok(()) => {}
            // One damaged lesson must not keep a course from being exported.
            Err(fault) if projects.len() > 1 && !fault.is_of_the_call() && !stop.load(Ordering::Relaxed) => {
                eprintln!("error: {}: {fault}", project.display());
                failed += 1;
            }
            Err(fault) => return Err(fault),
        }
    }
    match failed {
        0 => Ok(()),
        n => Err(Fault::new(format!("{n} of {} projects could not be exported", projects.len()))
            .help("the reasons are above; run it again when they are mended")),
    }
}

/// In the order given, each once.
fn distinct(formats: &[Format]) -> Vec<Format> {
    let mut all = Vec::new();
    for format in formats {
        if !all.contains(format) {
            all.push(*format);
        }
    }
    all
}

/// Projects that are exported into one place need names that differ there.
fn check_names(projects: &[PathBuf], args: &Args) -> Result<()> {
    if args.out.is_none() {
        return Ok(());
    }
    let name = |p: &PathBuf| p.canonicalize().ok().and_then(|p| p.file_name().map(|n| n.to_owned()));
    for (i, project) in projects.iter().enumerate() {
        if let Some(other) = projects[..i].iter().find(|o| name(o).is_some() && name(o) == name(project)) {
            return Err(Fault::new(format!(
                "`{}` and `{}` would be written into the same folder",
                other.display(),
                project.display()
            ))
            .help("export them one by one, each with its own --out")
            .of_the_call());
        }
    }
    Ok(())
}

fn one(project: &Path, args: &Args, request: &Request, stop: &AtomicBool, out: &mut dyn Write) -> Result<()> {
    let mut lesson = Lesson::read(project)?;
    let clips: Vec<usize> = (0..lesson.clips.len())
        .filter(|n| args.clip.as_ref().is_none_or(|name| lesson.clips[*n].entry.name == *name))
        .collect();
    super::align::find_missing(&mut lesson, &clips);
    let jobs = plan(&lesson, request)?;
    for clip in &lesson.clips {
        note_guess(clip, &jobs);
    }
    for face in lesson.faces.iter().filter(|f| f.looks_each_time()) {
        eprintln!(
            "note: the points of face {} were looked for in its photo; `lianpu face` keeps them",
            face.entry.name
        );
    }
    let frames: u32 = jobs.iter().map(|j| j.frames.len() as u32).sum();
    let bar = progress_bar(frames, args.json);
    let show = |p: Progress| {
        bar.set_position(u64::from(p.done));
        // A line a hundredth, so that a log stays readable.
        if args.json && (p.done == p.of || p.done.is_multiple_of((p.of / 100).max(1))) {
            eprintln!("{}", serde_json::json!({ "done": p.done, "of": p.of }));
        }
    };
    let mut report = run_jobs(&jobs, request.jobs, &show, stop)?;
    bar.finish_and_clear();
    let whole = wholes(&lesson, request)?;
    let mut tell = |_: usize, whole: &crate::export::Whole| {
        let what =
            whole.clip.as_ref().map_or_else(|| whole.format.name().into(), |c| format!("{c}, {}", whole.format.name()));
        if args.json {
            eprintln!("{}", serde_json::json!({ "making": whole.format.name(), "clip": whole.clip }));
        } else if std::io::stderr().is_terminal() {
            eprintln!("making {what} …");
        }
    };
    let made = write_wholes(&lesson, request, &whole, &mut tell, stop)?;
    report.stopped |= made.len() < whole.len();
    tell_notes(&made);
    report = report.with(&made);
    if report.stopped {
        return Err(
            Fault::new("the export was stopped before its end").help("run it again: it goes on where it stopped")
        );
    }
    let mut say = |text: String| writeln!(out, "{text}").map_err(output_fault);
    for job in &jobs {
        let folder = (!job.formats.is_empty()).then(|| (job.folder.clone(), job.frames.len()));
        let files = job.texts.iter().map(|(path, _)| (path.clone(), 0));
        for (path, frames) in folder.into_iter().chain(files) {
            let mut line = serde_json::json!({ "project": project, "clip": job.clip, "path": path });
            if frames > 0 {
                line["frames"] = frames.into();
            }
            say(if args.json { line.to_string() } else { path.display().to_string() })?;
        }
    }
    for (whole, written) in whole.iter().zip(&made) {
        for path in &written.paths {
            let line = serde_json::json!({ "project": project, "clip": whole.clip, "path": path });
            say(if args.json { line.to_string() } else { path.display().to_string() })?;
        }
    }
    if args.json {
        let totals = serde_json::json!({ "project": project, "written": report.written, "kept": report.kept,
            "removed": report.removed, "bytes": report.bytes });
        return say(totals.to_string());
    }
    let removed = match report.removed {
        0 => String::new(),
        n => format!(", {n} left over from a longer export removed"),
    };
    let files = if report.written == 1 { "file" } else { "files" };
    eprintln!("{} {files} written, {} already there{removed}", report.written, report.kept);
    Ok(())
}

/// Tells what there is to know of whole files, each thing once.
fn tell_notes(made: &[Written]) {
    let mut told: Vec<&String> = Vec::new();
    for note in made.iter().flat_map(|w| &w.notes) {
        if !told.contains(&note) {
            eprintln!("note: {note}");
            told.push(note);
        }
    }
}

/// Frames drawn from guessed times look as sure as any others, so it is said.
fn note_guess(clip: &crate::project::Clip, jobs: &[crate::export::Job]) {
    if clip.timing.guessed && !clip.syllables.is_empty() && jobs.iter().any(|j| j.clip == clip.entry.name) {
        eprintln!("note: the times of clip {} are guessed; set them in the studio", clip.entry.name);
    }
}

fn progress_bar(frames: u32, json: bool) -> ProgressBar {
    if json || frames == 0 || !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(u64::from(frames));
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} frames  {per_sec}  {eta} left");
    if let Ok(style) = style {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}

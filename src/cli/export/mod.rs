//! `lianpu export`.

mod course;
mod show;

use std::io::Write;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use self::course::{Course, Failed};
use super::print::note;
use crate::disk::{Fault, Result};
use crate::drawing::Colour;
use crate::export::{Dedupe, Format, FrameSet, Request, Shard, shard_of_array};
use crate::figure::Widths;
use crate::project::{Output, check_output};

/// Write lessons as frames, subtitles, pages, books, videos and for other programs.
///
/// Run again, it only writes what is missing or has changed. `manifest.json` beside the files lists them with checksums.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// The projects, or folders of them.
    #[arg(value_name = "PROJECT", required = true)]
    pub(super) projects: Vec<PathBuf>,
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
    /// Which frames, counted from 0, the last one included: 0-24 or 0-24,50-74. For svg, png, poses and moving pictures; other
    /// forms hold the whole clip.
    #[arg(long, value_name = "A-B")]
    frames: Option<FrameSet>,
    /// One part of everything, counted from 1: 2/3 is the second of three. In a Slurm job array the task's own where left out;
    /// `lianpu merge` joins the parts.
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
    /// How the strokes of a line figure get their width between control points: bezier, along the curve, or paper,
    /// straight from one point's width to the next one's. As the figure's file says where left out. The cartoon's
    /// lines have no such points.
    #[arg(long, value_name = "bezier|paper")]
    width: Option<Widths>,
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
///
/// # Errors
/// When the call cannot be carried out, a lesson cannot be exported, or it was stopped.
pub fn run(args: &Args, out: &mut dyn Write) -> Result<()> {
    let projects = super::lessons(&args.projects);
    let shard = match args.shard {
        Some(shard) => shard,
        None => shard_of_array()?
            .inspect(|s| note(format_args!("part {s}, as this job array has it")))
            .unwrap_or(Shard::WHOLE),
    };
    let request = request_of(args, projects.len() > 1);
    let stop = Arc::new(AtomicBool::new(false));
    for signal in [signal_hook::consts::SIGINT, signal_hook::consts::SIGTERM] {
        // A second signal ends the program at once: every file is whole at any moment.
        let _ = signal_hook::flag::register_conditional_shutdown(signal, 130, Arc::clone(&stop));
        let _ = signal_hook::flag::register(signal, Arc::clone(&stop));
    }
    check_names(&projects, args)?;
    let course = Course { request: &request, shard, several: projects.len() > 1, stop: &stop, json: args.json };
    check_settings(args)?;
    let mut failed = Failed::default();
    let mut add = |more: Failed| {
        failed.count += more.count;
        failed.of_the_call += more.of_the_call;
    };
    match &args.out {
        Some(_) => add(course.export(&projects, out)?),
        // Each in its own folder, with a manifest of its own.
        None => {
            for project in &projects {
                add(course.export(std::slice::from_ref(project), out)?);
            }
        }
    }
    if failed.count == 0 {
        return Ok(());
    }
    let fault = Fault::new(format!("{} of {} projects could not be exported", failed.count, projects.len()))
        .help("the reasons are above; run it again when they are mended");
    let none_fits = failed.of_the_call as usize == projects.len();
    Err(if none_fits { fault.of_the_call() } else { fault })
}

/// What is asked of every lesson.
pub(super) fn request_of(args: &Args, by_project: bool) -> Request {
    Request {
        formats: distinct(&args.formats),
        clip: args.clip.clone(),
        out: args.out.clone(),
        by_project,
        frames: args.frames.clone().unwrap_or_default(),
        shares: None,
        size: args.size,
        fps: args.fps,
        background: args.background.map(|c| if c.a == 0 { None } else { Some(c) }),
        width: args.width,
        dedupe: args.dedupe,
        jobs: args.jobs.into(),
        thesis: args.thesis,
    }
}

/// What no lesson could be exported with is told once.
fn check_settings(args: &Args) -> Result<()> {
    let usual = Output::default();
    let output = Output { fps: args.fps.unwrap_or(usual.fps), size: args.size.unwrap_or(usual.size) };
    check_output(&output).map_err(Fault::of_the_call)
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

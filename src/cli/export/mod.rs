//! `lianpu export`.

mod show;

use std::io::Write;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use self::show::Show;
use super::print;
use crate::disk::{Fault, Result, shown};
use crate::drawing::Colour;
use crate::export::{Dedupe, Event, Format, FrameSet, Observer, Request, Shard, export_projects, shard_of_array};
use crate::figure::Widths;

/// Write lessons as frames, subtitles, pages, books, videos and for other programs.
///
/// Run again, it only writes what is missing or has changed. `manifest.json` beside the files lists them with checksums.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
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
/// When the call cannot be carried out, a project cannot be exported, or it was stopped.
pub(crate) fn run(args: &Args, out: &mut dyn Write) -> Result<()> {
    let projects = super::lessons(&args.projects);
    let shard = match args.shard {
        Some(shard) => shard,
        None => shard_of_array()?
            .inspect(|s| print::note(format!("part {s}, as this job array has it")))
            .unwrap_or(Shard::WHOLE),
    };
    let stop = Arc::new(AtomicBool::new(false));
    for signal in [signal_hook::consts::SIGINT, signal_hook::consts::SIGTERM] {
        // A second signal ends the program at once: every file is whole at any moment.
        let _ = signal_hook::flag::register_conditional_shutdown(signal, 130, Arc::clone(&stop));
        let _ = signal_hook::flag::register(signal, Arc::clone(&stop));
    }
    let several = projects.len() > 1;
    let show = Show::new(args.json);
    let mut event = |event: Event<'_>| {
        show.clear();
        match event {
            Event::Note(note) => print::note(note),
            Event::Exported(project, exported) => return show.result(project, several, exported, out),
            // The only project's fault is the call's own.
            Event::Failed(project, fault) if several => print::error(Some(&shown(project)), fault),
            Event::Failed(..) => {}
        }
        Ok(())
    };
    let mut observer = Observer { event: &mut event, progress: &|step| show.step(step), stop: &stop };
    let mut report = export_projects(&projects, &request_of(args), shard, &mut observer)?;
    show.clear();
    if report.stopped {
        return Err(
            Fault::new("the export was stopped before its end").help("run it again: it goes on where it stopped")
        );
    }
    let count = report.failed.len();
    match report.failed.pop() {
        None => Ok(()),
        Some((_, fault)) if !several => Err(fault),
        Some((_, last)) => {
            let fault = Fault::new(format!("{count} of {} projects could not be exported", projects.len()))
                .help("the reasons are above; run it again when they are mended");
            let of_the_call = |fault: &Fault| fault.is_of_the_call();
            let none_fits =
                count == projects.len() && of_the_call(&last) && report.failed.iter().all(|f| of_the_call(&f.1));
            Err(if none_fits { fault.of_the_call() } else { fault })
        }
    }
}

/// The request for every project.
pub(super) fn request_of(args: &Args) -> Request {
    Request {
        formats: args.formats.clone(),
        clip: args.clip.clone(),
        out: args.out.clone(),
        by_project: false,
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

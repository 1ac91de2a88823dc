//! `lianpu track`.

use std::io::Write;
use std::path::{Path, PathBuf};

use super::frames_done::FramesDone;
use super::{live, print};
use crate::disk::{Fault, Result};
use crate::project::{Clip, Lesson, Method, TrackEvent, TrackRequest, counted};
use crate::track::Options;

/// Follow the face in videos: the seven ratios of every frame into ratios.csv, its eyes, mouth and head into tracks.csv.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The lesson; its clips with videos that were not followed yet, or have changed since.
    #[arg(value_name = "PROJECT", required_unless_present = "live", conflicts_with_all = ["live", "model"])]
    project: Option<PathBuf>,
    /// One clip of the lesson, followed anew.
    #[arg(long, value_name = "NAME", requires = "project")]
    clip: Option<String>,
    /// By the person's active appearance model, or by regions of eyes and mouth.
    #[arg(long, default_value = Method::default().name(), value_name = "aam|regions", value_parser = super::one_of(Method::ALL, Method::name))]
    by: Method,
    /// Ratios as the paper has them: of the whole face, so that speech and blinks are read as emotion too, and some are
    /// negative. Without it they are the nearest mix from 0 on, told apart from what the face does besides.
    #[arg(long)]
    paper: bool,
    /// A ratios.csv that was not made by following a face gives way too.
    #[arg(long, requires = "project")]
    replace: bool,
    /// Frames as they come, YUV4MPEG2 on standard input (-), to a ratio record on standard output.
    #[arg(long, value_name = "-", requires = "model")]
    live: Option<PathBuf>,
    /// The lesson, or the folder of a face, whose person is in the frames.
    #[arg(long, value_name = "PROJECT", requires = "live")]
    model: Option<PathBuf>,
}

/// Follows the faces and says what was found.
///
/// # Errors
/// When a file cannot be read or written, or no face is found in a video.
pub(crate) fn run(args: &Args, out: &mut dyn Write) -> Result<()> {
    let options = if args.paper { Options::PAPER } else { Options::default() };
    match (&args.live, &args.model, &args.project) {
        (Some(input), Some(model), _) if input == Path::new("-") => live::run(model, &options, out),
        (Some(input), ..) => Err(Fault::new(format!("`--live {}` is none", input.display()))
            .help("frames come on standard input: `ffmpeg -nostdin -v error -i VIDEO -f yuv4mpegpipe - | lianpu track --live - --model PROJECT`")
            .of_the_call()),
        (None, _, Some(project)) => in_lesson(project, args, &options, out),
        // The parser asks for one of them.
        (None, _, None) => Ok(()),
    }
}

fn in_lesson(project: &Path, args: &Args, options: &Options, out: &mut dyn Write) -> Result<()> {
    let mut lesson = Lesson::open_to_write(project, "the ratios")?;
    let clip =
        args.clip.as_deref().map(|name| lesson.clip_named(Some(name))).transpose().map_err(Fault::of_the_call)?;
    let request = TrackRequest { clip, method: args.by, options: *options, replace: args.replace };
    let bar = FramesDone::default();
    let mut failed: Option<(String, Fault)> = None;
    lesson.track(&request, &|clip, done, of| bar.show(clip, done, of), &mut |event| {
        bar.clear();
        match event {
            TrackEvent::Note(note) => print::note(note),
            TrackEvent::Tracked(clip) => return print::say(out, summary(clip)),
            TrackEvent::Failed(clip, fault) => {
                if let Some((name, before)) = failed.replace((format!("clip {}", clip.entry.name), fault)) {
                    print::error(Some(&name), &before);
                }
            }
        }
        Ok(())
    })?;
    failed.map_or(Ok(()), |(_, fault)| Err(fault))
}

/// What was found, in a line.
fn summary(clip: &Clip) -> String {
    let rows = clip.record.as_ref().map_or(&[][..], |r| &r.rows);
    let lost = rows.iter().filter(|r| r.confidence <= 0.0).count();
    let mut line = format!("clip {}: {} followed", clip.entry.name, counted(rows.len(), "frame"));
    if lost > 0 {
        line.push_str(&format!(", {} without a face and bridged", counted(lost, "frame")));
    }
    let places = clip.lost();
    if let Some(first) = places.first() {
        line.push_str(&format!("; {} to look at, the first at {:.2} s", counted(places.len(), "place"), first.start));
    }
    line
}

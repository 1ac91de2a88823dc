//! `lianpu track`.

use std::io::Write;
use std::path::{Path, PathBuf};

use super::frames_done::FramesDone;
use super::live;
use super::print::{self, note, say, tell};
use crate::disk::{Fault, Result};
use crate::project::{Lesson, Method, TrackJob, counted};
use crate::track::Options;

/// Follow the face in videos: the seven ratios of every frame into ratios.csv, its eyes, mouth and head into tracks.csv.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// The lesson; its clips with videos that were not followed yet, or have changed since.
    #[arg(value_name = "PROJECT", required_unless_present = "live", conflicts_with_all = ["live", "model"])]
    project: Option<PathBuf>,
    /// One clip of the lesson, followed anew.
    #[arg(long, value_name = "NAME", requires = "project")]
    clip: Option<String>,
    /// By the person's active appearance model, or by regions of eyes and mouth.
    #[arg(long, value_enum, default_value_t, value_name = "HOW")]
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
pub fn run(args: &Args, out: &mut dyn Write) -> Result<()> {
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
    let mut lesson = Lesson::open(project)?;
    let chosen =
        args.clip.as_deref().map(|name| lesson.clip_named(Some(name))).transpose().map_err(Fault::of_the_call)?;
    if let Some(why) = &lesson.read_only {
        return Err(Fault::new(format!("what is found cannot be kept: {why}"))
            .at(project)
            .help("open it where it can be written"));
    }
    if lesson.is_unsaved() {
        return Err(Fault::new("the lesson has changes that were never saved")
            .at(project)
            .help("open it in the studio and save or discard them"));
    }
    let mut failed: Option<Fault> = None;
    for number in wanted(&lesson, chosen, args, options)? {
        let name = lesson.clips[number].entry.name.clone();
        let bar = FramesDone::new(&name);
        let job = TrackJob::of(&lesson, number, args.by, *options);
        let found = job.and_then(|job| job.run(&mut |done, of| bar.show(done, of)));
        drop(bar);
        match found {
            Ok(found) => {
                for note in found.notes.iter().chain(&found.tracked.notes) {
                    print::note(format_args!("clip {name}: {note}"));
                }
                if let Some(change) = lesson.tracked(number, &found.tracked, &found.checksum) {
                    lesson.change(change)?;
                    lesson.save()?;
                }
                say(out, summary(&lesson, number))?;
            }
            Err(fault) => {
                if let Some(before) = failed.replace(fault) {
                    tell(format_args!("error: {before}"));
                }
            }
        }
    }
    failed.map_or(Ok(()), Err)
}

/// Follows the faces of clips whose videos were never followed, in memory only, and says so.
pub(super) fn find_missing(lesson: &mut Lesson, clips: &[usize]) {
    for number in clips.iter().copied().filter(|n| lesson.clips[*n].wants_tracking()).collect::<Vec<_>>() {
        let name = lesson.clips[number].entry.name.clone();
        let bar = FramesDone::new(&name);
        let job = TrackJob::of(lesson, number, Method::default(), Options::default());
        let found = job.and_then(|job| job.run(&mut |done, of| bar.show(done, of)));
        drop(bar);
        match found {
            Ok(found) => {
                lesson.take_tracked(number, found.tracked, &found.checksum);
                note(format_args!(
                    "the face in the video of clip {name} was followed; `lianpu track` keeps what was found"
                ));
            }
            Err(fault) => note(format_args!("the face in the video of clip {name} was not followed: {fault}")),
        }
    }
}

/// The clips that are to be followed. A record that somebody made otherwise is only replaced when that is asked for.
fn wanted(lesson: &Lesson, chosen: Option<usize>, args: &Args, options: &Options) -> Result<Vec<usize>> {
    let mut wanted = Vec::new();
    for (number, clip) in lesson.clips.iter().enumerate() {
        let name = &clip.entry.name;
        if chosen.is_some_and(|c| c != number) {
            continue;
        }
        if clip.video.is_none() {
            if chosen.is_some() {
                return Err(Fault::new(format!("the clip `{name}` has no video"))
                    .at(&clip.folder)
                    .help("put it there as video.mp4, or as pictures in a folder frames/"));
            }
            continue;
        }
        let own = clip.record.is_some() && clip.score.tracked.is_none();
        if own && !args.replace {
            let text =
                format!("clip {name} has ratios of its own, which stay; `--replace` puts the video's in their place");
            note(text);
        } else if chosen.is_some() || own || lesson.is_tracked_anew(number, args.by, options)? {
            wanted.push(number);
        } else {
            tell(format_args!("clip {name}: neither its video nor the calibration has changed, what was found stays"));
        }
    }
    if lesson.clips.iter().all(|c| c.video.is_none()) {
        note("no clip has a video, so there is nothing to follow");
    }
    Ok(wanted)
}

/// What was found, in a line.
fn summary(lesson: &Lesson, number: usize) -> String {
    let clip = &lesson.clips[number];
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

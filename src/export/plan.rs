//! What an export is asked to do, and the list of files that comes of it.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use super::{Dedupe, FrameSet, Shard, poses};
use crate::disk::{Fault, Result};
use crate::drawing::Colour;
use crate::figure::Figure;
use crate::project::{Lesson, Output};
use crate::timeline::Timeline;
use crate::timing::Timing;

/// A form that a clip is exported in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// One SVG file a frame.
    Svg,
    /// One PNG file a frame.
    Png,
    /// The times as a Praat TextGrid.
    TextGrid,
    /// The times as SubRip subtitles.
    Srt,
    /// The times as WebVTT subtitles.
    Vtt,
    /// A table of every frame's pose.
    Poses,
}

impl Format {
    /// All of them.
    pub const ALL: [Self; 6] = [Self::Svg, Self::Png, Self::TextGrid, Self::Srt, Self::Vtt, Self::Poses];

    /// Its name on the command line and in file names.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Png => "png",
            Self::TextGrid => "textgrid",
            Self::Srt => "srt",
            Self::Vtt => "vtt",
            Self::Poses => "poses",
        }
    }

    /// Whether it is one file a frame.
    #[must_use]
    pub const fn is_frames(self) -> bool {
        matches!(self, Self::Svg | Self::Png)
    }
}

impl FromStr for Format {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Self::ALL.into_iter().find(|f| f.name() == text).ok_or_else(|| {
            let known: Vec<&str> = Self::ALL.iter().map(|f| f.name()).collect();
            format!("`{text}` is no export format; formats: {}", known.join(", "))
        })
    }
}

/// What an export is asked to do.
#[derive(Debug, Clone)]
pub struct Request {
    /// The forms.
    pub formats: Vec<Format>,
    /// One clip by name; all where left out.
    pub clip: Option<String>,
    /// Where the files go; `export` in the project where left out.
    pub out: Option<PathBuf>,
    /// Whether the project's name comes between: where several are exported into one place.
    pub by_project: bool,
    /// Which frames.
    pub frames: FrameSet,
    /// Which part of them.
    pub shard: Shard,
    /// Instead of the manifest's size in pixels.
    pub size: Option<[u32; 2]>,
    /// Instead of the manifest's frames a second.
    pub fps: Option<f64>,
    /// Instead of the figure's background; `Some(None)` is transparent.
    pub background: Option<Option<Colour>>,
    /// What is done about frames that are equal.
    pub dedupe: Dedupe,
    /// Threads; 0 for as many as there are processors.
    pub jobs: usize,
}

impl Request {
    /// Everything as the manifest has it.
    #[must_use]
    pub fn new(formats: Vec<Format>) -> Self {
        Self {
            formats,
            clip: None,
            out: None,
            by_project: false,
            frames: FrameSet::default(),
            shard: Shard::WHOLE,
            size: None,
            fps: None,
            background: None,
            dedupe: Dedupe::default(),
            jobs: 0,
        }
    }
}

/// The export of one clip, ready to run.
#[derive(Debug)]
pub struct Job {
    /// The lesson's title.
    pub title: String,
    /// The clip's name.
    pub clip: String,
    /// Frames go here as `000000.png` and so on.
    pub folder: PathBuf,
    /// The frames to write.
    pub frames: Vec<u32>,
    /// Whether these are all frames of the clip, so that later ones are left over from before.
    pub whole: bool,
    /// How many frames the clip has.
    pub count: u32,
    /// Pixels.
    pub size: [u32; 2],
    /// Instead of the figure's background.
    pub background: Option<Option<Colour>>,
    /// What is done about frames that are equal.
    pub dedupe: Dedupe,
    /// Frame forms.
    pub formats: Vec<Format>,
    /// Whole files: where, and what is in them.
    pub texts: Vec<(PathBuf, String)>,
    /// The built score.
    pub timeline: Timeline,
    /// The figure that draws it.
    pub figure: Figure,
}

impl Job {
    /// The file of a frame.
    #[must_use]
    pub fn path_of(&self, frame: u32, format: Format) -> PathBuf {
        self.folder.join(format!("{frame:06}.{}", format.name()))
    }
}

/// Works out the jobs of an export, one a clip. Nothing is written yet.
///
/// # Errors
/// When a clip, figure, size or frame rate cannot be used.
pub fn plan(lesson: &Lesson, request: &Request) -> Result<Vec<Job>> {
    let output = Output {
        fps: request.fps.unwrap_or(lesson.manifest.output.fps),
        size: request.size.unwrap_or(lesson.manifest.output.size),
    };
    crate::project::check_output(&output).map_err(Fault::of_the_call)?;
    let clips = match &request.clip {
        Some(name) => vec![lesson.clip_named(Some(name)).map_err(Fault::of_the_call)?],
        None if lesson.clips.is_empty() => vec![lesson.clip_named(None)?],
        None => (0..lesson.clips.len()).collect(),
    };
    let out = out_folder(lesson, request);
    clips.into_iter().map(|clip| job(lesson, clip, request, &output, &out)).collect()
}

fn out_folder(lesson: &Lesson, request: &Request) -> PathBuf {
    let project = || {
        let full = lesson.root.canonicalize().unwrap_or_else(|_| lesson.root.clone());
        full.file_name().map(PathBuf::from).unwrap_or_default()
    };
    match &request.out {
        Some(out) if request.by_project => out.join(project()),
        Some(out) => out.clone(),
        None => lesson.root.join("export"),
    }
}

fn job(lesson: &Lesson, index: usize, request: &Request, output: &Output, out: &Path) -> Result<Job> {
    let clip = &lesson.clips[index];
    let timeline = lesson.timeline(index, Some(output.fps));
    let count = timeline.frames();
    if let Some(last) = request.frames.last().filter(|last| *last >= count) {
        return Err(Fault::new(format!("frame {last} is beyond the clip `{}`", clip.entry.name))
            .help(format!("it has {count} frames, 0 to {}", count.saturating_sub(1)))
            .of_the_call());
    }
    let frames = request.shard.of(&request.frames.of(count));
    let whole = request.frames.is_all() && request.shard == Shard::WHOLE;
    let texts = request.formats.iter().filter_map(|format| {
        let timing = match format {
            Format::TextGrid => crate::timing::Format::TextGrid,
            Format::Srt => crate::timing::Format::Srt,
            Format::Vtt => crate::timing::Format::WebVtt,
            Format::Poses => {
                let path = out.join(format!("{}.poses.csv", clip.entry.name));
                return Some((path, poses::to_csv(&timeline, &frames)));
            }
            Format::Svg | Format::Png => return None,
        };
        let path = out.join(format!("{}.{}", clip.entry.name, timing.extension()));
        // Subtitles are for an audience, which reads phrases and no markup; the TextGrid is for people who edit times.
        let text = match format {
            Format::TextGrid => crate::timing::write(&clip.timing, timing),
            _ => {
                let phrases = Timing { duration: clip.duration(), tiers: vec![clip.phrases()], guessed: false };
                crate::timing::write(&phrases, timing)
            }
        };
        Some((path, text))
    });
    let texts = texts.collect();
    Ok(Job {
        title: lesson.manifest.title.clone(),
        clip: clip.entry.name.clone(),
        folder: out.join(&clip.entry.name),
        frames,
        whole,
        count,
        size: output.size,
        background: request.background,
        dedupe: request.dedupe,
        texts,
        formats: request.formats.iter().copied().filter(|f| f.is_frames()).collect(),
        timeline,
        figure: lesson.figure_of(&clip.entry)?,
    })
}

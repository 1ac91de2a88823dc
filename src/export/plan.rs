//! What an export is asked to do, and the list of files that comes of it.

use std::path::{Path, PathBuf};

use super::{Dedupe, ExportFault, Format, FrameSet, Share};
use crate::disk::{Fault, Result};
use crate::drawing::Colour;
use crate::figure::{Figure, Widths};
use crate::forms::{captions, poses, said};
use crate::project::{ClipEntry, Lesson, Output};
use crate::timeline::Timeline;
use crate::timing::Timing;

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
    /// What of each clip is to be done, where others do the rest; everything where left out.
    pub shares: Option<Vec<Share>>,
    /// Instead of the manifest's size in pixels.
    pub size: Option<[u32; 2]>,
    /// Instead of the manifest's frames a second.
    pub fps: Option<f64>,
    /// Instead of the figure's background; `Some(None)` is transparent.
    pub background: Option<Option<Colour>>,
    /// How the widths of a line figure's strokes run, instead of as the figure says.
    pub width: Option<Widths>,
    /// What is done about frames that are equal.
    pub dedupe: Dedupe,
    /// Threads; 0 for as many as there are processors.
    pub jobs: usize,
    /// Animated SVG as the thesis writes it: a group a frame (thesis 7.3.2).
    pub thesis: bool,
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
            shares: None,
            size: None,
            fps: None,
            background: None,
            width: None,
            dedupe: Dedupe::default(),
            jobs: 0,
            thesis: false,
        }
    }

    /// The figure of a clip, drawn as it is asked for.
    ///
    /// # Errors
    /// As [`Lesson::figure_of`].
    pub(super) fn figure_of(&self, lesson: &Lesson, clip: &ClipEntry) -> Result<Figure> {
        let figure = lesson.figure_of(clip)?;
        Ok(match self.width {
            Some(widths) => figure.with_widths(widths),
            None => figure,
        })
    }

    /// The share of the clip at a place among those that are asked for.
    pub(super) fn share_of(&self, place: usize) -> Option<&Share> {
        self.shares.as_ref().and_then(|shares| shares.get(place))
    }
}

/// The export of one clip, ready to run.
#[derive(Debug)]
pub struct Job {
    /// The lesson's title.
    pub title: String,
    /// The clip's name.
    pub clip: String,
    /// The folder of the export's manifest, which all files are in.
    pub root: PathBuf,
    /// Frames go here as `000000.png` and so on.
    pub folder: PathBuf,
    /// The frames to write.
    pub frames: Vec<u32>,
    /// Whether frames beyond the clip's end, which an earlier and longer export left, are removed: where all are asked for,
    /// by the part that has the first.
    pub clears: bool,
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

/// Works out the jobs of an export, one a clip that has something to be done. Nothing is written yet.
///
/// # Errors
/// When a clip, figure, size or frame rate cannot be used.
pub fn plan(lesson: &Lesson, request: &Request) -> Result<Vec<Job>> {
    let output = checked_output(lesson, request)?;
    let clips = chosen_clips(lesson, request)?;
    let out = out_folder(lesson, request);
    let mut jobs = Vec::with_capacity(clips.len());
    for (place, clip) in clips.into_iter().enumerate() {
        let share = request.share_of(place);
        if share.is_none_or(|s| !s.is_empty()) {
            jobs.push(job(lesson, clip, request, share, &output, &out)?);
        }
    }
    Ok(jobs)
}

/// The frames that are asked of a clip, by all parts of the export.
///
/// # Errors
/// When the clip has no such frame.
pub(super) fn frames_asked(request: &Request, name: &str, count: u32) -> Result<Vec<u32>> {
    if let Some(last) = request.frames.last().filter(|last| *last >= count) {
        return Err(Fault::of(ExportFault::NoSuchFrame, format!("frame {last} is beyond the clip `{name}`"))
            .help(format!("it has {count} frames, 0 to {}", count.saturating_sub(1)))
            .of_the_call());
    }
    Ok(request.frames.of(count))
}

/// A file that carries a clip's times as text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Times {
    TextGrid,
    Vtt,
    Srt,
    KaraokeSrt,
    Poses,
}

/// Those that are asked for, and where each goes.
pub(super) fn texts_of<'a>(
    request: &'a Request,
    clip: &'a str,
    out: &'a Path,
) -> impl Iterator<Item = (Times, PathBuf)> + 'a {
    let texts = |format: &Format| match format {
        Format::TextGrid => &[(Times::TextGrid, "TextGrid")][..],
        Format::Vtt => &[(Times::Vtt, "vtt")],
        Format::Srt => &[(Times::Srt, "srt"), (Times::KaraokeSrt, "karaoke.srt")],
        Format::Poses => &[(Times::Poses, "poses.csv")],
        _ => &[],
    };
    let all = request.formats.iter().flat_map(texts);
    all.map(move |(text, ending)| (*text, out.join(format!("{clip}.{ending}"))))
}

/// Size and frame rate: the manifest's, or those asked for.
///
/// # Errors
/// When they cannot be.
pub(super) fn checked_output(lesson: &Lesson, request: &Request) -> Result<Output> {
    let output = Output {
        fps: request.fps.unwrap_or(lesson.manifest.output.fps),
        size: request.size.unwrap_or(lesson.manifest.output.size),
    };
    crate::project::check_output(&output).map_err(Fault::of_the_call)?;
    Ok(output)
}

/// The clips that are asked for, by number.
///
/// # Errors
/// When there is none.
pub(super) fn chosen_clips(lesson: &Lesson, request: &Request) -> Result<Vec<usize>> {
    Ok(match &request.clip {
        Some(name) => vec![lesson.clip_named(Some(name)).map_err(Fault::of_the_call)?],
        None if lesson.clips.is_empty() => vec![lesson.clip_named(None)?],
        None => (0..lesson.clips.len()).collect(),
    })
}

/// The folder that an export's manifest lies in: of one lesson its own, or one for several.
pub(super) fn root_folder(lesson: &Lesson, request: &Request) -> PathBuf {
    request.out.clone().unwrap_or_else(|| lesson.root.join("export"))
}

/// Where the files go.
pub(super) fn out_folder(lesson: &Lesson, request: &Request) -> PathBuf {
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

fn job(
    lesson: &Lesson,
    index: usize,
    request: &Request,
    share: Option<&Share>,
    output: &Output,
    out: &Path,
) -> Result<Job> {
    let clip = &lesson.clips[index];
    let timeline = lesson.timeline(index, Some(output.fps));
    let count = timeline.frames();
    let asked = frames_asked(request, &clip.entry.name, count)?;
    let frames = match share {
        Some(share) => asked.get(share.frames.start as usize..share.frames.end as usize).unwrap_or_default().to_vec(),
        None => asked.clone(),
    };
    let whole_files = share.is_none_or(|s| s.whole_files);
    let texts = texts_of(request, &clip.entry.name, out).filter(|_| whole_files).map(|(text, path)| {
        // Subtitles are for an audience, which reads phrases; the TextGrid is for people who edit times.
        let text = match text {
            Times::TextGrid => crate::timing::write(&clip.timing, crate::timing::Format::TextGrid),
            Times::Vtt => captions::vtt(&said::phrases(clip)),
            Times::KaraokeSrt => captions::karaoke_srt(&said::phrases(clip)),
            Times::Srt => {
                let phrases = Timing { duration: clip.duration(), tiers: vec![said::captions(clip)], guessed: false };
                crate::timing::write(&phrases, crate::timing::Format::Srt)
            }
            Times::Poses => poses::to_csv(&timeline, &asked),
        };
        (path, text)
    });
    let texts = texts.collect();
    Ok(Job {
        title: lesson.manifest.title.clone(),
        clip: clip.entry.name.clone(),
        root: root_folder(lesson, request),
        folder: out.join(&clip.entry.name),
        frames,
        clears: request.frames.is_all() && whole_files,
        count,
        size: output.size,
        background: request.background,
        dedupe: request.dedupe,
        texts,
        formats: request.formats.iter().copied().filter(|f| f.is_frames()).collect(),
        timeline,
        figure: request.figure_of(lesson, &clip.entry)?,
    })
}

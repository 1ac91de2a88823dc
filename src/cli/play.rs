//! `lianpu play`.

use std::io::IsTerminal;
use std::path::{Path, PathBuf};

use super::frames_done::FramesDone;
use super::print;
use crate::disk::{self, Fault, MAX_TEXT_BYTES, Result};
use crate::figure::{Figure, LineFigure};
use crate::pose::MouthPreset;
use crate::project::{Lesson, prepare};
use crate::ratios::{Record, Tracks, Whole, import, is_lpr};
use crate::studio::{self, Show};
use crate::timeline::{Score, Sources, Timeline};

/// Play a clip's face, or a ratio record, in the terminal.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The project; with --ratios, whose face shows them.
    #[arg(value_name = "PROJECT", required_unless_present_any = ["ratios", "of"])]
    project: Option<PathBuf>,
    /// The same by name.
    #[arg(long = "project", value_name = "PROJECT", conflicts_with = "project", hide = true)]
    of: Option<PathBuf>,
    /// The clip; the first where left out.
    #[arg(long, conflicts_with = "ratios")]
    clip: Option<String>,
    /// A ratio record: ratios.csv, its JSON, a compact record, or what OpenFace, mediapipe or ARKit wrote; - draws the first
    /// three from standard input as they arrive.
    #[arg(long, value_name = "FILE")]
    ratios: Option<PathBuf>,
    /// The figure that shows a ratio record: line or cat.
    #[arg(long, value_name = "NAME", requires = "ratios", conflicts_with_all = ["project", "of"])]
    figure: Option<String>,
    /// The face of the project that shows a ratio record; its first where left out.
    #[arg(long, value_name = "NAME", requires = "ratios")]
    face: Option<String>,
}

/// Plays until it is left.
///
/// # Errors
/// Of the call: no terminal, a figure, clip or face that is not there. Of the input: a lesson or record that cannot be
/// read; a record that is cut or damaged, after what there is of it was played.
pub(crate) fn run(args: &Args) -> Result<()> {
    if !std::io::stdout().is_terminal() {
        return Err(Fault::new("playing needs a terminal").help("use `lianpu export` for files").of_the_call());
    }
    let project = args.project.as_ref().or(args.of.as_ref());
    match (&args.ratios, project) {
        (Some(path), _) => {
            let figure = figure(args, project.map(PathBuf::as_path))?;
            if path == Path::new("-") { from_pipe(figure) } else { from_file(path, figure) }
        }
        (None, Some(project)) => {
            let mut lesson = Lesson::read(project)?;
            let clip = lesson.clip_named(args.clip.as_deref()).map_err(Fault::of_the_call)?;
            let bar = FramesDone::default();
            for note in prepare(&mut lesson, &[clip], &|clip, done, of| bar.show(clip, done, of)) {
                print::note(&note);
            }
            drop(bar);
            studio::play(Show::of_clip(&lesson, clip)?)
        }
        (None, None) => Err(Fault::new("there is nothing to play").help("name a project").of_the_call()),
    }
}

/// Who shows a record: a built-in figure, or a lesson's own.
fn figure(args: &Args, project: Option<&Path>) -> Result<Figure> {
    let Some(project) = project else {
        if args.face.is_some() {
            return Err(Fault::new("`--face` needs a project").help("name it: --project PATH").of_the_call());
        }
        let name = args.figure.as_deref().unwrap_or("line");
        return LineFigure::built_in(name).map(Figure::from).map_err(Fault::of_the_call);
    };
    let lesson = Lesson::read(project)?;
    let faces = || lesson.manifest.faces.iter().map(|f| f.name.clone());
    if let Some(name) = args.face.as_ref().filter(|name| !faces().any(|f| f == **name)) {
        let names = faces().collect::<Vec<_>>().join(", ");
        let help = if names.is_empty() { "it has none".to_owned() } else { format!("its faces are {names}") };
        return Err(Fault::new(format!("the project has no face `{name}`")).at(project).help(help).of_the_call());
    }
    lesson.figure_of_face(args.face.as_deref())
}

/// A record that is there whole.
fn from_file(path: &Path, figure: Figure) -> Result<()> {
    let bytes = disk::read_bytes(path, MAX_TEXT_BYTES)?;
    let (record, tracks, damage, notes) = if is_lpr(&bytes) {
        let whole = Whole::read(&bytes[..]).map_err(|f| f.at(path))?;
        (whole.record, whole.tracks, whole.damage, Vec::new())
    } else {
        let (record, tracks, notes) = import::parse(&bytes, None).map_err(|f| f.at(path))?;
        (record, tracks, None, notes)
    };
    let frames = record.rows.len() as u64;
    let title = path.display().to_string();
    studio::play(Show { title, timeline: timeline(&record, tracks.as_ref()), figure, captions: Vec::new() })?;
    for note in notes {
        print::note(note);
    }
    damage.map_or(Ok(()), |fault| Err(after_playing(&fault, frames).at(path)))
}

/// A record that arrives.
fn from_pipe(figure: Figure) -> Result<()> {
    if std::io::stdin().is_terminal() {
        let help = "pipe a record into it: lianpu track --live … | lianpu play --ratios -";
        return Err(Fault::new("standard input is the terminal itself").help(help).of_the_call());
    }
    let played = studio::play_live("ratios", figure, std::io::stdin())?;
    let said = |fault: Fault| match played.frames {
        0 => fault,
        frames => after_playing(&fault, frames),
    };
    played.damage.map_or(Ok(()), |fault| Err(said(fault).at("standard input")))
}

/// What was wrong with a record, and how much of it was played.
fn after_playing(fault: &Fault, frames: u64) -> Fault {
    let count = if frames == 1 { "1 frame was played".to_owned() } else { format!("{frames} frames were played") };
    Fault::new(format!("{}; {count}", fault.what())).help(fault.next_step())
}

fn timeline(record: &Record, tracks: Option<&Tracks>) -> Timeline {
    Timeline::build(&Sources {
        duration: record.duration(),
        fps: record.fps().clamp(1.0, 240.0),
        spoken: &[],
        record: Some(record),
        tracks,
        score: &Score::default(),
        mouths: MouthPreset::default(),
    })
}

//! `lianpu play`.

use std::io::{IsTerminal, Read};
use std::path::{Path, PathBuf};

use crate::disk::{Fault, MAX_TEXT_BYTES, Result, clean, read_text};
use crate::emotion::Record;
use crate::figure::LineFigure;
use crate::pose::MouthPreset;
use crate::project::Lesson;
use crate::studio::{self, Show};
use crate::timeline::{Score, Sources, Timeline};

/// Play a clip's face, or a ratio record, in the terminal.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// The project.
    #[arg(value_name = "PROJECT", required_unless_present = "ratios", conflicts_with = "ratios")]
    project: Option<PathBuf>,
    /// The clip; the first where left out.
    #[arg(long)]
    clip: Option<String>,
    /// A ratio record instead of a project; - reads it from standard input.
    #[arg(long, value_name = "FILE")]
    ratios: Option<PathBuf>,
    /// The figure that shows a ratio record: line or cat.
    #[arg(long, value_name = "NAME", default_value = "line")]
    figure: String,
}

/// Plays until it is left.
pub fn run(args: &Args) -> Result<()> {
    let show = match (&args.ratios, &args.project) {
        (Some(path), _) => of_record(path, &args.figure)?,
        (None, Some(project)) => {
            let mut lesson = Lesson::read(project)?;
            let clip = lesson.clip_named(args.clip.as_deref()).map_err(Fault::of_the_call)?;
            super::align::find_missing(&mut lesson, &[clip]);
            Show::of_clip(&lesson, clip)?
        }
        (None, None) => return Err(Fault::new("there is nothing to play").help("name a project").of_the_call()),
    };
    if !std::io::stdout().is_terminal() {
        return Err(Fault::new("playing needs a terminal").help("use `lianpu export` for files").of_the_call());
    }
    studio::play(show)
}

fn of_record(path: &Path, figure: &str) -> Result<Show> {
    let from_pipe = path == Path::new("-");
    let text = if from_pipe {
        let mut bytes = Vec::new();
        let mut input = std::io::stdin().lock().take(MAX_TEXT_BYTES);
        input.read_to_end(&mut bytes).map_err(|e| Fault::io("cannot read it", "standard input", e))?;
        clean(&String::from_utf8_lossy(&bytes))
    } else {
        read_text(path)?
    };
    let title = if from_pipe { "ratios".into() } else { path.display().to_string() };
    let record = Record::parse(&text).map_err(|f| f.at(if from_pipe { Path::new("standard input") } else { path }))?;
    let timeline = Timeline::build(&Sources {
        duration: record.duration(),
        fps: 25.0,
        spoken: &[],
        record: Some(&record),
        tracks: None,
        score: &Score::default(),
        mouths: MouthPreset::default(),
    });
    let figure = LineFigure::built_in(figure).map_err(Fault::of_the_call)?;
    Ok(Show { title, timeline, figure: figure.into(), captions: Vec::new() })
}

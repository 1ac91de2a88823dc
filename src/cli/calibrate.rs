//! `lianpu calibrate`.

use std::io::Write;
use std::path::PathBuf;

use serde_json::json;

use super::print::say;
use crate::calibration::{Calibrated, Source};
use crate::disk::{Fault, Result, printable_json};
use crate::pose::Emotion;
use crate::project::Lesson;

/// Learn a person's seven emotions from photos: faces/NAME/neutral.png, happy.png, anger.png, disgust.png, sadness.png,
/// fear.png, surprised.png, as many as there are. What it finds lasts for every clip of that person.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The lesson.
    #[arg(value_name = "PROJECT")]
    project: PathBuf,
    /// Which of its faces; the first where left out.
    #[arg(long, value_name = "NAME")]
    face: Option<String>,
    /// How good it is, as JSON.
    #[arg(long)]
    json: bool,
}

/// Calibrates a face and prints how good it is.
pub(crate) fn run(args: &Args, out: &mut dyn Write) -> Result<()> {
    let mut lesson = Lesson::open_to_write(&args.project, "the calibration")?;
    super::note_state(&lesson);
    let number = lesson.face_named(args.face.as_deref()).map_err(Fault::of_the_call)?;
    let (kept, written) = lesson.calibrate(number)?;
    let face = &lesson.faces[number];
    let made = &kept.made;
    if args.json {
        return say(out, printable_json(&as_json(&face.entry.name, made)));
    }
    let text = in_words(made).join("\n");
    say(out, text)?;
    let names: Vec<_> = written.iter().filter_map(|p| p.file_name()).map(|n| n.to_string_lossy()).collect();
    match names.as_slice() {
        [] => say(out, format_args!("face {}: nothing has changed", face.entry.name)),
        names => say(out, format_args!("face {}: wrote {}", face.entry.name, names.join(", "))),
    }
}

/// How good a calibration is, line by line.
fn in_words(made: &Calibrated) -> Vec<String> {
    let quality = &made.quality;
    let mut lines = vec![format!("{:<10} {:<22} {:>8} {:>8}", "shot", "points", "residual", "strength")];
    for ((emotion, shape), shot) in Emotion::ALL.iter().zip(made.calibration.shapes()).zip(&quality.shots) {
        let how = match shape.source {
            Source::Marked if *emotion == Emotion::Neutral => "given".to_owned(),
            Source::Marked => "marked by hand".to_owned(),
            Source::Found(sure) => format!("found, {:.0} % sure", 100.0 * sure),
            Source::Modelled => "no shot: modelled".to_owned(),
        };
        let residual = match shape.source {
            Source::Modelled => String::new(),
            _ => format!("{:.1} %", shot.residual),
        };
        lines.push(format!("{:<10} {how:<22} {residual:>8} {:>6.1} %", emotion.name(), shot.strength));
    }
    let (a, b, degrees) = quality.nearest;
    lines.push(format!("hardest to tell apart: {a} and {b}, {degrees:.0} degrees; condition {:.1}", quality.condition));
    lines.extend(quality.retake.iter().map(|r| format!("retake first: {}: {}", r.emotion, r.why)));
    lines.extend(quality.notes.iter().map(|n| format!("note: {n}")));
    lines
}

fn as_json(name: &str, made: &Calibrated) -> String {
    json!({
        "face": name,
        "points": made.calibration.binding().count(),
        "quality": made.quality,
    })
    .to_string()
}

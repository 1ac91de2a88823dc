//! The commands: a thin face on the rooms. Every command reads its arguments, calls a room and prints; it decides
//! nothing that a library user could want decided the same way.

mod aam;
mod align;
mod calibrate;
mod check;
mod completions;
mod convert;
mod export;
mod face;
mod farm;
mod frames_done;
mod live;
#[cfg(feature = "studio")]
mod keys;
mod merge;
mod new;
mod output;
#[cfg(feature = "studio")]
mod play;
mod plot;
mod print;
#[cfg(feature = "studio")]
mod studio;
mod syllables;
mod times;
mod track;
mod wording;

use std::io::Write;

use clap::{CommandFactory, Parser, Subcommand};

use crate::disk::{Fault, Result, suggestion};
use crate::project::Lesson;

/// A terminal studio that makes a face talk.
#[derive(Debug, Parser)]
#[command(name = "lianpu", version, about, args_conflicts_with_subcommands = true)]
pub struct Cli {
    /// A folder that holds projects, or a project: opens the studio on it.
    #[arg(value_name = "FOLDER")]
    folder: Option<std::path::PathBuf>,

    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Make a lesson from a photo, a recording and its script, from a video, from times, or from ratios.
    New(new::Args),
    /// Find when each syllable of a script is spoken in a recording.
    Align(align::Args),
    /// Say what lessons have, lack, and have wrong.
    Check(check::Args),
    Export(export::Args),
    Merge(merge::Args),
    Farm(farm::Args),
    /// Find the points of a face in its photo, for its cartoon.
    Face(face::Args),
    /// Learn a person's seven emotions from photos, for videos of that person.
    Calibrate(calibrate::Args),
    /// Follow the face in videos: seven ratios, eyes, mouth and head of every frame.
    Track(track::Args),
    /// Train, fit and look at active appearance models of faces.
    Aam(aam::Args),
    #[cfg(feature = "studio")]
    /// Play a clip's face in the terminal.
    Play(play::Args),
    /// Draw charts of a clip: ratios, change, timeline, faces, a frame.
    Plot(plot::Args),
    /// Turn a timing file or a ratio record into another format.
    Convert(convert::Args),
    /// Print the syllables of a text with their readings and mouth shapes.
    Syllables(syllables::Args),
    /// Print the keys of the studio and of the player.
    #[cfg(feature = "studio")]
    Keys(keys::Args),
    /// Print what makes a shell complete this program's words.
    Completions(completions::Args),
}

/// What is wrong with a call whose first word is neither a command nor a folder that is there: most likely the command
/// was mistyped, and the parser would speak of folders.
#[must_use]
pub fn mistyped(first: Option<&std::ffi::OsStr>) -> Option<Fault> {
    let word = first?.to_str()?;
    let program = Cli::command();
    let names: Vec<&str> = program.get_subcommands().map(clap::Command::get_name).collect();
    let is_known = word.starts_with('-') || word == "help" || names.contains(&word);
    if is_known || std::path::Path::new(word).exists() || word.contains(std::path::MAIN_SEPARATOR) {
        return None;
    }
    Some(
        Fault::new(format!("`{word}` is neither a command nor a folder here"))
            .help(suggestion(word, "commands", &names))
            .of_the_call(),
    )
}

/// The lessons that paths name: a lesson itself, or all those in a folder that holds some.
pub(crate) fn lessons(paths: &[std::path::PathBuf]) -> Vec<std::path::PathBuf> {
    let of = |path: &std::path::PathBuf| match crate::project::projects_in(path) {
        Ok(found) if !found.is_empty() => found,
        // Whoever reads it says what is wrong with it.
        _ => vec![path.clone()],
    };
    paths.iter().flat_map(of).collect()
}

/// The calibration of a face's folder as its shots are now; what there is to say of it is said.
pub(crate) fn calibration_of(folder: &std::path::Path) -> Result<crate::calibration::Calibration> {
    let (kept, notes) = crate::calibration::Kept::of(folder)?;
    notes.iter().for_each(print::note);
    Ok(kept.made.calibration)
}

/// Prints the fault that ends a call, on standard error.
pub fn report(fault: &Fault) {
    print::error(None, fault);
}

/// Runs one call of the program.
///
/// # Errors
/// With what went wrong; [`Fault::is_of_the_call`] tells whether the call (exit code 2) or the input (1) was at fault.
pub fn run(cli: &Cli, out: &mut dyn Write) -> Result<()> {
    match &cli.command {
        Some(Command::New(args)) => new::run(args, out),
        Some(Command::Align(args)) => align::run(args, out),
        Some(Command::Check(args)) => check::run(args, out),
        Some(Command::Export(args)) => export::run(args, out),
        Some(Command::Merge(args)) => merge::run(args, out),
        Some(Command::Farm(args)) => farm::run(args, out),
        Some(Command::Face(args)) => face::run(args, out),
        Some(Command::Calibrate(args)) => calibrate::run(args, out),
        Some(Command::Track(args)) => track::run(args, out),
        Some(Command::Aam(args)) => aam::run(args, out),
        #[cfg(feature = "studio")]
        Some(Command::Play(args)) => play::run(args),
        #[cfg(feature = "studio")]
        Some(Command::Keys(args)) => keys::run(args, out),
        Some(Command::Plot(args)) => plot::run(args, out),
        Some(Command::Convert(args)) => convert::run(args, out),
        Some(Command::Syllables(args)) => syllables::run(args, out),
        Some(Command::Completions(args)) => completions::run(args, out),
        #[cfg(feature = "studio")]
        None if studio::is_possible() => studio::open(cli.folder.as_deref()),
        // A script that calls it by mistake must not wait for ever.
        None => {
            let help = Cli::command().render_help();
            write!(out, "{help}").map_err(output_fault)
        }
    }
}

/// Parses the name of one of a few values.
pub(crate) fn one_of<T: Copy + Send + Sync + 'static, const N: usize>(
    all: [T; N],
    name: fn(T) -> &'static str,
) -> impl clap::builder::TypedValueParser<Value = T> {
    use clap::builder::{PossibleValuesParser, TypedValueParser};
    // The parser lets nothing through but these names.
    PossibleValuesParser::new(all.map(name))
        .map(move |word| all.into_iter().find(|v| name(*v) == word).unwrap_or(all[0]))
}

/// Reports a save that was cut off, and changes of an earlier session that are in no file.
fn note_state(lesson: &Lesson) {
    lesson.state_notes().iter().for_each(print::note);
}

/// What a failed write to standard output is called.
pub(crate) fn output_fault(error: std::io::Error) -> Fault {
    Fault::io("cannot write the output", "standard output", error)
}

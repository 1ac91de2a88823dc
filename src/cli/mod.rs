//! The commands: a thin face on the rooms. Every command reads its arguments, calls a room and prints; it decides
//! nothing that a library user could want decided the same way.

mod convert;

use std::io::Write;
use std::path::Path;

use clap::{Parser, Subcommand};

use crate::disk::{Fault, Result};
use crate::studio;

/// A terminal studio that makes a face talk.
#[derive(Debug, Parser)]
#[command(name = "lianpu", version, about, arg_required_else_help = false, args_conflicts_with_subcommands = true)]
pub struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    /// The folder that holds lessons, or is one [default: projects]
    folder: Option<std::path::PathBuf>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Turn a timing file or a ratio record into another format.
    Convert(convert::Args),
}

/// Runs one call of the program and says how it ended: 0 done, 1 the input was at fault, 2 the call was.
pub fn run(cli: &Cli, out: &mut dyn Write) -> Result<()> {
    match &cli.command {
        Some(Command::Convert(args)) => convert::run(args, out),
        None => open_studio(cli.folder.as_deref(), out),
    }
}

/// The studio; without a terminal the help, so that a script that calls it by mistake does not wait for ever.
fn open_studio(folder: Option<&Path>, out: &mut dyn Write) -> Result<()> {
    use clap::CommandFactory;
    use std::io::IsTerminal;
    if !(std::io::stdin().is_terminal() && std::io::stdout().is_terminal()) {
        return write!(out, "{}", Cli::command().render_long_help()).map_err(output_fault);
    }
    let not_yet = |_, _: &dyn Fn(studio::Progress), _: &std::sync::atomic::AtomicBool| {
        Err(Fault::new("this version cannot export from the studio").help("use `lianpu export`"))
    };
    studio::run(folder.unwrap_or(Path::new("projects")), Box::new(not_yet))
}

/// What a failed write to standard output is called.
pub(crate) fn output_fault(error: std::io::Error) -> Fault {
    Fault::io("cannot write the output", "standard output", error)
}

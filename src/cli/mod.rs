//! The commands: a thin face on the rooms. Every command reads its arguments, calls a room and prints; it decides
//! nothing that a library user could want decided the same way.

mod syllables;

use std::io::Write;

use clap::{Parser, Subcommand};

use crate::disk::{Fault, Result};

/// A terminal studio that makes a face talk.
#[derive(Debug, Parser)]
#[command(name = "lianpu", version, about, arg_required_else_help = false)]
pub struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
enum Command {
    Syllables(syllables::Args),
}

/// Runs one call of the program and says how it ended: 0 done, 1 the input was at fault, 2 the call was.
pub fn run(cli: &Cli, out: &mut dyn Write) -> Result<()> {
    match &cli.command {
        Some(Command::Syllables(args)) => syllables::run(args, out),
        None => Ok(()),
    }
}

/// What a failed write to standard output is called.
pub(crate) fn output_fault(error: std::io::Error) -> Fault {
    Fault::io("cannot write the output", "standard output", error)
}

//! `lianpu completions`.

use std::io::Write;

use clap::CommandFactory;

use super::{Cli, output_fault};
use crate::disk::Result;

/// Print what makes a shell complete this program's words.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// bash, zsh, fish, elvish or powershell.
    shell: clap_complete::Shell,
}

/// Prints the completions.
pub(crate) fn run(args: &Args, out: &mut dyn Write) -> Result<()> {
    let mut text = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "lianpu", &mut text);
    out.write_all(&text).map_err(output_fault)
}

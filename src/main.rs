//! The program: parses the call, runs it, and maps faults to exit codes.

use std::borrow::Cow;
use std::io::{self, BufWriter, Write};
use std::process::ExitCode;

use clap::Parser;
use lianpu::cli::{self, Cli};
use lianpu::disk::{Fault, printable};

fn main() -> ExitCode {
    let mut out = BufWriter::new(io::stdout().lock());
    let done = cli::mistyped(std::env::args_os().nth(1).as_deref())
        .map_or(Ok(()), Err)
        .and_then(|()| cli::run(&parsed(), &mut out))
        .and_then(|()| out.flush().map_err(|e| Fault::io("cannot write the output", "standard output", e)));
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(fault) if is_closed_pipe(&fault) => ExitCode::SUCCESS,
        Err(fault) => {
            cli::report(&fault);
            ExitCode::from(if fault.is_of_the_call() { 2 } else { 1 })
        }
    }
}

/// The call; where it cannot be read, that is said and the program ends. The words of a call may be names of files that a
/// shell put there, so they are printed as other names are.
fn parsed() -> Cli {
    Cli::try_parse().unwrap_or_else(|error| {
        let text = error.to_string();
        match printable(&text) {
            Cow::Borrowed(_) => error.exit(),
            Cow::Owned(clean) => {
                eprint!("{clean}");
                std::process::exit(error.exit_code());
            }
        }
    })
}

/// A reader that has seen enough, such as `head`, is no error.
fn is_closed_pipe(fault: &Fault) -> bool {
    std::error::Error::source(fault)
        .and_then(|e| e.downcast_ref::<io::Error>())
        .is_some_and(|e| e.kind() == io::ErrorKind::BrokenPipe)
}

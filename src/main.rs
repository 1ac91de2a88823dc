//! The program: parses the call, runs it, and maps faults to exit codes.

use std::io::{self, BufWriter, Write};
use std::process::ExitCode;

use clap::Parser;
use lianpu::cli::{self, Cli};
use lianpu::disk::Fault;

fn main() -> ExitCode {
    let mut out = BufWriter::new(io::stdout().lock());
    let done = cli::mistyped(std::env::args_os().nth(1).as_deref())
        .map_or(Ok(()), Err)
        .and_then(|()| cli::run(&Cli::parse(), &mut out))
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

/// A reader that has seen enough, such as `head`, is no error.
fn is_closed_pipe(fault: &Fault) -> bool {
    std::error::Error::source(fault)
        .and_then(|e| e.downcast_ref::<io::Error>())
        .is_some_and(|e| e.kind() == io::ErrorKind::BrokenPipe)
}

//! The lines that commands print. Each goes through [`printable`], for names and messages may come from a stranger's
//! project; what is asked for as a file's content is written as it is.

use std::fmt::Display;
use std::io::Write;

use serde_json::Value;

use super::output_fault;
use super::wording::{word, worded};
use crate::disk::{Fault, Message, Result, printable, printable_json};

/// A line on standard output.
pub(super) fn say(out: &mut dyn Write, text: impl Display) -> Result<()> {
    writeln!(out, "{}", printable(&text.to_string())).map_err(output_fault)
}

/// A value as a line of JSON on standard output.
pub(super) fn say_json(out: &mut dyn Write, value: &Value) -> Result<()> {
    say(out, printable_json(&value.to_string()))
}

/// A line on standard error.
#[allow(clippy::needless_pass_by_value, reason = "called with what was just formatted")]
pub(super) fn tell(text: impl Display) {
    eprintln!("{}", printable(&text.to_string()));
}

/// A note to the author on standard error.
pub(super) fn note(note: impl Into<Message>) {
    tell(format_args!("note: {}", worded(note)));
}

/// A fault on standard error, with whose it is where several were worked on.
pub(super) fn error(whose: Option<&str>, fault: &Fault) {
    let whose = whose.map(|name| format!("{name}: ")).unwrap_or_default();
    tell(format_args!("error: {whose}{}", fault.worded(&word)));
}

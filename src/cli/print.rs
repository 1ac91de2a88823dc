//! The lines that commands print. Each goes through [`printable`], for names and messages may come from a stranger's
//! project; what is asked for as a file's content is written as it is.

use std::fmt::Display;
use std::io::Write;

use serde_json::Value;

use super::output_fault;
use crate::disk::{Result, printable, printable_json};

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

/// Something that the author should know, on standard error.
pub(super) fn note(text: impl Display) {
    tell(format_args!("note: {text}"));
}

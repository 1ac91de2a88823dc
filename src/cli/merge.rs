//! `lianpu merge`.

use std::io::Write;
use std::path::PathBuf;

use super::print::{note, say, say_json, tell};
use crate::disk::{Result, shown};
use crate::export::merge;

/// Join the parts of an export that was divided among machines, and check that nothing is missing or damaged.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The folder that the parts were exported into.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// The result as a line of JSON.
    #[arg(long)]
    json: bool,
}

/// Joins the parts and prints where the manifest of the whole is.
///
/// # Errors
/// With what is missing or differs, and the part to be run again.
pub(crate) fn run(args: &Args, out: &mut dyn Write) -> Result<()> {
    let merged = merge(&args.folder)?;
    if let Some(text) = &merged.note {
        note(text.as_str());
    }
    if args.json {
        let line = serde_json::json!({ "path": merged.path.to_string_lossy(), "parts": merged.parts, "files": merged.files,
            "bytes": merged.bytes });
        return say_json(out, &line);
    }
    say(out, shown(&merged.path))?;
    let parts = if merged.parts == 1 { "1 part".to_owned() } else { format!("{} parts", merged.parts) };
    tell(format_args!("{parts}, {} files, all there and as they were written", merged.files));
    Ok(())
}

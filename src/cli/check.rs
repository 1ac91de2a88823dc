//! `lianpu check`.

use std::io::Write;
use std::path::PathBuf;

use super::print::say;
use super::wording;
use crate::disk::{Fault, Result, printable_json, shown};
use crate::project::{Finding, check, check_quality};

/// Say what lessons have, lack, and have wrong. Exit code 1 if anything is wrong.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The projects, or folders of them.
    #[arg(value_name = "PROJECT", required = true)]
    projects: Vec<PathBuf>,
    /// Also how good the recordings are and where times are doubtful, place by place.
    #[arg(long)]
    quality: bool,
    /// One JSON object a finding.
    #[arg(long)]
    json: bool,
}

/// Checks every project and prints what it finds.
pub(crate) fn run(args: &Args, out: &mut dyn Write) -> Result<()> {
    let mut wrong = 0;
    for project in &super::lessons(&args.projects) {
        if !args.json {
            say(out, shown(project))?;
        }
        for finding in if args.quality { check_quality(project) } else { check(project) } {
            let (kind, text) = match &finding {
                Finding::Fine(text) => ("fine", text.clone()),
                Finding::Odd(text) => ("odd", text.worded(&wording::word)),
                Finding::Wrong(fault) => {
                    wrong += 1;
                    ("wrong", fault.worded(&wording::word))
                }
            };
            let line = if args.json {
                let mut line =
                    serde_json::json!({ "project": project.to_string_lossy(), "finding": kind, "text": text });
                if let Finding::Wrong(fault) = &finding {
                    line["text"] = fault.what().into();
                    line["file"] = fault.path().map(|p| p.display().to_string()).into();
                    line["line"] = fault.line_number().into();
                    line["help"] = fault.advice().worded(&wording::word).into();
                }
                printable_json(&line.to_string()).into_owned()
            } else {
                let mark = match kind {
                    "fine" => "  ok     ",
                    "odd" => "  note   ",
                    _ => "  WRONG  ",
                };
                format!("{mark}{}", text.replace('\n', "\n         "))
            };
            say(out, line)?;
        }
    }
    match wrong {
        0 => Ok(()),
        1 => Err(Fault::new("one thing is wrong").help("it is marked WRONG above")),
        n => Err(Fault::new(format!("{n} things are wrong")).help("they are marked WRONG above")),
    }
}

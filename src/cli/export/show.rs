//! How far an export is, on the terminal or as lines of JSON, and what came of it.

use std::io::{IsTerminal, Write};
use std::path::Path;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};
use serde_json::json;

use crate::cli::print::{self, tell};
use crate::disk::{Result, printable_json, shown};
use crate::export::{Exported, Progress, Step};

const FRAMES: &str = "{msg} {bar:30} {pos}/{len} frames  {per_sec}  {eta} left";
const TRACKING: &str = "{msg} {wide_bar} {pos}/{len} frames {eta}";

/// Shows one lesson's export.
pub(super) struct Show {
    json: bool,
    bar: ProgressBar,
}

impl Show {
    pub(super) fn new(json: bool) -> Self {
        if json || !std::io::stderr().is_terminal() {
            return Self { json, bar: ProgressBar::hidden() };
        }
        let bar = ProgressBar::new(0);
        bar.enable_steady_tick(Duration::from_millis(200));
        Self { json, bar }
    }

    /// Begins the bar anew.
    fn begin(&self, template: &str, message: String) {
        if let Ok(style) = ProgressStyle::with_template(template) {
            self.bar.set_style(style);
        }
        self.bar.reset();
        self.bar.set_message(message);
    }

    /// Shows a step; may be called from any thread.
    pub(super) fn step(&self, step: Step<'_>) {
        let (what, clip, Progress { done, of }) = match step {
            Step::Frames(progress) => (None, None, progress),
            Step::Whole(whole, progress) => (Some(whole.format.name()), whole.clip.as_deref(), progress),
            Step::Tracking { clip, done, of } => return self.tracking(clip, done, of),
        };
        if !self.json {
            if done == 0 {
                self.begin(FRAMES, what.unwrap_or_default().to_owned());
            }
            self.bar.set_length(of.into());
            self.bar.set_position(done.into());
            return;
        }
        // A line a hundredth, so that a log stays readable.
        if done == of || done.is_multiple_of((of / 100).max(1)) {
            let mut line = json!({ "done": done, "of": of });
            if let Some(what) = what {
                line["making"] = what.into();
                line["clip"] = clip.into();
            }
            tell(printable_json(&line.to_string()));
        }
    }

    /// A log has no use for how far a face is followed.
    fn tracking(&self, clip: &str, done: usize, of: Option<usize>) {
        if done <= 1 {
            self.begin(TRACKING, format!("following the face in {clip}"));
        }
        if let Some(of) = of {
            self.bar.set_length(of as u64);
        }
        self.bar.set_position(done as u64);
    }

    /// Takes the bar away.
    pub(super) fn clear(&self) {
        self.bar.finish_and_clear();
    }

    /// Prints where everything is; where there are several lessons, of which one.
    pub(super) fn result(&self, project: &Path, several: bool, exported: &Exported, out: &mut dyn Write) -> Result<()> {
        let mut say = |text: String| print::say(out, text);
        for place in &exported.places {
            if !self.json {
                say(shown(&place.path))?;
                continue;
            }
            let mut line = json!({ "project": named(project), "clip": place.clip, "path": named(&place.path) });
            if place.frames > 0 {
                line["frames"] = place.frames.into();
            }
            say(printable_json(&line.to_string()).into_owned())?;
        }
        let report = exported.report;
        if self.json {
            let totals = json!({ "project": named(project), "written": report.written, "kept": report.kept,
                "removed": report.removed, "bytes": report.bytes });
            return say(printable_json(&totals.to_string()).into_owned());
        }
        let removed = match report.removed {
            0 => String::new(),
            n => format!(", {n} left over from a longer export removed"),
        };
        let files = if report.written == 1 { "file" } else { "files" };
        let whose = if several { format!("{}: ", shown(project)) } else { String::new() };
        tell(format_args!("{whose}{} {files} written, {} already there{removed}", report.written, report.kept));
        Ok(())
    }
}

/// JSON has no names but those in UTF-8.
fn named(path: &Path) -> String {
    path.to_string_lossy().into_owned()
}

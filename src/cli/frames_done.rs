//! A bar that says how many frames of a video are done, on a terminal and nowhere else.

use std::io::IsTerminal;

use indicatif::{ProgressBar, ProgressStyle};

/// Shows how far the following of a face is, and never stops it.
pub(super) struct FramesDone {
    bar: ProgressBar,
}

impl Default for FramesDone {
    fn default() -> Self {
        let bar = if std::io::stderr().is_terminal() { ProgressBar::no_length() } else { ProgressBar::hidden() };
        if let Ok(style) = ProgressStyle::with_template("{msg} {wide_bar} {pos}/{len} frames {eta}") {
            bar.set_style(style);
        }
        Self { bar }
    }
}

impl FramesDone {
    /// Shows how far a clip's video is done.
    pub(super) fn show(&self, clip: &str, done: usize, of: Option<usize>) -> bool {
        if done <= 1 {
            self.bar.reset();
            self.bar.set_message(format!("following the face in {clip}"));
        }
        if let Some(of) = of {
            self.bar.set_length(of as u64);
        }
        self.bar.set_position(done as u64);
        true
    }

    /// Takes the bar away until something is shown again.
    pub(super) fn clear(&self) {
        self.bar.finish_and_clear();
    }
}

impl Drop for FramesDone {
    fn drop(&mut self) {
        self.clear();
    }
}

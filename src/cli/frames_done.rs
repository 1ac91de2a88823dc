//! A bar that says how many frames of a video are done, on a terminal and nowhere else.

use std::io::IsTerminal;

use indicatif::{ProgressBar, ProgressStyle};

/// What is told how far the following of a face is, and never stops it.
pub(super) struct FramesDone {
    bar: ProgressBar,
}

impl FramesDone {
    /// A bar for a clip's video.
    pub(super) fn new(clip: &str) -> Self {
        let bar = if std::io::stderr().is_terminal() { ProgressBar::no_length() } else { ProgressBar::hidden() };
        if let Ok(style) = ProgressStyle::with_template("{msg} {wide_bar} {pos}/{len} frames {eta}") {
            bar.set_style(style);
        }
        bar.set_message(format!("following the face in {clip}"));
        Self { bar }
    }

    /// Shows how far it is.
    pub(super) fn show(&self, done: usize, of: Option<usize>) -> bool {
        if let Some(of) = of {
            self.bar.set_length(of as u64);
        }
        self.bar.set_position(done as u64);
        true
    }
}

impl Drop for FramesDone {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

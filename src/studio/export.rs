//! What the studio asks of an export, and what it hears back. How frames are made and written is not its business:
//! whoever opens the studio hands in the function.

use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

use crate::disk::Result;

/// What is to be exported.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExportRequest {
    /// The lesson's folder.
    pub project: PathBuf,
    /// The clip; none for all of them.
    pub clip: Option<String>,
    /// The formats as typed, with commas between them, such as `png` or `png,srt`.
    pub formats: String,
}

/// How far an export is.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Progress {
    /// Steps done, such as frames.
    pub done: u64,
    /// Steps in all; 0 while that is not known.
    pub total: u64,
    /// What is being made, in a few words.
    pub what: String,
}

/// Exports: tells its progress, stops soon after the flag is set, and says in a line what it wrote and where.
pub type Exporter = Box<dyn Fn(ExportRequest, &dyn Fn(Progress), &AtomicBool) -> Result<String> + Send>;

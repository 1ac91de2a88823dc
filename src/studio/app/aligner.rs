//! The function that finds times, which tests replace by another, and the search that is under way.

use std::fmt;
use std::path::PathBuf;
use std::sync::Arc;

use crate::disk::Result;
use crate::project::{AlignJob, Clip};
use crate::speech::Alignment;
use crate::timing::Interval;

/// Finds times: the job goes in, each wanted clip's number comes out with what was found.
#[derive(Clone)]
pub struct Aligner(Arc<Search>);

type Search = dyn Fn(&AlignJob) -> Vec<(usize, Result<Alignment>)> + Send + Sync;

impl Aligner {
    /// An aligner of another kind, for tests.
    pub fn new(search: impl Fn(&AlignJob) -> Vec<(usize, Result<Alignment>)> + Send + Sync + 'static) -> Self {
        Self(Arc::new(search))
    }

    /// Runs a job.
    #[must_use]
    pub(crate) fn run(&self, job: &AlignJob) -> Vec<(usize, Result<Alignment>)> {
        (self.0)(job)
    }
}

impl Default for Aligner {
    fn default() -> Self {
        Self::new(AlignJob::run)
    }
}

impl fmt::Debug for Aligner {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Aligner")
    }
}

/// A search for times that is under way.
#[derive(Debug)]
pub struct Aligning {
    /// The project's folder.
    pub root: PathBuf,
    /// The clip when the search began: what is found fits this and nothing else.
    pub of: Standing,
    /// Whether the author asked for it.
    pub asked: bool,
    /// The clip that comes after it, of the project in a folder, and whether it was asked for; a newer one takes its place.
    pub next: Option<(PathBuf, usize, bool)>,
}

/// What a search for times depends on.
#[derive(Debug, PartialEq)]
pub struct Standing {
    script: String,
    intervals: Vec<Interval>,
    pins: Vec<usize>,
}

impl Standing {
    /// That of a clip.
    #[must_use]
    pub(crate) fn of(clip: &Clip) -> Self {
        Self { script: clip.script.clone(), intervals: clip.intervals().to_vec(), pins: clip.score.pins.clone() }
    }
}

//! The video of a clip as far as it was read.

use std::sync::Arc;

use crate::media::Source;
use crate::photo::Photo;

/// The video of a clip, a frame of it at a time.
#[derive(Debug, Default)]
pub struct Footage {
    pub(super) source: Option<Source>,
    /// Whether a thread is opening it.
    pub(super) opening: bool,
    /// The frame that was read last, by its number.
    pub(super) frame: Option<(u32, Arc<Photo>)>,
    /// The frame that a thread is reading.
    pub(super) reading: Option<u32>,
}

impl Footage {
    /// The frame that was read last.
    #[must_use]
    pub fn picture(&self) -> Option<&Photo> {
        self.frame.as_ref().map(|f| &*f.1)
    }
}

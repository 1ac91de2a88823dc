//! The ratios and tracks found in a clip's video, as an edit takes them and as the clip's files keep them.

use serde::{Deserialize, Serialize};

use crate::disk::Result;
use crate::project::fault::stale;
use crate::project::files::Clip;
use crate::ratios::{Record, Tracks};

/// The record and the tracks of a clip, as the text of their files.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Footage {
    /// `ratios.csv`; none where there is no record.
    pub ratios: Option<String>,
    /// `tracks.csv`; none where there are no tracks.
    pub tracks: Option<String>,
    /// The checksum of video and calibration they were found with, where they were found in a video.
    pub tracked: Option<String>,
}

impl Footage {
    /// That of a clip as it is.
    pub(super) fn of(clip: &Clip) -> Self {
        Self {
            ratios: clip.record.as_ref().map(Record::to_csv),
            tracks: clip.tracks.as_ref().map(Tracks::to_csv),
            tracked: clip.score.tracked.clone(),
        }
    }

    /// Puts it in the place of that of a clip, which must be `before`.
    pub(super) fn put(&self, before: &Self, clip: &mut Clip) -> Result<()> {
        if Self::of(clip) != *before {
            return Err(stale());
        }
        let record = self.ratios.as_deref().map(Record::parse).transpose()?;
        let tracks = self.tracks.as_deref().map(Tracks::parse).transpose()?;
        (clip.record, clip.tracks) = (record, tracks);
        clip.score.tracked.clone_from(&self.tracked);
        clip.footage_changed = true;
        Ok(())
    }
}

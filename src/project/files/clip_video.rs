//! The video of a clip as frames.

use super::clip::Clip;
use super::recordings::FRAMES_FPS;
use crate::disk::Result;
use crate::media::Source;
use crate::photo::Photo;

impl Clip {
    /// Its video as a stream of frames; none where it has none.
    ///
    /// # Errors
    /// When it cannot be opened.
    pub(crate) fn source(&self) -> Result<Option<Source>> {
        self.video.as_ref().map(|path| Source::of(path, self.video_fps())).transpose()
    }

    /// Frames a second of its video, where that is a folder of pictures.
    #[must_use]
    pub(crate) fn video_fps(&self) -> f64 {
        self.entry.video_fps.unwrap_or(FRAMES_FPS)
    }

    /// The frame of its video that is shown at a time; none where it has none, or it has ended.
    ///
    /// # Errors
    /// When the video cannot be read.
    pub fn frame_at(&self, time: f64) -> Result<Option<Photo>> {
        let Some(source) = self.source()? else { return Ok(None) };
        if source.duration().is_some_and(|end| time >= end) {
            return Ok(None);
        }
        source.frame_at(time).map(Some)
    }

    /// Whether the face in its video is still to be followed: it never was, or what was found is gone.
    #[must_use]
    pub(crate) fn wants_tracking(&self) -> bool {
        self.video.is_some() && self.record.is_none()
    }

    /// Whether a record was found in its video that is not there any more.
    #[must_use]
    pub(crate) fn lost_its_record(&self) -> bool {
        self.record.is_none() && self.score.tracked.is_some()
    }
}

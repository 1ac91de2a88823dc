//! The result of tracking a clip's video as a change of the clip.

use super::change::{Change, Edit};
use super::clip::ClipEdit;
use super::footage::Footage;
use super::lesson::Lesson;
use crate::project::count::counted;
use crate::track::Tracked;

/// The checksum of what a record was found in, and that of the record as its file has it.
fn with_sum(checksum: &str, ratios: &str) -> String {
    format!("{checksum}{:08x}", crc32fast::hash(ratios.as_bytes()))
}

impl Lesson {
    /// The change that gives a clip what was found in its video; none where that is what it has.
    #[must_use]
    pub fn tracked(&self, number: usize, tracked: &Tracked, checksum: &str) -> Option<Change> {
        let before = Footage::of(self.clips.get(number)?);
        let ratios = tracked.record.to_csv();
        let after = Footage {
            tracked: Some(with_sum(checksum, &ratios)),
            ratios: Some(ratios),
            tracks: Some(tracked.tracks.to_csv()),
        };
        if before == after {
            return None;
        }
        let edit = Edit::Clip(number, ClipEdit::Tracked { before: Box::new(before), after: Box::new(after) });
        Some(Change::one(format!("{} tracked", counted(tracked.record.rows.len(), "frame")), edit))
    }

    /// Gives a clip what was found in its video, in memory only: for an export of a lesson that was never tracked.
    pub(crate) fn take_tracked(&mut self, number: usize, tracked: Tracked, checksum: &str) {
        if let Some(clip) = self.clips.get_mut(number) {
            clip.score.tracked = Some(with_sum(checksum, &tracked.record.to_csv()));
            clip.record = Some(tracked.record);
            clip.tracks = Some(tracked.tracks);
        }
    }
}

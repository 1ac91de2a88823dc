//! What tracking found in a clip's video, as one edit takes it and as the clip's files keep it.

use serde::{Deserialize, Serialize};

use super::change::stale;
use super::save::{RATIOS, TRACKS, is_gone};
use super::{Change, Clip, Edit, Lesson, counted};
use crate::disk::{Commit, NextStep, Result, Setting, Task, message};
use crate::ratios::{Record, Tracks};
use crate::track::Tracked;

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

impl Clip {
    pub(super) fn footage(&self) -> Footage {
        Footage {
            ratios: self.record.as_ref().map(Record::to_csv),
            tracks: self.tracks.as_ref().map(Tracks::to_csv),
            tracked: self.score.tracked.clone(),
        }
    }

    /// Whether `ratios.csv` is still what tracking wrote: one that an author has changed is hers.
    pub(super) fn disown(&mut self, ratios: &str) {
        let sum = format!("{:08x}", crc32fast::hash(ratios.as_bytes()));
        if self.score.tracked.as_ref().is_some_and(|t| !t.ends_with(&sum)) {
            self.score.tracked = None;
            let stays = "its ratios.csv was changed since the face was followed, and stays; ";
            self.warnings.push(message![stays, NextStep::from(Task::Track).and(Setting::Replace), " finds it anew"]);
        }
    }

    /// Puts what was found in a video in the place of what was there.
    pub(super) fn take_footage(&mut self, before: &Footage, after: &Footage) -> Result<()> {
        if self.footage() != *before {
            return Err(stale());
        }
        let record = after.ratios.as_deref().map(Record::parse).transpose()?;
        let tracks = after.tracks.as_deref().map(Tracks::parse).transpose()?;
        (self.record, self.tracks) = (record, tracks);
        self.score.tracked.clone_from(&after.tracked);
        self.footage_changed = true;
        Ok(())
    }

    /// Adds `ratios.csv` and `tracks.csv` where an edit has changed them or the file is gone, and the removal of what an undo has taken back.
    pub(super) fn stage_footage(&self, commit: &mut Commit) -> Result<()> {
        let Footage { ratios, tracks, .. } = self.footage();
        for (name, text, seen) in [(RATIOS, ratios, self.seen.ratios), (TRACKS, tracks, self.seen.tracks)] {
            let path = self.folder.join(name);
            if !self.footage_changed && !is_gone(&path, seen) {
                continue;
            }
            match text {
                Some(text) => commit.put(&path, text, seen)?,
                None if seen.is_some() => commit.remove(&path, seen)?,
                None => {}
            }
        }
        Ok(())
    }
}

/// The checksum of what a record was found in, and that of the record as its file has it.
fn with_sum(checksum: &str, ratios: &str) -> String {
    format!("{checksum}{:08x}", crc32fast::hash(ratios.as_bytes()))
}

impl Lesson {
    /// The change that gives a clip what was found in its video; none where that is what it has.
    #[must_use]
    pub fn tracked(&self, number: usize, tracked: &Tracked, checksum: &str) -> Option<Change> {
        let before = self.clips.get(number)?.footage();
        let ratios = tracked.record.to_csv();
        let after = Footage {
            tracked: Some(with_sum(checksum, &ratios)),
            ratios: Some(ratios),
            tracks: Some(tracked.tracks.to_csv()),
        };
        if before == after {
            return None;
        }
        let edit = Edit::Tracked { clip: number, before: Box::new(before), after: Box::new(after) };
        Some(Change::one(format!("{} tracked", counted(tracked.record.rows.len(), "frame")), edit))
    }

    /// Gives a clip what was found in its video, in memory only: for an export of a lesson that was never tracked.
    pub fn take_tracked(&mut self, number: usize, tracked: Tracked, checksum: &str) {
        if let Some(clip) = self.clips.get_mut(number) {
            clip.score.tracked = Some(with_sum(checksum, &tracked.record.to_csv()));
            clip.record = Some(tracked.record);
            clip.tracks = Some(tracked.tracks);
        }
    }
}

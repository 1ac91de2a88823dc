//! Saving: only files whose content differs are written, each whole.

use std::path::{Path, PathBuf};

use super::{Change, Clip, Edit, Lesson, LessonFace};
use crate::disk::{self, Fault, Result, read_old, write_whole};
use crate::emotion::{Kept, Marks};
use crate::face::Face;
use crate::pose::Emotion;
use crate::timeline::Score;
use crate::timing::{self, Format};

impl Lesson {
    /// Writes every changed file of the lesson and empties the journal. Returns what was written.
    ///
    /// # Errors
    /// When the lesson is read-only or a file cannot be written; what was written before stays, and so does the
    /// journal.
    pub fn save(&mut self) -> Result<Vec<PathBuf>> {
        if let Some(why) = &self.read_only {
            return Err(super::lesson::refusal("saved", why));
        }
        let mut written = Vec::new();
        for clip in &mut self.clips {
            written.extend(clip.save()?);
        }
        for face in &mut self.faces {
            written.extend(face.save_all()?);
        }
        if let Some(journal) = &mut self.journal {
            journal.clear()?;
        }
        self.history.mark_saved();
        Ok(written)
    }

    /// Writes one face's `face.toml` and nothing else; whether it differed from what was there.
    ///
    /// # Errors
    /// When the lesson is read-only, has changes that are not in its files, or the file cannot be written.
    pub fn write_face(&mut self, number: usize, face: &Face) -> Result<bool> {
        if let Some(why) = &self.read_only {
            return Err(super::lesson::refusal("changed", why));
        }
        if self.is_unsaved() {
            return Err(Fault::new("the lesson has changes that were never saved")
                .at(&self.root)
                .help("open it in the studio and save or discard them"));
        }
        // As it will be read: what could not be read back is not written.
        let face = Face::parse(&face.to_toml())?;
        let Some(kept) = self.faces.get_mut(number) else {
            return Err(Fault::new(format!("there is no face number {number}")).help("look at lianpu.toml"));
        };
        let before = kept.face.replace(face);
        let written = kept.save();
        if written.is_err() {
            kept.face = before;
        }
        Ok(written?.is_some())
    }

    /// What makes the points that a calibration found those of the lesson: a change of every shot whose points differ.
    ///
    /// # Errors
    /// When the face's points were changed while it was made.
    pub fn calibrated(&self, number: usize, kept: &Kept) -> Result<Option<Change>> {
        let Some(face) = self.faces.get(number).filter(|f| f.sums_match(&kept.inputs)) else {
            return Err(Fault::new("the points or photos were changed while it calibrated").help("calibrate again"));
        };
        let marks = Emotion::ALL[1..].iter().filter_map(|emotion| {
            let before = face.shots[emotion.index()].marks.as_ref().map(Marks::to_toml);
            let after = kept.marks.iter().find(|(e, _)| e == emotion).map(|(_, m)| m.to_toml())?;
            let (face, shot) = (number, *emotion);
            (before.as_ref() != Some(&after)).then_some(Edit::Marks { face, shot, before, after: Some(after) })
        });
        let edits: Vec<Edit> = marks.collect();
        Ok((!edits.is_empty()).then(|| Change { label: "find the points of the shots".into(), edits }))
    }

    /// Keeps a calibration: saves the lesson, writes `calibration.toml` and `model.aam`, and takes it over.
    ///
    /// # Errors
    /// As [`Self::save`], and when a file of the calibration cannot be written.
    pub fn keep_calibration(&mut self, number: usize, kept: &Kept) -> Result<()> {
        self.save()?;
        match self.faces.get_mut(number) {
            Some(face) => face.take_calibration(kept),
            None => Ok(()),
        }
    }

    /// Drops every change that is not in the files: the journal forgets them, so that no later run brings them back,
    /// and the lesson in memory, which still has them, is given up.
    ///
    /// # Errors
    /// When the journal cannot be emptied.
    pub fn discard(mut self) -> Result<()> {
        match &mut self.journal {
            Some(journal) => journal.clear(),
            None => Ok(()),
        }
    }
}

impl LessonFace {
    /// Writes what differs, once it is sure that none of its files was changed by something else.
    fn save_all(&mut self) -> Result<Vec<PathBuf>> {
        if let Some(face) = self.face.as_ref().filter(|_| self.face != self.written) {
            unchanged(&self.path(), &face.to_toml(), self.seen)?;
        }
        for (emotion, shot) in Emotion::ALL.into_iter().zip(self.shots.iter()) {
            shot.ready(&self.folder, emotion)?;
        }
        let mut written: Vec<PathBuf> = self.save()?.into_iter().collect();
        for (emotion, shot) in Emotion::ALL.into_iter().zip(self.shots.iter_mut()) {
            written.extend(shot.save(&self.folder, emotion)?);
        }
        Ok(written)
    }

    /// Writes `face.toml` where the face differs from the file's, and removes it where its points were taken back.
    fn save(&mut self) -> Result<Option<PathBuf>> {
        if self.face == self.written {
            return Ok(None);
        }
        let path = self.path();
        let done = match &self.face {
            Some(face) => write_changed(path, &face.to_toml(), &mut self.seen)?,
            // Only what this program wrote, or has read as it is.
            None if self.seen.is_some() && checksum(&path) == self.seen => {
                disk::remove(&path).map_err(|e| Fault::io("cannot remove it", &path, e))?;
                self.seen = None;
                Some(path)
            }
            None => None,
        };
        self.written.clone_from(&self.face);
        Ok(done)
    }
}

impl Clip {
    /// Writes what differs, once it is sure that none of the files was changed by something else: script, times and
    /// score belong together.
    pub(super) fn save(&mut self) -> Result<Vec<PathBuf>> {
        let path = |name: &str| self.folder.join(name);
        let (script, times, score) = (path("script.txt"), path("timing.TextGrid"), path("score.toml"));
        let said = self.script_to_write();
        // Guesses are made anew from the sound, so they are not written until something of the tier was set by hand, or
        // they take the place of times that were there.
        let labels_set = self.intervals().iter().zip(&self.syllables).any(|(i, s)| i.label != s.text);
        let is_set = !self.timing.guessed || !self.score.pins.is_empty() || labels_set;
        if is_set || self.seen.timing.is_some() {
            self.score.guessed = self.timing.guessed && self.score.pins.len() < self.syllables.len();
        }
        let has_times = (is_set || self.seen.timing.is_some()) && !self.timing.tiers.is_empty();
        let timing = has_times.then(|| timing::write(&self.timing, Format::TextGrid));
        let set = (self.score != Score::default() || score.exists()).then(|| self.score.to_toml());
        for (path, text, seen) in
            [(&script, &said, self.seen.script), (&times, &timing, self.seen.timing), (&score, &set, self.seen.score)]
        {
            if let Some(text) = text {
                unchanged(path, text, seen)?;
            }
        }
        let mut written = Vec::new();
        if let Some(text) = said {
            if text.is_empty() && self.seen.script.is_some() && checksum(&script) == self.seen.script {
                remove(&script)?;
                self.seen.script = None;
                written.push(script);
            } else if !text.is_empty() {
                written.extend(write_changed(script, &text, &mut self.seen.script)?);
            }
            self.kept_script.clone_from(&self.script);
        }
        if let Some(text) = timing {
            written.extend(write_changed(times, &text, &mut self.seen.timing)?);
        } else if self.seen.timing.is_some() && checksum(&times) == self.seen.timing {
            // Times of nothing; only what this program wrote, or has read as it is.
            remove(&times)?;
            self.seen.timing = None;
        }
        written.extend(self.save_footage()?);
        if let Some(text) = set {
            written.extend(write_changed(score, &text, &mut self.seen.score)?);
        }
        Ok(written)
    }

    /// The text of `script.txt` where words were laid into the script or taken out again; empty where none is left.
    fn script_to_write(&self) -> Option<String> {
        let text = self.script.trim_end();
        let line = if text.is_empty() { String::new() } else { format!("{text}\n") };
        (self.script != self.kept_script).then_some(line)
    }
}

pub(super) fn remove(path: &Path) -> Result<()> {
    disk::remove(path).map_err(|e| Fault::io("cannot remove it", path, e))
}

/// What a file looks like; none where there is none.
pub(super) fn checksum(path: &Path) -> Option<u32> {
    read_old(path).map(|bytes| crc32fast::hash(&bytes))
}

/// Makes sure that nobody else has changed a file since it was read or written last.
pub(super) fn unchanged(path: &Path, text: &str, seen: Option<u32>) -> Result<()> {
    match checksum(path) {
        Some(now) if Some(now) != seen && now != crc32fast::hash(text.as_bytes()) => {
            Err(Fault::new("the file was changed by something else since the lesson was opened, and is left as it is")
                .at(path)
                .help("move it aside and save again to keep yours, or leave without saving and open the lesson again"))
        }
        _ => Ok(()),
    }
}

/// Writes a text where the file differs from it, unless somebody else has changed the file meanwhile.
pub(super) fn write_changed(path: PathBuf, text: &str, seen: &mut Option<u32>) -> Result<Option<PathBuf>> {
    unchanged(&path, text, *seen)?;
    let new = Some(crc32fast::hash(text.as_bytes()));
    if checksum(&path) == new {
        *seen = new;
        return Ok(None);
    }
    write_whole(&path, text.as_bytes())?;
    *seen = new;
    Ok(Some(path))
}

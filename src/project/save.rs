//! Saving: only files whose content differs are written, each whole.

use std::path::{Path, PathBuf};

use super::{Clip, Lesson, LessonFace};
use crate::disk::{Fault, Result, write_whole};
use crate::face::Face;
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
            written.extend(face.save()?);
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
                std::fs::remove_file(&path).map_err(|e| Fault::io("cannot remove it", &path, e))?;
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
    pub(super) fn save(&mut self) -> Result<Vec<PathBuf>> {
        let mut written: Vec<PathBuf> = self.save_script()?.into_iter().collect();
        // Guesses are made anew from the sound, so they are not written until something of the tier was set by hand.
        let labels_set = self.intervals().iter().zip(&self.syllables).any(|(i, s)| i.label != s.text);
        if !self.timing.guessed || !self.score.pins.is_empty() || labels_set {
            self.score.guessed = self.timing.guessed && self.score.pins.len() < self.syllables.len();
            if !self.intervals().is_empty() {
                let text = timing::write(&self.timing, Format::TextGrid);
                written.extend(write_changed(self.folder.join("timing.TextGrid"), &text, &mut self.seen.timing)?);
            }
        }
        let path = self.folder.join("score.toml");
        if self.score != Score::default() || path.exists() {
            written.extend(write_changed(path, &self.score.to_toml(), &mut self.seen.score)?);
        }
        Ok(written)
    }
}

/// `script.txt`, where words were laid into it or taken out again.
impl Clip {
    fn save_script(&mut self) -> Result<Option<PathBuf>> {
        if self.script == self.kept_script {
            return Ok(None);
        }
        let path = self.folder.join("script.txt");
        let written =
            if self.script.trim().is_empty() && self.seen.script.is_some() && checksum(&path) == self.seen.script {
                remove(&path)?;
                self.seen.script = None;
                // Times of nothing; only what this program wrote, or has read as it is.
                let times = self.folder.join("timing.TextGrid");
                if self.intervals().is_empty() && self.seen.timing.is_some() && checksum(&times) == self.seen.timing {
                    remove(&times)?;
                    self.seen.timing = None;
                }
                Some(path)
            } else {
                let line = format!("{}\n", self.script.trim_end());
                write_changed(path, &line, &mut self.seen.script)?
            };
        self.kept_script.clone_from(&self.script);
        Ok(written)
    }
}

fn remove(path: &Path) -> Result<()> {
    std::fs::remove_file(path).map_err(|e| Fault::io("cannot remove it", path, e))
}

/// What a file looks like; none where there is none.
pub(super) fn checksum(path: &Path) -> Option<u32> {
    std::fs::read(path).ok().map(|bytes| crc32fast::hash(&bytes))
}

/// Writes a text where the file differs from it, unless somebody else has changed the file meanwhile.
fn write_changed(path: PathBuf, text: &str, seen: &mut Option<u32>) -> Result<Option<PathBuf>> {
    let (now, new) = (checksum(&path), crc32fast::hash(text.as_bytes()));
    if now == Some(new) {
        *seen = now;
        return Ok(None);
    }
    if now.is_some() && now != *seen {
        return Err(Fault::new(
            "the file was changed by something else since the lesson was opened, and is left as it is",
        )
        .at(&path)
        .help("move it aside and save again to keep yours, or leave without saving and open the lesson again"));
    }
    write_whole(&path, text.as_bytes())?;
    *seen = Some(new);
    Ok(Some(path))
}

//! Saving: only files whose content differs are written, each whole.

use std::path::PathBuf;

use super::{Clip, Lesson};
use crate::disk::{Fault, Result, write_whole};
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
            return Err(Fault::new(format!("the lesson cannot be saved: {why}"))
                .help("copy the folder to a place of yours and open the copy"));
        }
        let mut written = Vec::new();
        for clip in &mut self.clips {
            written.extend(clip.save()?);
        }
        if let Some(journal) = &mut self.journal {
            journal.clear()?;
        }
        self.history.mark_saved();
        Ok(written)
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

impl Clip {
    fn save(&mut self) -> Result<Vec<PathBuf>> {
        let mut written = Vec::new();
        // Guesses are made anew from the sound, so they are not written until something of the tier was set by hand.
        let labels_set = self.intervals().iter().zip(&self.syllables).any(|(i, s)| i.label != s.text);
        if !self.timing.guessed || !self.score.pins.is_empty() || labels_set {
            self.score.guessed = self.timing.guessed && self.score.pins.len() < self.syllables.len();
            if !self.intervals().is_empty() {
                let text = timing::write(&self.timing, Format::TextGrid);
                written.extend(write_changed(self.folder.join("timing.TextGrid"), &text)?);
            }
        }
        let path = self.folder.join("score.toml");
        if self.score != Score::default() || path.exists() {
            written.extend(write_changed(path, &self.score.to_toml())?);
        }
        Ok(written)
    }
}

fn write_changed(path: PathBuf, text: &str) -> Result<Option<PathBuf>> {
    if std::fs::read(&path).is_ok_and(|old| old == text.as_bytes()) {
        return Ok(None);
    }
    write_whole(&path, text.as_bytes())?;
    Ok(Some(path))
}

//! Saving: the files whose content differs are written, and the journal emptied, in one commit.

use std::path::{Path, PathBuf};

use super::change::{Change, Edit};
use super::face::FaceEdit;
use super::footage::Footage;
use super::journal::Journal;
use super::lesson::Lesson;
use super::refusal::{elsewhere, refusal};
use crate::calibration::{Kept, Marks};
use crate::disk::{CHANGED_MEANWHILE, Calls, Commit, Committed, Fault, Lock, Result, Sums, SystemCalls, end_commit};
use crate::face::Face;
use crate::pose::Emotion;
use crate::project::ProjectFault;
use crate::project::files::{
    Clip, LOCK, LessonFace, MANIFEST, OWN_FOLDER, RATIOS, SCORE, SCRIPT, TIMES, TRACKS, is_gone,
};
use crate::timeline::Score;
use crate::timing::{self, Format};

impl Lesson {
    /// Writes every changed file of the lesson and empties the journal, all or nothing. Returns what was written.
    ///
    /// # Errors
    /// When the lesson is read-only, its folder was moved, or a file cannot be written. Nothing has changed then, unless
    /// the message says that the save is finished later.
    pub fn save(&mut self) -> Result<Vec<PathBuf>> {
        self.save_by(&mut SystemCalls)
    }

    /// The same, by other calls than the system's.
    ///
    /// # Errors
    /// As [`Self::save`].
    pub fn save_by(&mut self, calls: &mut dyn Calls) -> Result<Vec<PathBuf>> {
        self.commit(calls, |lesson, commit| lesson.stage(commit))
    }

    /// Adds everything that differs from the files, and the journal, which it empties.
    fn stage(&mut self, commit: &mut Commit) -> Result<()> {
        for clip in &mut self.clips {
            clip.stage(commit)?;
        }
        for face in &self.faces {
            face.stage_all(commit)?;
        }
        let manifest = self.root.join(MANIFEST);
        if !manifest.exists() && !self.manifest_text.is_empty() {
            commit.put(&manifest, self.manifest_text.as_bytes(), None)?;
        }
        self.journal.as_ref().map_or(Ok(()), |journal| journal.empty_in(commit))
    }

    /// Makes a commit of what `stage` adds to it, and takes over what is in the files then.
    fn commit(
        &mut self,
        calls: &mut dyn Calls,
        stage: impl FnOnce(&mut Self, &mut Commit) -> Result<()>,
    ) -> Result<Vec<PathBuf>> {
        if let Some(why) = &self.read_only {
            return Err(refusal("saved", why));
        }
        self.hold()?;
        let (root, own, like) = (self.root.clone(), self.root.join(OWN_FOLDER), self.root.join(MANIFEST));
        // A save that could not be finished comes first.
        let ended = end_commit(&root, &own, calls)?;
        if let Some(note) = ended.into_iter().find(|note| note.contains(CHANGED_MEANWHILE)) {
            return Err(Fault::of(ProjectFault::Changed, note).at(&root).help("look at both, and save again"));
        }
        let before = self.sent.clone();
        let mut commit = Commit::new(&root, &own, &like, &before);
        stage(self, &mut commit)?;
        let sums = commit.sums().clone();
        // Should it fail, its files may be there all the same, and are not somebody else's.
        self.sent.extend(sums.iter().map(|(path, sum)| (path.clone(), *sum)));
        let Committed { changed, unfinished } = commit.run(calls)?;
        self.sent.clear();
        self.take_over(&sums);
        unfinished.map_or(Ok(changed), Err)
    }

    /// Takes files over as a commit has written them.
    fn take_over(&mut self, sums: &Sums) {
        for clip in &mut self.clips {
            clip.written(sums);
        }
        for face in &mut self.faces {
            face.written(sums);
        }
        if let Some(journal) = self.journal.as_mut().filter(|j| sums.contains_key(j.path())) {
            journal.replaced();
            self.history.mark_saved();
        }
    }

    /// Makes sure that the lesson is still where it was opened, and that nobody else has it.
    pub(in crate::project) fn hold(&mut self) -> Result<()> {
        if let Some(held) = self.held.as_ref().filter(|held| !held.is_at(&self.root)) {
            return Err(self.is_elsewhere(held.place().as_deref()));
        }
        let path = self.root.join(OWN_FOLDER).join(LOCK);
        if self.lock.as_ref().is_none_or(|lock| lock.is_at(&path)) {
            return Ok(());
        }
        // The program's own folder was removed, and its lock with it.
        match Lock::take(&path)? {
            Some(lock) => {
                self.lock = Some(lock);
                Ok(())
            }
            None => Err(refusal("saved", &elsewhere(&path))),
        }
    }

    /// The fault of a lesson whose folder is at `place` now, or nowhere that is known.
    fn is_elsewhere(&self, place: Option<&Path>) -> Fault {
        let changes = match (self.is_unsaved(), place) {
            (true, Some(_)) => "; leave it and keep the changes: its journal has them, and they are back there",
            _ => "",
        };
        let (what, help) = match place {
            Some(place) => ("moved", format!("open it where it is now, {}{changes}", place.display())),
            None => {
                ("moved or removed", "open it where it is now; where it was removed, nothing of it can be kept".into())
            }
        };
        Fault::of(
            ProjectFault::Changed,
            format!("the lesson's folder was {what} while it was open, so nothing is saved here"),
        )
        .at(&self.root)
        .help(help)
    }

    /// Writes one face's `face.toml` and nothing else; whether it differed from what was there.
    ///
    /// # Errors
    /// When the lesson is read-only, has changes that are not in its files, or the file cannot be written.
    pub fn write_face(&mut self, number: usize, face: &Face) -> Result<bool> {
        if let Some(why) = &self.read_only {
            return Err(refusal("changed", why));
        }
        self.check_saved()?;
        // As it will be read: what could not be read back is not written.
        let face = Face::parse(&face.to_toml())?;
        let Some(kept) = self.faces.get_mut(number) else {
            return Err(Fault::of(ProjectFault::NoSuchFace, format!("there is no face number {number}"))
                .help("look at lianpu.toml"));
        };
        let before = kept.face.replace(face);
        let written = self.commit(&mut SystemCalls, |lesson, commit| lesson.faces[number].stage(commit));
        if written.is_err()
            && let Some(kept) = self.faces.get_mut(number)
            && kept.face != kept.written
        {
            kept.face = before;
        }
        Ok(!written?.is_empty())
    }

    /// What makes the points that a calibration found those of the lesson: a change of every shot whose points differ.
    ///
    /// # Errors
    /// When the face's points were changed while it was made.
    pub fn calibrated(&self, number: usize, kept: &Kept) -> Result<Option<Change>> {
        let Some(face) = self.faces.get(number).filter(|f| f.sums_match(&kept.inputs)) else {
            return Err(Fault::of(ProjectFault::Changed, "the points or photos were changed while it calibrated")
                .help("calibrate again"));
        };
        let marks = Emotion::ALL[1..].iter().filter_map(|emotion| {
            let before = face.shots[emotion.index()].marks.as_ref().map(Marks::to_toml);
            let after = kept.marks.iter().find(|(e, _)| e == emotion).map(|(_, m)| m.to_toml())?;
            let edit = FaceEdit::Marks { shot: *emotion, before: before.clone(), after: Some(after.clone()) };
            (before != Some(after)).then_some(Edit::Face(number, edit))
        });
        let edits: Vec<Edit> = marks.collect();
        Ok((!edits.is_empty()).then(|| Change { label: "find the points of the shots".into(), edits }))
    }

    /// Keeps a calibration: saves the lesson's changes together with `calibration.toml`, `model.aam` and the points that
    /// were found, and takes it over. Returns what was written.
    ///
    /// # Errors
    /// As [`Self::save`].
    pub fn keep_calibration(&mut self, number: usize, kept: &Kept) -> Result<Vec<PathBuf>> {
        self.keep_calibration_by(number, kept, &mut SystemCalls)
    }

    /// The same, by other calls than the system's.
    ///
    /// # Errors
    /// As [`Self::save`].
    pub fn keep_calibration_by(&mut self, number: usize, kept: &Kept, calls: &mut dyn Calls) -> Result<Vec<PathBuf>> {
        let written = self.commit(calls, |lesson, commit| {
            if lesson.is_unsaved() {
                lesson.stage(commit)?;
            }
            lesson
                .faces
                .get(number)
                .map_or(Ok(()), |face| kept.stage(&face.folder, |shot| face.shots[shot.index()].seen, commit))
        })?;
        if let Some(face) = self.faces.get_mut(number) {
            face.calibration = Some(Box::new(kept.file()));
            for (emotion, marks) in &kept.marks {
                let shot = &mut face.shots[emotion.index()];
                shot.marks = Some(marks.clone());
                shot.written.clone_from(&shot.marks);
            }
        }
        Ok(written)
    }

    /// Drops every change that is not in the files: the journal forgets them, so that no later run brings them back,
    /// and the lesson in memory, which still has them, is to be given up.
    ///
    /// # Errors
    /// When the journal cannot be emptied.
    pub fn discard(&mut self) -> Result<()> {
        self.journal.as_mut().map_or(Ok(()), Journal::clear)
    }
}

impl LessonFace {
    /// Adds its files that differ.
    fn stage_all(&self, commit: &mut Commit) -> Result<()> {
        self.stage(commit)?;
        for (emotion, shot) in Emotion::ALL.into_iter().zip(self.shots.iter()) {
            shot.stage(&self.folder, emotion, commit)?;
        }
        Ok(())
    }

    /// Adds `face.toml` where the face differs from the file's, and its removal where its points were taken back.
    fn stage(&self, commit: &mut Commit) -> Result<()> {
        match &self.face {
            _ if self.face == self.written && !is_gone(&self.path(), self.seen) => Ok(()),
            Some(face) => commit.put(&self.path(), face.to_toml(), self.seen),
            // Only what this program wrote, or has read as it is.
            None if self.seen.is_some() => commit.remove(&self.path(), self.seen),
            None => Ok(()),
        }
    }

    /// Takes its files over as a commit has written them.
    fn written(&mut self, sums: &Sums) {
        if let Some(sum) = sums.get(&self.path()) {
            self.seen = *sum;
            self.written.clone_from(&self.face);
        }
        for (emotion, shot) in Emotion::ALL.into_iter().zip(self.shots.iter_mut()) {
            shot.written(&self.folder, emotion, sums);
        }
    }
}

impl Clip {
    /// Adds the files that differ: script, times and score belong together.
    pub(in crate::project) fn stage(&mut self, commit: &mut Commit) -> Result<()> {
        let path = |name: &str| self.folder.join(name);
        let (script, times, score) = (path(SCRIPT), path(TIMES), path(SCORE));
        // Guesses are made anew from the sound, so they are not written until something of the tier was set by hand, or
        // they take the place of times that were there.
        let labels_set = self.intervals().iter().zip(&self.syllables).any(|(i, s)| i.label != s.text);
        let is_set = !self.timing.guessed || !self.score.pins.is_empty() || labels_set;
        if is_set || self.seen.timing.is_some() {
            self.score.guessed = self.timing.guessed && self.score.pins.len() < self.syllables.len();
        }
        let has_times = (is_set || self.seen.timing.is_some()) && !self.timing.tiers.is_empty();
        match self.script_to_write().or_else(|| is_gone(&script, self.seen.script).then(|| self.script.clone())) {
            Some(text) if !text.is_empty() => commit.put(&script, text, self.seen.script)?,
            Some(_) if self.seen.script.is_some() => commit.remove(&script, self.seen.script)?,
            _ => {}
        }
        let is_as_stored = self.timing == self.stored.0 && !is_gone(&times, self.seen.timing);
        if is_as_stored && self.seen.timing.is_some() {
            // Comments and tiers that mean nothing here stay as somebody wrote them.
        } else if has_times {
            commit.put(&times, timing::write(&self.timing, Format::TextGrid), self.seen.timing)?;
        } else if self.seen.timing.is_some() {
            // Times of nothing; only what this program wrote, or has read as it is.
            commit.remove(&times, self.seen.timing)?;
        }
        self.stage_footage(commit)?;
        let is_as_stored = self.score == self.stored.1 && !is_gone(&score, self.seen.score);
        if !is_as_stored && (self.score != Score::default() || score.exists()) {
            commit.put(&score, self.score.to_toml(), self.seen.score)?;
        }
        Ok(())
    }

    /// Adds `ratios.csv` and `tracks.csv` where an edit has changed them or the file is gone, and the removal of what an undo has taken back.
    fn stage_footage(&self, commit: &mut Commit) -> Result<()> {
        let Footage { ratios, tracks, .. } = Footage::of(self);
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

    /// Takes its files over as a commit has written them.
    pub(in crate::project) fn written(&mut self, sums: &Sums) {
        let seen = &mut self.seen;
        let files = [
            (SCRIPT, &mut seen.script),
            (TIMES, &mut seen.timing),
            (SCORE, &mut seen.score),
            (RATIOS, &mut seen.ratios),
            (TRACKS, &mut seen.tracks),
        ];
        for (name, seen) in files {
            if let Some(sum) = sums.get(&self.folder.join(name)) {
                *seen = *sum;
            }
        }
        if sums.keys().any(|path| path.parent() == Some(&self.folder)) {
            self.kept_script.clone_from(&self.script);
            self.stored = (self.timing.clone(), self.score.clone());
            self.footage_changed = false;
        }
    }

    /// The text of `script.txt` where words were laid into the script or taken out again; empty where none is left.
    fn script_to_write(&self) -> Option<String> {
        let text = self.script.trim_end();
        let line = if text.is_empty() { String::new() } else { format!("{text}\n") };
        (self.script != self.kept_script).then_some(line)
    }
}

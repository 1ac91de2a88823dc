//! Opening a lesson: to read it, or to work on it with its lock, its last save finished and its journal brought back.

use std::path::Path;
use std::thread::sleep;
use std::time::Duration;

use super::change::{Change, Edit};
use super::clip::ClipEdit;
use super::history::History;
use super::journal::{JOURNAL, JOURNAL_BYTES, Journal, Left};
use super::lesson::Lesson;
use super::refusal::{LOST, elsewhere};
use super::unsaved::Unsaved;
use crate::disk::{
    Calls, Commit, HeldFolder, Lock, Message, Pending, Result, Sums, SystemCalls, free_name, read_bytes, read_text,
};
use crate::project::files::{Clip, LOCK, LessonFace, MANIFEST, Manifest, OWN_FOLDER, end_and_sweep, read_settled};

impl Lesson {
    /// Reads a lesson to look at and export. Nothing on disk changes, unless a save was cut off: that is finished first.
    ///
    /// # Errors
    /// When the manifest or a clip is damaged.
    pub fn read(root: &Path) -> Result<Self> {
        let manifest = Manifest::read(root)?;
        let (lesson, notes) = read_settled(root, |pending| Self::of_files(root, &manifest, pending, &[]))?;
        Ok(Self { notes, unsaved: Unsaved::of(root)?, ..lesson? })
    }

    /// Reads the files through the paths of `pending`. `left` are the changes of the journal, oldest first.
    fn of_files(root: &Path, manifest: &Manifest, pending: &Pending, left: &[Change]) -> Result<Self> {
        let clips = manifest.clips.iter().enumerate();
        let clips = clips.map(|(number, entry)| Clip::read_before(root, entry, pending, script_before(left, number)));
        let clips = clips.collect::<Result<_>>()?;
        let faces = manifest.faces.iter().map(|entry| LessonFace::read(root, entry, pending)).collect::<Result<_>>()?;
        Ok(Self {
            root: root.to_owned(),
            manifest: manifest.clone(),
            manifest_text: read_text(&root.join(MANIFEST))?,
            clips,
            faces,
            read_only: Some("it was opened to be read".into()),
            recovered: 0,
            lost: 0,
            unsaved: Unsaved::default(),
            notes: Vec::new(),
            history: History::default(),
            journal: None,
            lock: None,
            held: None,
            sent: Sums::new(),
        })
    }

    /// Opens a lesson to work on it: takes its lock, finishes a save that was cut off, and brings back what an earlier run
    /// left unsaved. Where another studio has it open, or it cannot be written to, it opens read-only and says so.
    ///
    /// # Errors
    /// When the manifest or a clip is damaged.
    pub fn open(root: &Path) -> Result<Self> {
        Self::open_by(root, &mut SystemCalls)
    }

    /// The same, by other calls than the system's.
    ///
    /// # Errors
    /// As [`Self::open`].
    pub fn open_by(root: &Path, calls: &mut dyn Calls) -> Result<Self> {
        let manifest = Manifest::read(root)?;
        let own = root.join(OWN_FOLDER);
        let why = match take_lock(&own.join(LOCK)) {
            Ok(Some(lock)) => match end_and_sweep(root, &own, calls) {
                Ok(notes) => return Self::work_on(root, &manifest, lock, notes, calls),
                Err(fault) => format!("the last save cannot be finished: {}", fault.what()),
            },
            Ok(None) => elsewhere(&own.join(LOCK)),
            Err(_) => "its folder cannot be written to".into(),
        };
        Ok(Self { read_only: Some(why), unsaved: Unsaved::default(), ..Self::read(root)? })
    }

    /// Opens a lesson whose lock was taken and whose last save is whole.
    fn work_on(
        root: &Path,
        manifest: &Manifest,
        lock: Lock,
        notes: Vec<Message>,
        calls: &mut dyn Calls,
    ) -> Result<Self> {
        let own = root.join(OWN_FOLDER);
        let path = own.join(JOURNAL);
        let Left { changes: left, unreadable } = Journal::left_in(&path)?;
        let mut lesson = Self::of_files(root, manifest, &Pending::default(), &left)?;
        (lesson.read_only, lesson.notes) = (None, notes);
        (lesson.lock, lesson.held) = (Some(lock), Some(HeldFolder::new(root)));
        let mut made_before = 0;
        for change in &left {
            // A change that does not fit was made to files that have since been changed.
            match lesson.bring_back(change) {
                Ok(true) => {
                    lesson.history.push(change.clone());
                    lesson.recovered += 1;
                }
                Ok(false) => made_before += 1,
                Err(_) => break,
            }
        }
        lesson.lost = left.len() - lesson.recovered - made_before + unreadable;
        let (like, none) = (root.join(MANIFEST), Sums::new());
        if lesson.lost > 0 {
            // Nobody can tell what they are, so nothing is thrown away.
            let all = read_bytes(&path, JOURNAL_BYTES)?;
            let mut copy = Commit::new(root, &own, &like, &none);
            copy.put_over(&free_name(&own.join(LOST)), all)?;
            copy.run(calls)?;
        }
        let mut commit = Commit::new(root, &own, &like, &none);
        lesson.journal = Some(Journal::start(path, lesson.history.done(), &mut commit)?);
        commit.run(calls)?;
        Ok(lesson)
    }

    /// Makes a change of an earlier session again; whether anything of it was still to be made. What of it is in the files
    /// already stays.
    fn bring_back(&mut self, change: &Change) -> Result<bool> {
        if self.apply(change).is_ok() {
            return Ok(true);
        }
        let before = (self.clips.clone(), self.faces.clone());
        let mut any = false;
        for edit in &change.edits {
            match edit.apply(&mut self.clips, &mut self.faces) {
                Ok(()) => any = true,
                Err(_) if edit.is_made(&self.clips, &self.faces) => {}
                Err(fault) => {
                    (self.clips, self.faces) = before;
                    return Err(fault);
                }
            }
        }
        Ok(any)
    }
}

/// The lock at `path`; a reader that finishes a save holds it for a moment.
fn take_lock(path: &Path) -> Result<Option<Lock>> {
    const TRIES: u32 = 5;
    const STEP: Duration = Duration::from_millis(40);
    for _ in 1..TRIES {
        match Lock::take(path)? {
            None => sleep(STEP),
            taken => return Ok(taken),
        }
    }
    Lock::take(path)
}

/// The script of a clip before the first change of it in a journal.
fn script_before(left: &[Change], number: usize) -> Option<&str> {
    left.iter().flat_map(|change| &change.edits).find_map(|edit| match edit {
        Edit::Clip(clip, ClipEdit::Said { before, .. }) if *clip == number => Some(before.script.as_str()),
        _ => None,
    })
}

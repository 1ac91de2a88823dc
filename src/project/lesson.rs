//! A lesson in memory: its manifest, its clips, its figures, and the list of changes made to it.

use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::Duration;

use super::figures;
use super::history::History;
use super::journal::{JOURNAL, JOURNAL_BYTES, Journal};
use super::manifest::{ClipEntry, MANIFEST, Manifest};
use super::settled::{LOCK, OWN_FOLDER, end_and_sweep, read_settled};
use super::{Change, Clip, LessonFace};
use crate::disk::{
    Calls, Commit, Fault, HeldFolder, Lock, Pending, Result, Sums, SystemCalls, is_temporary, nearest, read_bytes,
};
use crate::figure::Figure;
use crate::pose::MouthPreset;
use crate::timeline::Timeline;

/// Where changes are kept that do not fit the files any more.
const LOST: &str = "journal.lost";

/// A lesson that is open.
#[derive(Debug)]
pub struct Lesson {
    /// Its folder.
    pub root: PathBuf,
    /// What it is called and has.
    pub manifest: Manifest,
    /// Its clips, in the manifest's order.
    pub clips: Vec<Clip>,
    /// Its faces, in the manifest's order.
    pub faces: Vec<LessonFace>,
    /// Why it cannot be changed; none where it can.
    pub read_only: Option<String>,
    /// How many unsaved changes of an earlier run were brought back.
    pub recovered: usize,
    /// How many did not fit the files any more; they are kept in `.lianpu/journal.lost`.
    pub lost: usize,
    /// How many unsaved changes an earlier session has left, where the lesson was opened to be read: they are not in it.
    pub unsaved: usize,
    /// What became of a save that was cut off, for the author to know.
    pub notes: Vec<String>,
    pub(super) history: History,
    pub(super) journal: Option<Journal>,
    pub(super) lock: Option<Lock>,
    /// Its folder, so that another one at its path is noticed.
    pub(super) held: Option<HeldFolder>,
    /// The sums of files that a save has sent without knowing that they arrived.
    pub(super) sent: Sums,
}

impl Lesson {
    /// Reads a lesson to look at and export. Nothing on disk changes, unless a save was cut off: that is finished first.
    ///
    /// # Errors
    /// When the manifest or a clip is damaged.
    pub fn read(root: &Path) -> Result<Self> {
        let manifest = Manifest::read(root)?;
        let (lesson, notes) = read_settled(root, |pending| Self::of_files(root, &manifest, pending, &[]))?;
        Ok(Self { notes, unsaved: unsaved_in(root)?, ..lesson? })
    }

    /// Reads the files through the paths of `pending`, and the scripts of clips as `said` has them.
    fn of_files(root: &Path, manifest: &Manifest, pending: &Pending, left: &[Change]) -> Result<Self> {
        let clips = manifest.clips.iter().enumerate();
        let clips = clips.map(|(n, entry)| Clip::read_before(root, entry, pending, n, left)).collect::<Result<_>>()?;
        let faces = manifest.faces.iter().map(|entry| LessonFace::read(root, entry, pending)).collect::<Result<_>>()?;
        Ok(Self {
            root: root.to_owned(),
            manifest: manifest.clone(),
            clips,
            faces,
            read_only: Some("it was opened to be read".into()),
            recovered: 0,
            lost: 0,
            unsaved: 0,
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
        Ok(Self { read_only: Some(why), unsaved: 0, ..Self::read(root)? })
    }

    /// Opens a lesson whose lock was taken and whose last save is whole.
    fn work_on(
        root: &Path,
        manifest: &Manifest,
        lock: Lock,
        notes: Vec<String>,
        calls: &mut dyn Calls,
    ) -> Result<Self> {
        let own = root.join(OWN_FOLDER);
        let path = own.join(JOURNAL);
        let left = Journal::left_in(&path)?;
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
        lesson.lost = left.len() - lesson.recovered - made_before;
        let (like, none) = (root.join(MANIFEST), Sums::new());
        if lesson.lost > 0 {
            // Nobody can tell what they are, so nothing is thrown away.
            let all = read_bytes(&path, JOURNAL_BYTES)?;
            let mut copy = Commit::new(root, &own, &like, &none);
            copy.put_over(&own.join(LOST), all)?;
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

    /// Makes a change, remembers it for undo, and notes it in the journal.
    ///
    /// # Errors
    /// When the lesson is read-only, the change does not fit it, or the journal cannot be written.
    pub fn change(&mut self, change: Change) -> Result<()> {
        if let Some(why) = &self.read_only {
            return Err(refusal("changed", why));
        }
        self.make(&change)?;
        self.history.push(change);
        Ok(())
    }

    /// Takes the last change back; its label, or none where there is none.
    ///
    /// # Errors
    /// When the journal cannot be written; then nothing has changed.
    pub fn undo(&mut self) -> Result<Option<String>> {
        let Some(change) = self.history.done().last().cloned() else { return Ok(None) };
        self.make(&change.inverse())?;
        self.history.step_back();
        Ok(Some(change.label))
    }

    /// Makes the change that was last taken back again.
    ///
    /// # Errors
    /// When the journal cannot be written; then nothing has changed.
    pub fn redo(&mut self) -> Result<Option<String>> {
        let Some(change) = self.history.undone().last().cloned() else { return Ok(None) };
        self.make(&change)?;
        self.history.step_on();
        Ok(Some(change.label))
    }

    /// Applies a change and notes it in the journal: both or neither.
    fn make(&mut self, change: &Change) -> Result<()> {
        if self.journal.as_ref().is_some_and(|journal| !journal.is_open()) {
            self.hold()?;
        }
        self.apply(change)?;
        let noted = self.journal.as_mut().map_or(Ok(()), |journal| journal.note(change));
        if noted.is_err() {
            // The inverse of what was just applied fits.
            let _ = self.apply(&change.inverse());
        }
        noted
    }

    /// Whether there are changes that are not in the files.
    #[must_use]
    pub fn is_unsaved(&self) -> bool {
        self.history.is_unsaved()
    }

    /// The changes made and taken back, for a list of them.
    #[must_use]
    pub fn history(&self) -> &History {
        &self.history
    }

    fn apply(&mut self, change: &Change) -> Result<()> {
        let mut done: Vec<&super::Edit> = Vec::new();
        for edit in &change.edits {
            if let Err(fault) = edit.apply(&mut self.clips, &mut self.faces) {
                // All or nothing: what was done is undone, which cannot fail for edits that were just applied.
                for edit in done.into_iter().rev() {
                    let _ = edit.inverse().apply(&mut self.clips, &mut self.faces);
                }
                return Err(fault);
            }
            done.push(edit);
        }
        Ok(())
    }

    /// The number of the clip of that name, or of the first one where none is named.
    ///
    /// # Errors
    /// When there is none of that name, with the names there are; or when the lesson has no clips.
    pub fn clip_named(&self, name: Option<&str>) -> Result<usize> {
        let known: Vec<&str> = self.clips.iter().map(|c| c.entry.name.as_str()).collect();
        match name {
            Some(name) => self.clips.iter().position(|c| c.entry.name == name).ok_or_else(|| {
                let near = nearest(name, &known).map_or(String::new(), |n| format!("did you mean `{n}`? "));
                Fault::new(format!("there is no clip `{name}`"))
                    .at(self.root.join(MANIFEST))
                    .help(format!("{near}clips: {}", known.join(", ")))
            }),
            None if self.clips.is_empty() => {
                Err(Fault::new("the lesson has no clips").at(self.root.join(MANIFEST)).help("add a [[clip]]"))
            }
            None => Ok(0),
        }
    }

    /// The number of the face of that name, or of the first one where none is named.
    ///
    /// # Errors
    /// When there is none of that name, with the names there are; or when the lesson has no faces.
    pub fn face_named(&self, name: Option<&str>) -> Result<usize> {
        let known: Vec<&str> = self.faces.iter().map(|f| f.entry.name.as_str()).collect();
        match name {
            Some(name) => known.iter().position(|k| *k == name).ok_or_else(|| {
                let near = nearest(name, &known).map_or(String::new(), |n| format!("did you mean `{n}`? "));
                Fault::new(format!("there is no face `{name}`"))
                    .at(self.root.join(MANIFEST))
                    .help(format!("{near}faces: {}", known.join(", ")))
            }),
            None if known.is_empty() => {
                Err(Fault::new("the lesson has no faces").at(self.root.join(MANIFEST)).help("add a [[face]]"))
            }
            None => Ok(0),
        }
    }

    /// Which nine mouth shapes a clip's face has.
    #[must_use]
    pub fn mouths_of(&self, clip: &ClipEntry) -> MouthPreset {
        self.manifest.face_of(clip).map(|f| f.mouths).unwrap_or_default()
    }

    /// A clip's score, built for the lesson's frame rate or another.
    #[must_use]
    pub fn timeline(&self, clip: usize, fps: Option<f64>) -> Timeline {
        let clip = &self.clips[clip];
        clip.timeline(fps.unwrap_or(self.manifest.output.fps), self.mouths_of(&clip.entry))
    }

    /// The figure that a clip is drawn with.
    ///
    /// # Errors
    /// When the manifest names one that does not exist or is damaged, or the cartoon of a face without points.
    pub fn figure_of(&self, clip: &ClipEntry) -> Result<Figure> {
        let face = self.manifest.face_of(clip).and_then(|e| self.faces.iter().find(|f| f.entry.name == e.name));
        figures::figure(&self.root, face)
    }

    /// The figure of a face by its name; without one of the first face, and the line face of a lesson without faces.
    ///
    /// # Errors
    /// As [`Self::figure_of`].
    pub fn figure_of_face(&self, name: Option<&str>) -> Result<Figure> {
        let face = match name {
            Some(name) => self.faces.iter().find(|f| f.entry.name == name),
            None => self.faces.first(),
        };
        figures::figure(&self.root, face)
    }

    /// The cartoon of a face, whatever figure the manifest names.
    ///
    /// # Errors
    /// When the face has no points, or its style or a layer is damaged.
    pub fn cartoon_of(&self, face: &LessonFace) -> Result<Figure> {
        figures::cartoon(&self.root, face)
    }
}

/// Why a read-only lesson cannot be changed or saved, and what to do.
pub(super) fn refusal(what: &str, why: &str) -> Fault {
    let help = if why.starts_with(ELSEWHERE) {
        "close it there and open it here again"
    } else {
        "copy the folder to a place of yours and open the copy"
    };
    Fault::new(format!("the lesson cannot be {what}: {why}")).help(help)
}

/// Why a lesson is read-only that somebody is working on.
const ELSEWHERE: &str = "it is open in another window";

/// The same, with who holds the lock at `path`.
pub(super) fn elsewhere(path: &Path) -> String {
    Lock::holder(path).map_or(ELSEWHERE.into(), |holder| format!("{ELSEWHERE} ({holder})"))
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

/// How many changes the journal of a lesson holds that nobody has open.
pub(super) fn unsaved_in(root: &Path) -> Result<usize> {
    let own = root.join(OWN_FOLDER);
    if Lock::is_held(&own.join(LOCK)) { Ok(0) } else { Ok(Journal::left_in(&own.join(JOURNAL))?.len()) }
}

/// The projects in a folder, by name; the folder itself where it is one.
///
/// # Errors
/// When the folder cannot be listed.
pub fn projects_in(folder: &Path) -> Result<Vec<PathBuf>> {
    if folder.join(MANIFEST).is_file() {
        return Ok(vec![folder.to_owned()]);
    }
    let entries = std::fs::read_dir(folder).map_err(|e| {
        Fault::io("cannot list the folder", folder, e).help("give a folder that holds projects, or a project")
    })?;
    let mut found: Vec<PathBuf> = entries
        .flatten()
        .filter(|e| !e.file_name().to_str().is_some_and(is_temporary))
        .map(|e| e.path())
        .filter(|p| p.join(MANIFEST).is_file())
        .collect();
    found.sort();
    Ok(found)
}

//! A lesson in memory: its manifest, its clips, its figures, and the list of changes made to it.

use std::path::{Path, PathBuf};

use super::figures;
use super::history::History;
use super::journal::Journal;
use super::manifest::{ClipEntry, MANIFEST, Manifest};
use super::{Change, Clip, LessonFace};
use crate::disk::{self, Fault, Lock, Result, confine, nearest};
use crate::figure::Figure;
use crate::pose::MouthPreset;
use crate::timeline::Timeline;

/// The folder of what the program keeps for itself.
pub(super) const OWN_FOLDER: &str = ".lianpu";

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
    pub(super) history: History,
    pub(super) journal: Option<Journal>,
    pub(super) lock: Option<Lock>,
}

impl Lesson {
    /// Reads a lesson to look at and export. Nothing is locked and nothing on disk changes.
    ///
    /// # Errors
    /// When the manifest or a clip is damaged.
    pub fn read(root: &Path) -> Result<Self> {
        let manifest = Manifest::read(root)?;
        let clips = manifest.clips.iter().map(|entry| Clip::read(root, entry)).collect::<Result<Vec<_>>>()?;
        let faces = manifest.faces.iter().map(|entry| LessonFace::read(root, entry)).collect::<Result<Vec<_>>>()?;
        Ok(Self {
            root: root.to_owned(),
            manifest,
            clips,
            faces,
            read_only: Some("it was opened to be read".into()),
            recovered: 0,
            lost: 0,
            history: History::default(),
            journal: None,
            lock: None,
        })
    }

    /// Opens a lesson to work on it: takes its lock and brings back what an earlier run left unsaved. Where another
    /// studio has it open, or it cannot be written to, it opens read-only and says so.
    ///
    /// # Errors
    /// When the manifest or a clip is damaged.
    pub fn open(root: &Path) -> Result<Self> {
        let mut lesson = Self::read(root)?;
        let own = root.join(OWN_FOLDER);
        match Lock::take(&own.join("lock")) {
            Ok(Some(lock)) => {
                lesson.lock = Some(lock);
                lesson.read_only = None;
            }
            Ok(None) => lesson.read_only = Some(ELSEWHERE.into()),
            Err(_) => lesson.read_only = Some("its folder cannot be written to".into()),
        }
        if lesson.read_only.is_none() {
            let path = own.join("journal");
            let left = Journal::left_in(&path)?;
            for change in &left {
                // A change that does not fit was made to files that have since been changed, or is in them already:
                // a save that was cut off after writing leaves such a journal.
                if lesson.apply(change).is_err() {
                    break;
                }
                lesson.history.push(change.clone());
                lesson.recovered += 1;
            }
            lesson.lost = left.len() - lesson.recovered;
            if lesson.lost > 0 {
                // Nobody can tell which of the two it is, so nothing is thrown away.
                let _ = disk::remove(&own.join(LOST));
                disk::copy(&path, &own.join(LOST)).map_err(|e| Fault::io("cannot keep the journal", &path, e))?;
            }
            lesson.journal = Some(Journal::start(&path, lesson.history.done())?);
        }
        Ok(lesson)
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
    let help =
        if why == ELSEWHERE { "close it there" } else { "copy the folder to a place of yours and open the copy" };
    Fault::new(format!("the lesson cannot be {what}: {why}")).help(help)
}

/// Why a lesson is read-only that somebody is working on.
const ELSEWHERE: &str = "it is open in another window";

/// The projects in a folder, by name; the folder itself where it is one.
///
/// # Errors
/// When the folder cannot be listed.
pub fn projects_in(folder: &Path) -> Result<Vec<PathBuf>> {
    if folder.join(MANIFEST).is_file() {
        confine(folder);
        return Ok(vec![folder.to_owned()]);
    }
    let paths = disk::list(folder).map_err(|e| {
        Fault::io("cannot list the folder", folder, e).help("give a folder that holds projects, or a project")
    })?;
    let found: Vec<PathBuf> = paths.into_iter().filter(|p| p.join(MANIFEST).is_file()).collect();
    found.iter().for_each(|project| confine(project));
    Ok(found)
}

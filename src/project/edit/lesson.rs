//! A lesson in memory: its manifest, its clips, its figures, and the list of changes made to it.

use std::path::{Path, PathBuf};

use super::change::{Change, Edit};
use super::history::History;
use super::journal::Journal;
use super::refusal::{LOST, refusal};
use super::unsaved::Unsaved;
use crate::disk::{self, Fault, HeldFolder, Lock, Message, Result, Sums, confine, is_temporary, suggestion};
use crate::drawing::Drawing;
use crate::figure::Figure;
use crate::pose::MouthPreset;
use crate::project::ProjectFault;
use crate::project::files::{self, Clip, ClipEntry, LessonFace, MANIFEST, Manifest};
use crate::timeline::Timeline;

/// A lesson that is open.
#[derive(Debug)]
pub struct Lesson {
    /// Its folder.
    pub root: PathBuf,
    /// What it is called and has.
    pub manifest: Manifest,
    /// The text of its `lianpu.toml`, which a save puts back where the file is gone.
    pub(in crate::project) manifest_text: String,
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
    /// The unsaved changes of another session, where the lesson was opened to be read: they are not in it.
    pub unsaved: Unsaved,
    /// What became of a save that was cut off, for the author to know.
    pub notes: Vec<Message>,
    pub(in crate::project) history: History,
    pub(in crate::project) journal: Option<Journal>,
    pub(in crate::project) lock: Option<Lock>,
    /// Its folder, so that another one at its path is noticed.
    pub(in crate::project) held: Option<HeldFolder>,
    /// The sums of files that a save has sent without knowing that they arrived.
    pub(in crate::project) sent: Sums,
}

impl Lesson {
    /// The notes on a save that was cut off, and on changes of an earlier session that are in no file.
    #[must_use]
    pub fn state_notes(&self) -> Vec<Message> {
        let lost = (self.lost > 0).then(|| {
            let many = if self.lost == 1 {
                "1 unsaved change of an earlier session fits"
            } else {
                "unsaved changes of an earlier session fit"
            };
            let many = if self.lost == 1 { many.to_owned() } else { format!("{} {many}", self.lost) };
            Message::from(format!(
                "{many} the files no more and was left out: .lianpu/{LOST} has what was in the journal"
            ))
        });
        self.notes.iter().cloned().chain(lost).chain(self.unsaved.note()).collect()
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
        let unsaved = self.history.unsaved();
        self.journal.as_mut().map_or(Ok(()), |journal| journal.revive(&unsaved))?;
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

    pub(in crate::project) fn apply(&mut self, change: &Change) -> Result<()> {
        let mut done: Vec<&Edit> = Vec::new();
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
                Fault::of(ProjectFault::NoSuchClip, format!("there is no clip `{name}`"))
                    .at(self.root.join(MANIFEST))
                    .help(suggestion(name, "clips", &known))
            }),
            None if self.clips.is_empty() => Err(Fault::of(ProjectFault::NoSuchClip, "the lesson has no clips")
                .at(self.root.join(MANIFEST))
                .help("add a [[clip]]")),
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
                Fault::of(ProjectFault::NoSuchFace, format!("there is no face `{name}`"))
                    .at(self.root.join(MANIFEST))
                    .help(suggestion(name, "faces", &known))
            }),
            None if known.is_empty() => Err(Fault::of(ProjectFault::NoSuchFace, "the lesson has no faces")
                .at(self.root.join(MANIFEST))
                .help("add a [[face]]")),
            None => Ok(0),
        }
    }

    /// Which nine mouth shapes a clip's face has.
    #[must_use]
    pub(crate) fn mouths_of(&self, clip: &ClipEntry) -> MouthPreset {
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
        files::figure(&self.root, face)
    }

    /// A clip's figure at a time in seconds.
    ///
    /// # Errors
    /// As [`Self::figure_of`], and when there is no clip of that number.
    pub fn drawing(&self, clip: usize, time: f64) -> Result<Drawing> {
        let entry = self.clips.get(clip).map(|c| &c.entry);
        let entry =
            entry.ok_or_else(|| Fault::of(ProjectFault::NoSuchClip, format!("there is no clip number {clip}")))?;
        Ok(self.figure_of(entry)?.draw(&self.timeline(clip, None).pose(time)))
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
        files::figure(&self.root, face)
    }

    /// The cartoon of a face, whatever figure the manifest names.
    ///
    /// # Errors
    /// When the face has no points, or its style or a layer is damaged.
    pub fn cartoon_of(&self, face: &LessonFace) -> Result<Figure> {
        files::cartoon(&self.root, face)
    }
}

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
    let is_project = |path: &PathBuf| {
        let name = path.file_name().and_then(|n| n.to_str());
        !name.is_some_and(is_temporary) && path.join(MANIFEST).is_file()
    };
    let found: Vec<PathBuf> = paths.into_iter().filter(is_project).collect();
    found.iter().for_each(|project| confine(project));
    Ok(found)
}

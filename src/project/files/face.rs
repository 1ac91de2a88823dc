//! A face of a lesson: its photo, its points, and what an author made of them.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::manifest::FaceEntry;
use super::names::{FACE_FILE, sum_of};
use super::shots::{FaceShot, PHOTOS, shots_of};
use crate::calibration::{CALIBRATION, CalibrationFile, sum_of_face, sum_of_marks};
use crate::disk::{Pending, Result, Sum, inside, is_file_there, read_text};
use crate::face::{Face, create};
use crate::photo::Photo;
use crate::pose::Emotion;

/// What a neutral photo is called, in the order in which it is looked for.
const NEUTRAL: [&str; 4] = ["neutral.png", "neutral.jpg", "neutral.jpeg", "neutral.webp"];

/// A face in memory. Edits change `face`; the rest is as the files have it.
#[derive(Debug, Clone)]
pub struct LessonFace {
    /// Its entry in the manifest.
    pub entry: FaceEntry,
    /// Its folder, which may not be there.
    pub folder: PathBuf,
    /// Its points and measures; none before they were found.
    pub face: Option<Face>,
    /// Its neutral photo.
    pub photo: Option<PathBuf>,
    /// The shapes of its person's emotions, where they were calibrated.
    pub calibration: Option<Box<CalibrationFile>>,
    /// What is wrong with the file of that, where it cannot be read.
    pub damage: Option<String>,
    /// The shots of the emotions in canonical order; the first has nothing, the neutral one is `photo` and `face`.
    pub shots: Box<[FaceShot; 7]>,
    /// The sum of `face.toml` as it was last read or written.
    pub(in crate::project) seen: Option<Sum>,
    /// The face as the file has it.
    pub(in crate::project) written: Option<Face>,
}

impl LessonFace {
    /// Reads a face of the project in `root`, through the paths of `pending`. A face without files is one: a line figure
    /// needs none.
    ///
    /// # Errors
    /// When its `face.toml` is damaged, or a name leads out of the project.
    pub(crate) fn read(root: &Path, entry: &FaceEntry, pending: &Pending) -> Result<Self> {
        let folder = inside(root, &format!("faces/{}", entry.name))?;
        let mut photo = None;
        for name in NEUTRAL {
            let path = inside(root, &format!("faces/{}/{name}", entry.name))?;
            if photo.is_none() && is_file_there(&path)? {
                photo = Some(path);
            }
        }
        let path = inside(root, &format!("faces/{}/{FACE_FILE}", entry.name))?;
        let (face, seen) = match pending.at(&path)? {
            Some(file) => {
                // The sum first: a file that changes while it is read is not what it says.
                let sum = sum_of(&file);
                (Some(Face::parse(&read_text(&file)?).map_err(|f| f.at(&path))?), sum)
            }
            None => (None, None),
        };
        let path = inside(root, &format!("faces/{}/{CALIBRATION}", entry.name))?;
        // A damaged calibration is made anew; it is no reason not to open a lesson.
        let (calibration, damage) = match pending.at(&path)?.map(|file| CalibrationFile::read(&file)) {
            Some(Ok(file)) => (Some(Box::new(file)), None),
            Some(Err(fault)) => (None, Some(fault.what().to_owned())),
            None => (None, None),
        };
        let shots = Box::new(shots_of(root, &entry.name, pending)?);
        Ok(Self { entry: entry.clone(), folder, written: face.clone(), face, photo, calibration, damage, shots, seen })
    }

    /// Whether the face has points to draw a cartoon from.
    #[must_use]
    pub(crate) fn has_cartoon(&self) -> bool {
        self.face.is_some()
    }

    /// Whether its cartoon is drawn from points that are in no file.
    #[must_use]
    pub(crate) fn looks_each_time(&self) -> bool {
        self.face.is_none() && self.photo.is_some() && self.entry.figure.as_deref() == Some("cartoon")
    }

    /// Its points; where they were never looked for, they are now, and kept in memory only.
    ///
    /// # Errors
    /// When its photo cannot be read, or no face is found in it.
    pub(crate) fn points(&self) -> Result<Option<Cow<'_, Face>>> {
        match (&self.face, &self.photo) {
            (Some(face), _) => Ok(Some(Cow::Borrowed(face))),
            (None, None) => Ok(None),
            (None, Some(path)) => {
                let (photo, sha256) = Photo::read_with_sum(path)?;
                let created = create(&photo, &sha256, None, None).map_err(|f| f.at(path))?;
                Ok(Some(Cow::Owned(created.face)))
            }
        }
    }

    /// Where its points are written.
    #[must_use]
    pub(crate) fn path(&self) -> PathBuf {
        self.folder.join(FACE_FILE)
    }

    /// The shot of an emotion; none of the neutral one, whose points are the face's.
    #[must_use]
    pub fn shot(&self, emotion: Emotion) -> Option<&FaceShot> {
        (emotion != Emotion::Neutral).then(|| &self.shots[emotion.index()])
    }

    /// The photo of a shot, the neutral one among them.
    #[must_use]
    pub fn photo_of(&self, emotion: Emotion) -> Option<&PathBuf> {
        self.shot(emotion).map_or(self.photo.as_ref(), |shot| shot.photo.as_ref())
    }

    /// Whether the points have been changed since the face was calibrated: in the files or in memory. The photos
    /// themselves are not looked at, only whether there are as many. A face that was never calibrated is not stale.
    #[must_use]
    pub fn is_stale(&self) -> bool {
        self.calibration.as_ref().is_some_and(|file| !self.goes_with(file))
    }

    /// Whether a calibration is of the points as they are now.
    pub(in crate::project) fn goes_with(&self, file: &CalibrationFile) -> bool {
        self.sums_match(&file.inputs)
    }

    pub(in crate::project) fn sums_match(&self, inputs: &BTreeMap<String, String>) -> bool {
        let face = self.face.as_ref().and_then(|f| Face::parse(&f.to_toml()).ok());
        if face.as_ref().map(sum_of_face).as_ref() != inputs.get("face.toml") {
            return false;
        }
        Emotion::ALL[1..].iter().all(|emotion| {
            let shot = &self.shots[emotion.index()];
            let is_there = PHOTOS.iter().any(|e| inputs.contains_key(&format!("{emotion}.{e}")));
            let sum = shot.marks.as_ref().and_then(|m| sum_of_marks(&m.points));
            shot.photo.is_some() == is_there && sum.as_ref() == inputs.get(&format!("{emotion}.toml"))
        })
    }
}

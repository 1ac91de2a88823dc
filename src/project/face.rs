//! A face of a lesson: its photo, its points, and what an author made of them.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use super::manifest::FaceEntry;
use super::save::sum_of;
use super::shots::{FaceShot, shots_of};
use crate::calibration::{CALIBRATION, CalibrationFile};
use crate::disk::{Pending, Result, Sum, inside, is_file_there, read_text};
use crate::face::{Face, create};
use crate::photo::Photo;

/// The file of a face's points.
pub(super) const FACE_FILE: &str = "face.toml";

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
    pub(super) seen: Option<Sum>,
    /// The face as the file has it.
    pub(super) written: Option<Face>,
}

impl LessonFace {
    /// Reads a face of the project in `root`, through the paths of `pending`. A face without files is one: a line figure
    /// needs none.
    ///
    /// # Errors
    /// When its `face.toml` is damaged, or a name leads out of the project.
    pub fn read(root: &Path, entry: &FaceEntry, pending: &Pending) -> Result<Self> {
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
    pub fn has_cartoon(&self) -> bool {
        self.face.is_some()
    }

    /// Whether its cartoon is drawn from points that are in no file.
    #[must_use]
    pub fn looks_each_time(&self) -> bool {
        self.face.is_none() && self.photo.is_some() && self.entry.figure.as_deref() == Some("cartoon")
    }

    /// Its points; where they were never looked for, they are now, and kept in memory only.
    ///
    /// # Errors
    /// When its photo cannot be read, or no face is found in it.
    pub fn points(&self) -> Result<Option<Cow<'_, Face>>> {
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
    pub fn path(&self) -> PathBuf {
        self.folder.join(FACE_FILE)
    }
}

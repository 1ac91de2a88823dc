//! The calibration shots of a face besides the neutral one: `happy.png` … and their points, `happy.toml` ….

use std::path::{Path, PathBuf};

use super::save::{is_gone, sum_of};
use super::{LessonFace, ProjectFault};
use crate::calibration::{Binding, CalibrationFile, Marks, sum_of_face, sum_of_marks};
use crate::disk::{Commit, Fault, Pending, Result, Sum, Sums, inside, is_file_there, read_text};
use crate::face::{Face, FeaturePoint, Placed};
use crate::pose::Emotion;

/// Endings of photos, in the order they are looked for.
const PHOTOS: [&str; 4] = ["png", "jpg", "jpeg", "webp"];
/// Endings of somebody's own annotations.
const ANNOTATIONS: [&str; 2] = ["pts", "asf"];

/// A shot of an emotion.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FaceShot {
    /// Its photo; none where the emotion is modelled.
    pub photo: Option<PathBuf>,
    /// Its points; none before they were found, and where somebody else's annotation has them.
    pub marks: Option<Marks>,
    /// Somebody else's annotation, whose points have no names and cannot be moved here.
    pub foreign: Option<PathBuf>,
    /// The sum of its file as it was last read or written.
    pub(super) seen: Option<Sum>,
    /// The points as the file has them.
    pub(super) written: Option<Marks>,
}

impl FaceShot {
    /// Its named points.
    pub fn points(&self) -> impl Iterator<Item = (FeaturePoint, Placed)> + '_ {
        Binding::own_points().zip(self.marks.iter().flat_map(|m| m.points.iter().copied()))
    }

    /// A named point, to move.
    pub(super) fn placed_mut(&mut self, point: FeaturePoint) -> Option<&mut Placed> {
        let place = Binding::own_points().position(|p| p == point)?;
        self.marks.as_mut()?.points.get_mut(place)
    }

    fn file(folder: &Path, emotion: Emotion) -> PathBuf {
        folder.join(format!("{emotion}.toml"))
    }

    /// Adds its file where the points differ from it, and the file's removal where they were taken back.
    pub(super) fn stage(&self, folder: &Path, emotion: Emotion, commit: &mut Commit) -> Result<()> {
        let path = Self::file(folder, emotion);
        match &self.marks {
            _ if self.marks == self.written && !is_gone(&path, self.seen) => Ok(()),
            Some(marks) => commit.put(&path, marks.to_toml(), self.seen),
            None if self.seen.is_some() => commit.remove(&path, self.seen),
            None => Ok(()),
        }
    }

    /// Takes its file over as a commit has written it.
    pub(super) fn written(&mut self, folder: &Path, emotion: Emotion, sums: &Sums) {
        if let Some(sum) = sums.get(&Self::file(folder, emotion)) {
            self.seen = *sum;
            self.written.clone_from(&self.marks);
        }
    }
}

/// The shots of the six emotions in a face's folder. Of the photos only the names are read.
pub(super) fn shots_of(root: &Path, name: &str, pending: &Pending) -> Result<[FaceShot; 7]> {
    let first = |stem: &str, endings: &[&str]| -> Result<Option<PathBuf>> {
        for ending in endings {
            let path = inside(root, &format!("faces/{name}/{stem}.{ending}"))?;
            if is_file_there(&path)? {
                return Ok(Some(path));
            }
        }
        Ok(None)
    };
    let mut shots: [FaceShot; 7] = Default::default();
    let is_foreign = first("neutral", &ANNOTATIONS)?.is_some();
    for emotion in &Emotion::ALL[1..] {
        let shot = &mut shots[emotion.index()];
        shot.photo = first(emotion.name(), &PHOTOS)?;
        if shot.photo.is_none() {
            continue;
        }
        if is_foreign {
            shot.foreign = first(emotion.name(), &ANNOTATIONS)?;
            continue;
        }
        let path = inside(root, &format!("faces/{name}/{emotion}.toml"))?;
        if let Some(file) = pending.at(&path)? {
            shot.seen = sum_of(&file);
            shot.marks = Some(Marks::parse(&read_text(&file)?).map_err(|f| f.at(&path))?);
            shot.written.clone_from(&shot.marks);
        }
    }
    Ok(shots)
}

impl LessonFace {
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
    pub(super) fn goes_with(&self, file: &CalibrationFile) -> bool {
        self.sums_match(&file.inputs)
    }

    pub(super) fn sums_match(&self, inputs: &std::collections::BTreeMap<String, String>) -> bool {
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

/// Makes sure that points of a shot lie where points can lie.
pub(super) fn near_the_photo(at: [f64; 2]) -> Result<()> {
    if at.iter().all(|v| v.abs() <= crate::face::MAX_COORDINATE) {
        return Ok(());
    }
    Err(Fault::of(ProjectFault::Edit, "the point would lie nowhere near the photo").help("move it back"))
}

//! The calibration shots of a face besides the neutral one: `happy.png` … and their points, `happy.toml` ….

use std::path::{Path, PathBuf};

use super::names::{is_gone, sum_of};
use crate::calibration::{Binding, Marks};
use crate::disk::{Commit, Pending, Result, Sum, Sums, inside, is_file_there, read_text};
use crate::face::{FeaturePoint, Placed};
use crate::pose::Emotion;

/// Endings of photos, in the order they are looked for.
pub(in crate::project) const PHOTOS: [&str; 4] = ["png", "jpg", "jpeg", "webp"];
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
    pub(in crate::project) seen: Option<Sum>,
    /// The points as the file has them.
    pub(in crate::project) written: Option<Marks>,
}

impl FaceShot {
    /// Its named points.
    pub fn points(&self) -> impl Iterator<Item = (FeaturePoint, Placed)> + '_ {
        Binding::own_points().zip(self.marks.iter().flat_map(|m| m.points.iter().copied()))
    }

    /// A named point, to move.
    pub(in crate::project) fn placed_mut(&mut self, point: FeaturePoint) -> Option<&mut Placed> {
        let place = Binding::own_points().position(|p| p == point)?;
        self.marks.as_mut()?.points.get_mut(place)
    }

    fn file(folder: &Path, emotion: Emotion) -> PathBuf {
        folder.join(format!("{emotion}.toml"))
    }

    /// Adds its file where the points differ from it, and the file's removal where they were taken back.
    pub(in crate::project) fn stage(&self, folder: &Path, emotion: Emotion, commit: &mut Commit) -> Result<()> {
        let path = Self::file(folder, emotion);
        match &self.marks {
            _ if self.marks == self.written && !is_gone(&path, self.seen) => Ok(()),
            Some(marks) => commit.put(&path, marks.to_toml(), self.seen),
            None if self.seen.is_some() => commit.remove(&path, self.seen),
            None => Ok(()),
        }
    }

    /// Takes its file over as a commit has written it.
    pub(in crate::project) fn written(&mut self, folder: &Path, emotion: Emotion, sums: &Sums) {
        if let Some(sum) = sums.get(&Self::file(folder, emotion)) {
            self.seen = *sum;
            self.written.clone_from(&self.marks);
        }
    }
}

/// The shots of the six emotions in a face's folder. Of the photos only the names are read.
pub(in crate::project) fn shots_of(root: &Path, name: &str, pending: &Pending) -> Result<[FaceShot; 7]> {
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

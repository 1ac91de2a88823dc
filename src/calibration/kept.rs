//! A calibration in a face's folder: made from the shots there, and kept there as `calibration.toml` and `model.aam`.

use std::collections::BTreeMap;
use std::path::Path;

use super::{Calibrated, CalibrationFile, Marks, ShotFiles, calibrate};
use crate::aam::Model;
use crate::disk::{Commit, Fault, FileFault, Message, Result, Sum, Task, message};
use crate::photo::sha256;
use crate::pose::Emotion;

/// The name of the calibration's file.
pub(crate) const CALIBRATION: &str = "calibration.toml";
/// The name of the model's file.
const MODEL: &str = "model.aam";

/// A calibration as a face's folder keeps it.
#[derive(Debug, Clone)]
pub struct Kept {
    /// What was found.
    pub made: Calibrated,
    /// The SHA-256 of what it was made from, by the files' names.
    pub inputs: BTreeMap<String, String>,
    /// The points of the shots as `happy.toml` and so on keep them; none of somebody's own annotations, and of a
    /// calibration that was read.
    pub marks: Vec<(Emotion, Marks)>,
}

impl Kept {
    /// Calibrates a face from the shots in its folder. Nothing is written.
    ///
    /// # Errors
    /// As [`ShotFiles::of`] and [`calibrate`].
    pub fn make(folder: &Path) -> Result<Self> {
        let files = ShotFiles::of(folder)?;
        let made = files.inputs().and_then(|inputs| calibrate(&inputs)).map_err(|f| f.at(folder))?;
        let own = Emotion::ALL.into_iter().zip(&made.shots);
        let marks = own.filter_map(|(e, points)| Some((e, files.marks(e, points.as_ref()?)?))).collect();
        Ok(Self { made, inputs: files.sums, marks })
    }

    /// Reads the calibration of a face's folder; none where there is none.
    ///
    /// # Errors
    /// When its files are damaged, or do not belong together.
    pub fn read(folder: &Path) -> Result<Option<Self>> {
        let path = folder.join(CALIBRATION);
        if !path.is_file() {
            return Ok(None);
        }
        let CalibrationFile { calibration, quality, model: sum, inputs, .. } = CalibrationFile::read(&path)?;
        let path = folder.join(MODEL);
        let again = message![Task::Calibrate, " makes it anew"];
        if !path.is_file() {
            return Err(Fault::of(FileFault::Missing, "the model of this calibration is missing")
                .at(&path)
                .help(&again));
        }
        let model = Model::read(&path)?;
        if model.count() != calibration.binding().count() || sha256(&model.to_bytes()) != sum {
            return Err(Fault::of(FileFault::Mismatch, "this model is of another calibration").at(&path).help(again));
        }
        let made = Calibrated { calibration, model, quality, shots: Default::default() };
        Ok(Some(Self { made, inputs, marks: Vec::new() }))
    }

    /// What `calibration.toml` holds of it.
    #[must_use]
    pub(crate) fn file(&self) -> CalibrationFile {
        CalibrationFile {
            calibration: self.made.calibration.clone(),
            quality: self.made.quality.clone(),
            model: sha256(&self.made.model.to_bytes()),
            inputs: self.inputs.clone(),
        }
    }

    /// The calibration of a face's folder as its shots are now: what is kept there, or what is made now and kept nowhere;
    /// with what there is to say of that.
    ///
    /// # Errors
    /// As [`read`](Self::read) and [`make`](Self::make).
    pub fn of(folder: &Path) -> Result<(Self, Vec<Message>)> {
        match Self::read(folder)? {
            Some(kept) if kept.is_of(folder) => Ok((kept, Vec::new())),
            // A calibration lasts, also where its photos are kept elsewhere.
            Some(kept) if ShotFiles::of(folder).is_err() => {
                Ok((kept, vec!["its shots are not there any more: the calibration is used as it was kept".into()]))
            }
            before => {
                let made = Self::make(folder)?;
                let note = || {
                    let found = "the shots have changed since they were calibrated: ";
                    message![found, Task::Calibrate, " keeps what is found now"]
                };
                let mut notes: Vec<Message> = before.map(|_| note()).into_iter().collect();
                notes.extend(made.made.quality.notes.iter().map(|n| Message::from(n.as_str())));
                Ok((made, notes))
            }
        }
    }

    /// Whether a folder's shots are still those that this was made from.
    #[must_use]
    pub(crate) fn is_of(&self, folder: &Path) -> bool {
        ShotFiles::of(folder).is_ok_and(|files| files.sums == self.inputs)
    }

    /// What tells this calibration from others: the same inputs and the same model give the same.
    #[must_use]
    pub fn fingerprint(&self) -> String {
        let inputs: String = self.inputs.iter().map(|(name, sum)| format!("{name} {sum}\n")).collect();
        format!("{:08x}{:08x}", crc32fast::hash(inputs.as_bytes()), crc32fast::hash(&self.made.model.to_bytes()))
    }

    /// Adds its files in a face's folder to a commit: the points of the shots that were found, as `happy.toml` and so on,
    /// `model.aam`, and `calibration.toml`. `seen` gives the sums of the points of shots as they were last read.
    ///
    /// # Errors
    /// When a file that is there cannot be read, or points were changed by something else since.
    pub(crate) fn stage(
        &self,
        folder: &Path,
        seen: impl Fn(Emotion) -> Option<Sum>,
        commit: &mut Commit,
    ) -> Result<()> {
        for (emotion, marks) in &self.marks {
            commit.put(&folder.join(format!("{emotion}.toml")), marks.to_toml(), seen(*emotion))?;
        }
        commit.put_over(&folder.join(MODEL), self.made.model.to_bytes())?;
        commit.put_over(&folder.join(CALIBRATION), self.file().to_toml()?)
    }
}

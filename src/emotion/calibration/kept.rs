//! A calibration in a face's folder: made from the shots there, and kept there as `calibration.toml` and `model.aam`.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::{Calibrated, CalibrationFile, ShotFiles, calibrate};
use crate::aam::Model;
use crate::disk::{Fault, Result, write_whole};
use crate::pose::Emotion;

/// The name of the calibration's file.
pub const CALIBRATION: &str = "calibration.toml";
/// The name of the model's file.
const MODEL: &str = "model.aam";

/// A calibration as a face's folder keeps it.
#[derive(Debug, Clone)]
pub struct Kept {
    /// What was found.
    pub made: Calibrated,
    /// The SHA-256 of what it was made from, by the files' names.
    pub inputs: BTreeMap<String, String>,
}

impl Kept {
    /// Calibrates a face from the shots in its folder. Nothing is written.
    ///
    /// # Errors
    /// As [`ShotFiles::of`] and [`calibrate`].
    pub fn make(folder: &Path) -> Result<Self> {
        let files = ShotFiles::of(folder)?;
        let made = files.inputs().and_then(|inputs| calibrate(&inputs)).map_err(|f| f.at(folder))?;
        Ok(Self { made, inputs: files.sums })
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
        let CalibrationFile { calibration, quality, inputs } = CalibrationFile::read(&path)?;
        let path = folder.join(MODEL);
        let again = "run `lianpu calibrate` again";
        if !path.is_file() {
            return Err(Fault::new("the model of this calibration is missing").at(&path).help(again));
        }
        let model = Model::read(&path)?;
        if model.count() != calibration.binding().count() {
            return Err(Fault::new("this model is of another calibration").at(&path).help(again));
        }
        Ok(Some(Self { made: Calibrated { calibration, model, quality, shots: Default::default() }, inputs }))
    }

    /// Whether a folder's shots are still those that this was made from.
    #[must_use]
    pub fn is_of(&self, folder: &Path) -> bool {
        ShotFiles::of(folder).is_ok_and(|files| files.sums == self.inputs)
    }

    /// What tells this calibration from others: the same inputs and the same model give the same.
    #[must_use]
    pub fn fingerprint(&self) -> String {
        let inputs: String = self.inputs.iter().map(|(name, sum)| format!("{name} {sum}\n")).collect();
        format!("{:08x}{:08x}", crc32fast::hash(inputs.as_bytes()), crc32fast::hash(&self.made.model.to_bytes()))
    }

    /// Writes it into a face's folder: `calibration.toml`, `model.aam`, and the points of the shots that were found, as
    /// `happy.toml` and so on. Returns what was written; what is the same stays untouched.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<Vec<PathBuf>> {
        let files = ShotFiles::of(folder)?;
        let mut written = Vec::new();
        let mut put = |name: String, bytes: &[u8]| -> Result<()> {
            let path = folder.join(name);
            if std::fs::read(&path).is_ok_and(|old| old == bytes) {
                return Ok(());
            }
            write_whole(&path, bytes)?;
            written.push(path);
            Ok(())
        };
        for (emotion, points) in Emotion::ALL.iter().zip(&self.made.shots) {
            if let Some(marks) = points.as_ref().and_then(|points| files.marks(*emotion, points)) {
                put(format!("{emotion}.toml"), marks.to_toml().as_bytes())?;
            }
        }
        put(MODEL.into(), &self.made.model.to_bytes())?;
        let Calibrated { calibration, quality, .. } = &self.made;
        let file =
            CalibrationFile { calibration: calibration.clone(), quality: quality.clone(), inputs: self.inputs.clone() };
        put(CALIBRATION.into(), file.to_toml()?.as_bytes())?;
        Ok(written)
    }
}

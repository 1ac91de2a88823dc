//! `lianpu track --live - --model PROJECT`: frames on standard input, a record on standard output.

use std::io::{BufReader, Write};
use std::path::{Path, PathBuf};

use super::print;
use crate::calibration::Kept;
use crate::disk::{Fault, Result};
use crate::project::Lesson;
use crate::track::{Options, relay};

/// Follows the face of a lesson, or of a face's folder, in the frames that come.
///
/// # Errors
/// When there is no face to follow, the stream is none or damaged, or the record cannot be written.
pub(super) fn run(model: &Path, options: &Options, out: &mut dyn Write) -> Result<()> {
    let folder = face_folder(model)?;
    let (kept, notes) = Kept::of(&folder)?;
    notes.iter().for_each(print::note);
    let input = BufReader::with_capacity(1 << 20, std::io::stdin().lock());
    let (count, lost) = relay(input, out, &kept.made.model, &kept.made.calibration, options)?;
    if lost > 0 {
        print::note(format!("the face was lost in {lost} of {count} frames"));
    }
    Ok(())
}

/// The folder of the face: of a lesson its first one's.
fn face_folder(model: &Path) -> Result<PathBuf> {
    if !model.join("lianpu.toml").is_file() {
        return Ok(model.to_owned());
    }
    let lesson = Lesson::read(model)?;
    let face = lesson.faces.first().ok_or_else(|| {
        Fault::new("the lesson has no face to follow")
            .at(model)
            .help("add a [[face]] to lianpu.toml, and its shots in faces/NAME, or give a face's folder")
    })?;
    Ok(face.folder.clone())
}

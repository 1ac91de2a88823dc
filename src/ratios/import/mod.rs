//! Ratios and tracks from whatever a person has: our own records, and what other programs found in a video. What a file
//! is, its content tells.
//!
//! Read are `ratios.csv` and its JSON, compact records, the CSV of OpenFace, JSON of mediapipe's face landmarker, and CSV of ARKit's
//! blendshapes (Live Link Face). Action units and blendshapes become ratios by a table (see `blendshapes.rs`); points need the
//! person's calibration.

mod arkit;
mod blendshapes;
mod csv;
mod frame;
mod landmarks;
mod mediapipe;
mod openface;

use std::path::Path;

use super::lpr::{Whole, is_lpr};
use super::{Record, Tracks};
use crate::calibration::Calibration;
use crate::disk::{self, Fault, FileFault, MAX_TEXT_BYTES, Result, Setting, Task, message};
use frame::Seen;

/// What a file of ratios is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// `ratios.csv`.
    Csv,
    /// The same as JSON.
    Json,
    /// The compact record.
    Lpr,
    /// OpenFace's CSV.
    OpenFace,
    /// Results of mediapipe's face landmarker.
    Mediapipe,
    /// Blendshapes of ARKit.
    Arkit,
}

impl Kind {
    /// What it is, by its beginning (some kilobytes do); none where it is none of these.
    #[must_use]
    pub(crate) fn of(bytes: &[u8]) -> Option<Self> {
        if is_lpr(bytes) {
            return Some(Self::Lpr);
        }
        let head = String::from_utf8_lossy(&bytes[..bytes.len().min(16_384)]);
        let head = head.trim_start_matches('\u{FEFF}').trim_start();
        if head.starts_with(['[', '{']) {
            let is_ours = head.starts_with('[') && head.contains("\"neutral\"") && head.contains("\"surprised\"");
            return if is_ours { Some(Self::Json) } else { mediapipe::is_likely(head).then_some(Self::Mediapipe) };
        }
        let header = head.lines().next().unwrap_or_default();
        let names = disk::CsvTable::names_of(header);
        if openface::is_header(&names) {
            Some(Self::OpenFace)
        } else if arkit::is_header(&names) {
            Some(Self::Arkit)
        } else {
            Record::is_header(head).then_some(Self::Csv)
        }
    }
}

/// Ratios, tracks where there are any, and what there is to say of them. The faces of other programs' files are read by a
/// calibration only through [`read_with`].
///
/// # Errors
/// When it cannot be read, is no such file, or has points alone.
pub(crate) fn read(path: &Path) -> Result<(Record, Option<Tracks>, Vec<String>)> {
    read_with(path, None)
}

/// The same, with the calibration of the person who is seen: points in the file are read by it.
///
/// # Errors
/// When it cannot be read, or is no such file; or has points alone, and no calibration is given or it does not fit them.
pub(crate) fn read_with(
    path: &Path,
    calibration: Option<&Calibration>,
) -> Result<(Record, Option<Tracks>, Vec<String>)> {
    let bytes = disk::read_bytes(path, MAX_TEXT_BYTES)?;
    parse(&bytes, calibration).map_err(|fault| fault.at(path))
}

/// The same from bytes.
///
/// # Errors
/// As [`read_with`].
pub(crate) fn parse(bytes: &[u8], calibration: Option<&Calibration>) -> Result<(Record, Option<Tracks>, Vec<String>)> {
    let Some(kind) = Kind::of(bytes) else {
        return Err(Fault::of(FileFault::Unsupported, "this is no ratio record, nor a face tracker's file that is known").help(
            "known are ratios.csv, JSON of the same columns, .lpr, OpenFace CSV, mediapipe JSON, ARKit blendshapes as CSV",
        ));
    };
    if kind == Kind::Lpr {
        let whole = Whole::read(bytes)?;
        let count = whole.record.rows.len();
        let notes = whole.damage.iter().map(|f| format!("{}: {count} frames were read", f.what())).collect();
        return Ok((whole.record, whole.tracks, notes));
    }
    let text = text_of(bytes)?;
    let frames = match kind {
        Kind::Csv => return Ok((Record::parse(&text)?, None, Vec::new())),
        Kind::Json => return Ok((Record::parse_json(&text)?, None, Vec::new())),
        Kind::OpenFace => openface::read(&text)?,
        Kind::Arkit => arkit::read(&text)?,
        Kind::Mediapipe | Kind::Lpr => mediapipe::read(&text)?,
    };
    of_frames(&frames, calibration)
}

/// Text made clean, as [`disk::read_text`] does.
fn text_of(bytes: &[u8]) -> Result<String> {
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    match std::str::from_utf8(bytes) {
        Ok(text) => Ok(disk::clean(text)),
        Err(error) => {
            let line = 1 + bytes[..error.valid_up_to()].iter().filter(|b| **b == b'\n').count();
            Err(Fault::of(FileFault::Encoding, "the file is not UTF-8 text")
                .line(line)
                .help("save it as UTF-8 and try again"))
        }
    }
}

fn of_frames(frames: &[Seen], calibration: Option<&Calibration>) -> Result<(Record, Option<Tracks>, Vec<String>)> {
    let lost = frames.iter().filter(|f| f.confidence <= 0.0).count();
    if lost == frames.len() {
        return Err(Fault::new("no frame of the file has a face").help("was a face found in the video?"));
    }
    let mut notes = Vec::new();
    if lost > 0 {
        notes.push(format!("{lost} of {} frames have no face: bridged", frames.len()));
    }
    let has_shapes = frames.iter().any(|f| !f.shapes.is_empty());
    let record = match calibration {
        Some(calibration) if frames.iter().any(|f| !f.points.is_empty()) => {
            landmarks::by_calibration(frames, calibration, &mut notes)?
        }
        _ if has_shapes => frame::by_blendshapes(frames, &mut notes)?,
        _ => {
            return Err(Fault::new("the file has the points of a face and nothing that tells its emotions").help(
                message![
                    "give the person's calibrated face (made by ",
                    Task::Calibrate,
                    "): ",
                    Task::Convert.with(Setting::Face, "faces/NAME"),
                    "; or have the tracker write action units or blendshapes too",
                ],
            ));
        }
    };
    Ok((record, frame::tracks(frames), notes))
}

//! The way in for every kind of recording: which reader takes it, what is too large, and what is said about the rest.

use std::io::{Read, Seek, SeekFrom};
use std::path::Path;

use super::kind::{HEAD, Kind, kind};
use super::raw::{Raw, broken};
use super::{Sound, decode, wav};
use crate::disk::{Fault, FileFault, Result, open};

/// The largest file that is read. Its samples lie in memory.
const MAX_BYTES: u64 = 2 << 30;

/// Reads a file; faults come with its path.
pub(super) fn read(path: &Path) -> Result<Sound> {
    let mut raw = once(path, None).map_err(|fault| fault.at(path))?;
    if let Some(loudest) = raw.mixed.cancelled() {
        // Read again rather than kept twice.
        raw = once(path, Some(loudest)).map_err(|fault| fault.at(path))?;
        let number = loudest + 1;
        raw.warnings.push(format!("its channels cancel each other when mixed; channel {number} alone is used"));
    }
    if raw.mixed.strange > 0 {
        raw.warnings.push(format!("{} samples are no numbers and are taken for silence", raw.mixed.strange));
    }
    let mut sound = Sound::new(raw.rate, raw.mixed.samples);
    sound.channels = u16::try_from(raw.mixed.sides.len()).unwrap_or(u16::MAX);
    (sound.sides, sound.warnings) = (raw.mixed.sides, raw.warnings);
    Ok(sound)
}

fn once(path: &Path, only: Option<usize>) -> Result<Raw> {
    let mut file = open(path).map_err(|error| Fault::io("cannot open it", path, error))?;
    let bytes = file.metadata().map_err(broken)?.len();
    if bytes > MAX_BYTES {
        return Err(Fault::of(FileFault::TooLarge, "the file is larger than 2 GB").help("cut the recording into clips"));
    }
    let mut head = Vec::with_capacity(HEAD);
    file.by_ref().take(HEAD as u64).read_to_end(&mut head).map_err(broken)?;
    let kind = kind(&head);
    match kind {
        Kind::Wave => {
            if let Some(raw) = wav::read(&mut file, bytes, only)? {
                return Ok(raw);
            }
        }
        Kind::Foreign(what) => {
            return Err(
                Fault::of(FileFault::Unsupported, format!("it is {what}, which is not read")).help(convert(path))
            );
        }
        Kind::Unknown => {
            let what = if bytes == 0 { "the file is empty" } else { "it is no recording that is known" };
            let kinds = "WAV, AIFF, FLAC, OGG, MP3 and M4A are read, and the sound of MP4, MOV, MKV and WebM";
            return Err(Fault::new(what).help(format!("{kinds}; for others {}", convert(path))));
        }
        Kind::Mp3 | Kind::Iso | Kind::Other => {}
    }
    file.seek(SeekFrom::Start(0)).map_err(broken)?;
    decode::read(file, kind, only)
        .map_err(|fault| if fault.advice().is_empty() { fault.help(convert(path)) } else { fault })
}

/// What to do with a file of another kind.
fn convert(path: &Path) -> String {
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let target = if name == "speech.wav" { "converted.wav" } else { "speech.wav" };
    let plain = name.chars().all(|c| c.is_alphanumeric() || "._-".contains(c)) && !name.starts_with('-');
    let name = if plain { name } else { format!("'{}'", name.replace('\'', "'\\''")) };
    format!("turn it into WAV, for example with `ffmpeg -i {name} {target}`")
}

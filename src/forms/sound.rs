//! A clip's sound as a file: WAV always, and small where an encoder is there.

use std::ffi::OsString;
use std::io::Cursor;
use std::path::Path;

use crate::disk::{Fault, Pipe, Result, read_old, replace};
use crate::forms::FormFault;
use crate::media::Ffmpeg;
use crate::media::{Sound, write_wav};

/// Bits a second of what is encoded: speech through one channel is clean from here on.
const BITS: &str = "48k";

/// Samples a second of what is encoded, at most: speech has nothing above half of them.
const RATE: u32 = 24_000;

/// A sound ready to be put into a file.
#[derive(Debug, Clone)]
pub(crate) struct Encoded {
    /// What it is, for browsers.
    pub mime: &'static str,
    /// The ending of its name.
    pub extension: &'static str,
    /// The file.
    pub bytes: Vec<u8>,
}

impl Encoded {
    /// Whether every reader of books plays it.
    pub(crate) fn is_for_books(&self) -> bool {
        matches!(self.extension, "mp3" | "m4a")
    }
}

/// A recording as it came, where it is MP3 or AAC.
pub(crate) fn own(path: &Path) -> Option<Encoded> {
    let (mime, extension) = match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
        "mp3" => ("audio/mpeg", "mp3"),
        "m4a" => ("audio/mp4", "m4a"),
        _ => return None,
    };
    Some(Encoded { mime, extension, bytes: read_old(path)? })
}

/// The WAV file of a sound: 16 bits, one channel, its own rate.
///
/// # Errors
/// When it is too long for a WAV file.
pub(crate) fn wav(sound: &Sound) -> Result<Vec<u8>> {
    let mut bytes = Cursor::new(Vec::with_capacity(44 + 2 * sound.samples.len()));
    write_wav(&mut bytes, sound.rate, [whole(sound).collect::<Vec<_>>()])
        .map_err(|e| Fault::of(FormFault::CannotWrite, format!("the sound cannot be written as WAV: {e}")))?;
    Ok(bytes.into_inner())
}

/// Samples of 16 bits: what was read from such goes back to the same.
fn whole(sound: &Sound) -> impl Iterator<Item = i16> + '_ {
    sound.samples.iter().map(|s| (f64::from(*s) * 32_768.0).round().clamp(-32_768.0, 32_767.0) as i16)
}

/// The sound as MP3, which every browser and reading system plays; as FLAC, which is larger, where there is no encoder
/// or it fails, and then why, in a line.
pub(crate) fn encoded(sound: &Sound, encoder: Option<&Ffmpeg>) -> (Encoded, Option<String>) {
    let why = match encoder.map(|encoder| mp3(sound, encoder)) {
        Some(Ok(bytes)) => return (Encoded { mime: "audio/mpeg", extension: "mp3", bytes }, None),
        Some(Err(fault)) => fault.what().to_owned(),
        None => "there is no `ffmpeg`".to_owned(),
    };
    let samples: Vec<i16> = whole(sound).collect();
    let bytes = super::flac::flac(&samples, sound.rate);
    let note = format!("{why}; the sound is written as FLAC, which is larger than MP3");
    (Encoded { mime: "audio/flac", extension: "flac", bytes }, Some(note))
}

/// Through files, because the length that makes a player exact stands at the beginning of an MP3 and is known at its
/// end.
fn mp3(sound: &Sound, encoder: &Ffmpeg) -> Result<Vec<u8>> {
    let folder = tempfile::tempdir().map_err(|e| Fault::new(format!("no temporary folder: {e}")))?;
    let (from, to) = (folder.path().join("sound.wav"), folder.path().join("sound.mp3"));
    replace(&from, &wav(sound)?)?;
    let rate = sound.rate.min(RATE).to_string();
    let mut arguments = vec!["-y".into(), "-i".into(), Ffmpeg::file(&from)];
    let plain = ["-map_metadata", "-1", "-ac", "1", "-ar", &rate, "-c:a", "libmp3lame", "-b:a", BITS];
    // The same bytes whenever the same program encodes the same sound.
    let exact = ["-fflags", "+bitexact", "-flags:a", "+bitexact", "-id3v2_version", "0", "-threads", "1", "-f", "mp3"];
    arguments.extend(plain.into_iter().chain(exact).map(OsString::from));
    arguments.push(Ffmpeg::file(&to));
    let running = encoder.start("error", arguments, Pipe::None);
    let ended = running.and_then(|mut running| running.ended());
    let ended = ended.map_err(|e| Fault::io("cannot run it", encoder.path(), e))?;
    let why = ended.messages.lines().into_iter().next().unwrap_or_else(|| ended.status.to_string());
    let failed = || Fault::of(FormFault::Encoder, format!("ffmpeg failed: {why}"));
    if !ended.status.success() {
        return Err(failed());
    }
    read_old(&to).filter(|bytes| !bytes.is_empty()).ok_or_else(failed)
}

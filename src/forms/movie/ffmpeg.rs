//! The `ffmpeg` program as an encoder: fed with frames, and the faults that its messages become.

use std::ffi::OsString;
use std::io::{Error, ErrorKind};
use std::sync::atomic::AtomicBool;

use crate::disk::{Fault, Messages, Pipe, Result, Running, Setting, message};
use crate::forms::FormFault;
use crate::media::Ffmpeg;

/// A running encoder; killed when dropped.
pub(super) struct Encoder(Running);

/// Checks that a video can be made, before anything else is.
///
/// # Errors
/// When the program is not on the PATH.
pub(crate) fn is_there() -> Result<()> {
    start(["-version".into()], Pipe::None)?.ended().map(drop).map_err(|e| not_started(&e))
}

fn start(arguments: impl IntoIterator<Item = OsString>, pipe: Pipe) -> Result<Running> {
    let program = Ffmpeg::on_path().ok_or_else(|| not_started(&ErrorKind::NotFound.into()))?;
    program.start("error", arguments, pipe).map_err(|e| not_started(&e))
}

fn not_started(error: &Error) -> Fault {
    match error.kind() {
        ErrorKind::NotFound => Fault::of(FormFault::Encoder, "video needs the program `ffmpeg`, which is not here")
            .help("install it (Debian: apt install ffmpeg), or export gif, apng or png, which need none"),
        _ => Fault::of(FormFault::Encoder, format!("`ffmpeg` cannot be started: {error}"))
            .help("does `ffmpeg -version` work?"),
    }
}

impl Encoder {
    /// Starts the one on the PATH; an output file that is there already is written over.
    pub(super) fn start(arguments: Vec<OsString>) -> Result<Self> {
        start(std::iter::once("-y".into()).chain(arguments), Pipe::Input).map(Self)
    }

    /// Hands over one frame.
    pub(super) fn feed(&mut self, frame: &[u8]) -> Result<()> {
        self.0.feed(frame).map_err(|e| stopped(&self.0.give_up(), &e.to_string()))
    }

    /// Lets it finish its file; `false` where it was stopped before.
    pub(super) fn finish(mut self, stop: &AtomicBool) -> Result<bool> {
        match self.0.ended_unless(stop) {
            Ok(Some(ended)) if ended.status.success() => Ok(true),
            Ok(Some(ended)) => Err(stopped(&ended.messages, &ended.status.to_string())),
            Ok(None) => Ok(false),
            Err(e) => Err(stopped(&self.0.give_up(), &e.to_string())),
        }
    }
}

/// Its first three messages; `otherwise` where it gave none.
fn stopped(messages: &Messages, otherwise: &str) -> Fault {
    let mut lines = messages.lines();
    lines.truncate(3);
    let what = if lines.is_empty() { otherwise.to_owned() } else { lines.join("; ") };
    let fault = Fault::of(FormFault::Encoder, format!("`ffmpeg` stopped: {what}"));
    if messages.text().contains("Unknown encoder") {
        return fault.help("this ffmpeg was built without it: install a full one, or export another format");
    }
    if messages.text().contains("No space left") {
        return fault.help(message!["make room, or choose another place with ", Setting::Out]);
    }
    fault.help("is there room, and does `ffmpeg -version` work?")
}

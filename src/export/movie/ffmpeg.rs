//! The `ffmpeg` program, fed through a pipe. It never outlives us, and what it complains of is shown.

use std::ffi::OsString;
use std::io::{ErrorKind, Read, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

use crate::disk::{Fault, Result, Setting, clean_line, message};

/// A running ffmpeg; killed when dropped.
pub(super) struct Ffmpeg {
    child: Child,
    input: Option<ChildStdin>,
    errors: Option<JoinHandle<String>>,
}

/// Whether a video can be made: known before anything else is.
///
/// # Errors
/// When the program is not on the PATH.
pub(in crate::export) fn is_there() -> Result<()> {
    let mut command = Command::new("ffmpeg");
    command.arg("-version").stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command.status().map(drop).map_err(|e| not_started(&e))
}

fn not_started(error: &std::io::Error) -> Fault {
    match error.kind() {
        ErrorKind::NotFound => Fault::new("video needs the program `ffmpeg`, which is not here")
            .help("install it (Debian: apt install ffmpeg), or export gif, apng or png, which need none"),
        _ => Fault::new(format!("`ffmpeg` cannot be started: {error}")).help("does `ffmpeg -version` work?"),
    }
}

impl Ffmpeg {
    /// Starts the one on the PATH.
    pub(super) fn start(arguments: &[OsString]) -> Result<Self> {
        let mut command = Command::new("ffmpeg");
        command.args(["-hide_banner", "-nostdin", "-loglevel", "error", "-y"]).args(arguments);
        command.env("AV_LOG_FORCE_NOCOLOR", "1").env_remove("FFREPORT");
        command.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::piped());
        #[cfg(unix)]
        {
            use std::os::unix::process::CommandExt;
            // Ctrl-C is for us: we end it ourselves, or let it finish.
            command.process_group(0);
        }
        let mut child = command.spawn().map_err(|e| not_started(&e))?;
        let input = child.stdin.take();
        let errors = child.stderr.take().map(|mut pipe| {
            std::thread::spawn(move || {
                let mut kept = Vec::new();
                let mut part = [0; 4096];
                // All of it is read, or it would wait for us; the beginning says what was wrong first.
                while let Ok(count @ 1..) = pipe.read(&mut part) {
                    let room = (1_usize << 16).saturating_sub(kept.len());
                    kept.extend_from_slice(&part[..count.min(room)]);
                }
                String::from_utf8_lossy(&kept).into_owned()
            })
        });
        Ok(Self { child, input, errors })
    }

    /// Hands over one frame.
    pub(super) fn feed(&mut self, frame: &[u8]) -> Result<()> {
        let fed = match &mut self.input {
            Some(input) => input.write_all(frame),
            None => Err(ErrorKind::BrokenPipe.into()),
        };
        fed.map_err(|e| self.failed(&e.to_string()))
    }

    /// Lets it finish its file; `false` where it was stopped before.
    pub(super) fn finish(mut self, stop: &AtomicBool) -> Result<bool> {
        drop(self.input.take());
        loop {
            match self.child.try_wait() {
                Ok(Some(status)) if status.success() => return Ok(true),
                Ok(Some(status)) => return Err(self.failed(&status.to_string())),
                Ok(None) if stop.load(Ordering::Relaxed) => return Ok(false),
                Ok(None) => std::thread::sleep(Duration::from_millis(5)),
                Err(e) => return Err(self.failed(&e.to_string())),
            }
        }
    }

    /// What it says was wrong.
    fn failed(&mut self, otherwise: &str) -> Fault {
        drop(self.input.take());
        // It has most likely ended already; if not, there is nothing more for it to do.
        std::thread::sleep(Duration::from_millis(50));
        let _ = self.child.kill();
        let _ = self.child.wait();
        let said = self.errors.take().and_then(|e| e.join().ok()).unwrap_or_default();
        let lines = lines_of(&said);
        let what = if lines.is_empty() { otherwise.to_owned() } else { lines.join("; ") };
        let fault = Fault::new(format!("`ffmpeg` stopped: {what}"));
        if said.contains("Unknown encoder") {
            return fault.help("this ffmpeg was built without it: install a full one, or export another format");
        }
        if said.contains("No space left") {
            return fault.help(message!["make room, or choose another place with ", Setting::Out]);
        }
        fault.help("is there room, and does `ffmpeg -version` work?")
    }
}

impl Drop for Ffmpeg {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Its complaints, each once, without the addresses of its inner parts; the first three.
fn lines_of(said: &str) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for line in said.lines() {
        let mut line = clean_line(line, 200);
        if let (Some(at), Some(end)) = (line.find(" @ 0x"), line.find(']'))
            && line.starts_with('[')
            && at < end
        {
            line.replace_range(at..end, "");
        }
        if !line.is_empty() && !lines.contains(&line) {
            lines.push(line);
        }
    }
    lines.truncate(3);
    lines
}

/// A file as ffmpeg takes it, whatever its name begins with.
pub(super) fn file(path: &Path) -> OsString {
    let mut text = OsString::from("file:");
    text.push(path);
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn complaints_come_once_and_without_addresses() {
        let said = "[libx264 @ 0x55d0c7] broken\u{1b}[0m header\n[libx264 @ 0x55d0c8] broken\u{1b}[0m header\n\nend\n";
        assert_eq!(lines_of(said), ["[libx264] broken[0m header", "end"]);
    }
}

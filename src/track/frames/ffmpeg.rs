//! Videos through the program ffmpeg, where somebody has installed it.
//!
//! Nothing of it is linked. It is started with the file's name behind `file:`, so that no name is taken for an address, and
//! may open nothing but files, so that a playlist does not reach the network.

use std::ffi::{OsStr, OsString};
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdout, Command, Stdio};
use std::thread::JoinHandle;

use super::y4m::Y4m;
use crate::disk::{Fault, Result, clean_line, open, settle, temporary_in};

/// The program, found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Ffmpeg {
    program: PathBuf,
}

/// Of what it says so much is kept: the first and the last.
const KEPT: usize = 16 << 10;
/// Seconds: longer than pictures that stand by themselves are apart in most videos.
const BEFORE: f64 = 10.0;

impl Ffmpeg {
    /// Looks for it on the PATH.
    ///
    /// # Errors
    /// When it is not there, with the one command that makes frames of a video where it is.
    pub fn find() -> Result<Self> {
        let name = format!("ffmpeg{}", std::env::consts::EXE_SUFFIX);
        let path = std::env::var_os("PATH").unwrap_or_default();
        let found = std::env::split_paths(&path).filter(|d| d.is_absolute()).map(|d| d.join(&name)).find(|p| runs(p));
        found.map(|program| Self { program }).ok_or_else(|| {
            Fault::new("a video needs the program ffmpeg, which is not on the PATH").help(
                "install it, or make frames of the video where it is and give their folder: \
                 ffmpeg -i VIDEO -q:v 2 frames/%05d.jpg",
            )
        })
    }

    /// A program that is known to be it.
    #[must_use]
    pub fn at(program: &Path) -> Self {
        Self { program: program.to_owned() }
    }

    /// The frames of a video from a time in seconds on, at most so many; upright, with square pixels, at a steady rate.
    pub(super) fn video(&self, video: &Path, from: f64, most: Option<u32>, loud: bool) -> Result<Running> {
        // A jump lands on any picture near, in old kinds of files behind the one that is wanted: it goes to some time before,
        // and from there every picture is decoded.
        let jump = (from - BEFORE).max(0.0);
        let mut words: Vec<OsString> = self.opening(video, jump, loud);
        if from > jump {
            words.extend(["-ss".into(), OsString::from(format!("{:.6}", from - jump))]);
        }
        let plain = ["-map", "0:v:0", "-an", "-sn", "-dn", "-vf", "scale=trunc(iw*sar/2+0.5)*2:ih,setsar=1"];
        words.extend(plain.map(OsString::from));
        if let Some(most) = most {
            words.extend(["-frames:v".into(), most.to_string().into()]);
        }
        words.extend(["-pix_fmt", "yuv420p", "-f", "yuv4mpegpipe", "pipe:1"].map(OsString::from));
        self.start(video, words)
    }

    fn opening(&self, video: &Path, from: f64, loud: bool) -> Vec<OsString> {
        let mut file = OsString::from("file:");
        file.push(video);
        let level = if loud { "info" } else { "error" };
        let mut words: Vec<OsString> =
            ["-nostdin", "-hide_banner", "-loglevel", level, "-protocol_whitelist", "file,pipe"].map(Into::into).into();
        if from > 0.0 {
            words.extend(["-ss".into(), OsString::from(format!("{from:.6}"))]);
        }
        words.extend(["-i".into(), file]);
        words
    }

    fn start(&self, video: &Path, words: Vec<OsString>) -> Result<Running> {
        open(video).map_err(|e| Fault::io("cannot open the video", video, e))?;
        let mut command = Command::new(&self.program);
        command.args(words).stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().map_err(|e| Fault::io("cannot start ffmpeg", &self.program, e))?;
        let words = child.stderr.take().map(|said| std::thread::spawn(move || kept(said)));
        Ok(Running { child, words, video: video.to_owned() })
    }
}

#[cfg(unix)]
fn runs(path: &Path) -> bool {
    use std::os::unix::fs::PermissionsExt;
    path.metadata().is_ok_and(|m| m.is_file() && m.permissions().mode() & 0o111 != 0)
}

#[cfg(not(unix))]
fn runs(path: &Path) -> bool {
    path.is_file()
}

/// Reads to the end, so that the program never waits, and keeps what fits.
fn kept(mut said: impl Read) -> Vec<u8> {
    let mut all = Vec::new();
    let mut part = [0; 4096];
    while let Ok(n) = said.read(&mut part) {
        if n == 0 {
            break;
        }
        all.extend_from_slice(&part[..n]);
        if all.len() > KEPT {
            all.drain(KEPT / 2..all.len() - KEPT / 2);
        }
    }
    all
}

/// ffmpeg at work; it is ended with this.
#[derive(Debug)]
pub(super) struct Running {
    child: Child,
    words: Option<JoinHandle<Vec<u8>>>,
    video: PathBuf,
}

impl Running {
    /// What it writes.
    pub fn output(&mut self) -> Option<BufReader<ChildStdout>> {
        self.child.stdout.take().map(|out| BufReader::with_capacity(1 << 20, out))
    }

    /// The stream it writes.
    pub fn stream(&mut self) -> Result<Y4m<BufReader<ChildStdout>>> {
        let output = self.output().ok_or_else(|| Fault::new("ffmpeg has no output"))?;
        match Y4m::new(output) {
            Ok(stream) => Ok(stream),
            // What it says itself is nearer to the cause.
            Err(fault) => Err(self.ended().err().unwrap_or(fault).at(&self.video)),
        }
    }

    /// Waits for its end; what it said.
    ///
    /// # Errors
    /// When it failed, with its own last words.
    pub fn ended(&mut self) -> Result<String> {
        let status = self.child.wait().map_err(|e| Fault::io("ffmpeg cannot be waited for", &self.video, e))?;
        let said = self.words.take().and_then(|words| words.join().ok()).unwrap_or_default();
        let said = String::from_utf8_lossy(&said).into_owned();
        if status.success() {
            return Ok(said);
        }
        let lines: Vec<String> = said.lines().map(|l| clean_line(l, 200)).filter(|l| !l.is_empty()).collect();
        let last = lines[lines.len().saturating_sub(2)..].join("; ");
        let why = if last.is_empty() { status.to_string() } else { last };
        Err(Fault::new(format!("ffmpeg cannot read the video: {why}"))
            .at(&self.video)
            .help("does it play elsewhere? convert it there to MP4 and give that"))
    }

    /// Ends it before its time.
    pub fn stop(&mut self) {
        // It may have ended by itself.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        self.stop();
    }
}

/// The length that ffmpeg prints of a file: `Duration: 00:01:02.50`, in seconds.
pub(super) fn duration_said(said: &str) -> Option<f64> {
    let rest = said.split_once("Duration: ")?.1;
    let time = rest.split([',', ' ', '\n']).next()?;
    let mut parts = time.split(':');
    let mut next = || parts.next()?.parse::<f64>().ok().filter(|v| v.is_finite() && *v >= 0.0);
    Some(3600.0 * next()? + 60.0 * next()? + next()?)
}

/// Writes the sound of a video as WAV, one channel, 48 kHz, 16 bits. MP4, MOV and Matroska files with common sound are
/// read by [`Sound`](crate::speech::Sound) itself and need no ffmpeg.
///
/// # Errors
/// When ffmpeg is missing, the video cannot be read or has no sound, or the file cannot be written.
pub fn sound_of(video: &Path, out: &Path) -> Result<()> {
    let folder = out.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let ffmpeg = Ffmpeg::find()?;
    // Beside the file, so that it is whole or not there.
    let part = temporary_in(folder, ".wav").map_err(|e| Fault::io("cannot write it", out, e))?;
    let mut words = ffmpeg.opening(video, 0.0, false);
    let plain = ["-map", "0:a:0", "-vn", "-ac", "1", "-ar", "48000", "-c:a", "pcm_s16le", "-f", "wav"];
    words.extend(plain.map(OsString::from));
    // No name is given, so none is taken for an option: the file comes through the pipe.
    words.push(OsStr::new("pipe:1").to_owned());
    let mut running = ffmpeg.start(video, words)?;
    let mut output = running.output().ok_or_else(|| Fault::new("ffmpeg has no output"))?;
    let mut file = part.as_file();
    std::io::copy(&mut output, &mut file).map_err(|e| Fault::io("cannot write it", out, e))?;
    running.ended()?;
    part.as_file().sync_all().map_err(|e| Fault::io("cannot write it", out, e))?;
    settle(part.into_temp_path(), out).map_err(|e| Fault::io("cannot write it", out, e))?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_length_is_read_from_what_it_says() {
        let said = "Input #0, mov\n  Duration: 00:01:02.50, start: 0.000000, bitrate: 1 kb/s\n";
        assert_eq!(duration_said(said), Some(62.5));
        assert_eq!(duration_said("  Duration: N/A, start"), None);
    }

    #[test]
    fn of_much_talk_the_beginning_and_the_end_are_kept() {
        let text: String = (0..20_000).map(|n| format!("line {n}\n")).collect();
        let said = String::from_utf8(kept(text.as_bytes())).unwrap();
        assert!(said.len() <= KEPT && said.starts_with("line 0\n") && said.ends_with("line 19999\n"));
    }
}

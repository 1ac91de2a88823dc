//! The program ffmpeg, where it is installed: videos and their sound in. Nothing of it is linked.
//!
//! A file's name is passed behind `file:`, so that none is taken for an address, and a video may open nothing but files,
//! so that a playlist does not reach the network.

use std::ffi::OsString;
use std::io::{self, BufReader};
use std::path::{Path, PathBuf};
use std::process::ChildStdout;

use super::y4m::Y4m;
use crate::disk::{Fault, Pipe, Program, Result, Running, open, settle, temporary_in};
use crate::media::MediaFault;

/// The program, found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Ffmpeg {
    program: Program,
}

/// Seconds: longer than pictures that stand by themselves are apart in most videos.
const BEFORE: f64 = 10.0;

impl Ffmpeg {
    /// The one on the PATH, where there is one.
    #[must_use]
    pub(crate) fn on_path() -> Option<Self> {
        Program::find("ffmpeg").map(|program| Self { program })
    }

    /// Looks for it on the PATH.
    ///
    /// # Errors
    /// When it is not there, with the one command that makes frames of a video where it is.
    pub fn find() -> Result<Self> {
        Self::on_path().ok_or_else(|| {
            Fault::of(MediaFault::NoDecoder, "a video needs the program ffmpeg, which is not on the PATH").help(
                "install it, or make frames of the video where it is and give their folder: \
                 ffmpeg -i VIDEO -q:v 2 frames/%05d.jpg",
            )
        })
    }

    /// A program that is known to be it.
    #[must_use]
    pub fn at(program: &Path) -> Self {
        Self { program: Program::at(program) }
    }

    /// The executable file.
    #[must_use]
    pub(crate) fn path(&self) -> &Path {
        self.program.path()
    }

    /// Starts it without questions and banner; `level` is that of its messages.
    ///
    /// # Errors
    /// When the system cannot start it.
    pub(crate) fn start(
        &self,
        level: &str,
        arguments: impl IntoIterator<Item = OsString>,
        pipe: Pipe,
    ) -> io::Result<Running> {
        let common = ["-nostdin", "-hide_banner", "-loglevel", level].map(OsString::from);
        self.program.start(common.into_iter().chain(arguments), pipe)
    }

    /// The argument that names a file.
    #[must_use]
    pub(crate) fn file(path: &Path) -> OsString {
        let mut argument = OsString::from("file:");
        argument.push(path);
        argument
    }

    /// The frames of a video from a time in seconds on, at most so many; upright, with square pixels, at a steady rate.
    pub(super) fn video(&self, video: &Path, from: f64, most: Option<u32>, loud: bool) -> Result<Reading> {
        // A jump lands on any picture near, in old kinds of files behind the one that is wanted: it goes to some time before,
        // and from there every picture is decoded.
        let jump = (from - BEFORE).max(0.0);
        let mut words = opening(video, jump);
        if from > jump {
            words.extend(["-ss".into(), OsString::from(format!("{:.6}", from - jump))]);
        }
        let plain = ["-map", "0:v:0", "-an", "-sn", "-dn", "-vf", "scale=trunc(iw*sar/2+0.5)*2:ih,setsar=1"];
        words.extend(plain.map(OsString::from));
        if let Some(most) = most {
            words.extend(["-frames:v".into(), most.to_string().into()]);
        }
        words.extend(["-pix_fmt", "yuv420p", "-f", "yuv4mpegpipe", "pipe:1"].map(OsString::from));
        self.read(if loud { "info" } else { "error" }, video, words)
    }

    fn read(&self, level: &str, video: &Path, words: Vec<OsString>) -> Result<Reading> {
        open(video).map_err(|e| Fault::io("cannot open the video", video, e))?;
        let running = self.start(level, words, Pipe::Output);
        let running = running.map_err(|e| Fault::io("cannot start ffmpeg", self.path(), e))?;
        Ok(Reading { running, video: video.to_owned() })
    }
}

/// The arguments that open a video at a time in seconds.
fn opening(video: &Path, from: f64) -> Vec<OsString> {
    let mut words: Vec<OsString> = ["-protocol_whitelist", "file,pipe"].map(Into::into).into();
    if from > 0.0 {
        words.extend(["-ss".into(), OsString::from(format!("{from:.6}"))]);
    }
    words.extend(["-i".into(), Ffmpeg::file(video)]);
    words
}

/// ffmpeg reading a video; it is ended with this.
#[derive(Debug)]
pub(super) struct Reading {
    running: Running,
    video: PathBuf,
}

impl Reading {
    /// The bytes that it writes.
    fn output(&mut self) -> Result<BufReader<ChildStdout>> {
        self.running.output().ok_or_else(|| Fault::of(MediaFault::NoDecoder, "ffmpeg has no output"))
    }

    /// The stream of frames that it writes.
    pub(crate) fn stream(&mut self) -> Result<Y4m<BufReader<ChildStdout>>> {
        match Y4m::new(self.output()?) {
            Ok(stream) => Ok(stream),
            // Its own messages are nearer to the cause.
            Err(fault) => Err(self.ended().err().unwrap_or(fault).at(&self.video)),
        }
    }

    /// Waits for its end; its messages.
    ///
    /// # Errors
    /// When it failed, with its last messages.
    pub(crate) fn ended(&mut self) -> Result<String> {
        let ended = self.running.ended().map_err(|e| Fault::io("ffmpeg cannot be waited for", &self.video, e))?;
        if ended.status.success() {
            return Ok(ended.messages.text().to_owned());
        }
        let lines = ended.messages.lines();
        let last = lines[lines.len().saturating_sub(2)..].join("; ");
        let why = if last.is_empty() { ended.status.to_string() } else { last };
        Err(Fault::new(format!("ffmpeg cannot read the video: {why}"))
            .at(&self.video)
            .help("does it play elsewhere? convert it there to MP4 and give that"))
    }

    /// Ends it before its time.
    pub(crate) fn stop(&mut self) {
        self.running.stop();
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
/// read by [`Sound`](crate::media::Sound) itself and need no ffmpeg.
///
/// # Errors
/// When ffmpeg is missing, the video cannot be read or has no sound, or the file cannot be written.
pub fn sound_of(video: &Path, out: &Path) -> Result<()> {
    let folder = out.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let ffmpeg = Ffmpeg::find()?;
    // Beside the file, so that it is whole or not there.
    let part = temporary_in(folder, ".wav").map_err(|e| Fault::io("cannot write it", out, e))?;
    let mut words = opening(video, 0.0);
    // No name is given, so none is taken for an option: the file comes through the pipe.
    let plain = ["-map", "0:a:0", "-vn", "-ac", "1", "-ar", "48000", "-c:a", "pcm_s16le", "-f", "wav", "pipe:1"];
    words.extend(plain.map(OsString::from));
    let mut reading = ffmpeg.read("error", video, words)?;
    let mut output = reading.output()?;
    io::copy(&mut output, &mut part.as_file()).map_err(|e| Fault::io("cannot write it", out, e))?;
    reading.ended()?;
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
}

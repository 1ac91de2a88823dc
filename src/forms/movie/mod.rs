//! A clip as a video, by the `ffmpeg` program where it is there: MP4 (H.264, AAC) or WebM (VP9, Opus), with its sound and
//! its captions as a track.
//!
//! We make the frames, their colours and the sound's cut; ffmpeg compresses and packs. The number of its threads is fixed
//! and its own marks are off, so that one version of it writes the same bytes on any machine.

mod ffmpeg;
mod soundtrack;
mod yuv;

use std::ffi::OsString;
use std::io::Write;
use std::path::Path;

use self::ffmpeg::Encoder;
pub(crate) use self::ffmpeg::is_there;
use self::yuv::Planes;
use super::cels::{Area, changed, pixels};
use super::draft::{beside, write_fault};
use super::stream::{Frames, Outcome, Rate, Watch};
use crate::disk::{Fault, Result, clean_line, put_whole};
use crate::forms::FormFault;
use crate::media::Ffmpeg;
use crate::media::Sound;
use crate::timing::{self, Tier, Timing};

/// What a video is packed in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Container {
    /// H.264 and AAC: plays everywhere. No alpha.
    Mp4,
    /// VP9 and Opus: for the web, with alpha.
    WebM,
}

/// A video beside its pictures.
#[derive(Debug, Clone, Copy)]
pub struct Film<'a> {
    /// Frames a second.
    pub fps: f64,
    /// The numbers of the clip's frames that are shown, rising: sound and captions are cut to them.
    pub shown: &'a [u32],
    /// The clip's recording.
    pub sound: Option<&'a Sound>,
    /// What is said, in the clip's time.
    pub captions: Option<&'a Tier>,
    /// The lesson's title.
    pub title: &'a str,
    /// Whether what has no colour stays transparent, in WebM; in MP4 it is black.
    pub transparent: bool,
}

/// Writes the video at `path`; where there is a file already, when the new one is whole.
///
/// # Errors
/// When ffmpeg is not there or gives up (with what it says), when there are no frames, one cannot be drawn, or the file
/// cannot be written.
pub fn write(
    path: &Path,
    container: Container,
    frames: &mut dyn Frames,
    film: &Film<'_>,
    watch: &Watch<'_>,
) -> Result<Outcome> {
    let rate = Rate::new(film.fps)?;
    let (size, count) = (frames.size(), frames.count());
    if count == 0 || size.contains(&0) {
        return Err(Fault::of(FormFault::NoFrames, "there are no frames to be shown")
            .help("give the clip a recording, times or keys"));
    }
    let alpha = film.transparent && container == Container::WebM;
    let mut planes = Planes::new(size, container == Container::Mp4, alpha);
    let runs = soundtrack::runs(film.shown);
    let sound = film.sound.map(|sound| soundtrack::sound_file(path, sound, &runs, rate)).transpose()?;
    let captions = film.captions.map(|tier| soundtrack::captions_of(tier, &runs, rate));
    let captions = match captions.filter(|c| !c.intervals.is_empty()) {
        Some(tier) => {
            let timing = Timing { duration: tier.end(), tiers: vec![tier], guessed: false };
            let mut file = beside(path, ".vtt")?;
            let text = timing::write(&timing, timing::Format::WebVtt);
            file.write_all(text.as_bytes()).map_err(|e| write_fault(path, e))?;
            Some(file)
        }
        None => None,
    };
    let draft = beside(path, container.ending())?;
    let arguments = Arguments {
        container,
        size: planes.size(),
        rate,
        alpha,
        sound: sound.as_ref().map(|f| f.path()),
        captions: captions.as_ref().map(|f| f.path()),
        title: film.title,
    };
    let mut program = Encoder::start(arguments.list(draft.path()))?;
    let mut shown = Vec::new();
    for n in 0..count {
        if watch.is_stopped() {
            return Ok(Outcome::Stopped);
        }
        let within = Area::of(frames.show(n)?, size);
        let next = pixels(frames, size)?;
        let area = if n == 0 { Some(Area::whole(size)) } else { changed(&shown, next, size[0], 4, within) };
        if let Some(area) = area {
            planes.take(next, area);
            if n == 0 {
                shown = next.to_vec();
            } else {
                area.rows(size[0], 4).for_each(|row| shown[row.clone()].copy_from_slice(&next[row]));
            }
        }
        program.feed(&planes.bytes)?;
        (watch.progress)(n + 1);
    }
    if !program.finish(watch.stop)? {
        return Ok(Outcome::Stopped);
    }
    let saved = (|| {
        let bytes = draft.as_file().metadata()?.len();
        put_whole(draft, path)?;
        Ok(bytes)
    })();
    saved.map(Outcome::Written).map_err(|e| write_fault(path, e))
}

impl Container {
    const fn ending(self) -> &'static str {
        match self {
            Self::Mp4 => ".mp4",
            Self::WebM => ".webm",
        }
    }
}

/// What ffmpeg is told.
struct Arguments<'a> {
    container: Container,
    size: [u32; 2],
    rate: Rate,
    alpha: bool,
    sound: Option<&'a Path>,
    captions: Option<&'a Path>,
    title: &'a str,
}

impl Arguments<'_> {
    fn list(&self, out: &Path) -> Vec<OsString> {
        let mut list: Vec<OsString> = Vec::new();
        let mut add = |words: &str| list.extend(words.split(' ').map(OsString::from));
        let pixels = if self.alpha { "yuva420p" } else { "yuv420p" };
        let ([width, height], rate) = (self.size, self.rate);
        add(&format!("-f rawvideo -pix_fmt {pixels} -video_size {width}x{height}"));
        add(&format!("-framerate {}/{} -i pipe:0", rate.frames, rate.seconds));
        if let Some(sound) = self.sound {
            list.extend(["-f".into(), "wav".into(), "-i".into(), Ffmpeg::file(sound)]);
        }
        if let Some(captions) = self.captions {
            list.extend(["-f".into(), "webvtt".into(), "-i".into(), Ffmpeg::file(captions)]);
        }
        let mut add = |words: &str| list.extend(words.split(' ').map(OsString::from));
        add("-map 0:v");
        if self.sound.is_some() {
            add("-map 1:a");
        }
        if self.captions.is_some() {
            add(if self.sound.is_some() { "-map 2:s" } else { "-map 1:s" });
        }
        // A key frame every two seconds, for whoever jumps.
        let group = (2 * rate.frames).div_ceil(rate.seconds).max(1);
        add(&format!("-g {group} -pix_fmt {pixels} -color_range tv -colorspace bt709"));
        add("-color_primaries bt709 -color_trc bt709");
        match self.container {
            Container::Mp4 => {
                add("-c:v libx264 -preset medium -tune animation -crf 18 -threads 4 -chroma_sample_location center");
                add("-c:a aac -b:a 96k -c:s mov_text -movflags +faststart");
            }
            Container::WebM => {
                add("-c:v libvpx-vp9 -crf 24 -b:v 0 -deadline good -cpu-used 4 -tile-columns 2 -threads 4 -row-mt 0");
                if self.alpha {
                    // The encoder's hidden frames would part colour from alpha.
                    add("-auto-alt-ref 0");
                }
                add("-c:a libopus -b:a 64k -c:s webvtt");
            }
        }
        add("-map_metadata -1 -fflags +bitexact -flags:v +bitexact -flags:a +bitexact");
        let title = clean_line(self.title, 200);
        if !title.is_empty() {
            list.extend(["-metadata".into(), format!("title={title}").into()]);
        }
        let format = self.container.ending().trim_start_matches('.');
        list.extend(["-f".into(), format.into(), Ffmpeg::file(out)]);
        list
    }
}

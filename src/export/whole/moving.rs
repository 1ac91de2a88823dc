//! A clip as one moving picture: its frames painted one after the other and handed to whoever packs them.

use std::ops::Range;
use std::path::Path;

use sha2::{Digest, Sha256};

use super::Written;
use crate::disk::{Fault, Result, Setting, message};
use crate::drawing::{Colour, Picture};
use crate::export::ExportFault;
use crate::export::manifest::hex;
use crate::export::{Format, Job, Ledger};
use crate::forms::apng::{self, ApngForm, Depth};
use crate::forms::gif::{self, GifForm};
use crate::forms::movie::{self, Container, Film};
use crate::forms::{Frames, Outcome, Watch, said};
use crate::project::Clip;
use crate::render::{REVISION, Reel};
use crate::timing::{self, Tier, Timing};

/// The frames of a job, painted as they are asked for.
struct Painted<'a> {
    job: &'a Job,
    reel: Reel,
}

impl Frames for Painted<'_> {
    fn size(&self) -> [u32; 2] {
        self.job.size
    }

    fn count(&self) -> u32 {
        u32::try_from(self.job.frames.len()).unwrap_or(u32::MAX)
    }

    fn show(&mut self, n: u32) -> Result<(Range<u32>, Range<u32>)> {
        let frame = self
            .job
            .frames
            .get(n as usize)
            .ok_or_else(|| Fault::of(ExportFault::NoSuchFrame, "there is no such frame"))?;
        Ok(self.reel.show(&self.job.drawing(*frame)))
    }

    fn picture(&self) -> &Picture {
        self.reel.picture()
    }
}

/// A clip to be written as a video, a GIF or an animated PNG.
pub(super) struct Moving<'a> {
    pub(super) job: &'a Job,
    pub(super) clip: &'a Clip,
    pub(super) format: Format,
}

impl Moving<'_> {
    /// Writes it, unless it is there already as the same was made before; none where it was stopped.
    ///
    /// # Errors
    /// When it cannot be written.
    pub(super) fn write(&self, path: &Path, ledger: &mut Ledger, watch: &Watch<'_>) -> Result<Option<Written>> {
        let captions = said::captions(self.clip);
        let key = self.key(&captions);
        let mut written = Written { paths: vec![path.to_owned()], ..Written::default() };
        if self.format == Format::Mp4 && !self.is_opaque() {
            let name = &self.clip.entry.name;
            written.notes.push(message![
                format!("{name}.mp4: MP4 has no alpha, so it is black where nothing is; WebM keeps it ("),
                Setting::Format.of("webm"),
                ")"
            ]);
        }
        if let Some(entry) = ledger.kept(path, &key) {
            ledger.keep(entry)?;
            written.report.kept = 1;
            return Ok(Some(written));
        }
        ledger.set_aside(path, None)?;
        let Outcome::Written(bytes) = self.film(path, &captions, watch)? else { return Ok(None) };
        ledger.made(path, &key)?;
        written.report.written = 1;
        written.report.bytes = bytes;
        Ok(Some(written))
    }

    fn film(&self, path: &Path, captions: &Tier, watch: &Watch<'_>) -> Result<Outcome> {
        let job = self.job;
        let [width, height] = job.size;
        let mut frames = Painted { job, reel: Reel::new(width, height)? };
        let (fps, opaque) = (job.timeline.fps(), self.is_opaque());
        let container = match self.format {
            Format::Gif => {
                return gif::write(path, &mut frames, GifForm { fps, plays: 0, matte: Colour::WHITE }, watch);
            }
            Format::Apng => {
                let form = ApngForm { fps, plays: 0, depth: Depth::Palette, opaque };
                return apng::write(path, &mut frames, form, watch);
            }
            Format::Webm => Container::WebM,
            _ => Container::Mp4,
        };
        let film = Film {
            fps,
            shown: &job.frames,
            sound: self.clip.sound.as_deref(),
            captions: Some(captions),
            title: &job.title,
            transparent: !opaque,
        };
        movie::write(path, container, &mut frames, &film, watch)
    }

    fn is_opaque(&self) -> bool {
        let ground = self.job.background.unwrap_or_else(|| self.job.drawing(0).background);
        ground.is_some_and(|c| c.a == 255)
    }

    /// What it is made from, by everything that changes it but ffmpeg's version.
    fn key(&self, captions: &Tier) -> String {
        let job = self.job;
        let mut sum = Sha256::new();
        let [width, height] = job.size;
        let ground = match self.format {
            _ if self.is_opaque() => "opaque",
            Format::Mp4 => "on black",
            _ => "clear",
        };
        let form = format!("{} {width}x{height} {} {ground}", self.format.name(), job.timeline.fps());
        sum.update(format!("{} {REVISION} {form} {}\n", env!("CARGO_PKG_VERSION"), job.title));
        for frame in &job.frames {
            sum.update(frame.to_le_bytes());
            sum.update(job.drawing(*frame).fingerprint().to_le_bytes());
        }
        if matches!(self.format, Format::Mp4 | Format::Webm) {
            let said = Timing { duration: captions.end(), tiers: vec![captions.clone()], guessed: false };
            sum.update(timing::write(&said, timing::Format::WebVtt));
            if let Some(sound) = &self.clip.sound {
                sum.update(sound.rate.to_le_bytes());
                let mut bytes = Vec::new();
                for block in sound.samples.chunks(1 << 14) {
                    bytes.clear();
                    bytes.extend(block.iter().flat_map(|s| s.to_le_bytes()));
                    sum.update(&bytes);
                }
            }
        }
        hex(&sum.finalize())[..32].to_owned()
    }
}

//! A clip as one moving picture: its frames painted one after the other and handed to whoever packs them.

use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use super::{Written, with_ending};
use crate::disk::{Fault, Result};
use crate::drawing::Colour;
use crate::export::apng::{self, ApngForm, Depth};
use crate::export::gif::{self, GifForm};
use crate::export::movie::{self, Container, Film};
use crate::export::{Format, Frames, Job, Outcome, Watch};
use crate::project::Clip;
use crate::render::{Painter, Picture};

/// The frames of a job, painted as they are asked for.
struct Painted<'a> {
    job: &'a Job,
    painter: Painter,
    picture: Option<Picture>,
}

impl Frames for Painted<'_> {
    fn size(&self) -> [u32; 2] {
        self.job.size
    }

    fn count(&self) -> u32 {
        u32::try_from(self.job.frames.len()).unwrap_or(u32::MAX)
    }

    fn at(&mut self, n: u32) -> Result<&Picture> {
        let frame = self.job.frames.get(n as usize).ok_or_else(|| Fault::new("there is no such frame"))?;
        Ok(self.picture.insert(self.painter.paint(&self.job.drawing(*frame))))
    }
}

/// Writes a clip's frames as a video, a GIF or an animated PNG; nothing where it was stopped.
pub(super) fn moving(
    job: &Job,
    clip: &Clip,
    format: Format,
    base: &Path,
    stop: &AtomicBool,
    written: &mut Written,
) -> Result<()> {
    let [width, height] = job.size;
    let mut frames = Painted { job, painter: Painter::new(width, height)?, picture: None };
    let watch = Watch { progress: &|_| {}, stop };
    let ground = match job.background {
        Some(background) => background,
        None => job.drawing(0).background,
    };
    let opaque = ground.is_some_and(|c| c.a == 255);
    let fps = job.timeline.fps();
    let film = |transparent| {
        (
            Film {
                fps,
                shown: &job.frames,
                sound: clip.sound.as_deref(),
                captions: None,
                title: &job.title,
                transparent,
            },
            clip.phrases(),
        )
    };
    let path: PathBuf;
    let outcome = match format {
        Format::Gif => {
            path = with_ending(base, "gif");
            gif::write(&path, &mut frames, GifForm { fps, plays: 0, matte: Colour::WHITE }, &watch)?
        }
        Format::Apng => {
            path = with_ending(base, "apng");
            apng::write(&path, &mut frames, ApngForm { fps, plays: 0, depth: Depth::Palette, opaque }, &watch)?
        }
        _ => {
            let container = if format == Format::Webm { Container::WebM } else { Container::Mp4 };
            path = with_ending(base, format.name());
            let (film, phrases) = film(!opaque);
            movie::write(&path, container, &mut frames, &Film { captions: Some(&phrases), ..film }, &watch)?
        }
    };
    if let Outcome::Written(bytes) = outcome {
        written.report.written += 1;
        written.report.bytes += bytes;
        written.paths.push(path);
    }
    Ok(())
}

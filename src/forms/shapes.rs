//! The mouth shapes of a clip in time, as other programs of lip movement take them.

use std::path::{Path, PathBuf};

use super::File;
use crate::pose::MouthPreset;
use crate::project::Clip;
use crate::timeline::{MouthKey, Timeline};
use crate::timing::{self, Format, Interval, MOHO_FPS, Tier, Timing};

/// The shapes from key to key: each holds from midway between it and the one before.
pub(crate) fn shapes(clip: &Clip, fps: f64, mouths: MouthPreset) -> Timing {
    // A video moves a mouth without naming its shapes: then those of its speech are meant.
    let mut spoken = clip.clone();
    spoken.tracks = None;
    let timeline: Timeline = spoken.timeline(fps, mouths);
    let keys = timeline.mouth_keys();
    let duration = clip.duration();
    let between = |a: &MouthKey, b: &MouthKey| f64::midpoint(a.until, b.time);
    let mut tier = Tier::new("shapes");
    for (i, key) in keys.iter().enumerate() {
        let start = i.checked_sub(1).map_or(0.0, |b| between(&keys[b], key)).clamp(0.0, duration);
        let end = keys.get(i + 1).map_or(duration, |next| between(key, next)).clamp(start, duration);
        let Some(shape) = key.shape.filter(|_| end > start) else { continue };
        match tier.intervals.last_mut() {
            Some(last) if last.label == shape.to_string() && (start - last.end).abs() < 1e-9 => last.end = end,
            _ => tier.intervals.push(Interval::new(start, end, shape.to_string())),
        }
    }
    Timing { duration, tiers: vec![tier], guessed: clip.timing.guessed }
}

/// Rhubarb's three.
pub(crate) const RHUBARB: [Format; 3] = [Format::RhubarbTsv, Format::RhubarbXml, Format::RhubarbJson];

/// The file of one of Rhubarb's forms.
pub(crate) fn rhubarb_path(base: &Path, format: Format) -> PathBuf {
    super::with_ending(base, &format!("rhubarb.{}", format.extension()))
}

/// The shapes in Rhubarb's forms.
pub(crate) fn rhubarb(timing: &Timing, base: &Path) -> Vec<File> {
    RHUBARB
        .map(|format| File { path: rhubarb_path(base, format), bytes: timing::write(timing, format).into_bytes() })
        .into()
}

/// Moho's, at `fps` frames a second.
pub(crate) fn moho(mut timing: Timing, fps: f64, base: &Path) -> Vec<File> {
    timing.stretch(fps / MOHO_FPS);
    let path = super::with_ending(base, Format::Moho.extension());
    vec![File { path, bytes: timing::write(&timing, Format::Moho).into_bytes() }]
}

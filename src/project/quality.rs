//! How good a lesson is where nothing is wrong: its recordings, and the times that deserve a look.

use super::{Clip, Finding};

/// Judges a clip: its recording, and each place of its times that deserves a look.
pub(super) fn of_clip(clip: &Clip) -> Vec<Finding> {
    let name = &clip.entry.name;
    let mut found = Vec::new();
    if let Some(sound) = &clip.sound {
        let quality = sound.quality();
        found.push(Finding::Fine(format!(
            "clip {name}: voice at {:.0} dB, noise at {:.0} dB, peaks at {:.1} dB",
            quality.voice_db, quality.noise_db, quality.peak_db
        )));
        let odd = quality.remarks().into_iter().map(|r| Finding::Odd(format!("clip {name}: its sound: {r}").into()));
        found.extend(odd);
    }
    for doubt in clip.to_look_at() {
        let what = clip.told(&doubt);
        found.push(Finding::Odd(format!("clip {name}: {:.2} to {:.2} s: {what}", doubt.start, doubt.end).into()));
    }
    found
}

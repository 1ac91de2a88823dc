//! The analyses that a project lacks, run in memory for whoever only reads it: times found in the sound, ratios found in
//! the video. Nothing is written.

use super::align::AlignJob;
use super::tracking::{Method, TrackJob};
use crate::disk::{Message, Task, message};
use crate::project::edit::Lesson;
use crate::project::files::Clip;
use crate::track::Options;

/// Hears how far the tracking of a clip is: its name, frames done, frames in all where that is known. `false` stops it.
pub type Tracking<'a> = &'a dyn Fn(&str, usize, Option<usize>) -> bool;

/// Finds the times and ratios that the clips of these numbers lack. Returns what an author should know of them: what was
/// found or not, guessed times, odd recordings, faces whose points are in no file.
pub fn prepare(lesson: &mut Lesson, clips: &[usize], tracking: Tracking<'_>) -> Vec<Message> {
    let mut notes = lesson.state_notes();
    notes.extend(align_missing(lesson, clips));
    notes.extend(track_missing(lesson, clips, tracking));
    for clip in clips.iter().filter_map(|n| lesson.clips.get(*n)) {
        notes.extend(guessed(clip));
        notes.extend(recording(clip));
        if clip.lost_its_record() && clip.video.is_none() {
            let name = &clip.entry.name;
            notes.push(
                format!("the ratios.csv of clip {name} is gone, and so is its video: its ratios are neutral").into(),
            );
        }
    }
    notes.extend(lesson.faces.iter().filter(|f| f.looks_each_time()).map(|face| {
        let looked = format!("the points of face {} were looked for in its photo; ", face.entry.name);
        message![looked, Task::FindFace, " keeps them"]
    }));
    notes
}

fn align_missing(lesson: &mut Lesson, clips: &[usize]) -> Vec<Message> {
    let wanted: Vec<usize> =
        clips.iter().copied().filter(|n| lesson.clips.get(*n).is_some_and(Clip::wants_alignment)).collect();
    let found = AlignJob::of(lesson, &wanted).map(|job| job.run()).unwrap_or_default();
    let mut notes = Vec::new();
    for (number, found) in found {
        let name = lesson.clips[number].entry.name.clone();
        notes.push(match found {
            Ok(found) => {
                lesson.take_alignment(number, &found);
                message![format!("the times of clip {name} were found in its sound; "), Task::Align, " keeps them"]
            }
            Err(fault) => fault.to_message().after(format!("the times of clip {name} are guessed: ")),
        });
    }
    notes
}

fn track_missing(lesson: &mut Lesson, clips: &[usize], tracking: Tracking<'_>) -> Vec<Message> {
    let mut notes = Vec::new();
    for number in clips.iter().copied() {
        let Some(clip) = lesson.clips.get(number).filter(|c| c.wants_tracking()) else { continue };
        let name = clip.entry.name.clone();
        let job = TrackJob::of(lesson, number, Method::default(), Options::default());
        let found = job.and_then(|job| job.run(&mut |done, of| tracking(&name, done, of)));
        notes.push(match found {
            Ok(found) => {
                lesson.take_tracked(number, found.tracked, &found.checksum);
                let followed = format!("the face in the video of clip {name} was followed; ");
                message![followed, Task::Track, " keeps what was found"]
            }
            Err(fault) => fault.to_message().after(format!("the face in the video of clip {name} was not followed: ")),
        });
    }
    notes
}

/// Frames drawn from guessed times look as sure as any others.
fn guessed(clip: &Clip) -> Option<Message> {
    (clip.timing.guessed && !clip.syllables.is_empty())
        .then(|| message![format!("the times of clip {} are guessed; set them in ", clip.entry.name), Task::Open])
}

/// The flaws of a recording, and the syllables that lie beyond its end.
fn recording(clip: &Clip) -> Vec<Message> {
    let Some(sound) = &clip.sound else { return Vec::new() };
    let name = &clip.entry.name;
    let warning = |warning: &String| Message::from(format!("the recording of clip {name}: {warning}"));
    let mut notes: Vec<Message> = sound.warnings.iter().map(warning).collect();
    let end = sound.duration();
    // Rounded times may end a hair later.
    if let Some(over) = clip.intervals().iter().find(|i| i.end > end + 0.01) {
        let late = format!("`{}` of clip {name} ends at {:.2} s, its recording at {end:.2} s", over.label, over.end);
        notes.push(late.into());
    }
    notes
}

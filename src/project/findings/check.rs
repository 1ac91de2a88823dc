//! What a lesson has, what it lacks, and what is wrong with it.

use std::path::Path;

use crate::calibration::ShotFiles;
use crate::disk::{Fault, Message, Pending, Task, message, read_bytes};
use crate::face::{FeaturePoint, How};
use crate::figure::Figure;
use crate::photo::{MAX_PHOTO_BYTES, Photo, sha256};
use crate::project::count::counted;
use crate::project::edit::Unsaved;
use crate::project::files::{Clip, LessonFace, MANIFEST, Manifest, figure, layer, read_settled};
use crate::script::Lang;
use crate::timeline::KeyValue;

/// Syllables a second that nobody reaches; fast Mandarin has 7.
const FASTEST: f64 = 11.0;

/// One thing that a check found.
#[derive(Debug)]
pub enum Finding {
    /// It is there.
    Fine(String),
    /// It is not there, or odd, and the lesson works all the same.
    Odd(Message),
    /// The lesson, or this part of it, cannot be used.
    Wrong(Fault),
}

/// Checks the lesson in `root`, every clip for itself, so that one damaged file does not hide the rest.
#[must_use]
pub fn check(root: &Path) -> Vec<Finding> {
    find(root, |_| Vec::new())
}

/// The same, with how good the recordings are and every place of their times that deserves a look.
#[must_use]
pub fn check_quality(root: &Path) -> Vec<Finding> {
    find(root, of_quality)
}

fn find(root: &Path, more: impl Fn(&Clip) -> Vec<Finding>) -> Vec<Finding> {
    let manifest = match Manifest::read(root) {
        Ok(manifest) => manifest,
        Err(fault) => return vec![Finding::Wrong(fault)],
    };
    match read_settled(root, |pending| of_files(root, &manifest, pending, &more)) {
        Ok((mut found, notes)) => {
            found.extend(notes.into_iter().map(Finding::Odd));
            match Unsaved::of(root) {
                Ok(unsaved) => found.extend(unsaved.note().map(Finding::Odd)),
                Err(fault) => found.push(Finding::Wrong(fault)),
            }
            found
        }
        Err(fault) => vec![Finding::Wrong(fault)],
    }
}

fn of_files(
    root: &Path,
    manifest: &Manifest,
    pending: &Pending,
    more: &impl Fn(&Clip) -> Vec<Finding>,
) -> Vec<Finding> {
    let mut found = vec![Finding::Fine(format!(
        "{}: “{}”, {} at {} frames a second, {} × {}",
        MANIFEST,
        manifest.title,
        counted(manifest.clips.len(), "clip"),
        manifest.output.fps,
        manifest.output.size[0],
        manifest.output.size[1]
    ))];
    if manifest.clips.is_empty() {
        found.push(Finding::Odd("there are no clips yet: add a [[clip]]".into()));
    }
    for entry in &manifest.clips {
        match Clip::read(root, entry, pending) {
            Ok(clip) => found.extend(of_clip(&clip).into_iter().chain(more(&clip))),
            Err(fault) => found.push(Finding::Wrong(fault)),
        }
    }
    for entry in &manifest.faces {
        match LessonFace::read(root, entry, pending) {
            Ok(face) => found.extend(of_face(root, &face)),
            Err(fault) => found.push(Finding::Wrong(fault)),
        }
    }
    found
}

fn of_face(root: &Path, face: &LessonFace) -> Vec<Finding> {
    let name = &face.entry.name;
    let whose = format!("face {name}: ");
    let figure = match figure(root, Some(face)) {
        Ok(figure) => figure,
        Err(fault) => return vec![Finding::Wrong(fault)],
    };
    let mut found = Vec::new();
    let is_cartoon = matches!(figure, Figure::Cartoon(_));
    match &face.face {
        Some(points) => {
            let set = FeaturePoint::all().filter_map(|p| points.placed(p)).filter(|p| p.how == How::Hand).count();
            let by_hand = if set > 0 { format!(", {set} set by hand") } else { String::new() };
            let drawn = if is_cartoon { "drawn as a cartoon" } else { "with points, drawn as a line figure" };
            found.push(Finding::Fine(format!("face {name}: {drawn}{by_hand}")));
            if let Some(what) = points.oddity() {
                found.push(odd(
                    &whose,
                    message![
                        format!("{what}: "),
                        Task::Open,
                        " shows the points, ",
                        Task::FindFace,
                        " finds them again"
                    ],
                ));
            }
            match &face.photo {
                None => found.push(odd(&whose, "its photo is not there, so its points cannot be found again")),
                Some(path) => match read_bytes(path, MAX_PHOTO_BYTES).map(|bytes| sha256(&bytes)) {
                    Ok(sum) if sum != points.photo.sha256 && Photo::read(path).is_ok() => {
                        found.push(odd(
                            &whose,
                            message!["its points are of another photo: ", Task::FindFace, " finds them in this one"],
                        ));
                    }
                    Ok(sum) if sum != points.photo.sha256 => found.extend(unreadable(path)),
                    Ok(_) => {}
                    Err(fault) => found.push(Finding::Wrong(fault)),
                },
            }
        }
        None if is_cartoon => {
            found.push(odd(
                &whose,
                message!["its points are looked for each time; ", Task::FindFace, " finds and keeps them"],
            ));
        }
        None if face.photo.is_some() => {
            found.push(odd(
                &whose,
                message!["it has a photo and no points yet: ", Task::FindFace, " finds them for a cartoon"],
            ));
        }
        None => {}
    }
    if face.face.is_none() {
        found.extend(face.photo.as_deref().and_then(unreadable));
    }
    found.extend(face.shots.iter().filter_map(|shot| unreadable(shot.photo.as_deref()?)));
    found.extend(of_shots(face));
    if let (false, Some(style)) = (is_cartoon, &face.entry.style) {
        found.push(odd(&whose, format!("line figures have no styles, `{style}` changes nothing")));
    }
    if !is_cartoon && !face.entry.layers.is_empty() {
        found.push(odd(&whose, "line figures have no layers of their own, `layers` changes nothing"));
    }
    for entry in face.entry.layers.iter().filter(|_| is_cartoon) {
        if let Ok(layer) = layer(root, entry)
            && !layer.left_out.is_empty()
        {
            found.push(odd(&whose, format!("`{}` is drawn without {}", entry.file, layer.left_out.join(", "))));
        }
    }
    found
}

/// A photo that cannot be read.
fn unreadable(path: &Path) -> Option<Finding> {
    Photo::read(path).err().map(Finding::Wrong)
}

/// The shots of a face, and whether its calibration is of them.
fn of_shots(face: &LessonFace) -> Option<Finding> {
    let name = &face.entry.name;
    let shots = counted(face.shots.iter().filter(|s| s.photo.is_some()).count(), "photo");
    if let Some(what) = &face.damage {
        let what = format!("its calibration.toml cannot be read ({what})");
        return Some(Finding::Odd(message![format!("face {name}: {what}; "), Task::Calibrate, " makes it anew"]));
    }
    let Some(file) = &face.calibration else {
        let any = face.shots.iter().any(|s| s.photo.is_some());
        return any.then(|| {
            Finding::Odd(message![
                format!("face {name}: {shots} of emotions, never calibrated; "),
                Task::Calibrate,
                " does that"
            ])
        });
    };
    // The photos may be others too, which only their bytes tell.
    if ShotFiles::of(&face.folder).is_ok_and(|files| files.sums == file.inputs) {
        let retake = file.quality.retake.as_ref();
        return Some(match retake {
            None => Finding::Fine(format!("face {name}: calibrated with {shots} of emotions")),
            Some(retake) => {
                Finding::Odd(format!("face {name}: calibrated with {shots} of emotions; {}", retake.why).into())
            }
        });
    }
    let what = "its photos or points were changed since it was calibrated";
    Some(Finding::Odd(message![format!("face {name}: {what}; "), Task::Calibrate, " does that again"]))
}

fn of_clip(clip: &Clip) -> Vec<Finding> {
    let mut found = vec![contents(clip)];
    found.extend(of_ratios(clip));
    found.extend(of_speech(clip));
    found.extend(of_times(clip));
    found
}

/// What a clip has.
fn contents(clip: &Clip) -> Finding {
    let name = &clip.entry.name;
    let mut parts = vec![format!("{:.2} s", clip.duration())];
    parts.push(match &clip.sound {
        Some(sound) => format!("sound at {} Hz", sound.rate),
        None => "no sound".into(),
    });
    if !clip.syllables.is_empty() {
        parts.push(counted(clip.syllables.len(), "syllable"));
    }
    if let Some(record) = &clip.record {
        parts.push(format!("{} of ratios", counted(record.rows.len(), "row")));
    }
    if let Some(video) = clip.video.as_ref().and_then(|v| v.file_name()) {
        parts.push(format!("video {}", video.to_string_lossy()));
    }
    let keys = clip.score.keys.len();
    if keys > 0 {
        parts.push(counted(keys, "key"));
    }
    Finding::Fine(format!("clip {name}: {}", parts.join(", ")))
}

/// What is odd about a clip's times that are not found yet, its video and its ratios.
fn of_ratios(clip: &Clip) -> Vec<Finding> {
    let mut found = Vec::new();
    let whose = format!("clip {}: ", clip.entry.name);
    if clip.timing.guessed && !clip.syllables.is_empty() {
        found.push(odd(
            &whose,
            match clip.sound {
                Some(_) => {
                    message!["no times of its syllables are kept, each export finds them; ", Task::Align, " keeps them"]
                }
                None => message!["the syllables' times are guessed; set them in ", Task::Open],
            },
        ));
    }
    if clip.wants_tracking() {
        let what = match clip.lost_its_record() {
            true => "its ratios.csv is gone; ",
            false => "the face in its video was never followed; ",
        };
        found.push(odd(&whose, message![what, Task::Track, " finds its ratios"]));
    }
    if clip.video.is_none() && clip.lost_its_record() {
        found.push(odd(&whose, "its ratios.csv is gone, and so is its video: its ratios are neutral"));
    }
    let lost = clip.lost();
    if let Some(first) = lost.first() {
        let places = counted(lost.len(), "place");
        found.push(odd(
            &whose,
            format!("{places} of its video to look at, the first at {:.2} s: {}", first.start, clip.told(first)),
        ));
    }
    found
}

/// What is odd about a clip's recording, its script and the tiers that move its mouth.
fn of_speech(clip: &Clip) -> Vec<Finding> {
    let mut found = Vec::new();
    let whose = format!("clip {}: ", clip.entry.name);
    if clip.sound.is_some() && clip.syllables.is_empty() && clip.tracks.is_none() {
        found.push(odd(&whose, "there is sound and no script, so the mouth stays shut"));
    }
    if clip.sound.is_none() && !clip.syllables.is_empty() {
        found.push(odd(&whose, "there is no recording: put it there as speech.wav"));
    }
    let sounding: f64 = clip.sound.iter().flat_map(|s| s.sounding()).map(|(a, b)| b - a).sum();
    let rate = clip.syllables.len() as f64 / sounding.max(1e-3);
    if clip.sound.is_some() && rate > FASTEST {
        found.push(odd(
            &whose,
            format!("{rate:.0} syllables a second is more than anyone says: is this the script of this sound?"),
        ));
    }
    if clip.timing.tier("shapes").is_some() && !clip.syllables.is_empty() {
        found.push(odd(&whose, "its tier `shapes` moves the mouth; syllables' times and readings do not"));
    }
    if clip.timing.tier("phones").is_some_and(|t| !t.intervals.is_empty()) && clip.syllables_with_phones() == 0 {
        found.push(odd(
            &whose,
            "its tier `phones` is kept and moves nothing: its names are not those of Pinyin or ARPAbet",
        ));
    }
    found
}

/// What is odd about a clip's times, readings, pins and keys.
fn of_times(clip: &Clip) -> Vec<Finding> {
    let mut found = Vec::new();
    let whose = format!("clip {}: ", clip.entry.name);
    let doubts = clip.doubts();
    if let Some(first) = doubts.first() {
        let text = first.syllable.and_then(|s| clip.syllables.get(s)).map_or("beside the script", |s| s.text.as_str());
        found.push(odd(
            &whose,
            format!(
                "{} of its times to look at, the first at {:.2} s ({text})",
                counted(doubts.len(), "place"),
                first.start
            ),
        ));
    }
    let unread = clip.syllables.iter().filter(|s| s.lang == Lang::Zh && s.pinyin.is_empty()).count();
    if unread > 0 {
        found.push(odd(
            &whose,
            format!("{} without a known reading: write it as 字{{zi4}}", counted(unread, "character")),
        ));
    }
    if let Some(pin) = clip.score.pins.iter().find(|p| **p >= clip.syllables.len()) {
        found.push(odd(&whose, format!("`pins` names syllable {pin}, and there are {}", clip.syllables.len())));
    }
    found.extend(clip.warnings.iter().map(|w| odd(&whose, w)));
    let end = clip.duration();
    let late =
        clip.score.keys.iter().filter(|k| k.time > end + 1e-6 && !matches!(k.value, KeyValue::Emotion(_))).count();
    if late > 0 {
        found.push(odd(&whose, format!("{} after its end", counted(late, "key"))));
    }
    if let Some(over) = clip.intervals().iter().find(|i| i.end > end + 0.05) {
        found.push(odd(&whose, format!("`{}` ends at {:.2} s, after the sound", over.label, over.end)));
    }
    found
}

/// Judges a clip: its recording, and each place of its times that deserves a look.
fn of_quality(clip: &Clip) -> Vec<Finding> {
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

fn odd(whose: &str, text: impl Into<Message>) -> Finding {
    Finding::Odd(text.into().after(whose))
}

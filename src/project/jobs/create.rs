//! A new lesson from a photo, a recording and its script, times, or a ratio record. Everything is checked before anything is
//! made, and the folder appears whole or not at all.

use std::path::{Path, PathBuf};

use super::align::AlignJob;
use super::tracking::{Method, TrackJob};
use crate::calibration::{Kept, Quality};
use crate::disk::{
    Commit, Fault, FileFault, Message, Result, Setting, Sums, SystemCalls, Task, clean_line, clear_temporaries, list,
    make_folder, message, plain_name, read_bytes, read_text, temporary_prefix, write_whole,
};
use crate::face::{Anchors, Created, Warning};
use crate::figure::LineFigure;
use crate::media::sound_of;
use crate::pose::Emotion;
use crate::project::ProjectFault;
use crate::project::edit::Lesson;
use crate::project::files::{
    Brought, ClipEntry, FRAMES_FPS, FaceEntry, MANIFEST, Manifest, OWN_FOLDER, Output, SOUNDS, copy_video, frame_of,
    read_script, write_face,
};
use crate::ratios::import;
use crate::script::System;
use crate::speech::Note;
use crate::timing::{self, Format};
use crate::track::Options;

/// The largest recording that is copied: hours of sound.
const MAX_SOUND_BYTES: u64 = 4 << 30;

/// What a new lesson is made from.
#[derive(Debug, Default)]
pub struct NewLesson {
    /// Its title; the folder's name where left out.
    pub title: Option<String>,
    /// The recording.
    pub speech: Option<PathBuf>,
    /// What is said in it.
    pub script: Option<PathBuf>,
    /// How the script is written.
    pub system: Option<System>,
    /// When it is said, in any timing format.
    pub timing: Option<PathBuf>,
    /// A ratio record.
    pub ratios: Option<PathBuf>,
    /// The neutral photo of whoever speaks.
    pub neutral: Option<PathBuf>,
    /// Where its face is, in pixels of the photo, where it is not found.
    pub anchors: Option<Anchors>,
    /// Photos of the same person's other emotions.
    pub shots: Vec<(Emotion, PathBuf)>,
    /// A video of the person: a file, or a folder of pictures.
    pub video: Option<PathBuf>,
    /// Frames a second of a video that is a folder of pictures.
    pub video_fps: Option<f64>,
    /// The number of the frame that is the neutral photo where none is given; the first where left out.
    pub neutral_frame: Option<u32>,
    /// The figure.
    pub figure: Option<String>,
}

/// A lesson that was made.
#[derive(Debug)]
pub struct Made {
    /// The lesson, read back.
    pub lesson: Lesson,
    /// What there is to say of its photo.
    pub warnings: Vec<Warning>,
    /// What there is to say of its recording and its video.
    pub notes: Vec<Message>,
    /// How good the calibration of its face is, where it was calibrated.
    pub calibration: Option<Quality>,
}

/// Makes the lesson `root` and returns it, read back. Where it has a video, `go_on` is told how many of its frames were
/// looked at, of how many, and stops that by `false`: the lesson is made without it then.
///
/// # Errors
/// When the folder is taken, or an input cannot be used; then nothing is left behind.
pub fn create(root: &Path, new: &NewLesson, go_on: &mut dyn FnMut(usize, Option<usize>) -> bool) -> Result<Made> {
    let Some(name) = root.file_name().and_then(|n| n.to_str()).map(str::to_owned) else {
        return Err(Fault::of(
            ProjectFault::Request,
            format!("`{}` does not end in a name for the lesson", root.display()),
        )
        .help("give the folder to make, such as lessons/nihao")
        .of_the_call());
    };
    plain_name(&name).map_err(Fault::of_the_call)?;
    let taken = root.symlink_metadata().is_ok() && list(root).map_or(true, |there| !there.is_empty());
    if taken {
        return Err(Fault::of(ProjectFault::Taken, "something of that name is already there")
            .at(root)
            .help("choose another name"));
    }
    let has_clip = has_clip(new);
    check_request(new)?;
    let parent = match root.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let has_face = new.neutral.is_some() || new.video.is_some();
    let figure = new.figure.as_deref().unwrap_or(if has_face { CARTOON } else { "line" });
    if figure != CARTOON {
        LineFigure::built_in(figure).map_err(Fault::of_the_call)?;
    } else if !has_face {
        return Err(Fault::of(ProjectFault::Request, "a cartoon needs a photo")
            .help(message!["give ", Setting::Neutral])
            .of_the_call());
    }
    check_inputs(new)?;
    // Before a folder is made: a photo in which no face is found leaves nothing behind.
    let face = neutral(new)?;
    let shots = new
        .shots
        .iter()
        .map(|(e, path)| Ok((*e, Brought::read(path)?)))
        .collect::<Result<Vec<(Emotion, Brought)>>>()?;
    make_folder(parent).map_err(|e| Fault::io("cannot make the folder", parent, e))?;
    clear_temporaries(parent);
    let draft = tempfile::Builder::new()
        .prefix(&temporary_prefix())
        .tempdir_in(parent)
        .map_err(|e| Fault::io("cannot make the lesson's folder", parent, e))?;
    let clip = ClipEntry {
        name: name.clone(),
        face: None,
        script_system: new.system.filter(|s| *s != System::Auto),
        onsets: Default::default(),
        take_of: None,
        video_fps: new.video_fps.filter(|_| new.video.as_deref().is_some_and(Path::is_dir)),
    };
    let face_entry = FaceEntry {
        name: FACE.into(),
        figure: Some(figure.into()),
        style: None,
        mouths: Default::default(),
        layers: Vec::new(),
    };
    let title = clean_line(new.title.as_deref().unwrap_or(&name), 200);
    let entries = (title, face_entry, has_clip.then_some(clip));
    let found = furnish(draft.path(), new, face.as_ref(), &shots, entries, go_on);
    let (notes, calibration) = found.map_err(|fault| fault.moved(draft.path(), root))?;
    if root.exists() {
        std::fs::remove_dir(root).map_err(|e| Fault::io("cannot use the empty folder", root, e))?;
    }
    open_to_others(draft.path());
    let made = draft.keep();
    std::fs::rename(&made, root).map_err(|e| {
        let _ = std::fs::remove_dir_all(&made);
        Fault::io("cannot make the lesson's folder", root, e)
    })?;
    let warnings = face.map_or_else(Vec::new, |(_, created)| created.warnings);
    Ok(Made { lesson: Lesson::read(root)?, warnings, notes, calibration })
}

/// Writes the files of a new lesson into its draft, with what is found in them; what there is to say of that.
fn furnish(
    draft: &Path,
    new: &NewLesson,
    face: Option<&(Brought, Created)>,
    shots: &[(Emotion, Brought)],
    entries: (String, FaceEntry, Option<ClipEntry>),
    go_on: &mut dyn FnMut(usize, Option<usize>) -> bool,
) -> Result<(Vec<Message>, Option<Quality>)> {
    let (title, face_entry, clip) = entries;
    let mut notes = Vec::new();
    if let Some(clip) = &clip {
        notes.extend(fill(draft, clip, new)?);
    }
    let faces = draft.join("faces").join(FACE);
    if let Some((photo, created)) = face {
        photo.write(&faces, Emotion::Neutral)?;
        write_face(&faces, created)?;
    }
    for (emotion, shot) in shots {
        shot.write(&faces, *emotion)?;
    }
    let manifest =
        Manifest { title, faces: vec![face_entry], clips: clip.into_iter().collect(), output: Output::default() };
    write_whole(&draft.join(MANIFEST), manifest.to_toml().as_bytes())?;
    write_whole(&draft.join(".gitignore"), b"/.lianpu/\n/export/\n")?;
    // Read back as anyone would read it: a lesson that cannot be opened is not made. Faults name the author's own
    // files, not the draft's.
    let mut lesson = Lesson::read(draft).map_err(|f| of_inputs(f, new))?;
    if new.script.is_some() && lesson.clips.iter().any(|c| c.syllables.is_empty()) {
        let fault = Fault::of(FileFault::Empty, "there is nothing to say in the script")
            .help("write what is said in the recording");
        return Err(match &new.script {
            Some(path) => fault.at(path),
            None => fault,
        });
    }
    notes.extend(find_times(&mut lesson)?);
    let calibration = calibrate_shots(&lesson, new)?;
    notes.extend(follow_faces(&mut lesson, go_on)?);
    Ok((notes, calibration))
}

const fn has_clip(new: &NewLesson) -> bool {
    new.speech.is_some() || new.timing.is_some() || new.ratios.is_some() || new.video.is_some()
}

/// Makes sure that what is given for a lesson goes together.
fn check_request(new: &NewLesson) -> Result<()> {
    let has_clip = has_clip(new);
    if !has_clip && new.neutral.is_none() {
        return Err(Fault::of(ProjectFault::Request, "a lesson needs a photo, a recording, times, ratios, or a video")
            .help(message![
                "give ",
                Setting::Neutral,
                ", ",
                Setting::Speech,
                " and ",
                Setting::Script,
                ", ",
                Setting::Timing,
                ", ",
                Setting::Ratios,
                ", or ",
                Setting::Video
            ])
            .of_the_call());
    }
    if !new.shots.is_empty() && new.neutral.is_none() && new.video.is_none() {
        return Err(Fault::of(ProjectFault::Request, "shots of emotions are measured from the neutral face")
            .help(message!["give ", Setting::Neutral, " too"])
            .of_the_call());
    }
    if new.ratios.is_some() && new.video.is_some() {
        return Err(Fault::of(
            ProjectFault::Request,
            "the ratios of a clip are those of its video, or those of a file",
        )
        .help(message!["give ", Setting::Video, " or ", Setting::Ratios])
        .of_the_call());
    }
    if new.script.is_some() && !has_clip {
        return Err(Fault::of(ProjectFault::Request, "a script needs its recording, or its times")
            .help(message!["give ", Setting::Speech, ", or leave ", Setting::Script, " out for now"])
            .of_the_call());
    }
    Ok(())
}

/// Finds the times of a new lesson in its sound, and says what there is to say of them. A recording that cannot be
/// aligned is no reason not to make a lesson of it.
fn find_times(lesson: &mut Lesson) -> Result<Vec<Message>> {
    let wanted: Vec<usize> = (0..lesson.clips.len()).filter(|n| lesson.clips[*n].wants_alignment()).collect();
    let sounds = lesson.clips.iter().filter_map(|c| c.sound.as_ref());
    let mut notes: Vec<Message> = sounds.flat_map(|s| s.quality().remarks()).map(Message::from).collect();
    for (number, found) in AlignJob::of(lesson, &wanted)?.run() {
        match found {
            Ok(found) => {
                // That it is noisy is among what is said of the sound.
                let said = found.notes.iter().filter(|n| !matches!(n, Note::Noisy { .. }));
                notes.extend(said.map(|n| n.to_string().into()));
                lesson.take_alignment(number, &found);
                save_clip(lesson, number)?;
            }
            Err(fault) => notes.push(fault.to_message().after("its times could not be found: ")),
        }
    }
    Ok(notes)
}

/// Calibrates a new lesson's face where there are shots of it or a video to follow it in.
fn calibrate_shots(lesson: &Lesson, new: &NewLesson) -> Result<Option<Quality>> {
    let Some(face) = lesson.faces.first().filter(|_| !new.shots.is_empty() || new.video.is_some()) else {
        return Ok(None);
    };
    let kept = Kept::make(&face.folder).map_err(|f| of_inputs(f, new))?;
    in_draft(&lesson.root, |commit| kept.stage(&face.folder, |_| None, commit))?;
    Ok(Some(kept.made.quality))
}

/// Writes a clip's files in a draft.
fn save_clip(lesson: &mut Lesson, number: usize) -> Result<()> {
    let Lesson { root, clips, .. } = lesson;
    let sums = in_draft(root, |commit| clips[number].stage(commit))?;
    clips[number].written(&sums);
    Ok(())
}

/// Writes files in a draft, which nobody reads before it has its name; their sums.
fn in_draft(draft: &Path, stage: impl FnOnce(&mut Commit) -> Result<()>) -> Result<Sums> {
    let (own, like, none) = (draft.join(OWN_FOLDER), draft.join(MANIFEST), Sums::new());
    let mut commit = Commit::new(draft, &own, &like, &none);
    stage(&mut commit)?;
    let sums = commit.sums().clone();
    commit.run_unrecorded(&mut SystemCalls)?;
    Ok(sums)
}

/// Follows the faces in a new lesson's videos. A video in which that fails is no reason not to make a lesson of it.
fn follow_faces(lesson: &mut Lesson, go_on: &mut dyn FnMut(usize, Option<usize>) -> bool) -> Result<Vec<Message>> {
    let mut notes = Vec::new();
    for number in (0..lesson.clips.len()).filter(|n| lesson.clips[*n].wants_tracking()).collect::<Vec<_>>() {
        let job = TrackJob::of(lesson, number, Method::default(), Options::default())?;
        match job.run(go_on) {
            Ok(followed) => {
                notes.extend(followed.notes);
                notes.extend(followed.tracked.notes.iter().cloned());
                lesson.take_tracked(number, followed.tracked, &followed.checksum);
                lesson.clips[number].footage_changed = true;
                save_clip(lesson, number)?;
            }
            Err(fault) => {
                let what = fault.in_a_line().after("the face in its video could not be followed: ");
                notes.push(what.then("; then ").then(Task::Track));
            }
        }
    }
    Ok(notes)
}

/// What the face of a new lesson is called.
const FACE: &str = "teacher";
/// The figure that is drawn from a photo.
const CARTOON: &str = "cartoon";
/// The neutral photo of a new lesson, from a photo or a video, and the face in it.
fn neutral(new: &NewLesson) -> Result<Option<(Brought, Created)>> {
    if let Some(path) = &new.neutral {
        let photo = Brought::read(path)?;
        let created = photo.face(new.anchors).map_err(|f| f.at(path))?;
        return Ok(Some((photo, created)));
    }
    let Some(video) = &new.video else { return Ok(None) };
    let number = new.neutral_frame.unwrap_or(0);
    let photo = frame_of(video, new.video_fps.unwrap_or(FRAMES_FPS), number)?;
    let created = photo.face(new.anchors).map_err(|f| {
        Fault::of(FileFault::OutOfRange, format!("frame {number} cannot be the neutral face: {}", f.what()))
            .at(video)
            .help(message![
                "name one that shows it at rest, from the front: ",
                Setting::NeutralFrame,
                ", or give ",
                Setting::Neutral
            ])
    })?;
    Ok(Some((photo, created)))
}

/// Reads every input where it is, before a folder is made, so that a fault names the author's file and nothing is left.
fn check_inputs(new: &NewLesson) -> Result<()> {
    if let Some(path) = &new.speech {
        crate::media::Sound::read(path)?;
    }
    if let Some(path) = &new.script {
        read_script(path, new.system.unwrap_or(System::Auto))?;
    }
    if let Some(path) = &new.timing {
        timing::read(path)?;
    }
    if let Some(path) = &new.ratios {
        import::read(path)?;
    }
    Ok(())
}

/// Copies what a clip is made of into its folder; what there is to say of that.
fn fill(root: &Path, clip: &ClipEntry, new: &NewLesson) -> Result<Vec<Message>> {
    let mut notes = Vec::new();
    let folder = root.join("clips").join(&clip.name);
    make_folder(&folder).map_err(|e| Fault::io("cannot make the folder", &folder, e))?;
    if let Some(path) = &new.speech {
        // What it is its content says; its name must be one that is found again.
        let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
        let extension = if SOUNDS.contains(&extension.as_str()) { extension } else { "wav".into() };
        write_whole(&folder.join(format!("speech.{extension}")), &read_bytes(path, MAX_SOUND_BYTES)?)?;
    }
    if let Some(path) = &new.script {
        write_whole(&folder.join("script.txt"), read_text(path)?.as_bytes())?;
    }
    if let Some(path) = &new.timing {
        let timing = timing::read(path)?;
        write_whole(&folder.join("timing.TextGrid"), timing::write(&timing, Format::TextGrid).as_bytes())?;
    }
    if let Some(path) = &new.ratios {
        let (record, tracks, said) = import::read(path)?;
        notes.extend(said.into_iter().map(Message::from));
        write_whole(&folder.join("ratios.csv"), record.to_csv().as_bytes())?;
        if let Some(tracks) = tracks {
            write_whole(&folder.join("tracks.csv"), tracks.to_csv().as_bytes())?;
        }
    }
    if let Some(path) = &new.video {
        copy_video(path, &folder)?;
        if new.speech.is_none() && path.is_file() {
            // A video without a sound track is a video all the same.
            if let Err(fault) = sound_of(path, &folder.join("speech.wav")) {
                notes.push(format!("the video brings no sound: {}", fault.what()).into());
            }
        }
    }
    Ok(notes)
}

/// The fault with the author's file in place of its copy in the draft.
fn of_inputs(fault: Fault, new: &NewLesson) -> Fault {
    let copied = fault.path().and_then(|p| p.file_stem()).and_then(|s| s.to_str()).unwrap_or_default().to_owned();
    let original = match copied.as_str() {
        "speech" => &new.speech,
        "script" => &new.script,
        "timing" => &new.timing,
        "ratios" => &new.ratios,
        "neutral" | "face" => &new.neutral,
        "video" => &new.video,
        shot => &new.shots.iter().find(|(e, _)| e.name() == shot).map(|(_, path)| path.clone()),
    };
    let line = fault.line_number();
    let mut named = fault.without_place();
    if let Some(path) = original {
        named = named.at(path);
    }
    match line {
        Some(line) => named.line(line),
        None => named,
    }
}

/// A temporary folder is its owner's alone; a lesson is a folder like any other.
fn open_to_others(root: &Path) {
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // Where this fails the lesson is private, and works.
        let _ = std::fs::set_permissions(root, std::fs::Permissions::from_mode(0o755));
    }
    #[cfg(not(unix))]
    let _ = root;
}

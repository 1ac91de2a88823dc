//! `lianpu new`.

use std::io::Write;
use std::path::PathBuf;

use super::frames_done::FramesDone;
use super::{print, wording};
use crate::disk::Result;
use crate::pose::Emotion;
use crate::project::{Made, NewLesson, create};
use crate::script::System;

/// Make a lesson from a photo, a recording and its script, from a video, from times, or from ratios.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The folder to make; its last part names the lesson and its clip.
    #[arg(value_name = "PROJECT")]
    project: PathBuf,
    /// The recording: WAV, AIFF, FLAC, OGG, MP3, M4A, or a video with its sound.
    #[arg(long, value_name = "FILE")]
    speech: Option<PathBuf>,
    /// What is said in it: characters, Pinyin, Zhuyin, Tongyong or English.
    #[arg(long, value_name = "FILE")]
    script: Option<PathBuf>,
    /// How the script is written; told from the text where left out.
    #[arg(long, value_name = "SYSTEM")]
    from: Option<System>,
    /// When it is said: TextGrid, SRT, WebVTT, CSV, JSON, labels of Audacity, CTM, HTK; or mouth shapes of Rhubarb or Moho.
    #[arg(long, value_name = "FILE")]
    timing: Option<PathBuf>,
    /// Ratios: ratios.csv or .lpr, or what OpenFace, MediaPipe, ARKit or Live Link Face have written.
    #[arg(long, value_name = "FILE")]
    ratios: Option<PathBuf>,
    /// A video of whoever speaks: a file (by ffmpeg), or a folder of pictures. Its face drives the cartoon's.
    #[arg(long, value_name = "FILE")]
    video: Option<PathBuf>,
    /// Frames a second of a folder of pictures; 25 where left out. A video file knows its own.
    #[arg(long, value_name = "FPS", requires = "video", value_parser = fps)]
    video_fps: Option<f64>,
    /// The frame of the video that is the neutral photo, counted from 0; the first where left out.
    #[arg(long, value_name = "N", requires = "video", conflicts_with = "neutral")]
    neutral_frame: Option<u32>,
    /// A photo of one of the person's other emotions: happy, anger, disgust, sadness, fear or surprised. Points that
    /// lie beside it in a .pts or .asf file of its name are taken along.
    #[arg(long = "shot", value_name = "EMOTION=PHOTO", value_parser = shot)]
    shots: Vec<(Emotion, PathBuf)>,
    /// A photo of whoever speaks, from the front, mouth closed: it becomes a cartoon.
    #[arg(long, value_name = "PHOTO")]
    neutral: Option<PathBuf>,
    /// Where the face is in a photo in which it is not found: the eye at the image's left,
    /// the one at its right, mouth, chin, in pixels.
    #[arg(long, value_name = "X,Y", num_args = 4, allow_hyphen_values = true)]
    at: Vec<String>,
    /// The figure: cartoon (which needs a photo), line or cat.
    #[arg(long, value_name = "NAME")]
    figure: Option<String>,
    /// The lesson's title; its folder's name where left out.
    #[arg(long)]
    title: Option<String>,
}

/// Makes the lesson and prints what comes next.
pub(crate) fn run(args: &Args, out: &mut dyn Write) -> Result<()> {
    let new = NewLesson {
        title: args.title.clone(),
        speech: args.speech.clone(),
        script: args.script.clone(),
        system: args.from,
        timing: args.timing.clone(),
        ratios: args.ratios.clone(),
        neutral: args.neutral.clone(),
        shots: args.shots.clone(),
        video: args.video.clone(),
        video_fps: args.video_fps,
        neutral_frame: args.neutral_frame,
        anchors: super::face::anchors(&args.at)?,
        figure: args.figure.clone(),
    };
    let made = {
        let bar = FramesDone::default();
        create(&args.project, &new, &mut |done, of| bar.show("the video", done, of))?
    };
    let Made { lesson, warnings, notes, calibration } = made;
    let root = args.project.display();
    let mut say = |text: String| print::say(out, text);
    match lesson.clips.first() {
        Some(clip) => {
            let syllables = match clip.syllables.len() {
                0 => String::new(),
                1 => ", 1 syllable".into(),
                n => format!(", {n} syllables"),
            };
            say(format!("made {root}: {:.2} s{syllables}", clip.duration()))?;
            for warning in &clip.warnings {
                say(format!("note: {}", wording::worded(warning)))?;
            }
            for note in &notes {
                say(format!("note: {}", wording::worded(note)))?;
            }
            let doubts = clip.doubts();
            match doubts.first() {
                Some(first) => {
                    let places = if doubts.len() == 1 { "1 place".into() } else { format!("{} places", doubts.len()) };
                    say(format!(
                        "its times were found in the sound, {places} to look at, the first at {:.2} s",
                        first.start
                    ))?;
                }
                None if clip.score.aligned.is_some() => say("its times were found in the sound".into())?,
                None => {}
            }
            if clip.sound.is_some() && clip.syllables.is_empty() {
                say("what is said in it is not known yet: in the studio m marks its syllables, Enter types words onto them".into())?;
            }
            if clip.timing.guessed {
                say("the times of its syllables are guessed: equal shares of the sound, until you move them".into())?;
            }
        }
        None => say(format!("made {root}: a face, and no clip yet"))?,
    }
    for warning in &warnings {
        say(format!("note on the photo: {warning}"))?;
    }
    for note in calibration.iter().flat_map(|quality| &quality.notes) {
        say(format!("note on the shots: {note}"))?;
    }
    let quoted = if args.project.to_string_lossy().contains(' ') { format!("'{root}'") } else { root.to_string() };
    if lesson.clips.is_empty() {
        say("next, to see and correct the face in the studio:".into())?;
        return say(format!("  lianpu {quoted}"));
    }
    say("next, to see and correct it in the studio, and to write its frames:".into())?;
    say(format!("  lianpu {quoted}"))?;
    say(format!("  lianpu export {quoted} --to png"))
}

fn fps(text: &str) -> Result<f64, String> {
    let fps = text.parse::<f64>().ok().filter(|f| (1.0..=240.0).contains(f));
    fps.ok_or_else(|| format!("`{text}` is no frame rate: give frames a second from 1 to 240"))
}

fn shot(text: &str) -> Result<(Emotion, PathBuf), String> {
    let (emotion, path) = text.split_once('=').ok_or("write it as happy=PHOTO")?;
    match emotion.parse::<Emotion>() {
        Ok(Emotion::Neutral) => Err("the neutral photo is given by --neutral PHOTO".into()),
        Ok(emotion) if !path.is_empty() => Ok((emotion, path.into())),
        Ok(_) => Err("the photo is missing: write it as happy=PHOTO".into()),
        Err(what) => Err(format!("{what}: happy, anger, disgust, sadness, fear or surprised")),
    }
}

//! The face in a clip's video followed: what it takes as something that can go to a thread, and the calibration that it
//! goes by.
//!
//! How a face is followed is the business of `track`, what its shapes mean that of `calibration`.

use std::path::PathBuf;

use crate::calibration::Kept;
use crate::disk::{Fault, Message, Result, Task, message};
use crate::media::Source;
use crate::project::ProjectFault;
use crate::project::edit::Lesson;
use crate::project::files::LessonFace;
use crate::track::{self, Options, Tracked};

/// How a face is followed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Method {
    /// By the person's active appearance model (paper sec. 3).
    #[default]
    Aam,
    /// By regions of eyes and mouth (thesis sec. 6.2).
    Regions,
}

impl Method {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Aam, Self::Regions];

    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Aam => "aam",
            Self::Regions => "regions",
        }
    }
}

/// A clip's video to be followed, apart from its lesson.
#[derive(Debug, Clone)]
pub struct TrackJob {
    video: PathBuf,
    fps: f64,
    face: LessonFace,
    method: Method,
    options: Options,
}

/// What a job has found.
#[derive(Debug)]
pub struct Followed {
    /// Ratios, eyes, mouth and head, and what there is to say of them.
    pub tracked: Tracked,
    /// The checksum of what it was found from.
    pub checksum: String,
    /// What there is to say of the calibration.
    pub notes: Vec<Message>,
}

impl TrackJob {
    /// What it takes to follow the face in a clip's video. Nothing is opened yet.
    ///
    /// # Errors
    /// When the clip has no video or no face.
    pub fn of(lesson: &Lesson, number: usize, method: Method, options: Options) -> Result<Self> {
        let clip =
            lesson.clips.get(number).ok_or_else(|| Fault::of(ProjectFault::NoSuchClip, "there is no such clip"))?;
        let Some(video) = clip.video.clone() else {
            return Err(Fault::of(ProjectFault::Incomplete, format!("the clip `{}` has no video", clip.entry.name))
                .at(&clip.folder)
                .help("put it there as video.mp4, or as pictures in a folder frames/"));
        };
        let face = lesson
            .manifest
            .face_of(&clip.entry)
            .and_then(|entry| lesson.faces.iter().find(|f| f.entry.name == entry.name))
            .ok_or_else(|| {
                Fault::of(
                    ProjectFault::Incomplete,
                    format!("the clip `{}` has no face to compare its video with", clip.entry.name),
                )
                .at(&lesson.root)
                .help("add a [[face]] to lianpu.toml, and its photo as faces/NAME/neutral.png")
            })?;
        Ok(Self { video, fps: clip.video_fps(), face: face.clone(), method, options })
    }

    /// Follows the face through the video. `go_on` is told how many frames are done, of how many, and stops it by
    /// `false`.
    ///
    /// # Errors
    /// When the video, the calibration or a frame cannot be read, the face has no points where they are needed, or it was
    /// stopped.
    pub fn run(&self, go_on: &mut dyn FnMut(usize, Option<usize>) -> bool) -> Result<Followed> {
        let source = Source::of(&self.video, self.fps)?;
        let (kept, notes) = Kept::of(&self.face.folder)?;
        let checksum = checksum(&source, &kept, self.method, &self.options)?;
        let made = &kept.made;
        let tracked = match self.method {
            Method::Aam => track::by_aam(&source, &made.model, &made.calibration, &self.options, go_on)?,
            Method::Regions => {
                let face = self.face.points()?;
                let face = face.as_deref().ok_or_else(|| {
                    Fault::of(ProjectFault::Incomplete, "the face has no points to find its regions by")
                        .at(&self.face.folder)
                        .help(message![Task::FindFace, " finds them"])
                })?;
                track::by_regions(&source, face, Some(&made.calibration), &self.options, go_on)?
            }
        };
        Ok(Followed { tracked, checksum, notes })
    }
}

/// What is found in a video hangs on this.
fn checksum(source: &Source, kept: &Kept, method: Method, options: &Options) -> Result<String> {
    let text = format!("{} {} {method:?} {options:?}", source.fingerprint()?, kept.fingerprint());
    Ok(format!("{:08x}", crc32fast::hash(text.as_bytes())))
}

impl Lesson {
    /// Whether a clip's video is to be followed: it never was, or by another way, or the video or the calibration was
    /// another.
    ///
    /// # Errors
    /// When the video cannot be read.
    pub fn is_tracked_anew(&self, number: usize, method: Method, options: &Options) -> Result<bool> {
        let Some(clip) = self.clips.get(number) else { return Ok(false) };
        if clip.wants_tracking() {
            return Ok(true);
        }
        let (Some(before), Some(source)) = (&clip.score.tracked, clip.source()?) else {
            return Ok(false);
        };
        let folder = self.manifest.face_of(&clip.entry).map(|f| self.root.join("faces").join(&f.name));
        let Some(folder) = folder else { return Ok(false) };
        // What is not kept, or is of other shots, is calibrated anew: nobody knows what comes of that.
        match Kept::read(&folder)? {
            Some(kept) if kept.is_of(&folder) => Ok(!before.starts_with(&checksum(&source, &kept, method, options)?)),
            _ => Ok(true),
        }
    }
}

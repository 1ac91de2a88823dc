//! What a thread is asked to do.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::export::ExportRequest;
use crate::face::{Anchors, Face};
use crate::geometry::Point;
use crate::media::Sound;
use crate::media::Source;
use crate::pose::Emotion;
use crate::project::{AlignJob, TrackJob};

/// Work that takes long enough to be done elsewhere.
#[derive(Debug)]
pub enum Job {
    /// Open a lesson and check it.
    Open(PathBuf),
    /// Check a lesson's files, after they were written.
    Check(PathBuf),
    /// Make the outline of a clip's sound.
    Outline {
        /// The lesson's folder.
        root: PathBuf,
        /// Number of the clip.
        clip: usize,
        /// Its sound.
        sound: Arc<Sound>,
    },
    /// Find a clip's times in its sound.
    Align {
        /// The lesson's folder.
        root: PathBuf,
        /// What to align.
        job: Box<AlignJob>,
    },
    /// Follow the face in a clip's video.
    Follow {
        /// The lesson's folder.
        root: PathBuf,
        /// Number of the clip.
        clip: usize,
        /// What to follow.
        job: Box<TrackJob>,
        /// Set to stop it.
        stop: Arc<AtomicBool>,
    },
    /// Open a clip's video.
    Video {
        /// The lesson's folder.
        root: PathBuf,
        /// Number of the clip.
        clip: usize,
        /// Its file or folder.
        path: PathBuf,
        /// Frames a second of a folder of pictures.
        fps: f64,
    },
    /// Read a frame of a clip's video.
    Frame {
        /// The lesson's folder.
        root: PathBuf,
        /// Number of the clip.
        clip: usize,
        /// Its video.
        source: Box<Source>,
        /// Which frame, counted from 0.
        number: u32,
    },
    /// Make the spectrogram of a clip's sound.
    Spectrogram {
        /// The lesson's folder.
        root: PathBuf,
        /// Number of the clip.
        clip: usize,
        /// Its sound.
        sound: Arc<Sound>,
    },
    /// Track the pitch of a clip's sound.
    Pitch {
        /// The lesson's folder.
        root: PathBuf,
        /// Number of the clip.
        clip: usize,
        /// Its sound.
        sound: Arc<Sound>,
    },
    /// Mark where syllables are heard in a clip's sound.
    Nuclei {
        /// The lesson's folder.
        root: PathBuf,
        /// Number of the clip.
        clip: usize,
        /// Its sound.
        sound: Arc<Sound>,
    },
    /// Read the photo of a face, and work out the stages of the search.
    Photo {
        /// The lesson's folder.
        root: PathBuf,
        /// Number of the face.
        face: usize,
        /// Which of its shots.
        shot: Emotion,
        /// The photo's file.
        path: PathBuf,
        /// Its eyeballs, where they are known.
        eyes: Option<[Point; 2]>,
        /// Somebody else's annotation of it.
        dots: Option<PathBuf>,
        /// Whether the stages are wanted.
        stages: bool,
    },
    /// Calibrate a face from the files of its folder.
    Calibrate {
        /// The lesson's folder.
        root: PathBuf,
        /// Number of the face.
        face: usize,
        /// The face's folder.
        folder: PathBuf,
    },
    /// Find the points of a face.
    FindFace {
        /// The lesson's folder.
        root: PathBuf,
        /// Number of the face.
        face: usize,
        /// The photo's file.
        path: PathBuf,
        /// The face so far: what a hand has set in it stays.
        kept: Option<Box<Face>>,
        /// Four places given by hand.
        anchors: Option<Anchors>,
    },
    /// Export.
    Export {
        /// What.
        request: ExportRequest,
        /// Set to stop it.
        cancel: Arc<AtomicBool>,
    },
}

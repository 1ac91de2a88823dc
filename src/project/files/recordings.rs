//! The recording and the video of a clip, by their names in its folder.

use std::path::{Path, PathBuf};

use crate::disk::{Fault, FileFault, Result, inside, is_file_there, list};

/// The folder of a video that is pictures.
pub(in crate::project) const FRAMES: &str = "frames";

/// Frames a second of a folder of pictures whose manifest does not say it.
pub(in crate::project) const FRAMES_FPS: f64 = 25.0;

/// What videos are called at their end.
pub(in crate::project) const VIDEOS: [&str; 13] =
    ["mp4", "m4v", "mov", "mkv", "webm", "avi", "mpg", "mpeg", "ogv", "3gp", "wmv", "flv", "y4m"];

/// The video in a clip's folder: `frames/`, or `video.*`.
pub(in crate::project) fn video_file(root: &Path, folder: &Path) -> Result<Option<PathBuf>> {
    let clip = folder.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    let frames = inside(root, &format!("clips/{clip}/{FRAMES}"))?;
    if frames.is_dir() {
        return Ok(Some(frames));
    }
    let paths = list(folder).map_err(|e| Fault::io("cannot list the folder", folder, e))?;
    let is_video = |p: &PathBuf| {
        let extension = p.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
        p.file_stem().is_some_and(|s| s == "video") && VIDEOS.contains(&extension.as_str())
    };
    let found: Vec<PathBuf> = paths.into_iter().filter(is_video).collect();
    found.iter().try_for_each(|path| is_file_there(path).map(drop))?;
    match found.as_slice() {
        [] => Ok(None),
        [one] => {
            let name = one.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
            inside(root, &format!("clips/{clip}/{name}"))?;
            Ok(Some(one.clone()))
        }
        several => {
            let names: Vec<_> = several.iter().filter_map(|p| p.file_name()).map(|n| n.to_string_lossy()).collect();
            Err(Fault::of(FileFault::Duplicate, format!("there are several videos: {}", names.join(", ")))
                .at(folder)
                .help("keep one of them"))
        }
    }
}

/// What recordings are called at their end. What is in them their content says; Opus is named when it is found.
pub(in crate::project) const SOUNDS: [&str; 22] = [
    "wav", "wave", "bwf", "aif", "aiff", "aifc", "mp3", "ogg", "oga", "flac", "m4a", "m4b", "aac", "mp4", "m4v", "mov",
    "3gp", "mkv", "mka", "webm", "opus", "wma",
];

/// `speech.*` in a clip's folder.
pub(in crate::project) fn sound_file(root: &Path, folder: &Path) -> Result<Option<PathBuf>> {
    let paths = list(folder).map_err(|e| Fault::io("cannot list the folder", folder, e))?;
    let is_sound = |p: &PathBuf| {
        let extension = p.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
        p.file_stem().is_some_and(|s| s == "speech") && SOUNDS.contains(&extension.as_str())
    };
    let found: Vec<PathBuf> = paths.into_iter().filter(is_sound).collect();
    found.iter().try_for_each(|path| is_file_there(path).map(drop))?;
    let names: Vec<String> =
        found.iter().filter_map(|p| p.file_name().map(|n| n.to_string_lossy().into_owned())).collect();
    match (found.as_slice(), names.as_slice()) {
        ([], _) => Ok(None),
        ([one], [name]) => {
            let clip = folder.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
            inside(root, &format!("clips/{clip}/{name}"))?;
            Ok(Some(one.clone()))
        }
        _ => Err(Fault::of(FileFault::Duplicate, format!("there are several recordings: {}", names.join(", ")))
            .at(folder)
            .help("keep one of them")),
    }
}

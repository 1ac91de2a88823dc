//! A clip's video: where it is.

use std::path::{Path, PathBuf};

use crate::disk::{Fault, FileFault, Result, inside, is_file_there, list};

/// The folder of a video that is pictures.
pub(super) const FRAMES: &str = "frames";

/// Frames a second of a folder of pictures whose manifest does not say it.
pub(super) const FRAMES_FPS: f64 = 25.0;

/// What videos are called at their end.
pub(super) const VIDEOS: [&str; 13] =
    ["mp4", "m4v", "mov", "mkv", "webm", "avi", "mpg", "mpeg", "ogv", "3gp", "wmv", "flv", "y4m"];

/// The video in a clip's folder: `frames/`, or `video.*`.
pub(super) fn of(root: &Path, folder: &Path) -> Result<Option<PathBuf>> {
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

//! The video of a clip beside its drawing: opened in a thread, then read a frame at a time, the one at the cursor.

use std::path::PathBuf;
use std::sync::Arc;

use super::editor::Editor;
use crate::disk::Result;
use crate::media::Source;
use crate::photo::Photo;
use crate::studio::app::project::OpenProject;
use crate::studio::app::stack::{Context, Job, Reporter, Stack};

/// A frame is kept this many pixels wide at most: a terminal shows no more.
const KEPT_SIDE: usize = 360;

/// The fault where a video or a frame of it cannot be read.
const BROKEN: [&str; 2] = ["the photo cannot be looked at", "save it again as PNG and try that"];

/// Shows the video beside the drawing, or not.
pub(super) fn show(project: &OpenProject, editor: &mut Editor, cx: &mut Context<'_>) {
    if project.lesson.clips[editor.clip].video.is_none() {
        cx.shell.refuse("this clip has no video");
        return;
    }
    cx.shell.shows_video = !cx.shell.shows_video;
}

/// Starts to read the frame at the cursor, where it is shown and not there yet.
pub(super) fn missing(project: &OpenProject, editor: &mut Editor, cx: &mut Context<'_>) {
    if !cx.shell.shows_video {
        return;
    }
    let (number, cursor) = (editor.clip, editor.playing.unwrap_or(editor.cursor));
    let root = project.lesson.root.clone();
    let footage = &mut editor.footage;
    let Some(source) = &footage.source else {
        let clip = &project.lesson.clips[number];
        let Some(path) = clip.video.clone() else { return };
        // What takes long is not waited for, and not begun twice.
        if !std::mem::replace(&mut footage.opening, true) {
            cx.start(VideoJob { root, clip: number, path, fps: clip.video_fps() });
        }
        return;
    };
    let last = source.count().map_or(u32::MAX, |c| u32::try_from(c.saturating_sub(1)).unwrap_or(u32::MAX));
    let wanted = ((cursor * source.fps() + 1e-6).max(0.0) as u32).min(last);
    if footage.reading.is_some() || footage.frame.as_ref().is_some_and(|f| f.0 == wanted) {
        return;
    }
    footage.reading = Some(wanted);
    cx.start(FrameJob { root, clip: number, source: source.clone(), number: wanted });
}

/// Opens a clip's video.
struct VideoJob {
    root: PathBuf,
    clip: usize,
    path: PathBuf,
    /// Frames a second of a folder of pictures.
    fps: f64,
}

impl Job for VideoJob {
    type Made = Source;
    const BROKEN: [&'static str; 2] = BROKEN;

    fn run(&mut self, _: &Reporter) -> Result<Source> {
        Source::of(&self.path, self.fps)
    }

    fn done(self, made: Result<Source>, stack: &mut Stack) {
        let Some((project, editor)) = stack.editor(&self.root, self.clip) else { return };
        let (editor, cx) = (&mut *editor.borrow_mut(), &mut stack.context());
        editor.footage.opening = false;
        match made {
            Ok(source) => {
                editor.footage.source = Some(source);
                missing(&project.borrow(), editor, cx);
            }
            Err(fault) => {
                cx.shell.shows_video = false;
                editor.footage.frame = None;
                cx.shell.say_fault(&fault);
            }
        }
    }
}

/// Reads a frame of a clip's video.
struct FrameJob {
    root: PathBuf,
    clip: usize,
    source: Source,
    /// The frame, counted from 0.
    number: u32,
}

impl Job for FrameJob {
    type Made = Photo;
    const BROKEN: [&'static str; 2] = BROKEN;

    fn run(&mut self, _: &Reporter) -> Result<Photo> {
        self.source.frame(self.number)
    }

    fn done(self, made: Result<Photo>, stack: &mut Stack) {
        let Some((project, editor)) = stack.editor(&self.root, self.clip) else { return };
        let (editor, cx) = (&mut *editor.borrow_mut(), &mut stack.context());
        editor.footage.reading = None;
        match made {
            Ok(photo) => {
                let small = photo.at_most(KEPT_SIDE).0.into_owned();
                editor.footage.frame = Some((self.number, Arc::new(small)));
                missing(&project.borrow(), editor, cx);
            }
            Err(fault) => {
                cx.shell.shows_video = false;
                editor.footage.frame = None;
                cx.shell.say_fault(&fault);
            }
        }
    }
}

//! The face in a clip's video, for the studio: followed in a thread, its result one change of the lesson; and the
//! frame of the video at the cursor, beside the drawing.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::job::Job;
use super::state::State;
use crate::disk::Result;
use crate::media::Source;
use crate::photo::Photo;
use crate::project::{Followed, Method, TrackJob};
use crate::track::Options;

/// A search that is under way.
#[derive(Debug)]
pub struct Following {
    root: PathBuf,
    clip: usize,
    /// Frames done, of how many where that is known.
    pub done: (usize, Option<usize>),
    stop: Arc<AtomicBool>,
}

impl Following {
    /// How far it is, in a few letters.
    #[must_use]
    pub fn told(&self) -> String {
        match self.done {
            (_, Some(0)) | (0, _) => "following the face…".into(),
            (done, Some(of)) => format!("following the face {} %…", 100 * done / of),
            (done, None) => format!("following the face, frame {done}…"),
        }
    }
}

/// The video of the clip on the desk, a frame of it at a time.
#[derive(Debug, Default)]
pub struct Footage {
    /// The clip whose video it is.
    clip: Option<usize>,
    source: Option<Source>,
    /// Whether a thread is opening it.
    opening: bool,
    /// Whether it was asked if somebody else's ratios may be replaced.
    asked: bool,
    /// Whether its frames are shown.
    pub shown: bool,
    /// The frame that was read last, by its number.
    frame: Option<(u32, Arc<Photo>)>,
    /// The frame that a thread is reading.
    reading: Option<u32>,
}

/// A frame is kept this many pixels wide at most: a terminal shows no more.
const KEPT_SIDE: usize = 360;

/// Follows the face in the video of the clip on the desk, or the chosen one; stops where it does so already.
pub(super) fn ask(state: &mut State) -> Option<Job> {
    if let Some(now) = &state.following {
        now.stop.store(true, Ordering::Relaxed);
        state.say("stopping…");
        return None;
    }
    let clip = state.editor.as_ref().map(|e| e.clip).or_else(|| state.open.as_ref().map(|o| o.chosen))?;
    let theirs = state.lesson()?.clips.get(clip)?;
    let is_theirs = theirs.video.is_some() && theirs.record.is_some() && theirs.score.tracked.is_none();
    if is_theirs && !std::mem::replace(&mut state.footage.asked, true) {
        state.refuse("these ratios were not found here: T again puts those of the video in their place");
        return None;
    }
    state.footage.asked = false;
    start(state, clip, true)
}

/// Follows the face in the video of a clip that was opened and whose record nobody has made yet, once.
pub(super) fn of_itself(state: &mut State, clip: usize) -> Option<Job> {
    let open = state.open.as_mut()?;
    let lesson = open.lesson.as_ref().ok()?;
    let wanted = lesson.read_only.is_none() && lesson.clips.get(clip)?.wants_tracking();
    if !wanted || state.following.is_some() || !open.followed.insert(clip) {
        return None;
    }
    start(state, clip, false)
}

fn start(state: &mut State, clip: usize, asked: bool) -> Option<Job> {
    let lesson = state.lesson()?;
    if let Some(why) = &lesson.read_only {
        let why = format!("the lesson cannot be changed: {why}");
        if asked {
            state.refuse(why);
        }
        return None;
    }
    let root = lesson.root.clone();
    match TrackJob::of(lesson, clip, Method::Aam, Options::default()) {
        Ok(job) => {
            if let Some(open) = &mut state.open {
                open.followed.insert(clip);
            }
            let stop = Arc::new(AtomicBool::new(false));
            state.following = Some(Following { root: root.clone(), clip, done: (0, None), stop: Arc::clone(&stop) });
            Some(Job::Follow { root, clip, job: Box::new(job), stop })
        }
        Err(fault) => {
            if asked {
                state.say_fault(&fault);
            }
            None
        }
    }
}

/// Notes how far it is.
pub(super) fn goes_on(state: &mut State, done: (usize, Option<usize>)) {
    if let Some(now) = &mut state.following {
        now.done = done;
    }
}

/// Takes what was found.
pub(super) fn found(state: &mut State, root: &Path, clip: usize, found: Result<Followed>) {
    let Some(now) = state.following.take() else { return };
    if state.lesson().is_none_or(|l| l.root != root) || now.clip != clip || now.root != root {
        return;
    }
    let followed = match found {
        Ok(followed) => followed,
        Err(_) if now.stop.load(Ordering::Relaxed) => {
            state.say("stopped: the clip is as it was");
            return;
        }
        Err(fault) => {
            state.say_fault(&fault);
            return;
        }
    };
    let Some(lesson) = state.lesson() else { return };
    let change = lesson.tracked(clip, &followed.tracked, &followed.checksum);
    let is_new = change.is_some();
    if let Some(change) = change
        && !super::edits::change(state, change)
    {
        return;
    }
    let notes: Vec<String> = followed.all_notes().iter().map(super::wording::worded).collect();
    let worst = notes.first().cloned();
    if let Some(open) = &mut state.open {
        open.notes.entry(clip).or_default().extend(notes);
    }
    let frames = crate::project::counted(followed.tracked.record.rows.len(), "frame");
    let lost = state.lesson().and_then(|l| l.clips.get(clip)).map_or(0, |c| c.lost().len());
    let what = if is_new { format!("followed the face through {frames}") } else { "nothing new was found".into() };
    match (lost, worst) {
        (0, None) => state.say(what),
        (0, Some(note)) => state.say(format!("{what}; {note}")),
        (many, _) => {
            let places = crate::project::counted(many, "place");
            state.refuse(format!("{what}, {places} to look at: d goes there, o lists them"));
        }
    }
}

/// Shows the video beside the drawing, or not.
pub(super) fn show(state: &mut State) -> Option<Job> {
    let clip = state.clip()?;
    if clip.video.is_none() {
        state.refuse("this clip has no video");
        return None;
    }
    state.footage.shown = !state.footage.shown;
    missing(state)
}

/// Forgets the video of the clip that was on the desk; whether videos are shown stays.
pub(super) fn forget(state: &mut State) {
    state.footage = Footage { shown: state.footage.shown, ..Footage::default() };
}

/// The job that reads the frame at the cursor, where it is shown and not there yet.
pub(super) fn missing(state: &mut State) -> Option<Job> {
    let editor = state.editor.as_ref()?;
    let (number, cursor) = (editor.clip, editor.playing.unwrap_or(editor.cursor));
    if !state.footage.shown {
        return None;
    }
    if state.footage.clip != Some(number) {
        state.footage = Footage { clip: Some(number), shown: true, ..Footage::default() };
    }
    if state.footage.source.is_none() {
        let clip = state.clip()?;
        let (path, fps) = (clip.video.clone()?, clip.video_fps());
        let root = state.lesson()?.root.clone();
        // What takes long is not waited for, and not begun twice.
        let begun = std::mem::replace(&mut state.footage.opening, true);
        return (!begun).then_some(Job::Video { root, clip: number, path, fps });
    }
    let source = state.footage.source.as_ref()?;
    let last = source.count().map_or(u32::MAX, |c| u32::try_from(c.saturating_sub(1)).unwrap_or(u32::MAX));
    let wanted = ((cursor * source.fps() + 1e-6).max(0.0) as u32).min(last);
    if state.footage.reading.is_some() || state.footage.frame.as_ref().is_some_and(|f| f.0 == wanted) {
        return None;
    }
    state.footage.reading = Some(wanted);
    let root = state.lesson()?.root.clone();
    let source = Box::new(state.footage.source.clone()?);
    Some(Job::Frame { root, clip: number, source, number: wanted })
}

/// Takes a video that was opened; the job for its first frame.
pub(super) fn opened(state: &mut State, root: &Path, clip: usize, source: Result<Source>) -> Option<Job> {
    if state.lesson().is_none_or(|l| l.root != root) || state.footage.clip != Some(clip) {
        return None;
    }
    state.footage.opening = false;
    match source {
        Ok(source) => {
            state.footage.source = Some(source);
            missing(state)
        }
        Err(fault) => {
            state.footage.shown = false;
            state.say_fault(&fault);
            None
        }
    }
}

/// Takes a frame that was read; the job for the next one where the cursor has gone on.
pub(super) fn read(state: &mut State, root: &Path, clip: usize, number: u32, photo: Result<Photo>) -> Option<Job> {
    state.footage.reading = None;
    let here = state.lesson().is_some_and(|l| l.root == root) && state.footage.clip == Some(clip);
    if !here {
        return missing(state);
    }
    match photo {
        Ok(photo) => {
            let small = photo.at_most(KEPT_SIDE).0.into_owned();
            state.footage.frame = Some((number, Arc::new(small)));
            missing(state)
        }
        Err(fault) => {
            state.footage.shown = false;
            state.say_fault(&fault);
            None
        }
    }
}

impl Footage {
    /// The frame to show; none where none is shown.
    #[must_use]
    pub fn picture(&self, clip: usize) -> Option<&Photo> {
        self.frame.as_ref().filter(|_| self.shown && self.clip == Some(clip)).map(|f| &*f.1)
    }
}

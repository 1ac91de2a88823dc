//! The spectrogram and the pitch of a clip's sound, each made in a thread, once.

use std::path::PathBuf;
use std::sync::Arc;

use super::editor::Editor;
use crate::disk::Result;
use crate::media::Sound;
use crate::speech::{Spectrogram, pitch};
use crate::studio::app::heard::{Listened, SoundView, Tone};
use crate::studio::app::project::OpenProject;
use crate::studio::app::stack::{Context, Job, Reporter, Stack};

/// The fault where listening to a sound breaks off.
pub(super) const BROKEN: [&str; 2] = ["this sound cannot be listened to", "please report it"];

/// Starts the work on what is to be shown of a clip's sound and was not made yet.
pub(super) fn missing(project: &mut OpenProject, editor: &Editor, cx: &mut Context<'_>) {
    let clip = editor.clip;
    let Some(sound) = project.lesson.clips[clip].sound.clone() else { return };
    let root = project.lesson.root.clone();
    let heard = project.heard.entry(clip).or_default();
    let is_shown = cx.shell.view != SoundView::Wave;
    if is_shown && heard.spectrogram.is_none() && !std::mem::replace(&mut heard.under_way.0, true) {
        cx.start(SpectrogramJob { root: root.clone(), clip, sound: Arc::clone(&sound) });
    }
    if cx.shell.tone && heard.tone.is_none() && !std::mem::replace(&mut heard.under_way.1, true) {
        cx.start(PitchJob { root, clip, sound });
    }
}

/// Makes the spectrogram of a clip's sound.
struct SpectrogramJob {
    root: PathBuf,
    clip: usize,
    sound: Arc<Sound>,
}

impl Job for SpectrogramJob {
    type Made = Arc<Spectrogram>;
    const BROKEN: [&'static str; 2] = BROKEN;

    fn run(&mut self, _: &Reporter) -> Result<Self::Made> {
        Ok(Arc::new(Spectrogram::of(&self.sound)))
    }

    fn done(self, made: Result<Self::Made>, stack: &mut Stack) {
        take(&self.root, self.clip, made, stack, |heard, spectrogram| heard.spectrogram = Some(spectrogram));
    }
}

/// Tracks the pitch of a clip's sound.
struct PitchJob {
    root: PathBuf,
    clip: usize,
    sound: Arc<Sound>,
}

impl Job for PitchJob {
    type Made = Arc<Tone>;
    const BROKEN: [&'static str; 2] = BROKEN;

    fn run(&mut self, _: &Reporter) -> Result<Self::Made> {
        Ok(Arc::new(Tone::new(pitch(&self.sound))))
    }

    fn done(self, made: Result<Self::Made>, stack: &mut Stack) {
        take(&self.root, self.clip, made, stack, |heard, tone| heard.tone = Some(tone));
    }
}

/// Keeps what was made with the project, if it is still open.
fn take<T>(
    root: &std::path::Path,
    clip: usize,
    made: Result<T>,
    stack: &mut Stack,
    keep: impl FnOnce(&mut Listened, T),
) {
    let Some(project) = stack.project(root) else { return };
    match made {
        Ok(made) => keep(project.borrow_mut().heard.entry(clip).or_default(), made),
        Err(fault) => stack.shell.refuse(fault.what()),
    }
}

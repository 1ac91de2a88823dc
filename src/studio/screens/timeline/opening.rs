//! A clip put on the desk: its editor, the outline of its sound, and the searches that begin by themselves.

use std::cell::RefCell;
use std::path::PathBuf;
use std::rc::Rc;
use std::sync::Arc;

use super::editor::Editor;
use super::{TimelineScreen, aligning, following, listening};
use crate::disk::Result;
use crate::media::Sound;
use crate::studio::app::project::{OpenProject, SharedProject};
use crate::studio::app::stack::{Context, Job, Reporter, Stack};

/// Opens the timeline of a clip where the author left it.
pub(in crate::studio) fn open(shared: &SharedProject, project: &mut OpenProject, number: usize, cx: &mut Context<'_>) {
    let Some(clip) = project.lesson.clips.get(number) else { return };
    let figure = match project.lesson.figure_of(&clip.entry) {
        Ok(figure) => figure,
        Err(fault) => return cx.shell.say_fault(&fault),
    };
    project.replace_asked = false;
    let mut editor = Editor::new(&project.lesson, number, figure, project.counts());
    if let Some(left) = project.left.get(&number) {
        editor.go_back(clip, *left);
    }
    match clip.sound.clone() {
        Some(sound) => cx.start(OutlineJob { root: project.lesson.root.clone(), clip: number, sound }),
        None => editor.loudest = Some(0.0),
    }
    if let Some(why) = &project.lesson.read_only {
        cx.shell.say(format!("you can look but not change: {why}"));
    }
    listening::missing(project, &editor, cx);
    aligning::start_by_itself(project, number, cx);
    following::start_by_itself(project, number, cx);
    cx.push(TimelineScreen::new(Rc::clone(shared), Rc::new(RefCell::new(editor))));
}

/// Makes the outline of a clip's sound.
struct OutlineJob {
    root: PathBuf,
    clip: usize,
    sound: Arc<Sound>,
}

impl Job for OutlineJob {
    type Made = f32;
    const BROKEN: [&'static str; 2] = listening::BROKEN;

    fn run(&mut self, _: &Reporter) -> Result<f32> {
        // One column over everything builds the whole outline.
        let (low, high) = self.sound.peaks(0.0, self.sound.duration(), 1).first().copied().unwrap_or_default();
        Ok(high.max(-low))
    }

    fn done(self, made: Result<f32>, stack: &mut Stack) {
        // The author may have gone to another clip in the meantime.
        let Some((_, editor)) = stack.editor(&self.root, self.clip) else { return };
        match made {
            Ok(loudest) => editor.borrow_mut().loudest = Some(loudest),
            Err(fault) => stack.shell.say_fault(&fault),
        }
    }
}

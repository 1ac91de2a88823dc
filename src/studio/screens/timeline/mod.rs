//! The timeline of a clip: a cursor that moves and plays, lanes that are edited, searches that run beside.

pub(in crate::studio) mod aligning;
mod boundary;
pub(in crate::studio) mod desk;
mod doubts;
pub(in crate::studio) mod draw;
pub(in crate::studio) mod editor;
mod edits;
pub(in crate::studio) mod following;
mod footage;
mod free_places;
mod listening;
mod moving;
pub(in crate::studio) mod opening;
mod places;
mod typed;
mod video;
pub(in crate::studio) mod window;

use ratatui::layout::{Position, Rect};

use self::desk::ClipDesk;
use self::draw::Layout;
use super::project::checking;
use super::tapping::TappingScreen;
use super::{exporting, face};
use crate::studio::app::action::Action;
use crate::studio::app::keys::Place;
use crate::studio::app::project::SharedProject;
use crate::studio::app::shell::Shell;
use crate::studio::app::stack::{Context, Flow, Screen, SharedEditor, View};
use crate::studio::widgets::picture::FacePicture;
use crate::studio::widgets::prompt::{Prompt, Purpose, Spotted};

/// The timeline of a clip.
pub(crate) struct TimelineScreen {
    project: SharedProject,
    editor: SharedEditor,
    face: FacePicture,
}

impl TimelineScreen {
    /// A clip that was just opened.
    #[must_use]
    pub(crate) fn new(project: SharedProject, editor: SharedEditor) -> Self {
        Self { project, editor, face: FacePicture::default() }
    }

    /// Lets an action work on the clip.
    fn with<T>(&self, cx: &mut Context<'_>, work: impl FnOnce(&mut ClipDesk<'_, '_>) -> T) -> T {
        let (project, editor) = (&mut *self.project.borrow_mut(), &mut *self.editor.borrow_mut());
        work(&mut ClipDesk { project, editor, cx })
    }

    fn open_above(&self, action: Action, cx: &mut Context<'_>) {
        let (project, editor) = (&mut *self.project.borrow_mut(), &mut *self.editor.borrow_mut());
        match action {
            Action::Face => face::open(&self.project, project, editor.clip, cx),
            Action::Tap => {
                if let Some(screen) = TappingScreen::begin(&self.project, &self.editor, project, editor, cx.shell) {
                    cx.push(screen);
                }
            }
            _ => exporting::ask(&project.lesson.clips[editor.clip].entry.name, cx),
        }
    }
}

/// Carries out what concerns the clip itself; whether it does.
fn on_clip(desk: &mut ClipDesk<'_, '_>, action: Action) -> bool {
    let number = desk.editor.clip;
    match action {
        Action::Undo | Action::Redo => desk.project.retrace(action, desk.cx.shell),
        Action::Save => checking::save(desk.project, desk.cx),
        Action::Align => aligning::start(desk.project, number, true, desk.cx),
        Action::Follow => following::ask(desk.project, number, desk.cx),
        Action::Video => footage::show(desk.project, desk.editor, desk.cx),
        Action::Places => places::mark(desk),
        Action::Doubt(by) => doubts::step(desk, by),
        Action::Doubts => doubts::list(desk),
        Action::SoundView => desk.cx.shell.view = desk.cx.shell.view.next(),
        Action::Tone => desk.cx.shell.tone = !desk.cx.shell.tone,
        Action::Back if desk.editor.mark.take().is_some() => desk.say("the mark is gone"),
        Action::Back => {
            // The changes stay with the project; they are asked about when the project is left.
            desk.project.left.insert(number, desk.editor.left());
            desk.cx.close();
        }
        _ => return edits::execute(desk, action) || moving::execute(desk, action),
    }
    true
}

impl Screen for TimelineScreen {
    fn place(&self) -> Place {
        Place::Timeline
    }

    fn is_page(&self) -> bool {
        true
    }

    fn project(&self) -> Option<&SharedProject> {
        Some(&self.project)
    }

    fn editor(&self) -> Option<&SharedEditor> {
        Some(&self.editor)
    }

    /// Any key but those that only show something else takes the author's hand to the cursor: it stops.
    fn before(&mut self, action: Action) {
        let goes_on = matches!(
            action,
            Action::Play | Action::Zoom(_) | Action::Fit | Action::SoundView | Action::Tone | Action::Redraw
        );
        if !goes_on {
            self.editor.borrow_mut().playing = None;
        }
    }

    fn handle(&mut self, action: Action, cx: &mut Context<'_>) -> Flow {
        let taken = match action {
            Action::Face | Action::Tap | Action::Export => {
                self.open_above(action, cx);
                true
            }
            _ => self.with(cx, |desk| on_clip(desk, action)),
        };
        if taken { Flow::Taken } else { Flow::Passed }
    }

    fn refresh(&mut self, cx: &mut Context<'_>) {
        self.with(cx, |desk| {
            desk.editor.sync(&desk.project.lesson, desk.project.counts());
            listening::missing(desk.project, desk.editor, desk.cx);
            footage::missing(desk.project, desk.editor, desk.cx);
        });
    }

    fn advance(&mut self, seconds: f64, cx: &mut Context<'_>) -> bool {
        self.with(cx, |desk| moving::advance(desk, seconds))
    }

    fn beat(&self) -> Option<f64> {
        let editor = self.editor.borrow();
        let fps = editor.timeline.fps();
        editor.playing.map(|at| ((at * fps + 1e-6).floor() + 1.0) / fps - at)
    }

    fn accept(&mut self, prompt: &Prompt, cx: &mut Context<'_>) -> Result<(), String> {
        if prompt.purpose == Purpose::Export {
            let project = &mut *self.project.borrow_mut();
            let clip = project.lesson.clips[self.editor.borrow().clip].entry.name.clone();
            return exporting::start(project, Some(clip), prompt.line.text(), cx);
        }
        self.with(cx, |desk| edits::take(desk, prompt.purpose, prompt.line.text().trim()))
    }

    fn go_to(&mut self, spot: &Spotted, cx: &mut Context<'_>) {
        self.with(cx, |desk| doubts::go_to(desk, spot));
    }

    fn paint(&mut self, area: Rect, shell: &Shell) {
        let (project, editor) = (self.project.borrow(), self.editor.borrow());
        let layout = Layout::of(area, &editor, &project.lesson.clips[editor.clip], shell);
        self.face.show(&editor.figure, &editor.pose(), layout.face, shell.colours);
    }

    fn panel(&self, area: Rect, shell: &Shell) -> Option<Rect> {
        let (project, editor) = (self.project.borrow(), self.editor.borrow());
        Some(Layout::of(area, &editor, &project.lesson.clips[editor.clip], shell).panel)
    }

    fn draw(&self, view: &mut View<'_>) -> Option<Position> {
        draw::timeline(view, &self.project.borrow(), &self.editor.borrow(), &self.face, None);
        None
    }
}

//! Syllables tapped along with the sound of a clip.

mod change;
pub(in crate::studio) mod clock;
pub(in crate::studio) mod draw;

use std::rc::Rc;
use std::sync::Arc;

use ratatui::layout::{Position, Rect};

use self::change::{change_of, spoken};
use self::clock::{Passed, Phase, Tapping};
use super::timeline::desk::ClipDesk;
use super::timeline::draw::{self as timeline, Layout, Over};
use super::timeline::editor::Editor;
use crate::media::Sound;
use crate::project::counted;
use crate::studio::app::action::Action;
use crate::studio::app::keys::Place;
use crate::studio::app::project::{OpenProject, SharedProject};
use crate::studio::app::shell::{Hear, Shell};
use crate::studio::app::stack::{Context, Flow, Screen, SharedEditor, View};
use crate::studio::widgets::picture::FacePicture;

/// How much of the sound is heard before the cursor, so that nobody has to tap at once, in seconds.
const RUN_UP: f64 = 1.0;

/// Tapping along with the clip of the timeline below.
pub struct TappingScreen {
    project: SharedProject,
    editor: SharedEditor,
    /// The clock and what was tapped.
    pub tapping: Tapping,
    face: FacePicture,
}

/// Tapping, at work on its clip.
struct Desk<'a, 'b> {
    clip: ClipDesk<'a, 'b>,
    tapping: &'a mut Tapping,
}

impl TappingScreen {
    /// Begins to tap, from the cursor on; none where there is nothing to tap, which is said.
    pub(in crate::studio) fn begin(
        shared: &SharedProject,
        shared_editor: &SharedEditor,
        project: &OpenProject,
        editor: &mut Editor,
        shell: &mut Shell,
    ) -> Option<Self> {
        if !project.may_change(shell) {
            return None;
        }
        let clip = &project.lesson.clips[editor.clip];
        let Some(syllable) = editor.syllable else {
            shell.refuse("this clip has no syllables to tap: m marks where they are heard");
            return None;
        };
        let first = if clip.intervals().first().is_some_and(|i| editor.cursor <= i.start) { 0 } else { syllable };
        let from = (editor.cursor - RUN_UP).max(0.0);
        let tapping = Tapping::new(editor.cursor, from, first);
        editor.mark = None;
        show(project, editor, &tapping);
        Some(Self {
            project: Rc::clone(shared),
            editor: Rc::clone(shared_editor),
            tapping,
            face: FacePicture::default(),
        })
    }

    fn with<T>(&mut self, cx: &mut Context<'_>, work: impl FnOnce(&mut Desk<'_, '_>) -> T) -> T {
        let (project, editor) = (&mut *self.project.borrow_mut(), &mut *self.editor.borrow_mut());
        work(&mut Desk { clip: ClipDesk { project, editor, cx }, tapping: &mut self.tapping })
    }
}

impl Desk<'_, '_> {
    fn hear(&mut self, hear: fn(Option<Arc<Sound>>, f64, f64) -> Hear, from: f64) {
        let sound = self.clip.clip().sound.clone();
        self.clip.cx.shell.hear = Some(hear(sound, from, self.tapping.speed));
    }

    /// Stops the sound and the clock.
    fn pause(&mut self) {
        self.tapping.stop();
        self.clip.cx.shell.hear = Some(Hear::Nothing);
    }

    fn show(&mut self) {
        show(self.clip.project, self.clip.editor, self.tapping);
    }

    fn close(&mut self) {
        self.clip.cx.shell.hear = Some(Hear::Nothing);
        self.clip.cx.close();
    }

    /// Carries out what is asked for; whether the action means something here.
    fn execute(&mut self, action: Action) -> bool {
        let latency = self.clip.cx.shell.latency.unwrap_or(0.0);
        let count = self.clip.clip().syllables.len();
        match action {
            Action::TapStart => {
                let was_ready = self.tapping.is_ready();
                self.tapping.press(false, latency, count);
                if was_ready {
                    self.hear(soon, self.tapping.from);
                }
            }
            Action::TapEnd => self.tapping.press(true, latency, count),
            Action::TapBack => {
                if self.tapping.back() {
                    self.hear(now, self.tapping.at);
                }
            }
            Action::TapSpeed | Action::TapNext(_) if !self.tapping.is_ready() => {
                self.clip.say("that can be chosen before it begins: q keeps what was tapped, t goes on from there");
            }
            Action::TapSpeed => {
                self.tapping.speed = if self.tapping.speed < 1.0 { 1.0 } else { 0.5 };
                // Slowing down takes its time: it begins before the count does.
                self.hear(soon, self.tapping.from);
            }
            Action::TapNext(by) => {
                let last = count.saturating_sub(1) as i32;
                self.tapping.next = (self.tapping.next as i32 + by).clamp(0, last) as usize;
            }
            Action::TapMeasure if self.tapping.is_ready() => {
                self.tapping.measure();
                self.clip.cx.shell.hear = Some(Hear::Clicks(Tapping::flashes()));
            }
            Action::TapMeasure => self.clip.say("measure before it begins"),
            Action::TapKeep => {
                if self.keep() {
                    return true;
                }
            }
            Action::TapDrop => {
                let many = self.tapping.taps.iter().filter(|t| !t.is_end).count();
                self.tapping.at = self.tapping.home;
                self.close();
                self.clip.say(if many == 0 { "nothing was tapped".into() } else { format!("{many} taps dropped") });
            }
            _ => return false,
        }
        self.show();
        true
    }

    /// Keeps what was tapped, as one change, closes, and offers to find the rest; false where that cannot be, and the
    /// taps stay.
    fn keep(&mut self) -> bool {
        let (number, clip) = (self.clip.editor.clip, self.clip.clip());
        let spoken = spoken(self.tapping, clip);
        if spoken.is_empty() {
            self.close();
            self.clip.say("nothing was tapped");
            return true;
        }
        let (first, count) = (spoken[0].0, spoken.len());
        let change = match change_of(number, clip, &spoken) {
            Ok(change) => change,
            Err(why) => {
                self.clip.refuse(why);
                return false;
            }
        };
        if !self.clip.change(change) {
            return false;
        }
        self.close();
        let start = self.clip.clip().intervals().get(first).map_or(self.clip.editor.cursor, |i| i.start);
        self.clip.go(start);
        self.clip.editor.syllable = Some(first);
        let clip = self.clip.clip();
        let offer = match clip.syllables.len() - clip.score.pins.len() {
            0 => "all are set by hand now".into(),
            many => format!("A finds the other {many} between them"),
        };
        self.clip.say(format!("tapped {}; {offer}", counted(count, "syllable")));
        true
    }

    /// Lets seconds pass; whether there is something new to show.
    fn advance(&mut self, seconds: f64) -> bool {
        let (fps, duration) = (self.clip.editor.timeline.fps(), self.clip.editor.timeline.duration());
        let frame = |tapping: &Tapping| (tapping.at * fps + 1e-6).floor();
        let before = frame(self.tapping);
        let passed = self.tapping.advance(seconds, duration);
        let new = frame(self.tapping) != before;
        match passed {
            Passed::Begun => self.hear(now, self.tapping.at),
            Passed::Measured => self.take_measure(),
            Passed::Seen if !new && self.tapping.phase == Phase::Running => return false,
            Passed::Seen => {}
            Passed::Nothing => return false,
        }
        self.show();
        true
    }

    fn take_measure(&mut self) {
        let Some(late) = self.tapping.end_measuring() else {
            self.clip.say("too few taps to tell: c measures again");
            return;
        };
        self.clip.cx.shell.latency = Some(late);
        let side = if late < 0.0 { "before" } else { "after" };
        self.clip.say(format!("your taps come {:.0} ms {side} the flash: taken off from now on", late.abs() * 1e3));
    }
}

fn now(sound: Option<Arc<Sound>>, from: f64, speed: f64) -> Hear {
    Hear::Clip { sound, from, speed }
}

fn soon(sound: Option<Arc<Sound>>, from: f64, speed: f64) -> Hear {
    Hear::Soon { sound, from, speed }
}

/// Puts the cursor where the sound is, and selects the syllable that comes next.
fn show(project: &OpenProject, editor: &mut Editor, tapping: &Tapping) {
    let clip = &project.lesson.clips[editor.clip];
    let fps = editor.timeline.fps();
    editor.go(clip, (tapping.at * fps + 1e-6).floor() / fps);
    editor.syllable = Some(tapping.next.min(clip.syllables.len().saturating_sub(1)));
}

impl Screen for TappingScreen {
    fn place(&self) -> Place {
        Place::Tapping
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

    fn handle(&mut self, action: Action, cx: &mut Context<'_>) -> Flow {
        let taken = self.with(cx, |desk| {
            if action == Action::Help {
                // Nobody can tap below the list of keys.
                desk.pause();
            }
            desk.execute(action)
        });
        if taken { Flow::Taken } else { Flow::Passed }
    }

    fn keep(&mut self, cx: &mut Context<'_>) -> bool {
        self.with(cx, |desk| {
            desk.pause();
            desk.keep()
        })
    }

    fn advance(&mut self, seconds: f64, cx: &mut Context<'_>) -> bool {
        self.with(cx, |desk| desk.advance(seconds))
    }

    fn beat(&self) -> Option<f64> {
        self.tapping.beat(self.editor.borrow().timeline.fps())
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
        let (project, editor) = (self.project.borrow(), self.editor.borrow());
        let (shell, clip) = (view.shell, &project.lesson.clips[editor.clip]);
        let over = Over {
            panel: &|buffer, area| draw::panel(buffer, area, shell, &self.tapping, clip),
            marks: &|buffer, layout| draw::marks(buffer, layout, shell, &editor, &self.tapping),
        };
        timeline::timeline(view, &project, &editor, &self.face, Some(&over));
        None
    }
}

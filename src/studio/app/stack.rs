//! The stack of screens. The top one takes an action or passes it on to the one below; work that takes time runs in
//! threads, and its results come back to the stack.

use std::any::Any;
use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::rc::Rc;
use std::thread;

use crossbeam_channel::{Receiver, Sender, unbounded};
use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};

use super::action::Action;
use super::keys::Place;
use super::project::SharedProject;
use super::shell::Shell;
use crate::disk::{Fault, Result};
use crate::studio::screens::timeline::editor::Editor;
use crate::studio::widgets::prompt::{Prompt, Spotted};

/// A clip's cursor, window and selection, which the screens above its timeline share.
pub type SharedEditor = Rc<RefCell<Editor>>;

/// A screen: a page that fills the terminal, or a box on top of one. Its keys are the rows of the key table for its place.
pub trait Screen: Any {
    /// Its place in the key table.
    fn place(&self) -> Place;

    /// Carries out an action, or passes it on to the screen below.
    fn handle(&mut self, action: Action, cx: &mut Context<'_>) -> Flow;

    /// Draws it; the position of the caret where a line is typed in it.
    fn draw(&self, view: &mut View<'_>) -> Option<Position>;

    /// Whether it fills the terminal.
    fn is_page(&self) -> bool {
        false
    }

    /// Paints what takes long to paint and is kept, before [`draw`](Self::draw).
    fn paint(&mut self, _area: Rect, _shell: &Shell) {}

    /// The part of a page that a box may cover while something is changed on it.
    fn panel(&self, _area: Rect, _shell: &Shell) -> Option<Rect> {
        None
    }

    /// The open project it belongs to.
    fn project(&self) -> Option<&SharedProject> {
        None
    }

    /// The clip on it, open to be edited.
    fn editor(&self) -> Option<&SharedEditor> {
        None
    }

    /// Hears of every action before any screen takes it.
    fn before(&mut self, _action: Action) {}

    /// Hears that something may have changed.
    fn refresh(&mut self, _cx: &mut Context<'_>) {}

    /// Lets seconds pass while something moves on it; whether there is something new to show.
    fn advance(&mut self, _seconds: f64, _cx: &mut Context<'_>) -> bool {
        false
    }

    /// Seconds to the next frame; none while nothing moves.
    fn beat(&self) -> Option<f64> {
        None
    }

    /// Takes what was typed in a prompt on top of it.
    ///
    /// # Errors
    /// What is wrong with it; the prompt stays then.
    fn accept(&mut self, _prompt: &Prompt, _cx: &mut Context<'_>) -> Result<(), String> {
        Ok(())
    }

    /// Goes to a place that was chosen in a list on top of it.
    fn go_to(&mut self, _spot: &Spotted, _cx: &mut Context<'_>) {}

    /// Takes pasted text.
    fn paste(&mut self, _text: &str) {}

    /// Keeps what would be lost where the studio or the project is left; false where it cannot.
    fn keep(&mut self, _cx: &mut Context<'_>) -> bool {
        true
    }

    /// Why nothing may be left while it is there.
    fn holds(&self) -> Option<&'static str> {
        None
    }
}

/// What becomes of an action.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Flow {
    /// It was carried out, or means nothing.
    Taken,
    /// The screen below may take it.
    Passed,
}

/// Where a screen draws.
pub struct View<'a> {
    /// The cells of the terminal.
    pub buffer: &'a mut Buffer,
    /// The whole terminal.
    pub area: Rect,
    /// What all screens share.
    pub shell: &'a Shell,
    /// The part of the page below that a box may cover.
    pub panel: Option<Rect>,
}

/// What a screen may use and ask for while it handles something.
pub struct Context<'a> {
    /// What all screens share.
    pub shell: &'a mut Shell,
    /// The screen's place in the stack, counted from the bottom.
    at: usize,
    effects: &'a mut Vec<Effect>,
}

/// What is done once a screen has handled something.
pub(crate) enum Effect {
    /// Puts a screen on top.
    Push(Box<dyn Screen>),
    /// Closes the screen at this place in the stack.
    Close(usize),
    /// Closes the prompt on top and gives it to the page.
    Accept,
    /// Closes the list on top and goes to a place of the page.
    GoTo(Spotted),
    /// Leaves the studio (`Quit`) or the project (`Back`), after a question where something would be lost.
    Leave(Action),
    /// The same without a question.
    Go(Action),
    /// Starts work in a thread.
    Start(Box<dyn FnOnce(&mut Stack)>),
}

impl Context<'_> {
    /// Puts a screen on top.
    pub(crate) fn push(&mut self, screen: impl Screen) {
        self.effects.push(Effect::Push(Box::new(screen)));
    }

    /// Closes this screen.
    pub(crate) fn close(&mut self) {
        self.effects.push(Effect::Close(self.at));
    }

    /// Asks for something else.
    pub(crate) fn ask(&mut self, effect: Effect) {
        self.effects.push(effect);
    }

    /// Starts work in a thread.
    pub(crate) fn start<J: Job>(&mut self, job: J) {
        self.effects.push(Effect::Start(Box::new(move |stack| stack.start(job))));
    }
}

/// Work that takes long enough to be done in a thread.
pub(crate) trait Job: Send + Sized + 'static {
    /// What it makes.
    type Made: Send + 'static;

    /// The fault where the work panics: what, and what to do.
    const BROKEN: [&'static str; 2];

    /// Does the work, in a thread.
    ///
    /// # Errors
    /// What kept it from being done.
    fn run(&mut self, reporter: &Reporter) -> Result<Self::Made>;

    /// Takes what was made, in the studio. The screens that asked for it may be gone.
    fn done(self, made: Result<Self::Made>, stack: &mut Stack);
}

/// Something that a thread has to tell the studio.
pub struct Report(Box<dyn FnOnce(&mut Stack) + Send>);

impl Report {
    /// Takes it.
    pub(crate) fn take(self, stack: &mut Stack) {
        (self.0)(stack);
    }
}

/// Tells the studio how far a thread is.
pub(crate) struct Reporter(Sender<Report>);

impl Reporter {
    /// Tells the studio something, which it takes between two events. Nobody may wait for it any more.
    pub(crate) fn tell(&self, change: impl FnOnce(&mut Stack) + Send + 'static) {
        let _ = self.0.send(Report(Box::new(change)));
    }
}

/// The screens, what they share, and the work under way.
pub struct Stack {
    /// The screens, the top one last; there is always one.
    pub screens: Vec<Box<dyn Screen>>,
    /// What they share.
    pub shell: Shell,
    effects: Vec<Effect>,
    reports: (Sender<Report>, Receiver<Report>),
    /// Threads that have not reported their end.
    under_way: usize,
}

impl Stack {
    /// A stack of one page.
    #[must_use]
    pub(crate) fn new(page: impl Screen, shell: Shell) -> Self {
        Self { screens: vec![Box::new(page)], shell, effects: Vec::new(), reports: unbounded(), under_way: 0 }
    }

    /// The place of the topmost page.
    #[must_use]
    pub(crate) fn page(&self) -> usize {
        self.screens.iter().rposition(|s| s.is_page()).unwrap_or(0)
    }

    /// Lets the screen at a place in the stack handle something.
    pub(crate) fn handle_at<T>(
        &mut self,
        at: usize,
        handle: impl FnOnce(&mut dyn Screen, &mut Context<'_>) -> T,
    ) -> Option<T> {
        let screen = self.screens.get_mut(at)?;
        let mut cx = Context { shell: &mut self.shell, at, effects: &mut self.effects };
        Some(handle(screen.as_mut(), &mut cx))
    }

    /// The topmost screen of a kind.
    #[must_use]
    pub fn find<S: Screen>(&self) -> Option<&S> {
        self.screens.iter().rev().find_map(|screen| (screen.as_ref() as &dyn Any).downcast_ref())
    }

    /// Lets the topmost screen of a kind handle something; nothing where there is none.
    pub(crate) fn with<S: Screen, T>(&mut self, handle: impl FnOnce(&mut S, &mut Context<'_>) -> T) -> Option<T> {
        let at = self.screens.iter().rposition(|screen| (screen.as_ref() as &dyn Any).is::<S>())?;
        let screen = (self.screens[at].as_mut() as &mut dyn Any).downcast_mut()?;
        let mut cx = Context { shell: &mut self.shell, at, effects: &mut self.effects };
        Some(handle(screen, &mut cx))
    }

    /// Lets something be handled that belongs to no screen.
    pub(crate) fn context(&mut self) -> Context<'_> {
        Context { shell: &mut self.shell, at: usize::MAX, effects: &mut self.effects }
    }

    /// The open project in a folder.
    #[must_use]
    pub(crate) fn project(&self, root: &Path) -> Option<SharedProject> {
        let project = self.screens.iter().find_map(|screen| screen.project())?;
        (project.borrow().lesson.root == root).then(|| Rc::clone(project))
    }

    /// The editor of a clip of the project in a folder.
    #[must_use]
    pub(crate) fn editor(&self, root: &Path, clip: usize) -> Option<(SharedProject, SharedEditor)> {
        let project = self.project(root)?;
        let editor = self.screens.iter().find_map(|screen| screen.editor())?;
        (editor.borrow().clip == clip).then(|| (project, Rc::clone(editor)))
    }

    /// Starts work in a thread. Whatever becomes of it, it reports its end.
    pub(crate) fn start<J: Job>(&mut self, mut job: J) {
        self.under_way += 1;
        let reporter = Reporter(self.reports.0.clone());
        thread::spawn(move || {
            let [what, help] = J::BROKEN;
            let made = catch_unwind(AssertUnwindSafe(|| job.run(&reporter)));
            let made = made.unwrap_or_else(|_| Err(Fault::new(what).help(help)));
            reporter.tell(move |stack| {
                stack.under_way -= 1;
                job.done(made, stack);
            });
        });
    }

    /// What threads report.
    #[must_use]
    pub(crate) fn reports(&self) -> &Receiver<Report> {
        &self.reports.1
    }

    /// Whether threads are at work.
    #[must_use]
    pub(crate) fn is_working(&self) -> bool {
        self.under_way > 0
    }

    /// Takes what was asked for since it was last taken.
    pub(crate) fn take_effects(&mut self) -> Vec<Effect> {
        std::mem::take(&mut self.effects)
    }
}

//! The studio without a terminal: keys and reports go in, a frame comes out.

use std::path::Path;

use crossbeam_channel::Receiver;
use ratatui::Frame;

use super::action::Action;
use super::aligner::Aligner;
use super::colours::Colours;
use super::export::Exporter;
use super::keys;
use super::keys::Place;
use super::project::SharedProject;
use super::shell::{Hear, Shell};
use super::stack::{Effect, Flow, Report, SharedEditor, Stack, View};
use super::voice::Voice;
use crate::disk::Result;
use crate::studio::screens::confirm::ConfirmScreen;
use crate::studio::screens::help::HelpScreen;
use crate::studio::screens::projects::ProjectsScreen;
use crate::studio::screens::typing::TypingScreen;
use crate::studio::widgets::foot::{Foot, foot};
use crate::studio::widgets::text::{has_no_room, is_too_small};

/// The studio: its screens, and the player for sound.
pub struct Studio {
    /// The screens and what they share.
    pub stack: Stack,
    voice: Option<Voice>,
    /// Whether the last frame had no room for anything: nobody can see then what a key would do.
    too_small: bool,
}

impl Studio {
    /// A studio on the projects of a folder, or on the one it is; `exporter` makes the exports.
    ///
    /// # Errors
    /// When the folder cannot be listed.
    pub fn new(folder: impl AsRef<Path>, colours: Colours, exporter: Exporter) -> Result<Self> {
        let projects = ProjectsScreen::new(folder.as_ref().to_owned())?;
        Ok(Self { stack: Stack::new(projects, Shell::new(colours, exporter)), voice: None, too_small: false })
    }

    /// Finds times by another aligner.
    #[must_use]
    pub fn with_aligner(mut self, aligner: Aligner) -> Self {
        self.stack.shell.aligner = aligner;
        self
    }

    /// What all screens share.
    #[must_use]
    pub fn shell(&self) -> &Shell {
        &self.stack.shell
    }

    /// The project that is open.
    #[must_use]
    pub fn project(&self) -> Option<SharedProject> {
        self.stack.screens.iter().find_map(|screen| screen.project().cloned())
    }

    /// The editor of the clip that is open.
    #[must_use]
    pub fn editor(&self) -> Option<SharedEditor> {
        self.stack.screens.iter().find_map(|screen| screen.editor().cloned())
    }

    /// Whether there are changes that are not in the files.
    #[must_use]
    pub fn is_unsaved(&self) -> bool {
        self.project().is_some_and(|project| project.borrow().lesson.is_unsaved())
    }

    /// The place in the key table where a key is pressed.
    #[must_use]
    pub(crate) fn place(&self) -> Place {
        self.stack.screens.last().map_or(Place::Projects, |screen| screen.place())
    }

    /// Lets itself be heard, where there is a player for sound on this side of the connection.
    pub(super) fn find_voice(&mut self) {
        self.voice = Voice::found();
        self.stack.shell.can_hear = self.voice.is_some();
    }

    /// Takes a key by its name in the key table. Keys that mean nothing here are let pass.
    pub fn key(&mut self, name: &str) -> bool {
        if self.too_small {
            // No question could be seen. What is unsaved waits in the journal, as after a lost connection.
            self.stack.shell.leaving |= name == "Ctrl-c";
            return self.stack.shell.leaving;
        }
        let action = keys::action_of(self.place(), name);
        if let Some(action) = action {
            self.handle(action);
        }
        action.is_some()
    }

    /// Carries out an action: the topmost screen down to the topmost page may take it, then the studio itself.
    pub(crate) fn handle(&mut self, action: Action) {
        if action != Action::Redraw {
            self.stack.shell.message = None;
        }
        self.stack.screens.iter_mut().for_each(|screen| screen.before(action));
        let mut at = self.stack.screens.len();
        let page = self.stack.page();
        let mut flow = Flow::Passed;
        while flow == Flow::Passed && at > page {
            at -= 1;
            flow = self.stack.handle_at(at, |screen, cx| screen.handle(action, cx)).unwrap_or(Flow::Taken);
        }
        if flow == Flow::Passed {
            match action {
                Action::Help => {
                    let of = self.place();
                    self.stack.context().push(HelpScreen::new(of));
                }
                Action::Redraw => self.stack.shell.redraw = true,
                Action::Quit => self.leave(Action::Quit),
                _ => {}
            }
        }
        self.settle_effects();
    }

    /// Carries out what screens have asked for, and lets all of them see what has changed.
    fn settle_effects(&mut self) {
        loop {
            let effects = self.stack.take_effects();
            if effects.is_empty() {
                break;
            }
            effects.into_iter().for_each(|effect| self.carry_out(effect));
        }
        for at in 0..self.stack.screens.len() {
            self.stack.handle_at(at, |screen, cx| screen.refresh(cx));
        }
        let started = self.stack.take_effects();
        started.into_iter().for_each(|effect| self.carry_out(effect));
        self.speak();
    }

    fn carry_out(&mut self, effect: Effect) {
        match effect {
            Effect::Push(screen) => self.stack.screens.push(screen),
            // The first page stays.
            Effect::Close(at) if at > 0 && at < self.stack.screens.len() => {
                self.stack.screens.remove(at);
            }
            Effect::Close(_) => {}
            Effect::Accept => self.accept(),
            Effect::GoTo(spot) => {
                self.stack.screens.pop();
                let page = self.stack.page();
                self.stack.handle_at(page, |screen, cx| screen.go_to(&spot, cx));
            }
            Effect::Leave(by) => self.leave(by),
            Effect::Go(by) => self.go(by),
            Effect::Start(start) => start(&mut self.stack),
        }
    }

    /// Gives what was typed to the page below. Where it is wrong the line stays, with the reason.
    fn accept(&mut self) {
        let typed = self.stack.with(|screen: &mut TypingScreen, cx| {
            cx.close();
            screen.prompt.clone()
        });
        let Some(mut prompt) = typed else { return };
        // What it opens comes on top of the page, so the line goes first.
        let close = self.stack.take_effects();
        close.into_iter().for_each(|effect| self.carry_out(effect));
        let page = self.stack.page();
        if let Some(Err(fault)) = self.stack.handle_at(page, |screen, cx| screen.accept(&prompt, cx)) {
            prompt.fault = Some(fault);
            self.stack.context().push(TypingScreen { prompt });
        }
    }

    /// Leaves the project (`Back`) or the studio (`Quit`), after a question where something would be lost.
    fn leave(&mut self, by: Action) {
        if let Some(why) = self.stack.screens.iter().find_map(|screen| screen.holds()) {
            self.stack.shell.refuse(why);
            return;
        }
        self.stack.screens.retain(|screen| screen.is_page());
        for at in (0..self.stack.screens.len()).rev() {
            if self.stack.handle_at(at, |screen, cx| screen.keep(cx)) == Some(false) {
                return;
            }
        }
        let kept = self.stack.take_effects();
        kept.into_iter().for_each(|effect| self.carry_out(effect));
        match self.project().filter(|_| self.is_unsaved()) {
            Some(project) => self.stack.context().push(ConfirmScreen::new(project, by)),
            None => self.go(by),
        }
    }

    /// Leaves without a question.
    fn go(&mut self, by: Action) {
        self.stack.screens.retain(|screen| screen.is_page());
        match by {
            Action::Quit => self.stack.shell.leaving = true,
            _ => {
                self.stack.screens.truncate(1);
                self.stack.shell.shows_video = false;
            }
        }
    }

    /// Lets be heard what is to be heard.
    fn speak(&mut self) {
        let Some(hear) = self.stack.shell.hear.take() else { return };
        let Some(voice) = &self.voice else { return };
        match hear {
            Hear::Clip { sound: Some(sound), from, speed } => voice.play(sound, from, speed),
            Hear::Soon { sound: Some(sound), from, speed } => voice.prepare(sound, from, speed),
            Hear::Clicks(times) => voice.click(times),
            _ => voice.stop(),
        }
    }

    /// Takes pasted text: it goes into a line being typed and nowhere else.
    pub fn paste(&mut self, text: &str) {
        if let Some(screen) = self.stack.screens.last_mut() {
            screen.paste(text);
        }
    }

    /// Lets so many seconds of playing pass; whether another frame is due.
    pub fn advance(&mut self, seconds: f64) -> bool {
        let page = self.stack.page();
        let new = self.stack.handle_at(page, |screen, cx| screen.advance(seconds, cx)).unwrap_or(false);
        self.settle_effects();
        new
    }

    /// Seconds to the next frame while it plays; none while nothing moves.
    #[must_use]
    pub fn beat(&self) -> Option<f64> {
        self.stack.screens.get(self.stack.page())?.beat()
    }

    /// What threads report.
    #[must_use]
    pub fn reports(&self) -> &Receiver<Report> {
        self.stack.reports()
    }

    /// Takes a report.
    pub fn receive(&mut self, report: Report) {
        report.take(&mut self.stack);
        self.settle_effects();
    }

    /// Waits for everything that is under way, and takes it: for tests and tools, which have no loop.
    pub fn settle(&mut self) {
        while self.stack.is_working() {
            match self.stack.reports().recv() {
                Ok(report) => self.receive(report),
                Err(_) => return,
            }
        }
    }

    /// Draws the screens from the topmost page on. Pictures are painted anew only where what they show has changed.
    pub fn draw(&mut self, frame: &mut Frame<'_>) {
        let area = frame.area();
        self.too_small = has_no_room(area);
        if is_too_small(frame.buffer_mut(), area) {
            return;
        }
        let (page, lane) = (self.stack.page(), self.editor().map(|editor| editor.borrow().lane));
        let (place, opens) = (self.place(), self.project().is_some());
        let Stack { screens, shell, .. } = &mut self.stack;
        screens[page].paint(area, shell);
        let panel = screens[page].panel(area, shell);
        let mut view = View { buffer: frame.buffer_mut(), area, shell, panel };
        screens[page].draw(&mut view);
        let (message, busy) = (shell.message.as_ref(), shell.busy.as_deref());
        foot(view.buffer, area, Foot { place, lane, opens, message, busy }, shell.colours);
        // The line that is typed in the topmost box has the caret.
        let caret = screens[page + 1..].iter().fold(None, |_, screen| screen.draw(&mut view));
        if let Some(caret) = caret {
            frame.set_cursor_position(caret);
        }
    }
}

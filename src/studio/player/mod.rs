//! The player: a face over the whole terminal, and a line with words and time below it.
//!
//! One screen and its keys ([`Player`]) for two kinds of time ([`Playback`]): a clip's own, and that of frames that
//! arrive. The screen knows neither timelines nor records.

mod arrival;
mod clip;
mod live;

use ratatui::Frame;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use crate::figure::Figure;
use crate::pose::Pose;
use crate::studio::app::action::Action;
use crate::studio::app::colours::Colours;
use crate::studio::app::keys::{self, Place};
use crate::studio::app::run::Desk;
use crate::studio::widgets::boxed;
use crate::studio::widgets::foot::{Foot, foot};
use crate::studio::widgets::picture::FacePicture;
use crate::studio::widgets::text;

pub use clip::{Caption, Show, play};
pub use live::{Played, play_live};

/// A time that moves, with the pose and the words at it.
pub trait Playback {
    /// A report of its threads.
    type Report;

    /// Takes a report.
    fn receive(&mut self, _report: Self::Report) {}

    /// Lets seconds pass; whether another frame is shown then.
    fn advance(&mut self, seconds: f64) -> bool;

    /// Seconds to the next frame; none while it is stopped.
    fn beat(&self) -> Option<f64>;

    /// Carries out an action of the player's keys that moves or stops time; whether there is such an action here.
    fn act(&mut self, action: Action) -> bool;

    /// True when there is nothing left to show.
    fn is_over(&self) -> bool;

    /// The number of the frame that is shown; none before the first.
    fn frame(&self) -> Option<u32>;

    /// The pose of the frame that is shown.
    fn pose(&self) -> Pose;

    /// The time and its state, for the right end of the line.
    fn status(&self) -> String;

    /// Draws the words of now, or the title, at the left end of the line.
    fn caption(&self, buffer: &mut Buffer, row: Rect);
}

/// The player without a terminal.
pub struct Player<P> {
    playback: P,
    figure: Figure,
    help: bool,
    over: bool,
    redraw: bool,
    /// The last drawing had no room for anything.
    too_small: bool,
    colours: Colours,
    face: FacePicture,
}

impl<P: Playback> Player<P> {
    fn of(playback: P, figure: Figure, colours: Colours) -> Self {
        Self {
            playback,
            figure,
            help: false,
            over: false,
            redraw: false,
            too_small: false,
            colours,
            face: FacePicture::default(),
        }
    }

    /// The number of the frame that is shown; none before the first.
    #[must_use]
    pub fn frame(&self) -> Option<u32> {
        self.playback.frame()
    }

    /// Lets seconds pass; whether another frame is due.
    pub fn advance(&mut self, seconds: f64) -> bool {
        self.playback.advance(seconds)
    }

    /// Takes a key by its name in the table; whether it means something here.
    pub fn key(&mut self, name: &str) -> bool {
        if self.too_small && name != "Ctrl-c" {
            return false;
        }
        match keys::action_of(self.place(), name) {
            Some(Action::Help) => self.help = true,
            Some(Action::Close) => self.help = false,
            Some(Action::Redraw) => self.redraw = true,
            Some(Action::Quit) => self.over = true,
            Some(action) => return self.playback.act(action),
            None => return false,
        }
        true
    }

    fn place(&self) -> Place {
        if self.help { Place::Help } else { Place::Player }
    }

    /// Draws the face and the line below it.
    pub fn draw(&mut self, frame: &mut Frame<'_>) {
        let area = frame.area();
        let buffer = frame.buffer_mut();
        self.too_small = text::is_too_small(buffer, area);
        if self.too_small {
            return;
        }
        let face = Rect { height: area.height - 2, ..area };
        self.face.show(&self.figure, &self.playback.pose(), face, self.colours);
        self.face.put(buffer, face);
        let y = area.bottom() - 2;
        let status = self.playback.status();
        let right = text::cells(&status);
        text::put(buffer, area.right().saturating_sub(right + 1), y, right, &status, Style::new());
        self.playback.caption(buffer, Rect::new(area.x + 1, y, area.width.saturating_sub(right + 4), 1));
        if self.help {
            boxed::help(buffer, area, Place::Player, 0);
        }
        let at_foot = Foot { place: self.place(), lane: None, opens: false, message: None, busy: None };
        foot(buffer, area, at_foot, self.colours);
    }
}

impl<P: Playback> Desk for Player<P> {
    type Report = P::Report;

    fn key(&mut self, name: &str) -> bool {
        Self::key(self, name)
    }

    fn receive(&mut self, report: P::Report) {
        self.playback.receive(report);
    }

    fn advance(&mut self, seconds: f64) -> bool {
        Self::advance(self, seconds)
    }

    fn beat(&self) -> Option<f64> {
        self.playback.beat()
    }

    fn takes_redraw(&mut self) -> bool {
        std::mem::take(&mut self.redraw)
    }

    fn is_over(&self) -> bool {
        self.over || self.playback.is_over()
    }

    fn draw(&mut self, frame: &mut Frame<'_>) {
        Self::draw(self, frame);
    }
}

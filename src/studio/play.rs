//! Playback over the whole terminal: the face, and a line with what is said and when.

use crossbeam_channel::never;
use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};

use super::Action;
use super::draw;
use super::keys::{self, Place};
use super::look::Colours;
use super::picture::FacePicture;
use super::run::{Desk, turn};
use crate::disk::Result;
use crate::figure::Figure;
use crate::project::Lesson;
use crate::timeline::Timeline;

/// Something to play.
#[derive(Debug, Clone)]
pub struct Show {
    /// What it is called.
    pub title: String,
    /// What happens.
    pub timeline: Timeline,
    /// Who is seen.
    pub figure: Figure,
    /// What is said; may be empty.
    pub captions: Vec<Caption>,
}

/// A syllable in time.
#[derive(Debug, Clone, PartialEq)]
pub struct Caption {
    /// Seconds.
    pub start: f64,
    /// Seconds.
    pub end: f64,
    /// What is said.
    pub text: String,
}

impl Show {
    /// A clip of a lesson.
    ///
    /// # Errors
    /// When its figure does not exist or is damaged.
    pub fn of_clip(lesson: &Lesson, clip: usize) -> Result<Self> {
        let of = &lesson.clips[clip];
        let said = of.syllables.iter().zip(of.intervals());
        Ok(Self {
            title: format!("{} › {}", lesson.manifest.title, of.entry.name),
            timeline: lesson.timeline(clip, None),
            figure: lesson.figure_of(&of.entry)?,
            captions: said.map(|(s, i)| Caption { start: i.start, end: i.end, text: s.text.clone() }).collect(),
        })
    }
}

/// Plays in the terminal until it is left.
///
/// # Errors
/// When there is no terminal, or it fails.
pub fn play(show: Show) -> Result<()> {
    turn(&mut Player::new(show, Colours::of_environment()), &never())
}

/// The player without a terminal.
pub struct Player {
    show: Show,
    /// The exact time.
    at: f64,
    playing: bool,
    looping: bool,
    help: bool,
    over: bool,
    redraw: bool,
    /// Whether the last frame had no room for anything.
    too_small: bool,
    colours: Colours,
    face: FacePicture,
}

impl Player {
    /// A player at the start, playing.
    #[must_use]
    pub fn new(show: Show, colours: Colours) -> Self {
        Self {
            show,
            at: 0.0,
            playing: true,
            looping: false,
            help: false,
            over: false,
            redraw: false,
            too_small: false,
            colours,
            face: FacePicture::default(),
        }
    }

    /// The frame that is shown.
    #[must_use]
    pub fn frame(&self) -> u32 {
        let last = self.show.timeline.frames().saturating_sub(1);
        ((self.at * self.show.timeline.fps() + 1e-6).floor() as u32).min(last)
    }

    /// Lets so many seconds pass while it plays; whether another frame is due.
    pub fn advance(&mut self, seconds: f64) -> bool {
        if !self.playing {
            return false;
        }
        let before = self.frame();
        let duration = self.show.timeline.duration();
        self.at += seconds;
        if self.at >= duration {
            self.playing = self.looping && duration > 0.0;
            self.at = if self.playing { self.at % duration } else { self.end() };
            return true;
        }
        self.frame() != before
    }

    /// Takes a key by its name in the table; whether it means something here.
    pub fn key(&mut self, name: &str) -> bool {
        if self.too_small && name != "Ctrl-c" {
            return false;
        }
        let place = if self.help { Place::Help } else { Place::Player };
        let Some(action) = keys::action_of(place, name) else { return false };
        match action {
            Action::Play => {
                if !self.playing && self.at >= self.end() - 1e-6 {
                    self.at = 0.0;
                }
                self.playing = !self.playing;
            }
            Action::Frames(by) => {
                let frame = (i64::from(self.frame()) + i64::from(by)).clamp(0, i64::from(u32::MAX)) as u32;
                self.at = self.show.timeline.time_of(frame).min(self.end());
                self.playing = false;
            }
            Action::First => self.at = 0.0,
            Action::Last => self.at = self.end(),
            Action::Loop => self.looping = !self.looping,
            Action::Help => self.help = true,
            Action::Close => self.help = false,
            Action::Redraw => self.redraw = true,
            Action::Quit => self.over = true,
            _ => {}
        }
        true
    }

    /// The time of the last frame.
    fn end(&self) -> f64 {
        self.show.timeline.time_of(self.show.timeline.frames().saturating_sub(1))
    }

    /// Draws the face and the line below it.
    pub fn draw(&mut self, frame: &mut Frame<'_>) {
        let area = frame.area();
        let buffer = frame.buffer_mut();
        self.too_small = draw::is_too_small(buffer, area);
        if self.too_small {
            return;
        }
        let time = self.show.timeline.time_of(self.frame());
        let face = Rect { height: area.height - 2, ..area };
        self.face.show(&self.show.figure, &self.show.timeline.pose(time), face, self.colours);
        self.face.put(buffer, face);
        let y = area.bottom() - 2;
        let marks =
            format!("{}{}", if self.looping { "loop   " } else { "" }, if self.playing { "" } else { "stopped   " });
        let clock = format!("{marks}{time:.2} of {:.2} s", self.show.timeline.duration());
        let right = draw::cells(&clock);
        draw::put(buffer, area.right() - right - 1, y, right, &clock, Style::new());
        self.caption(buffer, Rect::new(area.x + 1, y, area.width.saturating_sub(right + 4), 1), time);
        if self.help {
            draw::help(buffer, area, Place::Player, 0);
        }
        let place = if self.help { Place::Help } else { Place::Player };
        let foot = draw::Foot { place, lane: None, opens: false, message: None, busy: None };
        draw::foot(buffer, area, foot, self.colours);
    }

    /// What is said around now, the syllable of now turned over; without words the title.
    fn caption(&self, buffer: &mut ratatui::buffer::Buffer, row: Rect, time: f64) {
        let captions = &self.show.captions;
        if captions.is_empty() {
            draw::put_short(buffer, row.x, row.y, row.width, &self.show.title, Style::new());
            return;
        }
        let next = captions.partition_point(|c| c.start <= time + 1e-9);
        let now = next.checked_sub(1).filter(|i| time < captions[*i].end);
        // As many before now as fill a third of the line.
        let (mut first, mut used) = (next.saturating_sub(1), 0);
        while let Some(before) = first.checked_sub(1) {
            used += draw::cells(&captions[before].text) + 1;
            if used > row.width / 3 {
                break;
            }
            first = before;
        }
        let mut x = row.x;
        for (index, caption) in captions.iter().enumerate().skip(first) {
            let style = if Some(index) == now { Style::new().add_modifier(Modifier::REVERSED) } else { Style::new() };
            let room = row.right().saturating_sub(x);
            if draw::cells(&caption.text) > room {
                break;
            }
            x += draw::put(buffer, x, row.y, room, &caption.text, style) + 1;
        }
    }
}

impl Desk for Player {
    /// It has no threads.
    type Report = ();

    fn key(&mut self, name: &str) -> bool {
        Player::key(self, name)
    }

    fn advance(&mut self, seconds: f64) -> bool {
        Player::advance(self, seconds)
    }

    fn beat(&self) -> Option<f64> {
        let fps = self.show.timeline.fps();
        self.playing.then(|| ((self.at * fps + 1e-6).floor() + 1.0) / fps - self.at)
    }

    fn takes_redraw(&mut self) -> bool {
        std::mem::take(&mut self.redraw)
    }

    fn is_over(&self) -> bool {
        self.over
    }

    fn draw(&mut self, frame: &mut Frame<'_>) {
        Player::draw(self, frame);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::timeline::{Score, Sources};

    fn player() -> Player {
        let score = Score::default();
        let sources = Sources {
            duration: 2.0,
            fps: 10.0,
            spoken: &[],
            record: None,
            tracks: None,
            score: &score,
            mouths: crate::pose::MouthPreset::default(),
        };
        let show = Show {
            title: "a record".into(),
            timeline: Timeline::build(&sources),
            figure: crate::figure::LineFigure::built_in("cat").unwrap().into(),
            captions: Vec::new(),
        };
        Player::new(show, Colours::None)
    }

    #[test]
    fn a_bare_timeline_plays_to_its_end_and_stays_there() {
        let mut player = player();
        assert!(!player.advance(0.05), "no new frame, no drawing");
        assert!(player.advance(0.06) && player.frame() == 1);
        assert!(player.advance(60.0) && player.frame() == 19);
        assert!(player.beat().is_none() && !player.advance(1.0));
    }

    #[test]
    fn seeking_stops_playing_and_stays_inside() {
        let mut player = player();
        player.key("Left");
        assert_eq!((player.frame(), player.beat().is_none()), (0, true));
        player.key("Up");
        assert_eq!(player.frame(), 19);
        player.key("Home");
        player.key("Right");
        assert_eq!(player.frame(), 1);
    }

    #[test]
    fn the_beat_falls_on_frames_however_late_one_was() {
        let mut player = player();
        player.advance(0.13);
        assert!(player.beat().is_some_and(|s| (s - 0.07).abs() < 1e-9));
    }
}

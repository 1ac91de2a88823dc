//! A clip played by its timeline: its time runs, jumps and comes round.

use crossbeam_channel::never;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};

use super::{Playback, Player};
use crate::disk::Result;
use crate::figure::Figure;
use crate::pose::Pose;
use crate::project::Lesson;
use crate::studio::app::action::Action;
use crate::studio::app::colours::Colours;
use crate::studio::app::run::turn;
use crate::studio::widgets::text;
use crate::timeline::Timeline;

/// Something to play.
#[derive(Debug, Clone)]
pub struct Show {
    /// Its title.
    pub title: String,
    /// The score.
    pub timeline: Timeline,
    /// The figure that is drawn.
    pub figure: Figure,
    /// Its syllables in time; may be empty.
    pub captions: Vec<Caption>,
}

/// A syllable in time.
#[derive(Debug, Clone, PartialEq)]
pub struct Caption {
    /// Seconds.
    pub start: f64,
    /// Seconds.
    pub end: f64,
    /// The syllable as it is written.
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

impl Player<ClipPlayback> {
    /// A player at the start, playing.
    #[must_use]
    pub fn new(show: Show, colours: Colours) -> Self {
        let Show { title, timeline, figure, captions } = show;
        Self::of(ClipPlayback { title, timeline, captions, at: 0.0, playing: true, looping: false }, figure, colours)
    }
}

/// A clip at a time of its own.
pub struct ClipPlayback {
    title: String,
    timeline: Timeline,
    captions: Vec<Caption>,
    /// The exact time, in seconds.
    at: f64,
    playing: bool,
    looping: bool,
}

impl ClipPlayback {
    /// The frame that is shown.
    fn number(&self) -> u32 {
        let last = self.timeline.frames().saturating_sub(1);
        ((self.at * self.timeline.fps() + 1e-6).floor() as u32).min(last)
    }

    /// The time of the frame that is shown.
    fn time(&self) -> f64 {
        self.timeline.time_of(self.number())
    }

    /// The time of the last frame.
    fn end(&self) -> f64 {
        self.timeline.time_of(self.timeline.frames().saturating_sub(1))
    }
}

impl Playback for ClipPlayback {
    /// It has no threads.
    type Report = ();

    fn advance(&mut self, seconds: f64) -> bool {
        if !self.playing {
            return false;
        }
        let before = self.number();
        let duration = self.timeline.duration();
        self.at += seconds;
        if self.at >= duration {
            self.playing = self.looping && duration > 0.0;
            self.at = if self.playing { self.at % duration } else { self.end() };
            return true;
        }
        self.number() != before
    }

    fn beat(&self) -> Option<f64> {
        let fps = self.timeline.fps();
        self.playing.then(|| ((self.at * fps + 1e-6).floor() + 1.0) / fps - self.at)
    }

    fn act(&mut self, action: Action) -> bool {
        match action {
            Action::Play => {
                if !self.playing && self.at >= self.end() - 1e-6 {
                    self.at = 0.0;
                }
                self.playing = !self.playing;
            }
            Action::Frames(by) => {
                let frame = (i64::from(self.number()) + i64::from(by)).clamp(0, i64::from(u32::MAX)) as u32;
                self.at = self.timeline.time_of(frame).min(self.end());
                self.playing = false;
            }
            Action::First => self.at = 0.0,
            Action::Last => self.at = self.end(),
            Action::Loop => self.looping = !self.looping,
            _ => return false,
        }
        true
    }

    /// At its end it waits to be played again.
    fn is_over(&self) -> bool {
        false
    }

    fn frame(&self) -> Option<u32> {
        Some(self.number())
    }

    fn pose(&self) -> Pose {
        self.timeline.pose(self.time())
    }

    fn status(&self) -> String {
        let looping = if self.looping { "loop   " } else { "" };
        let stopped = if self.playing { "" } else { "stopped   " };
        format!("{looping}{stopped}{:.2} of {:.2} s", self.time(), self.timeline.duration())
    }

    /// The syllables around now, that of now reversed; without captions the title.
    fn caption(&self, buffer: &mut Buffer, row: Rect) {
        let (captions, time) = (&self.captions, self.time());
        if captions.is_empty() {
            text::put_short(buffer, row.x, row.y, row.width, &self.title, Style::new());
            return;
        }
        let next = captions.partition_point(|c| c.start <= time + 1e-9);
        let now = next.checked_sub(1).filter(|i| time < captions[*i].end);
        // As many before now as fill a third of the line.
        let (mut first, mut used) = (next.saturating_sub(1), 0);
        while let Some(before) = first.checked_sub(1) {
            used += text::cells(&captions[before].text) + 1;
            if used > row.width / 3 {
                break;
            }
            first = before;
        }
        let mut x = row.x;
        for (index, caption) in captions.iter().enumerate().skip(first) {
            let style = if Some(index) == now { Style::new().add_modifier(Modifier::REVERSED) } else { Style::new() };
            let room = row.right().saturating_sub(x);
            if text::cells(&caption.text) > room {
                break;
            }
            x += text::put(buffer, x, row.y, room, &caption.text, style) + 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::studio::app::run::Desk;
    use crate::timeline::{Score, Sources};

    fn player() -> Player<ClipPlayback> {
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
        assert!(player.advance(0.06) && player.frame() == Some(1));
        assert!(player.advance(60.0) && player.frame() == Some(19));
        assert!(player.beat().is_none() && !player.advance(1.0));
    }

    #[test]
    fn seeking_stops_playing_and_stays_inside() {
        let mut player = player();
        player.key("Left");
        assert_eq!((player.frame(), player.beat().is_none()), (Some(0), true));
        player.key("Up");
        assert_eq!(player.frame(), Some(19));
        player.key("Home");
        player.key("Right");
        assert_eq!(player.frame(), Some(1));
    }

    #[test]
    fn the_beat_falls_on_frames_however_late_one_was() {
        let mut player = player();
        player.advance(0.13);
        assert!(player.beat().is_some_and(|s| (s - 0.07).abs() < 1e-9));
    }
}

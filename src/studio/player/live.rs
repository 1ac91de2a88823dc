//! A ratio record drawn as it arrives: whoever records may be far away, and still be recording.

use std::collections::VecDeque;
use std::io::Read;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::arrival::{Arrived, Room, read_ahead};
use super::{Playback, Player};
use crate::disk::{Fault, Result};
use crate::figure::Figure;
use crate::pose::{MouthPreset, Pose};
use crate::ratios::{Moment, Record, Tracks};
use crate::studio::app::action::Action;
use crate::studio::app::colours::Colours;
use crate::studio::app::run::turn;
use crate::studio::widgets::text;
use crate::timeline::{Score, Sources, Timeline};

/// Time goes on for so many seconds while nothing arrives: what a line stammers is caught up with, what pauses for longer
/// goes on where it paused.
const STAMMER: f64 = 0.5;
/// With so many seconds waiting, the record comes from a file and not from somebody who is recording.
const FROM_A_FILE: f64 = 2.0;
/// Blinks of a record without eyes come again after so many seconds.
const BLINKS: f64 = 600.0;

/// The outcome of playing a record.
#[derive(Debug)]
pub struct Played {
    /// Frames that were shown or were already late when they arrived.
    pub frames: u64,
    /// The fault of a record that is cut or damaged, where playing reached it.
    pub damage: Option<Fault>,
}

/// Draws a record while it arrives, until it ends or is left.
///
/// # Errors
/// When there is no terminal, or it fails. What is wrong with the record comes back with what was played.
pub fn play_live(title: &str, figure: Figure, input: impl Read + Send + 'static) -> Result<Played> {
    let (room, arrived) = read_ahead(input);
    let mut player = Player::of(LivePlayback::new(title, Some(room)), figure, Colours::of_environment());
    turn(&mut player, &arrived)?;
    Ok(player.playback.played())
}

/// A record at the time of the frames that have arrived.
pub(crate) struct LivePlayback {
    title: String,
    /// Frames that have arrived and are not due.
    waiting: VecDeque<Moment>,
    shown: Option<Moment>,
    /// The record's time; none before its first frame.
    clock: Option<f64>,
    /// The duration of a frame in seconds, by the last two.
    step: f64,
    frames: u64,
    /// The record's end, once it has arrived, with its fault.
    end: Option<Option<Fault>>,
    /// Stopped, and whether frames wait then instead of passing by.
    stopped: Option<bool>,
    /// The record has ended and was shown.
    over: bool,
    /// Blinks for records without eyes.
    blinks: Timeline,
    room: Option<Room>,
}

impl LivePlayback {
    /// Waits for its first frame. Where a reader fills it, `room` is the reader's.
    fn new(title: &str, room: Option<Room>) -> Self {
        Self {
            title: title.to_owned(),
            waiting: VecDeque::new(),
            shown: None,
            clock: None,
            step: 0.04,
            frames: 0,
            end: None,
            stopped: None,
            over: false,
            blinks: timeline(None, None, BLINKS),
            room,
        }
    }

    /// The outcome.
    fn played(self) -> Played {
        // Whoever leaves before the damage has seen nothing of it.
        let damage = if self.waiting.is_empty() { self.end.flatten() } else { None };
        Played { frames: self.frames, damage }
    }

    fn stop_or_go_on(&mut self) {
        match self.stopped {
            None => {
                let early = self.waiting.back().zip(self.clock).map_or(0.0, |(m, now)| m.row.time - now);
                self.stopped = Some(self.end.is_some() || early > FROM_A_FILE);
            }
            Some(waits) => {
                self.stopped = None;
                if let Some(newest) = self.waiting.back().filter(|_| !waits) {
                    self.clock = Some(newest.row.time);
                    self.show_due();
                }
            }
        }
    }

    /// The newest frame that is due is shown; those before it came too late.
    fn show_due(&mut self) {
        let now = self.clock.unwrap_or(0.0) + 1e-6;
        while self.waiting.front().is_some_and(|m| m.row.time <= now) {
            let next = self.take();
            if let Some((next, before)) = next.zip(self.shown) {
                self.step = next.row.time - before.row.time;
            }
            self.shown = next.or(self.shown);
        }
    }

    /// Nothing but the newest frame waits on.
    fn pass_by(&mut self) {
        while self.waiting.len() > 1 {
            self.take();
        }
    }

    fn take(&mut self) -> Option<Moment> {
        let next = self.waiting.pop_front()?;
        self.frames += 1;
        if let Some(room) = &self.room {
            room.give_back();
        }
        Some(next)
    }
}

impl Playback for LivePlayback {
    type Report = Arrived;

    fn receive(&mut self, arrived: Arrived) {
        match arrived {
            Arrived::Moment(moment) => {
                self.waiting.push_back(*moment);
                if self.clock.is_none() {
                    self.clock = Some(moment.row.time);
                }
                match self.stopped {
                    None => self.show_due(),
                    // Who records does not wait: only the newest is kept.
                    Some(false) => self.pass_by(),
                    Some(true) => {}
                }
            }
            Arrived::End(fault) => {
                self.end = Some(fault);
                self.over |= self.shown.is_none() && self.waiting.is_empty();
            }
        }
    }

    fn advance(&mut self, seconds: f64) -> bool {
        let Some(clock) = &mut self.clock else { return false };
        if self.stopped.is_some() {
            return false;
        }
        *clock += seconds.max(0.0);
        if let Some(newest) = self.waiting.back().or(self.shown.as_ref()) {
            *clock = clock.min(newest.row.time + STAMMER);
        }
        let before = self.frame();
        self.show_due();
        let last = self.shown.map_or(0.0, |m| m.row.time);
        if self.end.is_some()
            && self.waiting.is_empty()
            && self.clock.is_some_and(|now| now >= last + self.step.min(STAMMER))
        {
            self.over = true;
        }
        self.frame() != before
    }

    fn beat(&self) -> Option<f64> {
        let clock = self.clock.filter(|_| self.stopped.is_none())?;
        // While it waits for more, time goes on unseen.
        Some(match (self.waiting.front(), &self.end) {
            (Some(next), _) => next.row.time - clock,
            (None, Some(_)) => self.step,
            (None, None) => 1.0,
        })
    }

    /// Stops and goes on; frames that have not arrived or have passed cannot be shown.
    fn act(&mut self, action: Action) -> bool {
        let is_play = action == Action::Play;
        if is_play {
            self.stop_or_go_on();
        }
        is_play
    }

    fn is_over(&self) -> bool {
        self.over
    }

    fn frame(&self) -> Option<u32> {
        self.shown.map(|m| m.row.frame)
    }

    fn pose(&self) -> Pose {
        let Some(shown) = &self.shown else { return Pose::default() };
        let record = Record { rows: vec![shown.row] };
        let tracks = shown.track.map(|row| Tracks { rows: vec![row] });
        let mut pose = timeline(Some(&record), tracks.as_ref(), 0.0).pose(shown.row.time);
        if shown.track.is_none() {
            pose.lids = self.blinks.pose(shown.row.time % BLINKS).lids;
        }
        pose
    }

    /// The time, of how long once that is known, and a word where the face is lost.
    fn status(&self) -> String {
        let Some(shown) = &self.shown else { return "waiting for the first frame".to_owned() };
        let lost = if shown.row.confidence <= 0.0 { "face lost   " } else { "" };
        let stopped = if self.stopped.is_some() { "stopped   " } else { "" };
        let time = shown.row.time;
        match &self.end {
            Some(_) => {
                let last = self.waiting.back().unwrap_or(shown).row.time;
                format!("{lost}{stopped}{time:.2} of {:.2} s", last + self.step)
            }
            None => format!("{lost}{stopped}{time:.2} s, arriving"),
        }
    }

    fn caption(&self, buffer: &mut Buffer, row: Rect) {
        text::put_short(buffer, row.x, row.y, row.width, &self.title, Style::new());
    }
}

fn timeline(record: Option<&Record>, tracks: Option<&Tracks>, duration: f64) -> Timeline {
    let score = Score::default();
    Timeline::build(&Sources {
        duration,
        fps: 25.0,
        spoken: &[],
        record,
        tracks,
        score: &score,
        mouths: MouthPreset::default(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::LineFigure;
    use crate::pose::Ratios;
    use crate::ratios::Row;
    use crate::studio::app::run::Desk;

    fn player() -> Player<LivePlayback> {
        let figure = LineFigure::built_in("line").unwrap().into();
        Player::of(LivePlayback::new("ratios", None), figure, Colours::None)
    }

    fn frame(n: u32) -> Arrived {
        let row = Row { frame: n, time: f64::from(n) * 0.04, ratios: Ratios::NEUTRAL, confidence: 1.0 };
        Arrived::Moment(Box::new(Moment { row, track: None }))
    }

    #[test]
    fn what_comes_early_keeps_its_time_and_what_comes_late_is_shown_at_once() {
        let mut player = player();
        assert!(player.frame().is_none() && !player.advance(5.0));
        for n in 0..5 {
            player.receive(frame(n));
        }
        assert_eq!(player.frame(), Some(0));
        assert!(player.advance(0.041) && player.frame() == Some(1));
        assert!(!player.advance(0.01), "nothing new, nothing drawn");
        assert!(player.advance(0.2) && player.frame() == Some(4));
        // Nothing came for a quarter of a second, then all of it.
        player.advance(0.2);
        for n in 5..10 {
            player.receive(frame(n));
        }
        assert_eq!(player.frame(), Some(9), "the newest that is due");
        // After a pause of the recording it goes on where it was, half a second on at most.
        player.advance(60.0);
        for n in 10..60 {
            player.receive(frame(n));
        }
        assert_eq!(player.frame(), Some(21));
        player.receive(Arrived::End(None));
        assert!(player.advance(1.52) && player.frame() == Some(59) && !player.is_over());
        player.advance(0.05);
        assert!(player.is_over());
        let played = player.playback.played();
        assert!(played.frames == 60 && played.damage.is_none());
    }

    #[test]
    fn stopped_a_file_waits_and_a_recording_passes_by() {
        let mut player = player();
        for n in 0..100 {
            player.receive(frame(n));
        }
        player.key("Space");
        assert!(!player.advance(1.0) && player.frame() == Some(0));
        player.key("Space");
        assert!(player.advance(0.05) && player.frame() == Some(1));
        player.advance(10.0);
        assert_eq!(player.frame(), Some(99));
        player.key("Space");
        for n in 100..300 {
            player.receive(frame(n));
        }
        assert!(player.frame() == Some(99) && player.playback.waiting.len() == 1);
        player.key("Space");
        assert_eq!(player.frame(), Some(299));
        player.receive(Arrived::End(Some(Fault::new("the record is cut off"))));
        player.advance(1.0);
        assert!(player.is_over());
        let played = player.playback.played();
        assert!(played.frames == 300 && played.damage.is_some());
    }

    #[test]
    fn a_record_that_is_none_ends_at_once() {
        let mut player = player();
        player.receive(Arrived::End(Some(Fault::new("no record came"))));
        assert!(player.is_over());
    }
}

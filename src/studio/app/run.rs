//! The loop: keys, reports and ticks come in, the screen is drawn when something has changed.

use std::path::Path;
use std::thread;
use std::time::{Duration, Instant};

use crossbeam_channel::{Receiver, Sender, never, select, unbounded};
use crossterm::event::{self, KeyEventKind};
use ratatui::Frame;

use super::action::Action;
use super::colours::Colours;
use super::export::Exporter;
use super::keys;
use super::stack::Report;
use super::studio::Studio;
use super::terminal::{self, Screen};
use crate::disk::{Fault, Result};
use crate::project::MANIFEST;

/// Runs the studio on the lessons of a folder, until it is left.
///
/// # Errors
/// When there is no terminal, it fails, or the folder cannot be listed.
pub fn run(folder: &Path, exporter: Exporter) -> Result<()> {
    let mut studio = Studio::new(folder, Colours::of_environment(), exporter)?;
    studio.find_voice();
    // A folder that is a project opens at once.
    if folder.join(MANIFEST).is_file() {
        studio.handle(Action::Open);
    }
    let reports = studio.reports().clone();
    turn(&mut studio, &reports)
}

/// What the loop drives.
pub(in crate::studio) trait Desk {
    /// What its threads report.
    type Report;
    /// A key by its name in the table; whether something may have changed.
    fn key(&mut self, name: &str) -> bool;
    /// Pasted text.
    fn paste(&mut self, _text: &str) {}
    /// A report of a thread.
    fn receive(&mut self, _report: Self::Report) {}
    /// So many seconds have passed while it plays; whether there is something new to show.
    fn advance(&mut self, seconds: f64) -> bool;
    /// Seconds to the next frame while it plays.
    fn beat(&self) -> Option<f64>;
    /// Whether everything is to be drawn anew; asked once a frame.
    fn takes_redraw(&mut self) -> bool;
    /// Whether it is over.
    fn is_over(&self) -> bool;
    /// Draws.
    fn draw(&mut self, frame: &mut Frame<'_>);
}

impl Desk for Studio {
    type Report = Report;

    fn key(&mut self, name: &str) -> bool {
        Studio::key(self, name)
    }

    fn paste(&mut self, text: &str) {
        Studio::paste(self, text);
    }

    fn receive(&mut self, report: Report) {
        Studio::receive(self, report);
    }

    fn advance(&mut self, seconds: f64) -> bool {
        Studio::advance(self, seconds)
    }

    fn beat(&self) -> Option<f64> {
        Studio::beat(self)
    }

    fn takes_redraw(&mut self) -> bool {
        std::mem::take(&mut self.stack.shell.redraw)
    }

    fn is_over(&self) -> bool {
        self.stack.shell.leaving
    }

    fn draw(&mut self, frame: &mut Frame<'_>) {
        Studio::draw(self, frame);
    }
}

/// Something from outside.
enum Event {
    /// A key or the like, and when it came.
    Terminal(event::Event, Instant),
    /// The terminal is gone, or the program was asked to end.
    End,
}

/// Drives a desk on the terminal until it is over.
pub(in crate::studio) fn turn<R>(desk: &mut dyn Desk<Report = R>, reports: &Receiver<R>) -> Result<()> {
    if !Screen::is_there() {
        return Err(Fault::new("there is no terminal here").help("run it in a terminal, not in a pipe").of_the_call());
    }
    let mut screen = Screen::take()?;
    let (sender, events) = unbounded();
    watch_signals(sender.clone())?;
    // What is drawn first is there before the first key is waited for.
    screen.draw(|frame| desk.draw(frame))?;
    thread::spawn(move || read_keys(&sender));
    let mut clock = Clock(Instant::now());
    while !desk.is_over() {
        let tick = match desk.beat() {
            Some(seconds) => crossbeam_channel::after(Duration::from_secs_f64(seconds.clamp(0.001, 1.0))),
            None => never(),
        };
        let mut changed = false;
        select! {
            recv(events) -> event => match event {
                Ok(event) => match take(desk, &mut screen, &mut clock, event)? {
                    Some(new) => changed |= new,
                    None => return Ok(()),
                },
                Err(_) => return Ok(()),
            },
            recv(reports) -> report => if let Ok(report) = report {
                desk.receive(report);
                changed = true;
            },
            recv(tick) -> _ => {}
        }
        // Many queued events, one drawing.
        while let Ok(event) = events.try_recv() {
            match take(desk, &mut screen, &mut clock, event)? {
                Some(new) => changed |= new,
                None => return Ok(()),
            }
        }
        while let Ok(report) = reports.try_recv() {
            desk.receive(report);
            changed = true;
        }
        // Time passes by the clock, not by ticks: a frame that comes too late is left out.
        changed |= clock.pass(desk, Instant::now());
        if desk.takes_redraw() {
            screen.anew()?;
            changed = true;
        }
        if changed && !desk.is_over() {
            screen.draw(|frame| desk.draw(frame))?;
        }
    }
    Ok(())
}

/// Until when time has passed for a desk.
struct Clock(Instant);

impl Clock {
    /// Lets time pass until an instant, if it does; whether there is something new to show. While nothing moves, time
    /// goes by unseen.
    fn pass<R>(&mut self, desk: &mut dyn Desk<Report = R>, until: Instant) -> bool {
        let seconds = until.saturating_duration_since(self.0).as_secs_f64();
        self.0 = self.0.max(until);
        desk.beat().is_some() && desk.advance(seconds)
    }
}

/// Takes an event: whether something changed; nothing where it is the end.
fn take<R>(
    desk: &mut dyn Desk<Report = R>,
    screen: &mut Screen,
    clock: &mut Clock,
    event: Event,
) -> Result<Option<bool>> {
    Ok(match event {
        Event::End => None,
        Event::Terminal(event::Event::Key(key), at) if key.kind != KeyEventKind::Release => {
            // What moves has moved on until the very instant of the key, however long the last drawing took.
            let moved = clock.pass(desk, at);
            Some(keys::name_of(&key).is_some_and(|name| desk.key(&name)) || moved)
        }
        Event::Terminal(event::Event::Paste(text), _) => {
            desk.paste(&text);
            Some(true)
        }
        Event::Terminal(event::Event::Resize(..), _) => {
            screen.anew()?;
            Some(true)
        }
        Event::Terminal(..) => Some(false),
    })
}

fn read_keys(sender: &Sender<Event>) {
    loop {
        let event = match event::read() {
            Ok(event) => Event::Terminal(event, Instant::now()),
            Err(_) => Event::End,
        };
        let ends = matches!(event, Event::End);
        if sender.send(event).is_err() || ends {
            return;
        }
    }
}

/// Ends the loop when the terminal hangs up or the program is asked to end. Every change is in the journal already.
/// If the loop does not come round (it may hang in a write to a terminal that is gone), the program ends without it.
fn watch_signals(sender: Sender<Event>) -> Result<()> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    let mut signals = signal_hook::iterator::Signals::new([SIGHUP, SIGINT, SIGTERM])
        .map_err(|e| Fault::io("cannot watch for signals", "the terminal", e))?;
    thread::spawn(move || {
        if let Some(signal) = signals.forever().next() {
            let _ = sender.send(Event::End);
            thread::sleep(Duration::from_millis(700));
            terminal::give_back();
            std::process::exit(128 + signal);
        }
    });
    Ok(())
}

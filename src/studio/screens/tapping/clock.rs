//! Tapping: a clock that runs through a clip at full or half speed, and what was tapped along with it. It knows no
//! lesson and no terminal; time goes in, marks come out.

/// A key that comes again this soon, in seconds, is held down and repeats: nobody taps ten times a second.
const REPEAT: f64 = 0.1;

/// The longest that a terminal waits before a key that is held repeats, in seconds.
const REPEAT_DELAY: f64 = 1.05;

/// The beats of the count before it starts, and how long each lasts, in seconds.
const COUNT: f64 = 3.0;
/// See [`COUNT`].
const BEAT: f64 = 0.7;

/// How far back a mark that is taken back goes, in seconds of the sound.
const STEP_BACK: f64 = 1.0;

/// A start this soon after the last one, in seconds of the sound, belongs to it: whoever went a second back taps along
/// with what is marked already.
const AGAIN: f64 = 0.07;

/// The flashes of a measurement, how often they come, and how long one is seen, in seconds.
pub(crate) const FLASHES: usize = 8;
const EVERY: f64 = 0.75;
const LIT: f64 = 0.15;

/// Taps along with the clip.
#[derive(Debug, Clone, PartialEq)]
pub struct Tapping {
    /// What is going on.
    pub phase: Phase,
    /// How fast the sound goes: 1 or 0.5.
    pub speed: f64,
    /// What was tapped, by rising time.
    pub taps: Vec<Tap>,
    /// Where it began, in seconds of the sound.
    pub from: f64,
    /// Where it is, in seconds of the sound.
    pub at: f64,
    /// Where the cursor was before, to go back to where nothing is kept.
    pub home: f64,
    /// The syllable that comes next.
    pub next: usize,
    /// Seconds on the clock of the wall.
    wall: f64,
    presses: Presses,
}

/// What is going on.
#[derive(Debug, Clone, PartialEq)]
pub enum Phase {
    /// It waits to begin.
    Ready,
    /// The count before it starts: seconds that are left of it.
    Counting(f64),
    /// The sound runs.
    Running,
    /// The sound has ended or was stopped.
    Over,
    /// The flashes of a measurement: seconds since it began, and when taps came.
    Measuring {
        /// Seconds since it began.
        at: f64,
        /// When taps came.
        taps: Vec<f64>,
    },
}

/// A mark.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tap {
    /// When, in seconds of the sound.
    pub at: f64,
    /// Of which syllable.
    pub syllable: usize,
    /// Whether it ends there; else it starts.
    pub is_end: bool,
}

/// What came of time passing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Passed {
    /// Nothing that is to be seen.
    Nothing,
    /// Something is to be drawn.
    Seen,
    /// The sound begins now.
    Begun,
    /// The measurement is over.
    Measured,
}

/// The keys as they come, to tell those that were pressed from those that repeat.
#[derive(Debug, Clone, PartialEq, Default)]
struct Presses {
    last: Option<(f64, bool)>,
    /// How long before the last one that was no repeat the one before it came.
    gap: f64,
    repeating: bool,
    /// Whether the last one left a mark.
    marked: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Press {
    Own,
    Repeat,
    /// A repeat, and so was the one before.
    SecondRepeat,
}

impl Presses {
    fn press(&mut self, now: f64, is_end: bool) -> Press {
        let gap = self.last.filter(|(_, end)| *end == is_end).map(|(at, _)| now - at);
        self.last = Some((now, is_end));
        match gap {
            Some(gap) if gap < REPEAT => match std::mem::replace(&mut self.repeating, true) {
                false if self.marked && self.gap <= REPEAT_DELAY => Press::SecondRepeat,
                _ => Press::Repeat,
            },
            gap => {
                self.repeating = false;
                self.gap = gap.unwrap_or(f64::INFINITY);
                Press::Own
            }
        }
    }
}

impl Tapping {
    /// Ready to begin at a time, the syllable that comes first being `next`; the cursor is at `home`.
    #[must_use]
    pub(crate) fn new(home: f64, from: f64, next: usize) -> Self {
        Self {
            phase: Phase::Ready,
            speed: 1.0,
            taps: Vec::new(),
            from,
            at: from,
            home,
            next,
            wall: 0.0,
            presses: Presses::default(),
        }
    }

    /// Lets so many seconds on the wall pass, of a clip that lasts so long.
    pub(crate) fn advance(&mut self, seconds: f64, duration: f64) -> Passed {
        self.wall += seconds;
        match &mut self.phase {
            Phase::Ready | Phase::Over => Passed::Nothing,
            Phase::Counting(_) => {
                let before = self.count();
                if let Phase::Counting(left) = &mut self.phase {
                    *left -= seconds;
                    if *left <= 0.0 {
                        // The sound begins when this is seen, however late that is.
                        self.at = self.from;
                        self.phase = Phase::Running;
                        return Passed::Begun;
                    }
                }
                if self.count() == before { Passed::Nothing } else { Passed::Seen }
            }
            Phase::Running => {
                self.at += seconds * self.speed;
                if self.at >= duration {
                    self.at = duration;
                    self.phase = Phase::Over;
                }
                Passed::Seen
            }
            Phase::Measuring { at, .. } => {
                let before = lit(*at);
                *at += seconds;
                match *at >= EVERY * (FLASHES as f64 + 1.0) {
                    true => Passed::Measured,
                    false if lit(*at) == before => Passed::Nothing,
                    false => Passed::Seen,
                }
            }
        }
    }

    /// Seconds on the wall until something is to be seen; none while nothing moves. `fps` is the film's.
    #[must_use]
    pub(crate) fn beat(&self, fps: f64) -> Option<f64> {
        match &self.phase {
            Phase::Ready | Phase::Over => None,
            Phase::Counting(left) => Some(left - ((left / BEAT).ceil() - 1.0).max(0.0) * BEAT),
            Phase::Running => Some((((self.at * fps + 1e-6).floor() + 1.0) / fps - self.at) / self.speed),
            Phase::Measuring { at, .. } => {
                let into = at % EVERY;
                Some(if into < LIT && *at >= EVERY { LIT - into } else { EVERY - into })
            }
        }
    }

    /// What is counted: 3, 2, 1.
    #[must_use]
    pub(crate) fn count(&self) -> Option<u32> {
        match self.phase {
            Phase::Counting(left) => Some((left / BEAT).ceil().max(1.0) as u32),
            _ => None,
        }
    }

    /// The flash that is seen now, from 1.
    #[must_use]
    pub(crate) fn flash(&self) -> Option<usize> {
        match self.phase {
            Phase::Measuring { at, .. } => lit(at),
            _ => None,
        }
    }

    /// How many times was tapped along with the flashes.
    #[must_use]
    pub(crate) fn measured(&self) -> usize {
        match &self.phase {
            Phase::Measuring { taps, .. } => taps.len(),
            _ => 0,
        }
    }

    /// Takes a key: the start of the next syllable, or the end of the last. `latency` is how many seconds after the
    /// sound it comes; `last` the number of syllables.
    pub(crate) fn press(&mut self, is_end: bool, latency: f64, count: usize) {
        match &mut self.phase {
            Phase::Ready => {
                self.phase = Phase::Counting(COUNT * BEAT);
                self.presses.press(self.wall, is_end);
                return;
            }
            Phase::Counting(_) | Phase::Over => {
                self.presses.press(self.wall, is_end);
                return;
            }
            Phase::Running | Phase::Measuring { .. } => {}
        }
        let press = self.presses.press(self.wall, is_end);
        if press == Press::SecondRepeat {
            self.unmark();
        }
        if press != Press::Own {
            self.presses.marked = false;
            return;
        }
        self.presses.marked = match &mut self.phase {
            Phase::Measuring { at, taps } => {
                taps.push(*at);
                true
            }
            _ => self.mark(is_end, latency, count),
        };
    }

    fn mark(&mut self, is_end: bool, latency: f64, count: usize) -> bool {
        let at = (self.at - latency * self.speed).max(0.0);
        let last = self.taps.last().copied();
        if last.is_some_and(|l| at < l.at + AGAIN) {
            return false;
        }
        match (is_end, last) {
            (true, Some(last)) if !last.is_end => self.taps.push(Tap { at, syllable: last.syllable, is_end }),
            (true, _) => return false,
            (false, _) if self.next < count => {
                self.taps.push(Tap { at, syllable: self.next, is_end });
                self.next += 1;
            }
            (false, _) => return false,
        }
        true
    }

    fn unmark(&mut self) -> bool {
        if let Phase::Measuring { taps, .. } = &mut self.phase {
            return taps.pop().is_some();
        }
        let Some(tap) = self.taps.pop() else { return false };
        if !tap.is_end {
            self.next = tap.syllable;
        }
        true
    }

    /// Takes the last mark back and goes a second back in the sound; whether the sound is to be heard from there.
    pub(crate) fn back(&mut self) -> bool {
        if !matches!(self.phase, Phase::Running | Phase::Over) {
            return false;
        }
        self.unmark();
        self.presses = Presses::default();
        self.at = (self.at - STEP_BACK).max(self.from);
        self.phase = Phase::Running;
        true
    }

    /// Stops where it is: going back goes on.
    pub(crate) fn stop(&mut self) {
        self.phase = match self.phase {
            Phase::Running | Phase::Over => Phase::Over,
            _ => Phase::Ready,
        };
    }

    /// Begins to measure.
    pub(crate) fn measure(&mut self) {
        self.presses = Presses::default();
        self.phase = Phase::Measuring { at: 0.0, taps: Vec::new() };
    }

    /// Ends a measurement: how many seconds after the flashes the taps came, in the middle; none where there were too
    /// few to say.
    pub(crate) fn end_measuring(&mut self) -> Option<f64> {
        let Phase::Measuring { taps, .. } = std::mem::replace(&mut self.phase, Phase::Ready) else { return None };
        let mut late: Vec<f64> = taps.iter().filter_map(|t| late(*t)).collect();
        late.sort_by(f64::total_cmp);
        let middle = late.len() / 2;
        match late.len() {
            0..4 => None,
            even if even % 2 == 0 => Some(f64::midpoint(late[middle - 1], late[middle])),
            _ => Some(late[middle]),
        }
    }

    /// When the flashes come, in seconds after the measurement has begun.
    #[must_use]
    pub(crate) fn flashes() -> Vec<f64> {
        (1..=FLASHES).map(|k| k as f64 * EVERY).collect()
    }

    /// Whether nothing has begun: speed and place may still be chosen.
    #[must_use]
    pub(crate) fn is_ready(&self) -> bool {
        self.phase == Phase::Ready
    }
}

/// Which flash is seen at a time of the measurement.
fn lit(at: f64) -> Option<usize> {
    let number = ((at + 1e-9) / EVERY).floor();
    let seen = at - number * EVERY < LIT - 1e-9;
    (seen && number >= 1.0 && number <= FLASHES as f64).then_some(number as usize)
}

/// How late a tap comes after the flash nearest to it.
fn late(tap: f64) -> Option<f64> {
    let number = (tap / EVERY).round();
    (1.0..=FLASHES as f64).contains(&number).then_some(tap - number * EVERY)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Running from 0, on a clip of 60 s.
    fn running() -> Tapping {
        let mut tapping = Tapping::new(0.0, 0.0, 0);
        tapping.press(false, 0.0, 9);
        assert_eq!(tapping.count(), Some(3));
        assert_eq!(tapping.advance(1.0, 60.0), Passed::Seen);
        assert_eq!(tapping.count(), Some(2));
        assert_eq!(tapping.advance(1.1, 60.0), Passed::Begun);
        tapping
    }

    fn starts(tapping: &Tapping) -> Vec<f64> {
        tapping.taps.iter().filter(|t| !t.is_end).map(|t| (t.at * 1e4).round() / 1e4).collect()
    }

    #[test]
    fn taps_come_as_late_as_was_measured_and_that_is_taken_off_by_the_sounds_own_clock() {
        let mut tapping = running();
        tapping.advance(0.5, 60.0);
        tapping.press(false, 0.08, 9);
        tapping.speed = 0.5;
        tapping.advance(1.0, 60.0);
        tapping.press(false, 0.08, 9);
        assert_eq!(starts(&tapping), [0.42, 0.96]);
    }

    #[test]
    fn a_key_that_is_held_is_one_tap() {
        let mut tapping = running();
        tapping.advance(0.4, 60.0);
        tapping.press(false, 0.0, 9);
        tapping.advance(0.5, 60.0);
        for _ in 0..12 {
            tapping.press(false, 0.0, 9);
            tapping.advance(0.033, 60.0);
        }
        assert_eq!(starts(&tapping), [0.4]);
        tapping.advance(0.2, 60.0);
        tapping.press(false, 0.0, 9);
        assert_eq!((starts(&tapping).len(), tapping.next), (2, 2));
    }

    #[test]
    fn taps_as_fast_as_anybody_speaks_all_count() {
        let mut tapping = running();
        for _ in 0..7 {
            tapping.advance(0.13, 60.0);
            tapping.press(false, 0.0, 9);
        }
        assert_eq!(starts(&tapping).len(), 7);
        tapping.advance(0.05, 60.0);
        tapping.press(true, 0.0, 9);
        assert_eq!(starts(&tapping).len(), 7, "another key is no repeat");
    }

    #[test]
    fn taking_back_goes_a_second_back_and_taps_along_the_way_change_nothing() {
        let mut tapping = running();
        for _ in 0..4 {
            tapping.advance(0.5, 60.0);
            tapping.press(false, 0.0, 9);
        }
        assert!(tapping.back());
        assert!((tapping.at - 1.0).abs() < 1e-9);
        assert_eq!((tapping.next, starts(&tapping).len()), (3, 3));
        tapping.advance(0.5, 60.0);
        tapping.press(false, 0.0, 9);
        assert_eq!(starts(&tapping), [0.5, 1.0, 1.5], "it was marked before");
        tapping.advance(0.45, 60.0);
        tapping.press(false, 0.0, 9);
        assert_eq!(starts(&tapping), [0.5, 1.0, 1.5, 1.95]);
    }

    #[test]
    fn an_end_belongs_to_the_syllable_before_it_and_comes_once() {
        let mut tapping = running();
        tapping.advance(0.3, 60.0);
        tapping.press(true, 0.0, 9);
        assert!(tapping.taps.is_empty(), "nothing has started");
        tapping.press(false, 0.0, 9);
        tapping.advance(0.3, 60.0);
        tapping.press(true, 0.0, 9);
        tapping.advance(0.3, 60.0);
        tapping.press(true, 0.0, 9);
        assert_eq!(tapping.taps.len(), 2);
        assert!(tapping.taps[1].is_end && tapping.taps[1].syllable == 0);
    }

    #[test]
    fn eight_flashes_measure_how_late_taps_come_and_stray_ones_do_not_matter() {
        let mut tapping = Tapping::new(0.0, 0.0, 0);
        tapping.measure();
        assert_eq!(tapping.flash(), None);
        tapping.advance(EVERY, 60.0);
        assert_eq!(tapping.flash(), Some(1));
        for late in [0.06, 0.07, 0.05, 0.06, 0.3, 0.08, 0.06] {
            tapping.advance(late, 60.0);
            tapping.press(false, 0.0, 9);
            tapping.advance(EVERY - late, 60.0);
        }
        assert_eq!(tapping.advance(EVERY, 60.0), Passed::Measured);
        let measured = tapping.end_measuring().unwrap();
        assert!((measured - 0.06).abs() < 1e-6, "{measured}");
        tapping.measure();
        assert_eq!(tapping.end_measuring(), None);
        assert!(tapping.is_ready());
    }

    #[test]
    fn the_clock_strikes_when_something_is_to_be_seen_and_rests_when_nothing_moves() {
        let mut tapping = Tapping::new(0.0, 0.0, 0);
        assert_eq!(tapping.beat(25.0), None);
        tapping.press(false, 0.0, 9);
        assert!((tapping.beat(25.0).unwrap() - BEAT).abs() < 1e-9);
        tapping.advance(2.1, 60.0);
        tapping.speed = 0.5;
        tapping.at = 0.03;
        assert!((tapping.beat(25.0).unwrap() - 0.02).abs() < 1e-9);
        assert_eq!(tapping.advance(500.0, 60.0), Passed::Seen);
        assert_eq!((tapping.phase.clone(), tapping.beat(25.0)), (Phase::Over, None));
        assert!(tapping.back() && tapping.at == 59.0);
        tapping.measure();
        assert!((tapping.beat(25.0).unwrap() - EVERY).abs() < 1e-9);
        tapping.advance(EVERY, 60.0);
        assert!((tapping.beat(25.0).unwrap() - LIT).abs() < 1e-9);
    }
}

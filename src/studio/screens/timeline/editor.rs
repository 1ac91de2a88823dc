//! A clip on the desk: its built timeline, the cursor, what is selected and what is shown of it.

use super::free_places::free;
use super::video::Footage;
use super::window::Window;
use crate::figure::Figure;
use crate::pose::Pose;
use crate::project::{Clip, Lesson};
use crate::studio::app::lane::Lane;
use crate::timeline::{Key, KeyValue, MouthKey, Origin, Timeline, Track};

/// What is shown of a longer clip at first, in seconds: as much as 80 columns can show syllable by syllable.
const FIRST_SIGHT: f64 = 6.0;

/// A clip being looked at and edited. It holds nothing that is saved; that is the lesson's.
#[derive(Debug)]
pub struct Editor {
    /// Number of the clip in the lesson.
    pub clip: usize,
    /// The clip's score as it is now.
    pub timeline: Timeline,
    /// Who is drawn.
    pub figure: Figure,
    /// The instant that is looked at, in seconds.
    pub cursor: f64,
    /// What of the clip is on the screen.
    pub window: Window,
    /// The lane one stands on.
    pub lane: Lane,
    /// The syllable that is selected; none where there are none.
    pub syllable: Option<usize>,
    /// One end of a stretch, once it is marked.
    pub mark: Option<f64>,
    /// While it plays: the exact time, of which the cursor shows the frame.
    pub playing: Option<f64>,
    /// The lowest and highest ratio of the clip in whole tenths, at least 0 to 0.3: what the curves' height stands for.
    pub extent: (f64, f64),
    /// The loudest sample, once the outline of the sound is ready.
    pub loudest: Option<f32>,
    /// Places where syllables are heard and no words are yet: starts and ends in seconds.
    pub places: Vec<(f64, f64)>,
    /// The clip's video.
    pub footage: Footage,
    /// The state of the project that is shown: the counts of its changes and of those of faces.
    shown: (u64, u64),
}

/// Where the author was on a clip that she has left.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Left {
    cursor: f64,
    window: Window,
    lane: Lane,
    syllable: Option<usize>,
}

/// A key on a lane, whoever set it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum LaneKey {
    /// The author's.
    Own(Key),
    /// A mouth key of speech or of a pause.
    Spoken(MouthKey),
}

impl LaneKey {
    /// When it is, in seconds.
    #[must_use]
    pub(crate) const fn time(&self) -> f64 {
        match self {
            Self::Own(key) => key.time,
            Self::Spoken(key) => key.time,
        }
    }
}

impl Editor {
    /// Opens a clip at its start.
    #[must_use]
    pub(crate) fn new(lesson: &Lesson, clip: usize, figure: Figure, shown: (u64, u64)) -> Self {
        let timeline = lesson.timeline(clip, None);
        let mut editor = Self {
            clip,
            window: Window { from: 0.0, span: timeline.duration().min(FIRST_SIGHT) },
            timeline,
            figure,
            cursor: 0.0,
            lane: Lane::Syllables,
            syllable: None,
            mark: None,
            playing: None,
            extent: (0.0, 1.0),
            loudest: None,
            places: Vec::new(),
            footage: Footage::default(),
            shown,
        };
        editor.rebuild(lesson);
        editor
    }

    /// Where the author is, to come back to.
    #[must_use]
    pub(crate) fn left(&self) -> Left {
        Left { cursor: self.cursor, window: self.window, lane: self.lane, syllable: self.syllable }
    }

    /// Goes back to where the author was.
    pub(crate) fn go_back(&mut self, clip: &Clip, left: Left) {
        self.lane = left.lane;
        self.window = left.window;
        self.go(clip, left.cursor);
        self.syllable = left.syllable.filter(|s| *s < clip.syllables.len()).or(self.syllable);
    }

    /// Shows the project as it is now, after so many changes of it and of its faces; whether it has changed.
    pub(crate) fn sync(&mut self, lesson: &Lesson, now: (u64, u64)) -> bool {
        if self.shown == now {
            return false;
        }
        if self.shown.1 != now.1
            && let Ok(figure) = lesson.figure_of(&lesson.clips[self.clip].entry)
        {
            self.figure = figure;
        }
        self.shown = now;
        self.rebuild(lesson);
        true
    }

    /// Builds the timeline anew, after the lesson has changed.
    fn rebuild(&mut self, lesson: &Lesson) {
        self.timeline = lesson.timeline(self.clip, None);
        let (low, high) = (0..=self.timeline.frames()).fold((0.0_f64, 0.3_f64), |(low, high), frame| {
            let ratios = self.timeline.ratios(self.timeline.time_of(frame));
            ratios.0.iter().fold((low, high), |(low, high), r| (low.min(*r), high.max(*r)))
        });
        // Whole tenths, so that small edits do not move every curve on the screen.
        self.extent = ((low * 10.0 + 1e-6).floor() / 10.0, (high * 10.0 - 1e-6).ceil() / 10.0);
        self.select(&lesson.clips[self.clip]);
        if !self.places.is_empty() {
            // Where a syllable has come or has grown, there is no place for another.
            self.places = free(&lesson.clips[self.clip], &self.places);
        }
        if let Some(clip) = lesson.clips.get(self.clip)
            && self.syllable.is_some_and(|s| s >= clip.syllables.len())
        {
            self.syllable = None;
        }
    }

    /// What the figure shows at the cursor.
    #[must_use]
    pub(crate) fn pose(&self) -> Pose {
        self.timeline.pose(self.cursor)
    }

    /// The frame at the cursor.
    #[must_use]
    pub(crate) fn frame(&self) -> u32 {
        (self.cursor * self.timeline.fps() + 1e-6).floor() as u32
    }

    /// The last instant that one can stand on: the last frame's.
    #[must_use]
    pub(crate) fn last(&self) -> f64 {
        self.timeline.time_of(self.timeline.frames().saturating_sub(1))
    }

    /// Puts the cursor on an instant; the screen and the selection follow.
    pub(crate) fn go(&mut self, clip: &Clip, time: f64) {
        self.cursor = time.clamp(0.0, self.last().max(0.0));
        self.window = self.window.following(self.cursor, self.timeline.duration());
        self.syllable = None;
        self.select(clip);
    }

    /// Moves the cursor by so many frames, onto a frame.
    pub(crate) fn step(&mut self, clip: &Clip, frames: i32) {
        let at = self.cursor * self.timeline.fps();
        // Between two frames the next one on either side is one step away.
        let from = if frames > 0 { (at + 1e-6).floor() } else { (at - 1e-6).ceil() };
        self.go(clip, (from + f64::from(frames)).max(0.0) / self.timeline.fps());
    }

    /// Goes to the next or previous start of a syllable or of a marked place.
    pub(crate) fn step_syllable_or_place(&mut self, clip: &Clip, by: i32) {
        let syllables = clip.intervals().iter().enumerate().map(|(i, s)| (s.start, Some(i)));
        let mut starts: Vec<(f64, Option<usize>)> = syllables.chain(self.places.iter().map(|p| (p.0, None))).collect();
        starts.sort_by(|a, b| a.0.total_cmp(&b.0));
        let beyond = |s: &&(f64, Option<usize>)| (s.0 - self.cursor) * f64::from(by) > 1e-6;
        let found = if by > 0 { starts.iter().find(beyond) } else { starts.iter().rev().find(beyond) };
        if let Some((time, syllable)) = found.copied() {
            self.go(clip, time);
            self.syllable = syllable.or(self.syllable);
        }
    }

    /// The marked place at the cursor.
    #[must_use]
    pub(crate) fn place_here(&self) -> Option<(f64, f64)> {
        self.places.iter().copied().find(|(from, to)| *from - 1e-6 <= self.cursor && self.cursor < *to)
    }

    /// How many columns of so many a phone takes in the mean; none where the clip has no phones.
    #[must_use]
    pub(crate) fn columns_a_phone(&self, clip: &Clip, columns: u16) -> Option<f64> {
        let phones = &clip.timing.tier("phones")?.intervals;
        let seconds: f64 = phones.iter().map(crate::timing::Interval::duration).sum();
        (!phones.is_empty()).then(|| seconds / phones.len() as f64 / self.window.span * f64::from(columns))
    }

    /// Selects the syllable at the cursor, or the one nearest to it, unless one is selected.
    fn select(&mut self, clip: &Clip) {
        if self.syllable.is_some() {
            return;
        }
        let away = |i: &crate::timing::Interval| (i.start - self.cursor).max(self.cursor - i.end).max(0.0);
        let intervals = clip.intervals().iter().enumerate();
        // At a shared boundary the later one: what starts there belongs there.
        let nearest = intervals.rev().min_by(|a, b| away(a.1).total_cmp(&away(b.1)));
        self.syllable = nearest.map(|(index, _)| index);
    }

    /// The keys of a track in order, whoever set them.
    #[must_use]
    pub(crate) fn keys_on(&self, clip: &Clip, track: Track) -> Vec<LaneKey> {
        let own = clip.score.sorted_keys().filter(|k| k.value.track() == track).map(|k| LaneKey::Own(*k));
        let mut keys: Vec<LaneKey> = own.collect();
        if track == Track::Mouth {
            let spoken = self.timeline.mouth_keys().iter().filter(|k| k.origin != Origin::Author);
            keys.extend(spoken.map(|k| LaneKey::Spoken(*k)));
            keys.sort_by(|a, b| a.time().total_cmp(&b.time()));
        }
        keys
    }

    /// The key of the lane at the cursor: within half a frame, the nearest.
    #[must_use]
    pub(crate) fn key_here(&self, clip: &Clip) -> Option<LaneKey> {
        let Lane::Keys(track) = self.lane else { return None };
        let reach = 0.5 / self.timeline.fps() + 1e-6;
        let away = |k: &LaneKey| (k.time() - self.cursor).abs();
        let own = clip.score.keys.iter().filter(|k| k.value.track() == track).map(|k| LaneKey::Own(*k));
        let spoken = self.timeline.mouth_keys().iter();
        let spoken =
            spoken.filter(|k| track == Track::Mouth && k.origin != Origin::Author).map(|k| LaneKey::Spoken(*k));
        // Of two at one place the first is taken, which is the author's.
        own.chain(spoken).filter(|k| away(k) <= reach).min_by(|a, b| away(a).total_cmp(&away(b)))
    }

    /// Whether a syllable's times are a guess that nobody has looked at.
    #[must_use]
    pub(crate) fn is_guessed(clip: &Clip, syllable: usize) -> bool {
        clip.timing.guessed && clip.score.pins.binary_search(&syllable).is_err()
    }
}

/// What a key sets, in words.
#[must_use]
pub(crate) fn value_text(value: &KeyValue) -> String {
    match value {
        KeyValue::Emotion(ratios) => {
            let said: Vec<String> = crate::pose::Emotion::ALL[1..]
                .iter()
                .filter(|e| ratios[**e].abs() > 5e-4)
                .map(|e| format!("{e} {}", number(ratios[*e])))
                .collect();
            if said.is_empty() { "neutral".into() } else { said.join(", ") }
        }
        KeyValue::Mouth(shape) => shape.map_or("rest".into(), |s| s.to_string()),
        KeyValue::Blink(length) => format!("{} s", number(*length)),
        KeyValue::Gaze(g) => format!("{} {}", number(g.x), number(g.y)),
        KeyValue::Head(h) => format!("{} {} {}", number(h.x), number(h.y), number(h.roll)),
    }
}

/// A number with up to three decimals.
#[must_use]
pub(crate) fn number(value: f64) -> String {
    let rounded = (value * 1e3).round() / 1e3;
    format!("{}", if rounded == 0.0 { 0.0 } else { rounded })
}

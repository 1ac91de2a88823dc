//! Frames as they come: each is answered before the next is there.

use super::Options;
use super::by_aam::Watcher;
use super::gather::{Instant, Rest, Seen, at_rest};
use crate::aam::Model;
use crate::calibration::Calibration;
use crate::disk::Result;
use crate::photo::Grey;
use crate::pose::Ratios;
use crate::ratios::{Moment, Row, SMOOTH_WIDTH, Steady};

/// Follows a face in frames that come one after the other, and looks at none ahead.
///
/// The face rests where it was first seen; its gaze is counted from the mean of what was seen so far. A frame in which the
/// face is lost says what the last one said, with confidence 0; before it is first seen, that is a neutral face at rest.
#[derive(Debug)]
pub struct Live<'m> {
    watcher: Watcher<'m>,
    rest: Option<Rest>,
    /// Frames in which the irises were seen.
    looked: f64,
    last: Option<Seen>,
    steady: Steady,
}

/// Frames over which the mean of the gaze is taken: one that looks aside for longer is taken to look ahead.
const LOOKED_MOST: f64 = 250.0;

impl<'m> Live<'m> {
    /// Ready for the first frame.
    ///
    /// # Errors
    /// When model and calibration do not belong together.
    pub fn new(model: &'m Model, calibration: &'m Calibration, options: &Options) -> Result<Self> {
        Ok(Self {
            watcher: Watcher::new(model, calibration, options)?,
            rest: None,
            looked: 0.0,
            last: None,
            steady: Steady::new(SMOOTH_WIDTH),
        })
    }

    /// What the next frame shows.
    #[must_use]
    pub fn next(&mut self, grey: &Grey, frame: u32, time: f64) -> Moment {
        let seen = self.watcher.see(grey);
        if let Some(seen) = seen {
            let first = || Rest::of(&[Instant { frame, time, seen: Some(seen) }]);
            self.rest = self.rest.or_else(first);
            if let (Some(rest), Some(iris)) = (&mut self.rest, seen.iris) {
                self.looked = (self.looked + 1.0).min(LOOKED_MOST);
                rest.iris += (iris - rest.iris) / self.looked;
            }
            self.last = Some(seen);
        }
        let confidence = seen.map_or(0.0, |s| s.confidence);
        let Some((rest, shown)) = self.rest.zip(self.last) else {
            let row = Row { frame, time, ratios: Ratios::NEUTRAL, confidence };
            return Moment { row, track: Some(at_rest(frame, time)) };
        };
        let row = Row { frame, time, ratios: shown.ratios, confidence };
        let mut track = rest.track(frame, time, &shown);
        track.confidence = confidence;
        self.steady.push(&Moment { row, track: Some(track) })
    }
}

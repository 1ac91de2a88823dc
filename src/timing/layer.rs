//! Laying intervals that were read into a tier, one after the other: the one place that says which times can be.

use super::{Interval, MAX_SECONDS, Tier};
use crate::disk::{self, Fault, Result};

/// Times closer than this are the same: what rounding in the writing program can do, which may count in milliseconds.
/// Seconds.
const SAME: f64 = 1e-3;

/// A tier in the making.
pub(super) struct Layer {
    tier: Tier,
    /// How far it is laid, silence included, in seconds.
    until: f64,
}

impl Layer {
    /// An empty tier; its name becomes one line.
    pub(crate) fn new(name: &str) -> Self {
        Self { tier: Tier::new(disk::clean_line(name, 200)), until: 0.0 }
    }

    /// Lays the next interval. An empty label is silence.
    ///
    /// # Errors
    /// Without a line, which the caller knows: times that are not numbers, negative, absurd, backwards, or before the
    /// end of the interval before.
    pub(crate) fn lay(&mut self, start: f64, end: f64, label: &str) -> Result<()> {
        let (start, end) = (checked(start)?, checked(end)?);
        if start > end + SAME {
            return Err(Fault::new(format!("the interval starts at {start} and ends before that, at {end}"))
                .help("its start must not lie behind its end"));
        }
        if start < self.until - SAME {
            let before = self.tier.intervals.last().map_or(String::from("silence"), |i| format!("`{}`", i.label));
            return Err(Fault::new(format!(
                "the interval starts at {start}, where {before} holds until {}",
                self.until
            ))
            .help("intervals of one tier must follow each other without overlapping"));
        }
        let start = start.max(self.until);
        let end = end.max(start);
        self.until = end;
        // Cleaned here as well as in the file: JSON can spell a control character with plain letters.
        let label = disk::clean(label);
        if !label.trim().is_empty() {
            self.tier.intervals.push(Interval::new(start, end, label.trim()));
        }
        Ok(())
    }

    /// The tier, and how far it is laid.
    pub(crate) fn done(self) -> (Tier, f64) {
        (self.tier, self.until)
    }
}

/// A time that can be: finite, not negative, not absurd.
///
/// # Errors
/// Without a line.
pub(super) fn checked(time: f64) -> Result<f64> {
    // A nothing below 0 is a 0 that was calculated.
    let time = if (-SAME..0.0).contains(&time) { 0.0 } else { time };
    if (0.0..=MAX_SECONDS).contains(&time) {
        return Ok(time);
    }
    let what = if time < 0.0 { format!("the time {time} is negative") } else { format!("the time {time} cannot be") };
    Err(Fault::new(what).help(format!("times are seconds from 0 to {MAX_SECONDS} (100 hours)")))
}

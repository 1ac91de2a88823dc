//! The frames of a moving picture, one after another: where they come from, how fast they are shown, and who watches.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::disk::{Fault, FileFault, Result};
use crate::drawing::Picture;

/// Where the frames of a moving picture come from.
pub trait Frames {
    /// Pixels across and down, of every frame.
    fn size(&self) -> [u32; 2];

    /// How many there are.
    fn count(&self) -> u32;

    /// Makes the frame that is shown `n`-th, counted from 0, the picture. They are asked for in order, but for a few that a
    /// palette is learned from before. Returns the columns and rows outside which it is the same as the picture before.
    ///
    /// # Errors
    /// When it cannot be drawn.
    fn show(&mut self, n: u32) -> Result<(Range<u32>, Range<u32>)>;

    /// The picture that was asked for last.
    fn picture(&self) -> &Picture;
}

/// Who is told how far it is, and may stop it.
#[derive(Clone, Copy)]
pub struct Watch<'a> {
    /// Called with the number of frames that are done.
    pub progress: &'a dyn Fn(u32),
    /// Ends it early, between two frames; what was at the path before stays there.
    pub stop: &'a AtomicBool,
}

impl Watch<'_> {
    /// Whether it is to end.
    pub(crate) fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

/// How the writing of a moving picture ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// It is there, with this many bytes.
    Written(u64),
    /// It was stopped; nothing has changed on disk.
    Stopped,
}

/// Frames a second as a fraction: `over.0 / over.1`, each at most 65,535, the nearest there is. 29.97 is 30000/1001 and
/// 23.976 is 24000/1001, as television has them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Rate {
    /// Frames …
    pub frames: u32,
    /// … in this many seconds.
    pub seconds: u32,
}

impl Rate {
    /// Of frames a second.
    ///
    /// # Errors
    /// When it is not above 0 and at most 1000.
    pub(crate) fn new(fps: f64) -> Result<Self> {
        if !(fps > 0.0 && fps <= 1000.0) {
            return Err(Fault::of(FileFault::OutOfRange, format!("{fps} frames a second cannot be"))
                .help("give a number from 1 to 240"));
        }
        // The rates of television first, which people write with two or three decimals.
        let ntsc = (fps * 1.001).round();
        if (fps - ntsc / 1.001).abs() < 0.004 && (fps - fps.round()).abs() > 1e-9 && ntsc * 1000.0 <= 65_535.0 {
            return Ok(Self { frames: ntsc as u32 * 1000, seconds: 1001 });
        }
        // Continued fraction: the last convergent whose terms fit.
        let (mut before, mut last) = ((0_u64, 1_u64), (1_u64, 0_u64));
        let mut rest = fps;
        loop {
            let whole = rest.floor();
            let next = (whole as u64 * last.0 + before.0, whole as u64 * last.1 + before.1);
            if next.0.max(next.1) > 65_535 {
                break;
            }
            (before, last) = (last, next);
            if rest - whole < 1e-9 || (fps - last.0 as f64 / last.1 as f64).abs() < 1e-9 {
                break;
            }
            rest = (rest - whole).recip();
        }
        // So slow that its fraction does not fit: the slowest there is.
        let last = if last.0 == 0 || last.1 == 0 { (1, 65_535) } else { last };
        Ok(Self { frames: last.0 as u32, seconds: last.1 as u32 })
    }

    /// When frame `n` begins, in seconds.
    #[must_use]
    pub(crate) fn time_of(self, n: u32) -> f64 {
        f64::from(n) * f64::from(self.seconds) / f64::from(self.frames)
    }

    /// When frame `n` begins, in the nearest of the parts that a second has `parts` of.
    #[must_use]
    pub(crate) fn in_parts(self, n: u32, parts: u64) -> u64 {
        let (above, below) = (u64::from(n) * u64::from(self.seconds) * parts, u64::from(self.frames));
        (2 * above + below) / (2 * below)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_are_the_fractions_that_people_mean() {
        let of = |fps: f64| Rate::new(fps).map(|r| (r.frames, r.seconds)).unwrap();
        for (fps, frames, seconds) in [
            (25.0, 25, 1),
            (24.0, 24, 1),
            (12.5, 25, 2),
            (23.976, 24_000, 1001),
            (29.97, 30_000, 1001),
            (59.94, 60_000, 1001),
            (240.0, 240, 1),
            (1.0 / 3.0, 1, 3),
        ] {
            assert_eq!(of(fps), (frames, seconds), "{fps}");
        }
        for fps in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e9] {
            assert!(Rate::new(fps).is_err(), "{fps}");
        }
        for fps in [7.77, 14.985, 119.88, 33.333] {
            let (frames, seconds) = of(fps);
            assert!((fps - f64::from(frames) / f64::from(seconds)).abs() < 0.004, "{fps}: {frames}/{seconds}");
        }
    }

    #[test]
    fn hundredths_do_not_drift() {
        for fps in [24.0, 25.0, 30.0, 29.97] {
            let rate = Rate::new(fps).unwrap();
            for n in 0..10_000 {
                assert!((rate.in_parts(n, 100) as f64 / 100.0 - rate.time_of(n)).abs() <= 0.005 + 1e-9);
            }
        }
    }
}

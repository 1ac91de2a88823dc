//! Smoothing as frames come: it looks back only.

use std::collections::VecDeque;

use super::local::tricube;
use super::noise::{ENOUGH, deviation, third_difference};
use super::{likeness, parts, with_parts};
use crate::pose::Ratios;
use crate::ratios::Moment;

/// Third differences that say how large the noise is: three seconds at 25 frames a second.
const MEMORY: usize = 75;

/// Takes the noise out of frames as they come: each becomes the mean of those before it that are alike, the later the
/// more. Nothing is held back, so it costs no time; a movement slower than the noise is followed at most some
/// deviations of it behind.
///
/// ```
/// use lianpu::ratios::Steady;
/// let mut steady = Steady::new(0.4);
/// # let moments: Vec<lianpu::ratios::Moment> = Vec::new();
/// let smooth: Vec<_> = moments.iter().map(|moment| steady.push(moment)).collect();
/// ```
#[derive(Debug)]
pub struct Steady {
    ratios: Past<7>,
    gaze: Past<2>,
    lids: Past<2>,
    mouth: Past<4>,
    head: Past<3>,
}

impl Steady {
    /// Looks back so many seconds ([`SMOOTH_WIDTH`](super::SMOOTH_WIDTH) is a good one).
    #[must_use]
    pub fn new(width: f64) -> Self {
        Self {
            ratios: Past::new(width),
            gaze: Past::new(width),
            lids: Past::new(width),
            mouth: Past::new(width),
            head: Past::new(width),
        }
    }

    /// The frame without its noise. A lost one (confidence 0) comes back as it is, and is forgotten.
    pub fn push(&mut self, moment: &Moment) -> Moment {
        let mut moment = *moment;
        let row = &mut moment.row;
        if row.confidence > 0.0 {
            let (old, new) = (row.ratios.0, self.ratios.push(row.time, row.ratios.0));
            row.ratios = if old == new { row.ratios } else { Ratios(new).closed() };
        }
        if let Some(track) = &mut moment.track
            && track.confidence > 0.0
        {
            let (time, (gaze, lids, mouth, head)) = (track.time, parts(track));
            let new = (
                self.gaze.push(time, gaze),
                self.lids.push(time, lids),
                self.mouth.push(time, mouth),
                self.head.push(time, head),
            );
            *track = with_parts(track, new);
        }
        moment
    }
}

/// What was seen lately of values that move together.
#[derive(Debug)]
struct Past<const N: usize> {
    width: f64,
    rows: VecDeque<(f64, [f64; N])>,
    differences: VecDeque<[f64; N]>,
}

impl<const N: usize> Past<N> {
    fn new(width: f64) -> Self {
        Self { width, rows: VecDeque::new(), differences: VecDeque::new() }
    }

    fn push(&mut self, now: f64, here: [f64; N]) -> [f64; N] {
        self.rows.push_back((now, here));
        // Four are kept for the differences, and no more than a second of a hundred frames.
        while self.rows.len() > 4 && (self.rows[0].0 <= now - self.width || self.rows.len() > 100) {
            self.rows.pop_front();
        }
        if let [.., a, b, c, _] = *self.rows.make_contiguous() {
            self.differences.push_back(std::array::from_fn(|i| third_difference([a.1[i], b.1[i], c.1[i], here[i]])));
        }
        if self.differences.len() > MEMORY {
            self.differences.pop_front();
        }
        if self.differences.len() < ENOUGH {
            return here;
        }
        let noise: [f64; N] = std::array::from_fn(|c| deviation(self.differences.iter().map(|d| d[c])));
        let (mut sum, mut values) = (0.0, [0.0; N]);
        for (time, row) in &self.rows {
            let weight = tricube(((now - time) / self.width).min(1.0)) * likeness(&here, row, &noise);
            sum += weight;
            for (value, new) in values.iter_mut().zip(row) {
                *value += weight * new;
            }
        }
        if sum > 0.0 { values.map(|v| v / sum) } else { here }
    }
}

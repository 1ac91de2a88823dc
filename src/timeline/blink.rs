//! Blinks: the author's, and between them ones at human intervals, the same every time for the same seed.

use super::{KeyValue, Score};

/// How long a blink's closing, closed and opening parts take, as shares of the whole (closing is the fastest).
const PARTS: (f64, f64) = (0.3, 0.45);

/// Length of a blink in seconds; people's take 0.1 to 0.4 s.
pub(super) const BLINK_SECONDS: f64 = 0.24;

/// Median seconds between blinks of a person talking, and the spread of their logarithm: about 17 a minute, most
/// 2 to 6 s apart.
const MEDIAN_INTERVAL: f64 = 3.2;
const LOG_SPREAD: f64 = 0.42;
const SHORTEST_INTERVAL: f64 = 1.2;
const LONGEST_INTERVAL: f64 = 9.0;

/// One blink.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Blink {
    /// When the lids start to close, in seconds.
    pub start: f64,
    /// Seconds until they are open again.
    pub length: f64,
    /// Whether an author set it.
    pub by_author: bool,
}

impl Blink {
    /// How far the lids are closed at `t`: 0 open, 1 closed.
    #[must_use]
    pub(crate) fn closed_at(&self, t: f64) -> f64 {
        let u = (t - self.start) / self.length;
        let (down, up) = PARTS;
        let level = if u <= 0.0 || u >= 1.0 {
            0.0
        } else if u < down {
            u / down
        } else if u < up {
            1.0
        } else {
            (1.0 - u) / (1.0 - up)
        };
        level * level * (3.0 - 2.0 * level)
    }
}

/// All blinks of a clip in order. An author's key is the moment of full closure; made-up ones keep away from it.
pub(super) fn blinks(score: &Score, duration: f64, make_up: bool) -> Vec<Blink> {
    let own: Vec<Blink> = score
        .keys
        .iter()
        .filter_map(|key| match key.value {
            KeyValue::Blink(length) if length > 0.0 => {
                Some(Blink { start: key.time - PARTS.0 * length, length, by_author: true })
            }
            _ => None,
        })
        .collect();
    let mut all = own.clone();
    if make_up && score.auto_blink {
        let mut random = Random(score.seed);
        // Somewhere inside the first interval, so that lessons do not all start with the same stare.
        let mut start = 0.4 + random.interval() * random.unit();
        while start + BLINK_SECONDS < duration {
            let clear = |b: &Blink| (b.start - start).abs() > SHORTEST_INTERVAL;
            if own.iter().all(clear) {
                all.push(Blink { start, length: BLINK_SECONDS, by_author: false });
            }
            start += random.interval();
        }
    }
    all.sort_by(|a, b| a.start.total_cmp(&b.start));
    all
}

/// SplitMix64 (Steele, Lea and Flood 2014): a few lines that give the same numbers everywhere.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Evenly in 0 … 1.
    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A log-normal interval, its normal part by the sum of twelve even numbers, which is close enough within the limits,
    /// in whole milliseconds, which mathematics libraries that differ in the last digit agree on.
    fn interval(&mut self) -> f64 {
        let normal: f64 = (0..12).map(|_| self.unit()).sum::<f64>() - 6.0;
        let seconds = MEDIAN_INTERVAL * (LOG_SPREAD * normal).exp();
        (seconds.clamp(SHORTEST_INTERVAL, LONGEST_INTERVAL) * 1000.0).round() / 1000.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn people_blink_ten_to_thirty_times_a_minute_and_so_do_we_the_same_every_time() {
        let score = Score { seed: 7, ..Score::default() };
        let all = blinks(&score, 600.0, true);
        assert_eq!(all, blinks(&score, 600.0, true));
        let per_minute = all.len() as f64 / 10.0;
        assert!((10.0..30.0).contains(&per_minute), "{per_minute}");
        for pair in all.windows(2) {
            assert!(pair[1].start - pair[0].start >= SHORTEST_INTERVAL - 1e-9);
        }
        assert_ne!(all, blinks(&Score { seed: 8, ..Score::default() }, 600.0, true));
    }

    #[test]
    fn a_blink_never_opens_the_eye_wider_than_neutral_and_closes_it_once() {
        let blink = Blink { start: 1.0, length: BLINK_SECONDS, by_author: false };
        let levels: Vec<f64> = (0..1000).map(|i| blink.closed_at(0.9 + f64::from(i) * 0.0005)).collect();
        assert!(levels.iter().all(|l| (0.0..=1.0).contains(l)));
        assert!(levels.contains(&1.0));
        let falls = levels.windows(2).filter(|w| w[0] == 1.0 && w[1] < 1.0).count();
        assert_eq!(falls, 1);
    }
}

//! Which frames of a clip: ranges, counted inclusively, and shards of them.

use std::fmt;
use std::str::FromStr;

/// Ranges of frame numbers, first and last included; empty means all.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct FrameSet(Vec<(u32, u32)>);

impl FrameSet {
    /// Whether every frame is meant.
    #[must_use]
    pub(crate) fn is_all(&self) -> bool {
        self.0.is_empty()
    }

    /// The frames of a clip of `count` that are meant, in order.
    #[must_use]
    pub(crate) fn of(&self, count: u32) -> Vec<u32> {
        if self.is_all() {
            return (0..count).collect();
        }
        let mut frames: Vec<u32> =
            self.0.iter().flat_map(|(a, b)| *a..=(*b).min(count.saturating_sub(1))).filter(|f| *f < count).collect();
        frames.sort_unstable();
        frames.dedup();
        frames
    }

    /// The highest frame named.
    #[must_use]
    pub(crate) fn last(&self) -> Option<u32> {
        self.0.iter().map(|r| r.1).max()
    }
}

impl FromStr for FrameSet {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let number = |s: &str| {
            s.trim().parse::<u32>().map_err(|_| format!("`{s}` is no frame number: write 10-20 or 10-20,40-50"))
        };
        let range = |part: &str| {
            let (a, b) = part.split_once('-').unwrap_or((part, part));
            let (a, b) = (number(a)?, number(b)?);
            if a <= b { Ok((a, b)) } else { Err(format!("`{part}` runs backward: write {b}-{a}")) }
        };
        text.split(',').map(range).collect::<Result<_, _>>().map(Self)
    }
}

/// One part of an export that is divided among machines: part `index` of `count`, counted from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    index: u32,
    count: u32,
}

impl Shard {
    /// Everything.
    pub const WHOLE: Self = Self { index: 1, count: 1 };

    /// Part `index` of `count`; none where there is no such part.
    #[must_use]
    pub fn new(index: u32, count: u32) -> Option<Self> {
        (1 <= index && index <= count).then_some(Self { index, count })
    }

    /// Which part, counted from 1.
    #[must_use]
    pub(crate) const fn index(self) -> u32 {
        self.index
    }

    /// Of how many.
    #[must_use]
    pub(crate) const fn count(self) -> u32 {
        self.count
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let parsed = text.split_once('/').and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
        match parsed {
            Some((index, count)) if 1 <= index && index <= count => Ok(Self { index, count }),
            _ => Err(format!("`{text}` is no shard: write I/N with I from 1 to N, such as 2/3")),
        }
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_count_inclusively_and_stop_at_the_clip_s_end() {
        let set: FrameSet = "3-5,5-6,90-200".parse().unwrap();
        assert_eq!(set.of(92), [3, 4, 5, 6, 90, 91]);
        assert_eq!("7".parse::<FrameSet>().unwrap().of(10), [7]);
        for bad in ["", "a", "5-3", "1-", "-1"] {
            assert!(bad.parse::<FrameSet>().is_err(), "{bad}");
        }
    }
}

//! The colours of a moving picture that may only have 256: one set for the whole clip, learned from some of its frames.
//!
//! One set, and no pattern of dots for what lies between: the same colour is the same in every frame, so nothing
//! flickers. Distances are those of OKLab, in whole numbers, so that no processor rounds them otherwise.

use std::collections::BTreeMap;

use super::stream::Frames;
use crate::disk::Result;
use crate::drawing::{Colour, Oklab};

/// How many frames the colours are learned from. Every mouth shape and both lids occur in that many of a lesson.
const SAMPLES: u32 = 32;

/// Colours that are learned from at most: the most frequent ones. The rest are single pixels of edges.
const MOST: usize = 1 << 14;

/// A colour as four whole numbers whose distances are those the eye sees: OKLab and alpha, the first three fading with
/// alpha; 4096 parts.
type Seen = [i32; 4];

/// At most 256 colours, and the way from any colour to the nearest of them.
#[derive(Debug)]
pub(crate) struct Palette {
    colours: Vec<[u8; 4]>,
    seen: Vec<Seen>,
    /// Colours looked up before; a slot a hash, so its size stays the same.
    known: Vec<(u32, u8)>,
}

impl Palette {
    /// Learns `most` colours (2 to 256) from frames of a clip. `flat` is what becomes of a pixel's
    /// colour first; none where it needs no colour.
    ///
    /// # Errors
    /// When a frame cannot be drawn.
    pub(crate) fn learn(
        frames: &mut dyn Frames,
        most: usize,
        flat: impl Fn([u8; 4]) -> Option<[u8; 4]>,
    ) -> Result<Self> {
        let (size, count) = (frames.size(), frames.count());
        let mut found: BTreeMap<u32, u64> = BTreeMap::new();
        let samples = SAMPLES.min(count);
        for k in 0..samples {
            let n = (u64::from(k) * u64::from(count) / u64::from(samples)) as u32;
            frames.show(n)?;
            count_colours(super::cels::pixels(frames, size)?, &mut found);
        }
        let mut flattened: BTreeMap<u32, u64> = BTreeMap::new();
        for (colour, times) in found {
            if let Some(colour) = flat(colour.to_be_bytes()) {
                *flattened.entry(u32::from_be_bytes(colour)).or_default() += times;
            }
        }
        Ok(Self::of(flattened.into_iter().map(|(c, n)| (c.to_be_bytes(), n)).collect(), most))
    }

    /// Of colours and how often they occur.
    pub(crate) fn of(mut found: Vec<([u8; 4], u64)>, most: usize) -> Self {
        let most = most.clamp(2, 256);
        // The most frequent ones; equals in the order of their channels.
        found.sort_by_key(|(colour, times)| (std::cmp::Reverse(*times), *colour));
        found.truncate(MOST);
        let mut colours: Vec<[u8; 4]> = if found.len() <= most {
            found.iter().map(|f| f.0).collect()
        } else {
            let spots: Vec<Spot> = found
                .iter()
                // An edge is as visible as the areas beside it, though it has fewer pixels: weights grow slower than counts.
                .map(|(colour, times)| Spot { colour: *colour, seen: seen(*colour), weight: times.isqrt().max(1) })
                .collect();
            chosen(&spots, most)
        };
        colours.sort_unstable();
        colours.dedup();
        let seen = colours.iter().map(|c| seen(*c)).collect();
        let mut palette = Self { colours, seen, known: Vec::new() };
        // What an unused slot says has to be true as well.
        palette.known = vec![(u32::MAX, palette.nearest([255; 4])); 1 << 16];
        palette
    }

    /// The colours, straight RGBA, by rising channels.
    pub(crate) fn colours(&self) -> &[[u8; 4]] {
        &self.colours
    }

    /// The number of the colour that is nearest to this one.
    pub(crate) fn index_of(&mut self, colour: [u8; 4]) -> u8 {
        let key = u32::from_be_bytes(colour);
        let slot = (key.wrapping_mul(0x9E37_79B1) >> 16) as usize;
        let (known, index) = self.known[slot];
        if known == key {
            return index;
        }
        let index = self.nearest(colour);
        self.known[slot] = (key, index);
        index
    }

    fn nearest(&self, colour: [u8; 4]) -> u8 {
        let at = seen(colour);
        let nearest = self.seen.iter().enumerate().min_by_key(|(i, s)| (distance(**s, at), *i));
        nearest.map_or(0, |(i, _)| i as u8)
    }
}

/// Counts the colours of a picture. Neighbours are mostly equal, so runs of them are counted at once.
fn count_colours(pixels: &[u8], found: &mut BTreeMap<u32, u64>) {
    let mut run = (0_u32, 0_u64);
    for p in pixels.chunks_exact(4) {
        let colour = u32::from_be_bytes([p[0], p[1], p[2], p[3]]);
        if colour == run.0 {
            run.1 += 1;
            continue;
        }
        if run.1 > 0 {
            *found.entry(run.0).or_default() += run.1;
        }
        run = (colour, 1);
    }
    if run.1 > 0 {
        *found.entry(run.0).or_default() += run.1;
    }
}

#[derive(Debug, Clone, Copy)]
struct Spot {
    colour: [u8; 4],
    seen: Seen,
    weight: u64,
}

fn seen([r, g, b, a]: [u8; 4]) -> Seen {
    let lab = Oklab::from(Colour::rgb(r, g, b));
    let share = f64::from(a) / 255.0;
    [lab.l, lab.a, lab.b, 1.0].map(|v| (v * share * 4096.0).round() as i32)
}

fn distance(a: Seen, b: Seen) -> i64 {
    a.iter().zip(&b).map(|(a, b)| i64::from(a - b).pow(2)).sum()
}

/// `most` colours that stand for the spots: median cut, then k-means. A cluster is shown by a colour that occurs: the one
/// nearest to its mean, or where one has half the weight, that one, so that areas keep their very colour.
fn chosen(spots: &[Spot], most: usize) -> Vec<[u8; 4]> {
    let mut means = median_cut(spots, most);
    let mut owner = vec![0_usize; spots.len()];
    for _ in 0..8 {
        let mut moved = false;
        for (spot, owner) in spots.iter().zip(&mut owner) {
            let best = (0..means.len()).min_by_key(|k| distance(means[*k], spot.seen)).unwrap_or(0);
            moved |= best != *owner;
            *owner = best;
        }
        for (k, mean) in means.iter_mut().enumerate() {
            let own = spots.iter().zip(&owner).filter(|(_, o)| **o == k).map(|(s, _)| *s);
            if let Some(new) = mean_of(own) {
                *mean = new;
            }
        }
        if !moved {
            break;
        }
    }
    let shown = |k: usize| {
        let own = || spots.iter().zip(&owner).filter(move |(_, o)| **o == k).map(|(s, _)| s);
        let all: u64 = own().map(|s| s.weight).sum();
        let heaviest = own().max_by_key(|s| (s.weight, std::cmp::Reverse(s.colour)));
        match heaviest {
            Some(spot) if spot.weight * 2 >= all => Some(spot.colour),
            _ => own().min_by_key(|s| (distance(s.seen, means[k]), s.colour)).map(|s| s.colour),
        }
    };
    (0..means.len()).filter_map(shown).collect()
}

fn mean_of(spots: impl Iterator<Item = Spot>) -> Option<Seen> {
    let mut sums = [0_i64; 4];
    let mut all = 0_i64;
    for spot in spots {
        let weight = spot.weight as i64;
        sums.iter_mut().zip(spot.seen).for_each(|(sum, v)| *sum += i64::from(v) * weight);
        all += weight;
    }
    (all > 0).then(|| sums.map(|sum| (sum + all / 2).div_euclid(all) as i32))
}

/// Boxes of spots: the one with the most error is cut across its longest side, where it parts its weight in halves.
fn median_cut(spots: &[Spot], most: usize) -> Vec<Seen> {
    let mut boxes = vec![Boxed::new(spots.to_vec())];
    while boxes.len() < most {
        let Some((at, _)) = boxes.iter().enumerate().filter(|b| b.1.error > 0).max_by_key(|b| (b.1.error, b.0)) else {
            break;
        };
        let (low, high) = boxes.swap_remove(at).cut();
        boxes.extend([low, high]);
    }
    boxes.iter().filter_map(|b| mean_of(b.spots.iter().copied())).collect()
}

struct Boxed {
    spots: Vec<Spot>,
    /// The side with the largest spread.
    side: usize,
    /// Sum of weighted squares from the mean along that side; 0 where it cannot be cut.
    error: i64,
}

impl Boxed {
    fn new(spots: Vec<Spot>) -> Self {
        let mean = mean_of(spots.iter().copied()).unwrap_or_default();
        let spread = |side: usize| -> i64 {
            spots.iter().map(|s| i64::from(s.seen[side] - mean[side]).pow(2) * s.weight as i64).sum()
        };
        let (side, error) = (0..4).map(|side| (side, spread(side))).max_by_key(|s| (s.1, s.0)).unwrap_or((0, 0));
        Self { spots, side, error }
    }

    /// In two, both with something in them.
    fn cut(mut self) -> (Self, Self) {
        let side = self.side;
        self.spots.sort_by_key(|s| (s.seen[side], s.colour));
        let half = self.spots.iter().map(|s| s.weight).sum::<u64>() / 2;
        let mut sum = 0;
        let middle = self.spots.iter().position(|s| {
            sum += s.weight;
            sum > half
        });
        let at = middle.unwrap_or(0).clamp(1, self.spots.len().saturating_sub(1).max(1));
        let high = self.spots.split_off(at.min(self.spots.len()));
        (Self::new(self.spots), Self::new(high))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn few_colours_are_kept_as_they_are() {
        let found: Vec<_> = (0..200_u8).map(|i| ([i, 255 - i, i / 2, 255], 1 + u64::from(i))).collect();
        let mut palette = Palette::of(found.clone(), 255);
        for (colour, _) in found {
            let index = palette.index_of(colour);
            assert_eq!(palette.colours()[usize::from(index)], colour);
        }
    }

    #[test]
    fn a_large_area_keeps_its_very_colour_among_thousands() {
        let mut found = vec![([200, 170, 150, 255], 100_000), ([255; 4], 900_000), ([30, 26, 28, 255], 20_000)];
        for i in 0..4000_u32 {
            let [_, a, b, c] = i.wrapping_mul(2_654_435_761).to_be_bytes();
            found.push(([a, b, c, 255], 3));
        }
        let mut palette = Palette::of(found.clone(), 255);
        assert!((200..=255).contains(&palette.colours().len()), "{}", palette.colours().len());
        for (colour, _) in &found[..3] {
            let index = palette.index_of(*colour);
            assert_eq!(palette.colours()[usize::from(index)], *colour);
        }
    }

    proptest! {
        #[test]
        fn what_is_remembered_is_the_nearest(colours in prop::collection::vec(any::<[u8; 4]>(), 1..600)) {
            let mut palette = Palette::of(colours.iter().map(|c| (*c, 1)).collect(), 64);
            for colour in colours.iter().chain(&[[255; 4], [0; 4]]) {
                let first = palette.index_of(*colour);
                prop_assert_eq!(first, palette.nearest(*colour));
                prop_assert_eq!(first, palette.index_of(*colour));
            }
        }
    }
}

//! Region growing: pixels that hang together (thesis sec. 3.3.2, steps 5 and 6).

use super::{Bounds, Mask};
use crate::drawing::Image;

/// Which pixels are neighbours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Neighbours {
    /// Those that share a side.
    Four,
    /// Those that share a side or a corner.
    Eight,
}

/// Pixels that hang together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Region {
    /// Its number in [`Regions::labels`]: its place in the list, from 1.
    pub label: u32,
    /// The smallest box round it.
    pub bounds: Bounds,
    /// Its pixels.
    pub area: usize,
}

/// All regions of a mask.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Regions {
    /// A region's number a pixel; 0 where the mask is not set.
    pub labels: Image<u32>,
    /// The regions, in the order of their first pixels.
    pub list: Vec<Region>,
}

impl Regions {
    /// The regions of the set pixels of a mask.
    #[must_use]
    pub(crate) fn of(mask: &Mask, neighbours: Neighbours) -> Self {
        let (width, height) = (mask.width(), mask.height());
        let bits = mask.pixels();
        let mut labels = vec![0_u32; bits.len()];
        let mut list: Vec<Region> = Vec::new();
        let mut open: Vec<usize> = Vec::new();
        for seed in 0..bits.len() {
            if !bits[seed] || labels[seed] != 0 {
                continue;
            }
            let label = list.len() as u32 + 1;
            let (x, y) = (seed % width, seed / width);
            let mut region = Region { label, bounds: Bounds { x0: x, y0: y, x1: x + 1, y1: y + 1 }, area: 0 };
            labels[seed] = label;
            open.push(seed);
            while let Some(at) = open.pop() {
                let (x, y) = (at % width, at / width);
                region.area += 1;
                region.bounds.take(x, y);
                let (left, right) = (x.saturating_sub(1), (x + 1).min(width - 1));
                for row in y.saturating_sub(1)..=(y + 1).min(height - 1) {
                    let (from, to) = match neighbours {
                        Neighbours::Four if row != y => (x, x),
                        _ => (left, right),
                    };
                    let start = row * width + from;
                    let places = labels[start..=row * width + to].iter_mut().zip(&bits[start..]);
                    for (i, (there, set)) in places.enumerate() {
                        if *set && *there == 0 {
                            *there = label;
                            open.push(start + i);
                        }
                    }
                }
            }
            list.push(region);
        }
        Self { labels: Image::new(width, height, labels), list }
    }

    /// Whether a region touches the image's border.
    #[must_use]
    pub(crate) fn at_border(&self, region: &Region) -> bool {
        let b = region.bounds;
        b.x0 == 0 || b.y0 == 0 || b.x1 == self.labels.width() || b.y1 == self.labels.height()
    }

    /// The pixels of the regions that `pick` says yes to.
    #[must_use]
    pub(crate) fn mask_of(&self, pick: impl Fn(&Region) -> bool) -> Mask {
        let picked: Vec<bool> = std::iter::once(false).chain(self.list.iter().map(pick)).collect();
        self.labels.map(|l| picked[*l as usize])
    }

    /// The pixels of one region, row by row.
    pub(crate) fn pixels_of(&self, region: &Region) -> impl Iterator<Item = (usize, usize)> + use<'_> {
        let (b, label) = (region.bounds, region.label);
        (b.y0..b.y1)
            .flat_map(move |y| (b.x0..b.x1).map(move |x| (x, y)))
            .filter(move |(x, y)| self.labels[(*x, *y)] == label)
    }
}

#[cfg(test)]
pub(super) fn drawn(rows: &[&str]) -> Mask {
    let bits = rows.iter().flat_map(|r| r.bytes().map(|b| b == b'#')).collect();
    Mask::new(rows[0].len(), rows.len(), bits)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_touches_by_a_corner_hangs_together_only_with_eight_neighbours() {
        let mask = drawn(&["##..#", "..#.#", ".....", "#####"]);
        let four = Regions::of(&mask, Neighbours::Four);
        let areas = |r: &Regions| r.list.iter().map(|r| r.area).collect::<Vec<_>>();
        assert_eq!(areas(&four), [2, 2, 1, 5]);
        let eight = Regions::of(&mask, Neighbours::Eight);
        assert_eq!(areas(&eight), [3, 2, 5]);
        assert_eq!(eight.list[0].bounds, Bounds { x0: 0, y0: 0, x1: 3, y1: 2 });
        assert_eq!(eight.pixels_of(&eight.list[0]).collect::<Vec<_>>(), [(0, 0), (1, 0), (2, 1)]);
        assert_eq!(eight.mask_of(|r| r.area == 5).count(), 5);
        assert!(!four.at_border(&four.list[2]) && four.at_border(&four.list[0]));
    }
}

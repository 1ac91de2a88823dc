//! Which neighbouring items make a part: those that are cheapest written as poses of their own.
//!
//! Items that change together share their poses; items that change by themselves would multiply them. Of all ways to cut
//! the items, back to front, into runs, the one is taken whose poses and changes take the fewest bytes.

use std::collections::HashMap;

use super::survey::{ABSENT, Tracked};

/// What a change from pose to pose takes, in bytes: a time and a name.
const CHANGE: u64 = 14;

/// What a part takes beside its poses, in bytes.
const PART: u64 = 260;

/// The parts as ranges of items.
pub(super) fn split(items: &[Tracked], frames: usize) -> Vec<std::ops::Range<usize>> {
    let units = still_together(items);
    let n = units.len();
    // best[j]: the least that the units before j take, and where the last part of them begins.
    let mut best: Vec<(u64, usize)> = vec![(0, 0)];
    best.resize(n + 1, (u64::MAX, 0));
    for first in 0..n {
        let before = best[first].0;
        let mut sums = vec![(0_u64, 0_u64); frames];
        let mut moved = vec![ABSENT; frames];
        for last in first..n {
            let mut fits = true;
            for item in &items[units[last].clone()] {
                fits &= joins(&mut moved, &item.moved);
                add(&mut sums, item);
            }
            if !fits {
                break;
            }
            let cost = before + cost(&sums, moved_of(&moved));
            if cost < best[last + 1].0 {
                best[last + 1] = (cost, first);
            }
        }
    }
    let mut parts = Vec::new();
    let mut end = n;
    while end > 0 {
        let first = best[end].1;
        parts.push(units[first].start..units[end - 1].end);
        end = first;
    }
    parts.reverse();
    parts
}

/// Neighbours that never change are one from the start.
fn still_together(items: &[Tracked]) -> Vec<std::ops::Range<usize>> {
    let is_still = |t: &Tracked| t.at.windows(2).all(|w| w[0] == w[1]);
    let mut units: Vec<std::ops::Range<usize>> = Vec::new();
    let mut open = false;
    for (i, item) in items.iter().enumerate() {
        let still = is_still(item);
        match units.last_mut() {
            Some(unit) if open && still && items[i - 1].moved == item.moved => unit.end = i + 1,
            _ => units.push(i..i + 1),
        }
        open = still;
    }
    units
}

/// Whether an item moves as those before it, wherever both are there; takes its moves in.
fn joins(moved: &mut [u32], item: &[u32]) -> bool {
    moved.iter_mut().zip(item).all(|(have, new)| {
        if *have == ABSENT {
            *have = *new;
        }
        *new == ABSENT || *have == *new
    })
}

fn add(sums: &mut [(u64, u64)], item: &Tracked) {
    let weights: Vec<u64> = item.states.iter().map(|s| s.iter().map(super::Mark::weight).sum()).collect();
    for ((key, weight), at) in sums.iter_mut().zip(&item.at) {
        // SplitMix64's mixing, one step an item.
        let mut z = (*key ^ u64::from(*at)).wrapping_add(0x9E37_79B9_7F4A_7C15);
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        *key = z ^ (z >> 31);
        *weight += weights.get(*at as usize).copied().unwrap_or(0);
    }
}

fn moved_of(moved: &[u32]) -> u64 {
    moved.windows(2).filter(|w| w[0] != w[1]).count() as u64
}

/// The bytes of the different poses, and of the changes from one to the next.
fn cost(sums: &[(u64, u64)], moves: u64) -> u64 {
    let mut seen: HashMap<u64, ()> = HashMap::with_capacity(sums.len());
    let poses: u64 =
        sums.iter().filter(|(key, _)| seen.insert(*key, ()).is_none()).map(|(_, weight)| weight + 20).sum();
    let changes = sums.windows(2).filter(|w| w[0].0 != w[1].0).count() as u64;
    PART + poses + CHANGE * (changes + moves)
}

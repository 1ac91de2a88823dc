//! The places of a sound where a syllable is heard and none of the script lies.

use crate::project::Clip;
use crate::timing::Interval;

/// A place that overlaps a syllable by more than this, in seconds, is that syllable's.
const OVERLAP: f64 = 0.02;

/// A place shorter than this, in seconds, is none.
const SHORTEST: f64 = 0.03;

/// The places that no syllable has, by rising time.
pub(super) fn free(clip: &Clip, heard: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let taken = clip.intervals();
    let mut free = Vec::new();
    for (from, to) in heard {
        let middle = f64::midpoint(*from, *to);
        let over = |i: &&Interval| i.end.min(*to) - i.start.max(*from) > OVERLAP;
        if taken.iter().filter(over).any(|i| i.start <= middle && middle < i.end) {
            continue;
        }
        // What reaches a little into a neighbour is cut there.
        let from = taken.iter().filter(|i| i.start <= middle).map(|i| i.end).fold(*from, f64::max);
        let to = taken.iter().filter(|i| i.start > middle).map(|i| i.start).fold(*to, f64::min);
        if to - from >= SHORTEST {
            free.push((from, to));
        }
    }
    free
}

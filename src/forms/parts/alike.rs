//! Which of many poses can stand for which: the fewest that every pose has one near it among.
//!
//! The one that most others are near to is taken first, then the one that most of the rest are near to, and so on. Taken
//! in the order in which they are seen it would be a sixth more.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};
use std::sync::Arc;

use super::mark::{Mark, are_near};

/// The marks of a pose, item by item.
pub(crate) type Looks = Vec<Arc<[Mark]>>;

/// For every pose the one that stands for it, by number: itself or one that differs by no more than `steps` of the grid.
pub(crate) fn standing_for(poses: &[Looks], steps: i32) -> Vec<usize> {
    let mut stands: Vec<usize> = (0..poses.len()).collect();
    // Only what is made of the same can be near.
    let mut made_alike: BTreeMap<Vec<u8>, Vec<(usize, Vec<i32>)>> = BTreeMap::new();
    for (number, looks) in poses.iter().enumerate() {
        let (mut kind, mut places) = (Vec::new(), Vec::new());
        for marks in looks {
            kind.push(b'|');
            marks.iter().for_each(|mark| mark.taken_apart(&mut kind, &mut places));
        }
        made_alike.entry(kind).or_default().push((number, places));
    }
    for group in made_alike.into_values() {
        cover(poses, group, steps, &mut stands);
    }
    stands
}

fn cover(poses: &[Looks], mut group: Vec<(usize, Vec<i32>)>, steps: i32, stands: &mut [usize]) {
    // Along the number that differs most, those that are near stand close together.
    let widest = (0..group.first().map_or(0, |g| g.1.len())).max_by_key(|i| {
        let own = || group.iter().map(|g| g.1[*i]);
        i64::from(own().max().unwrap_or(0)) - i64::from(own().min().unwrap_or(0))
    });
    let Some(widest) = widest.filter(|_| group.len() > 1) else { return };
    group.sort_by_key(|g| (g.1[widest], g.0));
    let mut near: Vec<Vec<u32>> = vec![Vec::new(); group.len()];
    for i in 0..group.len() {
        let reach = group[i].1[widest].saturating_add(steps);
        for j in (i + 1..group.len()).take_while(|j| group[*j].1[widest] <= reach) {
            let (a, b) = (&group[i], &group[j]);
            let close = a.1.iter().zip(&b.1).all(|(p, q)| p.abs_diff(*q) <= steps.unsigned_abs());
            if close && near_poses(&poses[a.0], &poses[b.0], steps) {
                near[i].push(j as u32);
                near[j].push(i as u32);
            }
        }
    }
    let mut open = vec![true; group.len()];
    let count = |i: usize, open: &[bool]| near[i].iter().filter(|j| open[**j as usize]).count();
    let mut next: BinaryHeap<(usize, Reverse<usize>, usize)> =
        (0..group.len()).map(|i| (near[i].len(), Reverse(group[i].0), i)).collect();
    while let Some((most, order, i)) = next.pop() {
        if !open[i] {
            continue;
        }
        let now = count(i, &open);
        if now < most {
            next.push((now, order, i));
            continue;
        }
        open[i] = false;
        for j in &near[i] {
            if std::mem::take(&mut open[*j as usize]) {
                stands[group[*j as usize].0] = group[i].0;
            }
        }
    }
}

/// Whether two poses of a part look alike.
fn near_poses(a: &[Arc<[Mark]>], b: &[Arc<[Mark]>], steps: i32) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| Arc::ptr_eq(a, b) || are_near(a, b, steps))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::Colour;
    use crate::forms::parts::Path;

    fn pose(x: i32) -> Looks {
        let path = Path { verbs: (*b"ML").into(), points: [[0, 0], [x, 0]].into() };
        vec![vec![Mark::Path { path, colour: Colour::BLACK }].into()]
    }

    #[test]
    fn the_middle_stands_for_both_its_sides() {
        let poses: Vec<Looks> = [0, 3, 6, 20, 22].map(pose).into();
        assert_eq!(standing_for(&poses, 3), [1, 1, 1, 3, 3]);
        // What differs in colour or kind stands for itself.
        let other = vec![
            vec![Mark::Path {
                path: Path { verbs: (*b"ML").into(), points: [[0, 0], [3, 0]].into() },
                colour: Colour::WHITE,
            }]
            .into(),
        ];
        assert_eq!(standing_for(&[pose(0), other, Vec::new(), pose(0)], 3), [0, 1, 2, 0]);
    }
}

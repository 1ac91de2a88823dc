//! The prints of tiles with the things of a drawing on them.

use super::leaf::{Leaf, Part, Shape};
use super::print::Print;
use super::tiles::{Grid, Touch};

/// Puts parts on the tiles, back to front.
pub(super) fn mark(grid: Grid, prints: &mut [Print], parts: &[Part]) {
    let mut one = |leaf: &Leaf| {
        for (tile, touch) in leaf.touched(grid) {
            let print = &mut prints[*tile as usize];
            match (touch, &leaf.shape) {
                (Touch::Inside, Shape::Fill { pixel, .. }) => {
                    // What is under an opaque colour cannot be seen.
                    if pixel >> 24 == 255 {
                        *print = grid.start(*tile as usize);
                    }
                    print.word(u64::from(*pixel));
                }
                // The same thing is another one elsewhere.
                _ => {
                    print.print(leaf.print);
                    print.word(u64::from(*tile));
                }
            }
        }
    };
    for part in parts {
        match part {
            Part::One(leaf) => one(leaf),
            Part::Kept(_, leaves) => leaves.iter().for_each(&mut one),
        }
    }
}

//! The tiles of a picture, each with a print of what is painted on it.

use super::canvas::{Area, Pixel};
use super::edges::{BITS, Edges};
use super::print::Print;

/// Pixels across and down of a tile, unless the picture ends. A row of tiles is a piece of a PNG file that stands by
/// itself.
pub(super) const TILE: (i32, i32) = (64, 32);

/// How a thing touches a tile.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Touch {
    /// It may do anything there.
    Crossed,
    /// It covers the tile whole.
    Inside,
}

/// How a picture is cut.
#[derive(Debug, Clone, Copy)]
pub(super) struct Grid {
    area: Area,
    pub(super) columns: usize,
    pub(super) rows: usize,
}

impl Grid {
    pub(super) fn new(area: Area) -> Self {
        let (wide, high) = (TILE.0 as usize, TILE.1 as usize);
        Self { area, columns: area.width().div_ceil(wide), rows: area.height().div_ceil(high) }
    }

    pub(super) fn len(self) -> usize {
        self.columns * self.rows
    }

    /// The pixels of a tile, counted row by row.
    pub(super) fn tile(self, index: usize) -> Area {
        let (column, row) = (index % self.columns, index / self.columns);
        self.block(column..column + 1, row..row + 1)
    }

    /// The pixels of tiles that lie side by side.
    pub(super) fn run(self, tiles: std::ops::Range<usize>) -> Area {
        let (row, first) = (tiles.start / self.columns, tiles.start % self.columns);
        self.block(first..first + tiles.len(), row..row + 1)
    }

    /// The pixels of neighbouring tiles.
    fn block(self, columns: std::ops::Range<usize>, rows: std::ops::Range<usize>) -> Area {
        let at = |i: usize, size: i32| i as i32 * size;
        let (x0, y0) = (at(columns.start, TILE.0), at(rows.start, TILE.1));
        Area { x0, y0, x1: at(columns.end, TILE.0), y1: at(rows.end, TILE.1) }.meet(self.area)
    }

    /// The print of a tile with nothing on it. Where the picture ends tiles are smaller.
    pub(super) fn start(self, tile: usize) -> Print {
        let area = self.tile(tile);
        let mut print = Print::START;
        print.word((area.width() as u64) << 32 | area.height() as u64);
        print
    }

    /// The prints of tiles with nothing but one pixel on them.
    pub(super) fn filled(self, pixel: Pixel) -> Vec<Print> {
        let mut prints: Vec<Print> = (0..self.len()).map(|tile| self.start(tile)).collect();
        prints.iter_mut().for_each(|print| print.word(u64::from(pixel)));
        prints
    }

    /// All tiles that a box touches.
    pub(super) fn of_box(self, bounds: Area) -> Vec<(u32, Touch)> {
        let Some((columns, rows)) = self.range(bounds) else { return Vec::new() };
        let tiles = rows.flat_map(|row| columns.clone().map(move |column| row * self.columns + column));
        tiles.map(|tile| (tile as u32, Touch::Crossed)).collect()
    }

    fn range(self, bounds: Area) -> Option<(std::ops::Range<usize>, std::ops::Range<usize>)> {
        let b = bounds.meet(self.area);
        let range = |from: i32, to: i32, size: i32| (from / size) as usize..((to - 1) / size) as usize + 1;
        (!b.is_empty()).then(|| (range(b.x0, b.x1, TILE.0), range(b.y0, b.y1, TILE.1)))
    }

    /// The tiles that edges cross, and those that lie inside the outline whole.
    pub(super) fn of_edges(self, edges: &Edges, bounds: Area) -> Vec<(u32, Touch)> {
        let Some((columns, rows)) = self.range(bounds) else { return Vec::new() };
        if columns.len() * rows.len() == 1 {
            return self.of_box(bounds);
        }
        let (wide, high) = (TILE.0 << BITS, TILE.1 << BITS);
        let (first, last) = (columns.start as i32, columns.end as i32 - 1);
        // For each tile whether it is crossed, and how the winding changes from the tile before it.
        let mut tiles = vec![(false, 0_i32); columns.len() * rows.len()];
        for e in &edges.all {
            let top = e.y0.div_euclid(high).max(rows.start as i32);
            // An edge that ends on the border between two rows touches both.
            let bottom = e.y1.div_euclid(high).min(rows.end as i32 - 1);
            for row in top..=bottom {
                let start = (row as usize - rows.start) * columns.len();
                let at = |y: i32| {
                    let y = y.clamp(e.y0, e.y1);
                    e.x0 + (i64::from(y - e.y0) * i64::from(e.x1 - e.x0) / i64::from(e.y1 - e.y0)) as i32
                };
                let level = e.y0 == e.y1;
                let (from, to) = if level || e.x0.div_euclid(wide) == e.x1.div_euclid(wide) {
                    (e.x0, e.x1)
                } else {
                    (at(row * high), at((row + 1) * high))
                };
                // A little more, for what is rounded.
                let (left, right) = ((from.min(to) - 2).div_euclid(wide), (from.max(to) + 2).div_euclid(wide));
                for column in left.max(first)..=right.min(last) {
                    tiles[start + (column - first) as usize].0 = true;
                }
                let middle = row * high + high / 2;
                if e.y0 <= middle && middle < e.y1 {
                    // What is left of all counts from the first tile on; what is in a tile, from the next one on.
                    let column = (from.max(to) + 2).div_euclid(wide) + 1;
                    if column <= last {
                        tiles[start + (column.max(first) - first) as usize].1 += e.down;
                    }
                }
            }
        }
        let mut touched = Vec::with_capacity(tiles.len());
        for (row, line) in rows.zip(tiles.chunks(columns.len())) {
            let mut winding = 0;
            for (column, (crossed, change)) in columns.clone().zip(line) {
                winding += change;
                let tile = (row * self.columns + column) as u32;
                if *crossed {
                    touched.push((tile, Touch::Crossed));
                } else if winding != 0 {
                    touched.push((tile, Touch::Inside));
                }
            }
        }
        touched
    }

    /// Blocks that hold every tile that `wanted` says, and few others: what neighbours each other is painted at once.
    pub(super) fn blocks(self, wanted: impl Fn(usize) -> bool) -> Vec<Area> {
        let mut done: Vec<Area> = Vec::new();
        let mut open: Vec<(Area, i64)> = Vec::new();
        for row in 0..self.rows {
            let mut next: Vec<(Area, i64)> = Vec::new();
            let mut column = 0;
            while column < self.columns {
                let start = column;
                while column < self.columns && wanted(row * self.columns + column) {
                    column += 1;
                }
                if start == column {
                    column += 1;
                    continue;
                }
                let run = self.block(start..column, row..row + 1);
                let mut all = (run, size(run));
                // It joins what touches it above, unless too much would be painted for nothing.
                open.retain(|(block, used)| {
                    let joined = block.join(all.0);
                    let touches = block.x0 <= all.0.x1 && all.0.x0 <= block.x1;
                    let good = touches && 4 * size(joined) <= 6 * (used + all.1);
                    if good {
                        all = (joined, used + all.1);
                    }
                    !good
                });
                next.push(all);
            }
            done.extend(open.drain(..).map(|(block, _)| block));
            open = next;
        }
        done.extend(open.into_iter().map(|(block, _)| block));
        done
    }
}

fn size(area: Area) -> i64 {
    area.width() as i64 * area.height() as i64
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn blocks_hold_every_wanted_tile(wanted in prop::collection::vec(prop::bool::weighted(0.2), 60)) {
            let grid = Grid::new(Area::of_size(620, 170));
            prop_assert_eq!(grid.len(), 60);
            let blocks = grid.blocks(|i| wanted[i]);
            for i in (0..60).filter(|i| wanted[*i]) {
                let tile = grid.tile(i);
                prop_assert!(blocks.iter().any(|b| b.meet(tile) == tile), "tile {i}");
            }
        }
    }
}

//! How much light comes through the hair: its density on a grid, and what is left of a ray that crosses it.

use rayon::prelude::*;

use crate::hair::Strand;
use crate::skull::Skull;
use crate::vector::{V, smooth};

const CELL: f32 = 4.0;
const FROM: V = V(-184.0, -208.0, -192.0);
const SIZE: [usize; 3] = [92, 110, 94];

/// Hair per cell, smoothed, and what part of each cell the skull fills.
pub struct Mass {
    cells: Vec<f32>,
    solid: Vec<f32>,
}

impl Mass {
    pub fn of(strands: &[Strand], skull: &Skull) -> Mass {
        let mut cells = vec![0.0f32; SIZE[0] * SIZE[1] * SIZE[2]];
        for strand in strands.iter().filter(|s| s.mass) {
            for pair in strand.points.windows(2) {
                let length = (pair[1] - pair[0]).len();
                let q = ((pair[0] + pair[1]) * 0.5 - FROM) * (1.0 / CELL);
                let (x, y, z) = (q.0.floor(), q.1.floor(), q.2.floor());
                let (fx, fy, fz) = (q.0 - x, q.1 - y, q.2 - z);
                for (k, w) in [(0, 1.0 - fz), (1, fz)] {
                    for (j, v) in [(0, 1.0 - fy), (1, fy)] {
                        for (i, u) in [(0, 1.0 - fx), (1, fx)] {
                            if let Some(at) = index(x as i32 + i, y as i32 + j, z as i32 + k) {
                                cells[at] += u * v * w * length * strand.width;
                            }
                        }
                    }
                }
            }
        }
        let solid = (0..cells.len())
            .into_par_iter()
            .map(|i| {
                let at = V((i % SIZE[0]) as f32, (i / SIZE[0] % SIZE[1]) as f32, (i / SIZE[0] / SIZE[1]) as f32);
                smooth(-6.0, -14.0, skull.distance(FROM + at * CELL))
            })
            .collect();
        Mass { cells, solid }
    }

    /// The part of a small lamp that the skull leaves to a hair at `p`.
    pub fn past_skull(&self, p: V, direction: V) -> f32 {
        let sum: f32 = (1..14).map(|i| sample(&self.solid, p + direction * (14.0 * i as f32))).sum();
        (-1.6 * sum).exp()
    }

    fn at(&self, p: V) -> f32 {
        sample(&self.cells, p)
    }

    /// The part of the light that reaches `p` from `direction` (Beer and Lambert): exp(−Σ density · cover).
    pub fn through(&self, p: V, direction: V, cover: f32, reach: usize) -> f32 {
        let mut sum = 0.0;
        for i in 0..reach {
            let q = p + direction * (CELL * (i as f32 + 1.2));
            sum += self.at(q);
        }
        (-sum * cover / (CELL * CELL)).exp()
    }
}

/// Between the eight cells around `p`.
fn sample(cells: &[f32], p: V) -> f32 {
    let q = (p - FROM) * (1.0 / CELL);
    let (x, y, z) = (q.0.floor(), q.1.floor(), q.2.floor());
    let (fx, fy, fz) = (q.0 - x, q.1 - y, q.2 - z);
    let mut sum = 0.0;
    for (k, w) in [(0, 1.0 - fz), (1, fz)] {
        for (j, v) in [(0, 1.0 - fy), (1, fy)] {
            for (i, u) in [(0, 1.0 - fx), (1, fx)] {
                if let Some(at) = index(x as i32 + i, y as i32 + j, z as i32 + k) {
                    sum += u * v * w * cells[at];
                }
            }
        }
    }
    sum
}

fn index(x: i32, y: i32, z: i32) -> Option<usize> {
    let inside = |v: i32, n: usize| v >= 0 && (v as usize) < n;
    (inside(x, SIZE[0]) && inside(y, SIZE[1]) && inside(z, SIZE[2]))
        .then(|| (z as usize * SIZE[1] + y as usize) * SIZE[0] + x as usize)
}

//! How the flesh of a face follows its muscles: a move for every place of the face at rest, and back.
//!
//! Moves lie in the picture's plane, are the same left and right, and are proportional to the numbers of an [`Act`]. The
//! lips part along their line, so that there are two fields of moves: of what is above that line and of what is below.

use crate::act::Act;
use crate::curve::Curve;
use crate::vector::{V, mix, smooth, spot};

/// The table of the way back: from x 0 and this y on, a cell a unit.
const TOP: f32 = -130.0;
const WIDE: usize = 128;
const HIGH: usize = 400;

/// Half the width of the mouth at rest.
const CORNER: f32 = 38.0;

/// Edges of the lips are tabulated for so many half units from the middle.
const EDGE: usize = 140;

#[derive(Clone)]
pub struct Flesh {
    act: Act,
    line: Curve,
    /// How far each place of the moved face has been moved, above and below the line of the lips.
    tables: [Vec<(f32, f32)>; 2],
    /// The edge of the upper and of the lower lip: y for half units of x.
    edges: [Vec<f32>; 2],
    /// Where the corner of the mouth is, and how far the lips stand apart where they do most.
    corner: f32,
    gape: f32,
}

impl Flesh {
    pub fn new(act: Act, line: &Curve) -> Flesh {
        let mut flesh = Flesh {
            act,
            line: line.clone(),
            tables: [vec![], vec![]],
            edges: [vec![], vec![]],
            corner: 0.0,
            gape: 0.0,
        };
        flesh.corner = flesh.moved(CORNER, line.at(CORNER), false).0;
        flesh.edges = [false, true].map(|low| flesh.edge(low));
        flesh.gape = flesh.edges[0].iter().zip(&flesh.edges[1]).map(|(a, b)| b - a).fold(0.0, f32::max);
        flesh.tables = [false, true].map(|low| flesh.table(low));
        flesh
    }

    /// Where a place of the right half at rest goes; `low` where it belongs to what is below the line of the lips.
    pub fn moved(&self, x: f32, y: f32, low: bool) -> (f32, f32) {
        let (dx, dy) = self.by(x, y, low);
        (x + dx, y + dy)
    }

    fn by(&self, x: f32, y: f32, low: bool) -> (f32, f32) {
        let a = &self.act;
        let (mut dx, mut dy) = (0.0, 0.0);
        // Brows, with the skin of the forehead over them.
        let tall = smooth(-96.0, -42.0, y) * smooth(-8.5, -21.5, y) * smooth(114.0, 94.0, x);
        if tall > 0.0 {
            let (inner, outer) = (smooth(52.0, 22.0, x), smooth(50.0, 84.0, x));
            dy += tall * (inner * a.brow_inner + outer * a.brow_outer + (1.0 - inner - outer) * a.brow_middle);
            dx -= tall * inner * (x / 15.0).min(1.0) * a.brow_in;
        }
        if y < 10.0 {
            return (dx, dy);
        }
        dy -= a.cheek * spot(((x - 58.0) / 24.0).hypot((y - 52.0) / 20.0)) * smooth(14.0, 28.0, y);
        dy -= a.sneer * spot(((x - 20.0) / 13.0).hypot((y - 54.0) / 14.0));
        // Corners of the mouth: all between them is stretched.
        let s = (x / CORNER).min(1.0);
        let near = smooth(52.0, 97.0, y) * smooth(152.0, 108.0, y);
        let beyond = smooth(90.0, CORNER, x);
        dx += near * s * beyond * a.corner_out;
        dy += near * s * s * beyond * a.corner_down;
        // Lips, from nothing at the corners to all in the middle.
        let arc = (1.0 - s * s).max(0.0).powf(0.8);
        let line = self.line.at(x.min(CORNER));
        let pressed = |u: f32| a.press * u * smooth(26.0, 12.0, u) * smooth(46.0, 34.0, x);
        if low {
            dy += arc * smooth(142.0, 112.0, y) * a.lower;
            let wide = smooth(104.0, 38.0, x) * smooth(268.0, 184.0, y);
            dy += mix(arc, wide, smooth(102.0, 140.0, y)) * a.jaw;
            dy -= pressed((y - line).max(0.0));
        } else {
            dy += arc * smooth(64.0, 89.0, y) * a.upper;
            dy -= arc.sqrt() * spot((x - 19.0) / 11.0) * smooth(60.0, 88.0, y) * a.bare;
            dy += pressed((line - y).max(0.0));
        }
        (dx, dy)
    }

    fn edge(&self, low: bool) -> Vec<f32> {
        let steps = 160;
        let line: Vec<(f32, f32)> = (0..=steps)
            .map(|i| {
                let x = 80.0 * i as f32 / steps as f32;
                self.moved(x, self.line.at(x), low)
            })
            .collect();
        (0..EDGE)
            .map(|i| {
                let x = i as f32 * 0.5;
                let k = line[1..line.len() - 1].iter().filter(|p| p.0 <= x).count();
                let (a, b) = (line[k], line[k + 1]);
                mix(a.1, b.1, ((x - a.0) / (b.0 - a.0).max(1e-3)).clamp(0.0, 1.0))
            })
            .collect()
    }

    fn table(&self, low: bool) -> Vec<(f32, f32)> {
        (0..WIDE * HIGH)
            .map(|i| {
                let (x, y) = ((i % WIDE) as f32, TOP + (i / WIDE) as f32);
                let (mut qx, mut qy) = (x, y);
                for _ in 0..24 {
                    let (dx, dy) = self.by(qx, qy, low);
                    let (nx, ny) = (x - dx, y - dy);
                    let step = (nx - qx).abs() + (ny - qy).abs();
                    // Half steps where the moves are steep.
                    (qx, qy) = (mix(qx, nx, 0.8), mix(qy, ny, 0.8));
                    if step < 1e-3 {
                        break;
                    }
                }
                (x - qx, y - qy)
            })
            .collect()
    }

    /// Y of the upper and of the lower lip's edge at `x` of the moved face.
    pub fn edges(&self, x: f32) -> (f32, f32) {
        let u = (x * 2.0).clamp(0.0, EDGE as f32 - 1.001);
        let (i, t) = (u as usize, u.fract());
        let at = |e: &[f32]| mix(e[i], e[i + 1], t);
        (at(&self.edges[0]), at(&self.edges[1]))
    }

    pub fn corner(&self) -> f32 {
        self.corner
    }

    pub fn gape(&self) -> f32 {
        self.gape
    }

    /// What a place of the moved face moves with: all in front, nothing at the neck's back.
    fn share(z: f32) -> f32 {
        smooth(2.0, 58.0, z)
    }

    /// The place at rest of a place of the even face.
    pub fn back(&self, q: V) -> V {
        let share = Flesh::share(q.2);
        if share <= 0.0 || q.1 > TOP + HIGH as f32 - 2.0 || q.1 < TOP {
            return q;
        }
        let x = q.0.abs();
        let (up, down) = self.edges(x);
        let low = q.1 > 0.5 * (up + down);
        let (u, v) = (x.min(WIDE as f32 - 1.001), q.1 - TOP);
        let (i, j) = (u as usize, v as usize);
        let (s, t) = (u - i as f32, v - j as f32);
        let table = &self.tables[usize::from(low)];
        let at = |i: usize, j: usize| table[j * WIDE + i];
        let (a, b, c, d) = (at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1));
        let dx = mix(mix(a.0, b.0, s), mix(c.0, d.0, s), t) * share;
        let dy = mix(mix(a.1, b.1, s), mix(c.1, d.1, s), t) * share;
        let (rx, mut ry) = (x - dx, q.1 - dy);
        // Between the lips there is no flesh: what is asked there belongs to the nearer edge.
        if rx < CORNER && down > up {
            let line = self.line.at(rx);
            ry = if low { ry.max(line) } else { ry.min(line) };
        }
        V(rx * q.0.signum(), ry, q.2)
    }

    /// Where a place at rest of the even face goes.
    pub fn forth(&self, q: V) -> V {
        let x = q.0.abs();
        let low = q.1 > self.line.at(x.min(CORNER));
        let (dx, dy) = self.by(x, q.1, low);
        let share = Flesh::share(q.2);
        V((x + dx * share) * if q.0 < 0.0 { -1.0 } else { 1.0 }, q.1 + dy * share, q.2)
    }
}

//! The large form of a head without its nose, lips, lids and ears: a distance from an inner point for every direction.
//!
//! The form goes through points of one half of a face (x, y as seen in a photograph, z by anthropometry); between them
//! the radius is a radial basis function over directions, r(d) = Σ wᵢ (|d − dᵢ|³ + |d − d′ᵢ|³) + a + b·d.y + c·d.z,
//! with d′ the mirror of d: the smoothest surface of its kind through the points. It is tabulated once.

use crate::vector::V;

const WIDE: usize = 512;
const HIGH: usize = 256;

/// The inner point, on the axis between the ears.
pub const CENTRE: V = V(0.0, 0.0, 5.0);

pub struct Skull {
    table: Vec<f32>,
}

impl Skull {
    /// Through `points` (x ≥ 0; those with x > 0 count on both sides). `give` lets the surface miss a point a little
    /// where points disagree.
    pub fn through(points: &[V], give: f64) -> Skull {
        let directions: Vec<(V, f64)> = points
            .iter()
            .map(|p| {
                let q = *p - CENTRE;
                (q.unit(), f64::from(q.len()))
            })
            .collect();
        let basis = |d: V, of: V| -> f64 {
            let (a, b) = ((d - of).len(), (d - V(-of.0, of.1, of.2)).len());
            f64::from(a * a * a + b * b * b)
        };
        let n = directions.len();
        let mut rows = vec![vec![0.0f64; n + 4]; n + 3];
        for i in 0..n {
            let (d, r) = directions[i];
            for j in 0..n {
                rows[i][j] = basis(d, directions[j].0);
            }
            rows[i][i] += give;
            for (k, v) in [1.0, f64::from(d.1), f64::from(d.2)].into_iter().enumerate() {
                rows[i][n + k] = v;
                rows[n + k][i] = v;
            }
            rows[i][n + 3] = r;
        }
        let weights = solve(rows);
        let mut table = vec![0.0; WIDE * HIGH];
        for (row, line) in table.chunks_mut(WIDE).enumerate() {
            for (column, value) in line.iter_mut().enumerate() {
                let d = direction(column, row);
                let mut r = weights[n] + weights[n + 1] * f64::from(d.1) + weights[n + 2] * f64::from(d.2);
                for (w, (of, _)) in weights.iter().zip(&directions) {
                    r += w * basis(d, *of);
                }
                *value = r as f32;
            }
        }
        Skull { table }
    }

    /// The radius in the direction of `q`, by bicubic interpolation (Catmull and Rom).
    fn radius(&self, q: V, length: f32) -> f32 {
        let u = (q.0.atan2(-q.2) / std::f32::consts::TAU + 0.5) * WIDE as f32;
        let v = ((q.1 / length).clamp(-1.0, 1.0).acos() / std::f32::consts::PI) * HIGH as f32 - 0.5;
        let (fu, fv) = (u.floor(), v.floor());
        let (wu, wv) = (weights(u - fu), weights(v - fv));
        let (iu, iv) = (fu as i32, fv as i32);
        let mut sum = 0.0;
        for (k, wv) in wv.iter().enumerate() {
            let row = (iv + k as i32 - 1).clamp(0, HIGH as i32 - 1) as usize * WIDE;
            for (j, wu) in wu.iter().enumerate() {
                let column = (iu + j as i32 - 1).rem_euclid(WIDE as i32) as usize;
                sum += wv * wu * self.table[row + column];
            }
        }
        sum
    }

    /// About the signed distance of `p` from the surface; exact on it.
    pub fn distance(&self, p: V) -> f32 {
        let q = p - CENTRE;
        let length = q.len().max(1e-3);
        length - self.radius(q, length)
    }

    /// Where the ray from the inner point in direction `d` leaves the head.
    pub fn surface(&self, d: V) -> V {
        CENTRE + d * self.radius(d, 1.0)
    }

    /// The direction away from the surface at `p`.
    pub fn outward(&self, p: V) -> V {
        let e = 1.5;
        let at = |d: V| self.distance(p + d);
        V(
            at(V(e, 0.0, 0.0)) - at(V(-e, 0.0, 0.0)),
            at(V(0.0, e, 0.0)) - at(V(0.0, -e, 0.0)),
            at(V(0.0, 0.0, e)) - at(V(0.0, 0.0, -e)),
        )
        .unit()
    }
}

/// The direction of a cell of the table: columns go round the vertical axis, rows from the chin's side to the crown.
fn direction(column: usize, row: usize) -> V {
    let round = (column as f32 / WIDE as f32 - 0.5) * std::f32::consts::TAU;
    let (sin, cos) = ((row as f32 + 0.5) / HIGH as f32 * std::f32::consts::PI).sin_cos();
    V(sin * round.sin(), cos, -sin * round.cos())
}

fn weights(t: f32) -> [f32; 4] {
    let (t2, t3) = (t * t, t * t * t);
    [0.5 * (-t3 + 2.0 * t2 - t), 0.5 * (3.0 * t3 - 5.0 * t2 + 2.0), 0.5 * (-3.0 * t3 + 4.0 * t2 + t), 0.5 * (t3 - t2)]
}

/// Gaussian elimination with row exchange; each row carries its right side last.
fn solve(mut rows: Vec<Vec<f64>>) -> Vec<f64> {
    let n = rows.len();
    for i in 0..n {
        let pivot = (i..n).max_by(|a, b| rows[*a][i].abs().total_cmp(&rows[*b][i].abs())).unwrap_or(i);
        rows.swap(i, pivot);
        let (head, tail) = rows.split_at_mut(i + 1);
        let top = &head[i];
        for row in tail {
            let f = row[i] / top[i];
            if f != 0.0 {
                for (a, b) in row[i..].iter_mut().zip(&top[i..]) {
                    *a -= f * b;
                }
            }
        }
    }
    let mut x = vec![0.0; n];
    for i in (0..n).rev() {
        let known: f64 = (i + 1..n).map(|j| rows[i][j] * x[j]).sum();
        x[i] = (rows[i][n] - known) / rows[i][i];
    }
    x
}

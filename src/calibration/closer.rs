//! Points brought to where a person's face looks as it does there in other shots, as far as a face can move so.

use nalgebra::{DMatrix, DVector};

use super::patches::{Patches, Sight, View, sights};
use crate::geometry::{Point, Similarity, Vec2};

/// How a model's points may move: ways of the rig, and bumps as flesh makes them.
#[derive(Debug, Clone)]
pub(super) struct Flesh {
    /// Columns of x and y in turns, each one standard deviation.
    ways: DMatrix<f64>,
    points: Vec<Point>,
}

/// How wide a bump is and how high, in pupil distances.
const BUMP: (f64, f64) = (0.28, 0.025);
/// What every point moves by itself.
const FREE: f64 = 0.006;
/// How loosely the place is held: turn, size, shift.
const LOOSE: f64 = 0.05;

/// Where a shot's points are.
#[derive(Debug, Clone)]
pub(super) struct Laid {
    /// From the frame of the neutral pupils to pixels.
    pub place: Similarity,
    /// The points in that frame.
    pub points: Vec<Point>,
    /// How far each may be off.
    pub errors: Vec<f64>,
    /// The mean correlation of what is seen.
    pub like: f64,
}

impl Flesh {
    /// Of a model's points in the frame of the neutral pupils, and the ways that the rig has for them.
    pub(crate) fn new(points: &[Point], rig: &DMatrix<f64>) -> Self {
        let n = points.len();
        let centres: Vec<Point> =
            if n <= 60 { points.to_vec() } else { points.iter().step_by(n.div_ceil(50)).copied().collect() };
        let density = |c: &Point| {
            let near: f64 = centres.iter().map(|d| (-c.distance_squared(*d) / (BUMP.0 * BUMP.0)).exp()).sum();
            near.max(1.0).sqrt()
        };
        let mut ways = DMatrix::zeros(2 * n, rig.ncols() + 2 * centres.len());
        ways.view_mut((0, 0), (2 * n, rig.ncols())).copy_from(rig);
        for (k, c) in centres.iter().enumerate() {
            let high = BUMP.1 / density(c);
            for (i, p) in points.iter().enumerate() {
                let bump = high * (-0.5 * p.distance_squared(*c) / (BUMP.0 * BUMP.0)).exp();
                ways[(2 * i, rig.ncols() + 2 * k)] = bump;
                ways[(2 * i + 1, rig.ncols() + 2 * k + 1)] = bump;
            }
        }
        Self { ways, points: points.to_vec() }
    }

    /// Moves points from `start` to where they look as in `looks`. `fixed` are known, in pixels.
    pub(crate) fn closer(
        &self,
        view: &View,
        looks: &[Patches],
        start: &Laid,
        fixed: &[(usize, Point)],
        reaches: &[f64],
    ) -> Laid {
        let mut laid = start.clone();
        for reach in reaches {
            let seen = sights(view, &laid.place, &laid.points, looks, *reach);
            if let Some(next) = self.step(&laid, &seen, fixed) {
                laid = next;
            }
        }
        laid
    }

    /// The likeliest shape of what was seen.
    fn step(&self, laid: &Laid, seen: &[Sight], fixed: &[(usize, Point)]) -> Option<Laid> {
        let n = self.points.len();
        let k = self.ways.ncols();
        let mut all = DMatrix::zeros(2 * n, k + 4);
        all.view_mut((0, 0), (2 * n, k)).copy_from(&self.ways);
        let mut off = DVector::zeros(2 * n);
        // What is seen, weighted: the inverse of each point's covariance on both sides.
        let mut weighted = DMatrix::zeros(2 * n, k + 4);
        let mut pulls = DVector::zeros(2 * n);
        let mut inverse = Vec::with_capacity(n);
        for (i, sight) in seen.iter().enumerate().take(n) {
            let rest = self.points[i];
            let (x, y) = (2 * i, 2 * i + 1);
            all[(x, k)] = LOOSE * rest.x;
            all[(y, k)] = LOOSE * rest.y;
            all[(x, k + 1)] = -LOOSE * rest.y;
            all[(y, k + 1)] = LOOSE * rest.x;
            all[(x, k + 2)] = LOOSE;
            all[(y, k + 3)] = LOOSE;
            let hand = fixed.iter().find(|(j, _)| *j == i).map(|f| laid.place.undo(f.1));
            let to = hand.unwrap_or(laid.points[i] + sight.by);
            let [a, b, d] = if hand.is_some() { [1e-6, 0.0, 1e-6] } else { sight.doubt };
            let (a, d) = (a + FREE * FREE, d + FREE * FREE);
            let det = (a * d - b * b).max(1e-14);
            inverse.push([d / det, -b / det, a / det]);
            (off[x], off[y]) = (to.x - rest.x, to.y - rest.y);
        }
        for (i, [a, b, d]) in inverse.iter().enumerate() {
            let (x, y) = (2 * i, 2 * i + 1);
            for c in 0..k + 4 {
                let (u, v) = (all[(x, c)], all[(y, c)]);
                weighted[(x, c)] = a * u + b * v;
                weighted[(y, c)] = b * u + d * v;
            }
            pulls[x] = a * off[x] + b * off[y];
            pulls[y] = b * off[x] + d * off[y];
        }
        let mut information = all.transpose() * &weighted;
        (0..k + 4).for_each(|i| information[(i, i)] += 1.0);
        let solver = information.cholesky()?;
        let along = solver.solve(&(all.transpose() * &pulls));
        let told = &all * &along;
        let moved = &self.ways * along.rows(0, k);
        let covariance = &self.ways * solver.inverse().view((0, 0), (k, k)) * self.ways.transpose();
        let mut points = Vec::with_capacity(n);
        let mut errors = Vec::with_capacity(n);
        for (i, [a, b, d]) in inverse.iter().enumerate() {
            let (x, y) = (2 * i, 2 * i + 1);
            let left = Vec2::new(off[x] - told[x], off[y] - told[y]);
            let own = Vec2::new(a * left.x + b * left.y, b * left.x + d * left.y) * (FREE * FREE);
            points.push(self.points[i] + Vec2::new(moved[x], moved[y]) + own);
            errors.push((0.5 * (covariance[(x, x)] + covariance[(y, y)]).max(0.0) + FREE * FREE).sqrt());
        }
        let q = Similarity {
            a: 1.0 + LOOSE * along[k],
            b: LOOSE * along[k + 1],
            origin: Point::new(LOOSE * along[k + 2], LOOSE * along[k + 3]),
        };
        let like = seen.iter().map(|s| s.like).sum::<f64>() / n.max(1) as f64;
        Some(Laid { place: laid.place.after(&q), points, errors, like })
    }
}

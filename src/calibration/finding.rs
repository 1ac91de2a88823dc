//! The points of a shot of which only the neutral one is marked: where the face finder sees them, less what it is off
//! on the neutral shot, as far as a face can move so; then where the person's own look agrees.

use nalgebra::{DMatrix, DVector};

use super::moves::Moves;
use crate::face::find::{Found, find};
use crate::face::{FeaturePoint as P, How, Part};
use crate::geometry::{Point, Similarity, Vec2};
use crate::photo::Grey;

/// Named points of a shot.
#[derive(Debug, Clone)]
pub(super) struct Seen {
    /// From the frame of the neutral pupils to pixels of the shot.
    pub place: Similarity,
    /// How each named point has moved, in pupil distances, in the frame of the neutral pupils.
    pub moves: Vec<Vec2>,
    /// How far each may be off, in pupil distances.
    pub errors: Vec<f64>,
    /// How far the head is turned, in degrees.
    pub turned: f64,
}

/// What the face finder sees in the neutral shot, against the marked points.
#[derive(Debug, Clone)]
pub(super) struct Seeing {
    /// The named points as marked, in the frame of the neutral pupils.
    named: Vec<(P, Point)>,
    /// Where the finder sees them there, in the same frame.
    seen: Vec<Point>,
    /// The ways in which points move: rows x and y in turns.
    ways: DMatrix<f64>,
    yaw: f64,
}

/// What no way explains of a point's move, in pupil distances.
const FREE: f64 = 0.012;
/// How far off the least the finder is, in pupil distances, however sure it is.
const LEAST: f64 = 0.012;

impl Seeing {
    /// From the neutral shot; none where no face is found in it.
    pub(crate) fn new(neutral: &Grey, frame: &Similarity, named: &[(P, Point)], moves: &Moves) -> Option<Self> {
        let hands: Vec<(P, Point)> = Vec::new();
        let found = find(&neutral.to_photo(), &hands).ok()?;
        let seen = named.iter().map(|(p, _)| frame.undo(found.points[p.index()].at)).collect();
        Some(Self { named: named.to_vec(), seen, ways: moves.ways(), yaw: found.yaw })
    }

    /// The named points in another shot, by the finder and what faces can do. `hands` are known in pixels.
    pub(crate) fn look(&self, found: &Found, hands: &[(P, Point)]) -> Option<Seen> {
        let at: Vec<Point> = self.named.iter().map(|(p, _)| found.points[p.index()].at).collect();
        let errors: Vec<f64> = self
            .named
            .iter()
            .map(|(p, _)| {
                let placed = found.points[p.index()];
                let error = 0.06 * (1.0 / placed.confidence.max(0.02) - 1.0);
                // What is placed by rule follows others and tells little of its own.
                error.max(LEAST) * if placed.how == How::Rule { 2.0 } else { 1.0 }
            })
            .collect();
        // First by what moves least, then by all.
        let still: Vec<usize> = (0..at.len()).filter(|i| is_still(self.named[*i].0)).collect();
        let pick = |list: &[Point]| still.iter().map(|i| list[*i]).collect::<Vec<_>>();
        let mut place = Similarity::between(&pick(&self.seen), &pick(&at))?;
        let n = at.len();
        let mut moves = Vec::new();
        let mut doubts = Vec::new();
        for _ in 0..3 {
            let (rows, ways) = (2 * n, self.ways.ncols());
            let mut all = DMatrix::zeros(rows, ways + 4);
            all.view_mut((0, 0), (rows, ways)).copy_from(&self.ways);
            let mut off = DVector::zeros(rows);
            let mut noise = DVector::zeros(rows);
            for i in 0..n {
                let rest = self.named[i].1;
                let hand = hands.iter().find(|(p, _)| *p == self.named[i].0);
                let by = match hand {
                    Some((_, to)) => place.undo(*to) - rest,
                    None => place.undo(at[i]) - self.seen[i],
                };
                let error = if hand.is_some() { 0.002 } else { errors[i] };
                (off[2 * i], off[2 * i + 1]) = (by.x, by.y);
                for row in [2 * i, 2 * i + 1] {
                    noise[row] = error * error + FREE * FREE;
                }
                const LOOSE: f64 = 0.08;
                all[(2 * i, ways)] = LOOSE * rest.x;
                all[(2 * i + 1, ways)] = LOOSE * rest.y;
                all[(2 * i, ways + 1)] = -LOOSE * rest.y;
                all[(2 * i + 1, ways + 1)] = LOOSE * rest.x;
                all[(2 * i, ways + 2)] = LOOSE;
                all[(2 * i + 1, ways + 3)] = LOOSE;
            }
            let covariance = &all * all.transpose();
            let mut sum = covariance.clone();
            (0..rows).for_each(|i| sum[(i, i)] += noise[i]);
            let solver = sum.cholesky()?;
            let solved = solver.solve(&off);
            let along = all.transpose() * &solved;
            let explained = &self.ways * along.rows(0, ways);
            // What is left may be a move that no way knows, as far as the finder is sure.
            let told = &all * &along;
            moves = (0..n)
                .map(|i| {
                    let error = noise[2 * i] - FREE * FREE;
                    let keep = FREE * FREE / (FREE * FREE + error);
                    let rest = Vec2::new(off[2 * i] - told[2 * i], off[2 * i + 1] - told[2 * i + 1]);
                    Vec2::new(explained[2 * i], explained[2 * i + 1]) + rest * keep
                })
                .collect::<Vec<Vec2>>();
            let gain = solver.solve(&covariance);
            let left = &covariance - &covariance * gain;
            doubts = (0..n)
                .map(|i| (0.5 * (left[(2 * i, 2 * i)] + left[(2 * i + 1, 2 * i + 1)]).max(0.0) + FREE * FREE).sqrt())
                .collect();
            // The similarity that was found beside the ways goes to the place.
            let l = 0.08;
            let q = Similarity {
                a: 1.0 + l * along[ways],
                b: l * along[ways + 1],
                origin: Point::new(l * along[ways + 2], l * along[ways + 3]),
            };
            place = place.after(&q);
        }
        Some(Seen { place, moves, errors: doubts, turned: found.yaw - self.yaw })
    }
}

/// Points that expressions move least.
fn is_still(p: P) -> bool {
    matches!(p.part(), Part::Nose) || [P::P3_12, P::P3_8, P::P3_11, P::P3_7, P::P11_2, P::P11_3].contains(&p)
}

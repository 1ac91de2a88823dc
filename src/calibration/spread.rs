//! What named points do, spread over the points of a model that are not all named.

use nalgebra::{DMatrix, DVector};

use crate::calibration::Binding;
use crate::face::FeaturePoint as P;
use crate::geometry::{Point, Vec2};

/// How far each point of a model follows each named point.
#[derive(Debug, Clone)]
pub(crate) struct Spread {
    /// A row a point of the model, a column a named point; rows sum to 1.
    weights: DMatrix<f64>,
}

/// How near, in pupil distances, moves of named points are followed: less than that apart they are averaged.
const SOFT: f64 = 0.02;

impl Spread {
    /// From a binding, the points of the model and the named ones of the same face, in one frame of pupil distance 1.
    pub(crate) fn new(binding: &Binding, points: &[Point], named: &[(P, Point)]) -> Self {
        let n = named.len();
        let mut weights = DMatrix::zeros(points.len(), n);
        let fixed: Vec<Option<usize>> = (0..points.len())
            .map(|i| {
                let own = binding.rows().iter().find(|(_, sum)| matches!(sum[..], [(k, _)] if k == i))?.0;
                named.iter().position(|(p, _)| *p == own)
            })
            .collect();
        let lips = Lips::of(named);
        for (i, at) in points.iter().enumerate() {
            if let Some(k) = fixed[i] {
                weights[(i, k)] = 1.0;
                continue;
            }
            // Where lips meet, a point goes with its own lip.
            let left_out = lips.as_ref().map_or(&[][..], |l| l.other_lip(*at));
            let with: Vec<usize> = (0..n).filter(|k| !left_out.contains(&named[*k].0)).collect();
            let places: Vec<Point> = with.iter().map(|k| named[*k].1).collect();
            for (k, w) in with.iter().zip(followed(&places, *at)) {
                weights[(i, *k)] = w;
            }
        }
        Self { weights }
    }

    /// The moves of the model's points for those of the named ones.
    pub(crate) fn over(&self, moves: &[Vec2]) -> Vec<Vec2> {
        let along = |f: fn(&Vec2) -> f64| &self.weights * DVector::from_iterator(moves.len(), moves.iter().map(f));
        let (x, y) = (along(|v| v.x), along(|v| v.y));
        x.iter().zip(y.iter()).map(|(x, y)| Vec2::new(*x, *y)).collect()
    }
}

/// How far a place follows each of some places: interpolation by the distance itself, which neither overshoots nor
/// bends more than it must, with a constant so that what moves as one does so everywhere.
fn followed(places: &[Point], at: Point) -> Vec<f64> {
    let n = places.len();
    let far = |a: Point, b: Point| -(a.distance_squared(b) + SOFT * SOFT).sqrt();
    let matrix = DMatrix::from_fn(n + 1, n + 1, |r, c| match (r == n, c == n) {
        (true, true) => 0.0,
        (true, false) | (false, true) => 1.0,
        (false, false) if r == c => -SOFT - 0.5 * SOFT,
        (false, false) => far(places[r], places[c]),
    });
    let right = DVector::from_fn(n + 1, |r, _| if r == n { 1.0 } else { far(places[r], at) });
    match matrix.lu().solve(&right) {
        Some(weights) => weights.iter().take(n).copied().collect(),
        None => vec![1.0 / n.max(1) as f64; n],
    }
}

/// Where the lips are and meet.
struct Lips {
    corners: [Point; 2],
    top: f64,
    meet: f64,
    bottom: f64,
}

impl Lips {
    fn of(named: &[(P, Point)]) -> Option<Self> {
        let at = |p: P| named.iter().find(|(n, _)| *n == p).map(|n| n.1);
        Some(Self {
            corners: [at(P::P8_4)?, at(P::P8_3)?],
            top: at(P::P8_1)?.y,
            meet: at(P::P2_2)?.midpoint(at(P::P2_3)?).y,
            bottom: at(P::P8_2)?.y,
        })
    }

    /// The named points of the lip that a place is not on; none where it is on neither.
    fn other_lip(&self, at: Point) -> &'static [P] {
        let [left, right] = self.corners;
        let share = (at.x - left.x) / (right.x - left.x);
        if !(0.06..0.94).contains(&share) {
            return &[];
        }
        // The line where they meet: a parabola through the corners and the middle.
        let level = left.y + (right.y - left.y) * share;
        let middle = left.y.midpoint(right.y);
        let line = level + (self.meet - middle) * 4.0 * share * (1.0 - share);
        let room = 0.5 * (self.bottom - self.top);
        if at.y <= line && at.y > self.top - room {
            &[P::P2_3, P::P8_2, P::P2_1]
        } else if at.y > line && at.y < self.bottom + 0.5 * room {
            &[P::P2_2, P::P8_1, P::P8_9, P::P8_10]
        } else {
            &[]
        }
    }
}

//! How the named feature points hang on the points of a model, whatever annotation it was trained on.

use crate::aam::triangles;
use crate::face::{FeaturePoint, Part};
use crate::geometry::Point;

/// Which sums of a model's points the named feature points are. A model of our own points has each of them; for others
/// a named point lies in a triangle of theirs, or is known by a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Binding {
    /// How many points the model has.
    count: usize,
    /// A named point and the points it is a sum of, each with its share; shares of one sum to 1.
    rows: Vec<(FeaturePoint, Vec<(usize, f64)>)>,
}

/// Nearer than this to a model's point, in pupil distances, a named point is that point.
const SAME: f64 = 0.02;

impl Binding {
    /// The feature points that a model of our own has: all that every face has but its ears, which hair may hide.
    pub fn own_points() -> impl Iterator<Item = FeaturePoint> {
        FeaturePoint::fixed().filter(|p| p.part() != Part::Ears)
    }

    /// The binding of a model of our own points.
    #[must_use]
    pub fn own() -> Self {
        let rows: Vec<_> = Self::own_points().enumerate().map(|(i, p)| (p, vec![(i, 1.0)])).collect();
        Self { count: rows.len(), rows }
    }

    /// A binding by shares that are known.
    #[must_use]
    pub fn of_rows(count: usize, rows: Vec<(FeaturePoint, Vec<(usize, f64)>)>) -> Self {
        Self { count, rows }
    }

    /// The binding of somebody else's points, from one picture that has both: `points` of the model and the named ones
    /// of the same face, all in pixels, `pupils` apart. A named point near one of the model's is that one; else it
    /// hangs in the triangle it lies in, or nearest to.
    #[must_use]
    pub fn by_place(points: &[Point], named: &[(FeaturePoint, Point)], pupils: f64) -> Self {
        let mesh = triangles(points);
        let row = |&(name, at): &(FeaturePoint, Point)| {
            let near = (0..points.len()).min_by(|a, b| points[*a].distance(at).total_cmp(&points[*b].distance(at)))?;
            if points[near].distance(at) < SAME * pupils {
                return Some((name, vec![(near, 1.0)]));
            }
            let shares = |t: &[usize; 3]| shares_in(at, t.map(|i| points[i]));
            let outside = |s: &[f64; 3]| s.iter().map(|v| (-v).max(0.0)).sum::<f64>();
            let best = mesh
                .iter()
                .filter_map(|t| shares(t).map(|s| (t, s)))
                .min_by(|a, b| outside(&a.1).total_cmp(&outside(&b.1)))?;
            Some((name, best.0.iter().copied().zip(best.1).collect()))
        };
        Self { count: points.len(), rows: named.iter().filter_map(row).collect() }
    }

    /// How many points the model has.
    #[must_use]
    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// The sums, point by point.
    #[must_use]
    pub fn rows(&self) -> &[(FeaturePoint, Vec<(usize, f64)>)] {
        &self.rows
    }

    /// Where a named point is on a shape of the model; none where the model does not tell, or the shape is another's.
    #[must_use]
    pub fn at(&self, shape: &[Point], name: FeaturePoint) -> Option<Point> {
        if shape.len() != self.count {
            return None;
        }
        let (_, sum) = self.rows.iter().find(|(p, _)| *p == name)?;
        Some(sum.iter().fold(Point::ORIGIN, |s, (i, share)| s + shape[*i].to_vec2() * *share))
    }
}

/// The shares of a triangle's corners in a point; none of a triangle without extent.
fn shares_in(p: Point, [a, b, c]: [Point; 3]) -> Option<[f64; 3]> {
    let whole = (b - a).cross(c - a);
    if whole.abs() < 1e-9 {
        return None;
    }
    let (v, w) = ((p - a).cross(c - a) / whole, (b - a).cross(p - a) / whole);
    Some([1.0 - v - w, v, w])
}

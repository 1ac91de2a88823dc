//! From the 47 points that [`face::find`](crate::face::find) sees to where a fit begins: how this model's points lie
//! about those, learned from the training pictures in which it finds the face.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::shape::Shapes;
use crate::face::find::{Found, find};
use crate::face::{FeaturePoint as P, Placed};
use crate::geometry::{Point, Similarity};
use crate::photo::Grey;

/// How a pose and a place along the modes follow from detected points. Rows: the four numbers of the pose in the frame of
/// the pupils, then the modes; columns: a constant, then all x and all y of the points in that frame, about their mean.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Detected {
    /// The mean of the points, x and y in turns.
    pub mean: Vec<f32>,
    /// Row by row.
    pub rows: Vec<f32>,
}

/// How much the points' differences are doubted, as a variance in squared pupil distances for each: the detector is
/// that much off.
const DOUBT: f64 = 0.02 * 0.02;

impl Detected {
    /// Learns from pictures with their points; none where no face is found in any of them.
    pub(crate) fn learned(shapes: &Shapes, shots: &[(&Grey, &[Point])]) -> Option<Self> {
        let one = |(grey, points): &(&Grey, &[Point])| {
            let found = find(&grey.to_photo(), &[]).ok()?;
            let (frame, places) = framed(&found)?;
            let (q, along) = shapes.describe(&points.iter().map(|p| frame.undo(*p)).collect::<Vec<_>>())?;
            // A face that was found elsewhere than where it is marked teaches nothing.
            if !(0.8..4.0).contains(&q.scale()) || q.origin.to_vec2().hypot() > 1.5 {
                return None;
            }
            let mut target = vec![q.a, q.b, q.origin.x, q.origin.y];
            target.extend(along);
            Some((places, target))
        };
        // Side by side, and in the order of the pictures whoever is done first.
        let seen: Vec<_> = shots.par_iter().map(one).collect::<Vec<_>>().into_iter().flatten().collect();
        let n = seen.len();
        let columns = seen.first()?.0.len();
        let targets = seen.first()?.1.len();
        let mean: Vec<f64> = (0..columns).map(|i| seen.iter().map(|s| s.0[i]).sum::<f64>() / n as f64).collect();
        let base: Vec<f64> = (0..targets).map(|i| seen.iter().map(|s| s.1[i]).sum::<f64>() / n as f64).collect();
        let x = DMatrix::from_fn(n, columns, |r, c| seen[r].0[c] - mean[c]);
        let mut products = &x * x.transpose();
        for i in 0..n {
            products[(i, i)] += DOUBT * n as f64;
        }
        let solver = products.cholesky()?;
        let mut rows = Vec::with_capacity(targets * (columns + 1));
        for (t, base) in base.iter().enumerate() {
            let y = DVector::from_fn(n, |r, _| seen[r].1[t] - base);
            let weights = x.transpose() * solver.solve(&y);
            rows.push(*base as f32);
            rows.extend(weights.iter().map(|w| *w as f32));
        }
        Some(Self { mean: mean.iter().map(|v| *v as f32).collect(), rows })
    }

    /// The shape that a detection stands for; none where its pupils coincide.
    pub(crate) fn start(&self, shapes: &Shapes, found: &Found) -> Option<Vec<Point>> {
        let (frame, places) = framed(found)?;
        let columns = self.mean.len();
        if places.len() != columns {
            return None;
        }
        let told: Vec<f64> = self
            .rows
            .chunks_exact(columns + 1)
            .map(|row| {
                let rest = row[1..].iter().zip(&places).zip(&self.mean);
                f64::from(row[0]) + rest.map(|((w, v), m)| f64::from(*w) * (v - f64::from(*m))).sum::<f64>()
            })
            .collect();
        let [a, b, x, y, along @ ..] = &told[..] else { return None };
        let q = Similarity { a: *a, b: *b, origin: Point::new(*x, *y) };
        Some(shapes.shape(along).iter().map(|p| frame.apply(q.apply(*p))).collect())
    }
}

/// How many numbers a detection has.
pub(super) const NUMBERS: usize = 2 * P::FIXED;

/// The frame of the detected pupils, whose distance is 1 in it, and the points in that frame.
fn framed(found: &Found) -> Option<(Similarity, Vec<f64>)> {
    let at = |p: P| found.points[p.index()].at;
    let (left, right) = (at(P::P3_6), at(P::P3_5));
    let across = right - left;
    if across.hypot() < 1.0 {
        return None;
    }
    let frame = Similarity::spanning(left, right);
    let numbers = found.points.iter().flat_map(|Placed { at, .. }| {
        let p = frame.undo(*at);
        [p.x, p.y]
    });
    Some((frame, numbers.collect()))
}

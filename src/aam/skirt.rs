//! Points round the marked ones, so that a model sees its face's border from both sides. A jaw is an edge between the face
//! and what lies behind it; of a mesh that ends there nothing pulls.

use crate::geometry::{Point, Vec2};

/// The points of a mean shape that lie on its border, as their numbers (Andrew's monotone chain).
pub(super) fn border(mean: &[Point]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..mean.len()).collect();
    order.sort_by(|a, b| {
        (mean[*a].x, mean[*a].y).partial_cmp(&(mean[*b].x, mean[*b].y)).unwrap_or(std::cmp::Ordering::Equal)
    });
    let half = |order: &mut dyn Iterator<Item = usize>| {
        let mut chain: Vec<usize> = Vec::new();
        for i in order {
            while let [.., a, b] = chain[..] {
                if (mean[b] - mean[a]).cross(mean[i] - mean[b]) > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(i);
        }
        chain.pop();
        chain
    };
    let mut all = half(&mut order.iter().copied());
    all.extend(half(&mut order.iter().rev().copied()));
    all
}

/// A shape with a point outside each of its border: as much farther from the shape's middle as `by` says. That is linear in
/// the shape, so that whatever a model learns of the border holds for them.
pub(super) fn skirted(points: &[Point], border: &[usize], by: f64) -> Vec<Point> {
    let middle = (points.iter().fold(Vec2::ZERO, |s, p| s + p.to_vec2()) / points.len().max(1) as f64).to_point();
    let outer = border.iter().filter_map(|i| points.get(*i)).map(|p| *p + (*p - middle) * by);
    points.iter().copied().chain(outer).collect()
}

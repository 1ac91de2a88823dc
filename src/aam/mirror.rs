//! Mirror images: what is learned from a face holds for its mirror image, once it is known which point is whose twin.

use super::align::align;
use crate::geometry::{Point, Similarity};
use crate::photo::Grey;

/// A point and its twin lie this near when one is mirrored, in widths of the mean shape.
const NEAR: f64 = 0.08;

/// The mirror images of pictures and their points; none where the points are not those of something symmetric.
pub(super) fn mirrored(shots: &[(&Grey, &[Point])]) -> Vec<(Grey, Vec<Point>)> {
    let marked: Vec<Vec<Point>> = shots.iter().map(|(_, s)| s.to_vec()).collect();
    let Some(twins) = align(&marked).and_then(|a| twins(&a.mean)) else { return Vec::new() };
    let mirror = |(grey, points): &(&Grey, &[Point])| {
        let (width, height) = (grey.width(), grey.height());
        let pixels = grey.pixels().chunks_exact(width).flat_map(|row| row.iter().rev().copied()).collect();
        let right = width as f64 - 1.0;
        let points = twins.iter().map(|t| Point::new(right - points[*t].x, points[*t].y)).collect();
        (Grey::new(width, height, pixels), points)
    };
    shots.iter().map(mirror).collect()
}

/// Of each point the one that it becomes in a mirror; none where some have no partner.
fn twins(mean: &[Point]) -> Option<Vec<usize>> {
    let n = mean.len();
    let flipped: Vec<Point> = mean.iter().map(|p| Point::new(-p.x, p.y)).collect();
    let width = {
        let (low, high) = mean.iter().fold((f64::MAX, f64::MIN), |(l, h), p| (l.min(p.x), h.max(p.x)));
        high - low
    };
    // Partners by nearness, then the pose anew from the partners: the axis need not be upright at first.
    let mut laid = flipped.clone();
    let mut partner = Vec::new();
    for _ in 0..8 {
        partner = matched(&laid, mean);
        let to: Vec<Point> = partner.iter().map(|i| mean[*i]).collect();
        let q = Similarity::between(&flipped, &to)?;
        laid = flipped.iter().map(|p| q.apply(*p)).collect();
    }
    let fine = (0..n).all(|i| laid[i].distance(mean[partner[i]]) < NEAR * width && partner[partner[i]] == i);
    fine.then_some(partner)
}

/// Pairs of points, the nearest first, each used once.
fn matched(from: &[Point], to: &[Point]) -> Vec<usize> {
    let n = from.len();
    let mut pairs: Vec<(f64, usize, usize)> =
        (0..n).flat_map(|i| (0..n).map(move |j| (i, j))).map(|(i, j)| (from[i].distance(to[j]), i, j)).collect();
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let (mut partner, mut taken) = (vec![usize::MAX; n], vec![false; n]);
    for (_, i, j) in pairs {
        if partner[i] == usize::MAX && !taken[j] {
            partner[i] = j;
            taken[j] = true;
        }
    }
    partner
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_symmetric_face_finds_its_twins_even_when_tilted_and_another_has_none() {
        let half = [(1.0, 0.0), (2.0, 1.0), (1.5, 2.5), (0.7, 3.0)].map(Point::from);
        let mut face: Vec<Point> = half.iter().flat_map(|p| [*p, Point::new(-p.x, p.y)]).collect();
        face.push(Point::new(0.0, 1.2));
        let q = Similarity { a: 1.0, b: 0.1, origin: Point::ORIGIN };
        let face: Vec<Point> = face.iter().map(|p| q.apply(*p)).collect();
        assert_eq!(twins(&face).unwrap(), [1, 0, 3, 2, 5, 4, 7, 6, 8]);
        assert!(twins(&[(0.0, 0.0), (3.0, 0.5), (1.0, 4.0), (9.0, 2.0)].map(Point::from)).is_none());
    }
}

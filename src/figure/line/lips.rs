//! Lips as strokes: their joints brought under ink, and the edges between which the mouth opens.

use crate::geometry::{BezPath, CubicBez, Knot, ParamCurve, ParamCurveNearest, PathEl, Point, Ribbon, Vec2, hermite};

/// A lip's strokes with their joints brought under ink. Every end but the two corners comes no wider than the stroke
/// it meets, so that no cap stands out, and the ends of the links between come to lie on the strokes they join. Links
/// lean on each other, so a few rounds settle them: each moves an end by less than a tenth of the one before.
pub(super) fn seated(mut lip: Vec<Ribbon>) -> Vec<Ribbon> {
    const ROUNDS: usize = 4;
    let Some(last) = lip.len().checked_sub(1).filter(|last| *last > 0) else { return lip };
    for _ in 0..ROUNDS {
        for i in 0..lip.len() {
            let forward = lip[i].0[0].x <= lip[i].0[3].x;
            for (end, handle) in [(0, 1), (3, 2)] {
                let at_left = (end == 0) == forward;
                if (i == 0 && at_left) || (i == last && !at_left) {
                    continue;
                }
                let from = lip[i].0[end];
                let Some(seat) = nearest_ink(&lip, i, from.point()) else { continue };
                let knots = &mut lip[i].0;
                knots[end].w = from.w.min(seat.w);
                if i != 0 && i != last {
                    (knots[end].x, knots[end].y) = (seat.x, seat.y);
                    knots[handle].x += seat.x - from.x;
                    knots[handle].y += seat.y - from.y;
                    knots[handle].w = knots[handle].w.min(seat.w);
                }
            }
        }
    }
    lip
}

/// The nearest place on the centre lines of a lip's strokes other than the one numbered `but`.
fn nearest_ink(lip: &[Ribbon], but: usize, to: Point) -> Option<Knot> {
    let others = lip.iter().enumerate().filter(|(i, _)| *i != but);
    others
        .map(|(_, other)| {
            let near = other.centre().nearest(to, 1e-3);
            (near.distance_sq, other.eval(near.t))
        })
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, knot)| knot)
}

/// A lip's centre line from left to right: its outermost two strokes, bridged in the middle where they stop short of
/// each other. Links between lie under the same ink and add nothing to the edge.
pub(super) fn edge(lip: &[Ribbon]) -> Vec<CubicBez> {
    let onward = |r: &Ribbon| {
        let c = r.centre();
        if c.p0.x <= c.p3.x { c } else { CubicBez::new(c.p3, c.p2, c.p1, c.p0) }
    };
    let (Some(first), Some(last)) = (lip.first().map(onward), lip.last().map(onward)) else { return Vec::new() };
    if lip.len() == 1 {
        return vec![first];
    }
    let gap = last.p0 - first.p3;
    if gap.hypot() < 1e-6 {
        return vec![first, last];
    }
    let along = |v: Vec2| v.normalize() * gap.hypot();
    let bridge = hermite(first.p3, along(first.p3 - first.p2), last.p0, along(last.p1 - last.p0));
    vec![first, bridge, last]
}

pub(super) fn mid_x(curves: &[CubicBez]) -> f64 {
    match (curves.first(), curves.last()) {
        (Some(a), Some(b)) => f64::midpoint(a.p0.x, b.p3.x),
        _ => 0.0,
    }
}

/// The height at which a chain of curves crosses `x`.
pub(super) fn crossing(curves: &[CubicBez], x: f64) -> Option<f64> {
    let curve = curves.iter().find(|c| c.p0.x <= x && x <= c.p3.x)?;
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..30 {
        let t = f64::midpoint(low, high);
        if curve.eval(t).x < x { low = t } else { high = t }
    }
    Some(curve.eval(low).y)
}

pub(super) fn closed_between(top: &[CubicBez], bottom: &[CubicBez]) -> BezPath {
    let mut path = BezPath::new();
    if let Some(first) = top.first() {
        path.push(PathEl::MoveTo(first.p0));
    }
    for c in top {
        path.push(PathEl::CurveTo(c.p1, c.p2, c.p3));
    }
    for c in bottom.iter().rev() {
        path.push(PathEl::LineTo(c.p3));
        path.push(PathEl::CurveTo(c.p2, c.p1, c.p0));
    }
    path.close_path();
    path
}

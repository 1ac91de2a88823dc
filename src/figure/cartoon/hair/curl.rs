//! Curly hair: an outline of scallops, and small open rings within.

use super::outline::Contour;
use crate::drawing::Item;
use crate::figure::cartoon::Pen;
use crate::figure::cartoon::dice::Dice;
use crate::geometry::{BezPath, CubicBez, ParamCurve, PathEl, Point, Vec2, brush_in_steps, equal_steps};

/// How far a scallop stands out, in shares of its length.
const BULGE: f64 = 0.40;

/// A closed line as arcs that stand outward, about `size` long and uneven.
pub(super) fn scallops(line: &[Point], size: f64) -> Contour {
    let mut dice = Dice(size as u64);
    let n = line.len();
    let length: f64 = (0..n).map(|i| line[i].distance(line[(i + 1) % n])).sum();
    let even = equal_steps(line, (length as usize).max(60), true);
    let even = smoothed(&even, 4);
    let area: f64 = (0..even.len()).map(|i| even[i].to_vec2().cross(even[(i + 1) % even.len()].to_vec2())).sum();
    let mut ends = Vec::new();
    let mut i = 0;
    while (i as f64) < even.len() as f64 - 0.6 * size {
        ends.push(even[i]);
        i += ((size * dice.between(0.65, 1.35)) as usize).max(1);
    }
    let (mut path, mut points) = (BezPath::new(), Vec::new());
    let Some(first) = ends.first() else { return Contour { path, line: points } };
    path.push(PathEl::MoveTo(*first));
    for (k, a) in ends.iter().enumerate() {
        let b = ends[(k + 1) % ends.len()];
        let along = b - *a;
        let out = Vec2::new(along.y, -along.x) * (area.signum() * BULGE);
        let (p, q) = (*a + out * 1.15 - along * 0.08, b + out + along * 0.02);
        path.push(PathEl::CurveTo(p, q, b));
        let arc = CubicBez::new(*a, p, q, b);
        points.extend((0..7).map(|s| arc.eval(f64::from(s) / 7.0)));
    }
    path.push(PathEl::ClosePath);
    Contour { path, line: points }
}

/// Each point of a closed line moved toward its neighbours, `times` times.
fn smoothed(line: &[Point], times: usize) -> Vec<Point> {
    let n = line.len();
    let mut now = line.to_vec();
    for _ in 0..times {
        let before = now.clone();
        for i in 0..n {
            let sum = before[(i + n - 1) % n].to_vec2() + before[i].to_vec2() * 2.0 + before[(i + 1) % n].to_vec2();
            now[i] = (sum / 4.0).to_point();
        }
    }
    now
}

/// Open rings where there is hair, lighter toward the upper left.
pub(super) fn curls(pen: &Pen, outlines: &[&[Point]], centre: Point, amount: f64) -> Vec<Item> {
    const ACROSS: f64 = 15.0;
    const DOWN: f64 = 12.0;
    let mut dice = Dice(7);
    let (mut dark, mut light) = (BezPath::new(), BezPath::new());
    let all = || outlines.iter().flat_map(|o| o.iter());
    let reach = |f: fn(&Point) -> f64| (all().map(f).fold(f64::MAX, f64::min), all().map(f).fold(f64::MIN, f64::max));
    let ((left, right), (top, bottom)) = (reach(|p| p.x), reach(|p| p.y));
    let (rows, columns) = (((bottom - top) / DOWN).max(0.0) as u32, ((right - left) / ACROSS).max(0.0) as u32);
    for row in 0..=rows.min(60) {
        for column in 0..=columns.min(60) {
            let p = Point::new(
                left + ACROSS * f64::from(column) + dice.between(-4.0, 4.0),
                top + DOWN * f64::from(row) + dice.between(-4.0, 4.0),
            );
            let [skip, turn, size, lit] = std::array::from_fn(|_| dice.unit());
            if skip > 0.75 * amount || !inside(outlines, p) {
                continue;
            }
            let towards = (p.y - centre.y).atan2(p.x - centre.x) + 1.4 * (turn - 0.5);
            let radius = 4.5 + 3.5 * size;
            let ring: [Point; 5] =
                std::array::from_fn(|i| p + Vec2::from_angle(towards - 1.3 + 0.65 * i as f64) * radius);
            let lighter = !pen.ink_only && p.x < 10.0 && p.y < -60.0 && lit < 0.55;
            let (path, width) = if lighter { (&mut light, 1.9) } else { (&mut dark, 1.15) };
            path.extend(brush_in_steps(&ring, width * pen.ink, &[0.0, 1.0, 0.8, 0.0], 5));
        }
    }
    let colours = &pen.palette;
    // On dark hair strands are lighter than it, which curls that overlap cannot be.
    let ink = if colours.strand == colours.hair_light { colours.hair_ink } else { colours.strand };
    let ink = if pen.ink_only { colours.hair_ink } else { ink.over(colours.hair, 0.85) };
    let mut items = vec![Item::area("hair-curls", dark, ink)];
    if !pen.ink_only {
        items.push(Item::area("hair-light", light, colours.hair_light.over(colours.hair, 0.85)));
    }
    items
}

/// Whether a point has hair: it is inside an odd number of outlines, holes among them.
fn inside(outlines: &[&[Point]], p: Point) -> bool {
    let crosses = |o: &[Point]| {
        let n = o.len();
        (0..n)
            .filter(|i| {
                let (a, b) = (o[*i], o[(i + 1) % n]);
                (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
            })
            .count()
    };
    outlines.iter().map(|o| crosses(o)).sum::<usize>() % 2 == 1
}

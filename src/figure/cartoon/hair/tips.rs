//! What a mask of hair does not show: where a photo's edge has cut it off, and the tips that hair ends in.

use super::super::at;
use crate::figure::cartoon::dice::Dice;
use crate::geometry::{Point, Vec2};

/// A level edge on top that is as long as this is a cut of the photo's, in face units; hair curves more.
const CUT: f64 = 60.0;
/// How far a cut is domed, in shares of its length, and at most.
const DOME: (f64, f64) = (0.24, 46.0);
/// One tip for so much of a lower end.
const TIP: f64 = 19.0;
/// A lower end turns up at both its sides by at least this much.
const RISE: f64 = 7.0;
/// The cosine of the angle of a corner: 118° and less.
const BLUNT: f64 = -0.47;
/// Nearer to the middle than this is the neck.
const NECK: f64 = 48.0;
/// Lower ends as wide as this are none: hair that goes round the head.
const WIDEST: f64 = 95.0;

/// The vertices of a closed outline with a dome over a top that the photo's edge has cut.
pub(super) fn domed(vertices: &[Point]) -> Vec<Point> {
    let n = vertices.len();
    let top = vertices.iter().map(|p| p.y).fold(f64::MAX, f64::min);
    let mut out = Vec::with_capacity(n + 8);
    for (i, a) in vertices.iter().enumerate() {
        let b = vertices[(i + 1) % n];
        out.push(*a);
        let along = b - *a;
        if along.x.abs() > CUT && along.y.abs() < 0.04 * along.x.abs() && a.y.min(b.y) < top + 3.0 {
            let high = (DOME.0 * along.x.abs()).min(DOME.1);
            out.extend(
                [(0.18, 0.62), (0.38, 0.95), (0.62, 1.0), (0.84, 0.60)]
                    .map(|(t, h)| *a + along * t - Vec2::new(0.0, h * high)),
            );
        }
    }
    out
}

/// The vertices of a closed outline whose lower ends beside the face, which a mask leaves blunt, end in tips. An
/// outline `behind` the head goes on behind the neck, where nothing of it can be seen.
pub(super) fn tipped(vertices: &[Point], brows: f64, behind: bool) -> Vec<Point> {
    let n = vertices.len();
    if n < 5 {
        return vertices.to_vec();
    }
    let turn: f64 = (0..n).map(|i| vertices[i].to_vec2().cross(vertices[(i + 1) % n].to_vec2())).sum::<f64>().signum();
    // Edges that face down.
    let down: Vec<bool> = (0..n)
        .map(|i| {
            let along = vertices[(i + 1) % n] - vertices[i];
            let hidden = behind && vertices[i].x.midpoint(vertices[(i + 1) % n].x).abs() < NECK;
            !hidden
                && -along.x * turn > 0.62 * along.hypot()
                && vertices[i].y.min(vertices[(i + 1) % n].y) > brows + 25.0
        })
        .collect();
    let Some(start) = (0..n).find(|i| !down[*i]) else { return vertices.to_vec() };
    let mut out = Vec::with_capacity(n + 24);
    let mut dice = Dice(11);
    let mut i = 0;
    while i < n {
        let here = (start + i) % n;
        out.push(vertices[here]);
        let run = (1..n - i).take_while(|k| down[(here + k) % n]).count();
        let edge = (here + 1) % n;
        if !down[edge] || run == 0 {
            i += 1;
            continue;
        }
        // The run goes from vertex `edge` over `run` edges.
        let line: Vec<Point> = (0..=run).map(|k| vertices[(edge + k) % n]).collect();
        let (before, after) = (vertices[here], vertices[(edge + run + 1) % n]);
        let (first, last) = (line[0], line[line.len() - 1]);
        let length: f64 = line.windows(2).map(|w| w[0].distance(w[1])).sum();
        let rise = RISE.min(length);
        let rises = [before.y <= first.y - rise, after.y <= last.y - rise];
        let ends = rises == [true; 2] || (behind && rises.contains(&true));
        // An end that was cut has a corner; one that is round is so by itself.
        let corner = |a: Point, b: Point, c: Point| {
            let (u, v) = (a - b, c - b);
            u.dot(v) > BLUNT * u.hypot() * v.hypot()
        };
        let cut = corner(before, first, line[1]) || corner(line[line.len() - 2], last, after);
        if !(5.0..=WIDEST).contains(&length) || !ends || !cut {
            i += 1;
            continue;
        }
        tips(&mut out, &line, length, &mut dice);
        i += run + 2;
    }
    out
}

/// Replaces a lower end by tips: tufts that lean outward, so that they do not look like a saw.
fn tips(out: &mut Vec<Point>, line: &[Point], length: f64, dice: &mut Dice) {
    let count = ((length / TIP).round() as usize).clamp(1, 5);
    let (first, last) = (line[0], line[line.len() - 1]);
    let outward = (if first.x.abs() > last.x.abs() { first } else { last }).x.signum();
    let steps = crate::geometry::equal_steps(line, 2 * count + 1, false);
    if count == 1 {
        let outer = if first.x.abs() > last.x.abs() { first } else { last };
        let tip = steps[1].lerp(outer, 0.5) + Vec2::new(0.0, (0.5 * length).min(7.0));
        out.extend([first.lerp(tip, 0.08), tip, last.lerp(tip, 0.08)]);
        return;
    }
    let spacing = length / count as f64;
    for (k, p) in steps.iter().enumerate() {
        if k == 0 || k == 2 * count {
            out.push(*p - Vec2::new(0.0, 3.0));
        } else if k % 2 == 1 {
            out.push(at(p.x + outward * spacing * dice.between(0.15, 0.30), p.y + dice.between(2.5, 5.0)));
        } else {
            out.push(at(p.x - outward * spacing * dice.between(0.0, 0.12), p.y - spacing * dice.between(0.22, 0.40)));
        }
    }
}

//! Strands of straight and wavy hair: along its form, or where it falls over the forehead along the rays.

use super::between;
use super::rays::Rays;
use crate::drawing::{Colour, Item};
use crate::figure::cartoon::Pen;
use crate::figure::cartoon::dice::Dice;
use crate::geometry::{BezPath, Point, Vec2, brush_in_steps, equal_steps, flattened, spline};

/// Hair that is thicker than this over the brows is a fringe, where it is so on more than a few rays.
const FRINGE: f64 = 72.0;
const FRINGE_RAYS: usize = 8;

/// Single strands and lights. `amount` is 0 for none to 1 for all.
pub(super) fn strands(pen: &Pen, rays: &Rays, wavy: bool, amount: f64) -> Vec<Item> {
    let over_brow = (Rays::toward(45.0)..Rays::toward(140.0)).filter(|i| rays.depth(*i) > FRINGE);
    let fringe: Vec<usize> = over_brow.collect();
    if fringe.len() > FRINGE_RAYS { falling(pen, rays, &fringe, wavy, amount) } else { combed(pen, rays, wavy, amount) }
}

/// Hair away from the face: strands that keep their level between hairline and silhouette, at uneven distances, since
/// even ones look like a pleated curtain.
fn combed(pen: &Pen, rays: &Rays, wavy: bool, amount: f64) -> Vec<Item> {
    let (crown, last) = (Rays::CROWN, rays.runs.len());
    let mut dice = Dice(5);
    let (mut thin, mut light) = (Brushes::new(rays, pen.ink), Brushes::new(rays, 4.0));
    (thin.wavy, light.wavy) = (wavy, wavy);
    for side in [crown..last - 2, 2..crown] {
        let left = side.start == crown;
        let mut level = 0.10;
        while level < 0.93 {
            let z: [f64; 5] = std::array::from_fn(|_| dice.unit());
            let (from, to) = reach(&side, left, z[0], z[1]);
            let drift = 0.16 * (z[2] - 0.4);
            if z[4] <= amount {
                thin.width = pen.ink * (0.65 + 0.5 * z[3]);
                thin.along((level, (level + drift).clamp(0.04, 0.95)), from..to, &[0.0, 1.0, 0.6, 0.0]);
            }
            level += 0.07 + 0.10 * z[3];
        }
        if pen.ink_only {
            continue;
        }
        // The light is at the upper left: more of it, and wider, there.
        let lights: &[(f64, f64, f64, f64)] = if left {
            &[(0.74, 0.10, 0.44, 4.0), (0.66, 0.06, 0.50, 6.5), (0.57, 0.12, 0.42, 3.5), (0.47, 0.16, 0.36, 2.5)]
        } else {
            &[(0.68, 0.05, 0.30, 4.5), (0.58, 0.08, 0.24, 3.0)]
        };
        for (level, from, to, width) in lights {
            light.width = *width;
            let (a, b) = reach(&side, left, *from, 1.0 - *to);
            light.along((*level, level + 0.03), a..b, &[0.0, 1.0, 0.8, 0.0]);
        }
    }
    let mut items = Vec::new();
    if !pen.ink_only {
        items.push(light.item("hair-light", pen.palette.hair_light.over(pen.palette.hair, 0.75)));
    }
    items.push(thin.item("hair-strands", strand_colour(pen)));
    items
}

/// A part of a side of the head: it starts `skip` of the way from the crown and stops `short` of its end.
fn reach(side: &std::ops::Range<usize>, left: bool, skip: f64, short: f64) -> (usize, usize) {
    let length = side.len() as f64;
    let (skip, short) = ((0.5 * skip * length) as usize, (0.55 * short * length) as usize);
    if left { (side.start + skip, side.end - short) } else { (side.start + short, side.end - skip) }
}

/// Strands that have come loose over the crown: they leave the outline a little and come back to it.
pub(super) fn loose(pen: &Pen, rays: &Rays, amount: f64) -> Item {
    const COUNT: usize = 6;
    let mut dice = Dice(13);
    let mut all = Brushes::new(rays, 0.75 * pen.ink);
    for k in 0..COUNT {
        let z: [f64; 3] = std::array::from_fn(|_| dice.unit());
        // From the right temple over the crown to the left one, one in each sixth.
        let from = Rays::toward(28.0) + 5 * k + (4.0 * z[0]) as usize;
        let run = from..from + 5 + (4.0 * z[1]) as usize;
        let out = 1.02 + 0.022 * z[2];
        let depth = run.clone().map(|i| rays.depth(i)).fold(f64::MAX, f64::min);
        if z[2] > amount || depth < 12.0 {
            continue;
        }
        // In shares of the hair's depth, so thin hair and thick hair alike stand off by a few units.
        let off = (out - 1.0) * 150.0 / depth;
        let levels = if k % 2 == 0 { (1.0 - 0.5 * off, 1.0 + off) } else { (1.0 + off, 1.0 - 0.5 * off) };
        all.along(levels, run, &[0.2, 1.0, 0.8, 0.0]);
    }
    all.item("hair-loose", pen.palette.hair_ink)
}

/// Hair over the forehead: strands from the crown to the fringe, uneven as cut hair is.
fn falling(pen: &Pen, rays: &Rays, fringe: &[usize], wavy: bool, amount: f64) -> Vec<Item> {
    const THIN: [f64; 4] = [0.0, 1.0, 0.7, 0.0];
    let (crown, last) = (Rays::CROWN, rays.runs.len());
    let mut dice = Dice(7);
    let (mut thin, mut light) = (Brushes::new(rays, pen.ink), Brushes::new(rays, pen.ink));
    for i in &fringe[1..fringe.len() - 1] {
        let aside = (1.0 + 3.0 * dice.unit()).floor();
        let to = (*i as f64 + aside * (*i as f64 - crown as f64).signum()).clamp(0.0, last as f64 - 1.0) as usize;
        let z: [f64; 5] = std::array::from_fn(|_| dice.unit());
        if z[4] > amount {
            continue;
        }
        if z[0] < 0.62 {
            thin.width = pen.ink * (1.0 + 0.7 * z[3]);
            let low = 0.02 + if z[3] < 0.5 { 0.25 * z[2] } else { 0.0 };
            thin.across(*i, to, (0.92 - 0.22 * z[1], low), wavy, &THIN);
        } else {
            light.width = 3.2 + 2.5 * z[3];
            light.across(*i, to, (0.84 - 0.2 * z[1], 0.18 + 0.2 * z[2]), wavy, &[0.0, 0.6, 1.0, 0.0]);
        }
    }
    thin.width = pen.ink;
    for (levels, run) in [
        ((0.35, 0.50), crown + 13..last - 3),
        ((0.35, 0.50), 3..crown - 13),
        ((0.72, 0.66), crown + 11..last - 5),
        ((0.72, 0.66), 4..crown - 11),
    ] {
        thin.along(levels, run, &THIN);
    }
    let mut items = vec![thin.item("hair-strands", strand_colour(pen))];
    if !pen.ink_only {
        items.push(light.item("hair-light", pen.palette.hair_light.over(pen.palette.hair, 0.6)));
    }
    items
}

fn strand_colour(pen: &Pen) -> Colour {
    if pen.ink_only { pen.palette.hair_ink } else { pen.palette.strand.over(pen.palette.hair, 0.85) }
}

/// Strokes of one colour, gathered into one path: where they cross they do not darken.
struct Brushes<'a> {
    rays: &'a Rays,
    width: f64,
    wavy: bool,
    path: BezPath,
}

impl<'a> Brushes<'a> {
    fn new(rays: &'a Rays, width: f64) -> Self {
        Self { rays, width, wavy: false, path: BezPath::new() }
    }

    fn item(self, name: &str, colour: Colour) -> Item {
        Item::area(name, self.path, colour)
    }

    /// A strand over several rays, from one level to another. It ends where a ray has no hair.
    fn along(&mut self, levels: (f64, f64), run: std::ops::Range<usize>, profile: &[f64]) {
        let last = (run.len().max(2) - 1) as f64;
        let mut line: Vec<Point> = Vec::new();
        for (k, i) in run.enumerate() {
            match self.rays.runs.get(i).copied().flatten() {
                Some(ray) => line.push(between(ray, levels.0 + (levels.1 - levels.0) * k as f64 / last)),
                None if line.len() > 4 => break,
                None => line.clear(),
            }
        }
        if line.len() <= 4 {
            return;
        }
        for _ in 0..3 {
            let before = line.clone();
            for i in 1..line.len() - 1 {
                line[i] =
                    ((before[i - 1].to_vec2() + before[i].to_vec2() * 2.0 + before[i + 1].to_vec2()) / 4.0).to_point();
            }
        }
        if self.wavy {
            line = waved(&line, levels.0 * 40.0, 2.6);
        }
        self.path.extend(brush_in_steps(&line, self.width, profile, if self.wavy { 25 } else { 9 }));
    }

    /// A strand along a ray, bending over to another one.
    fn across(&mut self, from: usize, to: usize, levels: (f64, f64), wavy: bool, profile: &[f64]) {
        let run = |i: usize| self.rays.runs.get(i).copied().flatten();
        let (Some(a), Some(b)) = (run(from), run(to)) else { return };
        let mut line: Vec<Point> = (0..6)
            .map(|k| {
                let q = f64::from(k) / 5.0;
                let level = levels.0 + (levels.1 - levels.0) * q;
                between(a, level).lerp(between(b, level), q * q)
            })
            .collect();
        if wavy {
            line = waved(&line, from as f64, 3.2);
        }
        self.path.extend(brush_in_steps(&line, self.width, profile, if wavy { 17 } else { 7 }));
    }
}

/// A line with waves 47 units long, smaller where it starts.
fn waved(line: &[Point], phase: f64, across: f64) -> Vec<Point> {
    const POINTS: usize = 25;
    let points = equal_steps(&flattened(&spline(line, false)), POINTS, false);
    let along: Vec2 = points[POINTS - 1] - points[0];
    let length = along.hypot();
    let aside = Vec2::new(-along.y, along.x) / length.max(1.0);
    let waves = points.iter().enumerate().map(|(i, p)| {
        let t = i as f64 / (POINTS - 1) as f64;
        *p + aside * (across * (0.3 + 0.7 * t) * (t * length / 7.5 + phase).sin())
    });
    waves.collect()
}

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

/// The soft shades: toward the face, and on the side away from the light.
pub(super) fn shades(pen: &Pen, rays: &Rays) -> Vec<Item> {
    let (crown, last, c) = (Rays::CROWN, rays.runs.len(), pen.palette.hair_shade);
    let mut shade = Brushes::new(rays, 15.0);
    shade.along((0.06, 0.0), crown + 3..last - 2, &[0.0, 1.0, 0.7, 0.0]);
    shade.along((0.06, 0.0), 1..crown - 3, &[0.0, 1.0, 0.7, 0.0]);
    let mut far = Brushes::new(rays, 12.0);
    far.along((0.93, 0.95), 2..crown - 6, &[0.0, 1.0, 0.7, 0.0]);
    vec![shade.item("hair-shade", c), far.item("hair-far", c.faded(0.9))]
}

/// Single strands and lights. `amount` is 0 for none to 1 for all.
pub(super) fn strands(pen: &Pen, rays: &Rays, wavy: bool, amount: f64) -> Vec<Item> {
    let over_brow = (Rays::toward(45.0)..Rays::toward(140.0)).filter(|i| rays.depth(*i) > FRINGE);
    let fringe: Vec<usize> = over_brow.collect();
    if fringe.len() > FRINGE_RAYS { falling(pen, rays, &fringe, wavy, amount) } else { combed(pen, rays, amount) }
}

/// Hair away from the face: strands that keep their level between hairline and silhouette.
fn combed(pen: &Pen, rays: &Rays, amount: f64) -> Vec<Item> {
    const LIGHT: [f64; 4] = [0.0, 1.0, 0.8, 0.0];
    const THIN: [f64; 4] = [0.0, 1.0, 0.6, 0.0];
    let (c, last) = (Rays::CROWN, rays.runs.len());
    let mut items = Vec::new();
    if !pen.ink_only {
        let mut light = Brushes::new(rays, 1.0);
        for (level, run, width) in [
            (0.70, c + 4..c + 16, 5.0),
            (0.62, c + 3..c + 18, 7.0),
            (0.53, c + 5..c + 15, 4.0),
            (0.66, c - 14..c - 4, 5.0),
            (0.57, c - 12..c - 5, 3.0),
        ] {
            light.width = width;
            light.along((level, level + 0.03), run, &LIGHT);
        }
        items.push(light.item("hair-light", pen.palette.hair_light.faded(0.75)));
    }
    let mut thin = Brushes::new(rays, pen.ink);
    let all = [
        ((0.30, 0.42), c + 1..last - 6),
        ((0.80, 0.72), c + 3..last - 4),
        ((0.30, 0.42), 6..c - 1),
        ((0.80, 0.72), 4..c - 3),
        ((0.46, 0.58), c + 6..last - 2),
        ((0.46, 0.58), 2..c - 6),
        ((0.17, 0.22), c..c + 15),
        ((0.17, 0.22), c - 15..c),
    ];
    let count = (all.len() as f64 * amount).round() as usize;
    for (levels, run) in all.into_iter().take(count) {
        thin.along(levels, run, &THIN);
    }
    items.push(thin.item("hair-strands", strand_colour(pen)));
    items
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
        items.push(light.item("hair-light", pen.palette.hair_light.faded(0.6)));
    }
    items
}

fn strand_colour(pen: &Pen) -> Colour {
    if pen.ink_only { pen.palette.hair_ink } else { pen.palette.strand.faded(0.85) }
}

/// Strokes of one colour, gathered into one path: where they cross they do not darken.
struct Brushes<'a> {
    rays: &'a Rays,
    width: f64,
    path: BezPath,
}

impl<'a> Brushes<'a> {
    fn new(rays: &'a Rays, width: f64) -> Self {
        Self { rays, width, path: BezPath::new() }
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
        self.path.extend(brush_in_steps(&line, self.width, profile, 13));
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
            line = waved(&line, from as f64);
        }
        self.path.extend(brush_in_steps(&line, self.width, profile, if wavy { 17 } else { 9 }));
    }
}

/// A line with waves 3.2 units across and 47 long, smaller where it starts.
fn waved(line: &[Point], phase: f64) -> Vec<Point> {
    const POINTS: usize = 18;
    let points = equal_steps(&flattened(&spline(line, false)), POINTS, false);
    let along: Vec2 = points[POINTS - 1] - points[0];
    let length = along.hypot();
    let aside = Vec2::new(-along.y, along.x) / length.max(1.0);
    let waves = points.iter().enumerate().map(|(i, p)| {
        let t = i as f64 / (POINTS - 1) as f64;
        *p + aside * (3.2 * (0.3 + 0.7 * t) * (t * length / 7.5 + phase).sin())
    });
    waves.collect()
}

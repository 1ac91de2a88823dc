//! Hairs on the canvas: each lit along its length and drawn as a line a fraction of a pixel wide.

use rayon::prelude::*;

use crate::hair::Strand;
use crate::mass::Mass;
use crate::noise::fraction;
use crate::vector::{V, mix, smooth};
use crate::view::{Canvas, Rig, Stand};

#[derive(Clone, Copy)]
struct Point {
    x: f32,
    y: f32,
    near: f32,
    wide: f32,
    colour: V,
}

/// Draws the hairs that are nearer than what the canvas already holds.
pub fn expose(strands: &[Strand], mass: &Mass, stand: &Stand, rig: &Rig, canvas: &mut Canvas) {
    let per_unit = canvas.per_unit();
    let lines: Vec<Vec<Point>> = strands.par_iter().map(|s| lit(s, mass, stand, rig, per_unit)).collect();
    let wide = canvas.wide();
    let band = wide.div_ceil(16).max(1);
    let colour = canvas.colour.par_chunks_mut(wide * band);
    let near = canvas.near.par_chunks_mut(wide * band);
    colour.zip(near).enumerate().for_each(|(i, (colour, near))| {
        let top = (i * band) as i32;
        let mut sheet = Sheet { wide: wide as i32, top, high: (colour.len() / wide) as i32, colour, near };
        for (n, line) in lines.iter().enumerate() {
            for (k, pair) in line.windows(2).enumerate() {
                sheet.draw(&pair[0], &pair[1], (n as u64) << 8 | k as u64);
            }
        }
    });
}

/// A band of the canvas.
struct Sheet<'a> {
    wide: i32,
    top: i32,
    high: i32,
    colour: &'a mut [V],
    near: &'a mut [f32],
}

impl Sheet<'_> {
    fn draw(&mut self, a: &Point, b: &Point, seed: u64) {
        let (low, high) = (a.y.min(b.y) - 3.0, a.y.max(b.y) + 3.0);
        if high < self.top as f32 || low > (self.top + self.high) as f32 {
            return;
        }
        let (dx, dy) = (b.x - a.x, b.y - a.y);
        let steps = dx.abs().max(dy.abs()).ceil().max(1.0);
        let steep = dy.abs() > dx.abs();
        let flat = (dx * dx + dy * dy).sqrt().max(1e-3) / dx.abs().max(dy.abs()).max(1e-3);
        for i in 0..steps as i32 {
            let t = i as f32 / steps;
            let (x, y) = (mix(a.x, b.x, t), mix(a.y, b.y, t));
            // A line as wide as it should be across its own direction; a part of a sample is left to chance.
            let across = mix(a.wide, b.wide, t) * flat;
            let whole = across.floor();
            let extra = fraction(seed << 12 | i as u64) < across - whole;
            let count = whole as i32 + i32::from(extra);
            let near = mix(a.near, b.near, t);
            let colour = a.colour.lerp(b.colour, t);
            let first = -(across - 1.0) * 0.5;
            for j in 0..count {
                let o = first + j as f32;
                let (px, py) = if steep { (x + o, y) } else { (x, y + o) };
                let (px, py) = (px.floor() as i32, py.floor() as i32 - self.top);
                if px < 0 || py < 0 || px >= self.wide || py >= self.high {
                    continue;
                }
                let at = (py * self.wide + px) as usize;
                if near > self.near[at] {
                    self.near[at] = near;
                    self.colour[at] = colour;
                }
            }
        }
    }
}

/// The hair's points on the canvas with the light that each sends to the camera.
///
/// A hair is a cylinder: its dull part goes with the sine between hair and light (Kajiya and Kay 1989); its gloss has
/// two lobes, white towards the root and coloured towards the tip (Marschner et al. 2003), Gaussians in the mean of
/// the inclinations of light and eye.
fn lit(strand: &Strand, mass: &Mass, stand: &Stand, rig: &Rig, per_unit: f32) -> Vec<Point> {
    let key = stand.turned(rig.key);
    let fill = stand.turned(rig.fill);
    let up = stand.turned(V(0.0, -1.0, 0.0));
    let see = stand.turned(V(0.0, 0.0, 1.0));
    let n = strand.points.len();
    (0..n)
        .map(|i| {
            let p = strand.points[i];
            let along = (strand.points[(i + 1).min(n - 1)] - strand.points[i.saturating_sub(1)]).unit();
            let t = i as f32 / (n - 1).max(1) as f32;
            let colour = if strand.mass {
                let mut sum = V::ZERO;
                for (to, power) in [(key, rig.key_power), (fill, rig.fill_power)] {
                    let seen = mass.through(p, to, 0.16, 12) * mass.past_skull(p, to);
                    sum = sum + one(along, to, see, strand.colour) * (power * seen);
                }
                let open = mass.through(p, (up + see * 1.3).unit(), 0.12, 10);
                sum + strand.colour * (rig.sky * 0.6 * open)
            } else {
                let light = rig.key_power * 0.55 + rig.fill_power * 0.4 + rig.sky * 0.5;
                strand.colour * light
            };
            let at = stand.project(p);
            let taper = if strand.mass { mix(1.0, 0.45, smooth(0.75, 1.0, t)) } else { mix(1.0, 0.25, t) };
            Point {
                x: at.0 * per_unit,
                y: at.1 * per_unit,
                near: at.2 + if strand.mass { 0.0 } else { 1.0 },
                wide: strand.width * stand.scale * per_unit * taper,
                colour,
            }
        })
        .collect()
}

fn one(along: V, to: V, see: V, colour: V) -> V {
    let (l, v) = (along.dot(to).clamp(-1.0, 1.0), along.dot(see).clamp(-1.0, 1.0));
    let half = (l.asin() + v.asin()) * 0.5;
    let lobe = |shift: f32, width: f32| (-((half - shift) / width).powi(2) * 0.5).exp();
    let sine = (1.0 - l * l).sqrt();
    let warm = V(colour.0.sqrt(), colour.1.sqrt(), colour.2.sqrt());
    colour * (sine * 0.75) + V::all(0.055 * lobe(-0.10, 0.10)) + warm.by(warm) * (1.6 * lobe(0.13, 0.19))
}

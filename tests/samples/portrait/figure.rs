//! One figure exposed on the canvas: rays to its surface, light on that, light spread under the skin.

use rayon::prelude::*;

use crate::body;
use crate::eye;
use crate::head::Head;
use crate::mass::Mass;
use crate::noise::{cloud, grain};
use crate::person::Person;
use crate::skin::{self, Surface};
use crate::vector::{V, join, mix, smooth};
use crate::view::{Canvas, Rig, Stand};

#[derive(Clone, Copy, PartialEq)]
enum Stuff {
    Nothing,
    Skin,
    Eye,
    Shirt,
    Teeth,
    Tongue,
}

/// What one ray met.
#[derive(Clone, Copy)]
struct Sample {
    stuff: Stuff,
    place: V,
    near: f32,
    /// Light that arrives, and light thrown back by the gloss.
    light: V,
    shine: V,
    albedo: V,
}

/// How much a place sees of the large lamp, of its surroundings, and of them through the hair.
#[derive(Clone, Copy)]
struct Shadows {
    seen: f32,
    open: f32,
    ambient: f32,
}

const NONE: Sample =
    Sample { stuff: Stuff::Nothing, place: V::ZERO, near: f32::MIN, light: V::ZERO, shine: V::ZERO, albedo: V::ZERO };

/// Canvas samples to one ray, each way.
const COARSE: usize = 2;

pub struct Figure<'a> {
    pub head: &'a Head,
    pub mass: &'a Mass,
    pub stand: Stand,
    pub rig: Rig,
    moles: Vec<(f32, f32, f32, f32)>,
}

impl<'a> Figure<'a> {
    pub fn new(head: &'a Head, mass: &'a Mass, stand: Stand, rig: Rig) -> Figure<'a> {
        Figure { head, mass, stand, rig, moles: skin::moles(head.person.seed) }
    }

    fn person(&self) -> &Person {
        &self.head.person
    }

    fn skin(&self, p: V) -> f32 {
        if p.1 < 30.0 {
            return self.head.distance(p);
        }
        if p.1 > 235.0 {
            return body::skin(p, self.person().neck);
        }
        let head = self.head.distance(p);
        // Before the face the neck is too far to matter.
        if p.2 > 85.0 && p.1 < 170.0 && head < 20.0 {
            return head;
        }
        join(head, body::skin(p, self.person().neck), 9.0)
    }

    fn nearest(&self, p: V) -> (f32, Stuff) {
        let bare = self.skin(p);
        let mut best = (bare, Stuff::Skin);
        let mut offer = |d: f32, stuff: Stuff| {
            if d < best.0 {
                best = (d, stuff);
            }
        };
        if p.1 > 140.0 {
            offer(body::shirt(p, self.person().neck), Stuff::Shirt);
        }
        if bare < 30.0 && p.2 > 60.0 && p.1 < 40.0 {
            offer(self.head.eyes(p), Stuff::Eye);
        }
        if self.head.gape() > 0.0 && bare < 40.0 && p.2 > 40.0 {
            offer(self.head.teeth(p), Stuff::Teeth);
            offer(self.head.tongue(p), Stuff::Tongue);
        }
        best
    }

    fn distance(&self, p: V) -> f32 {
        self.nearest(p).0
    }

    /// The direction away from the surface, by four samples at the corners of a tetrahedron.
    fn outward(&self, p: V, e: f32) -> V {
        let mut n = V::ZERO;
        for k in [V(1.0, -1.0, -1.0), V(-1.0, -1.0, 1.0), V(-1.0, 1.0, -1.0), V(1.0, 1.0, 1.0)] {
            n = n + k * self.distance(p + k * e);
        }
        n.unit()
    }

    fn march(&self, from: V, to: V) -> Option<(V, Stuff)> {
        self.march_from(from, to, 0.0)
    }

    fn march_from(&self, from: V, to: V, start: f32) -> Option<(V, Stuff)> {
        let (t, end) = bounds(from, to)?;
        let bold = if start > 0.0 { 0.9 } else { 0.72 };
        let first = t;
        let mut t = t.max(start);
        if start > 0.0 && self.distance(from + to * t) < 1.0 {
            t = first;
        }
        let mut before = t;
        for _ in 0..200 {
            let p = from + to * t;
            let (d, stuff) = self.nearest(p);
            if d < -0.04 {
                return Some(if start > 0.0 {
                    self.nearer(from, to, before, t)
                } else {
                    self.between(from, to, before, t)
                });
            }
            if d < 0.04 {
                return Some((p, stuff));
            }
            before = t;
            // Under the chin the nearest surface is not the one straight inwards: no long steps there.
            t += (d * bold).clamp(0.25, 12.0);
            if t > end {
                return None;
            }
        }
        // A ray that creeps along an edge counts as having touched it.
        let p = from + to * t;
        let (d, stuff) = self.nearest(p);
        (d < 1.0).then_some((p, stuff))
    }

    /// The surface between a place before it and one behind it on a ray, by halving.
    fn between(&self, from: V, to: V, mut before: f32, mut behind: f32) -> (V, Stuff) {
        for _ in 0..14 {
            let t = (before + behind) * 0.5;
            if self.distance(from + to * t) > 0.0 { before = t } else { behind = t }
        }
        let p = from + to * behind;
        (p, self.nearest(p).1)
    }

    /// The same by the secant, which takes fewer looks.
    fn nearer(&self, from: V, to: V, mut before: f32, mut behind: f32) -> (V, Stuff) {
        let (mut out, mut within) = (self.distance(from + to * before).max(1e-3), self.distance(from + to * behind));
        for _ in 0..6 {
            let t = mix(before, behind, (out / (out - within)).clamp(0.05, 0.95));
            let d = self.distance(from + to * t);
            if d.abs() < 0.04 {
                behind = t;
                break;
            }
            if d > 0.0 { (before, out) = (t, d) } else { (behind, within) = (t, d) }
        }
        let p = from + to * behind;
        (p, self.nearest(p).1)
    }

    /// The part of a large lamp that is seen from `p` (Quilez's estimate: the narrowest passage, as an angle).
    fn lamp(&self, p: V, to: V, sharp: f32) -> f32 {
        let mut open = 1.0f32;
        let mut t = 2.0;
        let steps = if sharp > 10.0 { 70 } else { 22 };
        for _ in 0..steps {
            let d = self.distance(p + to * t);
            open = open.min(0.5 + 0.5 * sharp * d / t);
            if open < 0.0 || t > 170.0 {
                break;
            }
            t += d.clamp(1.5, 16.0);
        }
        let open = open.max(0.0);
        open * open * (3.0 - 2.0 * open)
    }

    /// How open the surroundings are above a surface.
    fn sky(&self, p: V, n: V) -> f32 {
        let mut shut = 0.0;
        for (h, w) in [(1.5, 0.20), (4.0, 0.10), (9.0, 0.055), (19.0, 0.026), (38.0, 0.011)] {
            shut += (h - self.distance(p + n * h)).max(0.0) * w;
        }
        (1.0 - shut).clamp(0.06, 1.0)
    }

    /// What hides the lamps from a place, in the direction away from its surface.
    fn shadows(&self, place: V, smooth_n: V, eye: V) -> Shadows {
        let see = (eye - place).unit();
        let key = self.stand.turned(self.rig.key);
        let seen = self.lamp(place + smooth_n * 0.6, key, self.rig.sharp) * self.mass.through(place, key, 0.20, 14);
        let open = self.sky(place, smooth_n);
        let shut_in = self.mass.through(place, (smooth_n + see).unit(), 0.10, 8);
        Shadows { seen, open, ambient: open * (0.35 + 0.65 * shut_in) }
    }

    fn facing(&self, place: V, stuff: Stuff) -> V {
        self.outward(place, if stuff == Stuff::Skin { 0.35 } else { 0.5 })
    }

    fn shade(&self, place: V, stuff: Stuff, eye: V) -> Sample {
        let smooth_n = self.facing(place, stuff);
        self.shade_in(place, stuff, eye, smooth_n, self.shadows(place, smooth_n, eye))
    }

    fn shade_in(&self, place: V, stuff: Stuff, eye: V, smooth_n: V, shadows: Shadows) -> Sample {
        let see = (eye - place).unit();
        let Shadows { seen, open, ambient } = shadows;
        let mut n = smooth_n;
        let (surface, wrap) = match stuff {
            Stuff::Skin => {
                n = (n + skin::relief(self.head.pattern(place), 0.075)).unit();
                (skin::at(self.head, &self.moles, place), 0.22)
            }
            Stuff::Eye => {
                let (surface, facing) = eye::at(self.head, place);
                n = facing;
                (surface, 0.25)
            }
            Stuff::Shirt => {
                let weave = 1.0 + 0.05 * grain(place * 1.3) + 0.05 * cloud(place * 0.4);
                (Surface { albedo: self.person().shirt * weave, rough: 0.8, gloss: 0.25 }, 0.1)
            }
            Stuff::Teeth => (Surface { albedo: V(0.62, 0.57, 0.46), rough: 0.25, gloss: 1.0 }, 0.2),
            _ => (Surface { albedo: V(0.38, 0.12, 0.11), rough: 0.35, gloss: 0.9 }, 0.2),
        };
        let rig = &self.rig;
        let key = self.stand.turned(rig.key);
        let fill = self.stand.turned(rig.fill);
        let up = self.stand.turned(V(0.0, -1.0, 0.0));

        let facing = |l: V| ((n.dot(l) + wrap) / (1.0 + wrap)).max(0.0);
        let sky = (0.55 + 0.45 * n.dot(up)) * (0.6 + 0.4 * n.dot(see).max(0.0));
        // What light skin throws back into a hollow is red.
        let warm = if stuff == Stuff::Skin || stuff == Stuff::Eye {
            V(1.0, mix(0.84, 1.0, open), mix(0.77, 1.0, open))
        } else {
            V::all(1.0)
        };
        let light = V(1.0, 0.985, 0.96) * (rig.key_power * facing(key) * seen)
            + V(0.94, 0.97, 1.0) * (rig.fill_power * facing(fill) * ambient)
            + warm.by(V(0.96, 0.99, 1.0)) * (rig.sky * sky * ambient);

        let mut shine = V::ZERO;
        for (to, power, seen) in [(key, rig.key_power, seen), (fill, rig.fill_power, ambient)] {
            shine = shine + V::all(gloss(n, see, to, surface.rough) * power * seen * surface.gloss);
        }
        // At grazing angles the bright room shows on everything.
        let edge = (1.0 - n.dot(see).max(0.0)).powi(5);
        shine = shine + V::all(0.16 * edge * rig.sky * ambient * surface.gloss);
        if stuff == Stuff::Eye {
            shine = shine * 0.12 + self.window(n, see, key) * (0.55 + 0.45 * seen);
        }
        let shine =
            if stuff == Stuff::Eye { shine } else { V::all(shine.0.min(0.30) * smooth(0.02, 0.22, smooth_n.dot(see))) };
        Sample { stuff, place, near: self.stand.nearness(place), light, shine, albedo: surface.albedo }
    }

    /// The lamp itself, mirrored in the cornea as a rounded square.
    fn window(&self, n: V, see: V, key: V) -> V {
        let r = n * (2.0 * n.dot(see)) - see;
        let across = V(key.2, 0.0, -key.0).unit();
        let rise = V(0.0, 1.0, 0.0) - key * key.1;
        let (a, b) = (r.dot(across) / 0.20, r.dot(rise.unit()) / 0.23);
        let inside = (a.powi(4) + b.powi(4)).sqrt().sqrt();
        V(1.0, 1.0, 0.98) * (0.95 * smooth(1.25, 0.75, inside) * smooth(0.0, 0.3, r.dot(key)))
    }

    /// Exposes the figure's surfaces; its hairs come after (`strand::expose`).
    pub fn expose(&self, canvas: &mut Canvas) {
        self.seen(canvas).put(canvas);
    }

    /// What each ray meets.
    pub fn seen(&self, canvas: &Canvas) -> Exposure {
        let wide = canvas.wide() / COARSE;
        let per_unit = canvas.per_unit() / COARSE as f32;
        let mut samples = vec![NONE; wide * wide];
        samples.par_chunks_mut(wide).enumerate().for_each(|(row, line)| {
            for (column, sample) in line.iter_mut().enumerate() {
                let (from, to) = self.stand.ray((column as f32 + 0.5) / per_unit, (row as f32 + 0.5) / per_unit);
                if let Some((place, stuff)) = self.march(from, to) {
                    *sample = self.shade(place, stuff, from);
                }
            }
        });
        let light = spread(&samples, wide, per_unit * self.stand.scale);
        Exposure { wide, samples, light }
    }

    /// The same of a figure that differs in its face alone from one that has been seen: only the face's rays are sent
    /// again, and of four that lie together one looks for shadows, which are soft.
    pub fn seen_again(&self, canvas: &Canvas, before: &Exposure) -> Exposure {
        let wide = before.wide;
        let per_unit = canvas.per_unit() / COARSE as f32;
        let ray =
            |row: usize, column: usize| self.stand.ray((column as f32 + 0.5) / per_unit, (row as f32 + 0.5) / per_unit);
        let in_face = |from: V, to: V| {
            let at = from + to * ((from.2 - 100.0) / -to.2);
            let (x, y) = (at.0 / 112.0, (at.1 - 60.0) / if at.1 < 60.0 { 164.0 } else { 180.0 });
            (x * x * x * x + y * y * y * y < 1.0 && (at.1 < 140.0 || at.0.abs() < 96.0)).then_some(at)
        };
        let mut met: Vec<Option<(V, Stuff, V)>> = vec![None; wide * wide];
        met.par_chunks_mut(wide).enumerate().for_each(|(row, line)| {
            for (column, met) in line.iter_mut().enumerate() {
                let (from, to) = ray(row, column);
                let Some(at) = in_face(from, to) else { continue };
                let was = &before.samples[row * wide + column];
                // Beside the head there is still nothing.
                if was.stuff == Stuff::Nothing && at.1 < 85.0 || was.stuff == Stuff::Shirt {
                    continue;
                }
                // Down to the chin nothing comes nearer by more than folds and lips that are pushed out.
                let deep = at.1 < 105.0 || at.1 < 150.0 && was.place.2 > 80.0;
                let near = deep && was.stuff != Stuff::Nothing;
                let start = if near { (was.place - from).len() - if at.1 < 60.0 { 5.0 } else { 12.0 } } else { 0.0 };
                *met = self.march_from(from, to, start).map(|(p, stuff)| (p, stuff, self.facing(p, stuff)));
            }
        });
        let shadows: Vec<Option<Shadows>> = (0..wide * wide)
            .into_par_iter()
            .map(|i| {
                let (row, column) = (i / wide, i % wide);
                let (p, _, n) = met[i].filter(|_| row % 2 == 0 && column % 2 == 0)?;
                Some(self.shadows(p, n, ray(row, column).0))
            })
            .collect();
        let mut samples = before.samples.clone();
        samples.par_chunks_mut(wide).enumerate().for_each(|(row, line)| {
            for (column, sample) in line.iter_mut().enumerate() {
                let (from, to) = ray(row, column);
                if in_face(from, to).is_none() || sample.stuff == Stuff::Shirt {
                    continue;
                }
                let Some((place, stuff, n)) = met[row * wide + column] else {
                    *sample = NONE;
                    continue;
                };
                let beside = (row & !1) * wide + (column & !1);
                let same = met[beside].is_some_and(|(p, s, m)| s == stuff && (p - place).len() < 4.0 && m.dot(n) > 0.8);
                let shadows = shadows[beside].filter(|_| same).unwrap_or_else(|| self.shadows(place, n, from));
                *sample = self.shade_in(place, stuff, from, n, shadows);
            }
        });
        let light = spread(&samples, wide, per_unit * self.stand.scale);
        Exposure { wide, samples, light }
    }
}

/// What the rays of a picture have met, and the light that leaves the skin there.
#[derive(Clone)]
pub struct Exposure {
    wide: usize,
    samples: Vec<Sample>,
    light: Vec<V>,
}

impl Exposure {
    /// Puts on the canvas what is nearer than what it holds.
    pub fn put(&self, canvas: &mut Canvas) {
        let full = canvas.wide();
        for row in 0..full {
            for column in 0..full {
                let at = row / COARSE * self.wide + column / COARSE;
                let s = &self.samples[at];
                let to = row * full + column;
                if s.stuff != Stuff::Nothing && s.near > canvas.near[to] {
                    canvas.near[to] = s.near;
                    canvas.colour[to] = s.albedo.by(self.light[at]) + s.shine;
                }
            }
        }
    }
}

/// The part of a ray within the box that holds every figure.
fn bounds(from: V, to: V) -> Option<(f32, f32)> {
    let (low, high) = (V(-335.0, -165.0, -150.0), V(335.0, 900.0, 178.0));
    let mut span = (0.0f32, f32::MAX);
    for (f, d, a, b) in [(from.0, to.0, low.0, high.0), (from.1, to.1, low.1, high.1), (from.2, to.2, low.2, high.2)] {
        let d = if d.abs() < 1e-9 { 1e-9 } else { d };
        let (a, b) = ((a - f) / d, (b - f) / d);
        span = (span.0.max(a.min(b)), span.1.min(a.max(b)));
    }
    (span.0 < span.1).then_some(span)
}

/// Gloss of a rough surface (GGX with Schlick's Fresnel term, 0.028 for skin and water films).
fn gloss(n: V, see: V, to: V, rough: f32) -> f32 {
    let h = (see + to).unit();
    let (nl, nv, nh) = (n.dot(to), n.dot(see).max(0.05), n.dot(h).max(0.0));
    if nl <= 0.0 {
        return 0.0;
    }
    let a2 = rough.powi(4);
    let d = a2 / (std::f32::consts::PI * (nh * nh * (a2 - 1.0) + 1.0).powi(2));
    let k = rough * rough * 0.5;
    let g = 1.0 / ((nl * (1.0 - k) + k) * (nv * (1.0 - k) + k));
    let fresnel = 0.028 + 0.972 * (1.0 - see.dot(h).max(0.0)).powi(5);
    d * g * fresnel * 0.25 * nl * std::f32::consts::PI
}

/// Light that entered the skin leaves it a little further on, red light further than green and blue: a Gaussian per
/// channel over the picture, that stops where the depth jumps or the skin ends.
fn spread(samples: &[Sample], wide: usize, per_unit: f32) -> Vec<V> {
    let sigma = V(3.4, 1.7, 1.0) * per_unit;
    let reach = (sigma.0 * 2.0).ceil() as i32;
    let kernel: Vec<V> = (0..=reach)
        .map(|i| {
            let g = |s: f32| (-0.5 * (i as f32 / s.max(0.2)).powi(2)).exp();
            V(g(sigma.0), g(sigma.1), g(sigma.2))
        })
        .collect();
    let pass = |light: &[V], down: bool| -> Vec<V> {
        (0..samples.len())
            .into_par_iter()
            .map(|at| {
                let here = &samples[at];
                if here.stuff != Stuff::Skin {
                    return light[at];
                }
                let (row, column) = ((at / wide) as i32, (at % wide) as i32);
                let (mut sum, mut weight) = (V::ZERO, V::ZERO);
                for i in -reach..=reach {
                    let (r, c) = if down { (row + i, column) } else { (row, column + i) };
                    if r < 0 || c < 0 || r >= wide as i32 || c >= wide as i32 {
                        continue;
                    }
                    let to = r as usize * wide + c as usize;
                    let there = &samples[to];
                    if there.stuff != Stuff::Skin || (there.place - here.place).len() > 16.0 {
                        continue;
                    }
                    let k = kernel[i.unsigned_abs() as usize];
                    sum = sum + light[to].by(k);
                    weight = weight + k;
                }
                V(sum.0 / weight.0, sum.1 / weight.1, sum.2 / weight.2)
            })
            .collect()
    };
    let raw: Vec<V> = samples.iter().map(|s| s.light).collect();
    let soft = pass(&pass(&raw, false), true);
    raw.iter().zip(soft).map(|(a, b)| a.lerp(b, 0.7)).collect()
}

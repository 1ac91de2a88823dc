//! Grows every hair of a person: on the scalp, the brows and the lids.

use rayon::prelude::*;

use crate::curve::Curve;
use crate::head::{EYE, EYE_RADIUS, Head};
use crate::noise::{Dice, cloud, grain};
use crate::person::Cut;
use crate::skull::CENTRE;
use crate::vector::{V, mix, smooth, spot};

/// One hair, from its root to its tip.
pub struct Strand {
    pub points: Vec<V>,
    /// In units (pixels of the 600 frame), at the root.
    pub width: f32,
    pub colour: V,
    /// Whether it casts a shadow and is shaded as one of many.
    pub mass: bool,
}

/// How many hairs stand on the scalp.
const BOB: usize = 56_000;
const SHORT: usize = 60_000;

/// The hairline: the lowest y of the scalp for the angle from the front, in radians.
pub fn hairline(cut: Cut) -> Curve {
    match cut {
        Cut::Bob => Curve::through(&[
            (0.0, -101.0),
            (0.28, -101.0),
            (0.55, -96.0),
            (0.80, -82.0),
            (0.96, -58.0),
            (1.08, -28.0),
            (1.20, 6.0),
            (1.32, 22.0),
            (1.55, 10.0),
            (1.8, 10.0),
            (2.1, 62.0),
            (2.6, 84.0),
            (3.15, 88.0),
        ]),
        Cut::Short => Curve::through(&[
            (0.0, -103.0),
            (0.25, -104.0),
            (0.48, -107.0),
            (0.66, -100.0),
            (0.78, -80.0),
            (0.90, -56.0),
            (1.02, -40.0),
            (1.14, -20.0),
            (1.22, 16.0),
            (1.36, 34.0),
            (1.46, 8.0),
            (1.62, -14.0),
            (1.85, 10.0),
            (2.1, 50.0),
            (2.6, 76.0),
            (3.15, 80.0),
        ]),
    }
}

/// How far from the midline hair may lie in front: x for a height y.
fn face_edge() -> Curve {
    Curve::through(&[
        (-150.0, 0.0),
        (-108.0, 10.0),
        (-100.0, 42.0),
        (-90.0, 65.0),
        (-76.0, 80.0),
        (-55.0, 91.0),
        (-20.0, 96.0),
        (20.0, 98.0),
        (70.0, 97.0),
        (120.0, 92.0),
        (160.0, 88.0),
    ])
}

/// All hairs of a head; the same for the same person.
pub fn grow(head: &Head) -> Vec<Strand> {
    let mut all = scalp(head);
    brows(head, &mut all);
    lashes(head, &mut all);
    all
}

/// The hairs of brows and lids of a head that does something; `at_rest` is the same head, and `brows` its brows.
pub fn moved(head: &Head, at_rest: &Head, brows: &[Strand]) -> Vec<Strand> {
    let moved = |s: &Strand| {
        let points = s.points.iter().map(|p| head.sway(at_rest.rest(*p))).collect();
        Strand { points, width: s.width, colour: s.colour, mass: s.mass }
    };
    let mut all: Vec<Strand> = brows.iter().map(moved).collect();
    lashes(head, &mut all);
    all
}

/// The hairs of the head but its face's.
pub fn scalp(head: &Head) -> Vec<Strand> {
    let cut = head.person.cut;
    let face = face_edge();
    let count = if cut == Cut::Bob { BOB } else { SHORT };
    let mut all: Vec<Strand> = (0..count)
        .into_par_iter()
        .filter_map(|i| {
            let mut dice = Dice::new(head.person.seed.wrapping_mul(1_000_003) ^ i as u64);
            let root = root(head, &mut dice)?;
            Some(match cut {
                Cut::Bob => bob(head, &face, &root, &mut dice),
                Cut::Short => short(head, &root, &mut dice),
            })
        })
        .collect();
    down(head, &mut all);
    all
}

struct Root {
    at: V,
    /// How far within the hairline, in units; hairs at the edge are finer.
    inside: f32,
}

/// A place on the scalp, or none where the dice fell on the face.
fn root(head: &Head, dice: &mut Dice) -> Option<Root> {
    let (z, turn) = (dice.between(-1.0, 1.0), dice.between(0.0, std::f32::consts::TAU));
    let r = (1.0 - z * z).sqrt();
    let mut at = head.skull.surface(V(r * turn.cos(), z, r * turn.sin()));
    if head.person.cut == Cut::Bob && dice.roll() < 0.07 {
        // Beside the parting no hair from elsewhere covers the scalp: more grows there.
        let z = dice.between(WHORL - 15.0, 112.0);
        let x = parting(z) + 4.5 * dice.normal();
        at = V(x, -140.0, z);
        for _ in 0..4 {
            at = head.skull.surface((V(x, at.1, z) - CENTRE).unit());
        }
    }
    let ragged = 3.0 * cloud(at * 0.16) + 2.0 * dice.normal();
    let inside = head.within_hairline(at) + ragged;
    (inside > 0.0 && dice.roll() < 0.25 + smooth(0.0, 12.0, inside)).then_some(Root { at, inside })
}

fn tint(head: &Head, at: V, dice: &mut Dice) -> V {
    // Locks differ a little, single hairs more; some are sun-bleached.
    let lock = 1.0 + 0.5 * cloud(at * 0.17);
    let own = 1.0 + 0.3 * dice.normal().clamp(-1.6, 1.8);
    let warm = dice.between(0.0, 0.25);
    head.person.hair.by(V(1.0 + warm, 1.0 + 0.45 * warm, 1.0)) * (lock * own.max(0.3))
}

/// The depth at which the parting ends and hair goes back and to the sides from one point.
const WHORL: f32 = 48.0;

/// Where the parting runs: x for a depth z, from the hairline back to the whorl.
fn parting(z: f32) -> f32 {
    mix(24.0, 38.0, smooth(WHORL, 110.0, z)) + 1.6 * (z * 0.13).sin()
}

fn bob(head: &Head, face: &Curve, root: &Root, dice: &mut Dice) -> Strand {
    let seed = head.person.seed as f32;
    let at = root.at;
    let up = head.skull.outward(at);
    // In front of the crown hair is combed off the parting; behind it, away from the whorl.
    let side = if at.0 > parting(at.2) { 1.0 } else { -1.0 };
    let off = V(side, 0.25, -0.32);
    let whorl = V(at.0 - 24.0, 0.6 * (at.1 + 140.0), at.2 - WHORL);
    let front = smooth(WHORL - 12.0, WHORL + 14.0, at.2);
    let comb = (whorl.unit() + V(0.0, 0.35, 0.0)).lerp(off, front);
    let comb = (comb - up * comb.dot(up)).unit();
    // Hair from above lies over hair from below.
    let high = smooth(60.0, -150.0, at.1);
    let layer = 2.0
        + 15.0 * high.powf(0.8)
        + 5.0 * dice.roll() * dice.roll()
        + 2.5 * grain(at * 0.05 + V::all(seed))
        + 3.5 * grain(at * 0.19);
    let stray = if dice.roll() < 0.025 { dice.between(0.5, 1.6) } else { 0.0 };
    let near_part = spot((at.0 - parting(at.2)) / 14.0) * front;
    let mut direction = (comb + up * (0.22 + 0.2 * near_part)).unit();
    let mut p = at;
    let step = 4.5;
    let tip = mix(148.0, 166.0, smooth(20.0, -60.0, at.2))
        + 6.0 * dice.normal()
        + 7.0 * cloud(at * 0.09)
        + 9.0 * cloud(at * 0.25);
    let own = V(dice.normal(), dice.normal(), dice.normal());
    let phase = at * 0.035 + V::all(seed);
    let mut points = Vec::with_capacity(80);
    points.push(p);
    let ragged = cloud(at * 0.13);
    let mut run = 0.0;
    while run < 470.0 && p.1 < tip {
        run += step;
        let out = head.skull.outward(p);
        let wave = V(cloud(phase + V(0.0, run * 0.012, 0.0)), 0.0, cloud(phase + V(9.0, run * 0.012, 4.0)));
        let wild = V(grain(own * 7.0 + V::all(run * 0.02)), 0.0, grain(own * 9.0 + V::all(run * 0.02)));
        let keep = comb * (0.10 * smooth(120.0, 20.0, run));
        let mut pull =
            V(0.0, 0.20, 0.0) + keep + wave * mix(0.07, 0.13, smooth(0.0, 80.0, p.1)) + wild * (0.03 + 0.11 * stray);
        // The tips turn in under the jaw.
        let low = smooth(70.0, 150.0, p.1);
        pull = pull + V(-p.0.signum() * 0.10 * low, 0.0, -0.02 * low * p.2.signum());
        direction = (direction + pull).unit();
        let next = p + direction * step;
        let far = head.skull.distance(head.rest(next));
        let ear =
            17.0 * spot(((next.1 - 30.0) / 50.0).hypot((next.2 + 14.0) / 36.0)) * smooth(70.0, 100.0, next.0.abs());
        let cover = ear
            + 2.2 * smooth(0.0, 4.0, run)
            + (layer - 2.0) * smooth(0.0, 34.0, run)
            + stray * 4.0 * smooth(10.0, 90.0, run) * smooth(130.0, 40.0, p.1);
        let edge = smooth(10.0, 40.0, p.2) * smooth(0.0, -40.0, p.1) * smooth(30.0, 4.0, p.0 * side - face.at(p.1));
        let from_part = (p.0 - parting(p.2)).hypot((WHORL - p.2).max(0.0)) + (p.1 + 130.0).max(0.0);
        let cover = cover * mix(1.0, 0.3, edge) * mix(0.9, 1.0, smooth(0.0, 60.0, from_part)) + 1.0;
        let mut q = next;
        if far < cover {
            let push = (cover - far).min(step * 0.55);
            q = next + out * push;
        } else if far > cover + 2.0 && q.1 < 40.0 {
            q = next - out * ((far - cover - 2.0).min(step * 0.3));
        }
        // The face stays free: the hair is swept along the hairline and hangs as a curtain on either side.
        let free = face.at(q.1) + 2.6 * own.0 + 4.0 * ragged + layer * 0.25;
        let ahead = smooth(15.0, 45.0, q.2) * smooth(-106.0, -90.0, q.1);
        if ahead > 0.0 && q.0 * side < free {
            q.0 = mix(q.0, free * side, 0.35 * ahead);
        }
        // What hangs beside the face hangs before the ear, not before the cheek.
        let rear = 54.0 + 6.0 * own.1;
        if q.2 > rear && q.1 > -70.0 {
            q.2 = mix(q.2, rear, 0.07 * smooth(-70.0, 0.0, q.1));
        }
        direction = direction.lerp((q - p).unit(), 0.65).unit();
        p = q;
        points.push(p);
    }
    let fine = smooth(0.0, 9.0, root.inside);
    Strand { points, width: mix(0.20, 0.34, fine), colour: tint(head, at, dice), mass: true }
}

/// The fine short hairs along the hairline, without which hair looks like a wig.
fn down(head: &Head, all: &mut Vec<Strand>) {
    let mut dice = Dice::new(head.person.seed ^ 0xd0);
    let (count, most) = if head.person.cut == Cut::Bob { (26_000, 20.0) } else { (12_000, 5.0) };
    for _ in 0..count {
        let (z, turn) = (dice.between(-1.0, 0.3), dice.between(0.0, std::f32::consts::PI));
        let r = (1.0f32 - z * z).sqrt();
        let at = head.skull.surface(V(r * turn.cos(), z, r * turn.sin()));
        let inside = head.within_hairline(at) + 2.0 * cloud(at * 0.2);
        if at.2 < 10.0 || inside < -6.0 * dice.roll() || inside > 7.0 {
            continue;
        }
        let up = head.skull.outward(at);
        let side = if at.0 > parting(at.2) { 1.0 } else { -1.0 };
        let back = V(side * dice.between(0.4, 1.0), dice.between(-0.9, 0.5), -0.7);
        let mut direction = (back - up * (back.dot(up) - 0.3)).unit();
        let length = most * dice.between(0.35, 1.0);
        let mut p = at;
        let mut points = vec![p];
        let curl = V(dice.normal(), dice.normal(), dice.normal()) * 0.06;
        for _ in 0..7 {
            direction = (direction + curl - up * 0.06).unit();
            p = p + direction * (length / 7.0);
            p = p + up * (0.4 - head.skull.distance(p)).max(0.0);
            points.push(p);
        }
        all.push(Strand { points, width: dice.between(0.10, 0.2), colour: tint(head, at, &mut dice), mass: true });
    }
}

fn short(head: &Head, root: &Root, dice: &mut Dice) -> Strand {
    let at = root.at;
    let up = head.skull.outward(at);
    let top = smooth(-30.0, -110.0, at.1);
    let comb = V(0.25 * at.0.signum(), 0.1, 0.35).lerp(V(0.1, 0.7, -0.15), 1.0 - top);
    let own = V(dice.normal(), dice.normal(), dice.normal());
    let curl = V(grain(at * 0.2), grain(at * 0.2 + V::all(31.0)), grain(at * 0.2 + V::all(57.0)));
    let mut direction = (up + comb * 0.45 + curl * 0.5 + own * 0.18).unit();
    let fine = smooth(0.0, 12.0, root.inside);
    let length = mix(5.0, 13.0, top) * mix(0.45, 1.0, fine) * dice.between(0.75, 1.1);
    let mut points = vec![at];
    let mut p = at;
    let twist = V(dice.normal(), dice.normal(), dice.normal()) * 0.45;
    for _ in 0..6 {
        direction = (direction + twist * 0.5 + V(0.0, 0.10, 0.0) + comb * 0.08).unit();
        p = p + direction * (length / 6.0);
        let far = head.skull.distance(p);
        if far < 1.0 {
            p = p + up * (1.0 - far);
        }
        points.push(p);
    }
    let width = head.person.hair_width * mix(0.2, 0.34, fine);
    Strand { points, width, colour: tint(head, at, dice), mass: true }
}

/// The skin under a place on the face, by marching back from the front.
pub fn on_skin(head: &Head, x: f32, y: f32) -> V {
    let mut p = V(x, y, 190.0);
    for _ in 0..90 {
        let d = head.distance(p);
        if d < 0.05 {
            break;
        }
        p.2 -= d * 0.6;
    }
    p
}

pub fn brows(head: &Head, all: &mut Vec<Strand>) {
    let l = &head.lines;
    let mut dice = Dice::new(head.person.seed ^ 0xb40);
    for side in [-1.0, 1.0] {
        for _ in 0..head.person.brow_hairs {
            let t = dice.roll().powf(0.92);
            let x = mix(19.0, 89.0, t);
            let (top, low) = (l.brow_upper.at(x), l.brow_lower.at(x));
            // More hairs along the middle and the lower edge; the head of the brow is sparse.
            let v = (0.54 + 0.25 * dice.normal()).clamp(0.0, 1.0);
            if dice.roll() > smooth(16.0, 33.0, x) + 0.12 {
                continue;
            }
            let y = mix(top, low, v);
            // At the head hairs stand up, along the arch they lie outwards, upper ones bend down to meet the lower.
            let rise = mix(1.35, 0.0, smooth(0.0, 0.30, t));
            let lean = mix(0.55, -0.55, smooth(0.1, 0.9, 1.0 - v)) * smooth(0.1, 0.35, t);
            let slope = l.brow_upper.slope(x) * smooth(0.2, 0.5, t);
            let angle = (slope).atan() - rise - lean * 0.8 + 0.16 * dice.normal();
            let length =
                mix(7.0, 9.0, smooth(0.0, 0.4, t)) * mix(1.0, 0.62, smooth(0.6, 1.0, t)) * dice.between(0.7, 1.1);
            let bend = 0.35 * dice.between(0.2, 1.0) * smooth(0.0, 0.2, t);
            let mut points = Vec::with_capacity(6);
            let (mut px, mut py) = (x - 0.35 * length * angle.cos(), y - 0.35 * length * angle.sin());
            for k in 0..5 {
                let a = angle + bend * (k as f32 / 4.0 - 0.3);
                let lift = 0.5 + 1.1 * (k as f32 / 4.0);
                let at = head.sway(V(px * side, py, 125.0));
                let skin = on_skin(head, at.0, at.1);
                points.push(skin + V(0.0, 0.0, lift));
                px += a.cos() * length / 5.0;
                py += a.sin() * length / 5.0;
            }
            let tone = dice.between(0.8, 1.5);
            let colour = head.person.hair * tone;
            let width = head.person.brow_width * dice.between(0.75, 1.15) * mix(1.0, 0.8, t);
            all.push(Strand { points, width, colour, mass: false });
        }
    }
}

fn lashes(head: &Head, all: &mut Vec<Strand>) {
    let l = &head.lines;
    let mut dice = Dice::new(head.person.seed ^ 0x1a5);
    let (long, small) = head.person.lashes;
    for side in [-1.0f32, 1.0] {
        for (line, down, count, length) in [(&l.lid_upper, -1.0f32, 150, long), (&l.lid_lower, 1.0, 70, small)] {
            for _ in 0..count {
                let t = dice.roll();
                let t = if down < 0.0 { t.powf(0.8) } else { 0.25 + 0.75 * t };
                let x = mix(28.5, line.to - 0.3, t);
                let y = line.at(x) + down * dice.between(0.0, 0.9);
                let out = (x - EYE.0) / 20.0;
                let z =
                    EYE.2 + ((EYE_RADIUS + 2.0).powi(2) - (x - EYE.0).powi(2) - (y - EYE.1).powi(2)).max(1.0).sqrt();
                // They fan outwards, first forward and then up (or down).
                let own = length * dice.between(0.6, 1.05) * mix(0.55, 1.0, smooth(0.0, 0.55, t));
                let fan = 0.55 * out + 0.25 + 0.14 * dice.normal();
                let mut p = V(x, y, z + 0.4);
                let mut points = vec![head.sway(V(p.0 * side, p.1, p.2))];
                for k in 0..5 {
                    let u = k as f32 / 4.0;
                    let lift = down * mix(if down < 0.0 { -0.10 } else { 0.35 }, 1.0, u);
                    let d = V(fan * (0.5 + 0.5 * u), lift, mix(1.1, 0.35, u)).unit();
                    p = p + d * (own / 5.0);
                    points.push(head.sway(V(p.0 * side, p.1, p.2)));
                }
                let width = if down < 0.0 { 0.42 } else { 0.26 };
                all.push(Strand { points, width, colour: V(0.012, 0.009, 0.008), mass: false });
            }
        }
    }
}

//! Which cells are hair, skin, clothes and what is behind: colour models and what the points let expect, smoothed
//! along edges, learned anew from their own answer (as GrabCut, Rother et al. 2004, but with four classes, soft
//! labels, and a guided filter, He et al. 2013, in place of the cut).

use super::backdrop::Backdrop;
use super::frame::{Frame, Lab};
use super::mask::{CELLS, COLUMNS, ROWS, cells, cells_in, centre, column_at, per_cell, row_at};
use super::mixture::{LEAST, Mixture};
use super::shape::Shape;
use crate::face::FeaturePoint as P;
use crate::geometry::{Point, Vec2};
use crate::photo::{Mask, Plane};

/// The classes, as they index what is below.
const BACK: usize = 0;
const SKIN: usize = 1;
const HAIR: usize = 2;
const CLOTH: usize = 3;
const CLASSES: usize = 4;

/// How likely every cell is each of the four, 0 to 1.
pub(super) struct Regions {
    classes: [Plane; CLASSES],
    /// What is behind.
    pub backdrop: Backdrop,
    /// The colours of the cells.
    pub lab: Vec<Lab>,
    /// Which cells the photo shows.
    pub inside: Vec<bool>,
    /// Units from the outline of the face, negative inside it.
    pub from_face: Vec<f32>,
}

impl Regions {
    /// How likely each cell is hair.
    pub(crate) fn hair(&self) -> &[f32] {
        self.classes[HAIR].pixels()
    }

    /// How likely each cell is skin.
    pub(crate) fn skin(&self) -> &[f32] {
        self.classes[SKIN].pixels()
    }

    /// How likely each cell is what lies behind the head.
    pub(crate) fn back(&self) -> &[f32] {
        self.classes[BACK].pixels()
    }

    /// How sure the labels around a place in units are, 0 to 1.
    pub(crate) fn confidence(&self, at: Point) -> f64 {
        let (row, column) = (row_at(at.y), column_at(at.x));
        let (mut sum, mut count) = (0.0_f32, 0.0_f32);
        for r in row.saturating_sub(2)..(row + 3).min(ROWS) {
            for k in column.saturating_sub(2)..(column + 3).min(COLUMNS) {
                let best = self.classes.iter().fold(0.0_f32, |m, class| m.max(class[(k, r)]));
                sum += (2.0 * best - 1.0).max(0.0);
                count += 1.0;
            }
        }
        f64::from(sum / count.max(1.0))
    }

    /// Tells the four apart.
    pub(crate) fn of(frame: &Frame, shape: &Shape) -> Self {
        let (lab, inside) = cells(frame);
        let backdrop = Backdrop::of(&lab, &inside, shape);
        let face = cells_in(&shape.face);
        let outside = face.squared_distances();
        let within = face.not().squared_distances();
        let from_face: Vec<f32> = outside.with(&within, |o, i| 2.0 * (o.sqrt() - i.sqrt())).pixels().to_vec();
        let expected = expected(shape, &from_face);
        let guide = Guide::of(&lab);
        let behind: Vec<f32> = (0..CELLS).map(|c| backdrop.log(lab[c], c)).collect();

        let cheeks = cheeks(shape);
        let tones: Vec<(Lab, f32)> = cheeks.indices().map(|c| (lab[c], 1.0)).collect();
        let mut skin = skin_of(&tones);
        let mut shaded = shaded(skin_of(&tones));
        // Skin is learned where neither brows nor eyes, lips or beard are.
        let clear: Vec<bool> =
            (0..CELLS).map(|c| from_face[c] >= 0.0 || cheeks.pixels()[c] || centre(c).y < shape.brows - 9.0).collect();
        // What lies below the lobes or outside the face is skin in the shade as well.
        let bright: Vec<bool> = (0..CELLS).map(|c| from_face[c] < 0.0 && centre(c).y < shape.lobe).collect();
        let mut hair = first_hair(shape, &lab, &inside, &from_face, &behind, &skin);
        let mut cloth = first_cloth(shape, &lab, &inside);
        let mut classes: [Plane; CLASSES] = std::array::from_fn(|_| per_cell(|_| 0.0));
        for round in 0..3 {
            let seen: [Option<Vec<f32>>; CLASSES] = [
                None,
                Some((0..CELLS).map(|c| if bright[c] { skin.log(lab[c]) } else { shaded.log(lab[c]) }).collect()),
                hair.as_ref().map(|m| lab.iter().map(|c| m.log(*c)).collect()),
                cloth.as_ref().map(|m| lab.iter().map(|c| m.log(*c)).collect()),
            ];
            let logits: [Vec<f32>; CLASSES] = std::array::from_fn(|k| {
                (0..CELLS)
                    .map(|c| {
                        if !inside[c] {
                            return if k == BACK { 0.0 } else { -20.0 };
                        }
                        let log = match (k, &seen[k]) {
                            (BACK, _) => behind[c],
                            (_, Some(log)) => log[c],
                            (_, None) => return -20.0,
                        };
                        // No class rules a colour out: models are never whole.
                        const FLOOR: f32 = -4.0;
                        0.5 * log.max(FLOOR) + expected[k][c]
                    })
                    .collect()
            });
            classes = settled(&logits, &guide, if round == 2 { 3 } else { 2 });
            if round < 2 {
                let learn = |k: usize, parts: usize, test: &dyn Fn(usize) -> bool| {
                    let samples: Vec<(Lab, f32)> = (0..CELLS)
                        .filter(|c| c % 3 == 0 && inside[*c] && classes[k].pixels()[*c] > 0.6 && test(*c))
                        .map(|c| (lab[c], classes[k].pixels()[c]))
                        .collect();
                    Mixture::of(&samples, parts, LEAST)
                };
                // What the wall explains within some four spreads teaches nothing about hair.
                const WALL: f32 = 5.0;
                // Hair that was taken for skin must not teach what skin is.
                let apart = |c: usize| match (&seen[SKIN], &seen[HAIR]) {
                    (Some(skin), Some(hair)) => skin[c] > hair[c] - 2.0,
                    _ => true,
                };
                if let Some(found) = learn(SKIN, 3, &|c| bright[c] && clear[c] && apart(c)) {
                    skin = found;
                }
                if let Some(found) = learn(SKIN, 4, &|c| clear[c] && (from_face[c] < 10.0 || centre(c).y > shape.lobe))
                {
                    shaded = found;
                }
                hair = learn(HAIR, 3, &|c| behind[c] < WALL).map(|found| without_skin(found, &skin)).or(hair);
                cloth = learn(CLOTH, 3, &|_| true).or(cloth);
            }
        }
        Self { classes, backdrop, lab, inside, from_face }
    }
}

/// The cheeks and the back of the nose, without its wings.
fn cheeks(shape: &Shape) -> Mask {
    let p = &shape.points;
    let down = Vec2::new(0.0, 13.0);
    let wing = |side: P, base: P| Point::new(p[side].x * 1.15, p[base].y);
    let (left, right) = (wing(P::P9_2, P::P9_4), wing(P::P9_1, P::P9_5));
    let up = Vec2::new(0.0, -16.0);
    cells_in(&[
        p[P::P3_12] + down,
        p[P::P3_8] + down,
        p[P::P3_11] + down,
        p[P::P3_7] + down,
        p[P::P8_3].lerp(p[P::P2_13], 0.6),
        right + Vec2::new(6.0, 0.0),
        right + up,
        left + up,
        left - Vec2::new(6.0, 0.0),
        p[P::P8_4].lerp(p[P::P2_14], 0.6),
    ])
}

/// Skin as the cheeks show it.
fn skin_of(cheeks: &[(Lab, f32)]) -> Mixture {
    let mixture = Mixture::of(cheeks, 2, [0.03, 0.01, 0.01]);
    mixture.unwrap_or_else(|| Mixture::single([0.7, 0.03, 0.04], [0.1, 0.02, 0.02]))
}

/// The same also in the shade: less light scales all of OKLab alike.
fn shaded(mixture: Mixture) -> Mixture {
    let tone = mixture.heaviest();
    let shade = |share: f32| tone.map(|v| v * share);
    mixture.with(shade(0.85), [0.06, 0.015, 0.015], 0.15).with(shade(0.7), [0.06, 0.015, 0.015], 0.05)
}

/// Hair as the ring above the hairline shows it, what is skin or background left out.
fn first_hair(
    shape: &Shape,
    lab: &[Lab],
    inside: &[bool],
    from_face: &[f32],
    behind: &[f32],
    skin: &Mixture,
) -> Option<Mixture> {
    // A colour of which nothing is known, spread over what hair can be.
    const ANY: f32 = 4.5;
    let ring: Vec<(Lab, f32)> = (0..CELLS)
        .filter(|c| inside[*c] && (6.0..42.0).contains(&from_face[*c]) && centre(*c).y < shape.ear_top)
        .map(|c| (lab[c], 1.0 / (1.0 + (behind[c] - ANY).exp() + (skin.log(lab[c]) - ANY).exp())))
        .collect();
    Mixture::of(&ring, 3, LEAST).map(|found| without_skin(found, skin))
}

/// Hair without what is as like skin as skin is: points that are off let some of it in. A shaved head keeps it, as
/// there is little else.
fn without_skin(hair: Mixture, skin: &Mixture) -> Mixture {
    // Skin peaks near 8.5; this is about 2.4 spreads away.
    const LIKE_SKIN: f32 = 5.5;
    hair.without(|mean| skin.log(mean) > LIKE_SKIN)
}

/// Clothes as the lowest 40 units that the photo shows of the frame have them, beside the neck.
fn first_cloth(shape: &Shape, lab: &[Lab], inside: &[bool]) -> Option<Mixture> {
    let shown = |row: usize| inside[row * COLUMNS..(row + 1) * COLUMNS].iter().filter(|i| **i).count() > COLUMNS / 3;
    let last = (0..ROWS).rev().find(|row| shown(*row))?;
    let top = (shape.chin + 20.0).max(centre(last * COLUMNS).y - 40.0);
    let samples: Vec<(Lab, f32)> = (0..CELLS)
        .filter(|c| {
            c % 2 == 0 && inside[*c] && {
                let p = centre(*c);
                p.y > top && (0.9 * shape.half_jaw..200.0).contains(&p.x.abs())
            }
        })
        .map(|c| (lab[c], 1.0))
        .collect();
    Mixture::of(&samples, 3, LEAST)
}

/// What the points let expect of every cell: logarithms of odds, by class.
fn expected(shape: &Shape, from_face: &[f32]) -> [Vec<f32>; CLASSES] {
    let p = &shape.points;
    let ears = [[p[P::P10_2], p[P::P10_4], p[P::P10_6]], [p[P::P10_1], p[P::P10_3], p[P::P10_5]]]
        .map(|[top, out, lobe]| cells_in(&ear(top, out, lobe)));
    let mut found: [Vec<f32>; CLASSES] = std::array::from_fn(|_| vec![0.0; CELLS]);
    for c in 0..CELLS {
        let at = centre(c);
        let off = from_face[c];
        let ear = ears.iter().any(|e| e.pixels()[c]);
        let [back, skin, hair, cloth] = odds(shape, at, off, ear);
        found[BACK][c] = back;
        found[SKIN][c] = skin;
        found[HAIR][c] = hair;
        found[CLOTH][c] = cloth;
    }
    found
}

/// The area of an ear.
pub(super) fn ear(top: Point, out: Point, lobe: Point) -> [Point; 5] {
    let side = out.x.signum();
    let by = |p: Point, x: f64, y: f64| p + Vec2::new(side * x, y);
    [top, by(out, 3.0, 0.0), by(out.midpoint(lobe), 3.0, 0.0), by(lobe, -2.0, 2.0), by(top, -6.0, 6.0)]
}

/// Background, skin, hair, clothes at one place, `off` units from the face's outline.
fn odds(shape: &Shape, at: Point, off: f32, ear: bool) -> [f32; CLASSES] {
    let (x, y) = (at.x.abs(), at.y);
    // Shoulders begin between lobes and chin at the highest.
    let cloth = if y < shape.chin {
        -6.0 + 5.5 * ((y - shape.lobe) / (shape.chin - shape.lobe).max(10.0)).clamp(0.0, 1.0)
    } else {
        -0.5 + 0.5 * ((y - shape.chin) / 30.0).min(1.0)
    } as f32;
    if off < 0.0 {
        let deep = -off;
        let mouth = shape.points[P::P9_15].y;
        let hair = if y < shape.brows - 6.0 {
            -0.7 - (deep / 60.0).min(0.8)
        } else if y > mouth && x < 0.8 * shape.half_jaw {
            -6.0
        } else if y > shape.lobe {
            -(3.0 + deep / 5.0).min(6.0)
        } else {
            -(0.7 + deep / 5.0).min(6.0)
        };
        return [-2.0 - deep.min(6.0), 0.3, hair, -8.0];
    }
    if ear {
        return [-1.5, 0.5, 0.0, -8.0];
    }
    let middle = (shape.ear_top + shape.lobe) / 2.0;
    if y < middle {
        let back = -1.5 + (off / 40.0).min(2.0);
        return [back, -0.5 - (off / 14.0).min(4.0), 0.6 - (off / 120.0).min(1.5), -8.0];
    }
    if x < 0.85 * shape.half_jaw {
        return [-3.0, 1.0, -3.0, cloth];
    }
    let back = -1.0 + (off / 40.0).min(1.5);
    // Hair may fall on the shoulders, but dark clothes are likelier the farther down.
    let low = ((y - shape.chin) / 40.0).clamp(0.0, 2.0) as f32;
    [back, -0.8 - off / 40.0, -(off / 80.0).min(2.0) - low, cloth]
}

/// The lightness that smoothing follows, and its local mean and spread.
struct Guide {
    light: Plane,
    mean: Plane,
    inverse: Plane,
}

/// Half a window of the guided filter, in cells.
const REACH: usize = 4;

impl Guide {
    fn of(lab: &[Lab]) -> Self {
        // Lightness steps below 0.03 are no edges.
        const FLAT: f32 = 0.03 * 0.03;
        let light = per_cell(|c| lab[c][0]);
        let mean = light.boxed(REACH);
        let squares = light.map(|v| v * v).boxed(REACH);
        let inverse = squares.with(&mean, |s, m| 1.0 / ((s - m * m).max(0.0) + FLAT));
        Self { light, mean, inverse }
    }

    /// `field` smoothed, edges of the lightness kept.
    fn filter(&self, field: &Plane) -> Plane {
        let [light, own, inverse] = [&self.light, &self.mean, &self.inverse].map(Plane::pixels);
        let (mean, joint) = (field.boxed(REACH), field.with(&self.light, |f, g| f * g).boxed(REACH));
        let (mean, joint) = (mean.pixels(), joint.pixels());
        let slope = per_cell(|c| (joint[c] - mean[c] * own[c]) * inverse[c]);
        let offset = per_cell(|c| mean[c] - slope.pixels()[c] * own[c]);
        let (slope, offset) = (slope.boxed(REACH), offset.boxed(REACH));
        per_cell(|c| slope.pixels()[c] * light[c] + offset.pixels()[c])
    }
}

/// Mean field: every cell agrees with its neighbours on the same side of edges.
fn settled(logits: &[Vec<f32>; CLASSES], guide: &Guide, rounds: usize) -> [Plane; CLASSES] {
    // How much neighbours weigh against a cell's own colour.
    const AGREE: f32 = 4.0;
    let mut labels = softmax(logits);
    for _ in 0..rounds {
        // The filter is linear and keeps constants: as labels add up to 1, so do smooth ones, and the last is the rest.
        let mut rest = vec![1.0_f32; CELLS];
        let mut pulled = logits.clone();
        for k in 0..CLASSES - 1 {
            let smooth = guide.filter(&labels[k]);
            for (c, s) in smooth.pixels().iter().enumerate() {
                pulled[k][c] += AGREE * s;
                rest[c] -= s;
            }
        }
        pulled[CLASSES - 1].iter_mut().zip(rest).for_each(|(l, s)| *l += AGREE * s);
        labels = softmax(&pulled);
    }
    labels
}

fn softmax(logits: &[Vec<f32>; CLASSES]) -> [Plane; CLASSES] {
    let shares = per_cell(|c| {
        let four: [f32; CLASSES] = std::array::from_fn(|k| logits[k][c]);
        let most = four.iter().fold(f32::NEG_INFINITY, |m, v| m.max(*v));
        let e = four.map(|v| if v - most < -12.0 { 0.0 } else { (v - most).exp() });
        let sum: f32 = e.iter().sum();
        e.map(|v| v / sum)
    });
    std::array::from_fn(|k| shares.map(|four| four[k]))
}

//! The face's skin: one light from the upper left, cheeks, the shade of the eye sockets, the contour, and the folds
//! of an older face.

use super::head::Outline;
use super::{Pen, at};
use crate::drawing::{Item, Oklch};
use crate::face::{FeaturePoint as P, Points, Units};
use crate::geometry::{Point, Vec2, brush, brush_in_steps, spline};

/// How far the shaded edge reaches in from the right and from below.
const LIGHT: Vec2 = Vec2::new(7.5, 4.5);

/// The skin under everything that lies on it.
pub(super) fn skin(pen: &Pen, outline: &Outline) -> Vec<Item> {
    let mut items = vec![Item::area("face", outline.path(), pen.palette.skin)];
    if !pen.ink_only {
        items.push(Item::area("face-shade", outline.shaded(LIGHT, f64::MIN), pen.palette.shade));
    }
    items
}

/// The skin of the lower face again, below a height, where the chin has come down.
pub(super) fn lower(pen: &Pen, outline: &Outline, from: f64) -> Vec<Item> {
    let mut items = vec![Item::area("jaw", outline.below(from), pen.palette.skin)];
    if !pen.ink_only {
        items.push(Item::area("jaw-shade", outline.shaded(LIGHT, from - 6.0), pen.palette.shade));
    }
    items
}

/// Cheeks under the outer half of the eyes.
pub(super) fn blush(pen: &Pen, points: &Points, outline: &Outline) -> Vec<Item> {
    cheeks(pen, points, outline, 0.0, 0.38)
}

/// What raised cheeks add, from 0 to 1.
pub(super) fn raised_cheeks(pen: &Pen, points: &Points, outline: &Outline, raised: f64) -> Vec<Item> {
    if raised < 0.02 { Vec::new() } else { cheeks(pen, points, outline, 5.0 * raised, 0.24 * raised) }
}

fn cheeks(pen: &Pen, points: &Points, outline: &Outline, up: f64, cover: f64) -> Vec<Item> {
    if pen.ink_only {
        return Vec::new();
    }
    let spot = |eye: P, wing: P| {
        let middle = at(1.16 * points[eye].x, 0.88 * points[wing].y - up);
        // A glow that ran over the edge would lie on the ear.
        let room = outline.half_width(middle.y) - middle.x.abs();
        let radii = Vec2::new(30f64.min(room - 1.0), 21.0);
        Item::glow("blush", middle, radii, pen.palette.blush.faded(cover))
    };
    vec![spot(P::P3_6, P::P9_2), spot(P::P3_5, P::P9_1)]
}

/// Where skin shines in the light from the upper left: forehead and cheekbone. On dark skin this is what models the
/// face, since its shades can hardly be seen.
pub(super) fn lights(pen: &Pen, points: &Points, hairline: f64) -> Vec<Item> {
    if pen.ink_only {
        return Vec::new();
    }
    let cover = if Oklch::from(pen.palette.skin).l < 0.6 { 0.34 } else { 0.22 };
    let light = pen.palette.light.faded(cover);
    let (eye, brow) = (points[P::P3_6], points[P::P4_4].y);
    let high = (brow - hairline).max(12.0);
    let forehead = at(0.45 * eye.x, brow - 0.48 * high);
    let cheek = at(1.06 * eye.x, 0.50 * points[P::P9_2].y);
    vec![
        Item::glow("forehead-light", forehead, Vec2::new(46.0, 0.40 * high), light),
        Item::glow("cheek-light", cheek, Vec2::new(22.0, 10.0), light),
    ]
}

/// Soft shade between brow, inner corner and lid. It keeps to the neutral lid: shade that moved with a blink would
/// flicker.
pub(super) fn sockets(pen: &Pen, points: &Points) -> Vec<Item> {
    if pen.ink_only {
        return Vec::new();
    }
    let one = |inner: P, outer: P, brow: P, sign: f64| {
        let (inner, brow) = (points[inner], points[brow]);
        let middle = inner.midpoint(points[outer]);
        let shade = [
            brow + Vec2::new(sign * 3.0, 4.0),
            inner.midpoint(brow) + Vec2::new(-sign * 3.0, 1.0),
            inner + Vec2::new(-sign * 2.5, 2.0),
            inner.midpoint(middle) + Vec2::new(0.0, 2.0),
            middle + Vec2::new(sign * 4.0, 0.0),
            middle.midpoint(inner) - Vec2::new(0.0, 0.55 * (inner.y - brow.y)),
        ];
        Item::area("socket", spline(&shade, true), pen.palette.shade.faded(0.42))
    };
    vec![one(P::P3_8, P::P3_12, P::P4_2, -1.0), one(P::P3_11, P::P3_7, P::P4_1, 1.0)]
}

/// The ink in front of the ears, down to where the cheeks begin to move.
pub(super) fn cheek_lines(pen: &Pen, outline: &Outline) -> Vec<Item> {
    outline.cheeks().into_iter().map(|line| pen.line("cheek", &line, 1.15, &[0.1, 0.7, 0.8, 0.2])).collect()
}

/// The ink from lobe to lobe, heavy at the jaw; and the dimple of the chin.
pub(super) fn contour(pen: &Pen, outline: &Outline, points: &Points) -> Vec<Item> {
    const PROFILE: [f64; 9] = [0.55, 0.85, 0.95, 1.0, 1.0, 1.0, 0.95, 0.85, 0.55];
    let ink = brush_in_steps(&outline.jaw_line(), 1.15 * pen.ink, &PROFILE, 25);
    let (lip, chin) = (points[P::P8_2], points[P::P2_1]);
    let high = chin.y - lip.y;
    let dimple = [(-8.0, 0.30), (0.0, 0.36), (8.0, 0.30)].map(|(x, y)| lip + Vec2::new(x, y * high));
    let mark = brush(&dimple, 0.9 * pen.ink, &[0.0, 1.0, 0.0]);
    let colour = if pen.ink_only { pen.palette.line } else { pen.palette.shade.faded(0.8) };
    vec![Item::area("contour", ink, pen.palette.line), Item::area("chin", mark, colour)]
}

/// What years draw: folds from the wings of the nose to the mouth, under the eyes, and across the forehead. `amount`
/// is 0 for none, 1 for deep ones.
pub(super) fn folds(pen: &Pen, points: &Points, units: &Units, amount: f64) -> Vec<Item> {
    if amount <= 0.0 {
        return Vec::new();
    }
    let colour = if pen.ink_only { pen.palette.line } else { pen.palette.deep.faded(0.30 + 0.5 * amount) };
    let mut items = Vec::new();
    let mut fold = |line: &[Point], width: f64| {
        let ink = brush(line, width * pen.ink * (0.6 + 0.4 * amount), &[0.0, 1.0, 0.7, 0.0]);
        items.push(Item::area("fold", ink, colour));
    };
    for (sign, wing, corner, inner, outer, low) in
        [(-1.0, P::P9_2, P::P8_4, P::P3_8, P::P3_12, P::P3_4), (1.0, P::P9_1, P::P8_3, P::P3_11, P::P3_7, P::P3_3)]
    {
        let (wing, corner) = (points[wing], points[corner]);
        let to = wing.lerp(corner, 0.62 + 0.2 * amount);
        let between = wing.lerp(to, 0.5) + Vec2::new(sign * 7.0, -3.0);
        fold(&[wing + Vec2::new(sign * 3.5, -4.0), between, to + Vec2::new(sign * 8.0, 0.0)], 0.9);
        let (inner, outer, low) = (points[inner], points[outer], points[low]);
        let drop = 0.5 * units.left_eye_height.max(units.right_eye_height);
        let under = [
            inner.lerp(outer, 0.16) + Vec2::new(0.0, 0.75 * drop),
            at(low.x, low.y + 0.95 * drop),
            inner.lerp(outer, 0.80) + Vec2::new(0.0, 1.05 * drop),
        ];
        fold(&under, 0.75);
    }
    if amount > 0.5 {
        let (brow, hairline) = (points[P::P4_4].y.min(points[P::P4_3].y), points[P::P11_1].y);
        for (share, wide) in [(0.40, 0.42), (0.58, 0.36)] {
            let y = brow + share * (hairline - brow);
            let reach = wide * units.eye_separation;
            fold(&[at(-reach, y + 2.0), at(-0.4 * reach, y), at(0.3 * reach, y + 1.0), at(reach, y + 2.5)], 0.7);
        }
    }
    items
}

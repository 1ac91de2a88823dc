//! What the skin looks like at a place: its colour by zones, its gloss, and the fine relief of its pores.

use crate::head::Head;
use crate::noise::{Dice, cloud, grain};
use crate::vector::{V, mix, smooth, spot};

/// Colour (linear albedo), roughness and strength of the gloss.
pub struct Surface {
    pub albedo: V,
    pub rough: f32,
    pub gloss: f32,
}

/// Small dark spots that belong to one person: place in the picture's plane, radius, depth.
pub fn moles(seed: u64) -> Vec<(f32, f32, f32, f32)> {
    let mut dice = Dice::new(seed ^ 0x301e);
    (0..90)
        .map(|i| {
            let big = i < 3;
            let r = if big { dice.between(0.9, 1.3) } else { dice.between(0.45, 0.8) };
            let depth = if big { 0.45 } else { dice.between(0.10, 0.40) };
            // Most are freckles where the sun falls: over nose and cheeks.
            if i % 3 == 0 {
                (dice.between(-85.0, 85.0), dice.between(-70.0, 150.0), r, depth)
            } else {
                (44.0 * dice.normal(), 46.0 + 15.0 * dice.normal(), r, depth)
            }
        })
        .collect()
}

pub fn at(head: &Head, moles: &[(f32, f32, f32, f32)], place: V) -> Surface {
    let who = &head.person;
    let q = head.rest(place);
    let pattern = head.pattern(place);
    let f = q.folded();
    let (x, y) = (f.0, f.1);
    let l = &head.lines;
    let front = smooth(30.0, 70.0, q.2);
    let patches = cloud(pattern * 0.045);
    let fine = cloud(pattern * 0.3);

    // Blood near the surface: redder; its lack over bone: yellower.
    let mut red = 0.0;
    red += 0.42 * spot(((x - 62.0) / 34.0).hypot((y - 50.0) / 30.0)) * front;
    red += 0.5 * spot((x / 17.0).hypot((y - 54.0) / 15.0)) * front;
    red += 0.35 * spot(((x - 20.0) / 9.0).hypot((y - 60.0) / 9.0)) * front;
    red += 0.25 * spot((x / 26.0).hypot((y - 158.0) / 18.0)) * front;
    red += 0.25 * spot((x / 44.0).hypot((y - 100.0) / 26.0)) * front;
    red += 0.6 * smooth(104.0, 116.0, x) * smooth(-15.0, 5.0, y) * smooth(90.0, 70.0, y);
    red -= 0.18 * smooth(-30.0, -60.0, y) * front;
    red += 0.16 * patches;
    let red = red * who.blush;
    let mut c = who.skin.by(V(1.0 + 0.02 * red, 1.0 - 0.24 * red, 1.0 - 0.22 * red));

    // The scalp is dark with roots.
    let scalp = smooth(-1.0, 12.0, head.within_hairline(place)) * smooth(110.0, 70.0, y);
    c = c.lerp(who.hair * 1.6, who.scalp * scalp);

    // Around the eye: brownish on the lid, bluish in the hollow under it.
    let lid = front * smooth(-14.0, -8.0, l.crease.below(x, y)) * smooth(14.0, 6.0, l.lid_lower.below(x, y));
    let lid = lid * smooth(20.0, 28.0, x) * smooth(80.0, 68.0, x);
    c = c.by(V::all(1.0).lerp(V(0.93, 0.87, 0.86), lid));
    let hollow = front * spot((l.lid_lower.below(x, y) - 9.0) / 6.0) * smooth(24.0, 32.0, x) * smooth(66.0, 48.0, x);
    c = c.by(V::all(1.0).lerp(V(0.94, 0.91, 0.94), hollow));
    // The groove of the lid keeps a darker line, and the lashes' roots darken the margin.
    let in_eye = smooth(24.0, 27.0, x) * smooth(71.0, 67.0, x) * front;
    let groove = spot(l.crease.below(x, y) / 1.3) * smooth(28.0, 34.0, x) * smooth(74.0, 66.0, x) * front;
    c = c.by(V::all(1.0).lerp(V(0.60, 0.54, 0.53), 0.5 * groove));
    let margin = l.aperture(x, y);
    let upper = smooth(3.6, 0.8, margin) * smooth(1.5, -1.0, l.lid_upper.below(x, y)) * in_eye;
    c = c.by(V::all(1.0).lerp(V(0.16, 0.12, 0.11), 0.9 * upper * smooth(25.0, 36.0, x)));
    let rim = smooth(1.3, 0.2, margin) * smooth(0.0, 2.0, l.lid_upper.below(x, y)) * in_eye;
    c = c.lerp(who.skin.by(V(1.02, 0.76, 0.74)), 0.8 * rim);
    let lower = spot((margin - 2.0) / 1.2) * smooth(2.0, 4.0, l.lid_upper.below(x, y)) * in_eye;
    c = c.by(V::all(1.0).lerp(V(0.55, 0.45, 0.43), 0.6 * lower * smooth(30.0, 50.0, x)));

    // Under the brow hairs the skin is tinted.
    let (top, low) = (l.brow_upper.below(x, y), -l.brow_lower.below(x, y));
    let brow = smooth(-1.5, 2.5, top.min(low)) * smooth(18.0, 28.0, x) * smooth(91.0, 78.0, x) * front;
    c = c.lerp(who.hair.lerp(who.skin, 0.2), 0.48 * brow);

    // A shaved beard greys the jaw.
    if who.stubble > 0.0 {
        let side = smooth(58.0, 92.0, y - 0.35 * (x - 40.0).abs());
        let lip = smooth(70.0, 78.0, y) * smooth(52.0, 40.0, x);
        let beard = side.max(lip) * smooth(195.0, 165.0, y) * smooth(0.0, 30.0, q.2);
        let dots = 0.75 + 0.5 * grain(pattern * 1.1);
        c = c.by(V::all(1.0).lerp(V(0.62, 0.62, 0.66), who.stubble * beard * dots));
    }

    let mut rough = 0.46 + 0.05 * fine;
    let mut gloss = 0.88 + 0.22 * fine;
    gloss += 0.35 * (spot(x / 12.0) * smooth(-60.0, -20.0, y) * smooth(64.0, 50.0, y)) * front;
    gloss += 0.25 * spot((x / 50.0).hypot((y + 62.0) / 30.0)) * front;
    gloss *= 1.0 - 0.6 * lid.max(hollow);

    // Blotches, pores, freckles.
    c = c * (1.0 + 0.06 * patches + 0.09 * fine + 0.06 * grain(pattern * 0.9));
    for (mx, my, r, depth) in moles {
        let d = ((q.0 - mx) / r).hypot((q.1 - my) / r);
        if d < 3.0 {
            c = c.by(V::all(1.0).lerp(V(0.45, 0.33, 0.30), front * depth * spot(d)));
        }
    }

    let lips = if who.open > 0.0 || head.gape() > 0.0 || (x < 42.0 && y > 80.0 && y < 126.0) {
        l.on_lips(x, y, 1.7) * front
    } else {
        0.0
    };
    if lips > 0.0 {
        let lines = 1.0 + 0.09 * grain(V(q.0 * 0.7, q.1 * 0.12, 3.0)) + 0.05 * fine;
        let seam = spot(l.lip_line.below(x, y) / 1.5);
        let shade = if y < l.lip_line.at(x) { 0.88 } else { 1.04 };
        let lip = who.lips * (lines * shade * (1.0 - 0.55 * seam));
        c = c.lerp(lip, lips * 0.92);
        rough = mix(rough, 0.42, lips);
        gloss = mix(gloss, if y < l.lip_line.at(x) { 0.42 } else { 0.7 }, lips);
    }
    // Between the lips and in the nostrils little light is left.
    let hole = spot(((x - 9.6 * who.nose) / (4.6 * who.nose)).hypot((y - 65.2) / 3.2)) * front;
    c = c * (1.0 - 0.72 * hole);
    Surface { albedo: c, rough, gloss }
}

/// How pores and lines bend the surface: a vector to add to the outward direction.
pub fn relief(place: V, strength: f32) -> V {
    let at = |p: V| grain(p * 0.85) * 0.6 + grain(p * 1.7) * 0.4;
    let e = 0.35;
    let here = at(place);
    V(at(place + V(e, 0.0, 0.0)) - here, at(place + V(0.0, e, 0.0)) - here, at(place + V(0.0, 0.0, e)) - here)
        * (-strength / e)
}

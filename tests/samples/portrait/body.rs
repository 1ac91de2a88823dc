//! Neck, shoulders and a plain shirt, as distances.

use crate::noise::cloud;
use crate::vector::{V, ball, join, limb, smooth};

/// Signed distance from the skin of neck and chest; `wide` is the neck's width as a part of the average.
pub fn skin(p: V, wide: f32) -> f32 {
    let f = p.folded();
    // The neck is an upright oval that leans back as it goes down.
    let t = smooth(60.0, 240.0, p.1);
    let flare = 10.0 * smooth(175.0, 235.0, p.1);
    let axis = V(0.0, 0.0, -14.0 - 30.0 * t);
    let (dx, dz) = (f.0, p.2 - axis.2);
    let neck = ((dx / (61.0 * wide + flare)).hypot(dz / 60.0) - 1.0) * 58.0;
    let neck = neck.max(60.0 - p.1);
    // From behind the ear to the notch between the collarbones.
    let cord = limb(f, V(62.0 * wide, 90.0, -22.0), V(16.0, 246.0, 18.0), 13.0, 9.0);
    let neck = join(neck, cord, 12.0);
    let torso = torso(f, wide);
    let bone = limb(f, V(20.0, 256.0, 24.0), V(92.0, 256.0, -16.0), 7.0, 5.0);
    join(neck, join(torso, bone, 18.0), 26.0)
}

/// Shoulders and chest without what only bare skin shows.
fn torso(f: V, wide: f32) -> f32 {
    let slope = limb(f, V(44.0, 216.0, -58.0), V(240.0, 306.0, -58.0), 40.0 * wide, 34.0);
    // Below the widest place chest and arms go on as columns, out of the frame.
    let chest = ball(V(f.0, f.1.min(430.0), f.2), V(0.0, 430.0, -28.0), V(240.0, 205.0, 92.0));
    let arm = V(f.0 - 0.10 * (f.1 - 356.0).max(0.0), f.1.min(356.0), f.2);
    let shoulder = ball(arm, V(214.0 + 26.0 * wide, 356.0, -54.0), V(66.0, 100.0, 66.0));
    join(join(slope, chest, 46.0), shoulder, 44.0)
}

/// Signed distance from the shirt, which lies on the body below a neckline.
pub fn shirt(p: V, wide: f32) -> f32 {
    let f = p.folded();
    let root = ((f.0 / (70.0 * wide)).hypot((p.2 + 42.0) / 58.0) - 1.0) * 56.0;
    let cloth = join(torso(f, wide), root.max(195.0 - p.1), 26.0);
    if cloth > 40.0 {
        return cloth - 8.0;
    }
    // Hanging folds: long in y, thin across.
    let hang = smooth(200.0, 300.0, p.1);
    let folds = 4.5 * cloud(V(p.0 * 0.024 + p.1 * 0.004, p.1 * 0.009, p.2 * 0.012)) * hang;
    let thick = cloth - 4.5 - folds;
    // The neckline is an upright oval round the foot of the neck, cut out of the cloth.
    let edge = (1.0 - (p.0 / 94.0).hypot((p.2 + 24.0) / 58.0)) * 60.0;
    // A hem, thicker than the cloth.
    let hem = ((edge + 5.0).hypot(cloth - 3.0) - 4.2) * 0.85;
    join(-join(-thick, -edge, 2.0), hem, 2.0)
}

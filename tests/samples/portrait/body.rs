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
    let slope = limb(f, V(30.0, 175.0, -55.0), V(225.0, 268.0, -58.0), 44.0 * wide, 36.0);
    let chest = ball(f, V(0.0, 430.0, -28.0), V(255.0, 205.0, 92.0));
    let shoulder = ball(f, V(236.0 * wide, 330.0, -52.0), V(72.0, 96.0, 70.0));
    let torso = join(join(slope, chest, 46.0), shoulder, 44.0);
    let bone = limb(f, V(20.0, 256.0, 24.0), V(180.0, 246.0, -14.0), 7.0, 8.0);
    let torso = join(torso, bone, 18.0);
    join(neck, torso, 26.0)
}

/// Signed distance from the shirt, which lies on the skin below a neckline.
pub fn shirt(p: V, skin: f32) -> f32 {
    if skin > 40.0 || p.1 < 150.0 {
        return skin.max(150.0 - p.1);
    }
    // Hanging folds: long in y, thin across.
    let hang = smooth(200.0, 300.0, p.1);
    let folds = 3.2 * cloud(V(p.0 * 0.024 + p.1 * 0.004, p.1 * 0.009, p.2 * 0.012)) * hang;
    let thick = skin - 4.0 - folds;
    // The neckline is where a sloping plane meets the neck; it dips a little at the front.
    let front = smooth(-20.0, 60.0, p.2);
    let line = 231.0 + 0.40 * p.2 + front * 14.0;
    let edge = (line - p.1) * 0.85;
    // A hem, thicker than the cloth.
    let hem = ((p.1 - line - 5.0).hypot(skin - 2.5) - 4.2) * 0.85;
    join(-join(-thick, -edge, 2.0), hem, 2.0)
}

//! What lies between the lids: sclera, iris, pupil, the pink corner, and the window light on it.

use crate::head::{EYE, EYE_RADIUS, Head, IRIS};
use crate::noise::{cloud, grain};
use crate::skin::Surface;
use crate::vector::{V, mix, smooth, spot};

/// The surface at `place` on a ball, and the direction in which the wet cornea faces there.
pub fn at(head: &Head, place: V) -> (Surface, V) {
    let who = &head.person;
    let q = head.rest(place);
    let side = q.0.signum();
    let f = q.folded();
    // Of a gaze straight ahead the iris lies where the ball is nearest.
    let (dx, dy) = (f.0 - EYE.0 + 0.4 - side * head.act.gaze_x, f.1 - 0.6 - head.act.gaze_y);
    let r = dx.hypot(dy);
    let turn = dy.atan2(dx);

    // White that is never white: pink towards the corners, veined, shaded by the ball's own roundness.
    let corner = smooth(9.0, 20.0, dx.abs());
    let vein = smooth(0.25, 0.6, cloud(V(q.0 * 0.5, q.1 * 0.9, 3.0)).abs()) * corner;
    let white = V(0.57, 0.52, 0.485).lerp(V(0.50, 0.33, 0.29), 0.45 * corner + 0.18 * vein);

    // The iris: darker rim, lighter ring about the pupil, fibres between.
    let fibre = grain(V(turn.cos() * 9.0, turn.sin() * 9.0, r * 0.35 + 5.0 * side));
    let ring = smooth(IRIS * 0.78, IRIS * 0.40, r);
    let mut iris = who.iris * (0.62 + 0.35 * fibre + 0.6 * ring * (0.6 + 0.4 * fibre));
    // Light from above gathers at the far side of the lens.
    iris = iris * (1.0 + 0.6 * smooth(0.0, IRIS, dy) * smooth(IRIS, IRIS * 0.6, r));
    iris = iris * mix(1.0, 0.28, smooth(IRIS * 0.74, IRIS * 0.98, r));
    let pupil = smooth(3.5, 2.7, r);
    iris = iris.lerp(V::all(0.004), pupil);
    let mut c = white.lerp(iris, smooth(IRIS + 0.75, IRIS - 0.6, r));

    // The caruncle, pink and wet in the inner corner.
    let pink = spot(((f.0 - 26.8) / 3.4).hypot((f.1 - 6.0) / 3.2));
    c = c.lerp(who.skin.by(V(0.95, 0.52, 0.48)), pink.min(0.9));
    // The upper lid and its lashes shade what is under them; the lower lid a little.
    let l = &head.lines;
    let under = l.lid_upper.below(f.0, f.1);
    c = c * mix(0.34, 1.0, smooth(-0.3, 5.0, under));
    c = c * mix(0.62, 1.0, smooth(0.0, 2.6, -l.lid_lower.below(f.0, f.1)));
    c = c * mix(0.7, 1.0, smooth(66.0, 56.0, f.0));

    // The cornea is a smaller ball set on the larger.
    let ball = (f - EYE) * (1.0 / EYE_RADIUS);
    let cornea = V(dx, dy, 0.0) * (1.0 / 12.5);
    let t = smooth(IRIS + 2.5, IRIS - 1.0, r);
    let flat = V(ball.0, ball.1, 0.0).lerp(cornea, t);
    let facing = V(flat.0 * side, flat.1, (1.0 - flat.0 * flat.0 - flat.1 * flat.1).max(0.05).sqrt()).unit();
    (Surface { albedo: c, rough: 0.08, gloss: 1.0 }, facing)
}

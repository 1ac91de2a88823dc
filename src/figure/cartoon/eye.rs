//! The eyes: white, iris and pupil between the lids, lashes, crease (recipe part 5).

use super::Palette;
use crate::drawing::Item;
use crate::face::rig::Eye;
use crate::geometry::{
    BezPath, Circle, CubicBez, Ellipse, ParamCurve, PathEl, Point, Shape, Vec2, brush, lerp, spline,
};

/// Below this opening, in face units, the ink of the lids covers what lies between them.
const SLIVER: f64 = 0.8;

/// One eye, back to front. `ink` is the width of the face's ink in face units, `ink_only` whether the style has no
/// colours.
pub(super) fn eye(eye: &Eye, palette: &Palette, ink: f64, ink_only: bool) -> Vec<Item> {
    let side = if eye.side < 0.0 { "left" } else { "right" };
    let name = |what: &str| format!("{side}-{what}");
    let mut items = Vec::with_capacity(8);
    if eye.closed > 0.0 && !ink_only {
        items.push(Item::area(name("lid"), lid(eye, ink), palette.skin.faded(0.75 * eye.closed)));
    }
    if eye.opening() > SLIVER {
        let opening = between(&eye.upper, &eye.lower);
        let mut inside = vec![Item::area(name("eye-shade"), opening.clone(), palette.sclera_shade)];
        let low = crate::geometry::Affine::translate((0.0, 0.20 * eye.height));
        inside.push(Item::area(name("eye-white"), low * &opening, palette.sclera));
        if ink_only {
            inside[0] = Item::area(name("eye-white"), opening.clone(), palette.sclera);
        }
        inside.extend(iris(eye, palette, ink, ink_only, &name));
        items.push(Item::clipped(name("eye"), opening, inside));
        if !ink_only {
            let inner = eye.inner();
            let pink = [(0.2, 0.0), (3.4, -1.1), (3.2, 1.5)].map(|(x, y)| inner + Vec2::new(eye.side * x, y));
            let fade = 0.8 * (1.0 - eye.closed);
            items.push(Item::area(name("eye-corner"), spline(&pink, true), palette.blush.faded(fade)));
        }
    }
    let thin = if ink_only { palette.ink } else { palette.line };
    let below = samples(&eye.lower, 0.25, 1.0, 9);
    items.push(Item::area(name("lid-lower"), brush(&below, 0.8 * ink, &[0.0, 0.7, 0.9, 0.5]), thin.faded(0.85)));
    items.push(Item::area(name("lid-upper"), upper_lid(eye, ink), palette.ink));
    items.push(Item::area(name("lid-crease"), crease(eye, ink), thin.faded(0.8)));
    items
}

/// The skin of the upper lid, which comes down over the eye into the light.
fn lid(eye: &Eye, ink: f64) -> BezPath {
    let up = Vec2::new(0.0, -0.9 * ink);
    let c = eye.crease;
    between(&CubicBez::new(eye.upper.p0, c.p1 + up, c.p2 + up, eye.upper.p3), &eye.upper)
}

/// Heavy, tapering to the nose, drawn a little past the outer corner: up when open, down when closed.
fn upper_lid(eye: &Eye, ink: f64) -> BezPath {
    let mut line = samples(&eye.upper, 0.0, 1.0, 13);
    let past = Vec2::new(1.3 * eye.side, 0.5 * (2.0 * eye.closed - 1.0)) * ink;
    line.push(eye.outer() + past);
    for p in &mut line {
        p.y -= 0.4;
    }
    brush(&line, ink * lerp(2.35, 1.8, eye.closed), &[0.18, 0.7, 1.0, 1.0, 0.8, 0.05])
}

fn crease(eye: &Eye, ink: f64) -> BezPath {
    let mut line = samples(&eye.crease, 0.18, 0.95, 9);
    for p in &mut line {
        p.y -= 0.9 * ink;
    }
    brush(&line, 0.72 * ink, &[0.0, 0.8, 1.0, 0.2])
}

/// Iris and pupil under the shadow of the lid, and last the lights, at the same side in both eyes.
fn iris(eye: &Eye, palette: &Palette, ink: f64, ink_only: bool, name: &dyn Fn(&str) -> String) -> Vec<Item> {
    let (at, r) = (eye.iris, eye.radius);
    let disc = |x: f64, y: f64, radius: f64| Circle::new(at + Vec2::new(x, y) * r, radius * r).to_path(0.02);
    if ink_only {
        let ring = 0.5 * 0.7 * ink / r;
        return vec![
            Item::area(name("iris-ring"), disc(0.0, 0.0, 0.93 + ring), palette.ink),
            Item::area(name("iris"), disc(0.0, 0.0, 0.93 - ring), palette.iris),
            Item::area(name("pupil"), disc(0.0, 0.0, 0.56), palette.pupil),
            Item::area(name("light"), disc(-0.30, -0.36, 0.24), palette.sclera),
        ];
    }
    let glow = Ellipse::new(at + Vec2::new(0.0, 0.42 * r), (0.62 * r, 0.40 * r), 0.0).to_path(0.02);
    let white = crate::drawing::Colour::WHITE;
    vec![
        Item::area(name("iris-ring"), disc(0.0, 0.0, 1.0), palette.iris_ring),
        Item::area(name("iris"), disc(0.0, 0.0, 0.86), palette.iris),
        Item::area(name("iris-light"), glow, palette.iris_light),
        Item::area(name("pupil"), disc(0.0, 0.0, 0.46), palette.pupil),
        Item::area(name("lid-shadow"), lid_shadow(eye), palette.ink.faded(0.30)),
        Item::area(name("light"), disc(-0.34, -0.40, 0.25), white),
        Item::area(name("light-low"), disc(0.36, 0.42, 0.12), white.faded(0.7)),
    ]
}

/// What the upper lid shades: from its edge down a little.
fn lid_shadow(eye: &Eye) -> BezPath {
    let down = Vec2::new(0.0, 0.13 * eye.height);
    let c = eye.upper;
    between(&c, &CubicBez::new(c.p0 + down, c.p1 + down, c.p2 + down, c.p3 + down))
}

/// The area between two curves that run the same way.
fn between(top: &CubicBez, bottom: &CubicBez) -> BezPath {
    let mut path = BezPath::new();
    path.push(PathEl::MoveTo(top.p0));
    path.push(PathEl::CurveTo(top.p1, top.p2, top.p3));
    path.push(PathEl::LineTo(bottom.p3));
    path.push(PathEl::CurveTo(bottom.p2, bottom.p1, bottom.p0));
    path.push(PathEl::ClosePath);
    path
}

/// `count` points on a curve at equal parameters.
fn samples(curve: &CubicBez, from: f64, to: f64, count: usize) -> Vec<Point> {
    (0..count).map(|i| curve.eval(lerp(from, to, i as f64 / (count - 1) as f64))).collect()
}

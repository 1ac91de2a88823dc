//! What the 47 points say of the head before a pixel is looked at: sides, heights, and the outline of the face.

use crate::face::{FeaturePoint as P, Points};
use crate::geometry::{CubicBez, ParamCurve, Point, Vec2};

/// The inner handles of a jaw near which its edge is looked for: the mean of those that fit the jaw points of the 72
/// people of the Face Research Lab London Set best (DeBruine and Jones 2017, CC BY 4.0).
pub(super) const USUAL_JAW: [f64; 2] = [0.74, 0.22];

/// The 47 points in units, and what follows from them.
pub(super) struct Shape {
    /// The points in units.
    pub points: Points,
    /// Half the width of the jaw at 2.14 and 2.13.
    pub half_jaw: f64,
    /// Height of the chin.
    pub chin: f64,
    /// Half the width from ear to ear, at the outermost points.
    pub ears: f64,
    /// Height of the ears' tops.
    pub ear_top: f64,
    /// Height of the lobes.
    pub lobe: f64,
    /// Height of the brows' upper edge in the middle.
    pub brows: f64,
    /// The outline of the face, from the chin up the left side and down the right one.
    pub face: Vec<Point>,
}

impl Shape {
    pub(crate) fn of(points: Points) -> Self {
        let p = points;
        let mean = |a: P, b: P| (p[a].y + p[b].y) / 2.0;
        let half = |a: P, b: P| ((p[b].x - p[a].x) / 2.0).abs().max(1.0);
        Self {
            half_jaw: half(P::P2_14, P::P2_13),
            chin: p[P::P2_1].y,
            ears: half(P::P10_4, P::P10_3),
            ear_top: mean(P::P10_2, P::P10_1),
            lobe: mean(P::P10_6, P::P10_5),
            brows: p[P::P4_4].y.min(p[P::P4_3].y),
            face: outline(&p),
            points,
        }
    }
}

/// The cubic of one half of the jaw, from the chin to 2.14 or 2.13: it leaves the chin level, and reaches the jaw
/// point in line with the lobe (recipe part 3, layer 6). `handles` are [`Measures::jaw`](crate::face::Measures::jaw).
pub(super) fn jaw_curve(chin: Point, jaw: Point, lobe: Point, handles: [f64; 2]) -> CubicBez {
    let down = jaw - lobe;
    let down = if down.hypot() < 1e-6 { Vec2::new(0.0, 1.0) } else { down.normalize() };
    let along = (chin.y - jaw.y).abs();
    CubicBez::new(chin, chin + Vec2::new(handles[0] * (jaw.x - chin.x), 0.0), jaw + down * (handles[1] * along), jaw)
}

fn outline(p: &Points) -> Vec<Point> {
    const STEPS: usize = 8;
    let inward = |ear: P, by: f64| p[ear] + Vec2::new(by * (p[P::P2_1].x - p[ear].x).signum(), 0.0);
    let left = jaw_curve(p[P::P2_1], p[P::P2_14], p[P::P10_6], USUAL_JAW);
    let right = jaw_curve(p[P::P2_1], p[P::P2_13], p[P::P10_5], USUAL_JAW);
    let mut face: Vec<Point> = (0..=STEPS).map(|i| left.eval(i as f64 / STEPS as f64)).collect();
    face.extend([inward(P::P10_6, 3.0), inward(P::P10_2, 4.0)]);
    // 11.1 lies on the line: a parabola between the temples runs through it.
    let (a, m, b) = (p[P::P11_2], p[P::P11_1], p[P::P11_3]);
    let control = m + (m - a.midpoint(b));
    face.extend((0..=STEPS).map(|i| {
        let t = i as f64 / STEPS as f64;
        a.lerp(control, t).lerp(control.lerp(b, t), t)
    }));
    face.extend([inward(P::P10_1, 4.0), inward(P::P10_5, 3.0)]);
    face.extend((0..STEPS).map(|i| right.eval(1.0 - i as f64 / STEPS as f64)));
    face
}

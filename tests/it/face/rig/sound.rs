//! What must hold of a face in any pose.

use lianpu::face::FeaturePoint as P;
use lianpu::face::rig::{Deformed, Neutral};
use lianpu::geometry::{ParamCurve, Shape};

/// What must hold of a face in any pose.
pub fn sound(neutral: &Neutral, face: &Deformed) -> Result<(), String> {
    let p = &face.points;
    if !p.0.iter().all(|p| p.is_finite()) {
        return Err("a point is not finite".into());
    }
    for eye in &face.eyes {
        for i in 0..=20 {
            let t = f64::from(i) / 20.0;
            let (upper, lower) = (eye.upper.eval(t), eye.lower.eval(t));
            if (upper.x - lower.x).abs() > 1e-9 || upper.y > lower.y + 1e-9 {
                return Err(format!("lids cross at {t}: {upper} {lower}"));
            }
        }
        if eye.crease.eval(0.5).y >= eye.upper.eval(0.5).y {
            return Err("the crease lies under its lid".into());
        }
        let corners = [eye.inner().x, eye.outer().x];
        let (left, right) = (corners[0].min(corners[1]), corners[0].max(corners[1]));
        if !(left < eye.iris.x && eye.iris.x < right && eye.radius > 0.0) {
            return Err("the iris has left the eye".into());
        }
    }
    let m = &face.mouth;
    let curves = m.upper_inner.iter().zip(&m.lower_inner);
    for (upper, lower) in curves {
        for i in 0..=10 {
            let t = f64::from(i) / 10.0;
            let (a, b) = (upper.eval(t), lower.eval(t));
            if (a.x - b.x).abs() > 1e-9 || a.y > b.y + 1e-9 {
                return Err(format!("the lips' inner edges cross: {a} {b}"));
            }
        }
        if upper.p0.x > upper.p3.x {
            return Err("an inner edge runs back".into());
        }
    }
    let order = [m.peaks[0].y, m.bow.y, m.inner[0].y, m.inner[1].y, m.bottom.y, p[P::P2_1].y];
    if order.windows(2).any(|w| w[0] > w[1] + 1e-9) || m.corners[0].x >= m.corners[1].x {
        return Err(format!("the mouth is turned inside out: {order:?}"));
    }
    let ink = m.upper_edge.iter().chain(&m.lower_edge).map(|c| c.bounding_box());
    let edges = ink.reduce(|a, b| a.union(b)).unwrap();
    let inside = edges.x0 > p[P::P2_14].x && edges.x1 < p[P::P2_13].x && edges.y1 < p[P::P2_1].y;
    if !inside || edges.y0 < neutral.points()[P::P9_15].y {
        return Err(format!("the lips have left the face: {edges:?}"));
    }
    for (side, points) in [(-1.0, [P::P4_2, P::P4_6]), (1.0, [P::P4_1, P::P4_5])] {
        if side * p[points[0]].x >= side * p[points[1]].x {
            return Err("a brow is turned round".into());
        }
    }
    Ok(())
}

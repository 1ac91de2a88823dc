//! What stays when the head moves: neck, shoulders, shirt. The neck's upper end goes with the head.

use super::{Pen, at};
use crate::drawing::Item;
use crate::face::{FeaturePoint as P, Points};
use crate::geometry::{Affine, BezPath, Circle, CubicBez, ParamCurve, Point, Rect, Shape, Vec2, brush};

/// Measures of neck and shirt, in the face frame.
#[derive(Debug, Clone)]
pub(super) struct Body {
    /// Half the neck's width.
    neck: f64,
    /// The chin at rest.
    chin: f64,
    /// The height of the shoulders.
    shoulders: f64,
    /// Half the width and the lower edge of what is seen.
    reach: f64,
    bottom: f64,
}

/// How far the neck reaches up behind the face.
const BEHIND: f64 = 60.0;

impl Body {
    /// `neck` in half widths of the jaw, as measured; `jaw` that half width.
    pub(super) fn new(points: &Points, neck: f64, jaw: f64, view: Rect) -> Self {
        let chin = points[P::P2_1].y;
        let reach = view.x1.max(-view.x0) + 10.0;
        Self { neck: neck.clamp(0.66, 0.84) * jaw, chin, shoulders: chin + 62.0, reach, bottom: view.y1 + 10.0 }
    }

    /// The left side of the neck from behind the ear to the shoulder; `head` moves its upper end.
    fn side(&self, sign: f64, head: Affine) -> [CubicBez; 2] {
        let (n, y, s) = (self.neck, self.chin, self.shoulders);
        let p = |x: f64, y: f64| at(sign * x * n, y);
        // The farther down, the less it follows.
        let with = |q: Point, share: f64| q + (head * q - q) * share;
        [
            CubicBez::new(
                with(p(1.0, y - BEHIND), 1.0),
                with(p(1.0, y - 20.0), 0.7),
                with(p(0.98, y + 20.0), 0.2),
                p(1.02, y + 38.0),
            ),
            CubicBez::new(p(1.02, y + 38.0), p(1.08, y + 60.0), p(1.5, s + 8.0), p(2.1, s + 16.0)),
        ]
    }

    /// Neck and shoulders, without the shadow of the chin.
    pub(super) fn neck(&self, pen: &Pen, head: Affine) -> Vec<Item> {
        let (left, right) = (self.side(-1.0, head), self.side(1.0, head));
        let mut skin = BezPath::new();
        skin.move_to(left[0].p0);
        for piece in &left {
            skin.curve_to(piece.p1, piece.p2, piece.p3);
        }
        skin.line_to(at(-2.2 * self.neck, self.bottom));
        skin.line_to(at(2.2 * self.neck, self.bottom));
        skin.line_to(right[1].p3);
        for piece in right.iter().rev() {
            skin.curve_to(piece.p2, piece.p1, piece.p0);
        }
        skin.close_path();
        let mut items = vec![Item::area("neck", skin, pen.palette.skin)];
        for (side, sign) in [(left, -1.0), (right, 1.0)] {
            let line = &sampled(&side)[5..=22];
            items.push(pen.line("neck-line", line, 1.0, &[0.0, 0.9, 1.0, 0.5]));
            if !pen.ink_only {
                let (n, s) = (self.neck * sign, self.shoulders);
                let bone = [at(0.18 * n, s + 10.0), at(0.45 * n, s + 2.0), at(0.85 * n, s + 3.0)];
                let ink = brush(&bone, 1.2 * pen.ink, &[0.0, 1.0, 0.0]);
                items.push(Item::area("collar-bone", ink, pen.palette.shade.faded(0.8)));
            }
        }
        items
    }

    /// The shadow that the face throws on the neck: its lower outline, moved down and aside, within the neck.
    pub(super) fn shadow(&self, pen: &Pen, lower: &[Point], head: Affine) -> Vec<Item> {
        if pen.ink_only {
            return Vec::new();
        }
        let sides = [sampled(&self.side(-1.0, head)), sampled(&self.side(1.0, head))];
        let cast = |by: Vec2| {
            let mut path = BezPath::new();
            for p in lower {
                let p = head * *p + by;
                let (left, right) = (x_at(&sides[0], p.y), x_at(&sides[1], p.y));
                let q = at(p.x.clamp(left.min(right), right.max(left)), p.y.max(sides[0][0].y));
                if path.elements().is_empty() { path.move_to(q) } else { path.line_to(q) }
            }
            path.close_path();
            path
        };
        vec![
            Item::area("neck-shade", cast(Vec2::new(5.0, 20.0)), pen.palette.shade),
            Item::area("neck-shadow", cast(Vec2::new(3.0, 7.0)), pen.palette.under_chin),
        ]
    }

    /// The shirt.
    pub(super) fn shirt(&self, pen: &Pen) -> Vec<Item> {
        let (n, s, bottom) = (self.neck, self.shoulders, self.bottom.max(self.shoulders + 60.0));
        // However narrow the neck, the shoulders leave the picture at its sides.
        let wide = (3.2 * n).max(self.reach);
        let low = s + 36.0;
        let arm = |sign: f64| {
            let p = |x: f64, y: f64| at(sign * x, s + y);
            CubicBez::new(p(1.30 * n, -4.0), p(1.9 * n, 12.0), p(0.8 * wide, 22.0), p(wide, 60.0))
        };
        let mut cloth = BezPath::new();
        cloth.move_to(at(-1.30 * n, s - 4.0));
        cloth.curve_to(at(-n, s + 26.0), at(-0.5 * n, low), at(0.0, low));
        cloth.curve_to(at(0.5 * n, low), at(n, s + 26.0), at(1.30 * n, s - 4.0));
        let (left, right) = (arm(-1.0), arm(1.0));
        cloth.curve_to(right.p1, right.p2, right.p3);
        // A picture wider than the view shows where the shoulders round off and the arms hang.
        let hang = |sign: f64| {
            let p = |out: f64, y: f64| at(sign * (wide + out), s + y);
            CubicBez::new(p(0.0, 60.0), p(26.0, 80.0), p(44.0, 112.0), p(50.0, 170.0))
        };
        let (left_arm, right_arm) = (hang(-1.0), hang(1.0));
        cloth.curve_to(right_arm.p1, right_arm.p2, right_arm.p3);
        let low_end = bottom.max(s + 170.0);
        cloth.line_to(at(wide + 50.0, low_end));
        cloth.line_to(at(-wide - 50.0, low_end));
        cloth.line_to(left_arm.p3);
        cloth.curve_to(left_arm.p2, left_arm.p1, left_arm.p0);
        cloth.curve_to(left.p2, left.p1, left.p0);
        cloth.close_path();
        let collar = [(-1.30, -4.0), (-1.02, 17.0), (-0.5, 31.0), (0.0, 36.0), (0.5, 31.0), (1.02, 17.0), (1.30, -4.0)]
            .map(|(x, y)| at(x * n, s + y));
        let below = |by: f64| collar.map(|p| p + Vec2::new(0.0, by));
        let mut items = vec![Item::area("shirt", cloth, pen.palette.shirt)];
        if pen.ink_only {
            for sign in [-1.0, 1.0] {
                let slope = [0.0, 0.2, 0.4, 0.6, 0.8, 1.0].map(|t| arm(sign).eval(t));
                items.push(pen.line("shoulder", &slope, 1.0, &[1.0, 0.8, 0.0]));
            }
        } else {
            let band = brush(&below(4.0), 9.0, &[0.7, 1.0, 1.0, 1.0, 0.7]);
            items.push(Item::area("collar", band, pen.palette.shirt_light));
            let under = brush(&below(9.0), 2.0, &[0.3, 1.0, 1.0, 0.3]);
            items.push(Item::area("collar-shade", under, pen.palette.shirt_shade));
            // Two folds, where an arm would pull the cloth.
            for (sign, depth) in [(-1.0, 0.8), (1.0, 1.0)] {
                let fold = [at(sign * 2.15 * n, s + 44.0), at(sign * 1.9 * n, s + 72.0), at(sign * 2.0 * n, s + 104.0)];
                let ink = brush(&fold, 5.0 * depth, &[0.0, 0.8, 1.0, 0.2]);
                items.push(Item::area("fold", ink, pen.palette.shirt_shade.faded(0.7)));
            }
        }
        items.push(pen.line("collar-line", &collar, 0.8, &[0.5, 1.0, 1.0, 0.5]));
        items
    }

    /// The disc that sets the head off the ground.
    pub(super) fn disc(pen: &Pen) -> Item {
        let disc = Circle::new((0.0, 25.0), 192.0);
        Item::area("disc", disc.to_path(0.01), pen.palette.disc)
    }
}

/// 29 points down a side of the neck.
fn sampled(side: &[CubicBez; 2]) -> Vec<Point> {
    const EACH: usize = 14;
    let mut line = vec![side[0].p0];
    for piece in side {
        line.extend((1..=EACH).map(|i| piece.eval(i as f64 / EACH as f64)));
    }
    line
}

/// Where a line that runs down is at a height; its ends beyond it.
fn x_at(line: &[Point], y: f64) -> f64 {
    let piece = line.windows(2).find(|w| w[0].y <= y && y <= w[1].y);
    match piece {
        Some(w) if w[1].y > w[0].y => w[0].lerp(w[1], (y - w[0].y) / (w[1].y - w[0].y)).x,
        _ if y < line[0].y => line[0].x,
        _ => line[line.len() - 1].x,
    }
}

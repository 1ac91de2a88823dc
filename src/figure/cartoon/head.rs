//! The head's outline: chin, jaw, cheeks, the line behind which the ears stand, and the skull under the hair.

use super::at;
use crate::face::{FeaturePoint as P, Points};
use crate::geometry::{BezPath, CubicBez, ParamCurve, PathEl, Point, Vec2, lerp};

/// Points along each cubic where the outline is wanted as a line.
const SAMPLES: usize = 12;

/// What of the head's shape does not move.
#[derive(Debug, Clone)]
pub(super) struct HeadShape {
    /// The inner handles of the jaw's cubic: along the chin, in widths from 2.1 to 2.14; down from the jaw, in heights.
    handles: [f64; 2],
    /// How much of the jaw's direction is its own and how much straight down: 0 its own.
    upright: f64,
    /// Where the outline meets the lobe and the top of the ear, image left first.
    lobes: [Point; 2],
    tops: [Point; 2],
    /// The skull's top.
    pub(super) top: f64,
}

/// The outline in a pose: from the chin up the image's left, over the skull, down the right.
#[derive(Debug, Clone, Copy)]
pub(super) struct Outline([CubicBez; 8]);

/// A rounder jaw has these handles; how much of them a style takes is `round`.
const ROUND: [f64; 2] = [0.54, 0.60];

impl HeadShape {
    /// `jaw` as measured; `round` from 0, the face's own, to 1, a child's; `top` is the skull's.
    pub(super) fn new(points: &Points, jaw: [f64; 2], round: f64, top: f64) -> Self {
        let side = |p: P, sign: f64, by: Vec2| points[p] + Vec2::new(-sign * by.x, by.y);
        let (lobe, ear) = (Vec2::new(3.5, -2.0), Vec2::new(4.0, 4.0));
        Self {
            handles: [lerp(jaw[0], ROUND[0], round), lerp(jaw[1], ROUND[1], round)],
            upright: 0.8 * round,
            lobes: [side(P::P10_6, -1.0, lobe), side(P::P10_5, 1.0, lobe)],
            tops: [side(P::P10_2, -1.0, ear), side(P::P10_1, 1.0, ear)],
            top,
        }
    }

    /// Where the face ends at the top of an ear: 0 image left, 1 right.
    pub(super) fn ear_top(&self, side: usize) -> Point {
        self.tops[side]
    }

    /// The outline of the points of a pose: chin and jaw move.
    pub(super) fn outline(&self, points: &Points) -> Outline {
        let chin = points[P::P2_1];
        let half = |side: usize| -> [CubicBez; 4] {
            let sign = if side == 0 { -1.0 } else { 1.0 };
            let (jaw, lobe, ear) = (points[[P::P2_14, P::P2_13][side]], self.lobes[side], self.tops[side]);
            let (wide, high) = ((jaw.x - chin.x).abs(), chin.y - jaw.y);
            let unit = |v: Vec2| v / v.hypot().max(1e-6);
            let down = unit(unit(jaw - lobe) * (1.0 - self.upright) + Vec2::new(0.0, self.upright));
            let [along, below] = self.handles;
            let chin_piece =
                CubicBez::new(chin, chin + Vec2::new(sign * along * wide, 0.0), jaw + down * (below * high), jaw);
            let cheek = CubicBez::new(
                jaw,
                jaw - down * (0.4 * jaw.distance(lobe)),
                lobe + Vec2::new(sign * 0.5, 0.3 * (jaw.y - lobe.y)),
                lobe,
            );
            let rise = ear - lobe;
            let behind = CubicBez::new(
                lobe,
                lobe + rise * 0.33 + Vec2::new(sign * 1.5, 0.0),
                lobe + rise * 0.66 + Vec2::new(sign * 2.5, 0.0),
                ear,
            );
            let skull = CubicBez::new(
                ear,
                ear + Vec2::new(sign * 3.0, -0.5 * (ear.y - self.top)),
                at(0.60 * ear.x, self.top),
                at(0.0, self.top),
            );
            [chin_piece, cheek, behind, skull]
        };
        let ([a, b, c, d], [e, f, g, h]) = (half(0), half(1));
        let back = |c: CubicBez| CubicBez::new(c.p3, c.p2, c.p1, c.p0);
        Outline([a, b, c, d, back(h), back(g), back(f), back(e)])
    }
}

impl Outline {
    /// The whole outline, closed.
    pub(super) fn path(&self) -> BezPath {
        let mut path = BezPath::new();
        path.push(PathEl::MoveTo(self.0[0].p0));
        path.extend(self.0.iter().map(|c| PathEl::CurveTo(c.p1, c.p2, c.p3)));
        path.push(PathEl::ClosePath);
        path
    }

    /// The line from the left lobe under the chin to the right lobe.
    pub(super) fn jaw_line(&self) -> Vec<Point> {
        let mut line = self.line(&[6, 7, 0, 1]);
        line.reverse();
        line
    }

    /// The line from half the left ear down to where the cheek begins to move, and the same at the right.
    pub(super) fn cheeks(&self) -> [Vec<Point>; 2] {
        let mut left = self.line(&[1, 2]);
        left.reverse();
        let right = self.line(&[5, 6]);
        [left, right].map(|l| l[SAMPLES / 2..SAMPLES + SAMPLES / 2].to_vec())
    }

    /// The face below a height, down to the chin.
    pub(super) fn below(&self, y: f64) -> BezPath {
        let mut path = BezPath::new();
        let line = self.lower();
        for (i, p) in line.iter().enumerate() {
            if p.y < y {
                continue;
            }
            let crossed = |from: &Point| from.lerp(*p, ((y - from.y) / (p.y - from.y)).clamp(0.0, 1.0));
            match i.checked_sub(1).map(|k| line[k]).filter(|q| q.y < y) {
                Some(before) => path.move_to(crossed(&before)),
                None if path.elements().is_empty() => path.move_to(*p),
                None => {}
            }
            path.line_to(*p);
            if let Some(after) = line.get(i + 1).filter(|q| q.y < y) {
                path.line_to(crossed(after));
            }
        }
        path.close_path();
        path
    }

    /// The lower face, from the left ear's top under the chin to the right ear's top.
    pub(super) fn lower(&self) -> Vec<Point> {
        let mut line = self.line(&[5, 6, 7, 0, 1, 2]);
        line.reverse();
        line
    }

    /// The skull, from the left ear's top to the right ear's.
    pub(super) fn skull(&self) -> Vec<Point> {
        self.line(&[3, 4])
    }

    /// The edge of the face in shade when light comes from the upper left: what the outline covers and the same moved
    /// by `-by` does not, built as the way of one edge, so that no clip is needed. Nothing of the edge above `from`.
    pub(super) fn shaded(&self, by: Vec2, from: f64) -> BezPath {
        let mut round = self.line(&[4, 5, 6, 7, 0]);
        round.retain(|p| p.y >= from);
        let faces = |w: &[Point]| {
            let along = w[1] - w[0];
            Vec2::new(along.y, -along.x).dot(by) > 0.0
        };
        let first = round.windows(2).position(faces).unwrap_or(0);
        let last = round.windows(2).rposition(faces).map_or(round.len() - 1, |i| i + 1);
        let edge = &round[first..=last];
        let mut path = BezPath::new();
        path.move_to(edge[0]);
        edge[1..].iter().for_each(|p| path.line_to(*p));
        edge.iter().rev().for_each(|p| path.line_to(*p - by));
        path.close_path();
        path
    }

    /// Half the width of the face at a height, the smaller of its two sides; 0 below and above it.
    pub(super) fn half_width(&self, y: f64) -> f64 {
        let reach = |line: Vec<Point>| {
            line.windows(2)
                .filter(|w| (w[0].y - y) * (w[1].y - y) <= 0.0)
                .map(|w| w[0].lerp(w[1], if w[1].y == w[0].y { 0.0 } else { (y - w[0].y) / (w[1].y - w[0].y) }).x.abs())
                .fold(0.0, f64::max)
        };
        reach(self.line(&[0, 1, 2, 3])).min(reach(self.line(&[4, 5, 6, 7])))
    }

    fn line(&self, pieces: &[usize]) -> Vec<Point> {
        let mut line = vec![self.0[pieces[0]].p0];
        for piece in pieces {
            line.extend_from_slice(&samples(&self.0[*piece])[1..]);
        }
        line
    }
}

fn samples(piece: &CubicBez) -> [Point; SAMPLES + 1] {
    std::array::from_fn(|i| piece.eval(i as f64 / SAMPLES as f64))
}

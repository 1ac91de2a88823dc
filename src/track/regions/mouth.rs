//! The mouth from frame to frame by a reserved threshold of edges and seeds (thesis sec. 6.3).

use super::window::Window;
use crate::aam::{Grey, Similarity};
use crate::emotion::MouthMoves;
use crate::geometry::{Point, Rect, Vec2};
use crate::photo::{Mask, Neighbours, Regions, moment_preserving, sobel};
use crate::pose::{MouthPose, MouthPreset, MouthShape};

/// How far beside, above and below the neutral mouth its edges are looked for, in pupil distances: the nose's base stays
/// outside.
const BESIDE: f64 = 0.22;
const ABOVE: f64 = 0.06;
const BELOW: f64 = 0.34;
/// How near to one of the nine a mouth is to become it, in units of its opening (M) and, five times as much, its width
/// (MW0).
const NEAR: f64 = 0.18;
const WIDTHS: f64 = 5.0;

/// What is followed of the mouth. All is in the frame of the eyes, their distance 1, the origin midway.
#[derive(Debug, Clone)]
pub(super) struct Mouth {
    /// The threshold of edges, reserved from the first frame.
    threshold: f32,
    /// R_Mouth of the first frame, and where it is looked for.
    rest: Rect,
    search: Rect,
    /// The places of the last region's pixels: the seeds of the next one.
    seeds: Vec<Point>,
    /// MNS0 and MW0.
    units: [f64; 2],
}

impl Mouth {
    /// From the neutral mouth in the first frame: its corners, the edges of its upper and lower lip, the nose's base, all in
    /// the frame of the eyes. None where it has no edges.
    pub fn reserved(grey: &Grey, eyes: &Similarity, [left, right, upper, lower, nose]: [Point; 5]) -> Option<Self> {
        let own = Rect::new(left.x, upper.y, right.x, lower.y);
        let search = Rect::new(own.x0 - BESIDE, (own.y0 - ABOVE).max(nose.y + 0.03), own.x1 + BESIDE, own.y1 + BELOW);
        let units = [(upper.y - nose.y).max(0.05), (right.x - left.x).max(0.1)];
        let n = 12;
        let seeds = (0..=n).map(|i| left.lerp(right, f64::from(i) / f64::from(n))).collect();
        let mut mouth = Self { threshold: 0.0, rest: own, search, seeds, units };
        let window = mouth.window(grey, eyes)?;
        mouth.threshold = moment_preserving(sobel(&window.plane()).values.iter().copied())?;
        mouth.rest = mouth.grown(grey, eyes)?;
        Some(mouth)
    }

    fn window<'g>(&self, grey: &'g Grey, eyes: &Similarity) -> Option<Window<'g>> {
        let s = self.search;
        let corners = [(s.x0, s.y0), (s.x1, s.y0), (s.x0, s.y1), (s.x1, s.y1)].map(|(x, y)| eyes.apply(Point::new(x, y)));
        let low = corners.iter().fold(Point::new(f64::MAX, f64::MAX), |a, p| Point::new(a.x.min(p.x), a.y.min(p.y)));
        let high = corners.iter().fold(Point::new(f64::MIN, f64::MIN), |a, p| Point::new(a.x.max(p.x), a.y.max(p.y)));
        Window::of(grey, low, high)
    }

    /// R_Mouth: what grows from the seeds along edges; its box in the frame of the eyes.
    fn grown(&mut self, grey: &Grey, eyes: &Similarity) -> Option<Rect> {
        let window = self.window(grey, eyes)?;
        let b = window.bounds;
        let edges = Mask::of(&sobel(&window.plane()), |v| v > self.threshold);
        let regions = Regions::of(&edges, Neighbours::Eight);
        let mut seeded = vec![false; regions.list.len() + 1];
        for at in &self.seeds {
            let p = eyes.apply(*at);
            for (dx, dy) in [(0.0, 0.0), (0.0, 1.0), (0.0, -1.0), (1.0, 0.0), (-1.0, 0.0)] {
                let (x, y) = ((p.x + dx).round(), (p.y + dy).round());
                if x >= 0.0 && y >= 0.0 && b.holds(x as usize, y as usize) {
                    seeded[regions.labels[(y as usize - b.y0) * b.width() + x as usize - b.x0] as usize] = true;
                }
            }
        }
        seeded[0] = false;
        let places: Vec<Point> = regions
            .labels
            .iter()
            .enumerate()
            .filter(|(_, label)| seeded[**label as usize])
            .map(|(at, _)| eyes.undo(Point::new((b.x0 + at % b.width()) as f64, (b.y0 + at / b.width()) as f64)))
            .filter(|p| self.search.contains(*p))
            .collect();
        if places.len() < 8 {
            return None;
        }
        // A few pixels at the ends are stray edges of the cheeks.
        let span = |mut v: Vec<f64>, share: f64| {
            v.sort_by(f64::total_cmp);
            let cut = (share * v.len() as f64) as usize;
            (v[cut], v[v.len() - 1 - cut])
        };
        let (x0, x1) = span(places.iter().map(|p| p.x).collect(), 0.01);
        let (y0, y1) = span(places.iter().map(|p| p.y).collect(), 0.02);
        self.seeds = places;
        Some(Rect::new(x0, y0, x1, y1))
    }

    /// How the mouth of the next frame has moved; none where it has no edges, and the old seeds stay.
    pub fn follow(&mut self, grey: &Grey, eyes: &Similarity) -> Option<MouthMoves> {
        let now = self.grown(grey, eyes)?;
        let [mns, mw] = self.units;
        Some(MouthMoves {
            up: (self.rest.y0 - now.y0) / mns,
            down: (now.y1 - self.rest.y1) / mns,
            left: (self.rest.x0 - now.x0) / mw,
            right: (now.x1 - self.rest.x1) / mw,
        })
    }
}

/// The sizes of a mouth matched to the nine shapes (thesis sec. 6.4): the mix of the shapes that are about as open and as
/// wide, so that what is drawn are mouths that speak.
pub(super) fn matched(moves: &MouthMoves) -> MouthMoves {
    let size = Vec2::new((moves.up + moves.down).max(0.0), WIDTHS * f64::midpoint(moves.left, moves.right));
    let (mut sum, mut all) = ([0.0; 3], 0.0);
    for shape in MouthShape::ALL {
        let pose = MouthPose::of(shape, MouthPreset::Distinct);
        let own = Vec2::new(pose.opening(), -WIDTHS * pose.corner_in);
        let weight = (-(size - own).hypot2() / (2.0 * NEAR * NEAR)).exp() + 1e-12;
        let parts = if shape.closes() { [0.0, 0.0, 0.0] } else { [-pose.upper, pose.lower, -pose.corner_in] };
        sum.iter_mut().zip(parts).for_each(|(s, v)| *s += weight * v);
        all += weight;
    }
    let [up, down, out] = sum.map(|s| s / all);
    MouthMoves { up, down, left: out, right: out }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mouth_of_a_shape_s_size_becomes_that_shape() {
        for shape in [MouthShape::A, MouthShape::O, MouthShape::I, MouthShape::M] {
            let pose = MouthPose::of(shape, MouthPreset::Distinct);
            let out = -pose.corner_in;
            let (up, down) = if shape.closes() { (0.0, 0.0) } else { (-pose.upper, pose.lower) };
            let found = matched(&MouthMoves { up, down, left: out, right: out });
            assert!((found.up + found.down - up - down).abs() < 0.12, "{shape}: {found:?}");
            assert!((found.left - out).abs() < 0.04, "{shape}: {found:?}");
        }
    }
}

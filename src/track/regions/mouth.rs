//! The mouth from frame to frame by a reserved threshold and seeds (thesis sec. 6.3).
//!
//! The thesis grows edges; those run on into chin and cheeks. On 1241 frames of a man talking their height goes with a
//! model's mouth by a correlation of 0.58 and their width by 0.27, those of the dark between his lips by 0.75 and 0.60, so
//! that is what grows here.

use super::window::{Window, below};
use crate::geometry::{Point, Rect, Similarity, Vec2};
use crate::photo::Grey;
use crate::photo::{Neighbours, Regions};
use crate::pose::{MouthPose, MouthPreset, MouthShape};
use crate::ratios::MouthMoves;

/// How far beside, above and below the neutral mouth it is looked for, in pupil distances: the nose's base stays outside.
const BESIDE: f64 = 0.24;
const ABOVE: f64 = 0.06;
const BELOW: f64 = 0.24;
/// How many deviations below the mean of its window the dark between lips is.
const DARKER: f64 = 1.4;
/// How near to one of the nine a mouth is to become it, in units of its opening (M) and, five times as much, its width
/// (MW0).
const NEAR: f64 = 0.18;
const WIDTHS: f64 = 5.0;

/// What is followed of the mouth. All is in the frame of the eyes, their distance 1, the origin midway.
#[derive(Debug, Clone)]
pub(super) struct Mouth {
    /// The threshold, reserved from the first frame.
    threshold: f32,
    /// The mouth of the first frame, and where it is looked for.
    rest: Opening,
    search: Rect,
    /// The places of the last region's pixels: the seeds of the next one.
    seeds: Vec<Point>,
    /// MNS0 and MW0.
    units: [f64; 2],
}

/// The dark between lips: the ends of the line and how high it is, were it as high everywhere.
#[derive(Debug, Clone, Copy)]
struct Opening {
    left: f64,
    right: f64,
    height: f64,
}

impl Mouth {
    /// From the neutral mouth in the first frame: its corners, the edges of its upper and lower lip, the nose's base, all in
    /// the frame of the eyes. None where nothing dark is between the lips.
    pub(crate) fn reserved(
        grey: &Grey,
        eyes: &Similarity,
        [left, right, upper, lower, nose]: [Point; 5],
    ) -> Option<Self> {
        let own = Rect::new(left.x, upper.y, right.x, lower.y);
        let search = Rect::new(own.x0 - BESIDE, (own.y0 - ABOVE).max(nose.y + 0.03), own.x1 + BESIDE, own.y1 + BELOW);
        let units = [(upper.y - nose.y).max(0.05), (right.x - left.x).max(0.1)];
        // Where the lips of a mouth at rest meet: its line sags or rises, so what is seeded is a little high.
        let middle = upper.midpoint(lower);
        let reach = 0.12;
        let seeds = (-4..=4)
            .flat_map(|i| (-3..=3).map(move |j| (f64::from(i) / 4.0, f64::from(j) / 3.0)))
            .map(|(i, j)| middle + Vec2::new(0.6 * i * (right.x - middle.x), reach * j))
            .collect();
        let rest = Opening { left: left.x, right: right.x, height: 0.0 };
        let mut mouth = Self { threshold: 0.0, rest, search, seeds, units };
        let values: Vec<f32> = mouth.window(grey, eyes)?.values().collect();
        mouth.threshold = below(&values, DARKER)?;
        mouth.rest = mouth.grown(grey, eyes)?;
        Some(mouth)
    }

    fn window<'g>(&self, grey: &'g Grey, eyes: &Similarity) -> Option<Window<'g>> {
        let s = self.search;
        let corners =
            [(s.x0, s.y0), (s.x1, s.y0), (s.x0, s.y1), (s.x1, s.y1)].map(|(x, y)| eyes.apply(Point::new(x, y)));
        let low = corners.iter().fold(Point::new(f64::MAX, f64::MAX), |a, p| Point::new(a.x.min(p.x), a.y.min(p.y)));
        let high = corners.iter().fold(Point::new(f64::MIN, f64::MIN), |a, p| Point::new(a.x.max(p.x), a.y.max(p.y)));
        Window::of(grey, low, high)
    }

    /// What is dark and grows from the seeds.
    fn grown(&mut self, grey: &Grey, eyes: &Similarity) -> Option<Opening> {
        let window = self.window(grey, eyes)?;
        let b = window.bounds;
        let regions = Regions::of(&window.dark(self.threshold), Neighbours::Eight);
        let mut seeded = vec![false; regions.list.len() + 1];
        for at in &self.seeds {
            let p = eyes.apply(*at);
            let (x, y) = (p.x.round(), p.y.round());
            if x >= 0.0 && y >= 0.0 && b.holds(x as usize, y as usize) {
                seeded[regions.labels[(x as usize - b.x0, y as usize - b.y0)] as usize] = true;
            }
        }
        seeded[0] = false;
        let places: Vec<Point> = regions
            .labels
            .pixels()
            .iter()
            .enumerate()
            .filter(|(_, label)| seeded[**label as usize])
            .map(|(at, _)| eyes.undo(Point::new((b.x0 + at % b.width()) as f64, (b.y0 + at / b.width()) as f64)))
            .filter(|p| self.search.contains(*p))
            .collect();
        if places.len() < 4 {
            return None;
        }
        let mut across: Vec<f64> = places.iter().map(|p| p.x).collect();
        across.sort_by(f64::total_cmp);
        // A pixel or two at the ends may be a fold of the cheek.
        let cut = across.len() / 100;
        let (left, right) = (across[cut], across[across.len() - 1 - cut]);
        let area = places.len() as f64 / (eyes.scale() * eyes.scale());
        self.seeds = places;
        Some(Opening { left, right, height: area / self.units[1] })
    }

    /// How the mouth of the next frame has moved; none where nothing is dark, and the old seeds stay. Of what it opens, a
    /// quarter is the upper lip's, as in the nine shapes.
    pub(crate) fn follow(&mut self, grey: &Grey, eyes: &Similarity) -> Option<MouthMoves> {
        let now = self.grown(grey, eyes)?;
        let [mns, mw] = self.units;
        let open = (now.height - self.rest.height) / mns;
        Some(MouthMoves {
            up: 0.25 * open,
            down: 0.75 * open,
            left: (self.rest.left - now.left) / mw,
            right: (now.right - self.rest.right) / mw,
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

//! What a person's face looks like round each point, and where that is seen in another shot.

use crate::geometry::{Point, Similarity, Vec2};
use crate::photo::Grey;

/// Half a patch, in samples.
const HALF: isize = 7;
/// Samples in a pupil distance.
const FINE: f64 = 56.0;
/// How unlike a patch may look, as one minus its correlation, before it says little.
const UNLIKE: f64 = 0.06;
/// Correlation below which a patch is not seen at all.
const BLIND: f64 = 0.35;
/// What a sight is off at least, in pupil distances.
const LEAST: f64 = 0.008;

/// A picture small enough that a patch's sample is about a pixel of it.
#[derive(Debug, Clone)]
pub(super) struct View {
    grey: Grey,
    /// Pixels of the picture in one of this.
    step: f64,
}

impl View {
    /// Of a picture in which the pupils are so many pixels apart.
    pub(crate) fn of(grey: &Grey, pupils: f64) -> Self {
        let mut view = Self { grey: grey.clone(), step: 1.0 };
        while pupils / view.step > 1.5 * FINE && view.grey.width().min(view.grey.height()) > 16 {
            view = Self { grey: view.grey.halved(), step: 2.0 * view.step };
        }
        view
    }

    /// The picture round places: samples `FINE` to a pupil distance, in the turn and size of `place`.
    fn samples(&self, place: &Similarity, at: Point, half: isize) -> Vec<f32> {
        let side = (2 * half + 1) as usize;
        let mut out = Vec::with_capacity(side * side);
        for y in -half..=half {
            for x in -half..=half {
                let p = place.apply(at + Vec2::new(x as f64, y as f64) / FINE);
                out.push(self.light(p) as f32);
            }
        }
        out
    }

    fn light(&self, at: Point) -> f64 {
        let p = Point::new((at.x + 0.5) / self.step - 0.5, (at.y + 0.5) / self.step - 0.5);
        super::warped::between(&self.grey, p)
    }
}

/// What lies round each point of a shot: samples less their mean, of length 1.
#[derive(Debug, Clone)]
pub(super) struct Patches(Vec<Vec<f32>>);

impl Patches {
    /// From a shot: its points in the frame that `place` takes to pixels.
    pub(crate) fn of(view: &View, place: &Similarity, points: &[Point]) -> Self {
        Self(points.iter().map(|p| normal(view.samples(place, *p, HALF))).collect())
    }
}

impl Patches {
    /// Those of some points alone; the others are not looked for with them.
    pub(crate) fn only(mut self, which: &[bool]) -> Self {
        for (patch, keep) in self.0.iter_mut().zip(which) {
            if !keep {
                patch.clear();
            }
        }
        self
    }
}

fn normal(mut patch: Vec<f32>) -> Vec<f32> {
    let mean = patch.iter().sum::<f32>() / patch.len() as f32;
    patch.iter_mut().for_each(|v| *v -= mean);
    let length = patch.iter().map(|v| v * v).sum::<f32>().sqrt().max(4.0);
    patch.iter_mut().for_each(|v| *v /= length);
    patch
}

/// Where a point is seen: how far from where it was looked for, and how far off that may be, as a covariance.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sight {
    pub by: Vec2,
    /// Of x with x, x with y, y with y, in squared pupil distances.
    pub doubt: [f64; 3],
    /// The best correlation there.
    pub like: f64,
}

/// Looks for each point round a place, as it looks in any of some shots.
pub(super) fn sights(view: &View, place: &Similarity, points: &[Point], looks: &[Patches], reach: f64) -> Vec<Sight> {
    let far = (reach * FINE).round().max(1.0) as isize;
    points
        .iter()
        .enumerate()
        .map(|(i, at)| {
            let half = HALF + far;
            let side = (2 * half + 1) as usize;
            let around = view.samples(place, *at, half);
            let patch_side = (2 * HALF + 1) as usize;
            let mut likes = Vec::new();
            for dy in 0..=(2 * far) as usize {
                for dx in 0..=(2 * far) as usize {
                    let mut window = Vec::with_capacity(patch_side * patch_side);
                    for y in 0..patch_side {
                        let from = (dy + y) * side + dx;
                        window.extend_from_slice(&around[from..from + patch_side]);
                    }
                    let window = normal(window);
                    let like = |p: &Patches| p.0[i].iter().zip(&window).map(|(a, b)| a * b).sum::<f32>();
                    likes.push(f64::from(looks.iter().filter(|p| !p.0[i].is_empty()).map(like).fold(-1.0, f32::max)));
                }
            }
            sight(&likes, far)
        })
        .collect()
}

/// The middle and the spread of where a patch may be.
fn sight(likes: &[f64], far: isize) -> Sight {
    let best = likes.iter().copied().fold(-1.0, f64::max);
    let side = (2 * far + 1) as usize;
    let (mut sum, mut x, mut y, mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    for (k, like) in likes.iter().enumerate() {
        let (dx, dy) = ((k % side) as f64 - far as f64, (k / side) as f64 - far as f64);
        // Nearer places are a little likelier.
        let near = (-0.5 * (dx * dx + dy * dy) / (far as f64 * far as f64)).exp();
        let w = near * ((like - best) / UNLIKE).exp();
        sum += w;
        (x, y) = (x + w * dx, y + w * dy);
        (xx, xy, yy) = (xx + w * dx * dx, xy + w * dx * dy, yy + w * dy * dy);
    }
    let (x, y) = (x / sum, y / sum);
    let unit = 1.0 / (FINE * FINE);
    // A face that looks otherwise there is not seen there.
    let seen = ((best - BLIND) / (1.0 - BLIND)).clamp(0.05, 1.0);
    let wide = 1.0 / (seen * seen);
    let floor = LEAST * LEAST;
    Sight {
        by: Vec2::new(x, y) / FINE,
        doubt: [
            ((xx / sum - x * x) * unit + floor) * wide,
            (xy / sum - x * y) * unit * wide,
            ((yy / sum - y * y) * unit + floor) * wide,
        ],
        like: best,
    }
}

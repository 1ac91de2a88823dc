//! The eyes from frame to frame by a reserved threshold and seeds (thesis sec. 6.2).

use super::window::{Window, below};
use crate::geometry::{Point, Vec2};
use crate::photo::Grey;
use crate::photo::{Bounds, Eyeball, Eyeballs, Neighbours, Region, Regions};

/// t₁ = m₁ − 1.3 s₁, where the thesis has s₁ alone (eq. 3.3): around the eyes of a man talking the regions' heights then go
/// best with how far his lids are open.
const DARKER: f64 = 1.3;
/// Over so many distances between the eyes the highest columns of a region are averaged.
const COLUMNS: f64 = 0.07;
/// How far round an eyeball the eye is looked for, in distances between the eyes: brows stay outside.
const REACH: Vec2 = Vec2::new(0.30, 0.17);
/// How much the distance between the eyes may change from one frame to the next, either way, and by how many degrees its
/// direction.
const APART: f64 = 1.2;
const TURNED: f64 = 8.0;
/// How many times larger one region may be than the other: Chan's rule for a pair. An eye that winks is a line.
const AREAS: f64 = 4.0;

/// What is followed of the eyes.
#[derive(Debug, Clone)]
pub(super) struct Eyes {
    /// t₁, reserved from the first frame: darker than this is eye.
    threshold: f32,
    pub balls: Eyeballs,
    /// The boxes of both regions, in pixels.
    pub boxes: [Bounds; 2],
    /// How high both regions are where they are highest, in pixels: an iris is, a lash line is not.
    pub heights: [f64; 2],
    /// The pixels of both regions: the seeds of the next frame's.
    seeds: [Vec<(usize, usize)>; 2],
}

/// A region of one eye, found.
struct Eye {
    ball: Eyeball,
    bounds: Bounds,
    height: f64,
    pixels: Vec<(usize, usize)>,
}

impl Eyes {
    /// From the middles of the eyes in the first frame; none where nothing dark is there.
    pub(crate) fn reserved(grey: &Grey, left: Point, right: Point) -> Option<Self> {
        let balls = Eyeballs::at(left, right);
        let windows = [balls.left, balls.right].map(|b| window(grey, b.centre, balls.distance()));
        let [a, b] = windows;
        let values: Vec<f32> = a?.values().chain(b?.values()).collect();
        let threshold = below(&values, DARKER)?;
        let reach = 0.5 * balls.left.radius;
        let seeds = [balls.left, balls.right].map(|b| {
            let c = Vec2::new(reach, reach);
            let at = Bounds::between(b.centre - c, b.centre + c, grey.width(), grey.height());
            (at.y0..at.y1).flat_map(|y| (at.x0..at.x1).map(move |x| (x, y))).collect()
        });
        let whole = Bounds::whole(1, 1);
        let mut eyes = Self { threshold, balls, boxes: [whole; 2], heights: [0.0; 2], seeds };
        eyes.follow(grey).then_some(eyes)
    }

    /// Takes the pair of the next frame; where none is found the old one stays, and it is said.
    pub(crate) fn follow(&mut self, grey: &Grey) -> bool {
        let d = self.balls.distance();
        let found = [(self.balls.left, &self.seeds[0]), (self.balls.right, &self.seeds[1])]
            .map(|(ball, seeds)| self.grown(grey, ball, seeds, d));
        let [Some(left), Some(right)] = found else { return false };
        let balls = Eyeballs { left: left.ball, right: right.ball };
        let (was, is) = (self.balls.right.centre - self.balls.left.centre, right.ball.centre - left.ball.centre);
        let areas = [left.pixels.len(), right.pixels.len()].map(|n| n as f64);
        let apart = is.hypot() / was.hypot().max(1.0);
        let turned = was.cross(is).atan2(was.dot(is)).to_degrees().abs();
        let pair = (1.0 / APART..APART).contains(&apart)
            && turned <= TURNED
            && areas[0].max(areas[1]) <= AREAS * areas[0].min(areas[1]);
        if pair {
            self.balls = balls;
            self.boxes = [left.bounds, right.bounds];
            self.heights = [left.height, right.height];
            self.seeds = [left.pixels, right.pixels];
        }
        pair
    }

    /// The dark region that grows from the seeds; none where nothing does, or where it leaves the window upwards: then it
    /// is brow or hair.
    fn grown(&self, grey: &Grey, ball: Eyeball, seeds: &[(usize, usize)], d: f64) -> Option<Eye> {
        let window = window(grey, ball.centre, d)?;
        let b = window.bounds;
        let regions = Regions::of(&window.dark(self.threshold), Neighbours::Four);
        let mut hits = vec![0_usize; regions.list.len() + 1];
        for (x, y) in seeds.iter().filter(|(x, y)| b.holds(*x, *y)) {
            hits[regions.labels[(x - b.x0, y - b.y0)] as usize] += 1;
        }
        hits[0] = 0;
        let least = (0.0015 * d * d).max(3.0) as usize;
        let of_eye = |r: &&Region| hits[r.label as usize] > 0 && r.area >= least && r.bounds.y0 > 0;
        let region = *regions.list.iter().filter(of_eye).max_by_key(|r| (r.area, std::cmp::Reverse(r.label)))?;
        let at = Eyeball::of(&regions, &region);
        let shift = Vec2::new(b.x0 as f64, b.y0 as f64);
        let r = region.bounds;
        let pixels: Vec<(usize, usize)> = regions.pixels_of(&region).map(|(x, y)| (x + b.x0, y + b.y0)).collect();
        Some(Eye {
            ball: Eyeball { centre: at.centre + shift, radius: at.radius },
            bounds: Bounds { x0: r.x0 + b.x0, y0: r.y0 + b.y0, x1: r.x1 + b.x0, y1: r.y1 + b.y0 },
            height: thickest(&pixels, b.x0, b.width(), ((COLUMNS * d) as usize).max(1)),
            pixels,
        })
    }
}

fn window(grey: &Grey, centre: Point, d: f64) -> Option<Window<'_>> {
    Window::of(grey, centre - REACH * d, centre + REACH * d)
}

/// How high a region is in its highest columns, on average over `most` of them.
fn thickest(pixels: &[(usize, usize)], from: usize, width: usize, most: usize) -> f64 {
    let mut columns = vec![0_u32; width];
    pixels.iter().for_each(|(x, _)| columns[x - from] += 1);
    columns.sort_unstable_by(|a, b| b.cmp(a));
    let taken = &columns[..most.min(width)];
    f64::from(taken.iter().sum::<u32>()) / taken.len().max(1) as f64
}

//! The photos that are learned from, and what is made of them: mirrored, in other light, less sharp.

use std::collections::BTreeMap;
use std::path::Path;

use lianpu::face::FeaturePoint;
use lianpu::face::find::Pyramid;
use lianpu::geometry::Point;
use lianpu::photo::{Photo, Plane};

use crate::chance::Chance;

/// Further points of the London set that steady the fit, in pairs left and right.
const FURTHER: [(usize, usize); 27] = [
    (126, 132),
    (127, 131),
    (128, 130),
    (134, 144),
    (135, 143),
    (137, 141),
    (138, 140),
    (109, 112),
    (110, 113),
    (111, 114),
    (88, 92),
    (104, 108),
    (105, 107),
    (50, 56),
    (52, 58),
    (54, 60),
    (61, 66),
    (19, 26),
    (21, 24),
    (28, 33),
    (30, 31),
    (72, 81),
    (73, 80),
    (74, 79),
    (75, 78),
    (83, 86),
    (84, 85),
];

/// Which points of the London set make one of ours, and which of ours is its mirror image.
pub struct Scheme {
    /// The feature points, in their order; then there are the further ones.
    pub features: Vec<FeaturePoint>,
    pub groups: Vec<String>,
    /// Points of the London set of which each of ours is the middle.
    of: Vec<Vec<usize>>,
    /// The same in a mirrored photo. 4.3a is not made of the mirror images of what makes 4.4a, so this is not `of` of
    /// the point at the other side.
    of_mirrored: Vec<Vec<usize>>,
}

impl Scheme {
    pub fn read(folder: &Path) -> Self {
        let table = std::fs::read_to_string(folder.join("points72.csv")).expect("points72.csv");
        let mut rows: Vec<(FeaturePoint, Vec<usize>, String)> = table
            .lines()
            .skip(1)
            .map(|line| {
                let cells: Vec<&str> = line.split(',').collect();
                let numbers = cells[1].split(' ').map(|n| n.parse().expect("a number")).collect();
                (FeaturePoint::named(cells[0]).expect("a point"), numbers, cells[2].to_owned())
            })
            .collect();
        rows.sort_by_key(|r| r.0);
        let features: Vec<_> = rows.iter().map(|r| r.0).collect();
        let mut of: Vec<Vec<usize>> = rows.iter().map(|r| r.1.clone()).collect();
        // Which point of the London set is at the other side: as the pairs above say, else as the table does.
        let mut other: BTreeMap<usize, usize> = BTreeMap::new();
        for (left, right) in FURTHER {
            other.extend([(left, right), (right, left)]);
        }
        for (feature, numbers) in features.iter().zip(&of) {
            let twin = features.iter().position(|g| *g == feature.mirror()).expect("a mirror image");
            for (a, b) in numbers.iter().zip(&of[twin]) {
                other.entry(*a).or_insert(*b);
            }
        }
        of.extend(FURTHER.iter().flat_map(|(left, right)| [vec![*left], vec![*right]]));
        let of_mirrored = of.iter().map(|numbers| numbers.iter().map(|n| other[n]).collect()).collect();
        Self { features, groups: rows.into_iter().map(|r| r.2).collect(), of, of_mirrored }
    }

    /// Points that are learned.
    pub fn count(&self) -> usize {
        self.of.len()
    }

    pub fn index(&self, name: &str) -> usize {
        let point = FeaturePoint::named(name).expect("a point");
        self.features.iter().position(|f| *f == point).expect("a learned point")
    }
}

/// A photo with its truth; without where there is none.
pub struct Shot {
    pub person: usize,
    pub photo: Photo,
    pub truth: Vec<Point>,
    pub mirrored: bool,
}

/// The London photos of a kind, each with its mirror image after it.
pub fn london(folder: &Path, scheme: &Scheme, kind: &str) -> Vec<Shot> {
    let mut names: Vec<String> = std::fs::read_dir(folder)
        .expect("the folder of the London set")
        .filter_map(|e| e.ok()?.file_name().into_string().ok())
        .filter(|n| n.ends_with(&format!("_{kind}.jpg")))
        .collect();
    names.sort();
    let mut shots = Vec::new();
    for name in names {
        // People are counted as the files are; a smiling photo belongs to the same person as the neutral one.
        let person = name[..3].parse().expect("a number");
        let photo = Photo::read(&folder.join(&name)).expect("a photo");
        let raw = std::fs::read_to_string(folder.join(name.replace(".jpg", ".pts"))).map(|text| points(&text)).ok();
        let last = (photo.width() - 1) as f64;
        let middle = |of: &Vec<usize>, raw: &[Point]| {
            let sum = of.iter().fold((0.0, 0.0), |s, i| (s.0 + raw[*i].x, s.1 + raw[*i].y));
            Point::new(sum.0 / of.len() as f64, sum.1 / of.len() as f64)
        };
        let truth = raw.as_ref().map(|raw| scheme.of.iter().map(|of| middle(of, raw)).collect()).unwrap_or_default();
        let flip = |p: Point| Point::new(last - p.x, p.y);
        let turned = raw.map(|raw| scheme.of_mirrored.iter().map(|of| flip(middle(of, &raw))).collect());
        let flipped = mirror(&photo);
        shots.push(Shot { person, photo, truth, mirrored: false });
        shots.push(Shot { person, photo: flipped, truth: turned.unwrap_or_default(), mirrored: true });
    }
    shots
}

fn points(text: &str) -> Vec<Point> {
    let inside = text.split(['{', '}']).nth(1).expect("points in braces");
    let point = |line: &str| {
        let mut numbers = line.split_whitespace().map(|n| n.parse().expect("a number"));
        Point::new(numbers.next().expect("x"), numbers.next().expect("y"))
    };
    inside.trim().lines().map(point).collect()
}

fn mirror(photo: &Photo) -> Photo {
    let width = photo.width();
    let pixels = photo.pixels().chunks_exact(width).flat_map(|row| row.iter().rev().copied()).collect();
    Photo::new(width, photo.height(), pixels)
}

/// How much of each pixel is wall: what can be reached from the upper border over pixels as grey and as bright as
/// the wall there. The London photos all have such a wall.
pub fn wall(photo: &Photo) -> Plane {
    let (w, h) = (photo.width(), photo.height());
    let colour = |x: usize, y: usize| photo.at(x as isize, y as isize).map(f32::from);
    // The wall's colour at the left and the right border, row by row, carried on below the shoulders.
    let sides: Vec<[[f32; 3]; 2]> = {
        let mean = |x0: usize, y: usize| {
            let mut sum = [0.0; 3];
            for x in x0..x0 + 8 {
                (0..3).for_each(|k| sum[k] += colour(x, y)[k] / 8.0);
            }
            sum
        };
        (0..h).map(|y| [mean(0, y.min(h / 3)), mean(w - 8, y.min(h / 3))]).collect()
    };
    let alike = |x: usize, y: usize| {
        let (t, c) = (x as f32 / w as f32, colour(x, y));
        let usual: [f32; 3] = std::array::from_fn(|k| sides[y][0][k] * (1.0 - t) + sides[y][1][k] * t);
        let light = c.iter().sum::<f32>() / usual.iter().sum::<f32>().max(1.0);
        let tint = |v: [f32; 3]| (v[0] - v[2], v[0] - v[1]);
        let ((a, b), (c, d)) = (tint(c), tint(usual));
        (0.80..1.22).contains(&light) && (a - c).abs() < 15.0 && (b - d).abs() < 11.0
    };
    let mut mask = Plane::filled(w, h, 0.0);
    let mut open: Vec<(usize, usize)> =
        (0..w).map(|x| (x, 0)).chain((0..h * 2 / 5).flat_map(|y| [(0, y), (w - 1, y)])).collect();
    while let Some((x, y)) = open.pop() {
        if mask[(x, y)] > 0.0 || !alike(x, y) {
            continue;
        }
        mask[(x, y)] = 1.0;
        if x > 0 {
            open.push((x - 1, y));
        }
        if x + 1 < w {
            open.push((x + 1, y));
        }
        if y > 0 {
            open.push((x, y - 1));
        }
        if y + 1 < h {
            open.push((x, y + 1));
        }
    }
    // A little into the face, else a seam of the old wall is left.
    let mut mask = mask.blurred(0.9);
    mask.pixels_mut().iter_mut().for_each(|v| *v = (*v * 1.5).min(1.0));
    mask
}

/// The luma of a photo before something else than its wall: one grey, mostly dark, or a slope of two, or clouds.
pub fn elsewhere(photo: &Photo, chance: &mut Chance) -> Plane {
    let mut plane = Plane::luma(photo);
    let mask = wall(photo);
    let (w, h) = (plane.width(), plane.height());
    let grey = |c: &mut Chance| if c.share() < 0.6 { c.between(5.0, 110.0) } else { c.between(110.0, 250.0) };
    let (a, b) = (grey(chance), grey(chance));
    let kind = chance.share();
    let (b, turn) = (if kind < 0.5 { a } else { b }, chance.between(0.0, std::f64::consts::TAU));
    let clouds = (kind > 0.8).then(|| crate::others::drawn(9 * chance.below(2), w, chance));
    for y in 0..h {
        for x in 0..w {
            let (u, v) = (x as f64 / w as f64 - 0.5, y as f64 / h as f64 - 0.5);
            let t = (u * turn.cos() + v * turn.sin() + 0.5).clamp(0.0, 1.0);
            let behind = clouds.as_ref().map_or((a + (b - a) * t) as f32, |c| c[(x, y.min(w - 1))]);
            let (share, value) = (mask[(x, y)], &mut plane[(x, y)]);
            *value += (behind - *value) * share;
        }
    }
    plane
}

/// A photo in other light: bent in brightness, lit from a side, less sharp, with noise; the first is the photo itself.
pub fn varied(photo: &Photo, variant: usize, chance: &mut Chance) -> Pyramid {
    let mut plane = if variant > 0 && chance.share() < 0.75 { elsewhere(photo, chance) } else { Plane::luma(photo) };
    if variant > 0 {
        let gamma = chance.between(-0.5, 0.5).exp() as f32;
        let (sx, sy) = (chance.normal() * 0.7, chance.normal() * 0.3);
        let (w, h) = (plane.width(), plane.height());
        let level = chance.between(0.5, 1.1);
        for y in 0..h {
            for x in 0..w {
                let (u, v) = (x as f64 / w as f64 - 0.5, y as f64 / h as f64 - 0.5);
                let light = (level * (4.0 * (sx * u + sy * v)).clamp(-1.2, 1.2).exp()) as f32;
                let value = &mut plane[(x, y)];
                *value = ((*value / 255.0).powf(gamma) * light * 255.0).min(255.0);
            }
        }
        if chance.share() < 0.6 {
            plane = plane.blurred(chance.between(0.5, 2.5));
        }
        let noise = chance.between(0.0, 5.0) as f32 * f32::from(u8::from(chance.share() < 0.5));
        if noise > 0.0 {
            plane.pixels_mut().iter_mut().for_each(|v| *v = (*v + noise * chance.normal() as f32).clamp(0.0, 255.0));
        }
    }
    Pyramid::over(plane, 1.0, Point::ORIGIN)
}

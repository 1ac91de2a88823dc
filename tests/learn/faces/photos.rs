//! The photos that are learned from, and what is made of them: mirrored, in other light, less sharp.

use std::path::Path;

use lianpu::face::FeaturePoint;
use lianpu::face::find::Pyramid;
use lianpu::geometry::Point;
use lianpu::photo::{Photo, Plane};

use crate::chance::Chance;

/// Further points of the London set that steady the fit, in pairs left and right.
const FURTHER: [(usize, usize); 21] = [
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
];

/// Which points of the London set make one of ours, and which of ours is its mirror image.
pub struct Scheme {
    /// The feature points, in their order; then there are the further ones.
    pub features: Vec<FeaturePoint>,
    pub groups: Vec<String>,
    pub of: Vec<Vec<usize>>,
    pub mirror: Vec<usize>,
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
        let mut mirror: Vec<usize> =
            features.iter().map(|f| features.iter().position(|g| *g == f.mirror()).expect("a mirror image")).collect();
        let mut of: Vec<Vec<usize>> = rows.iter().map(|r| r.1.clone()).collect();
        for (left, right) in FURTHER {
            let n = of.len();
            of.extend([vec![left], vec![right]]);
            mirror.extend([n + 1, n]);
        }
        Self { features, groups: rows.into_iter().map(|r| r.2).collect(), of, mirror }
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
        let truth = match std::fs::read_to_string(folder.join(name.replace(".jpg", ".pts"))) {
            Ok(text) => points(&text, scheme),
            Err(_) => Vec::new(),
        };
        let (flipped, turned) = mirror(&photo, &truth, scheme);
        shots.push(Shot { person, photo, truth, mirrored: false });
        shots.push(Shot { person, photo: flipped, truth: turned, mirrored: true });
    }
    shots
}

fn points(text: &str, scheme: &Scheme) -> Vec<Point> {
    let inside = text.split(['{', '}']).nth(1).expect("points in braces");
    let all: Vec<Point> = inside
        .trim()
        .lines()
        .map(|l| {
            let mut numbers = l.split_whitespace().map(|n| n.parse().expect("a number"));
            Point::new(numbers.next().expect("x"), numbers.next().expect("y"))
        })
        .collect();
    let middle = |of: &Vec<usize>| {
        let sum = of.iter().fold((0.0, 0.0), |s, i| (s.0 + all[*i].x, s.1 + all[*i].y));
        Point::new(sum.0 / of.len() as f64, sum.1 / of.len() as f64)
    };
    scheme.of.iter().map(middle).collect()
}

fn mirror(photo: &Photo, truth: &[Point], scheme: &Scheme) -> (Photo, Vec<Point>) {
    let width = photo.width();
    let pixels = photo.pixels().chunks_exact(width).flat_map(|row| row.iter().rev().copied()).collect();
    let last = (width - 1) as f64;
    let flip = |p: Point| Point::new(last - p.x, p.y);
    let turned = if truth.is_empty() { Vec::new() } else { scheme.mirror.iter().map(|m| flip(truth[*m])).collect() };
    (Photo::new(width, photo.height(), pixels), turned)
}

/// A photo in other light: bent in brightness, lit from a side, less sharp, with noise; the first is the photo itself.
pub fn varied(photo: &Photo, variant: usize, chance: &mut Chance) -> Pyramid {
    let mut plane = Plane::luma(photo);
    if variant > 0 {
        let gamma = chance.between(-0.5, 0.5).exp() as f32;
        let (sx, sy) = (chance.normal() * 0.7, chance.normal() * 0.3);
        let (w, h) = (plane.width, plane.height);
        let level = chance.between(0.5, 1.1);
        for y in 0..h {
            for x in 0..w {
                let (u, v) = (x as f64 / w as f64 - 0.5, y as f64 / h as f64 - 0.5);
                let light = (level * (4.0 * (sx * u + sy * v)).clamp(-1.2, 1.2).exp()) as f32;
                let value = &mut plane.values[y * w + x];
                *value = ((*value / 255.0).powf(gamma) * light * 255.0).min(255.0);
            }
        }
        if chance.share() < 0.6 {
            plane = plane.blurred(chance.between(0.5, 2.5));
        }
        let noise = chance.between(0.0, 5.0) as f32 * f32::from(u8::from(chance.share() < 0.5));
        if noise > 0.0 {
            plane.values.iter_mut().for_each(|v| *v = (*v + noise * chance.normal() as f32).clamp(0.0, 255.0));
        }
    }
    Pyramid::over(plane, 1.0, Point::ORIGIN)
}

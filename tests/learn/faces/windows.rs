//! Learning the detector: windows with a face, windows without, and those without that it took for one.

use lianpu::face::find::Pyramid;
use lianpu::face::find::training::{BELOW, CELL, Detector, Hit, Matrix, SCALE, SIDE, WINDOW, cells, window};
use lianpu::geometry::{Point, Similarity};
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::chance::Chance;
use crate::ridge::solve;

/// The tilt of the side templates, in radians: 18°. Each template sees faces up to 11° off its own tilt.
const LEAN: f64 = 0.314;
const OFF: f64 = 0.19;

/// A picture, and where its face is, if it has one.
pub struct Scene<'a> {
    pub picture: &'a Pyramid,
    pub face: Option<Similarity>,
}

/// The numbers of the window of a face.
fn sample(picture: &Pyramid, face: &Similarity, roll: f64) -> Vec<f32> {
    let pixels = (SIDE + 2) * CELL;
    // A level's frame: a pixel of it is `face.scale() / SCALE` photo pixels, turned so that the face leans by `roll`.
    let step = face.scale() / SCALE;
    let half = pixels as f64 / 2.0 - 0.5;
    let level = Similarity::new(Point::ORIGIN, step, face.angle() - roll);
    let middle = face.apply(Point::new(0.0, BELOW));
    let corner = middle - level.apply_vec(lianpu::geometry::Vec2::new(half, half));
    let plane = picture.crop(&Similarity { origin: corner, ..level }, pixels, pixels);
    let mut out = Vec::new();
    window(&cells(&plane), 1, 1, &mut out);
    out
}

/// A template mirrored.
fn mirrored(row: &[f32]) -> Vec<f32> {
    // Directions 0 and 4, 1 and 3, 5 and 7 change places.
    const OTHER: [usize; 8] = [4, 3, 2, 1, 0, 7, 6, 5];
    let mut out = vec![0.0; WINDOW];
    for y in 0..SIDE {
        for x in 0..SIDE {
            for k in 0..8 {
                out[(y * SIDE + x) * 8 + k] = row[(y * SIDE + SIDE - 1 - x) * 8 + OTHER[k]];
            }
        }
    }
    out
}

/// Logistic regression by Newton's method; rows of `yes` and `no` weigh the same in sum.
pub fn logistic(yes: &[Vec<f32>], no: &[Vec<f32>], penalty: f32, from: Option<(&[f32], f32)>) -> (Vec<f32>, f32) {
    let d = yes[0].len() + 1;
    let n = yes.len() + no.len();
    let x = DMatrix::from_fn(n, d, |i, j| {
        if j + 1 == d {
            1.0
        } else if i < yes.len() {
            yes[i][j]
        } else {
            no[i - yes.len()][j]
        }
    });
    let weight = |i: usize| if i < yes.len() { 0.5 / yes.len() as f32 } else { 0.5 / no.len() as f32 };
    let mut w = DVector::<f32>::zeros(d);
    if let Some((weights, bias)) = from {
        w.rows_mut(0, d - 1).copy_from_slice(weights);
        w[d - 1] = bias;
    }
    for _ in 0..6 {
        let z = &x * &w;
        let mut scaled = x.clone();
        let mut slope = DVector::<f32>::zeros(n);
        for i in 0..n {
            let p = 1.0 / (1.0 + (-z[i]).exp());
            let y = if i < yes.len() { 1.0 } else { 0.0 };
            slope[i] = weight(i) * (y - p);
            let c = (weight(i) * (p * (1.0 - p)).max(1e-4)).sqrt();
            scaled.row_mut(i).scale_mut(c);
        }
        let mut gradient = x.transpose() * slope - &w * penalty;
        gradient[d - 1] += w[d - 1] * penalty;
        let mut h = scaled.transpose() * &scaled;
        (0..d).for_each(|i| h[(i, i)] += if i + 1 == d { 1e-7 } else { penalty });
        let step = solve(h, DMatrix::from_column_slice(d, 1, gradient.as_slice()));
        w += step.column(0);
        if step.norm() < 0.02 * w.norm() {
            break;
        }
    }
    (w.as_slice()[..d - 1].to_vec(), w[d - 1])
}

/// Whether a hit lies on a face, or so near that it is no example of anything else.
pub fn near(hit: &Hit, face: &Similarity) -> bool {
    let middle = |f: &Similarity| f.apply(Point::new(0.0, BELOW));
    let size = hit.frame.scale() / face.scale();
    middle(&hit.frame).distance(middle(face)) < 0.45 * face.scale() && (0.6..1.6).contains(&size)
}

pub fn learn(scenes: &[Scene], rounds: usize) -> Detector {
    let mut detector = Detector {
        rolls: vec![-LEAN as f32, 0.0, LEAN as f32],
        templates: Matrix { rows: 3, columns: WINDOW, values: vec![0.0; 3 * WINDOW] },
        bias: vec![0.0; 3],
    };
    let shifted = |lean: f64| -> Vec<Vec<f32>> {
        scenes
            .par_iter()
            .enumerate()
            .filter_map(|(i, s)| Some((i, s.picture, s.face?)))
            .flat_map_iter(|(i, picture, face)| {
                let mut chance = Chance(i as u64 * 31 + 3);
                (0..6).map(move |_| {
                    let by = Similarity::new(
                        Point::new(chance.between(-0.09, 0.09), chance.between(-0.09, 0.09)),
                        chance.between(-0.11, 0.11).exp(),
                        chance.between(-OFF, OFF),
                    );
                    let seen = face.after(&by);
                    sample(picture, &seen, lean)
                })
            })
            .collect()
    };
    let yes = [shifted(0.0), shifted(LEAN)];
    let mut no: [Vec<Vec<f32>>; 2] = [Vec::new(), Vec::new()];
    // At first windows by chance.
    let first: Vec<Vec<f32>> = scenes
        .par_iter()
        .enumerate()
        .flat_map_iter(|(i, s)| {
            let mut chance = Chance(i as u64 * 17 + 1);
            let (w, h) = s.picture.size();
            (0..12).filter_map(move |_| {
                let scale = chance.between(24f64.ln(), (0.4 * w.min(h)).max(30.0).ln()).exp();
                let frame = Similarity::new(Point::new(chance.between(0.0, w), chance.between(0.0, h)), scale, 0.0);
                let hit = Hit { frame, score: 0.0, template: 1 };
                (!s.face.is_some_and(|f| near(&hit, &f))).then(|| sample(s.picture, &frame, 0.0))
            })
        })
        .collect();
    no[0].clone_from(&first);
    no[1] = first;
    for round in 0..=rounds {
        for (kind, row) in [(0, 1), (1, 2)] {
            let before = (round > 0).then(|| (detector.templates.row(row), detector.bias[row]));
            let (weights, bias) = logistic(&yes[kind], &no[kind], 2e-4, before);
            detector.templates.values[row * WINDOW..(row + 1) * WINDOW].copy_from_slice(&weights);
            detector.bias[row] = bias;
        }
        let left = mirrored(detector.templates.row(2));
        detector.templates.values[..WINDOW].copy_from_slice(&left);
        detector.bias[0] = detector.bias[2];
        if round == rounds {
            break;
        }
        // Those with a face have little else in them: every third will do.
        let some = |i: usize, s: &Scene| s.face.is_none() || i % 3 == round % 3;
        let wrong: Vec<(usize, Vec<f32>)> = scenes
            .par_iter()
            .enumerate()
            .filter(|(i, s)| some(*i, s))
            .flat_map_iter(|(_, s)| {
                let hits = detector.scan(s.picture, 24.0, -1.0);
                let wrong = hits.into_iter().filter(|h| !s.face.is_some_and(|f| near(h, &f))).take(8);
                wrong
                    .map(|h| {
                        let roll = f64::from(detector.rolls[h.template]);
                        let numbers = sample(s.picture, &h.frame, roll);
                        if h.template == 0 { (1, flipped(&numbers)) } else { (h.template - 1, numbers) }
                    })
                    .collect::<Vec<_>>()
            })
            .collect();
        println!("  detector round {}: {} windows taken for faces", round + 1, wrong.len());
        for (kind, numbers) in wrong {
            no[kind].push(numbers);
        }
    }
    detector
}

fn flipped(numbers: &[f32]) -> Vec<f32> {
    mirrored(numbers)
}

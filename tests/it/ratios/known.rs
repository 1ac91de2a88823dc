//! Ratios whose truth is known: the frames of `projects/xiyang` are rendered, so that the mix of every frame and the places
//! of its points are known (`tests/truth`, made by `tests/samples/xiyang.rs`).

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use std::path::{Path, PathBuf};

use lianpu::aam::{Fitter, Kind, Model, Options, Start};
use lianpu::calibration::{self, Binding, Calibration, Choice, Kept, Shape};
use lianpu::face::FeaturePoint;
use lianpu::geometry::{Point, Vec2};
use lianpu::media::Source;
use lianpu::photo::Grey;
use lianpu::pose::{Emotion, Ratios};
use lianpu::ratios::Record;
use lianpu::track::by_aam;

use crate::support::chance::Chance;

/// A frame of the truth.
struct Known {
    speaking: f64,
    closed: f64,
    points: Vec<Point>,
    ratios: Ratios,
}

fn here(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

/// The rows of a table of points: what stands before them, and the points.
fn rows(name: &str, before: usize) -> Vec<(Vec<String>, Vec<Point>)> {
    let text = std::fs::read_to_string(here(name)).unwrap();
    let head: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    let names: Vec<String> = Binding::own_points().flat_map(|p| [format!("{p}x"), format!("{p}y")]).collect();
    assert_eq!(head[before..], names, "the points are those of a model of our own");
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        let numbers: Vec<f64> = cells[before..].iter().map(|c| c.parse().unwrap()).collect();
        let points = numbers.chunks_exact(2).map(|p| Point::new(p[0], p[1])).collect();
        (cells[..before].iter().map(|c| (*c).to_owned()).collect(), points)
    };
    text.lines().skip(1).map(row).collect()
}

fn shots() -> [Vec<Point>; 7] {
    let rows = rows("tests/truth/xiyang-shots.csv", 1);
    assert!(rows.iter().zip(Emotion::ALL).all(|(row, emotion)| row.0[0] == emotion.name()));
    rows.into_iter().map(|row| row.1).collect::<Vec<_>>().try_into().unwrap()
}

fn frames() -> Vec<Known> {
    let text = std::fs::read_to_string(here("tests/truth/xiyang-ratios.csv")).unwrap();
    let record = Record::parse(&text).unwrap();
    let rows = rows("tests/truth/xiyang-points.csv", 3);
    assert_eq!(rows.len(), record.rows.len());
    rows.into_iter()
        .zip(&record.rows)
        .map(|((before, points), row)| Known {
            speaking: before[1].parse().unwrap(),
            closed: before[2].parse().unwrap(),
            points,
            ratios: row.ratios,
        })
        .collect()
}

fn calibration(shapes: [Vec<Point>; 7]) -> Calibration {
    Calibration::new(shapes.map(|points| Shape { points, source: calibration::Source::Marked }), Binding::own())
        .unwrap()
}

fn pupils(points: &[Point]) -> f64 {
    let at = |p| Binding::own().at(points, p).unwrap();
    at(FeaturePoint::P3_6).distance(at(FeaturePoint::P3_5))
}

/// The mean difference of the seven ratios.
fn off(a: &Ratios, b: &Ratios) -> f64 {
    a.0.iter().zip(b.0).map(|(a, b)| (a - b).abs()).sum::<f64>() / 7.0
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let all: Vec<f64> = values.collect();
    assert!(!all.is_empty());
    all.iter().sum::<f64>() / all.len() as f64
}

/// The mean errors of three stretches: silent with open eyes, silent with a blink, speaking.
fn by_stretch(known: &[Known], read: &[Ratios]) -> [f64; 3] {
    let all: Vec<_> = known.iter().zip(read).collect();
    let of = |f: &dyn Fn(&Known) -> bool| mean(all.iter().filter(|(k, _)| f(k)).map(|(k, r)| off(&k.ratios, r)));
    [
        of(&|k| k.speaking == 0.0 && k.closed == 0.0),
        of(&|k| k.speaking == 0.0 && k.closed > 0.0),
        of(&|k| k.speaking > 0.0),
    ]
}

#[test]
fn each_calibration_shot_returns_its_own_emotion() {
    let calibration = calibration(shots());
    for (emotion, points) in Emotion::ALL.into_iter().zip(shots()) {
        for choice in [Choice::Paper, Choice::NonNegative] {
            let read = calibration.read(&points, choice).unwrap();
            assert!((read.ratios.sum() - 1.0).abs() <= 1e-9);
            for other in Emotion::ALL {
                let own = f64::from(u8::from(other == emotion));
                assert!((read.ratios[other] - own).abs() <= 0.01, "{emotion} shows {other} as {}", read.ratios[other]);
            }
        }
    }
}

/// A way to read ratios.
type Way = fn(&Calibration, &[Point]) -> Ratios;

/// Eq. 6 as the paper has it, and what tracking takes unless it is told otherwise.
const WAYS: [(&str, Way); 2] = [
    ("paper", |c, points| c.read(points, Choice::Paper).unwrap().ratios),
    ("apart", |c, points| c.read_apart(points, Choice::NonNegative).unwrap().ratios),
];

#[test]
fn known_points_give_the_known_mix_and_noise_of_two_per_cent_moves_it_little() {
    let calibration = calibration(shots());
    let known = frames();
    for (name, way) in WAYS {
        let read = |points: &[Point]| {
            let read = way(&calibration, points);
            assert!((read.sum() - 1.0).abs() <= 1e-9);
            read
        };
        let clean: Vec<Ratios> = known.iter().map(|k| read(&k.points)).collect();
        let [open, blink, speaking] = by_stretch(&known, &clean);
        println!("{name}, known points: mean error {open:.4} silent, {blink:.4} in a blink, {speaking:.4} speaking");
        assert!(open <= 0.02, "{open}");

        let mut chance = Chance(5);
        let noisy: Vec<Ratios> = known
            .iter()
            .map(|k| {
                // So that a point is off by 2 % of the pupils' distance, root mean square.
                let by = 0.02 * pupils(&k.points) / 2.0_f64.sqrt();
                let moved = |p: &Point| *p + Vec2::new(chance.normal(), chance.normal()) * by;
                read(&k.points.iter().map(moved).collect::<Vec<_>>())
            })
            .collect();
        let [open, blink, speaking] = by_stretch(&known, &noisy);
        println!("{name}, 2 % noise: mean error {open:.4} silent, {blink:.4} in a blink, {speaking:.4} speaking");
        assert!(open <= 0.06, "{open}");
    }
}

#[test]
fn tracked_frames_give_the_known_mix() {
    let folder = here("projects/xiyang/faces/teacher");
    let picture = |emotion: Emotion| {
        let name = emotion.name();
        let path = ["png", "jpg"].map(|e| folder.join(format!("{name}.{e}"))).into_iter().find(|p| p.is_file());
        Grey::read(&path.unwrap()).unwrap()
    };
    let greys = Emotion::ALL.map(picture);
    let shapes = shots();
    let examples: Vec<(&Grey, &[Point])> = greys.iter().zip(&shapes).map(|(g, s)| (g, &s[..])).collect();
    let model = Model::train(&examples, &Options::of(Kind::Person)).unwrap();
    let calibration = calibration(shapes);

    let known = frames();
    let mut fitter = Fitter::new(&model);
    let mut before = None;
    let mut read = [Vec::new(), Vec::new()];
    let mut errors = Vec::new();
    for (frame, k) in known.iter().enumerate() {
        let path = here(&format!("projects/xiyang/clips/xiyang/frames/{frame:04}.jpg"));
        let grey = Grey::read(&path).unwrap();
        let fit = match &before {
            Some(fit) => fitter.follow(&grey, fit),
            None => {
                let found = lianpu::face::find::find(&grey.to_photo(), &[]).unwrap();
                fitter.fit(&grey, Start::Points(&model.start(&found).unwrap()))
            }
        };
        assert!(fit.confidence >= 0.5, "frame {frame} is lost: {}", fit.confidence);
        let off = fit.points.iter().zip(&k.points).map(|(a, b)| a.distance(*b));
        errors.push(100.0 * mean(off) / pupils(&k.points));
        for ((_, way), read) in WAYS.iter().zip(&mut read) {
            let ratios = way(&calibration, &fit.points);
            assert!((ratios.sum() - 1.0).abs() <= 1e-9);
            read.push(ratios);
        }
        before = Some(fit);
    }
    println!("tracked: points {:.2} % off", mean(errors.into_iter()));
    for (((name, _), read), most) in WAYS.iter().zip(&read).zip([0.03, 0.02]) {
        let [open, blink, speaking] = by_stretch(&known, read);
        println!("{name}, tracked: mean error {open:.4} silent, {blink:.4} in a blink, {speaking:.4} speaking");
        // The paper's way comes to 0.026: of eyes that look aside and of closed lids the seven shots have no example.
        assert!(open <= most, "{name}: {open}");
    }
}

#[test]
fn a_video_tells_the_known_mix_from_photos_alone() {
    let known = frames();
    let folder = here("projects/xiyang/faces/teacher");
    let made = Kept::make(&folder).unwrap().made;
    let source = Source::of(&here("projects/xiyang/clips/xiyang/frames"), 25.0).unwrap();
    let tracked =
        by_aam(&source, &made.model, &made.calibration, &lianpu::track::Options::default(), &mut |_, _| true).unwrap();
    let read: Vec<Ratios> = tracked.record.rows.iter().map(|r| r.ratios).collect();
    assert_eq!(read.len(), known.len());
    let [open, blink, speaking] = by_stretch(&known, &read);
    println!("photos alone: mean error {open:.4} silent, {blink:.4} in a blink, {speaking:.4} speaking");
    assert!(open <= 0.02 && speaking <= 0.06, "{open} {speaking}");
}

//! The ratio record: how small it is, how true, and what damage does to it.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use std::path::Path;

use lianpu::aam::{Annotation, Fit, Fitter, Grey, Kind, Model, Options, Start};
use lianpu::emotion::{Binding, Calibration, Choice, LprWriter, Moment, Record, Row, Shape, Source, Whole, to_lpr};
use lianpu::face::FeaturePoint as P;
use lianpu::geometry::Point;

mod test_data;

fn load(folder: &Path, name: &str) -> (Grey, Vec<Point>) {
    let grey = Grey::read(&folder.join(format!("{name}.jpg"))).unwrap();
    let list = Annotation::read(&folder.join(format!("{name}.pts"))).unwrap();
    let points = list[0].in_pixels([grey.width(), grey.height()]);
    (grey, points)
}

/// Frames a second of the talking man.
const FPS: f64 = 25.0;

/// The talking man tracked, his seven calibration shots taken for emotions: 1241 frames of real movement and noise.
fn franck() -> Option<Record> {
    let folder = test_data::find("faces/franck")?;
    let shots: Vec<_> = ["0075", "0260", "0565", "1080", "1090", "1095", "1195"]
        .iter()
        .map(|name| load(&folder.join("calibration"), name))
        .collect();
    let pairs: Vec<(&Grey, &[Point])> = shots.iter().map(|(g, s)| (g, &s[..])).collect();
    let model = Model::train(&pairs, &Options { detect: false, ..Options::of(Kind::Person) }).unwrap();
    let shapes = std::array::from_fn(|i| Shape { points: shots[i].1.clone(), source: Source::Marked });
    let binding = Binding::of_rows(154, vec![(P::P3_6, vec![(152, 1.0)]), (P::P3_5, vec![(153, 1.0)])]);
    let calibration = Calibration::new(shapes, binding).unwrap();
    let mut fitter = Fitter::new(&model);
    let mut before: Option<Fit> = None;
    let row = |n: u32| {
        let grey = Grey::read(&folder.join(format!("frames/{n:04}.jpg"))).unwrap();
        let fit = match &before {
            Some(before) => fitter.follow(&grey, before),
            None => fitter.fit(&grey, Start::Points(&shots[0].1)),
        };
        let ratios = calibration.read(&fit.points, Choice::Paper).unwrap().ratios;
        let row = Row { frame: n, time: f64::from(n) / FPS, ratios, confidence: fit.confidence };
        before = Some(fit);
        row
    };
    Some(Record { rows: (0..1241).map(row).collect() })
}

/// The largest and the mean error of the seven ratios.
fn errors(a: &Record, b: &Record) -> (f64, f64) {
    assert_eq!(a.rows.len(), b.rows.len());
    let pairs = a.rows.iter().zip(&b.rows);
    let all: Vec<f64> = pairs.flat_map(|(a, b)| (0..7).map(|i| (a.ratios.0[i] - b.ratios.0[i]).abs())).collect();
    (all.iter().copied().fold(0.0, f64::max), all.iter().sum::<f64>() / all.len() as f64)
}

#[test]
fn the_record_of_a_talking_man_is_small_and_true() {
    let Some(record) = franck() else { return };
    let bytes = to_lpr(&record, None, FPS).unwrap();
    let back = Whole::read(&bytes[..]).unwrap();
    let (most, mean) = errors(&record, &back.record);
    let count = record.rows.len();
    println!(
        "file: {count} frames in {} bytes, {:.2} a frame; error at most {most:.5}, mean {mean:.5}",
        bytes.len(),
        bytes.len() as f64 / count as f64
    );
    assert!(back.damage.is_none() && back.fps == FPS && back.tracks.is_none());
    assert!(bytes.len() <= 5000 && most <= 0.01 && mean <= 0.005, "{} {most} {mean}", bytes.len());
    for (a, b) in record.rows.iter().zip(&back.record.rows) {
        assert_eq!((a.frame, a.time), (b.frame, b.time));
        assert!((a.confidence - b.confidence).abs() <= 1.0 / 32.0 && (b.ratios.sum() - 1.0).abs() <= 1e-9);
    }
    let mut live = LprWriter::new(Vec::new(), FPS, false).unwrap();
    for row in &record.rows {
        live.push(&Moment { row: *row, track: None }).unwrap();
    }
    let live = live.finish().unwrap();
    println!("live, a packet a frame: {} bytes, {:.0} a second", live.len(), live.len() as f64 / count as f64 * FPS);
    assert_eq!(errors(&record, &Whole::read(&live[..]).unwrap().record), (most, mean));
}

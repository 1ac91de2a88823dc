//! The nets: equal to the reference, refused where damaged, and right on people that nothing was learned from.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use super::points::true_eyes;
use crate::support::test_data;
use lianpu::face::FeaturePoint as P;
use lianpu::face::find::find;
use lianpu::face::net::{Levels, Net, NetError, Scratch, detect, mesh};
use lianpu::geometry::Point;
use lianpu::photo::Photo;
use std::path::Path;

const DETECTOR: &[u8] = include_bytes!("../../../src/face/net/face_detection_short_range.tflite");
const MESH: &[u8] = include_bytes!("../../../src/face/net/face_landmark_with_attention.tflite");

/// An input of any picture's values between `low` and 1.
fn pattern(count: usize, low: f64) -> Vec<f32> {
    let mut state: u32 = 1_234_567;
    let values = (0..count).map(|_| {
        state = state.wrapping_mul(1_103_515_245).wrapping_add(12345) & 0x7fff_ffff;
        (low + (1.0 - low) * f64::from((state >> 8) & 255) / 255.0) as f32
    });
    values.collect()
}

/// FNV-1a over the bits of all outputs.
fn fingerprint(outputs: &[Vec<f32>]) -> u64 {
    let add = |sum: u64, v: &f32| (sum ^ u64::from(v.to_bits())).wrapping_mul(0x0100_0000_01b3);
    outputs.iter().flatten().fold(0xcbf2_9ce4_8422_2325, add)
}

#[test]
fn the_nets_give_the_same_bits_on_every_processor() {
    let mut scratch = Scratch::default();
    for (file, low, expected) in [(DETECTOR, -1.0, 0x0cfe_9550_62d2_619c), (MESH, 0.0, 0x88de_f653_10c0_85e4)] {
        let net = Net::read(file).unwrap();
        let outputs = net.run(&pattern(net.input_len(), low), &mut scratch);
        assert_eq!(fingerprint(&outputs), expected);
    }
}

#[test]
fn damaged_nets_are_refused_and_never_stop_the_program() {
    let mut state: u64 = 9;
    let mut next = |below: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    let mut refused = 0;
    for round in 0..300 {
        let mut file = DETECTOR.to_vec();
        if round % 3 == 0 {
            file.truncate(next(file.len()));
        } else {
            // Tables lie at the front and at the end, weights between.
            for _ in 0..=next(8) {
                let at = if round % 2 == 0 { next(30_000) } else { file.len() - 1 - next(30_000) };
                file[at] = next(256) as u8;
            }
        }
        match Net::read(&file) {
            Ok(net) => drop(net.run(&vec![0.5; net.input_len()], &mut Scratch::default())),
            Err(_) => refused += 1,
        }
    }
    println!("{refused} of 300 refused");
    assert!(refused > 120);
    assert_eq!(Net::read(b"").unwrap_err(), NetError::Damaged);
    assert_eq!(Net::read(&[255; 64]).unwrap_err(), NetError::Damaged);
}

/// Where the London truth has our points, by photo: `points72.csv` names the templates' points.
fn truth(folder: &Path, name: &str) -> Vec<(P, Point)> {
    let text = std::fs::read_to_string(folder.join(format!("{name}.pts"))).unwrap();
    let numbers: Vec<Point> = text
        .lines()
        .filter_map(|l| {
            let mut cells = l.split_whitespace().map(str::parse::<f64>);
            Some(Point::new(cells.next()?.ok()?, cells.next()?.ok()?))
        })
        .collect();
    let table = std::fs::read_to_string(folder.join("points72.csv")).unwrap();
    let rows = table.lines().skip(1).filter_map(|l| {
        let mut cells = l.split(',');
        let point = P::named(cells.next()?)?;
        let at: Vec<usize> = cells.filter_map(|c| c.trim().parse().ok()).collect();
        let of = |i: usize| numbers.get(i).copied();
        match at[..] {
            [a] => Some((point, of(a)?)),
            [a, b] => Some((point, of(a)?.midpoint(of(b)?))),
            _ => None,
        }
    });
    rows.collect()
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn a_mesh_gives_the_points_of_the_london_people() {
    let Some(folder) = test_data::find("faces/london") else { return };
    let mut names: Vec<_> = std::fs::read_dir(&folder).unwrap().map(|e| e.unwrap().path()).collect();
    names.retain(|p| p.to_str().unwrap().ends_with("neutral.jpg"));
    names.sort();
    let mut scratch = Scratch::default();
    let mut sums = std::collections::BTreeMap::<String, (f64, u32)>::new();
    for path in &names {
        let photo = Photo::read(path).unwrap();
        let levels = Levels::of(&photo);
        let found = detect(&levels, &mut scratch);
        assert_eq!(found.len(), 1, "{}", path.display());
        let first = mesh(&levels, &found[0].square(), &mut scratch);
        let mesh = mesh(&levels, &first.square(), &mut scratch);
        let truth = truth(&folder, path.file_stem().unwrap().to_str().unwrap());
        let unit = mesh.frame().scale();
        for (point, at) in mesh.feature_points() {
            let Some((_, right)) = truth.iter().find(|(p, _)| *p == point) else { continue };
            let entry = sums.entry(point.name()).or_default();
            *entry = (entry.0 + at.distance(*right) / unit, entry.1 + 1);
        }
    }
    let inner = |name: &str| P::named(name).unwrap().index() < P::P2_1.index();
    let (sum, count) = sums.iter().filter(|(n, _)| inner(n)).fold((0.0, 0), |s, (_, v)| (s.0 + v.0, s.1 + v.1));
    for (name, (sum, count)) in &sums {
        print!("{name} {:.2}  ", 100.0 * sum / f64::from(*count));
    }
    println!("\n{} people, inner {:.2} %", names.len(), 100.0 * sum / f64::from(count));
    assert!(sum / f64::from(count) < 0.025);
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn faces_in_any_light_and_mood_are_found() {
    let Some(folder) = test_data::find("faces/imm240") else { return };
    let mut names: Vec<_> = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    names.retain(|p| p.extension().is_some_and(|e| e == "jpg"));
    names.sort();
    let mut refused = Vec::new();
    for name in &names {
        // Smiles, light from one side, free expressions: 9 of these 80 the cascade does not find by itself.
        let photo = Photo::read(name).unwrap();
        let found = match find(&photo, &[]) {
            Ok(found) => found,
            Err(refusal) => {
                refused.push(format!("{}: {refusal}", name.display()));
                continue;
            }
        };
        let eyes = [P::P3_6, P::P3_5].map(|p| found.points[p.index()].at);
        let (left, right) = true_eyes(name, (photo.width(), photo.height()));
        let off = eyes[0].distance(left).max(eyes[1].distance(right)) / left.distance(right);
        assert!(off < 0.2, "{}: an eye is {off:.3} pupil distances off", name.display());
    }
    assert!(names.len() == 80 && refused.len() <= 1, "{refused:?}");
}

//! How a face deforms: the rules of thesis 4.4 and 5.5 and of the recipe, on an average face, on measured ones and on
//! any.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

mod any;
mod face;
mod mouth;
mod sound;

use crate::support::average_face;
use crate::support::test_data;
use std::path::Path;

use lianpu::face::rig::{Neutral, Proportions};
use lianpu::face::{FeaturePoint as P, Points, to_face_frame};
use lianpu::geometry::Point;
use lianpu::pose::{Emotion, MouthPose, MouthPreset, MouthShape, Pose, Ratios};

use sound::sound;

const MOUTH: [P; 8] = [P::P8_4, P::P8_3, P::P8_9, P::P8_10, P::P8_1, P::P2_2, P::P2_3, P::P8_2];
const PRESETS: [MouthPreset; 2] = [MouthPreset::Distinct, MouthPreset::Thesis];

fn average() -> Neutral {
    Neutral::of(&average_face::points(), &Proportions::NORMAL)
}

/// M = max(MNS0, 0.33 MW0), bounded as on the timeline.
fn unit(neutral: &Neutral) -> f64 {
    let u = neutral.units();
    u.mouth_nose.clamp(0.33 * u.mouth_width, 0.40 * u.mouth_width)
}

fn says(shape: MouthShape, preset: MouthPreset, emotion: Emotion) -> Pose {
    Pose { mouth: MouthPose::of(shape, preset), ..Pose::of(Ratios::pure(emotion)) }
}

fn spoken(shape: MouthShape) -> Pose {
    says(shape, MouthPreset::Distinct, Emotion::Neutral)
}

fn felt(emotion: Emotion) -> Pose {
    Pose::of(Ratios::pure(emotion))
}

/// The faces of the test data in the face frame.
fn measured() -> Vec<(String, Points)> {
    let Some(folder) = test_data::find("faces/london") else { return Vec::new() };
    let table = std::fs::read_to_string(folder.join("points72.csv")).unwrap();
    let mut files: Vec<_> = std::fs::read_dir(&folder).unwrap().flatten().map(|e| e.path()).collect();
    files.retain(|p| p.extension().is_some_and(|e| e == "pts"));
    files.sort();
    files.iter().map(|f| (f.file_stem().unwrap().to_string_lossy().into_owned(), read(f, &table))).collect()
}

fn read(file: &Path, table: &str) -> Points {
    let text = std::fs::read_to_string(file).unwrap();
    let rows = text.split(['{', '}']).nth(1).unwrap().trim().lines();
    let raw: Vec<Point> = rows
        .map(|row| {
            let n: Vec<f64> = row.split_whitespace().map(|c| c.parse().unwrap()).collect();
            Point::new(n[0], n[1])
        })
        .collect();
    let frame = to_face_frame(raw[0], raw[1]);
    // What the table has no place for is set by rule and does not move.
    let mut points = average_face::points();
    for row in table.lines().skip(1) {
        let cells: Vec<&str> = row.split(',').collect();
        let places: Vec<Point> = cells[1].split(' ').map(|i| raw[i.parse::<usize>().unwrap()]).collect();
        let sum = places.iter().fold((0.0, 0.0), |(x, y), p| (x + p.x, y + p.y));
        let n = places.len() as f64;
        points[P::named(cells[0]).unwrap()] = frame * Point::new(sum.0 / n, sum.1 / n);
    }
    points
}

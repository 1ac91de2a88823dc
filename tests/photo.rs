//! The thesis's stages on real photos.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

mod test_data;

use std::path::{Path, PathBuf};

use lianpu::face::{FeaturePoint, thesis};
use lianpu::geometry::Point;
use lianpu::photo::{Photo, Stages};

/// The files of a folder of test data whose names end so, in order.
fn files(folder: &str, end: &str) -> Vec<PathBuf> {
    let Some(folder) = test_data::find(folder) else { return Vec::new() };
    let mut found: Vec<PathBuf> = std::fs::read_dir(folder)
        .unwrap()
        .map(|e| e.unwrap().path())
        .filter(|p| p.to_str().is_some_and(|p| p.ends_with(end)))
        .collect();
    found.sort();
    found
}

/// The points of a `.pts` file beside a photo.
fn pts(photo: &Path) -> Vec<Point> {
    let text = std::fs::read_to_string(photo.with_extension("pts")).unwrap();
    let pair = |l: &str| {
        let (x, y) = l.trim().split_once(' ')?;
        Some(Point::new(x.parse().ok()?, y.trim().parse().ok()?))
    };
    text.lines().filter_map(pair).collect()
}

/// The middles of both eyes' outlines in an `.asf` file beside a photo.
fn asf_eyes(photo: &Path, size: (f64, f64)) -> [Point; 2] {
    let text = std::fs::read_to_string(photo.with_extension("asf")).unwrap();
    let mut sums = [(0.0, 0.0, 0.0); 2];
    for line in text.lines() {
        let cells: Vec<f64> = line.split_whitespace().map_while(|c| c.parse().ok()).collect();
        if let [path @ (1.0 | 2.0), _, x, y, ..] = cells[..] {
            let sum = &mut sums[if path == 2.0 { 0 } else { 1 }];
            *sum = (sum.0 + x * size.0, sum.1 + y * size.1, sum.2 + 1.0);
        }
    }
    sums.map(|(x, y, n)| Point::new(x / n, y / n))
}

/// The share of photos whose eyes are found within 0.10 and within 0.15 pupil distances.
fn eye_pairs(photos: &[(Photo, [Point; 2])]) -> [f64; 2] {
    let errors: Vec<f64> = photos
        .iter()
        .map(|(photo, truth)| {
            let stages = Stages::of(photo);
            stages.located.as_ref().map_or(f64::INFINITY, |l| {
                let off = |eye: Point, truth: Point| stages.to_photo(eye).distance(truth);
                off(l.eyes.left.centre, truth[0]).max(off(l.eyes.right.centre, truth[1])) / truth[0].distance(truth[1])
            })
        })
        .collect();
    [0.10, 0.15].map(|limit| errors.iter().filter(|e| **e <= limit).count() as f64 / errors.len() as f64)
}

fn london() -> Vec<(Photo, Vec<Point>)> {
    files("faces/london", "_neutral.jpg").iter().map(|p| (Photo::read(p).unwrap(), pts(p))).collect()
}

#[test]
fn the_eye_pair_is_found_as_often_as_the_thesis_finds_it() {
    let london: Vec<_> = london().into_iter().map(|(photo, p)| (photo, [p[0], p[1]])).collect();
    let imm: Vec<_> = files("faces/imm240", "-1m.jpg")
        .into_iter()
        .chain(files("faces/imm240", "-1f.jpg"))
        .map(|path| {
            let photo = Photo::read(&path).unwrap();
            let eyes = asf_eyes(&path, (photo.width() as f64, photo.height() as f64));
            (photo, eyes)
        })
        .collect();
    if london.is_empty() || imm.is_empty() {
        return;
    }
    for (name, photos) in [("london", &london), ("imm240", &imm)] {
        let [tight, wide] = eye_pairs(photos);
        println!(
            "{name}: {} photos, within 0.10 {:.1} %, within 0.15 {:.1} %",
            photos.len(),
            100.0 * tight,
            100.0 * wide
        );
    }
}

/// Which of London's 189 points score which of ours, and in which group.
fn london_table() -> Vec<(FeaturePoint, Vec<usize>, String)> {
    let Some(path) = test_data::find("faces/london/points72.csv") else { return Vec::new() };
    let text = std::fs::read_to_string(path).unwrap();
    let row = |l: &str| {
        let cells: Vec<&str> = l.split(',').collect();
        let at = cells[1].split_whitespace().map(|n| n.parse().unwrap()).collect();
        (FeaturePoint::named(cells[0]).unwrap(), at, cells[2].to_owned())
    };
    text.lines().skip(1).map(row).collect()
}

#[test]
fn the_thesiss_points_lie_as_near_as_they_were_measured_to() {
    let table = london_table();
    let photos = london();
    if table.is_empty() || photos.is_empty() {
        return;
    }
    let groups = ["brow", "eye", "nose", "mouth", "contour", "ear"];
    let mut errors = vec![vec![Vec::new(); groups.len()]; 2];
    for (photo, truth) in &photos {
        for (way, errors) in errors.iter_mut().enumerate() {
            let stages = if way == 0 { Stages::of(photo) } else { Stages::with_eyes(photo, truth[0], truth[1]) };
            let Some(points) = thesis::points(&stages) else { continue };
            for (point, at, group) in &table {
                let sum = at.iter().fold(lianpu::geometry::Vec2::ZERO, |s, i| s + truth[*i].to_vec2());
                let wanted = (sum / at.len() as f64).to_point();
                let error = points[point.index()].at.distance(wanted) / truth[0].distance(truth[1]);
                errors[groups.iter().position(|g| g == group).unwrap()].push(error);
            }
        }
    }
    for (way, errors) in ["eyes as printed", "true eyes"].iter().zip(&mut errors) {
        for (group, errors) in groups.iter().zip(errors) {
            errors.sort_by(f64::total_cmp);
            let mean = errors.iter().sum::<f64>() / errors.len() as f64;
            println!("{way}, {group}: {} points, mean {mean:.3}, median {:.3}", errors.len(), errors[errors.len() / 2]);
        }
    }
}

//! The face in a photo and its points: found on photos that nothing was learned from, refused where there is none,
//! bent to what a hand has set.
//!
//! Accuracy by people whom the numbers have not seen is measured by `cargo run --release --features tools --example learn-faces -- DATA
//! --cross-validate`; its table is in `src/face/find/NOTES.md`.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use crate::support::test_data;
use std::path::{Path, PathBuf};

use lianpu::face::find::{Anchors, Doubt, Found, Model, Pyramid, Refusal, find, find_from};
use lianpu::face::{FeaturePoint as P, How};
use lianpu::figure::LineFigure;
use lianpu::geometry::{Point, Similarity};
use lianpu::photo::{Photo, Plane};
use lianpu::pose::{Emotion, Pose, Ratios};
use lianpu::render::Painter;

fn photos(folder: &str, keep: impl Fn(&str) -> bool) -> Option<Vec<PathBuf>> {
    let folder = test_data::find(&format!("faces/{folder}"))?;
    let mut names: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    names.retain(|p| p.extension().is_some_and(|e| e == "jpg") && keep(p.file_stem().unwrap().to_str().unwrap()));
    names.sort();
    Some(names)
}

fn one() -> Option<Photo> {
    Some(
        Photo::read(
            &test_data::find("faces/london/012_neutral.jpg")
                .or_else(|| photos("london", |n| n.ends_with("neutral"))?.into_iter().next())?,
        )
        .unwrap(),
    )
}

fn grey(plane: &Plane) -> Photo {
    plane.map(|v| [v.round().clamp(0.0, 255.0) as u8; 3])
}

fn eyes(found: &Found) -> (Point, Point) {
    (found.points[P::P3_6.index()].at, found.points[P::P3_5.index()].at)
}

/// Mean distance of the inner points of two faces, in pupil distances, the second brought back by `back`.
fn apart(a: &Found, b: &Found, back: impl Fn(Point) -> Point) -> f64 {
    let (left, right) = eyes(a);
    let off = (0..P::P2_1.index()).map(|i| a.points[i].at.distance(back(b.points[i].at)));
    off.sum::<f64>() / P::P2_1.index() as f64 / left.distance(right)
}

/// The middles of the eyes' eight outline points, by the photo's `.asf`.
pub fn true_eyes(photo: &Path, size: (usize, usize)) -> (Point, Point) {
    let text = std::fs::read_to_string(photo.with_extension("asf")).unwrap();
    let rows: Vec<Point> = text
        .lines()
        .map(|l| l.split_whitespace().collect::<Vec<_>>())
        .filter(|c| c.len() >= 7 && c[0] != "#")
        .map(|c| Point::new(c[2].parse::<f64>().unwrap() * size.0 as f64, c[3].parse::<f64>().unwrap() * size.1 as f64))
        .collect();
    let middle = |from: usize| {
        let sum = rows[from..from + 8].iter().fold((0.0, 0.0), |s, p| (s.0 + p.x / 8.0, s.1 + p.y / 8.0));
        Point::new(sum.0, sum.1)
    };
    let (a, b) = (middle(13), middle(21));
    if a.x < b.x { (a, b) } else { (b, a) }
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn the_eyes_of_people_from_whom_nothing_was_learned_are_found() {
    let Some(names) = photos("imm240", |n| n.contains("-1")) else { return };
    let mut worst: f64 = 0.0;
    for name in &names {
        let photo = Photo::read(name).unwrap();
        let found = find(&photo, &[]).unwrap_or_else(|refusal| panic!("{}: {refusal}", name.display()));
        let (left, right) = eyes(&found);
        let (true_left, true_right) = true_eyes(name, (photo.width(), photo.height()));
        let off = left.distance(true_left).max(right.distance(true_right)) / true_left.distance(true_right);
        assert!(off < 0.10, "{}: an eye is {off:.3} pupil distances off", name.display());
        worst = worst.max(off);
    }
    println!("{} photos, the worst eye {worst:.3} off", names.len());
    assert_eq!(names.len(), 20);
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn no_face_from_the_front_is_refused() {
    for (folder, keep) in [("imm_frontal", ""), ("london", "neutral"), ("london", "smiling")] {
        let Some(names) = photos(folder, |n| n.contains(keep)) else { return };
        // Every fifth: `learn-faces` looks at all.
        for name in names.iter().step_by(5) {
            let answer = find(&Photo::read(name).unwrap(), &[]);
            let found = answer.unwrap_or_else(|refusal| panic!("{}: {refusal}", name.display()));
            assert!(found.score > 0.8, "{}: {:.2}", name.display(), found.score);
        }
    }
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn a_face_moves_with_its_photo() {
    let Some(photo) = one() else { return };
    let found = find(&photo, &[]).unwrap();
    let last = (photo.width() - 1) as f64;
    let pixels = photo.pixels().chunks_exact(photo.width()).flat_map(|r| r.iter().rev().copied()).collect();
    let mirrored = find(&Photo::new(photo.width(), photo.height(), pixels), &[]).unwrap();
    let turned_back = Found {
        points: std::array::from_fn(|i| mirrored.points[P::fixed().nth(i).unwrap().mirror().index()]),
        ..mirrored.clone()
    };
    let off = apart(&found, &turned_back, |p| Point::new(last - p.x, p.y));
    assert!(off < 0.015, "mirrored: {off:.4}");

    let picture = Pyramid::of(&photo, 1.0);
    for (degrees, size) in [(-20.0_f64, 1.0), (-8.0, 0.6), (12.0, 1.0), (20.0, 1.4)] {
        let middle = Point::new(photo.width() as f64 / 2.0, photo.height() as f64 / 2.0);
        let turn = Similarity::new(middle, 1.0 / size, -degrees.to_radians());
        let side = (photo.width() as f64 * size) as usize;
        let corner = turn.apply(Point::new(-(side as f64) / 2.0, -(side as f64) / 2.0));
        let place = Similarity { origin: corner, ..turn };
        let other = find(&grey(&picture.crop(&place, side, side)), &[]).unwrap();
        let off = apart(&found, &other, |p| place.apply(p));
        assert!(off < 0.025, "turned by {degrees}, {size} times as large: {off:.4}");
        assert!((other.roll - found.roll - degrees).abs() < 2.5, "turned by {degrees}: {}", other.roll);
        let doubted = other.doubts.iter().any(|d| matches!(d, Doubt::Tilted(_)));
        assert_eq!(doubted, other.roll.abs() > 10.0);
    }
}

#[test]
fn what_is_no_face_is_refused() {
    let noise = |seed: u32| {
        let mut state = seed;
        let values = (0..300 * 300).map(|_| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 24) as f32
        });
        Plane::new(300, 300, values.collect())
    };
    let of = |f: &dyn Fn(f32, f32) -> f32| {
        let values = (0..90_000).map(|i| f((i % 300) as f32, (i / 300) as f32).clamp(0.0, 255.0)).collect();
        Plane::new(300, 300, values)
    };
    let blob = |x: f32, y: f32, u: f32, v: f32, r: f32| if (x - u).hypot(y - v) < r { 1.0 } else { 0.0 };
    let mut others = vec![
        ("one value", Plane::filled(200, 150, 127.0)),
        ("one pixel", Plane::filled(1, 1, 127.0)),
        ("one row", Plane::filled(500, 1, 127.0)),
        ("a gradient", of(&|x, y| 0.4 * x + 0.3 * y)),
        (
            "checks",
            of(&|x, y| if (x / 20.0).floor() as i32 % 2 == (y / 20.0).floor() as i32 % 2 { 230.0 } else { 20.0 }),
        ),
        ("stripes", of(&|x, y| 128.0 + 100.0 * (0.15 * x + 0.07 * y).sin())),
        (
            "hills",
            of(&|x, y| if y > 150.0 + 30.0 * (x * 0.03).sin() { 70.0 + 20.0 * (x * y * 0.01).sin() } else { 200.0 }),
        ),
        (
            "three dots in a disc",
            of(&|x, y| {
                let dots =
                    blob(x, y, 120.0, 130.0, 12.0) + blob(x, y, 180.0, 130.0, 12.0) + blob(x, y, 150.0, 195.0, 18.0);
                80.0 + 150.0 * blob(x, y, 150.0, 150.0, 90.0) - 180.0 * dots
            }),
        ),
    ];
    for seed in 1..5 {
        others.push(("noise", noise(seed)));
        others.push(("clouds", noise(seed + 90).blurred(f64::from(seed) * 3.0)));
    }
    for (what, plane) in &others {
        let answer = find(&grey(plane), &[]);
        assert_eq!(answer.as_ref().err(), Some(&Refusal::NoFace), "{what}");
        assert!(!Refusal::NoFace.help().is_empty());
    }
}

#[test]
fn a_drawn_figure_is_no_photo_of_a_face() {
    for name in LineFigure::BUILT_IN {
        let figure = LineFigure::built_in(name).unwrap();
        for emotion in [Emotion::Neutral, Emotion::Surprised] {
            for side in [200, 600] {
                let drawing = figure.draw(&Pose::of(Ratios::pure(emotion)));
                let picture = Painter::new(side, side).unwrap().paint(&drawing);
                let laid = |p: &[u8; 4]| [0, 1, 2].map(|k| 255 - (255 - p[k]) / 255 * p[3]);
                let answer = find(&picture.map(laid), &[]);
                assert!(answer.is_err(), "{name}, {emotion}: {:?}", answer.map(|f| f.score));
            }
        }
    }
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn faces_upside_down_on_their_side_or_in_pieces_are_refused() {
    let Some(names) = photos("imm240", |n| n.contains("-1")) else { return };
    for name in names.iter().step_by(4) {
        let photo = Photo::read(name).unwrap();
        let (w, h) = (photo.width(), photo.height());
        let down = Photo::new(w, h, photo.pixels().iter().rev().copied().collect());
        let side = Photo::new(h, w, (0..w * h).map(|i| photo.at((i / h) as isize, (i % h) as isize)).collect());
        let pieces = (0..w * h).map(|i| {
            let (x, y) = (i % w, i / w);
            photo.at(((x + 60 * (y / 24)) % w) as isize, y as isize)
        });
        let pieces = Photo::new(w, h, pieces.collect());
        for (what, photo) in [("upside down", down), ("on its side", side), ("in pieces", pieces)] {
            let answer = find(&photo, &[]);
            assert!(answer.is_err(), "{} {what}: {:?}", name.display(), answer.map(|f| f.score));
        }
    }
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn two_faces_are_refused_and_a_small_one() {
    let Some(names) = photos("imm240", |n| n.contains("-1")) else { return };
    let (a, b) = (Photo::read(&names[4]).unwrap(), Photo::read(&names[11]).unwrap());
    let (w, h) = (a.width(), a.height());
    let both = (0..2 * w * h).map(|i| {
        let (x, y) = (i % (2 * w), i / (2 * w));
        if x < w { a.at(x as isize, y as isize) } else { b.at((x - w) as isize, y as isize) }
    });
    assert_eq!(find(&Photo::new(2 * w, h, both.collect()), &[]), Err(Refusal::TwoFaces));

    let far = (0..4 * w * h).map(|i| {
        let (x, y) = (i % (2 * w), i / (2 * w));
        a.at(2 * x as isize - w as isize, 2 * y as isize - h as isize)
    });
    let far = Photo::new(2 * w, 2 * h, far.collect());
    let answer = find(&far, &[]);
    assert!(matches!(answer, Err(Refusal::TooSmall(size)) if size < 24.0), "{:?}", answer.map(|f| f.score));
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn what_a_hand_has_set_stays_and_pulls_its_neighbours() {
    let Some(photo) = one() else { return };
    let found = find(&photo, &[]).unwrap();
    let (left, right) = eyes(&found);
    let unit = left.distance(right);
    let corner = found.points[P::P8_4.index()].at;
    let set = Point::new(corner.x - 0.12 * unit, corner.y + 0.06 * unit);
    let other = find(&photo, &[(P::P8_4, set), (P::P9_6, left)]).unwrap();
    for (point, at) in [(P::P8_4, set), (P::P9_6, left)] {
        let placed = other.points[point.index()];
        assert_eq!((placed.at, placed.how, placed.confidence), (at, How::Hand, 1.0));
    }
    let moved = |p: P| other.points[p.index()].at - found.points[p.index()].at;
    assert!(moved(P::P8_9).x < -0.005 * unit, "the lip follows its corner: {:?}", moved(P::P8_9));
    assert!(moved(P::P3_5).hypot() < 0.02 * unit, "the eyes do not: {:?}", moved(P::P3_5));

    // Where a hand has set three points that lie apart, the face is there, whatever the picture shows.
    let blank = Photo::new(400, 400, vec![[128; 3]; 160_000]);
    let hands = [P::P3_6, P::P3_5, P::P2_1].map(|p| (p, found.points[p.index()].at));
    let guess = find(&blank, &hands).unwrap();
    assert!(hands.iter().all(|(p, at)| guess.points[p.index()].at == *at));
    assert!(guess.doubts.contains(&Doubt::Unusual));
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn four_places_pointed_out_are_enough() {
    let Some(photo) = one() else { return };
    let found = find(&photo, &[]).unwrap();
    let at = |p: P| found.points[p.index()].at;
    let unit = at(P::P3_6).distance(at(P::P3_5));
    let near = |p: Point, x: f64, y: f64| Point::new(p.x + x * unit, p.y + y * unit);
    let anchors = Anchors {
        left_eye: near(at(P::P3_6), 0.03, -0.02),
        right_eye: near(at(P::P3_5), -0.02, 0.02),
        mouth: near(at(P::P2_2), 0.02, 0.03),
        chin: near(at(P::P2_1), -0.03, 0.02),
    };
    let again = find_from(&photo, &anchors);
    let off = apart(&found, &again, |p| p);
    assert!(off < 0.03, "from four places near the right ones: {off:.4}");
    assert!(again.doubts.is_empty(), "{:?}", again.doubts);

    let blank = Photo::new(600, 600, vec![[90, 120, 60]; 360_000]);
    let guess = find_from(&blank, &anchors);
    assert!(guess.points.iter().all(|p| p.how == How::Rule && p.confidence <= 0.3));
    assert!(guess.points[P::P3_6.index()].at.distance(anchors.left_eye) < 0.05 * unit);
    assert!(guess.points[P::P2_1.index()].at.distance(anchors.chin) < 0.10 * unit);
    assert!(matches!(guess.doubts.last(), Some(Doubt::Guessed(47))));
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn confidence_tells_an_eye_from_an_ear() {
    let Some(photo) = one() else { return };
    let found = find(&photo, &[]).unwrap();
    let mean =
        |points: &[P]| points.iter().map(|p| found.points[p.index()].confidence).sum::<f64>() / points.len() as f64;
    let (eyes, ears) = (mean(&[P::P3_6, P::P3_5, P::P3_2, P::P3_1]), mean(&[P::P10_2, P::P10_6, P::P10_1, P::P10_5]));
    assert!(eyes > 0.7 && ears < eyes - 0.15, "{eyes:.2} {ears:.2}");
    assert!(found.points.iter().all(|p| (0.0..=1.0).contains(&p.confidence)));
    for point in [P::P9_6, P::P9_7, P::P9_14, P::P9_13] {
        assert_eq!(found.points[point.index()].how, How::Rule);
    }
    assert!(found.doubts.is_empty() && found.roll.abs() < 5.0 && found.opening < 0.1, "{found:?}");
}

#[test]
fn the_learned_numbers_come_back_as_they_were_written() {
    let model = Model::learned();
    let bytes = model.to_bytes();
    assert!(bytes.len() < 1_100_000, "{}", bytes.len());
    assert_eq!(Model::from_bytes(&bytes).unwrap().to_bytes().len(), bytes.len());
    for end in [0, 3, 4, 100, bytes.len() / 2, bytes.len() - 1] {
        assert!(Model::from_bytes(&bytes[..end]).is_none(), "cut at {end}");
    }
}

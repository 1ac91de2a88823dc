//! Learns the numbers by which faces are found.

#![allow(clippy::unwrap_used, clippy::print_stdout, missing_docs, reason = "a tool of the authors")]

#[path = "faces/chance.rs"]
mod chance;
#[path = "faces/others.rs"]
mod others;
#[path = "faces/photos.rs"]
mod photos;
#[path = "faces/points.rs"]
mod points;
#[path = "faces/ridge.rs"]
mod ridge;
#[path = "faces/whole.rs"]
mod whole;
#[path = "faces/windows.rs"]
mod windows;

use std::path::{Path, PathBuf};

use lianpu::face::find::{self, Fit, Model, Pyramid, WORKING_SIDE};
use lianpu::geometry::{Point, Similarity};
use lianpu::photo::{Photo, Plane};

use chance::Chance;
use photos::{Scheme, Shot};
use whole::Material;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let data = PathBuf::from(&arguments[0]);
    let has = |flag: &str| arguments.iter().any(|a| a == flag);
    let starts: usize = std::env::var("STARTS").map_or(3, |s| s.parse().unwrap());
    let folds: usize = std::env::var("FOLDS").map_or(3, |s| s.parse().unwrap());
    let scheme = Scheme::read(&data);
    let neutral = photos::london(&data, &scheme, "neutral");
    let smiling = photos::london(&data, &scheme, "smiling");
    let out = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/face/find/learned.bin");
    if has("--walls") {
        let mut sheet = image::RgbImage::new(600 * 6, 600 * 3);
        for (i, shot) in neutral.iter().step_by(8).take(18).enumerate() {
            let plane = photos::elsewhere(&shot.photo, &mut Chance(i as u64));
            for (x, y, p) in (0..360_000).map(|k| (k % 600, k / 600, plane.pixels()[k])) {
                sheet.put_pixel((i % 6 * 600 + x) as u32, (i / 6 * 600 + y) as u32, image::Rgb([p as u8; 3]));
            }
        }
        sheet.save("/tmp/find/walls.png").unwrap();
        return;
    }
    if has("--print") {
        for name in &arguments[2..] {
            match find::find(&Photo::read(Path::new(name)).unwrap(), &[]) {
                Ok(f) => println!(
                    "{name} {:.2} {:.2} {:.2} {}",
                    f.score,
                    f.opening,
                    f.residual,
                    f.points
                        .iter()
                        .map(|p| format!("{:.1},{:.1},{:.2}", p.at.x, p.at.y, p.confidence))
                        .collect::<Vec<_>>()
                        .join(" ")
                ),
                Err(e) => println!("{name} {e}"),
            }
        }
        return;
    }
    if has("--check") {
        let model = Model::from_bytes(&std::fs::read(&out).unwrap()).unwrap();
        check(&model, &data, &neutral, &scheme);
        return;
    }
    let material = Material::new(scheme, neutral, smiling);
    if !has("--cross-validate") {
        let model = whole::learn(&material, starts, |_| true);
        let bytes = model.to_bytes();
        std::fs::write(&out, &bytes).unwrap();
        println!("{} bytes", bytes.len());
        return;
    }
    let mut people: Vec<usize> = material.neutral.iter().map(|s| s.person).collect();
    people.dedup();
    let fold_of = |person: usize| people.iter().position(|p| *p == person).unwrap() % folds;
    let (mut errors, mut scores, mut smiles, mut expected) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for fold in 0..folds {
        println!("fold {fold}");
        if has("--points") {
            let mut chance = Chance(fold as u64 + 55);
            let (shapes, coarse, fine) = whole::fitted(&material, starts, &|person| fold_of(person) != fold);
            for shot in material.neutral.iter().filter(|s| fold_of(s.person) == fold && !s.mirrored) {
                let picture = Pyramid::of(&shot.photo, 1.0);
                for _ in 0..2 {
                    let frame = points::shaken(&shapes, &shot.truth, &mut chance);
                    let fit = Fit::at(&shapes, frame).through(&shapes, &coarse, &picture, &[], 1.0);
                    let fit = fit.by_all(&shapes, &fine, &picture, &[]);
                    errors.push(off(&fit.places(), &shot.truth, &material.scheme));
                }
            }
            continue;
        }
        let model = whole::learn(&material, starts, |person| fold_of(person) != fold);
        let model = Model::from_bytes(&model.to_bytes()).unwrap();
        for shot in material.neutral.iter().filter(|s| fold_of(s.person) == fold && !s.mirrored) {
            let (places, score, sure) = look(&model, &shot.photo);
            expected.push(sure);
            errors.push(off(&places, &shot.truth, &material.scheme));
            scores.push(score);
        }
        for shot in material.smiling.iter().filter(|s| fold_of(s.person) == fold && !s.mirrored) {
            smiles.push(look(&model, &shot.photo).1);
        }
    }
    report(&errors, &material.scheme);
    if scores.is_empty() {
        return;
    }
    let mut pairs: Vec<(f64, f64)> = expected.concat().into_iter().zip(errors.concat()).collect();
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    for fifth in pairs.chunks(pairs.len().div_ceil(5)) {
        let mean = |f: &dyn Fn(&(f64, f64)) -> f64| 100.0 * fifth.iter().map(f).sum::<f64>() / fifth.len() as f64;
        println!("expected {:5.2} %, is {:5.2} %", mean(&|p| p.0), mean(&|p| p.1));
    }
    spread_of("neutral", &scores);
    spread_of("smiling", &smiles);
    let eyes = [material.scheme.index("3.6"), material.scheme.index("3.5")];
    println!(
        "eye pair within 0.1: {} of {}",
        errors.iter().filter(|e| eyes.iter().all(|i| e[*i] < 0.1)).count(),
        errors.len()
    );
}

/// The points found in a photo, and the scores: of the window, the rough and the close fit, and the total.
fn look(model: &Model, photo: &Photo) -> (Vec<Point>, [f32; 4], Vec<f64>) {
    let (small, step) = photo.at_most(WORKING_SIDE);
    let picture = Pyramid::of(&small, step);
    let found = model.candidates(&picture, &[]);
    let Some(first) = found.first() else { return (vec![Point::ORIGIN; model.shapes.count()], [-99.0; 4], Vec::new()) };
    let close = model.closely(photo, first, &[]);
    let expected =
        (0..model.looks.base.len()).map(|n| model.looks.expected(n, close.fit.spread[n], close.strangeness[n]));
    (close.fit.places(), [close.window, close.rough, close.close, close.total()], expected.collect())
}

fn spread_of(name: &str, scores: &[[f32; 4]]) {
    for (k, what) in ["window", "rough", "close", "total"].iter().enumerate() {
        let mut of: Vec<f32> = scores.iter().map(|s| s[k]).collect();
        of.sort_by(f32::total_cmp);
        let n = of.len();
        println!(
            "{name:20} {what:6}: least {:6.2}, 5 % {:6.2}, middle {:6.2}, 95 % {:6.2}, most {:6.2}",
            of[0],
            of[n / 20],
            of[n / 2],
            of[n * 19 / 20],
            of[n - 1]
        );
    }
}

/// What the shipped numbers say of other sets and of pictures without faces.
fn check(model: &Model, data: &Path, neutral: &[Shot], scheme: &Scheme) {
    let beside = data.parent().unwrap();
    for (folder, ends) in [("imm240", "-1"), ("imm240", "-2"), ("imm240", "-5"), ("imm240", "-6"), ("imm_frontal", "")]
    {
        let mut names: Vec<_> = std::fs::read_dir(beside.join(folder)).unwrap().map(|e| e.unwrap().path()).collect();
        names.retain(|p| {
            p.extension().is_some_and(|e| e == "jpg") && p.file_stem().unwrap().to_str().unwrap().contains(ends)
        });
        names.sort();
        let mut scores = Vec::new();
        let mut good = Vec::new();
        let mut jaw: Vec<f64> = Vec::new();
        for name in &names {
            let (places, score, _) = look(model, &Photo::read(name).unwrap());
            scores.push(score);
            if folder == "imm240" {
                let text = std::fs::read_to_string(name.with_extension("asf")).unwrap();
                let rows: Vec<Vec<f64>> = text
                    .lines()
                    .filter(|l| l.split_whitespace().count() >= 7 && !l.starts_with('#'))
                    .map(|l| l.split_whitespace().map(|v| v.parse().unwrap_or(0.0)).collect())
                    .collect();
                let at = |i: usize| Point::new(rows[i][2] * 640.0, rows[i][3] * 480.0);
                // 13 to 20 go round one eye, 21 to 28 round the other; see the pictures.
                let middle = |from: usize| {
                    let (mut x, mut y) = (0.0, 0.0);
                    for i in from..from + 8 {
                        x += at(i).x / 8.0;
                        y += at(i).y / 8.0;
                    }
                    Point::new(x, y)
                };
                let (a, b) = (middle(13), middle(21));
                let (left, right) = if a.x < b.x { (a, b) } else { (b, a) };
                let unit = left.distance(right);
                // Eyes are the 13th and the 18th of the learned points.
                let worst = places[12].distance(left).max(places[17].distance(right)) / unit;
                good.push(worst);
                // 0 to 12 go along the jaw from ear to ear.
                for name in ["2.1", "2.14", "2.13"] {
                    let p = places[scheme.index(name)];
                    let near = (0..12).map(|i| {
                        let (a, b) = (at(i), at(i + 1));
                        let t = ((p - a).dot(b - a) / (b - a).hypot2()).clamp(0.0, 1.0);
                        p.distance(a + (b - a) * t)
                    });
                    jaw.push(near.fold(f64::INFINITY, f64::min) / unit);
                }
            }
        }
        spread_of(&format!("{folder}{ends}"), &scores);
        if !good.is_empty() {
            println!("   jaw and chin off the jaw's line: {:.3}", jaw.iter().sum::<f64>() / jaw.len() as f64);
            good.sort_by(f64::total_cmp);
            println!(
                "   eyes off: middle {:.3}, most {:.3}; within 0.1: {} of {}",
                good[good.len() / 2],
                good[good.len() - 1],
                good.iter().filter(|g| **g < 0.1).count(),
                good.len()
            );
        }
    }
    let photo_of = |plane: &Plane| plane.map(|v| [*v as u8; 3]);
    let own: Vec<&Shot> = neutral.iter().filter(|s| !s.mirrored).collect();
    let drawn: Vec<Photo> =
        (0..180).map(|i| photo_of(&others::drawn(i, 500, &mut Chance(i as u64 + 777_000)))).collect();
    said("drawn", &drawn);
    for turn in 1..4 {
        let turned: Vec<_> = own.iter().map(|s| photo_of(&others::quarters(&Plane::luma(&s.photo), turn))).collect();
        said(&format!("turned by {}", 90 * turn), &turned);
    }
    for degrees in [0, 10, 20, 30, 40, 50, 60, 75, 90] {
        let seen: Vec<_> = own
            .iter()
            .step_by(2)
            .map(|s| {
                let eyes = Similarity::spanning(s.truth[12], s.truth[17]);
                others::turned(&s.photo, &eyes, f64::from(degrees).to_radians(), &[]).0
            })
            .collect();
        said(&format!("looking {degrees} aside"), &seen);
        let yaws: Vec<f64> = seen.iter().filter_map(|p| Some(find::find(p, &[]).ok()?.yaw)).collect();
        println!("     measured {:.1}", yaws.iter().sum::<f64>() / yaws.len().max(1) as f64);
    }
    for degrees in [5, 10, 15, 20, 25, 30, 35, 45, 60] {
        let seen: Vec<_> = own
            .iter()
            .step_by(2)
            .map(|s| {
                let turn = Similarity::new(Point::new(300.0, 300.0), 1.0, -f64::from(degrees).to_radians());
                let corner = turn.apply(Point::new(-300.0, -300.0));
                photo_of(&Pyramid::of(&s.photo, 1.0).crop(&Similarity { origin: corner, ..turn }, 600, 600))
            })
            .collect();
        said(&format!("tilted by {degrees}"), &seen);
    }
    let pairs: Vec<Photo> = own.windows(2).step_by(3).map(|w| beside_each_other(&w[0].photo, &w[1].photo)).collect();
    said("two", &pairs);
    let folder = |name: &str, keep: &dyn Fn(&str) -> bool| {
        let mut names: Vec<_> = std::fs::read_dir(beside.join(name)).unwrap().map(|e| e.unwrap().path()).collect();
        names.retain(|p| p.extension().is_some_and(|e| e == "jpg") && keep(p.file_stem().unwrap().to_str().unwrap()));
        names.sort();
        names.iter().map(|n| Photo::read(n).unwrap()).collect::<Vec<_>>()
    };
    said("london neutral", &folder("london", &|n| n.ends_with("neutral")));
    said("london smiling", &folder("london", &|n| n.ends_with("smiling")));
    for k in ["-1", "-2", "-5", "-6"] {
        said(&format!("imm240{k}"), &folder("imm240", &|n| n.contains(k)));
    }
    said("imm_frontal", &folder("imm_frontal", &|_| true));
    said("franck", &folder("franck/frames", &|n| n.parse::<usize>().unwrap() % 20 == 0));
    let mut best = f64::INFINITY;
    let photos: Vec<&Photo> = own[..12].iter().map(|s| &s.photo).collect();
    for _ in 0..5 {
        let begun = std::time::Instant::now();
        photos.iter().for_each(|p| drop(find::find(p, &[])));
        best = best.min(begun.elapsed().as_secs_f64() / 12.0);
    }
    println!("{:.1} ms a photo of 600 x 600", 1000.0 * best);
    let large = enlarged(photos[0], 6);
    let mut best = f64::INFINITY;
    for _ in 0..5 {
        let begun = std::time::Instant::now();
        drop(find::find(&large, &[]));
        best = best.min(begun.elapsed().as_secs_f64());
    }
    println!("{:.1} ms for {} x {}", 1000.0 * best, large.width(), large.height());
}

/// What is said of photos: how often a face is given, and why not.
fn said(name: &str, photos: &[Photo]) {
    let totals: Vec<f32> = photos.iter().map(|p| look(Model::learned(), p).1[3]).collect();
    let (low, high) = totals.iter().fold((f32::INFINITY, f32::NEG_INFINITY), |b, t| (b.0.min(*t), b.1.max(*t)));
    let answers: Vec<_> = photos.iter().map(|p| find::find(p, &[])).collect();
    let mut counts = std::collections::BTreeMap::new();
    for answer in &answers {
        let word = match answer {
            Ok(found) if found.doubts.is_empty() => "given".to_owned(),
            Ok(found) => format!(
                "given, {:?}",
                found.doubts.iter().map(|d| format!("{d:?}").split('(').next().unwrap().to_owned()).collect::<Vec<_>>()
            ),
            Err(refusal) => format!("{refusal:?}").split('(').next().unwrap().to_owned(),
        };
        *counts.entry(word).or_insert(0) += 1;
    }
    println!("{name:20} of {}, totals {low:.2} to {high:.2}: {counts:?}", photos.len());
}

fn beside_each_other(a: &Photo, b: &Photo) -> Photo {
    let width = a.width() + b.width();
    let rows = (0..a.height()).flat_map(|y| {
        let row = move |p: &Photo| (0..p.width()).map(|x| p.at(x as isize, y as isize)).collect::<Vec<_>>();
        [row(a), row(b)].concat()
    });
    Photo::new(width, a.height(), rows.collect())
}

fn enlarged(photo: &Photo, by: usize) -> Photo {
    let (w, h) = (photo.width() * by, photo.height() * by);
    Photo::new(w, h, (0..w * h).map(|i| photo.at((i % w / by) as isize, (i / w / by) as isize)).collect())
}

fn off(found: &[Point], truth: &[Point], scheme: &Scheme) -> Vec<f64> {
    let unit = truth[scheme.index("3.6")].distance(truth[scheme.index("3.5")]);
    (0..scheme.features.len()).map(|i| found[i].distance(truth[i]) / unit).collect()
}

fn report(errors: &[Vec<f64>], scheme: &Scheme) {
    let line = |name: &str, take: &dyn Fn(usize) -> bool| {
        let mut means: Vec<f64> = errors
            .iter()
            .map(|e| {
                let of: Vec<f64> = (0..e.len()).filter(|i| take(*i)).map(|i| e[i]).collect();
                100.0 * of.iter().sum::<f64>() / of.len() as f64
            })
            .collect();
        means.sort_by(f64::total_cmp);
        let n = means.len();
        println!(
            "{name:10} mean {:5.2}  median {:5.2}  p95 {:5.2}  max {:5.2}",
            means.iter().sum::<f64>() / n as f64,
            means[n / 2],
            means[n * 95 / 100],
            means[n - 1]
        );
    };
    for group in ["brow", "eye", "nose", "mouth", "contour", "ear"] {
        line(group, &|i| scheme.groups[i] == group);
    }
    line("inner", &|i| ["brow", "eye", "nose", "mouth"].contains(&&*scheme.groups[i]));
    if std::env::var_os("EACH").is_some() {
        for (i, f) in scheme.features.iter().enumerate() {
            line(&f.name(), &|j| j == i);
        }
    }
}

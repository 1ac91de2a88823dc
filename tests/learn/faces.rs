//! Learns the numbers by which faces are found.

#![allow(clippy::unwrap_used, clippy::print_stdout, missing_docs, reason = "a tool of the authors")]

#[path = "faces/chance.rs"]
mod chance;
#[path = "faces/photos.rs"]
mod photos;
#[path = "faces/points.rs"]
mod points;
#[path = "faces/ridge.rs"]
mod ridge;

use std::path::PathBuf;

use lianpu::face::find::{Fit, Pyramid};
use lianpu::geometry::Point;

use chance::Chance;
use photos::{Scheme, Shot};
use points::{Plan, Sample};

const VARIANTS: usize = 3;

fn plans(scheme: &Scheme) -> Vec<Plan> {
    let all: Vec<usize> = (0..scheme.of.len()).collect();
    let few: Vec<usize> = all.clone();
    let stage = |scale, cell, anew, kept, modes, sites: &Vec<usize>, blocks| Plan { scale, cell, anew, kept, modes, blocks, all_sites: sites.clone() };
    vec![
        stage(24.0, 0.25, true, 24, 16, &few, vec![]),
        stage(24.0, 0.17, false, 24, 24, &few, vec![]),
        stage(60.0, 0.13, true, 24, 28, &all, vec![]),
        stage(60.0, 0.10, false, 24, 32, &all, vec![]),
        stage(60.0, 0.08, false, 32, 32, &all, points::groups(scheme)),
        stage(60.0, 0.06, false, 32, 32, &all, points::groups(scheme)),
    ]
}

fn main() {
    let data = PathBuf::from(std::env::args().nth(1).expect("the folder of the London set"));
    let starts: usize = std::env::var("STARTS").map_or(3, |s| s.parse().unwrap());
    let folds: usize = std::env::var("FOLDS").map_or(3, |s| s.parse().unwrap());
    let scheme = Scheme::read(&data);
    let shots = photos::london(&data, &scheme, "neutral");
    let mut people: Vec<usize> = shots.iter().map(|s| s.person).collect();
    people.dedup();
    let fold_of = |person: usize| people.iter().position(|p| *p == person).unwrap() % folds;
    let pictures: Vec<Pyramid> = (0..shots.len() * VARIANTS)
        .map(|i| photos::varied(&shots[i / VARIANTS].photo, i % VARIANTS, &mut Chance(i as u64 * 77 + 5)))
        .collect();
    let mut errors: Vec<Vec<f64>> = Vec::new();
    for fold in 0..folds {
        let mut chance = Chance(99);
        let begun = std::time::Instant::now();
        let train: Vec<&Shot> = shots.iter().filter(|s| fold_of(s.person) != fold).collect();
        let model = points::shapes(&train, &scheme, 32);
        let mut samples = Vec::new();
        for (i, shot) in shots.iter().enumerate().filter(|(_, s)| fold_of(s.person) != fold) {
            for k in 0..VARIANTS * starts {
                let frame = points::shaken(&model, &shot.truth, &mut chance);
                samples.push(Sample { picture: i * VARIANTS + k % VARIANTS, person: shot.person, frame, shape: model.mean.clone(), truth: shot.truth.clone() });
            }
        }
        let stages = points::cascade(&model, &pictures, samples, &plans(&scheme), 5);
        for (i, shot) in shots.iter().enumerate().filter(|(_, s)| fold_of(s.person) == fold && !s.mirrored) {
            for _ in 0..2 {
                let frame = points::shaken(&model, &shot.truth, &mut chance);
                let fit = Fit::run(&model, &stages, &pictures[i * VARIANTS], frame, &[]);
                errors.push(off(&fit.places(), &shot.truth, &scheme));
            }
        }
        println!("fold {fold}: {:.1} s", begun.elapsed().as_secs_f64());
    }
    report(&errors, &scheme);
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
        println!("{name:10} mean {:5.2}  median {:5.2}  p95 {:5.2}  max {:5.2}", means.iter().sum::<f64>() / n as f64, means[n / 2], means[n * 95 / 100], means[n - 1]);
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

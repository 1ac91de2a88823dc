//! How long the active appearance model takes: training on seven shots, a frame's fit with the memory that stays, decoding,
//! and a whole clip from its JPEG files to its shapes, on one thread.

#![allow(missing_docs, clippy::unwrap_used, reason = "a bench may stop")]

use std::hint::black_box;
use std::path::{Path, PathBuf};

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use lianpu::aam::{Annotation, Fit, Fitter, Kind, Model, Options, Start};
use lianpu::geometry::Point;
use lianpu::photo::Grey;

fn franck() -> Option<PathBuf> {
    let beside = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data");
    let folder = std::env::var_os("LIANPU_DATA").map_or_else(beside, PathBuf::from).join("faces/franck");
    folder.exists().then_some(folder)
}

fn fits(c: &mut Criterion) {
    let Some(folder) = franck() else { return };
    let shots: Vec<(Grey, Vec<Point>)> = ["0075", "0260", "0565", "1080", "1090", "1095", "1195"]
        .iter()
        .map(|name| {
            let at = |ending: &str| folder.join(format!("calibration/{name}.{ending}"));
            (Grey::read(&at("jpg")).unwrap(), Annotation::read(&at("pts")).unwrap().remove(0).points)
        })
        .collect();
    let pairs: Vec<(&Grey, &[Point])> = shots.iter().map(|(g, s)| (g, &s[..])).collect();
    let options = Options { detect: false, ..Options::of(Kind::Person) };
    let model = Model::train(&pairs, &options).unwrap();
    assert!(model.size()[0] >= 10_000 && model.size()[1] == 10);
    let files: Vec<Vec<u8>> =
        (0..1241).map(|n| std::fs::read(folder.join(format!("frames/{n:04}.jpg"))).unwrap()).collect();
    let frames: Vec<Grey> = files.iter().take(100).map(|f| Grey::decode(f).unwrap()).collect();
    let first = model.fit(&Grey::decode(&files[0]).unwrap(), Start::Points(&shots[0].1));

    let mut group = c.benchmark_group("aam");
    group.sample_size(10);
    group.bench_function("training on 7 shots", |b| b.iter(|| Model::train(black_box(&pairs), &options).unwrap()));
    let detected = Options::of(Kind::Person);
    group.bench_function("training on 7 shots, faces searched", |b| {
        b.iter(|| Model::train(black_box(&pairs), &detected).unwrap());
    });
    let bytes = model.to_bytes();
    group.bench_function("reading a model", |b| b.iter(|| Model::from_bytes(black_box(&bytes)).unwrap()));
    let mut fitter = Fitter::new(&model);
    group.throughput(Throughput::Elements(frames.len() as u64));
    group.bench_function("following 100 frames", |b| b.iter(|| followed(&mut fitter, frames.iter(), &first)));
    group.bench_function("decoding 100 frames", |b| {
        b.iter(|| files.iter().take(100).map(|f| Grey::decode(f).unwrap().width()).sum::<usize>());
    });
    group.throughput(Throughput::Elements(files.len() as u64));
    group.bench_function("1241 JPEG frames to shapes", |b| {
        b.iter(|| {
            let mut last = first.clone();
            for file in &files {
                last = fitter.follow(&Grey::decode(file).unwrap(), &last);
            }
            last
        });
    });
    group.finish();
}

fn followed<'a>(fitter: &mut Fitter, frames: impl Iterator<Item = &'a Grey>, first: &Fit) -> Fit {
    frames.fold(first.clone(), |last, grey| fitter.follow(grey, &last))
}

criterion_group!(benches, fits);
criterion_main!(benches);

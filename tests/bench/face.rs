//! How long a face takes: from a photo's bytes to `face.toml`, whole and by stage, on one thread. The photo is the
//! sample lesson's; the large one is the same, scaled to 12 megapixels.

#![allow(missing_docs, clippy::unwrap_used, reason = "a bench may stop")]

use std::hint::black_box;
use std::path::Path;

use criterion::{Criterion, criterion_group, criterion_main};
use lianpu::face::{Face, Points, create, measure};
use lianpu::figure::Cartoon;
use lianpu::figure::cartoon::Style;
use lianpu::photo::{Photo, Stages, sha256, to_clean_png};
use lianpu::pose::Pose;
use lianpu::render::Painter;

fn portrait() -> Vec<u8> {
    std::fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("projects/nihao/faces/teacher/neutral.png")).unwrap()
}

/// The photo with every pixel repeated so often each way.
fn enlarged(photo: &Photo, times: usize) -> Photo {
    let (width, height) = (photo.width() * times, photo.height() * times);
    let at = |i: usize| photo.at((i % width / times) as isize, (i / width / times) as isize);
    Photo::new(width, height, (0..width * height).map(at).collect())
}

fn to_toml(bytes: &[u8]) -> String {
    let photo = Photo::decode(bytes).unwrap();
    create(&photo, &sha256(bytes), None, None).unwrap().face.to_toml()
}

fn faces(c: &mut Criterion) {
    let bytes = portrait();
    let photo = Photo::decode(&bytes).unwrap();
    let face: Face = create(&photo, &sha256(&bytes), None, None).unwrap().face;
    let points: Points = face.places();
    // 3600 × 3600: 13 megapixels.
    let large = to_clean_png(&enlarged(&photo, 6)).unwrap();
    let mut group = c.benchmark_group("face");
    group.sample_size(10);
    group.bench_function("whole, 600 x 600", |b| b.iter(|| to_toml(black_box(&bytes))));
    group.bench_function("whole, 3600 x 3600", |b| b.iter(|| to_toml(black_box(&large))));
    group.bench_function("decode, 600 x 600", |b| b.iter(|| Photo::decode(black_box(&bytes)).unwrap()));
    group.bench_function("decode, 3600 x 3600", |b| b.iter(|| Photo::decode(black_box(&large)).unwrap()));
    group.bench_function("measure", |b| b.iter(|| measure(black_box(&photo), &points)));
    group.bench_function("stages of the thesis", |b| b.iter(|| Stages::of(black_box(&photo))));
    let style = Style::built_in("normal").unwrap();
    group.bench_function("cartoon made", |b| b.iter(|| Cartoon::new(black_box(&face), &style)));
    let cartoon = Cartoon::new(&face, &style);
    group.bench_function("cartoon drawn", |b| b.iter(|| cartoon.draw(black_box(&Pose::default()))));
    let mut painter = Painter::new(1280, 720).unwrap();
    let poses = [Pose::default(), Pose { gaze: lianpu::pose::Gaze { x: 0.2, y: 0.0 }, ..Pose::default() }];
    let mut turn = 0;
    group.bench_function("cartoon drawn and painted, 1280 x 720", |b| {
        b.iter(|| {
            turn ^= 1;
            painter.paint(&cartoon.draw(&poses[turn]))
        });
    });
    group.finish();
}

criterion_group!(benches, faces);
criterion_main!(benches);

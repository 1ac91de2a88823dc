//! Frames a second, by stage and as a whole, on the sample lesson at 1280 × 720.
//!
//! ```sh
//! cargo bench --bench export
//! ```
//!
//! To set the whole beside a loop of the `resvg` program over our own SVG frames, export both and time them in turn:
//!
//! ```sh
//! cargo install resvg
//! lianpu export projects/seven-emotions --to svg --out /tmp/svg
//! time lianpu export projects/seven-emotions --to png --out /tmp/png --jobs 1
//! time for f in /tmp/svg/walk/*.svg; do resvg "$f" /tmp/one.png; done
//! ```

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use std::path::Path;
use std::sync::atomic::AtomicBool;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use lianpu::export::{Format, Request, plan, run};
use lianpu::project::Lesson;
use lianpu::render::{Painter, encode_png, to_svg};

fn stages(c: &mut Criterion) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("projects/seven-emotions");
    let lesson = Lesson::read(&root).unwrap();
    let figure = lesson.figure_of(&lesson.clips[0].entry).unwrap();
    let timeline = lesson.timeline(0, None);
    let mut frame = 0;
    // Every sample another frame, so that nothing is measured that only repeats.
    let mut next = || {
        frame = (frame + 7) % timeline.frames();
        timeline.time_of(frame)
    };
    let mut group = c.benchmark_group("frame");
    group.throughput(Throughput::Elements(1));
    group.bench_function("pose", |b| b.iter(|| timeline.pose(next())));
    group.bench_function("draw", |b| b.iter(|| figure.draw(&timeline.pose(next()))));
    let mut painter = Painter::new(1280, 720).unwrap();
    group.bench_function("draw and paint", |b| b.iter(|| painter.paint(&figure.draw(&timeline.pose(next())))));
    let picture = painter.paint(&figure.draw(&timeline.pose(1.0)));
    group.bench_function("encode", |b| b.iter(|| encode_png(&picture, "").unwrap()));
    group.bench_function("svg", |b| b.iter(|| to_svg(&figure.draw(&timeline.pose(next())), 1280, 720)));
    group.finish();
}

fn whole(c: &mut Criterion) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("projects/nihao");
    let lesson = Lesson::read(&root).unwrap();
    let mut group = c.benchmark_group("export");
    group.sample_size(10);
    for threads in [1, 2] {
        group.throughput(Throughput::Elements(u64::from(lesson.timeline(0, None).frames())));
        group.bench_function(format!("png, {threads} threads"), |b| {
            b.iter(|| {
                let out = tempfile::tempdir().unwrap();
                let request = Request { out: Some(out.path().into()), ..Request::new(vec![Format::Png]) };
                run(&plan(&lesson, &request).unwrap(), threads, &|_| {}, &AtomicBool::new(false)).unwrap()
            });
        });
    }
    group.finish();
}

criterion_group!(benches, stages, whole);
criterion_main!(benches);

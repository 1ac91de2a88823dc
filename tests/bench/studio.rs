//! How long the studio takes from a key to a drawn screen, in a lesson of ten minutes on a large terminal.
//!
//! ```sh
//! cargo bench --bench studio
//! ```

#![allow(missing_docs, clippy::unwrap_used, reason = "a benchmark may stop")]

use criterion::{Criterion, criterion_group, criterion_main};
use lianpu::studio::{Colours, Studio};
use ratatui::Terminal;
use ratatui::backend::TestBackend;

const SECONDS: u32 = 600;
const RATE: u32 = 16_000;

fn keys(c: &mut Criterion) {
    let folder = tempfile::tempdir().unwrap();
    let clip = folder.path().join("long/clips/long");
    std::fs::create_dir_all(&clip).unwrap();
    let manifest = "format = 1\ntitle = \"long\"\n\n[[clip]]\nname = \"long\"\n";
    std::fs::write(folder.path().join("long/lianpu.toml"), manifest).unwrap();
    std::fs::write(clip.join("script.txt"), "今天我們來上課。".repeat(250)).unwrap();
    let spec =
        hound::WavSpec { channels: 1, sample_rate: RATE, bits_per_sample: 16, sample_format: hound::SampleFormat::Int };
    let mut wav = hound::WavWriter::create(clip.join("speech.wav"), spec).unwrap();
    for i in 0..SECONDS * RATE {
        wav.write_sample((i.wrapping_mul(2_654_435_761) >> 17) as i16 / 4).unwrap();
    }
    wav.finalize().unwrap();
    let mut studio =
        Studio::new(folder.path(), Colours::True, Box::new(|_, _, _| Ok(lianpu::export::CourseReport::default())))
            .unwrap();
    let mut terminal = Terminal::new(TestBackend::new(200, 50)).unwrap();
    for key in ["Enter", "Enter"] {
        studio.key(key);
        studio.settle();
    }
    let mut press = |key: &str| {
        studio.key(key);
        terminal.draw(|frame| studio.draw(frame)).unwrap();
    };
    let mut group = c.benchmark_group("key to screen");
    group.sample_size(20);
    group.bench_function("a cursor step", |b| b.iter(|| press("l")));
    group.bench_function("the next syllable", |b| b.iter(|| press("Tab")));
    press("0");
    group.bench_function("a cursor step, ten minutes in view", |b| b.iter(|| press("l")));
    group.finish();
}

criterion_group!(benches, keys);
criterion_main!(benches);

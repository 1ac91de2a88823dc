//! How fast recordings are aligned, adaptation included: of 1, 10 and 30 minutes, on one core.
//!
//! ```sh
//! RAYON_NUM_THREADS=1 cargo bench --bench speech
//! ```
//!
//! The sound is that of `data/speech/self`, over and over.

#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout, reason = "a benchmark may stop and speak")]

#[path = "../it/support/test_data.rs"]
mod test_data;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use lianpu::media::Sound;
use lianpu::script::{System, syllables};
use lianpu::speech::{Take, align};

fn lengths(c: &mut Criterion) {
    let Some(folder) = test_data::find("speech/self") else { return };
    let (mut samples, mut text) = (Vec::new(), String::new());
    for name in ["774", "814", "854", "894", "934", "974"] {
        samples.extend(Sound::read(&folder.join(format!("{name}.wav"))).unwrap().samples);
        text += &std::fs::read_to_string(folder.join(format!("{name}.lab"))).unwrap();
        text.push('\n');
    }
    let mut group = c.benchmark_group("align");
    group.sample_size(10);
    for minutes in [1, 10, 29] {
        let sound = Sound::new(16_000, samples.repeat(minutes));
        let script = syllables(&text.repeat(minutes), System::Hanyu).unwrap();
        // Seconds of sound a second.
        group.throughput(Throughput::Elements(sound.duration() as u64));
        group.bench_function(format!("{minutes} minutes"), |b| {
            b.iter(|| align(&[Take { sound: &sound, script: &script, pins: &[] }]).pop().unwrap().unwrap());
        });
    }
    group.finish();
}

criterion_group!(benches, lengths);
criterion_main!(benches);

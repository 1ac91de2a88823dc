//! Recordings as they come: every kind of WAV, the broken ones, and where speech begins and ends.

#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod test_data;

use std::io::Cursor;
use std::path::Path;

use hound::{SampleFormat, WavSpec, WavWriter};
use lianpu::disk::Fault;
use lianpu::speech::Sound;

/// A WAV of one second of a tone at half the full loudness, the same in all channels.
fn tone(channels: u16, rate: u32, bits: u16, float: bool) -> Vec<u8> {
    let format = if float { SampleFormat::Float } else { SampleFormat::Int };
    let spec = WavSpec { channels, sample_rate: rate, bits_per_sample: bits, sample_format: format };
    let mut bytes = Cursor::new(Vec::new());
    let mut writer = WavWriter::new(&mut bytes, spec).unwrap();
    for i in 0..rate {
        let value = 0.5 * (f64::from(i) / f64::from(rate) * 440.0 * std::f64::consts::TAU).sin();
        for _ in 0..channels {
            if float {
                writer.write_sample(value as f32).unwrap();
            } else {
                writer.write_sample((value * ((1_u64 << (bits - 1)) as f64 - 1.0)) as i32).unwrap();
            }
        }
    }
    writer.finalize().unwrap();
    bytes.into_inner()
}

fn read(bytes: &[u8]) -> Result<Sound, Fault> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("speech.wav");
    std::fs::write(&path, bytes).unwrap();
    Sound::read(&path)
}

/// Puts a number of 32 bits at a place.
fn put(bytes: &mut [u8], at: usize, number: u32) {
    bytes[at..at + 4].copy_from_slice(&number.to_le_bytes());
}

#[test]
fn every_depth_rate_and_number_of_channels_gives_the_same_tone() {
    for (channels, rate, bits, float) in [
        (1, 8_000, 8, false),
        (1, 16_000, 16, false),
        (2, 44_100, 16, false),
        (2, 48_000, 24, false),
        (6, 22_050, 32, false),
        (1, 96_000, 32, true),
        (2, 11_025, 32, true),
    ] {
        let sound = read(&tone(channels, rate, bits, float)).unwrap();
        let what = format!("{channels} {rate} {bits} {float}");
        assert_eq!((sound.rate, sound.channels, sound.samples.len()), (rate, channels, rate as usize), "{what}");
        assert!(sound.warnings.is_empty() && sound.duration() == 1.0, "{what}");
        let there = 0.5 * (f64::from(rate / 5) / f64::from(rate) * 440.0 * std::f64::consts::TAU).sin();
        assert!((f64::from(sound.samples[rate as usize / 5]) - there).abs() < 0.01, "{what}");
        let (low, high) = sound.peaks(0.0, 1.0, 1)[0];
        assert!((low + 0.5).abs() < 0.01 && (high - 0.5).abs() < 0.01, "{what}: {low} {high}");
    }
}

#[test]
fn what_an_interrupted_recording_holds_is_used_with_a_warning() {
    let whole = tone(1, 16_000, 16, false);
    for length in [0, 0xFFFF_FFFF, 0x7FFF_F000] {
        let mut bytes = whole.clone();
        put(&mut bytes, 4, length);
        put(&mut bytes, 40, length);
        let sound = read(&bytes).unwrap();
        assert_eq!(sound.samples.len(), 16_000);
        assert!(sound.warnings[0].contains("does not say how long"), "{:?}", sound.warnings);
    }
    let cut = read(&whole[..44 + 16_001]).unwrap();
    assert_eq!(cut.samples.len(), 8_000, "half a sample is none");
    assert!(cut.warnings[0].contains("cut off: 0.50 s of 1.00 s"), "{:?}", cut.warnings);
}

#[test]
fn other_chunks_before_and_after_even_of_odd_length_do_no_harm() {
    let whole = tone(1, 8_000, 16, false);
    let extra = |length: u32| {
        let mut chunk = b"LIST".to_vec();
        chunk.extend_from_slice(&length.to_le_bytes());
        chunk.resize(8 + length.next_multiple_of(2) as usize, b'x');
        chunk
    };
    let bytes = [&whole[..12], &extra(7), &whole[12..36], &extra(4), &whole[36..], &extra(30)].concat();
    let sound = read(&bytes).unwrap();
    assert_eq!((sound.samples.len(), sound.warnings.len()), (8_000, 0));
    // An empty part for samples in a file that is otherwise in order is not an interrupted recording.
    let mut empty = [&whole[..44], &extra(8)].concat();
    put(&mut empty, 40, 0);
    assert!(read(&empty).unwrap_err().what().contains("no sound"));
}

#[test]
fn headers_that_are_a_little_wrong_are_understood() {
    let mut wrong = tone(2, 8_000, 16, false);
    put(&mut wrong, 28, 7); // bytes a second
    wrong[32..34].copy_from_slice(&0_u16.to_le_bytes()); // bytes a frame
    assert_eq!(read(&wrong).unwrap().samples.len(), 8_000);
    let mut twelve = tone(1, 8_000, 16, false);
    twelve[34..36].copy_from_slice(&12_u16.to_le_bytes());
    assert_eq!(read(&twelve).unwrap().samples.len(), 8_000);
}

#[test]
fn samples_beyond_full_are_made_to_fit_and_those_that_are_no_numbers_are_silence() {
    let mut bytes = tone(1, 8_000, 32, true);
    let data = bytes.len() - 8_000 * 4;
    bytes[data..data + 4].copy_from_slice(&f32::NAN.to_le_bytes());
    bytes[data + 4..data + 8].copy_from_slice(&2.0_f32.to_le_bytes());
    let sound = read(&bytes).unwrap();
    assert_eq!((sound.samples[0], sound.samples[1]), (0.0, 1.0));
    assert_eq!(sound.warnings.len(), 2, "{:?}", sound.warnings);
}

#[test]
fn what_cannot_be_read_says_why_and_what_to_do() {
    let good = tone(1, 8_000, 16, false);
    let with = |at: usize, bytes: &[u8]| {
        let mut file = good.clone();
        file[at..at + bytes.len()].copy_from_slice(bytes);
        file
    };
    for (bytes, said) in [
        (Vec::new(), "no WAV"),
        (b"ID3\x04 an MP3 of some length".to_vec(), "no WAV"),
        (good[..30].to_vec(), "does not say how its samples"),
        (good[..40].to_vec(), "no sound"),
        (good[..44].to_vec(), "no sound"),
        (with(24, &[0; 4]), "0 samples a second"),
        (with(22, &[0; 2]), "0 channels"),
        (with(22, &[0xFF, 0xFF]), "65535 channels"),
        (with(20, &[7, 0]), "µ-law"),
        (with(20, &[3, 0]), "floating point of 16 bits"),
        (with(24, &[1, 0, 0, 0]), "1 samples a second"),
        (with(24, &[0xFF; 4]), "4294967295 samples a second"),
    ] {
        let fault = read(&bytes).err().unwrap_or_else(|| panic!("read: {said}"));
        assert!(fault.what().contains(said), "{said}: {fault}");
        assert!(fault.path().is_some() && !fault.next_step().is_empty(), "{fault}");
    }
}

/// The first start and last end of each file in a table, with the columns `file`, `start`, `end` at given places.
fn ends(table: &Path, start: usize, end: usize) -> Vec<(String, f64, f64)> {
    let mut files: Vec<(String, f64, f64)> = Vec::new();
    for line in std::fs::read_to_string(table).unwrap().lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let (from, to): (f64, f64) = (cells[start].parse().unwrap(), cells[end].parse().unwrap());
        match files.last_mut() {
            Some(last) if last.0 == cells[0] => last.2 = to,
            _ => files.push((cells[0].to_owned(), from, to)),
        }
    }
    files
}

/// Prints and returns the mean and the largest of some errors, in milliseconds.
fn said(what: &str, errors: &[f64]) -> (f64, f64) {
    let mean = errors.iter().map(|e| e.abs()).sum::<f64>() / errors.len() as f64 * 1000.0;
    let bias = errors.iter().sum::<f64>() / errors.len() as f64 * 1000.0;
    let worst = errors.iter().fold(0.0_f64, |w, e| w.max(e.abs())) * 1000.0;
    println!("{what}: {} ends, mean {mean:.1} ms, bias {bias:+.1} ms, worst {worst:.1} ms", errors.len());
    (mean, worst)
}

#[test]
fn the_outer_ends_of_speech_are_found() {
    let Some(folder) = test_data::find("speech") else { return };
    for (noisy, name) in [(false, "clean"), (true, "20 dB")] {
        let (mut starts, mut stops) = (Vec::new(), Vec::new());
        for (file, start, end) in ends(&folder.join("espeak/truth.csv"), 4, 5) {
            if file.ends_with("snr20") == noisy {
                let spans = Sound::read(&folder.join(format!("espeak/{file}.wav"))).unwrap().sounding();
                starts.push(spans[0].0 - start);
                stops.push(spans[spans.len() - 1].1 - end);
            }
        }
        let (starts, _) = said(&format!("synthetic, {name}, starts"), &starts);
        let (stops, _) = said(&format!("synthetic, {name}, ends"), &stops);
        // A weak consonant drowns in noise, and a synthetic vowel dies away behind its label.
        assert!(starts < 25.0 && stops < 30.0, "{starts} {stops}");
    }
    // Stretches between pauses that a person marked.
    let table = std::fs::read_to_string(folder.join("real/real_ipu.csv")).unwrap();
    let spans = Sound::read(&folder.join("real/f1_P8.wav")).unwrap().sounding();
    let mut errors = Vec::new();
    for line in table.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        for (at, side) in [(2, 0), (3, 1)] {
            let truth: f64 = cells[at].parse().unwrap();
            let found = spans.iter().map(|s| if side == 0 { s.0 - truth } else { s.1 - truth });
            errors.push(found.min_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap());
        }
    }
    let (mean, worst) = said("real, pauses set by a person", &errors);
    assert!(mean < 15.0 && worst < 50.0, "{spans:.3?}");
}

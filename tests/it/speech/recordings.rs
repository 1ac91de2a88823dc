//! Recordings as they come: every kind of WAV, the broken ones, and where speech begins and ends.

#![allow(clippy::unwrap_used, clippy::print_stdout)]

use crate::support::test_data;
use std::io::Cursor;
use std::path::Path;

use hound::{SampleFormat, WavSpec, WavWriter};
use lianpu::disk::Fault;
use lianpu::media::Sound;

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
fn floating_point_of_64_bits_and_the_codes_of_telephones_are_read() {
    let header = |tag: u16, width: u16, data: &[u8]| {
        let mut file = tone(1, 8_000, 16, false)[..44].to_vec();
        file[20..22].copy_from_slice(&tag.to_le_bytes());
        file[32..34].copy_from_slice(&width.to_le_bytes());
        file[34..36].copy_from_slice(&(width * 8).to_le_bytes());
        put(&mut file, 40, data.len() as u32);
        [&file, data].concat()
    };
    let wide: Vec<u8> = [0.5, -0.25, 1.0].iter().flat_map(|n: &f64| n.to_le_bytes()).collect();
    assert_eq!(read(&header(3, 8, &wide)).unwrap().samples, [0.5, -0.25, 1.0]);
    let sound = read(&header(7, 1, &[0xFF, 0x80, 0x00])).unwrap();
    assert_eq!(sound.samples, [0.0, 32_124.0 / 32_768.0, -32_124.0 / 32_768.0]);
    let sound = read(&header(6, 1, &[0xD5, 0xAA, 0x2A])).unwrap();
    assert_eq!(sound.samples, [8.0 / 32_768.0, 32_256.0 / 32_768.0, -32_256.0 / 32_768.0]);
    // The same behind WAVE_FORMAT_EXTENSIBLE, and in RF64, whose length stands in a part of its own.
    let plain = header(1, 2, &[0, 64, 0, 192]);
    let guid = [&1_u16.to_le_bytes()[..], b"\0\0\0\0\x10\0\x80\0\0\xAA\0\x38\x9B\x71"].concat();
    let mut long = [&plain[..36], &22_u16.to_le_bytes(), &16_u16.to_le_bytes(), &[0; 4], &guid, &plain[36..]].concat();
    put(&mut long, 16, 40);
    long[20..22].copy_from_slice(&[0xFE, 0xFF]);
    assert_eq!(read(&long).unwrap().samples, [0.5, -0.5]);
    for name in [b"RF64", b"BW64"] {
        let lengths = [&200_u64.to_le_bytes()[..], &4_u64.to_le_bytes(), &2_u64.to_le_bytes(), &[0; 4]].concat();
        let ds64 = [b"ds64", &28_u32.to_le_bytes()[..], &lengths].concat();
        let mut file = [name, &[0xFF; 4][..], b"WAVE", &ds64, &plain[12..], &[9; 8]].concat();
        put(&mut file, 12 + 36 + 24 + 4, u32::MAX);
        let sound = read(&file).unwrap();
        assert_eq!((sound.samples.as_slice(), sound.warnings.len()), (&[0.5, -0.5][..], 0));
    }
}

#[test]
fn channels_that_cancel_each_other_are_not_mixed() {
    let mut bytes = tone(2, 8_000, 16, false);
    for right in bytes[44..].chunks_exact_mut(4) {
        let sample = i16::from_le_bytes([right[2], right[3]]).saturating_neg();
        right[2..].copy_from_slice(&sample.to_le_bytes());
    }
    let sound = read(&bytes).unwrap();
    assert!((sound.peaks(0.0, 1.0, 1)[0].1 - 0.5).abs() < 0.01);
    assert!(sound.warnings[0].contains("cancel"), "{:?}", sound.warnings);
}

/// The sound that the files of `tests/sounds` were made from.
fn bursts() -> Vec<f32> {
    let burst = |time: f64, at: f64, hertz: f64| {
        let place = (time - at) / 0.1;
        let size = if place > 0.0 && place < 1.0 { (std::f64::consts::PI * place).sin().powi(2) } else { 0.0 };
        0.5 * size * (std::f64::consts::TAU * hertz * (time - at)).sin()
    };
    let sample = |i: u32| f64::from(i) / 16_000.0;
    (0..9_600).map(|i| (burst(sample(i), 0.1, 440.0) + burst(sample(i), 0.35, 1000.0)) as f32).collect()
}

fn sounds(name: &str) -> Vec<u8> {
    std::fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/sounds").join(name)).unwrap()
}

/// How far one sound is from another moved by `shift` samples: the root mean square of the difference, as a share.
fn apart(sound: &[f32], truth: &[f32], shift: i64) -> f64 {
    let at = |i: usize| usize::try_from(i as i64 + shift).ok().and_then(|i| sound.get(i)).copied().unwrap_or(0.0);
    let wrong: f64 = truth.iter().enumerate().map(|(i, t)| f64::from(at(i) - t).powi(2)).sum();
    (wrong / truth.iter().map(|t| f64::from(*t).powi(2)).sum::<f64>()).sqrt()
}

#[test]
fn every_kind_of_file_gives_the_sound_that_went_in_at_its_time() {
    let truth = bursts();
    for (name, most) in [
        ("tone.flac", 1e-3),
        ("tone.ogg", 0.2),
        ("tone.mp3", 0.1),
        ("untagged.mp3", 0.1),
        ("tone.aac", 0.05),
        ("tone.m4a", 0.05),
        ("video.mp4", 0.05),
        ("ima.wav", 0.1),
        ("msa.wav", 0.1),
    ] {
        // Under a name that lies: the content counts.
        let sound = read(&sounds(name)).unwrap_or_else(|fault| panic!("{name}: {fault}"));
        assert_eq!((sound.rate, sound.channels, sound.warnings.len()), (16_000, 1, 0), "{name} {:?}", sound.warnings);
        assert!((9_600..9_600 + 1_200).contains(&sound.samples.len()), "{name}: {}", sound.samples.len());
        let here = apart(&sound.samples, &truth, 0);
        println!("{name}: {} samples, {here:.4} apart", sound.samples.len());
        assert!(
            here < most && here < apart(&sound.samples, &truth, 1) && here < apart(&sound.samples, &truth, -1),
            "{name}"
        );
        // Whatever lies behind the bursts is silence.
        assert!(sound.samples[9_000..].iter().all(|s| s.abs() < 0.01), "{name}");
    }
    for name in ["tone.flac", "tone.ogg", "tone.m4a", "video.mp4"] {
        assert_eq!(read(&sounds(name)).unwrap().samples.len(), 9_600, "{name}");
    }
}

#[test]
fn what_is_damaged_is_silent_and_what_follows_keeps_its_time() {
    let truth = bursts();
    let mut hurt = sounds("tone.m4a");
    let data = hurt.windows(4).position(|w| w == b"mdat").unwrap() + 4;
    // The third and fourth frame: the first burst.
    hurt[data + 9..data + 80].fill(0xA5);
    let sound = read(&hurt).unwrap();
    assert_eq!(sound.samples.len(), 9_600);
    assert!(sound.warnings.iter().any(|w| w.contains("damaged and silent, the first at 0.0")), "{:?}", sound.warnings);
    let second = |samples: &[f32]| samples[5_400..7_400].to_vec();
    assert!(apart(&second(&sound.samples), &second(&truth), 0) < 0.05);
    // MP3 has no times in it.
    let mut hurt = sounds("tone.mp3");
    let first = 288 * 6;
    hurt[first + 50..first + 600].fill(0xA5);
    let sound = read(&hurt).unwrap();
    assert!(sound.warnings.iter().any(|w| w.contains("damaged and silent, the first at 0.")), "{:?}", sound.warnings);
    let mut last = truth.clone();
    last[..5_000].fill(0.0);
    let late = (-2_000..2_000).min_by_key(|shift| (apart(&sound.samples, &last, *shift) * 1e6) as i64);
    println!("after the hole in the MP3: {late:?} samples late, {:?}", sound.warnings);
    assert!(late.is_some_and(|late: i64| late.abs() <= 1));
    let cut = sounds("tone.mp3");
    let sound = read(&cut[..cut.len() / 2]).unwrap();
    assert!(sound.samples.len() > 3_000 && sound.samples.len() < 6_000, "{}", sound.samples.len());
    assert!(sound.warnings.iter().any(|w| w.contains("cut off")), "{:?}", sound.warnings);
}

/// A page of an OGG file: packets of less than 255 bytes.
fn page(of: &[u8], kind: u8, time: u64, number: u32, packets: &[&[u8]]) -> Vec<u8> {
    let mut page = [b"OggS\0", &[kind][..], &time.to_le_bytes(), &of[14..18], &number.to_le_bytes(), &[0; 4]].concat();
    page.push(packets.len() as u8);
    page.extend(packets.iter().map(|p| p.len() as u8));
    page.extend(packets.concat());
    let sum = page.iter().fold(0_u32, |sum, byte| {
        let sum = sum ^ (u32::from(*byte) << 24);
        (0..8).fold(sum, |s, _| if s >> 31 == 1 { (s << 1) ^ 0x04C1_1DB7 } else { s << 1 })
    });
    put(&mut page, 22, sum);
    page
}

#[test]
fn a_time_that_lies_hours_ahead_is_damage_and_no_silence() {
    let whole = sounds("tone.ogg");
    let last = whole.windows(4).rposition(|w| w == b"OggS").unwrap();
    let (head, of) = whole.split_at(last);
    let sizes = &of[27..27 + usize::from(of[26])];
    let mut rest = &of[27 + sizes.len()..];
    let packets: Vec<&[u8]> = sizes.iter().map(|size| rest.split_off(..usize::from(*size)).unwrap()).collect();
    let parts: Vec<&[&[u8]]> = packets.chunks(6).collect();
    assert_eq!(parts.len(), 4);
    let length = read(&whole).unwrap().samples.len();
    for (seconds, leaps) in [(0, false), (2, false), (3 * 3600, true), (100 * 3600, true)] {
        let far = 4_800 + seconds * 16_000;
        let page = |kind, time, number, part| page(of, kind, time, number, part);
        // The time of one page is damaged, or of all that follow.
        for (third, last) in [(7_200, 9_600), (far + 2_400, far + 4_800)] {
            let pages = [page(0, 2_400, 2, parts[0]), page(0, far, 3, parts[1])];
            let rest = [page(0, third, 4, parts[2]), page(4, last, 5, parts[3])];
            let sound = read(&[head, &pages.concat(), &rest.concat()].concat()).unwrap();
            println!("{seconds} s: {} samples, {:?}", sound.samples.len(), sound.warnings);
            let silence = if seconds == 2 { 32_000 } else { 0 };
            assert!(sound.samples.len().abs_diff(length + silence) < 1_500, "{seconds}: {}", sound.samples.len());
            assert_eq!(sound.warnings.iter().any(|w| w.contains("leap")), leaps, "{:?}", sound.warnings);
        }
    }
}

#[test]
fn what_cannot_be_read_says_why_and_what_to_do() {
    let good = tone(1, 8_000, 16, false);
    let with = |at: usize, bytes: &[u8]| {
        let mut file = good.clone();
        file[at..at + bytes.len()].copy_from_slice(bytes);
        file
    };
    let mp4 = sounds("video.mp4");
    let index = mp4.windows(4).position(|w| w == b"moov").unwrap();
    let unfinished = [&mp4[..index], b"free", &mp4[index + 4..]].concat();
    for (bytes, said) in [
        (Vec::new(), "the file is empty"),
        (b"not a sound at all, but a text of some length".to_vec(), "no recording that is known"),
        (b"ID3\x04 an MP3 of some length".to_vec(), "cannot find the sound"),
        (sounds("tone.opus"), "Opus"),
        (unfinished, "never finished"),
        (good[..30].to_vec(), "does not say how its samples"),
        (good[..40].to_vec(), "no sound"),
        (good[..44].to_vec(), "no sound"),
        (with(24, &[0; 4]), "0 samples a second"),
        (with(22, &[0; 2]), "0 channels"),
        (with(22, &[0xFF, 0xFF]), "65535 channels"),
        (with(20, &[7, 0]), "µ-law of 16 bits"),
        (with(20, &[3, 0]), "floating point of 16 bits"),
        (with(20, &[0x61, 1]), ""),
        (with(24, &[1, 0, 0, 0]), "1 samples a second"),
        (with(24, &[0xFF; 4]), "4294967295 samples a second"),
    ] {
        let fault = read(&bytes).err().unwrap_or_else(|| panic!("read: {said}"));
        assert!(fault.what().contains(said), "{said}: {fault}");
        assert!(fault.path().is_some() && !fault.next_step().is_empty(), "{fault}");
    }
    assert!(read(&sounds("tone.opus")).unwrap_err().next_step().contains("ffmpeg -i speech.wav converted.wav"));
}

#[test]
fn damaged_files_of_every_kind_are_read_or_refused_within_bounds() {
    let mut state = 1_u32;
    let mut random = move || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as usize
    };
    for name in
        ["tone.flac", "tone.ogg", "tone.mp3", "untagged.mp3", "tone.aac", "tone.m4a", "video.mp4", "ima.wav", "msa.wav"]
    {
        let whole = sounds(name);
        for round in 0..60 {
            let mut bytes = whole.clone();
            match round % 3 {
                0 => bytes.truncate(random() % whole.len()),
                1 => (0..1 + random() % 8).for_each(|_| bytes[random() % whole.len()] = random() as u8),
                _ => {
                    let at = random() % whole.len();
                    let length = (random() % 64).min(whole.len() - at);
                    bytes[at..at + length].fill([0, 0xFF, random() as u8][random() % 3]);
                }
            }
            if let Ok(sound) = read(&bytes) {
                assert!(sound.duration() < 4.0 * 3600.0 && !sound.samples.is_empty(), "{name} {round}");
            }
        }
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
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
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

/// The samples of a recording with white noise so far below its mean level, in dB.
fn with_noise(sound: &Sound, db: f64) -> Sound {
    let mean = sound.samples.iter().map(|s| f64::from(*s).powi(2)).sum::<f64>() / sound.samples.len() as f64;
    let size = (3.0 * mean).sqrt() * 10.0_f64.powf(-db / 20.0);
    let mut state = 1_u32;
    let noise = |s: &f32| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        s + (size * (f64::from(state >> 8) / f64::from(1 << 23) - 1.0)) as f32
    };
    Sound::new(sound.rate, sound.samples.iter().map(noise).collect())
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn good_recordings_pass_without_remark_and_noisy_ones_do_not() {
    let Some(folder) = test_data::find("speech") else { return };
    for kind in ["espeak", "mbrola", "real", "self", "english"] {
        let (mut clean, mut noisy, mut files) = (Vec::new(), Vec::new(), 0);
        for entry in std::fs::read_dir(folder.join(kind)).unwrap().filter_map(Result::ok) {
            let path = entry.path();
            if path.extension().is_none_or(|e| e != "wav") {
                continue;
            }
            let sound = Sound::read(&path).unwrap();
            let quality = sound.quality();
            // Among them are the recordings with noise at 20 dB.
            assert!(quality.remarks().is_empty(), "{}: {:?}", path.display(), quality.remarks());
            files += 1;
            clean.push(quality.snr_db);
            if kind == "espeak" && !path.to_string_lossy().contains("snr") {
                let quality = with_noise(&sound, 10.0).quality();
                assert!(quality.remarks()[0].starts_with("noisy"), "{}: {quality:?}", path.display());
                noisy.push(quality.snr_db);
            }
        }
        let range = |values: &[f64]| {
            let least = values.iter().copied().fold(f64::INFINITY, f64::min);
            format!("{least:.1} to {:.1} dB", values.iter().copied().fold(0.0, f64::max))
        };
        println!("{kind}: {files} files, voice above noise {}; noise at 10 dB: {}", range(&clean), range(&noisy));
        assert!(files > 0);
    }
}

//! Recordings spoilt in known ways.

use lianpu::media::Sound;

use super::recordings::Recording;

/// Noise that falls by 3 dB an octave (Kellet's filter of white noise), the same for the same seed.
pub fn pink(count: usize, seed: u32) -> Vec<f32> {
    let mut state = seed;
    let mut poles = [0.0_f64; 3];
    let next = |_| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let white = f64::from(state >> 8) / f64::from(1 << 23) - 1.0;
        poles[0] = 0.99765 * poles[0] + white * 0.099_046;
        poles[1] = 0.963 * poles[1] + white * 0.296_516_4;
        poles[2] = 0.57 * poles[2] + white * 1.052_691_3;
        (poles.iter().sum::<f64>() + white * 0.1848) as f32
    };
    (0..count).map(next).collect()
}

fn loudness(samples: &[f32]) -> f32 {
    (samples.iter().map(|s| s * s).sum::<f32>() / samples.len().max(1) as f32).sqrt()
}

/// With pink noise so many dB below its syllables.
pub fn noisy(recording: &Recording, snr: f32, seed: u32) -> Recording {
    let rate = f64::from(recording.sound.rate);
    let said: Vec<f32> = recording
        .truth
        .iter()
        .flat_map(|(from, to)| &recording.sound.samples[(from * rate) as usize..(to * rate) as usize])
        .copied()
        .collect();
    let noise = pink(recording.sound.samples.len(), seed);
    let gain = loudness(&said) / loudness(&noise) / 10.0_f32.powf(snr / 20.0);
    let mixed = recording.sound.samples.iter().zip(&noise).map(|(s, n)| 0.9 * (s + gain * n)).collect();
    Recording { sound: Sound::new(recording.sound.rate, mixed), ..recording.clone() }
}

/// With other samples put in at a time; what comes after is later by as much.
pub fn inserted(recording: &Recording, at: f64, samples: &[f32]) -> Recording {
    let rate = f64::from(recording.sound.rate);
    let place = ((at * rate) as usize).min(recording.sound.samples.len());
    let (before, after) = recording.sound.samples.split_at(place);
    let later = samples.len() as f64 / rate;
    let moved = |time: f64| if time >= at - 1e-9 { time + later } else { time };
    Recording {
        name: recording.name.clone(),
        sound: Sound::new(recording.sound.rate, [before, samples, after].concat()),
        script: recording.script.clone(),
        // A syllable that starts here is later, one that ends here is not.
        truth: recording.truth.iter().map(|(s, e)| (moved(*s), if *e <= at + 1e-9 { *e } else { e + later })).collect(),
        phones: Vec::new(),
    }
}

/// A stretch of samples.
pub fn stretch(recording: &Recording, from: f64, to: f64) -> Vec<f32> {
    let rate = f64::from(recording.sound.rate);
    recording.sound.samples[(from * rate) as usize..(to * rate) as usize].to_vec()
}

/// One after the other, both scripts too.
pub fn joined(recordings: &[Recording]) -> Recording {
    let first = &recordings[0];
    let mut out = Recording { truth: Vec::new(), phones: Vec::new(), script: Vec::new(), ..first.clone() };
    let mut samples = Vec::new();
    for recording in recordings {
        assert_eq!(recording.sound.rate, first.sound.rate);
        let later = samples.len() as f64 / f64::from(first.sound.rate);
        samples.extend_from_slice(&recording.sound.samples);
        out.truth.extend(recording.truth.iter().map(|(s, e)| (s + later, e + later)));
        out.script.extend(recording.script.iter().cloned());
    }
    out.sound = Sound::new(first.sound.rate, samples);
    out
}

/// The silence of a room: very weak pink noise.
pub fn room(seconds: f64, rate: u32) -> Vec<f32> {
    pink((seconds * f64::from(rate)) as usize, 5).iter().map(|s| s * 0.0005).collect()
}

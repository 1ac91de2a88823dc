//! Synthesised speech with its true times, made more like what people record: other vocal tracts, rooms, microphones and
//! noises. The same every time.

use std::ops::Range;
use std::path::{Path, PathBuf};

use lianpu::media::Sound;
use lianpu::script::{Syllable, System, segments, syllables};
use lianpu::speech::training::{FRAMES, Features, RATE, Unit, spelled};

use crate::chance::Chance;

/// A piece of speech whose beginning and end are known, and the units it is made of.
pub struct Piece {
    pub frames: Range<usize>,
    pub units: Vec<Unit>,
}

/// A recording that is learned from.
pub struct Lesson {
    pub heard: Features,
    pub pieces: Vec<Piece>,
    /// From the start of the first syllable after a pause to the end of the last before one.
    pub spoken: Vec<Range<usize>>,
}

/// A recording with what is said in it and when.
pub struct Told {
    pub name: String,
    pub sound: Sound,
    pub script: Vec<Syllable>,
    pub times: Vec<(f64, f64)>,
    /// The phones of espeak in each syllable.
    pub phones: Vec<Vec<(String, f64, f64)>>,
}

/// Every recording of a folder, by name.
pub fn read(folder: &Path) -> Vec<Told> {
    let mut names: Vec<PathBuf> = std::fs::read_dir(folder)
        .map(|d| d.flatten().map(|e| e.path()).filter(|p| p.extension().is_some_and(|e| e == "wav")).collect())
        .unwrap_or_default();
    names.sort();
    names.iter().filter_map(|n| told(n)).collect()
}

fn told(wav: &Path) -> Option<Told> {
    let rows = |ending: &str| -> Vec<(usize, String, f64, f64)> {
        let text = std::fs::read_to_string(wav.with_extension(ending)).unwrap_or_default();
        let row = |l: &str| {
            let mut f = l.split('\t');
            Some((f.next()?.parse().ok()?, f.next()?.to_owned(), f.next()?.parse().ok()?, f.next()?.parse().ok()?))
        };
        text.lines().filter_map(row).collect()
    };
    let (said, sounds) = (rows("tsv"), rows("phones.tsv"));
    let mut script = Vec::new();
    for (_, label, ..) in &said {
        let system = if label.ends_with(|c: char| c.is_ascii_digit()) { System::Hanyu } else { System::English };
        let read = syllables(label, system).ok()?;
        if read.len() != 1 || segments(&read[0]).is_empty() {
            return None;
        }
        script.extend(read);
    }
    let mut phones = vec![Vec::new(); said.len()];
    for (at, name, start, end) in sounds {
        phones.get_mut(at)?.push((name, start, end));
    }
    let times = said.iter().map(|s| (s.2, s.3)).collect();
    let name = wav.file_stem()?.to_string_lossy().into_owned();
    Some(Told { name, sound: Sound::read(wav).ok()?, script, times, phones })
}

/// What is done to a recording before it is learned from.
pub struct Changed {
    pub samples: Vec<f32>,
    /// By what times are to be multiplied.
    pub slower: f64,
}

/// Another vocal tract, room, microphone and noise.
pub fn changed(told: &Told, chance: &mut Chance, quietest: f64, noisiest: f64) -> Changed {
    let sound = &livelier(told, chance);
    let factors = [0.88, 0.92, 0.96, 1.0, 1.0, 1.04, 1.08, 1.13];
    let factor = factors[chance.below(factors.len())];
    let rate = (f64::from(sound.rate) * factor).round() as u32;
    let slower = f64::from(sound.rate) / f64::from(rate);
    let mut samples = Sound::new(rate, sound.samples.clone()).resampled(RATE).into_owned();
    // Silence around it, some of it long.
    let pad = (chance.between(0.1, 0.4) * f64::from(RATE)) as usize;
    samples.extend(vec![0.0; pad]);
    // A microphone's tilt.
    let tilt = chance.between(-0.35, 0.35) as f32;
    for i in (1..samples.len()).rev() {
        samples[i] += tilt * samples[i - 1];
    }
    // A room: a handful of echoes that die away.
    if chance.share() < crate::setting("ROOMS", 0.1) {
        let (loud, long) = (chance.between(0.05, 0.35), chance.between(0.015, 0.06));
        let echoes: Vec<(usize, f32)> = (0..24)
            .map(|_| {
                let delay = chance.between(0.002, 0.15);
                let sign = if chance.below(2) == 0 { 1.0 } else { -1.0 };
                ((delay * f64::from(RATE)) as usize, (sign * loud * (-delay / long).exp()) as f32)
            })
            .collect();
        let dry = samples.clone();
        for (delay, gain) in echoes {
            for (s, d) in samples[delay..].iter_mut().zip(&dry) {
                *s += gain * d;
            }
        }
    }
    let voiced: Vec<f32> = samples.iter().copied().filter(|s| s.abs() > 1e-4).collect();
    let level = (voiced.iter().map(|s| f64::from(s * s)).sum::<f64>() / voiced.len().max(1) as f64).sqrt();
    let snr = match chance.below(3) {
        0 => chance.between(noisiest, 20.0),
        1 => chance.between(15.0, 35.0),
        _ => chance.between(30.0, quietest),
    };
    noise(&mut samples, level * 10_f64.powf(-snr / 20.0), chance);
    Changed { samples, slower }
}

/// Syllables of different loudness that die away before a pause or a closure: a synthesiser speaks them alike and stops
/// at once.
fn livelier(told: &Told, chance: &mut Chance) -> Sound {
    let rate = f64::from(told.sound.rate);
    let mut samples = told.sound.samples.clone();
    let (louder, dying, deep) =
        (crate::setting("LOUDER", 4.0), crate::setting("DYING", 0.07), crate::setting("DEEP", 35.0));
    let depth = chance.between(0.0, deep);
    for (number, (start, end)) in told.times.iter().enumerate() {
        let gap = told.times.get(number + 1).map_or(1.0, |n| n.0 - end);
        let stop = told.script.get(number + 1).is_none_or(|s| {
            matches!(
                segments(s).first().copied().unwrap_or(""),
                "b" | "p"
                    | "d"
                    | "t"
                    | "g"
                    | "k"
                    | "j"
                    | "q"
                    | "zh"
                    | "ch"
                    | "z"
                    | "c"
                    | "P"
                    | "B"
                    | "T"
                    | "D"
                    | "K"
                    | "G"
                    | "CH"
                    | "JH"
            )
        });
        let gain = chance.between(-louder, louder);
        let long = chance.between(0.01, dying);
        let dies = gap > 0.08 || stop;
        let (from, to) = ((start * rate) as usize, ((end * rate) as usize).min(samples.len()));
        for (i, sample) in samples[from.min(to)..to].iter_mut().enumerate() {
            let left = end - start - i as f64 / rate;
            let fade = if dies && left < long { depth * (1.0 - left / long) } else { 0.0 };
            *sample *= 10_f64.powf((gain - fade) / 20.0) as f32;
        }
    }
    Sound::new(told.sound.rate, samples)
}

/// Adds noise of some colour at a level.
pub fn noise(samples: &mut [f32], level: f64, chance: &mut Chance) {
    let colour = chance.between(0.0, 0.95);
    let mut state = 0.0;
    let hiss: Vec<f64> = samples
        .iter()
        .map(|_| {
            state = colour * state + chance.normal();
            state
        })
        .collect();
    let own = (hiss.iter().map(|h| h * h).sum::<f64>() / hiss.len().max(1) as f64).sqrt();
    for (s, h) in samples.iter_mut().zip(&hiss) {
        *s += (h * level / own) as f32;
    }
}

/// A changed recording as frames and pieces.
pub fn lesson(told: &Told, changed: &Changed) -> Lesson {
    let heard = Features::of(&changed.samples);
    let frame = |t: f64| ((t * changed.slower * FRAMES).round() as usize).min(heard.len());
    let mut pieces = Vec::new();
    let mut spoken: Vec<Range<usize>> = Vec::new();
    for (number, syllable) in told.script.iter().enumerate() {
        let (mut start, end) = told.times[number];
        let before = number.checked_sub(1).map(|n| told.times[n].1);
        let near = before.filter(|b| start - b < 0.08);
        if let (Some(b), Some(last)) = (near, spoken.last_mut()) {
            start = b;
            last.end = frame(end);
        } else {
            spoken.push(frame(start)..frame(end));
        }
        let phones = segments(syllable);
        let spelled = spelled(&phones);
        let cuts = crate::cuts::cuts(syllable, &phones, &told.phones[number]);
        // Phones between two cuts are one piece.
        let mut from = start;
        let mut units = Vec::new();
        for (i, s) in spelled.iter().enumerate() {
            units.extend(&s.units);
            let cut = if i + 1 == spelled.len() { Some(end) } else { cuts[i] };
            if let Some(cut) = cut {
                let frames = frame(from)..frame(cut);
                if frames.len() >= units.len() {
                    pieces.push(Piece { frames, units: std::mem::take(&mut units) });
                } else {
                    units.clear();
                }
                from = cut;
            }
        }
    }
    Lesson { heard, pieces, spoken }
}

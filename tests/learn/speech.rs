//! Learns what the sounds of speech are like, from synthesised speech: `learn-speech CORPUS` writes
//! `src/speech/align/learned.bin`; `learn-speech --measure DATA` says how well it aligns.
//!
//! CORPUS is what `tests/learn/speech.py` makes: folders `zh` and `en`.

#![allow(clippy::unwrap_used, clippy::print_stdout, missing_docs, reason = "a tool of the authors")]

#[path = "speech/calibrate.rs"]
mod calibrate;
#[path = "faces/chance.rs"]
mod chance;
#[path = "speech/corpus.rs"]
mod corpus;
#[path = "speech/cuts.rs"]
mod cuts;
#[path = "speech/measure.rs"]
mod measure;
#[path = "speech/mixture.rs"]
mod mixture;

use std::path::{Path, PathBuf};

use lianpu::speech::training::{ANY, DIMS, Model, SIGNS, SILENCE, Terms, UNITS, Unit};

use chance::Chance;
use corpus::Lesson;
use mixture::Frames;

fn setting(name: &str, usual: f64) -> f64 {
    std::env::var(name).map_or(usual, |s| s.parse().unwrap())
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/speech/align/learned.bin");
    let out = std::env::var("MODEL").map_or(own, PathBuf::from);
    if arguments[0] == "--measure" {
        let model = Model::read(&std::fs::read(&out).unwrap()).unwrap();
        measure::all(&model, Path::new(&arguments[1]), &arguments[2..]);
        return;
    }
    if arguments[0] == "--calibrate" {
        let mut model = Model::read(&std::fs::read(&out).unwrap()).unwrap();
        model.confidence = calibrate::calibrate(&model, &arguments[1..]);
        std::fs::write(out, model.write()).unwrap();
        return;
    }
    let corpus = PathBuf::from(&arguments[0]);
    let copies = setting("COPIES", 2.0) as usize;
    let mut lessons = Vec::new();
    let folders = std::env::var("FOLDERS").unwrap_or_else(|_| "zh en".into());
    for folder in folders.split(' ') {
        let told = corpus::read(&corpus.join(folder));
        println!("{folder}: {} recordings", told.len());
        for (number, told) in told.iter().enumerate() {
            for copy in 0..copies {
                let mut chance = Chance((number * 8 + copy) as u64 * 2 + u64::from(folder == "en"));
                let changed = corpus::changed(told, &mut chance, 60.0, setting("NOISIEST", 4.0));
                lessons.push(corpus::lesson(told, &changed));
            }
        }
    }
    let model = learn(&lessons);
    let bytes = model.write();
    println!("{} Gaussians, {} bytes", model.mixtures.iter().map(Vec::len).sum::<usize>(), bytes.len());
    std::fs::write(out, bytes).unwrap();
}

fn learn(lessons: &[Lesson]) -> Model {
    let mut model: Option<Model> = None;
    let rounds = setting("ROUNDS", 4.0) as usize;
    let most = setting("MIXTURE", 6.0) as usize;
    for round in 0..rounds {
        let mut frames = vec![Frames::default(); UNITS.len()];
        for lesson in lessons {
            let labels = labels(model.as_ref(), lesson);
            for (n, label) in labels.iter().enumerate() {
                if let Some(label) = label {
                    let frame = lesson.heard.frame(n);
                    frames[usize::from(*label)].0.extend(frame);
                    if *label != SILENCE && n % 4 == 0 {
                        frames[usize::from(ANY)].0.extend(frame);
                    }
                }
            }
        }
        let all = Frames(frames.iter().flat_map(|f| f.0.iter().copied()).collect());
        let whole = mixture::single(&all, &[0.0; DIMS]);
        let share = setting("FLOOR", 0.02) as f32;
        let mean = whole.variance.iter().sum::<f32>() / DIMS as f32;
        let floor: [f32; DIMS] = std::array::from_fn(|_| share * mean);
        let last = round + 1 == rounds;
        let mixtures = frames
            .iter()
            .enumerate()
            .map(|(unit, frames)| {
                let most = match unit as Unit {
                    _ if !last => 1,
                    ANY => setting("ANY", 24.0) as usize,
                    _ => most,
                };
                if frames.len() < 60 {
                    println!("{}: {} frames", UNITS[unit].name, frames.len());
                    return vec![whole.clone()];
                }
                mixture::mixture(frames, most, &floor)
            })
            .collect();
        model = Some(Model { mixtures, confidence: [0.0; SIGNS] });
        println!("round {round}: {} frames", all.len());
    }
    model.unwrap()
}

/// The unit of each frame: evenly by the usual times at first, then by the best way through each piece.
fn labels(model: Option<&Model>, lesson: &Lesson) -> Vec<Option<Unit>> {
    let mut labels = vec![None; lesson.heard.len()];
    let mut near = vec![false; lesson.heard.len()];
    for spoken in &lesson.spoken {
        let range = spoken.start.saturating_sub(5)..(spoken.end + 5).min(near.len());
        near[range].fill(true);
    }
    for (label, near) in labels.iter_mut().zip(&near) {
        *label = (!near).then_some(SILENCE);
    }
    for piece in &lesson.pieces {
        let ends = match model {
            None => evenly(&piece.units, piece.frames.len()),
            Some(model) => best(model, lesson, piece),
        };
        let mut from = 0;
        for (unit, to) in piece.units.iter().zip(ends) {
            labels[piece.frames.start + from..piece.frames.start + to].fill(Some(*unit));
            from = to;
        }
    }
    labels
}

fn evenly(units: &[Unit], frames: usize) -> Vec<usize> {
    let usual = |u: &Unit| f64::from(UNITS[usize::from(*u)].usual);
    let whole: f64 = units.iter().map(usual).sum();
    let mut sum = 0.0;
    units
        .iter()
        .map(|u| {
            sum += usual(u);
            (sum / whole * frames as f64).round() as usize
        })
        .collect()
}

fn best(model: &Model, lesson: &Lesson, piece: &corpus::Piece) -> Vec<usize> {
    let (n, length) = (piece.units.len(), piece.frames.len());
    let terms: Vec<Vec<Terms>> = piece.units.iter().map(|u| model.of(*u).iter().map(Terms::of).collect()).collect();
    let mut before = vec![f32::NEG_INFINITY; n];
    let mut moved = vec![vec![false; n]; length];
    for (t, moved) in moved.iter_mut().enumerate() {
        let frame = lesson.heard.frame((piece.frames.start + t).min(lesson.heard.len() - 1));
        let mut now = vec![f32::NEG_INFINITY; n];
        let mut come = f32::NEG_INFINITY;
        for (i, (now, terms)) in now.iter_mut().zip(&terms).enumerate() {
            let stay = before[i];
            let from = if t == 0 { if i == 0 { 0.0 } else { f32::NEG_INFINITY } } else { stay.max(come) };
            moved[i] = come > stay;
            *now = from + terms.iter().map(|g| g.at(frame)).fold(f32::MIN, f32::max);
            come = stay;
        }
        before = now;
    }
    let mut ends = vec![length; n];
    let mut i = n - 1;
    for t in (1..length).rev() {
        if moved[t][i] {
            i -= 1;
            ends[i] = t;
        }
    }
    ends
}

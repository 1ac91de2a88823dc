//! How the signs of a syllable tell whether its times are right: a logistic regression over synthesised voices that the
//! model was not learned from, changed, with noise down to 5 dB, some with a script that is not quite theirs.

use std::path::Path;

use lianpu::media::Sound;
use lianpu::speech::Take;
use lianpu::speech::training::{Model, SIGNS, confidence, works};

use crate::chance::Chance;
use crate::corpus;
use crate::measure::{Errors, table};

pub fn calibrate(model: &Model, folders: &[String]) -> [f32; SIGNS] {
    let (mut all, mut truth) = (Vec::new(), Vec::new());
    for folder in folders {
        for (number, told) in corpus::read(Path::new(folder)).iter().enumerate() {
            for copy in 0..3 {
                let mut chance = Chance(123_000 + (3 * number + copy) as u64);
                let other = corpus::changed(told, &mut chance, 60.0, 5.0);
                let sound = Sound::new(16_000, other.samples);
                let mut times: Vec<_> =
                    told.times.iter().map(|t| Some((t.0 * other.slower, t.1 * other.slower))).collect();
                let mut script = told.script.clone();
                if copy == 2 && script.len() > 3 {
                    // One in three has a syllable too few in its script.
                    let at = chance.below(script.len());
                    script.remove(at);
                    times.remove(at);
                }
                let Ok(work) = works(model, &[Take { sound: &sound, script: &script, pins: &[] }]).pop().unwrap()
                else {
                    continue;
                };
                let found = work.alignment(model);
                let mut errors = Errors::default();
                let times: Vec<_> = times.into_iter().flatten().collect();
                errors.add(&times, &found.syllables.iter().map(|s| (s.start, s.end)).collect::<Vec<_>>());
                for ((signs, right), s) in work.signs.iter().zip(errors.right()).zip(&found.syllables) {
                    if s.heard {
                        all.push(*signs);
                        truth.push(right);
                    }
                }
            }
        }
    }
    println!("{} syllables, {} right", all.len(), truth.iter().filter(|r| **r).count());
    let mut weights = [0.0_f64; SIGNS];
    // Newton's method with a little weight decay.
    for _ in 0..30 {
        let mut gradient = nalgebra::SVector::<f64, SIGNS>::zeros();
        let mut hessian = nalgebra::SMatrix::<f64, SIGNS, SIGNS>::identity() * 1e-3;
        for (signs, right) in all.iter().zip(&truth) {
            let x = nalgebra::SVector::<f64, SIGNS>::from_iterator(signs.iter().map(|s| f64::from(*s)));
            let p = confidence(signs, &weights.map(|w| w as f32));
            gradient += x * (f64::from(u8::from(*right)) - p);
            hessian += x * x.transpose() * (p * (1.0 - p));
        }
        let Some(step) = hessian.lu().solve(&gradient) else { break };
        for (w, s) in weights.iter_mut().zip(step.iter()) {
            *w += s;
        }
    }
    println!("{weights:.3?}");
    let weights = weights.map(|w| w as f32);
    let sure: Vec<f64> = all.iter().map(|s| confidence(s, &weights)).collect();
    table(&sure, &truth);
    weights
}

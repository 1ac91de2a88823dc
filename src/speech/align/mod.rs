//! Alignment: when each syllable of a script is spoken in a recording.
//!
//! The way of a recording: `features` hears it, `chain` makes a row of units of its script (`units`), `model` judges how
//! well each frame fits each unit, `search` finds the best way through both (`coarse` roughly before, `lasting` says how
//! long units last), `voice` moves the model towards the voice that was found, and the search is made again. `outcome`
//! makes times of the way, `confidence` says how sure they are.
//!
//! What was learned is in `learned.bin`; `NOTES.md` says from what, and `tests/learn/speech.rs` learns it again.

mod chain;
mod coarse;
mod confidence;
mod features;
mod lasting;
mod model;
mod outcome;
mod reach;
mod search;
mod sections;
mod units;
mod voice;
mod work;

/// What learning the shipped model needs beside [`align`].
#[cfg(feature = "tools")]
pub mod training {
    pub use super::confidence::{SIGNS, confidence};
    pub use super::features::{DIMS, FRAMES, Features, RATE};
    pub use super::model::{Gaussian, Model, Terms};
    pub use super::units::{ANY, SILENCE, UNITS, Unit, spelled};
    pub use super::work::Work;
    pub use super::works;
}

use rayon::prelude::*;

use self::model::Model;
use self::voice::Heard;
use self::work::Work;
use super::{Alignment, Take};
use crate::disk::Result;

/// Passes after the first, each with the model moved towards what the one before found. A third changes nothing.
const PASSES: usize = 2;

/// The model moved by other takes must fit so much better to be used, in logarithms a frame.
const GAIN: f32 = 0.5;

/// Aligns the takes of one speaker, each to its own script. Their sound is pooled to adapt the model to the voice
/// where that helps.
///
/// # Errors
/// For each take: no voice in it, too short for its script, a script without syllables.
#[must_use]
pub fn align(takes: &[Take<'_>]) -> Vec<Result<Alignment>> {
    let model = Model::learned();
    works(model, takes).into_iter().map(|work| work.map(|w| w.alignment(model))).collect()
}

/// Takes aligned by a model that need not be the learned one, with all that is known of them.
#[must_use]
pub fn works(model: &Model, takes: &[Take<'_>]) -> Vec<Result<Work>> {
    let mut works: Vec<Result<Work>> = takes.par_iter().map(Work::of).collect();
    let mut open: Vec<&mut Work> = works.iter_mut().flatten().collect();
    open.par_iter_mut().for_each(|work| work.pass(model));
    for _ in 0..PASSES {
        let heard: Vec<Heard> = open.par_iter().map(|w| Heard::of(model, &w.heard, &w.labels())).collect();
        let mut all = Heard::nothing(model);
        heard.iter().for_each(|h| all.and(h, 1.0));
        open.par_iter_mut().zip(heard).for_each(|(work, own)| {
            let mut others = all.clone();
            others.and(&own, -1.0);
            let pooled = heard_helps(model, &others, work);
            let model = if pooled { all.moved(model) } else { own.moved(model) };
            work.pass(&model);
        });
    }
    works
}

/// Whether what was heard in other takes makes the model fit this one better: it does when it is the same speaker.
fn heard_helps(model: &Model, others: &Heard, work: &Work) -> bool {
    others.frames() > 0.0 && voice::gain(model, &others.moved(model), &work.heard, &work.labels()) > GAIN
}

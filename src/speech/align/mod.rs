//! Alignment: when each syllable of a script is spoken in a recording.
//!
//! The way of a recording: `features` hears it, `chain` makes a row of units of its script (`units`), `model` judges how
//! well each frame fits each unit, `search` finds the best way through both (`coarse` roughly before, `lasting` says how
//! long units last), `voice` moves the model towards the voice that was found, and the search is made again.
//!
//! What was learned is in `learned.bin`; `NOTES.md` says from what, and `tests/learn/speech.rs` learns it again.

pub mod chain;
mod coarse;
pub mod features;
mod fourier;
pub mod lasting;
pub mod model;
pub mod search;
pub mod units;
pub mod voice;

use std::borrow::Cow;

use self::chain::Chain;
use self::features::{FRAMES, Features};
use self::model::{Gaussian, Model, judge};
use self::search::{Costs, Search, Section, Way};
use self::units::{ANY, SILENCE, Unit};
use self::voice::Heard;
use super::{Alignment, SpokenPhone, SpokenSyllable, Take};
use crate::disk::{Fault, Result};

/// How much the sound counts: frames overlap and follow each other, and say much the same.
static SOUND: std::sync::LazyLock<f32> =
    std::sync::LazyLock::new(|| std::env::var("SOUND").map_or(0.2, |s| s.parse().unwrap()));

/// Passes after the first, each with the model moved towards what the one before found.
static PASSES: std::sync::LazyLock<usize> =
    std::sync::LazyLock::new(|| std::env::var("PASSES").map_or(3, |s| s.parse().unwrap()));

/// What leaving the way costs.
const COSTS: Costs = Costs { pause: 6.0, other: 40.0, skip: 40.0 };

/// Frames to either side of a rough way that are searched.
const WIDE: usize = 200;

/// Frames to either side of a way that was searched once.
const NARROW: usize = 80;

/// Aligns the takes of one speaker, each to its own script. Their sound is pooled to adapt the model to the voice
/// where that helps.
///
/// # Errors
/// For each take: no voice in it, too short or far too long for its script, a script without syllables.
#[must_use]
pub fn align(takes: &[Take<'_>]) -> Vec<Result<Alignment>> {
    takes.iter().map(|take| align_with(Model::learned(), take)).collect()
}

/// Aligns one take by a model that need not be the learned one.
///
/// # Errors
/// As [`align`].
pub fn align_with(model: &Model, take: &Take<'_>) -> Result<Alignment> {
    let mut work = Work::of(take)?;
    work.pass(model, WIDE);
    for _ in 0..*PASSES {
        let heard = Heard::of(model, &work.heard, &work.labels());
        work.pass(&heard.moved(model), NARROW);
    }
    Ok(work.alignment())
}

/// A take on its way to an alignment.
struct Work {
    heard: Features,
    chain: Chain,
    units: Vec<Unit>,
    silence: Option<Gaussian>,
    sections: Vec<Section>,
    ways: Vec<Way>,
    rate: f32,
    duration: f64,
}

impl Work {
    fn of(take: &Take<'_>) -> Result<Self> {
        let chain = Chain::of(take.script);
        if chain.links.is_empty() {
            return Err(Fault::new("the script has no syllables").help("write down what is said in the recording"));
        }
        let samples: Cow<'_, [f32]> = take.sound.resampled(features::RATE);
        let heard = Features::of(&samples);
        let usual = chain.usual(0..chain.links.len());
        let rate = (heard.sounding() / usual).clamp(0.4, 2.5) as f32;
        let silence = voice::silence(&heard);
        let sections = vec![Section { from: 0, to: heard.len(), first: 0, last: chain.syllables.len() }];
        let units = chain.units();
        Ok(Self { heard, units, chain, silence, sections, ways: Vec::new(), rate, duration: take.sound.duration() })
    }

    /// Searches once, by a model.
    fn pass(&mut self, model: &Model, width: usize) {
        let (terms, rows) = voice::ready(model, &self.units, self.silence.as_ref());
        let mut scores = judge(&terms, &self.heard);
        // Against any voice: so scores stay near 0, and what is said beside the script has none.
        let (silence, rest) = scores.split_at_mut(1);
        let (any, rest) = rest.split_at_mut(1);
        for row in silence.iter_mut().chain(rest) {
            for (value, any) in row.iter_mut().zip(&any[0]) {
                *value = *SOUND * (*value - any);
            }
        }
        any[0].fill(0.0);
        let search = Search { chain: &self.chain, scores: &scores, rows: &rows, rate: self.rate, costs: COSTS };
        let near = |number: usize| self.ways.get(number).map(|w| w.links.as_slice());
        let ways = self.sections.iter().enumerate().map(|(n, s)| search.way(s, near(n), width)).collect();
        self.ways = ways;
    }

    /// The unit of every frame.
    fn labels(&self) -> Vec<Unit> {
        let mut labels = vec![SILENCE; self.heard.len()];
        for (section, way) in self.sections.iter().zip(&self.ways) {
            let links = &self.chain.links[self.chain.syllables[section.first].start..];
            for (link, (from, to)) in links.iter().zip(&way.links) {
                labels[*from..*to].fill(link.unit);
            }
            for (from, to) in way.beside.iter().flatten() {
                labels[*from..*to].fill(ANY);
            }
        }
        labels
    }

    fn alignment(&self) -> Alignment {
        let mut syllables = Vec::new();
        for (section, way) in self.sections.iter().zip(&self.ways) {
            let first = self.chain.syllables[section.first].start;
            for number in section.first..section.last {
                let links = self.chain.syllables[number].clone();
                let time = |frame: usize| (frame as f64 / FRAMES).min(self.duration);
                let span = |link: usize| way.links[link - first];
                let mut phones: Vec<SpokenPhone> = Vec::new();
                for (index, phone) in self.chain.phones[number].iter().enumerate() {
                    let own = links.clone().filter(|l| self.chain.links[*l].phone == index);
                    let (Some(a), Some(b)) = (own.clone().next(), own.last()) else { continue };
                    phones.push(SpokenPhone { phone, start: time(span(a).0), end: time(span(b).1) });
                }
                let (start, end) = (time(span(links.start).0), time(span(links.end - 1).1));
                syllables.push(SpokenSyllable { start, end, confidence: 1.0, heard: end > start, phones });
            }
        }
        Alignment { syllables, notes: Vec::new() }
    }
}

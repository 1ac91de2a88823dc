//! A script as the row of units that are to be heard, and how long each may last.

use std::ops::Range;

use super::units::{ANY, UNITS, Unit, is_vowel, spelled};
use crate::script::{Lang, Syllable, segments};

/// A unit at its place in the script.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Link {
    /// What is to be heard.
    pub unit: Unit,
    /// The number of its syllable.
    pub syllable: usize,
    /// The number of its phone in the syllable.
    pub phone: usize,
}

/// A script as units.
#[derive(Debug, Clone, Default)]
pub struct Chain {
    /// Every unit, in order.
    pub links: Vec<Link>,
    /// The links of each syllable.
    pub syllables: Vec<Range<usize>>,
    /// The phones of each syllable.
    pub phones: Vec<Vec<&'static str>>,
}

impl Chain {
    /// Of a script. A syllable without a reading is any voice.
    #[must_use]
    pub fn of(script: &[Syllable]) -> Self {
        let mut chain = Self::default();
        for (number, syllable) in script.iter().enumerate() {
            let from = chain.links.len();
            let phones = segments(syllable);
            for (phone, spelled) in spelled(&phones).into_iter().enumerate() {
                chain.links.extend(spelled.units.iter().map(|unit| Link { unit: *unit, syllable: number, phone }));
            }
            if phones.is_empty() {
                chain.links.push(Link { unit: ANY, syllable: number, phone: 0 });
            }
            chain.syllables.push(from..chain.links.len());
            chain.phones.push(phones);
        }
        chain
    }

    /// The same syllables the other way round.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let mut chain = Self::default();
        for (number, links) in self.syllables.iter().rev().enumerate() {
            let from = chain.links.len();
            chain.links.extend(self.links[links.clone()].iter().map(|l| Link { syllable: number, ..*l }));
            chain.syllables.push(from..chain.links.len());
        }
        chain.phones = self.phones.iter().rev().cloned().collect();
        chain
    }

    /// Whether a syllable sounds otherwise than the one at its place in another chain.
    #[must_use]
    pub fn differs(&self, other: &Self, syllable: usize) -> bool {
        let units = |c: &Self| c.links[c.syllables[syllable].clone()].iter().map(|l| l.unit).collect::<Vec<_>>();
        units(self) != units(other)
    }

    /// How long a stretch of it usually lasts, in seconds, at the usual rate.
    #[must_use]
    pub fn usual(&self, links: Range<usize>) -> f64 {
        self.links[links].iter().map(|l| f64::from(UNITS[usize::from(l.unit)].usual) / 1000.0).sum()
    }

    /// Which units are in it, each once.
    #[must_use]
    pub fn units(&self) -> Vec<Unit> {
        let mut units: Vec<Unit> = self.links.iter().map(|l| l.unit).collect();
        units.sort_unstable();
        units.dedup();
        units
    }

    /// Whether a syllable has a vowel: one without is spoken more softly.
    #[must_use]
    pub fn has_vowel(&self, syllable: usize) -> bool {
        self.links[self.syllables[syllable].clone()].iter().any(|l| is_vowel(l.unit))
    }
}

/// The language that most of a script is in.
#[must_use]
pub fn mostly(script: &[Syllable]) -> Lang {
    let english = script.iter().filter(|s| s.lang == Lang::En).count();
    if 2 * english > script.len() { Lang::En } else { Lang::Zh }
}

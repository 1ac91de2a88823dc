//! A script as the row of units that are to be heard, and how long each may last.

use std::ops::Range;

use super::units::{ANY, UNITS, Unit, spelled};
use crate::script::{Syllable, segments};

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
    pub(crate) fn of(script: &[Syllable]) -> Self {
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
    pub(crate) fn reversed(&self) -> Self {
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
    pub(crate) fn differs(&self, other: &Self, syllable: usize) -> bool {
        let units = |c: &Self| c.links[c.syllables[syllable].clone()].iter().map(|l| l.unit).collect::<Vec<_>>();
        units(self) != units(other)
    }

    /// How long a stretch of it usually lasts, in seconds, at the usual rate.
    #[must_use]
    pub(crate) fn usual(&self, links: Range<usize>) -> f64 {
        self.links[links].iter().map(|l| f64::from(UNITS[usize::from(l.unit)].usual) / 1000.0).sum()
    }

    /// Which units are in it, each once.
    #[must_use]
    pub(crate) fn units(&self) -> Vec<Unit> {
        let mut units: Vec<Unit> = self.links.iter().map(|l| l.unit).collect();
        units.sort_unstable();
        units.dedup();
        units
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::script::{System, syllables};

    #[test]
    fn both_languages_and_what_cannot_be_read_are_in_one_chain() {
        let mut script = syllables("您好 hello", System::Han).unwrap();
        script[1].pinyin = String::new();
        let chain = Chain::of(&script);
        let names: Vec<&str> = chain.links.iter().map(|l| UNITS[usize::from(l.unit)].name).collect();
        assert_eq!(names, ["N", "I", "NN", "ANY", "hh", "ah", "l", "ow1", "ow2"]);
        assert_eq!(chain.syllables, [0..3, 3..4, 4..9]);
        assert_eq!(chain.phones[2], ["HH", "AH", "L", "OW"]);
        assert!((chain.usual(0..3) - 0.21).abs() < 1e-6);
    }

    #[test]
    fn the_other_way_round_its_syllables_are_whole() {
        let chain = Chain::of(&syllables("ta1 men5 ta1", System::Hanyu).unwrap());
        let reversed = chain.reversed();
        assert_eq!(reversed.syllables, [0..3, 3..6, 6..9]);
        assert!((0..3).all(|n| !chain.differs(&reversed, n)), "the same from either end");
        let chain = Chain::of(&syllables("ni3 hao3", System::Hanyu).unwrap());
        assert!(chain.differs(&chain.reversed(), 0));
        assert_eq!(chain.reversed().reversed().links, chain.links);
    }
}

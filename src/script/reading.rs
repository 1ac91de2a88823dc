//! A reading: one syllable with or without its tone, in every spelling it may be written and printed in.

use std::fmt;

use super::romanised;
use super::sound::Sound;
use super::system::System;
use super::{han, tone, zhuyin};
use crate::pose::MouthShape;

/// How one character is read: a syllable, and its tone where that is known (1 to 4, 5 the neutral one).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Reading {
    sound: Sound,
    tone: Option<u8>,
}

impl Reading {
    /// A syllable with a tone. A number that is no tone counts as none.
    #[must_use]
    pub fn new(sound: Sound, tone: Option<u8>) -> Self {
        Self { sound, tone: tone.filter(|t| (1..=5).contains(t)) }
    }

    /// The suffix of erhua, `r5`: ㄦ, which stays a syllable of its own.
    #[must_use]
    pub fn erhua() -> Option<Self> {
        Some(Self::new(Sound::from_hanyu("r")?, Some(5)))
    }

    /// The reading of one syllable as the data files write it: Hanyu Pinyin with ü and a digit.
    pub(super) fn from_plain(text: &str) -> Option<Self> {
        let base = text.trim_end_matches(|c: char| c.is_ascii_digit());
        let tone = text[base.len()..].chars().next().and_then(tone::of_digit);
        Some(Self::new(Sound::from_hanyu(base)?, tone))
    }

    /// The syllable without its tone.
    #[must_use]
    pub fn sound(&self) -> Sound {
        self.sound
    }

    /// The tone, 1 to 5, where it is known.
    #[must_use]
    pub fn tone(&self) -> Option<u8> {
        self.tone
    }

    /// Hanyu Pinyin with the tone as a digit, none where it is not known: `nin2`, `lü4`, `hao`.
    #[must_use]
    pub fn pinyin(&self) -> String {
        with_digit(self.sound.hanyu(), self.tone)
    }

    /// Tongyong Pinyin with the tone as a digit, none where it is not known.
    #[must_use]
    pub fn tongyong(&self) -> String {
        with_digit(self.sound.tongyong(), self.tone)
    }

    /// Zhuyin as it is usually written: no mark for the first tone, the dot of the neutral tone first.
    #[must_use]
    pub fn zhuyin(&self) -> String {
        let (symbols, tone) = (self.sound.zhuyin(), self.tone.unwrap_or(0));
        let mark = tone::zhuyin_mark(tone);
        if tone == 5 { format!("{mark}{symbols}") } else { format!("{symbols}{mark}") }
    }

    /// The mouth shapes it passes through (thesis 5.2).
    #[must_use]
    pub fn shapes(&self) -> &'static [MouthShape] {
        self.sound.shapes()
    }
}

impl fmt::Display for Reading {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.pinyin())
    }
}

fn with_digit(base: &str, tone: Option<u8>) -> String {
    tone.map_or_else(|| base.to_owned(), |tone| format!("{base}{tone}"))
}

/// The readings that one label can have: none where it is not one syllable, two where the two romanisations differ.
/// A label of Zhuyin or of one character is told from any romanisation by its letters; `system` decides the rest.
#[must_use]
pub fn readings(label: &str, system: System) -> Vec<Reading> {
    let label = label.trim();
    let mut chars = label.chars();
    if let (Some(c), None) = (chars.next(), chars.next())
        && han::is_han(c)
    {
        return han::readings_of(c).into_iter().take(1).collect();
    }
    if label.chars().any(zhuyin::is_zhuyin) {
        return zhuyin::syllable(label).into_iter().collect();
    }
    let in_system = |system| match romanised::word(label, system).as_deref() {
        Some([one]) => Some(one.reading),
        _ => None,
    };
    match system {
        System::Hanyu | System::Tongyong => in_system(system).into_iter().collect(),
        System::English | System::Zhuyin => Vec::new(),
        System::Auto | System::Han => {
            let (hanyu, tongyong) = (in_system(System::Hanyu), in_system(System::Tongyong));
            let other = tongyong.filter(|t| hanyu.is_none_or(|h| h.shapes() != t.shapes()));
            hanyu.into_iter().chain(other).collect()
        }
    }
}

/// The reading of one label, such as a forced reading or a label of a TextGrid: `hang2`, `háng`, `ㄏㄤˊ`, or a character
/// (its commonest reading). Nothing where it is not one syllable, or where `system` leaves open which (`ci`, `si`
/// in [`System::Auto`]; see [`readings`]).
///
/// ```
/// use lianpu::script::{System, reading};
/// assert_eq!(reading("háng", System::Auto).unwrap().pinyin(), "hang2");
/// assert_eq!(reading("ㄏㄤˊ", System::Auto).unwrap().zhuyin(), "ㄏㄤˊ");
/// assert_eq!(reading("ci2", System::Auto), None);
/// assert_eq!(reading("ci2", System::Tongyong).unwrap().pinyin(), "qi2");
/// ```
#[must_use]
pub fn reading(label: &str, system: System) -> Option<Reading> {
    match readings(label, system).as_slice() {
        [one] => Some(*one),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_reading_prints_in_all_three_spellings() {
        let nin = reading("nin2", System::Auto).unwrap();
        assert_eq!(
            (nin.pinyin().as_str(), nin.zhuyin().as_str(), nin.tongyong().as_str()),
            ("nin2", "ㄋㄧㄣˊ", "nin2")
        );
        let de = reading("de5", System::Hanyu).unwrap();
        assert_eq!(de.zhuyin(), "˙ㄉㄜ");
        let lv = reading("lu:4", System::Hanyu).unwrap();
        assert_eq!((lv.pinyin().as_str(), lv.tongyong().as_str()), ("lü4", "lyu4"));
        assert_eq!(reading("ma", System::Auto).unwrap().zhuyin(), "ㄇㄚ");
    }

    #[test]
    fn a_label_of_two_syllables_or_of_none_has_no_reading() {
        for label in ["", "ni3hao3", "hello", "ㄋㄧˇㄏㄠˇ", "{}", "sil"] {
            assert_eq!(reading(label, System::Auto), None, "{label}");
        }
    }
}

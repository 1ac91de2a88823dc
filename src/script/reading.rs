//! A reading: one syllable with or without its tone, in every spelling it may be written and printed in.

use std::fmt;
use std::ops::Range;

use super::sound::Sound;
use super::tone;
use crate::pose::MouthShape;

/// How one character is read: a syllable, and its tone where that is known (1 to 4, 5 the neutral one).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Reading {
    sound: Sound,
    tone: Option<u8>,
}

/// One syllable of a word or label: its reading and its bytes in that word.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Written {
    pub(super) reading: Reading,
    pub(super) span: Range<usize>,
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

//! The readings of a label: one syllable, in whatever spelling it is written.

use super::reading::{Reading, Written};
use super::romanised::Romanised;
use super::system::System;
use super::{han, zhuyin};

/// The candidates of a label, such as a word in braces: a character, Zhuyin, and the two romanisations.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Label<'a> {
    /// The label as written.
    pub(super) text: &'a str,
    /// Its syllables in the two romanisations.
    pub(super) pinyin: Romanised,
    /// Its syllables in Zhuyin, where a horizontal stroke may stand for ㄧ.
    zhuyin: Option<Vec<Written>>,
    /// Whether a symbol or tone mark of Zhuyin is in it.
    has_zhuyin: bool,
}

impl<'a> Label<'a> {
    /// Reads a label without white space around it.
    pub(super) fn of(text: &'a str) -> Self {
        Self {
            text,
            pinyin: Romanised::of(text),
            zhuyin: zhuyin::run(text),
            has_zhuyin: text.chars().any(zhuyin::is_zhuyin),
        }
    }

    /// Whether it is a reading wherever it stands: Zhuyin, or Hanyu Pinyin that shows its tones.
    pub(super) fn is_reading(&self) -> bool {
        self.zhuyin.is_some() || (self.pinyin.shows_tones() && self.pinyin.in_system(System::Hanyu).is_some())
    }

    /// Its syllables in Zhuyin; nothing where no symbol of Zhuyin is in it.
    pub(super) fn in_zhuyin(&self) -> Option<&[Written]> {
        self.zhuyin.as_deref().filter(|_| self.has_zhuyin)
    }

    /// The readings it can have as one syllable, as [`readings`] gives them.
    pub(super) fn readings(&self, system: System) -> Vec<Reading> {
        let mut chars = self.text.chars();
        if let (Some(c), None) = (chars.next(), chars.next())
            && han::is_han(c)
        {
            return han::readings_of(c).into_iter().take(1).collect();
        }
        if self.has_zhuyin {
            return one(self.in_zhuyin()).into_iter().collect();
        }
        let in_system = |system| one(self.pinyin.in_system(system));
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
}

/// The reading of what is exactly one syllable.
fn one(syllables: Option<&[Written]>) -> Option<Reading> {
    match syllables {
        Some([one]) => Some(one.reading),
        _ => None,
    }
}

/// The readings that one label can have: none where it is not one syllable, two where the two romanisations differ.
/// A label of Zhuyin or of one character is told from any romanisation by its letters; `system` decides the rest.
#[must_use]
pub fn readings(label: &str, system: System) -> Vec<Reading> {
    Label::of(label.trim()).readings(system)
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

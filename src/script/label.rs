//! The readings of a label: one syllable, in whatever spelling it is written.

use super::reading::Reading;
use super::system::System;
use super::{han, romanised, zhuyin};

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

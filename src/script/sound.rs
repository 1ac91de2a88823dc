//! The table of Mandarin syllables without tones: every spelling of each, and the mouth shapes it passes through
//! (thesis 5.2, tables 5.1 to 5.4, rebuilt as `SOURCES.md` section 4 says).
//!
//! It knows nothing of characters, words and tones.

use std::sync::LazyLock;

use crate::pose::MouthShape;

/// One toneless syllable of Mandarin: a row of `syllables.csv`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Sound(u16);

/// What is known of one syllable.
#[derive(Debug)]
struct Row {
    hanyu: &'static str,
    zhuyin: &'static str,
    tongyong: &'static str,
    shapes: Vec<MouthShape>,
    /// An interjection without a vowel, or the suffix of erhua: never found inside a longer word.
    interjection: bool,
}

/// The table and its three orders.
struct Table {
    rows: Vec<Row>,
    by_hanyu: Vec<u16>,
    by_zhuyin: Vec<u16>,
    by_tongyong: Vec<u16>,
}

/// The table is part of the program: a fault in it is ours and the tests'.
static TABLE: LazyLock<Table> = LazyLock::new(|| {
    let rows: Vec<Row> = include_str!("syllables.csv")
        .lines()
        .skip(1)
        .filter_map(|line| {
            let mut cells = line.split(',');
            let (hanyu, zhuyin, tongyong) = (cells.next()?, cells.next()?, cells.next()?);
            let shapes = cells.nth(1)?.split(' ').filter_map(|s| s.parse().ok()).collect();
            let interjection = cells.next()? == "interj";
            Some(Row { hanyu, zhuyin, tongyong, shapes, interjection })
        })
        .collect();
    // A stable sort: of two rows with one spelling the earlier is found, so that Tongyong `e` is ㄜ and ㄦ is er.
    let order = |key: fn(&Row) -> &'static str| {
        let mut order: Vec<u16> = (0..rows.len()).filter_map(|i| u16::try_from(i).ok()).collect();
        order.sort_by_key(|i| key(&rows[usize::from(*i)]));
        order
    };
    let (by_hanyu, by_zhuyin, by_tongyong) = (order(|r| r.hanyu), order(|r| r.zhuyin), order(|r| r.tongyong));
    Table { rows, by_hanyu, by_zhuyin, by_tongyong }
});

fn find(order: &[u16], key: fn(&Row) -> &'static str, spelling: &str) -> Option<Sound> {
    let at = order.partition_point(|i| key(&TABLE.rows[usize::from(*i)]) < spelling);
    let row = *order.get(at)?;
    (key(&TABLE.rows[usize::from(row)]) == spelling).then_some(Sound(row))
}

/// How a syllable begins, as far as its timing goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum InitialClass {
    /// No consonant: ya, wo, an.
    None,
    /// b, p, m, f: the syllable begins with the lips closed.
    Labial,
    /// Any other consonant.
    Other,
}

/// What follows the initial, as far as the timing of its shapes goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum FinalClass {
    /// One vowel, or the empty rime.
    Vowel,
    /// ai, ei, ao, ou.
    Diphthong,
    /// A glide and a vowel: ia, ie, ua, uo, üe.
    GlideVowel,
    /// A glide and a diphthong: iao, iou, uai, uei.
    GlideDiphthong,
    /// A vowel and a nasal: an, en, in, un, and ㄥ.
    Nasal,
    /// A glide, a vowel and a nasal: ian, uan, üan, iang, uang.
    GlideNasal,
}

impl Sound {
    /// Every syllable of the table, in its order.
    pub fn all() -> impl Iterator<Item = Self> {
        (0..TABLE.rows.len()).filter_map(|i| u16::try_from(i).ok()).map(Self)
    }

    fn row(self) -> &'static Row {
        &TABLE.rows[usize::from(self.0)]
    }

    /// The syllable of a spelling in Hanyu Pinyin: lower case, no tone, `ü` as ü.
    #[must_use]
    pub fn from_hanyu(spelling: &str) -> Option<Self> {
        find(&TABLE.by_hanyu, |r| r.hanyu, spelling)
    }

    /// The syllable of a spelling in Zhuyin, without tone mark.
    #[must_use]
    pub fn from_zhuyin(spelling: &str) -> Option<Self> {
        find(&TABLE.by_zhuyin, |r| r.zhuyin, spelling)
    }

    /// The syllable of a spelling in Tongyong Pinyin: lower case, no tone. `e` alone is ㄜ, ㄝ is written `ê`.
    #[must_use]
    pub fn from_tongyong(spelling: &str) -> Option<Self> {
        let spelling = if spelling == "ê" { return Self::from_hanyu("ê") } else { spelling };
        find(&TABLE.by_tongyong, |r| r.tongyong, spelling)
    }

    /// Its spelling in Hanyu Pinyin.
    #[must_use]
    pub fn hanyu(self) -> &'static str {
        self.row().hanyu
    }

    /// Its spelling in Zhuyin.
    #[must_use]
    pub fn zhuyin(self) -> &'static str {
        self.row().zhuyin
    }

    /// Its spelling in Tongyong Pinyin.
    #[must_use]
    pub fn tongyong(self) -> &'static str {
        // The table prints `e` for ㄝ; it is written `ê` so that it reads back as itself.
        if self.row().hanyu == "ê" { "ê" } else { self.row().tongyong }
    }

    /// The mouth shapes it passes through, one to four (thesis tables 5.1 to 5.4).
    #[must_use]
    pub fn shapes(self) -> &'static [MouthShape] {
        &self.row().shapes
    }

    /// Whether it is one of the vowelless interjections or the suffix of erhua.
    #[must_use]
    pub fn is_interjection(self) -> bool {
        self.row().interjection
    }

    /// Its initial in Zhuyin, where it has one.
    #[must_use]
    pub fn initial(self) -> Option<char> {
        self.zhuyin().chars().next().filter(|c| ('ㄅ'..='ㄙ').contains(c))
    }

    /// Its final in Zhuyin; empty for the empty rime of zhi, chi, shi, ri, zi, ci, si.
    #[must_use]
    pub fn rime(self) -> &'static str {
        let zhuyin = self.zhuyin();
        zhuyin.strip_prefix(|c| ('ㄅ'..='ㄙ').contains(&c)).unwrap_or(zhuyin)
    }

    /// The class of its initial.
    #[must_use]
    pub fn initial_class(self) -> InitialClass {
        match self.initial() {
            None => InitialClass::None,
            Some('ㄅ' | 'ㄆ' | 'ㄇ' | 'ㄈ') => InitialClass::Labial,
            Some(_) => InitialClass::Other,
        }
    }

    /// The class of its final.
    #[must_use]
    pub fn final_class(self) -> FinalClass {
        let rime = self.rime();
        let glide = rime.starts_with(['ㄧ', 'ㄨ', 'ㄩ']);
        let rest = if glide { rime.get('ㄧ'.len_utf8()..).unwrap_or("") } else { rime };
        match rest.chars().next() {
            Some('ㄞ' | 'ㄟ' | 'ㄠ' | 'ㄡ') if glide => FinalClass::GlideDiphthong,
            Some('ㄞ' | 'ㄟ' | 'ㄠ' | 'ㄡ') => FinalClass::Diphthong,
            Some('ㄢ' | 'ㄤ') if glide => FinalClass::GlideNasal,
            // After a glide ㄣ and ㄥ are the nasal alone: yin is i n.
            Some('ㄢ' | 'ㄤ' | 'ㄣ' | 'ㄥ' | 'ㄇ' | 'ㄫ') => FinalClass::Nasal,
            Some(_) if glide => FinalClass::GlideVowel,
            _ => FinalClass::Vowel,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_spelling_leads_back_to_its_own_shapes() {
        assert_eq!(Sound::all().filter(|s| !s.is_interjection()).count(), 422);
        for sound in Sound::all() {
            let same = |found: Option<Sound>| found.is_some_and(|f| f.shapes() == sound.shapes());
            assert!((1..=4).contains(&sound.shapes().len()), "{}", sound.hanyu());
            assert_eq!(Sound::from_hanyu(sound.hanyu()), Some(sound));
            assert!(same(Sound::from_zhuyin(sound.zhuyin())), "{}", sound.zhuyin());
            assert!(same(Sound::from_tongyong(sound.tongyong())), "{}", sound.tongyong());
        }
    }

    #[test]
    fn a_shared_spelling_is_the_syllable_and_not_the_interjection() {
        assert_eq!(Sound::from_zhuyin("ㄦ").map(Sound::hanyu), Some("er"));
        assert_eq!(Sound::from_tongyong("e").map(Sound::zhuyin), Some("ㄜ"));
    }

    #[test]
    fn initials_and_finals_fall_into_their_classes() {
        let of = |s: &str| Sound::from_hanyu(s).map(|s| (s.initial_class(), s.final_class())).unwrap();
        assert_eq!(of("ya"), (InitialClass::None, FinalClass::GlideVowel));
        assert_eq!(of("bian"), (InitialClass::Labial, FinalClass::GlideNasal));
        assert_eq!(of("zhi"), (InitialClass::Other, FinalClass::Vowel));
        assert_eq!(of("wei"), (InitialClass::None, FinalClass::GlideDiphthong));
        assert_eq!(of("ning"), (InitialClass::Other, FinalClass::Nasal));
        assert_eq!(of("deng"), (InitialClass::Other, FinalClass::Nasal));
    }
}

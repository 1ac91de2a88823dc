//! When, within its syllable, each mouth shape starts: as the thesis has it (5.3), or as it was measured
//! (`SOURCES.md` section 4).
//!
//! Where the times of phones are known they win over both (`onsets_in_phones`).

use std::sync::LazyLock;

use serde::{Deserialize, Serialize};

use super::phone;
use super::sound::{FinalClass, InitialClass, Sound};
use super::syllable::{Lang, Syllable};

/// Where the shares come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum OnsetPreset {
    /// Thesis 5.3, read as shares of the whole syllable; by the number of shapes alone.
    Thesis,
    /// Means over about 12,000 aligned syllables, by initial class and final; four shapes as in the thesis.
    #[default]
    Measured,
}

/// A row of `onsets.csv`.
struct Row {
    preset: &'static str,
    initial: &'static str,
    kind: &'static str,
    onsets: Vec<f64>,
}

/// The table is part of the program: a fault in it is ours and the tests'.
static ROWS: LazyLock<Vec<Row>> = LazyLock::new(|| {
    include_str!("onsets.csv")
        .lines()
        .skip(1)
        .filter_map(|line| {
            let mut cells = line.split(',');
            let (preset, initial, kind) = (cells.next()?, cells.next()?, cells.next()?);
            Some(Row { preset, initial, kind, onsets: cells.filter_map(|c| c.parse().ok()).collect() })
        })
        .collect()
});

/// The share of the syllable at which each of its shapes starts: the first at 0, then rising, all below 1.
///
/// Shapes of an English word start where their phones do when all phones last equally long.
#[must_use]
pub fn onsets(syllable: &Syllable, preset: OnsetPreset) -> Vec<f64> {
    let count = syllable.shapes.len();
    if syllable.lang == Lang::En {
        let starts = phone::shapes_with_phones(&syllable.phones);
        if starts.len() == count && !syllable.phones.is_empty() {
            let phones = syllable.phones.len() as f64;
            return starts.iter().enumerate().map(|(i, (_, at))| if i == 0 { 0.0 } else { at / phones }).collect();
        }
        return equal(count);
    }
    let inner = match preset {
        OnsetPreset::Thesis => row("thesis", "any", by_count(count)),
        OnsetPreset::Measured => syllable.sound().and_then(|sound| measured(sound, count)),
    };
    match inner.or_else(|| row("thesis", "any", by_count(count))) {
        Some(inner) if inner.len() + 1 == count => std::iter::once(0.0).chain(inner.iter().copied()).collect(),
        _ => equal(count),
    }
}

/// Equal shares, for what no table has.
fn equal(count: usize) -> Vec<f64> {
    (0..count).map(|i| i as f64 / count as f64).collect()
}

fn by_count(count: usize) -> &'static str {
    match count {
        2 => "two",
        3 => "three",
        4 => "four",
        _ => "one",
    }
}

/// The measured row of a syllable; of the nearest class where its own was not measured.
fn measured(sound: Sound, count: usize) -> Option<&'static [f64]> {
    let initial = match sound.initial_class() {
        InitialClass::None => "none",
        InitialClass::Labial => "labial",
        InitialClass::Other => "other",
    };
    let kind = match (count, sound.final_class()) {
        (2, _) if initial == "labial" => {
            // The lips' release decides: meng, and feng, are timed as ma is.
            return row("measured", "labial", "vowel");
        }
        (2, FinalClass::Diphthong) => "diphthong",
        (2, FinalClass::GlideVowel) => "glide vowel",
        (2, _) => "nasal",
        (3, _) => "three",
        (4, _) => "four",
        _ => return None,
    };
    row("measured", initial, kind)
}

fn row(preset: &str, initial: &str, kind: &str) -> Option<&'static [f64]> {
    ROWS.iter()
        .find(|r| r.preset == preset && r.kind == kind && (r.initial == initial || r.initial == "any"))
        .map(|r| r.onsets.as_slice())
}

#[cfg(test)]
mod tests {
    use super::super::{System, reading};
    use super::*;

    fn of(pinyin: &str, preset: OnsetPreset) -> Vec<f64> {
        let reading = reading(pinyin, System::Hanyu).unwrap();
        onsets(&Syllable::mandarin(pinyin, &reading, 0..0), preset)
    }

    #[test]
    fn the_thesis_goes_by_the_number_of_shapes() {
        assert_eq!(of("nin2", OnsetPreset::Thesis), [0.0, 0.8095]);
        assert_eq!(of("wei4", OnsetPreset::Thesis), [0.0, 0.4337, 0.8312]);
        assert_eq!(of("bian4", OnsetPreset::Thesis), [0.0, 0.2450, 0.4565, 0.7153]);
        assert_eq!(of("a1", OnsetPreset::Thesis), [0.0]);
    }

    #[test]
    fn the_measured_go_by_initial_and_final_and_not_by_shapes() {
        assert_eq!(of("ya1", OnsetPreset::Measured), [0.0, 0.320]);
        assert_eq!(of("jia1", OnsetPreset::Measured), [0.0, 0.620]);
        assert_eq!(of("nin2", OnsetPreset::Measured), [0.0, 0.623]);
        assert_eq!(of("ma1", OnsetPreset::Measured), [0.0, 0.464]);
        assert_eq!(of("hao3", OnsetPreset::Measured), [0.0, 0.783]);
        assert_eq!(of("wei4", OnsetPreset::Measured), [0.0, 0.357, 0.750]);
        assert_eq!(of("dian4", OnsetPreset::Measured), [0.0, 0.476, 0.758]);
        assert_eq!(of("mai4", OnsetPreset::Measured), [0.0, 0.384, 0.710]);
        assert_eq!(of("bian4", OnsetPreset::Measured), of("bian4", OnsetPreset::Thesis));
    }

    #[test]
    fn every_syllable_rises_from_0_and_stays_below_1() {
        for sound in Sound::all() {
            for preset in [OnsetPreset::Thesis, OnsetPreset::Measured] {
                let found = of(sound.hanyu(), preset);
                assert_eq!((found.len(), found[0]), (sound.shapes().len(), 0.0), "{}", sound.hanyu());
                assert!(found.is_sorted_by(|a, b| a < b) && found.iter().all(|s| *s < 1.0), "{}", sound.hanyu());
            }
        }
    }

    #[test]
    fn a_word_of_english_spreads_its_shapes_over_its_phones() {
        let word = Syllable::english("map", super::super::english::word("map", true), 0..3);
        assert_eq!(onsets(&word, OnsetPreset::Measured), [0.0, 1.0 / 3.0, 2.0 / 3.0]);
    }
}

//! When, within its syllable, each mouth shape starts, from the times of the phones inside it.
//!
//! A shape starts with the phone that it is the mouth of; what has no shape of its own goes with the shape after it.
//! Lips part when a stop is released, before its breath is over; they round for u, ü and o while the consonant before is
//! still said, and open for the other vowels when those begin.

use super::onsets::{OnsetPreset, onsets};
use super::phone;
use super::segment::segments;
use super::syllable::{Lang, Syllable};
use crate::pose::MouthShape;

/// How long after the lips part the phone of an unaspirated stop goes on, in seconds: its burst.
const BURST: f64 = 0.012;

/// The same for an aspirated one: burst and breath.
const BREATH: f64 = 0.065;

/// However short a stop, its lips are closed for this share of it.
const LEAST_CLOSED: f64 = 0.4;

/// The share of the syllable at which each of its shapes starts, rising from 0 or later and below 1.
///
/// `span` is the start and the end of the syllable in seconds, `phones` those of each of its [`segments`], in order and
/// inside it. Where their number is another, or times run backwards, the preset holds.
#[must_use]
pub fn onsets_in_phones(syllable: &Syllable, span: (f64, f64), phones: &[(f64, f64)], preset: OnsetPreset) -> Vec<f64> {
    let names = segments(syllable);
    let rises = phones.iter().all(|(a, b)| b > a) && phones.windows(2).all(|w| w[1].0 >= w[0].0);
    if phones.is_empty() || names.len() != phones.len() || !rises {
        return onsets(syllable, preset);
    }
    let starts = match syllable.lang {
        Lang::Zh => mandarin(&syllable.shapes, &names, phones),
        Lang::En => english(syllable, &names, phones),
    };
    let length = span.1 - span.0;
    // Rounding in a file may leave a phone a little before its syllable.
    let share = |t: f64| ((t - span.0) / length).max(0.0);
    let shares: Option<Vec<f64>> = starts.map(|s| s.into_iter().map(share).collect());
    let rising = |s: &Vec<f64>| s.is_sorted_by(|a, b| a < b) && s.iter().all(|v| (0.0..1.0).contains(v));
    shares.filter(rising).unwrap_or_else(|| onsets(syllable, preset))
}

/// When the lips part, if a phone closes them.
fn released(name: &str, (start, end): (f64, f64)) -> Option<f64> {
    let after = match name {
        "b" | "B" => BURST,
        "p" | "P" => BREATH,
        "m" | "M" => 0.0,
        _ => return None,
    };
    Some((end - after).max(start + LEAST_CLOSED * (end - start)))
}

fn mandarin(shapes: &[MouthShape], names: &[&str], phones: &[(f64, f64)]) -> Option<Vec<f64>> {
    let mut starts = Vec::with_capacity(shapes.len());
    // The first phone that no shape has taken yet.
    let mut free = 0;
    for (i, shape) in shapes.iter().enumerate() {
        let own = (free..names.len()).find(|p| gives(names[*p], *shape)).or((free < names.len()).then_some(free))?;
        // Phones passed over go with this shape, but an unrounded vowel waits for a consonant before it.
        let waits = i == 0 && own > 0 && !matches!(shape, MouthShape::U | MouthShape::O);
        let first = if waits { (free..own).find(|p| is_vowel(names[*p])).unwrap_or(own) } else { free };
        let parted = free.checked_sub(1).and_then(|p| released(names[p], phones[p]));
        starts.push(parted.filter(|_| first == free).unwrap_or(phones[first].0));
        // Xiong is spoken ü u ng and drawn u n: one mouth for both vowels.
        free = own + 1;
        while names.get(free).is_some_and(|n| is_vowel(n) && gives(n, *shape)) {
            free += 1;
        }
    }
    Some(starts)
}

fn is_vowel(name: &str) -> bool {
    matches!(name, "a" | "o" | "e" | "ê" | "i" | "u" | "ü" | "ih" | "er")
}

/// Whether a phone of Mandarin is spoken with a mouth shape (thesis tables 5.1 to 5.4).
fn gives(name: &str, shape: MouthShape) -> bool {
    match shape {
        MouthShape::M => matches!(name, "b" | "p" | "m"),
        MouthShape::F => name == "f",
        // ㄧㄢ is written and drawn with a, and spoken with ê.
        MouthShape::A => matches!(name, "a" | "ê"),
        MouthShape::E => matches!(name, "e" | "ê"),
        MouthShape::O => name == "o",
        MouthShape::I => name == "i",
        MouthShape::U => matches!(name, "u" | "ü"),
        MouthShape::H => matches!(name, "e" | "ih" | "er" | "h"),
        MouthShape::N => matches!(name, "n" | "ng"),
    }
}

fn english(word: &Syllable, names: &[&str], phones: &[(f64, f64)]) -> Option<Vec<f64>> {
    let places = phone::shapes_with_phones(&word.phones);
    if places.len() != word.shapes.len() {
        return None;
    }
    let start = |(_, at): &(MouthShape, f64)| {
        let index = (at.floor() as usize).min(phones.len() - 1);
        let (from, to) = phones[index];
        let parted = index.checked_sub(1).filter(|_| at.fract() == 0.0).and_then(|p| released(names[p], phones[p]));
        parted.unwrap_or(from + at.fract() * (to - from))
    };
    Some(places.iter().map(start).collect())
}

#[cfg(test)]
mod tests {
    use super::super::{System, syllables};
    use super::*;

    /// The shares for phones of so many hundredths of a second.
    fn of(text: &str, lengths: &[f64]) -> Vec<f64> {
        let syllable = &syllables(text, System::Auto).unwrap()[0];
        let mut at = 1.0;
        let phones: Vec<(f64, f64)> = lengths
            .iter()
            .map(|l| {
                at += l / 100.0;
                (at - l / 100.0, at)
            })
            .collect();
        let shares = onsets_in_phones(syllable, (1.0, at), &phones, OnsetPreset::Measured);
        shares.iter().map(|s| (s * 1000.0).round() / 1000.0).collect()
    }

    #[test]
    fn shapes_start_with_their_phones() {
        assert_eq!(of("nin2", &[6.0, 8.0, 6.0]), [0.3, 0.7]);
        assert_eq!(of("ya1", &[10.0, 30.0]), [0.0, 0.25]);
        assert_eq!(of("wei4", &[10.0, 10.0, 20.0]), [0.0, 0.25, 0.5]);
        assert_eq!(of("yan2", &[10.0, 10.0, 20.0]), [0.0, 0.25, 0.5]);
        assert_eq!(of("xiong2", &[10.0, 5.0, 5.0, 20.0]), [0.0, 0.5]);
    }

    #[test]
    fn rounded_lips_are_there_before_their_vowel_and_open_ones_with_it() {
        assert_eq!(of("shu1", &[10.0, 10.0]), [0.0]);
        assert_eq!(of("sha1", &[10.0, 10.0]), [0.5]);
        // The vowel of meng has no shape of its own: n begins with it.
        assert_eq!(of("meng4", &[10.0, 10.0, 20.0]), [0.0, 0.25]);
    }

    #[test]
    fn lips_part_at_the_release_of_a_stop() {
        assert_eq!(of("ma1", &[10.0, 10.0]), [0.0, 0.5]);
        assert_eq!(of("ba1", &[10.0, 10.0]), [0.0, 0.44]);
        assert_eq!(of("pa1", &[15.0, 15.0]), [0.0, 0.283]);
        assert_eq!(of("pa1", &[5.0, 15.0]), [0.0, 0.1]);
        assert_eq!(of("map", &[10.0, 10.0, 10.0]), [0.0, 0.333, 0.667]);
    }

    #[test]
    fn what_does_not_fit_takes_the_preset() {
        let hao = &syllables("好", System::Auto).unwrap()[0];
        let preset = onsets(hao, OnsetPreset::Measured);
        for phones in [&[][..], &[(0.0, 0.1)], &[(0.0, 0.1), (0.1, 0.2)], &[(0.2, 0.3), (0.1, 0.2), (0.0, 0.1)]] {
            assert_eq!(onsets_in_phones(hao, (0.0, 0.3), phones, OnsetPreset::Measured), preset);
        }
    }

    #[test]
    fn every_syllable_has_rising_onsets_of_its_own() {
        for sound in super::super::Sound::all().filter(|s| !s.is_interjection()) {
            let syllable = &syllables(sound.hanyu(), System::Hanyu).unwrap()[0];
            let names = segments(syllable);
            let phones: Vec<(f64, f64)> = (0..names.len()).map(|i| (i as f64, i as f64 + 1.0)).collect();
            let starts = mandarin(&syllable.shapes, &names, &phones);
            let rises = starts.as_ref().is_some_and(|s| s.is_sorted_by(|a, b| a < b));
            assert!(rises, "{}: {starts:?}", sound.hanyu());
        }
    }
}

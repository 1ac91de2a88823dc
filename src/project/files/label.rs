//! Labels of the tier `syllables`: characters, any romanisation of them, or both as `行{hang2}`.

use crate::script::{self, Reading, Syllable, System};

/// Whether a tier's label can stand for a syllable: the same text, or a reading that it can have.
pub(in crate::project) fn label_fits(syllable: &Syllable, label: &str) -> bool {
    let label = label.trim();
    if let Some(forced) = forced_in(label) {
        return label_text(label) == syllable.text && script::reading(forced, System::Auto).is_some();
    }
    label.eq_ignore_ascii_case(&syllable.text)
        || script::readings(label, System::Auto).iter().any(|reading| can_have(syllable, reading))
}

/// Whether a syllable can be read so: as it is, or as its character is elsewhere.
fn can_have(syllable: &Syllable, reading: &Reading) -> bool {
    let mut letters = syllable.text.chars();
    syllable.sound() == Some(reading.sound())
        || match (letters.next(), letters.next()) {
            (Some(c), None) => script::readings_of(c).iter().any(|known| known.sound() == reading.sound()),
            _ => false,
        }
}

/// The character before a forced reading: 行 of `行{hang2}`.
fn label_text(label: &str) -> &str {
    label.split('{').next().unwrap_or(label).trim()
}

/// The reading in the braces of `行{hang2}`.
fn forced_in(label: &str) -> Option<&str> {
    label.split_once('{').and_then(|(_, rest)| rest.strip_suffix('}'))
}

/// The reading that a label gives beyond its character: of `行{hang2}` or of `hang2`. A bare sound without its tone
/// says nothing new about a syllable that has that sound.
pub(in crate::project) fn label_reading(syllable: &Syllable, label: &str) -> Option<Reading> {
    let label = label.trim();
    if let Some(forced) = forced_in(label) {
        return script::reading(forced, System::Auto);
    }
    if label.eq_ignore_ascii_case(&syllable.text) {
        return None;
    }
    let reading = script::readings(label, System::Auto).into_iter().find(|r| can_have(syllable, r))?;
    let says_less = reading.tone().is_none() && syllable.sound() == Some(reading.sound());
    (!says_less).then_some(reading)
}

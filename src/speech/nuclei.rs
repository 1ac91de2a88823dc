//! Where syllables are, without knowing which: nuclei and pauses, for an author to type words onto.

use super::Sound;

/// What is heard in a recording without a script.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Heard {
    /// Each syllable's start and end, in seconds, by rising time.
    pub syllables: Vec<(f64, f64)>,
    /// The pauses between, before and after them, in seconds.
    pub pauses: Vec<(f64, f64)>,
}

/// Marks the syllables of a recording.
#[must_use]
pub fn nuclei(_sound: &Sound) -> Heard {
    Heard::default()
}

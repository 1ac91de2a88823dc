//! The lanes of the timeline that one can stand on.

use crate::timeline::Track;

/// A lane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lane {
    /// What is said, syllable by syllable.
    Syllables,
    /// A track of keys.
    Keys(Track),
}

impl Lane {
    /// All lanes from top to bottom.
    pub(crate) const ALL: [Self; 6] = [
        Self::Syllables,
        Self::Keys(Track::Mouth),
        Self::Keys(Track::Emotion),
        Self::Keys(Track::Blink),
        Self::Keys(Track::Gaze),
        Self::Keys(Track::Head),
    ];

    /// What it is called on the screen.
    #[must_use]
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Syllables => "said",
            Self::Keys(Track::Mouth) => "mouth",
            Self::Keys(Track::Emotion) => "emotion",
            Self::Keys(Track::Blink) => "blink",
            Self::Keys(Track::Gaze) => "gaze",
            Self::Keys(Track::Head) => "head",
        }
    }

    /// The lane so many further down; the first and the last are ends.
    #[must_use]
    pub(crate) fn moved(self, by: i32) -> Self {
        let at = Self::ALL.iter().position(|l| *l == self).unwrap_or(0) as i32;
        Self::ALL[(at + by).clamp(0, Self::ALL.len() as i32 - 1) as usize]
    }
}

//! The seven emotions in their canonical order, and the seven ratios that mix them.

use std::fmt;
use std::ops::{Index, IndexMut};
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// One of the seven basic expressions (paper sec. 3.2), in the order of Table 1, which is the order everywhere.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Emotion {
    /// The resting face; what the other six are measured from.
    Neutral,
    /// Happiness.
    Happy,
    /// Anger.
    Anger,
    /// Disgust.
    Disgust,
    /// Sadness.
    Sadness,
    /// Fear.
    Fear,
    /// Surprise.
    Surprised,
}

impl Emotion {
    /// All seven in canonical order.
    pub const ALL: [Self; 7] =
        [Self::Neutral, Self::Happy, Self::Anger, Self::Disgust, Self::Sadness, Self::Fear, Self::Surprised];

    /// The word used in files and on screens.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Neutral => "neutral",
            Self::Happy => "happy",
            Self::Anger => "anger",
            Self::Disgust => "disgust",
            Self::Sadness => "sadness",
            Self::Fear => "fear",
            Self::Surprised => "surprised",
        }
    }

    /// One letter that tells it from the other six where there is no room for the word, and no colour to rely on.
    /// Surprise is `U`, because sadness has the S.
    #[must_use]
    pub(crate) const fn letter(self) -> char {
        match self {
            Self::Neutral => 'N',
            Self::Happy => 'H',
            Self::Anger => 'A',
            Self::Disgust => 'D',
            Self::Sadness => 'S',
            Self::Fear => 'F',
            Self::Surprised => 'U',
        }
    }

    /// Its place in the canonical order, 0 to 6.
    #[must_use]
    pub const fn index(self) -> usize {
        self as usize
    }
}

impl fmt::Display for Emotion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Emotion {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Self::ALL.into_iter().find(|e| e.name() == text).ok_or_else(|| format!("`{text}` is no emotion"))
    }
}

/// How much of each emotion a face shows (paper eq. 6): any real numbers, meant to sum to 1. A ratio may be
/// negative, as the paper's decomposition gives them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Ratios(pub [f64; 7]);

impl Ratios {
    /// The neutral face.
    pub const NEUTRAL: Self = Self([1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);

    /// One emotion alone.
    #[must_use]
    pub fn pure(emotion: Emotion) -> Self {
        let mut ratios = [0.0; 7];
        ratios[emotion.index()] = 1.0;
        Self(ratios)
    }

    /// `amount` of an emotion, the rest neutral.
    ///
    /// ```
    /// use lianpu::pose::{Emotion, Ratios};
    /// let half = Ratios::some(Emotion::Happy, 0.5);
    /// assert_eq!(half[Emotion::Neutral], 0.5);
    /// ```
    #[must_use]
    pub fn some(emotion: Emotion, amount: f64) -> Self {
        Self::NEUTRAL.lerp(Self::pure(emotion), amount)
    }

    /// What the seven add up to.
    #[must_use]
    pub fn sum(&self) -> f64 {
        self.0.iter().sum()
    }

    /// The same face with the sum brought to 1 by the neutral ratio, which is what eq. 6 leaves free:
    /// α₁ = 1 − Σ α₂…₇.
    #[must_use]
    pub fn closed(mut self) -> Self {
        self.0[0] = 1.0 - self.0[1..].iter().sum::<f64>();
        self
    }

    /// The way from `self` (t = 0) to `other` (t = 1), each ratio on its own. Sums are kept.
    #[must_use]
    pub fn lerp(self, other: Self, t: f64) -> Self {
        Self(std::array::from_fn(|i| self.0[i] + (other.0[i] - self.0[i]) * t))
    }

    /// The strongest emotion besides neutral, with its ratio.
    #[must_use]
    pub(crate) fn strongest(&self) -> (Emotion, f64) {
        let mut best = (Emotion::Happy, f64::NEG_INFINITY);
        for emotion in &Emotion::ALL[1..] {
            if self[*emotion] > best.1 {
                best = (*emotion, self[*emotion]);
            }
        }
        best
    }
}

impl Default for Ratios {
    fn default() -> Self {
        Self::NEUTRAL
    }
}

impl Index<Emotion> for Ratios {
    type Output = f64;

    fn index(&self, emotion: Emotion) -> &f64 {
        &self.0[emotion.index()]
    }
}

impl IndexMut<Emotion> for Ratios {
    fn index_mut(&mut self, emotion: Emotion) -> &mut f64 {
        &mut self.0[emotion.index()]
    }
}

//! The nine basic mouth shapes (thesis 5.2.3) and what each does to a mouth, in units of the neutral face.

use std::fmt;
use std::str::FromStr;
use std::sync::LazyLock;

use serde::{Deserialize, Serialize};

/// One of the nine basic mouth shapes of the thesis. `h'` of its Table 5.3 is the same open shape as `h`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum MouthShape {
    /// Lips closed: b, p, m.
    M,
    /// Lower lip under the upper teeth: f.
    F,
    /// Slightly open: the other initials before n, the empty rime, ㄜ, ㄦ.
    H,
    /// Wide open: ㄚ.
    A,
    /// Spread: ㄧ.
    I,
    /// Rounded and small: ㄨ, ㄩ.
    U,
    /// Spread and open: ㄝ.
    E,
    /// Rounded and open: ㄛ.
    O,
    /// Open, the tongue behind the teeth; corners stay where the shape before left them: ㄣ, ㄥ, nasal codas.
    N,
}

impl MouthShape {
    /// All nine, in the order of thesis 5.2.3.
    pub const ALL: [Self; 9] = [Self::M, Self::F, Self::H, Self::A, Self::I, Self::U, Self::E, Self::O, Self::N];

    /// The letter used in files and on screens.
    #[must_use]
    pub(crate) const fn letter(self) -> char {
        match self {
            Self::M => 'm',
            Self::F => 'f',
            Self::H => 'h',
            Self::A => 'a',
            Self::I => 'i',
            Self::U => 'u',
            Self::E => 'e',
            Self::O => 'o',
            Self::N => 'n',
        }
    }

    /// The shape of a letter.
    #[must_use]
    pub(crate) fn from_letter(letter: char) -> Option<Self> {
        Self::ALL.into_iter().find(|s| s.letter() == letter)
    }

    /// Whether the lips must meet: *m* and *f*.
    #[must_use]
    pub const fn closes(self) -> bool {
        matches!(self, Self::M | Self::F)
    }
}

impl fmt::Display for MouthShape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.letter())
    }
}

impl FromStr for MouthShape {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let mut letters = text.chars();
        match (letters.next().and_then(Self::from_letter), letters.next()) {
            (Some(shape), None) => Ok(shape),
            _ => Err(format!("`{text}` is none of the mouth shapes m f h a i u e o n")),
        }
    }
}

/// Which definition of the nine shapes is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum MouthPreset {
    /// Thesis 5.2.3 as printed and corrected. Its *h* and *u* cannot be told apart; its 1 and 3 pixels are read
    /// on a face whose nose and mouth are 30 pixels apart.
    Thesis,
    /// The nine told apart on any lips: *u* round, *f* biting.
    #[default]
    Distinct,
}

/// What a mouth does, away from its neutral face. All zero is the mouth at rest, as the emotion alone draws it.
///
/// Vertical moves are in M = max(MNS0, 0.33 MW0), y down; MNS0 is the distance from nose to upper lip and MW0 the
/// width of the neutral mouth (thesis 4.4.1). Left and right move alike. What concerns the thickness of lips is for
/// figures whose lips have one; a line figure's are lines.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct MouthPose {
    /// Move of the peaks of the upper lip, points 8.9 and 8.10, in M; negative is up.
    pub upper: f64,
    /// Move of the bottom of the lower lip, point 8.2, in M.
    pub lower: f64,
    /// Further move of 8.2 in heights of the lower lip (LowerLipH).
    pub lower_lip: f64,
    /// Move of the corners 8.4 and 8.3 toward the middle, in MW0; negative widens.
    pub corner_in: f64,
    /// Move of the corners, in M.
    pub corner_down: f64,
    /// How much thinner than neutral both lips are: 0 neutral, 0.2 a fifth thinner.
    pub thinner: f64,
    /// The same for the lower lip alone, instead of `thinner`.
    pub lower_thinner: f64,
    /// 1 where the lips must meet whatever the emotion does to them, 0 where they need not.
    pub closure: f64,
    /// 1 where the upper teeth stand on the lower lip.
    pub bite: f64,
    /// How far the tongue is raised, 0 to 1.
    pub tongue: f64,
    /// 1 while a syllable is spoken, 0 at rest: how much of the mouth is speech's to open. 2 where the whole mouth was
    /// measured, as a video's is: nothing of the emotion's own opening and width comes on top, but its raised or hanging
    /// corners stay.
    pub speaking: f64,
}

impl MouthPose {
    /// The emotion's own mouth, nothing spoken.
    pub const REST: Self = Self {
        upper: 0.0,
        lower: 0.0,
        lower_lip: 0.0,
        corner_in: 0.0,
        corner_down: 0.0,
        thinner: 0.0,
        lower_thinner: 0.0,
        closure: 0.0,
        bite: 0.0,
        tongue: 0.0,
        speaking: 0.0,
    };

    /// One shape, spoken. *n* comes with its corners at neutral; see `with_corners_of`.
    #[must_use]
    pub fn of(shape: MouthShape, preset: MouthPreset) -> Self {
        PRESETS[preset as usize][shape as usize]
    }

    /// The same mouth with the corners of another: how *n* follows the shape before it.
    #[must_use]
    pub(crate) fn with_corners_of(mut self, other: &Self) -> Self {
        self.corner_in = other.corner_in;
        self.corner_down = other.corner_down;
        self
    }

    /// How far the inner edges of the lips stand apart because of speech, in M; 0 when closed.
    #[must_use]
    pub fn opening(&self) -> f64 {
        ((self.lower - self.upper) * self.parting()).max(0.0)
    }

    /// How much of the lips' own moves parts them: all of it, but for a bite, which lifts the upper lip over a lower
    /// one that it touches.
    #[must_use]
    pub(crate) fn parting(&self) -> f64 {
        1.0 - self.closure * self.bite
    }

    /// The way from `self` (t = 0) to `other` (t = 1).
    #[must_use]
    pub fn lerp(&self, other: &Self, t: f64) -> Self {
        let (a, b) = (self.to_array(), other.to_array());
        Self::from_array(std::array::from_fn(|i| a[i] + (b[i] - a[i]) * t))
    }

    /// The eleven numbers in the order of the fields.
    #[must_use]
    pub(crate) const fn to_array(self) -> [f64; 11] {
        [
            self.upper,
            self.lower,
            self.lower_lip,
            self.corner_in,
            self.corner_down,
            self.thinner,
            self.lower_thinner,
            self.closure,
            self.bite,
            self.tongue,
            self.speaking,
        ]
    }

    /// The inverse of `to_array`.
    #[must_use]
    pub const fn from_array(a: [f64; 11]) -> Self {
        Self {
            upper: a[0],
            lower: a[1],
            lower_lip: a[2],
            corner_in: a[3],
            corner_down: a[4],
            thinner: a[5],
            lower_thinner: a[6],
            closure: a[7],
            bite: a[8],
            tongue: a[9],
            speaking: a[10],
        }
    }
}

/// `mouths.csv`, by preset and shape. The table is part of the program, so a fault in it is ours and the tests'.
static PRESETS: LazyLock<[[MouthPose; 9]; 2]> = LazyLock::new(|| {
    let mut table = [[MouthPose::REST; 9]; 2];
    for line in include_str!("mouths.csv").lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let Some(shape) = cells.get(1).and_then(|c| c.parse::<MouthShape>().ok()) else { continue };
        let number = |i: usize| cells.get(i).and_then(|c| c.parse::<f64>().ok()).unwrap_or(0.0);
        let preset = if cells[0] == "thesis" { MouthPreset::Thesis } else { MouthPreset::Distinct };
        table[preset as usize][shape as usize] = MouthPose {
            upper: number(2),
            lower: number(3),
            lower_lip: number(4),
            corner_in: number(5),
            corner_down: number(6),
            thinner: 1.0 - number(7),
            lower_thinner: 1.0 - number(8),
            closure: number(9),
            bite: number(10),
            tongue: number(11),
            speaking: 1.0,
        };
    }
    table
});

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shape_of_every_preset_is_in_the_table() {
        for preset in [MouthPreset::Thesis, MouthPreset::Distinct] {
            for shape in MouthShape::ALL {
                let pose = MouthPose::of(shape, preset);
                assert_eq!(pose.speaking, 1.0, "{preset:?} {shape}");
                assert_eq!(pose.closure == 1.0, shape.closes(), "{preset:?} {shape}");
            }
        }
    }

    #[test]
    fn the_nine_distinct_shapes_differ_pairwise_and_the_printed_h_and_u_do_not() {
        for (i, a) in MouthShape::ALL.into_iter().enumerate() {
            for b in &MouthShape::ALL[i + 1..] {
                let of = |s| MouthPose::of(s, MouthPreset::Distinct);
                assert_ne!(of(a), of(*b), "{a} and {b}");
            }
        }
        let of = |s| MouthPose::of(s, MouthPreset::Thesis);
        assert_eq!(of(MouthShape::H), of(MouthShape::U));
    }
}

//! The 39 phones of English in ARPAbet, and the mouth shapes of a row of them (`english-shapes.csv`).

use std::fmt;
use std::str::FromStr;
use std::sync::LazyLock;

use serde::{Deserialize, Serialize};

use crate::pose::MouthShape;

/// One phone of English, without stress, printed in ARPAbet: `AA`, `HH`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub struct Phone(u8);

/// A row of the table: the phone and its shapes; none for the consonants of h′.
struct Row {
    name: &'static str,
    shapes: Vec<MouthShape>,
}

/// The table is part of the program: a fault in it is ours and the tests'.
static TABLE: LazyLock<Vec<Row>> = LazyLock::new(|| {
    include_str!("english-shapes.csv")
        .lines()
        .skip(1)
        .filter_map(|line| {
            let (name, rest) = line.split_once(',')?;
            let shapes = rest.split(',').next()?;
            Some(Row { name, shapes: shapes.split(' ').filter_map(|s| s.parse().ok()).collect() })
        })
        .collect()
});

impl Phone {
    /// The phone at a place of the table.
    pub(super) fn at(place: u8) -> Option<Self> {
        (usize::from(place) < TABLE.len()).then_some(Self(place))
    }

    /// Its ARPAbet name.
    #[must_use]
    pub fn name(self) -> &'static str {
        TABLE[usize::from(self.0)].name
    }

    /// Whether it can carry a syllable.
    #[must_use]
    pub fn is_vowel(self) -> bool {
        self.name().starts_with(['A', 'E', 'I', 'O', 'U'])
    }

    /// Its mouth shapes by itself; none for h′, the consonants made behind the lips.
    #[must_use]
    pub fn shapes(self) -> &'static [MouthShape] {
        &TABLE[usize::from(self.0)].shapes
    }
}

impl fmt::Display for Phone {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Phone {
    type Err = String;

    /// A stress digit after the name is allowed and dropped.
    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let name = text.trim_end_matches(['0', '1', '2']);
        (0..=u8::MAX)
            .zip(TABLE.iter())
            .find(|(_, row)| row.name == name)
            .map(|(place, _)| Self(place))
            .ok_or_else(|| format!("`{text}` is no phone of ARPAbet"))
    }
}

impl From<Phone> for String {
    fn from(phone: Phone) -> Self {
        phone.name().to_owned()
    }
}

impl TryFrom<String> for Phone {
    type Error = String;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        text.parse()
    }
}

/// The mouth shapes of a word: h′ drops before a i u e o, and is h elsewhere; a shape that repeats at once is one.
#[must_use]
pub fn shapes_of(phones: &[Phone]) -> Vec<MouthShape> {
    shapes_with_phones(phones).into_iter().map(|(shape, _)| shape).collect()
}

/// The same, each shape with where in the row of phones it starts, in phones: the second shape of a diphthong half a
/// phone later. A dropped h′ leaves its time to the vowel it opens into.
pub(super) fn shapes_with_phones(phones: &[Phone]) -> Vec<(MouthShape, f64)> {
    use MouthShape::{A, E, H, I, O, U};
    let mut out: Vec<(MouthShape, f64)> = Vec::new();
    let mut push = |shape: MouthShape, at: f64| {
        if out.last().is_none_or(|(last, _)| *last != shape) {
            out.push((shape, at));
        }
    };
    let mut open_since: Option<f64> = None;
    for (at, phone) in (0_u32..).map(f64::from).zip(phones) {
        let shapes = phone.shapes();
        let Some(first) = shapes.first() else {
            open_since.get_or_insert(at);
            continue;
        };
        let drops = matches!(first, A | I | U | E | O);
        let mut start = at;
        if let Some(since) = open_since.take() {
            if drops {
                start = since;
            } else {
                push(H, since);
            }
        }
        for (k, shape) in (0_u32..).zip(shapes) {
            push(*shape, if k == 0 { start } else { at + 0.5 * f64::from(k) });
        }
    }
    if let Some(since) = open_since {
        push(H, since);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shapes(phones: &str) -> String {
        let phones: Vec<Phone> = phones.split(' ').map(|p| p.parse().unwrap()).collect();
        shapes_of(&phones).iter().map(ToString::to_string).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn open_consonants_drop_before_vowels_and_stay_elsewhere() {
        assert_eq!(shapes("HH AH0 L OW1"), "h o u");
        assert_eq!(shapes("S T AA P"), "a m");
        assert_eq!(shapes("K AE T"), "a h");
        assert_eq!(shapes("W ER L D"), "u h");
        assert_eq!(shapes("S N OW"), "h n o u");
        assert_eq!(shapes("S M AY L"), "h m a i h");
    }

    #[test]
    fn every_phone_is_in_the_table_and_reads_back() {
        assert_eq!(TABLE.len(), 39);
        for place in 0..39 {
            let phone = Phone::at(place).unwrap();
            assert_eq!(phone.name().parse(), Ok(phone));
        }
        assert!(Phone::at(39).is_none());
    }
}

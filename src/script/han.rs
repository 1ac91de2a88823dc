//! Characters by themselves: the one reading each has where no word says otherwise, every reading it can have, and the
//! simplified form under which words are listed.
//!
//! Readings inside words are `words`' to say.

use std::sync::LazyLock;

use super::reading::Reading;

/// One line a reading: the reading, the characters that have it first, the characters that have it too.
static READINGS: &str = include_str!("readings.txt");
/// Pairs of a traditional character and its simplified form.
static SIMPLIFIED: &str = include_str!("simplified.txt");

/// The blocks of characters that nearly all text is written in: extension A to the end of the main block.
const DENSE: std::ops::Range<u32> = 0x3400..0xA000;

/// The first readings, by character.
struct Firsts {
    readings: Vec<Reading>,
    /// For each character of `DENSE` one more than its place in `readings`, or 0.
    dense: Vec<u16>,
    /// The characters elsewhere, sorted.
    sparse: Vec<(char, u16)>,
}

static FIRSTS: LazyLock<Firsts> = LazyLock::new(|| {
    let mut firsts =
        Firsts { readings: Vec::new(), dense: vec![0; (DENSE.end - DENSE.start) as usize], sparse: Vec::new() };
    for (reading, first, _) in lines() {
        firsts.readings.push(reading);
        let Ok(number) = u16::try_from(firsts.readings.len()) else { break };
        for c in first.chars() {
            if DENSE.contains(&(c as u32)) {
                firsts.dense[(c as u32 - DENSE.start) as usize] = number;
            } else {
                firsts.sparse.push((c, number));
            }
        }
    }
    firsts.sparse.sort_unstable();
    firsts
});

fn lines() -> impl Iterator<Item = (Reading, &'static str, &'static str)> {
    READINGS.lines().filter_map(|line| {
        let mut cells = line.split('\t');
        Some((Reading::from_plain(cells.next()?)?, cells.next()?, cells.next().unwrap_or("")))
    })
}

/// Traditional characters with their simplified ones, sorted by the traditional.
static TO_SIMPLIFIED: LazyLock<Vec<(char, char)>> = LazyLock::new(|| {
    let mut chars = SIMPLIFIED.chars().filter(|c| *c != '\n');
    let mut pairs = Vec::with_capacity(SIMPLIFIED.len() / 6);
    while let (Some(from), Some(to)) = (chars.next(), chars.next()) {
        pairs.push((from, to));
    }
    pairs
});

/// Whether a character is a Chinese one.
#[must_use]
pub fn is_han(c: char) -> bool {
    matches!(c as u32, 0x3005..=0x3007 | 0x3400..=0x4DBF | 0x4E00..=0x9FFF | 0xF900..=0xFAFF | 0x2_0000..=0x3_FFFF)
}

/// The reading that a character has where no word says otherwise; nothing for one that is not in the table.
pub(super) fn first_reading(c: char) -> Option<Reading> {
    let firsts = &*FIRSTS;
    let number = if DENSE.contains(&(c as u32)) {
        firsts.dense[(c as u32 - DENSE.start) as usize]
    } else {
        let at = firsts.sparse.binary_search_by_key(&c, |(c, _)| *c).ok()?;
        firsts.sparse[at].1
    };
    firsts.readings.get(usize::from(number).checked_sub(1)?).copied()
}

/// Every reading a character is known to have, the commonest first: tells whether a label of a TextGrid can belong to it.
#[must_use]
pub fn readings_of(c: char) -> Vec<Reading> {
    let Some(first) = first_reading(c) else { return Vec::new() };
    let others = lines().filter(|(reading, _, too)| *reading != first && too.contains(c)).map(|(reading, ..)| reading);
    std::iter::once(first).chain(others).collect()
}

/// The simplified form of a character; itself where it has none.
pub(super) fn simplified(c: char) -> char {
    let pairs = &*TO_SIMPLIFIED;
    pairs.binary_search_by_key(&c, |(from, _)| *from).map_or(c, |at| pairs[at].1)
}

/// The simplified forms that differ from their traditional ones, sorted.
static SIMPLER: LazyLock<Vec<char>> = LazyLock::new(|| {
    let mut simpler: Vec<char> = TO_SIMPLIFIED.iter().map(|(_, to)| *to).collect();
    simpler.sort_unstable();
    simpler
});

/// Whether a character shows that a text is in traditional characters. 著 and 乾 do not: simplified text has them too.
pub(super) fn is_traditional(c: char) -> bool {
    !matches!(c, '著' | '乾') && simplified(c) != c
}

/// Whether a character shows that a text is in simplified characters.
pub(super) fn is_simplified(c: char) -> bool {
    simplified(c) == c && SIMPLER.binary_search(&c).is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn common_characters_have_their_readings() {
        let all = |c| readings_of(c).iter().map(Reading::pinyin).collect::<Vec<_>>();
        assert_eq!(first_reading('您').unwrap().pinyin(), "nin2");
        assert!(all('行').contains(&"hang2".to_owned()) && all('行')[0] == "xing2");
        assert!(all('長').contains(&"zhang3".to_owned()));
        assert_eq!(all('〇')[0], "ling2");
        assert!(all('x').is_empty());
    }

    #[test]
    fn traditional_characters_know_their_simplified_ones() {
        assert_eq!((simplified('長'), simplified('龍'), simplified('人')), ('长', '龙', '人'));
        assert!(TO_SIMPLIFIED.is_sorted_by_key(|(from, _)| *from));
    }

    #[test]
    fn more_than_twenty_thousand_characters_have_a_reading() {
        let known = ('\u{3400}'..'\u{A000}').filter(|c| first_reading(*c).is_some()).count();
        assert!(known > 20_000, "{known}");
    }
}

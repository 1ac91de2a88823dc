//! Characters in words: which of its readings a character has beside these neighbours.
//!
//! `words.txt` holds, for each character and reading, the words and patterns in which it has that reading; the longest
//! one that fits around a character decides. A pattern is a word in which
//!
//! | sign | stands for |
//! | --- | --- |
//! | `#` | a number in characters (一 二 … 十 百 千 万 几 两 半 多 数) |
//! | `^` `$` | the start and the end of a phrase |
//! | `~` | any Chinese character |
//! | `=` | the character before once more: 慢慢 |
//! | `*` | nothing: it marks the character that is meant where a word has it twice |
//! | `?` | at the start: any other word that fits beats this one |
//!
//! Signs count less than characters, so that a word beats a pattern of the same length.

use std::sync::LazyLock;

use super::han;
use super::reading::Reading;

static WORDS: &str = include_str!("words.txt");

/// The words of one character in one reading.
struct Line {
    c: char,
    reading: Reading,
    words: &'static str,
}

/// The lines in the order of the file, which is the order of their characters.
static LINES: LazyLock<Vec<Line>> = LazyLock::new(|| {
    WORDS
        .lines()
        .filter_map(|line| {
            let mut cells = line.split('\t');
            let c = cells.next()?.chars().next()?;
            Some(Line { c, reading: Reading::from_plain(cells.next()?)?, words: cells.next()? })
        })
        .collect()
});

/// The characters of a phrase made ready for looking up.
pub(super) struct Phrase {
    chars: Vec<char>,
    /// Their simplified forms: words are listed once, and fit either script.
    simplified: Vec<char>,
    /// Whether the script is in traditional characters, where 著 is also what 着 is in simplified ones.
    traditional: bool,
}

/// Weight of a character that fits, and of a sign.
const CHARACTER: u32 = 4;
const SIGN: u32 = 1;
/// Weight of a word that any other beats.
const WEAK: u32 = 2;

impl Phrase {
    pub(super) fn new(chars: Vec<char>, traditional: bool) -> Self {
        let simplified = chars.iter().map(|c| han::simplified(*c)).collect();
        Self { chars, simplified, traditional }
    }

    /// The reading of the character at a place: what the heaviest word around it says, else the character's first.
    /// Nothing for a character that is in no table.
    pub(super) fn reading(&self, at: usize) -> Option<Reading> {
        let c = *self.chars.get(at)?;
        if c == '々' {
            return self.reading(at.checked_sub(1)?);
        }
        if let Some(reading) = self.best(c, at) {
            return Some(reading);
        }
        if c == '著' && self.traditional {
            return self.best('着', at).or_else(|| han::first_reading('着'));
        }
        if c == '乾' && !self.traditional {
            // Simplified writing keeps this character for the name of heaven alone.
            return Reading::from_plain("qian2");
        }
        let simple = *self.simplified.get(at)?;
        // 髮 is listed under 发, but only a reading that 髮 itself has can be meant.
        let listed = if c == simple { None } else { self.best(simple, at) };
        listed
            .filter(|r| han::readings_of(c).iter().any(|k| k == r || (r.tone() == Some(5) && k.sound() == r.sound())))
            .or_else(|| han::first_reading(c))
            .or_else(|| han::first_reading(simple))
    }

    /// The reading of the heaviest word listed under `c` that fits around a place.
    fn best(&self, c: char, at: usize) -> Option<Reading> {
        let start = LINES.partition_point(|l| l.c < c);
        let mut best: Option<(Reading, u32)> = None;
        for line in LINES[start..].iter().take_while(|l| l.c == c) {
            for word in line.words.split(' ') {
                if let Some(weight) = fits(word, c, &self.simplified, at)
                    && best.is_none_or(|(_, b)| weight > b)
                {
                    best = Some((line.reading, weight));
                }
            }
        }
        best.map(|(reading, _)| reading)
    }
}

/// The weight of a word around a place, where it fits with its `c` there.
fn fits(word: &str, c: char, chars: &[char], at: usize) -> Option<u32> {
    let marked = word.contains('*');
    let mut previous = ' ';
    let mut offset = 0;
    let mut best = None;
    for sign in word.chars() {
        let here = sign == c && (!marked || previous == '*');
        if here && let Some(weight) = at.checked_sub(offset).and_then(|start| weigh(word, chars, start, at)) {
            best = best.max(Some(weight));
        }
        previous = sign;
        // The start of a phrase and the mark take no place.
        if !matches!(sign, '*' | '^' | '?') {
            offset += 1;
        }
    }
    best
}

/// The weight of a word from a place on, where it fits. `at` is the character that is asked for: it fits as it is.
fn weigh(word: &str, chars: &[char], start: usize, at: usize) -> Option<u32> {
    let (mut i, mut weight) = (start, 0);
    for sign in word.chars() {
        let here = chars.get(i).copied();
        let fits = match sign {
            '*' | '?' => continue,
            '^' => {
                if i > 0 && han::is_han(chars[i - 1]) {
                    return None;
                }
                weight += SIGN;
                continue;
            }
            '$' => here.is_none_or(|c| !han::is_han(c)),
            '~' => here.is_some_and(han::is_han),
            '=' => i > 0 && here == Some(chars[i - 1]),
            '#' => here.is_some_and(is_number),
            _ => i == at || here == Some(sign),
        };
        if !fits {
            return None;
        }
        weight += if matches!(sign, '$' | '~' | '#' | '=') { SIGN } else { CHARACTER };
        i += 1;
    }
    Some(if word.starts_with('?') { WEAK } else { weight })
}

fn is_number(c: char) -> bool {
    "〇零一二三四五六七八九十百千万亿几两半多数".contains(c)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> String {
        let phrase = Phrase::new(text.chars().collect(), true);
        let readings = (0..text.chars().count()).map(|i| phrase.reading(i).map_or("?".into(), |r| r.pinyin()));
        readings.collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn a_word_decides_and_the_longest_one_wins() {
        assert_eq!(read("银行行长"), "yin2 hang2 hang2 zhang3");
        assert_eq!(read("行动"), "xing2 dong4");
        assert_eq!(read("音乐快乐"), "yin1 yue4 kuai4 le4");
        assert_eq!(read("重新重要"), "chong2 xin1 zhong4 yao4");
    }

    #[test]
    fn traditional_characters_read_as_their_words_do() {
        assert_eq!(read("銀行行長"), "yin2 hang2 hang2 zhang3");
        assert_eq!(read("音樂頭髮發展"), "yin1 yue4 tou2 fa5 fa1 zhan3");
    }

    #[test]
    fn the_file_is_sorted_by_character() {
        assert!(LINES.is_sorted_by_key(|l| l.c));
    }
}

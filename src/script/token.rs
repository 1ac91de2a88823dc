//! A token of a script and its candidates: everything that each writing system can read it as.
//!
//! `scan` makes the tokens, `detect` chooses among the candidates, and `say` makes syllables of the chosen ones. What a
//! token can be is worked out here and nowhere again. What needs its neighbours or a dictionary is left open: the
//! reading of a character in its phrase, the phones of an English word.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::label::Label;
use super::letters::fold_width;
use super::number::{Number, mandarin};
use super::reading::Written;
use super::romanised::Romanised;

/// What follows a syllable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Pause {
    /// The next syllable.
    #[default]
    None,
    /// A comma or what is like it; the end of a line.
    Comma,
    /// The end of a sentence.
    Sentence,
}

/// A token of a script.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Token<'a> {
    /// The token as written.
    pub(super) text: &'a str,
    /// Its bytes in the script.
    pub(super) span: Range<usize>,
    /// Its kind, with its candidates.
    pub(super) kind: Kind<'a>,
}

/// The kind of a token, with its candidates.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Kind<'a> {
    /// One Chinese character.
    Han(char),
    /// Symbols and tone marks of Zhuyin, run together, and their syllables; nothing where they make none.
    Zhuyin(Option<Vec<Written>>),
    /// Latin letters, with digits, apostrophes and hyphens inside or digits after.
    Word(Word<'a>),
    /// Digits with what may stand between them, a sign of money before or a sign after.
    Number(Number),
    /// Readings in braces; text and span are what is inside them.
    Forced {
        /// The readings, parted by white space.
        labels: Vec<Label<'a>>,
        /// Whether a Chinese character stands directly before the braces.
        after_han: bool,
    },
    /// Whatever ends a phrase.
    Break(Pause),
}

/// The candidates of a word in Latin letters.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Word<'a> {
    /// Its syllables in Hanyu and Tongyong Pinyin.
    pub(super) pinyin: Romanised,
    /// Its parts in English.
    pub(super) english: Vec<Part<'a>>,
    /// The characters of the unit of measure that it is after a number in a Chinese script.
    pub(super) unit: Option<&'static str>,
}

/// A part of an English word: what stands between its hyphens and beside its digits.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Part<'a> {
    /// The part as written.
    pub(super) text: &'a str,
    /// Its bytes in the script.
    pub(super) span: Range<usize>,
    /// Letters or digits.
    pub(super) kind: PartKind<'a>,
}

/// The kind of a part, with its candidates.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum PartKind<'a> {
    /// Letters, and the digits before them where the letters make an ordinal of them: `22` of `22nd`.
    Letters {
        /// The digits.
        ordinal: Option<&'a str>,
    },
    /// Digits, with points between them.
    Digits(Number),
}

impl Token<'_> {
    /// The line of the script on which it starts, counted from 1.
    pub(super) fn line_in(&self, script: &str) -> usize {
        1 + script.bytes().take(self.span.start).filter(|b| *b == b'\n').count()
    }
}

impl<'a> Word<'a> {
    /// The candidates of the word at `span` of a script; `after_number` is whether a number ends where it starts.
    pub(super) fn of(script: &'a str, span: Range<usize>, after_number: bool) -> Self {
        let text = &script[span.clone()];
        Self {
            pinyin: Romanised::of(text),
            english: parts(script, span),
            unit: if after_number { mandarin::unit(text) } else { None },
        }
    }
}

/// The parts of an English word at `span` of a script.
fn parts(script: &str, span: Range<usize>) -> Vec<Part<'_>> {
    let mut parts = Vec::new();
    let mut at = span.start;
    while at < span.end {
        let rest = &script[at..span.end];
        let is_digits = rest.starts_with(|c| fold_width(c).is_ascii_digit());
        let ends =
            |c| (fold_width(c).is_ascii_digit() || c == '.') != is_digits || matches!(c, '-' | '‐' | '‑' | '·' | ':');
        let length = rest.find(ends).unwrap_or(rest.len());
        if length == 0 {
            at += rest.chars().next().map_or(1, char::len_utf8);
            continue;
        }
        let (text, end) = (&rest[..length], at + length);
        let kind = if is_digits {
            PartKind::Digits(Number::of(text, script[end..].chars().next()))
        } else {
            PartKind::Letters { ordinal: ordinal(text, &script[..at]) }
        };
        parts.push(Part { text, span: at..end, kind });
        at = end;
    }
    parts
}

/// The digits that end the script before the letters of an ordinal.
fn ordinal<'a>(letters: &str, before: &'a str) -> Option<&'a str> {
    let digits = &before[before.trim_end_matches(|c: char| c.is_ascii_digit()).len()..];
    (matches!(letters, "st" | "nd" | "rd" | "th") && !digits.is_empty()).then_some(digits)
}

#[cfg(test)]
mod tests {
    use super::super::system::System;
    use super::*;

    fn word(text: &str) -> Word<'_> {
        Word::of(text, 0..text.len(), false)
    }

    #[test]
    fn a_word_carries_every_system_that_can_read_it() {
        let can = |text| {
            let word = word(text);
            let [hanyu, tongyong] = [System::Hanyu, System::Tongyong].map(|s| word.pinyin.in_system(s).is_some());
            (hanyu, tongyong, word.english.len())
        };
        assert_eq!(can("long"), (true, true, 1));
        assert_eq!(can("zhi"), (true, false, 1));
        assert_eq!(can("jhih"), (false, true, 1));
        assert_eq!(can("hello"), (false, false, 1));
        assert_eq!(can("ni3hao3"), (true, true, 4));
    }

    #[test]
    fn english_parts_end_at_hyphens_and_digits() {
        let parts = |text| word(text).english.iter().map(|p| p.text).collect::<Vec<_>>().join("|");
        assert_eq!(parts("e-mail"), "e|mail");
        assert_eq!(parts("iPhone15"), "iPhone|15");
        assert_eq!(parts("v2.0beta"), "v|2.0|beta");
        assert_eq!(parts("don't"), "don't");
    }

    #[test]
    fn letters_of_an_ordinal_know_its_digits() {
        let last = |script, start| {
            let word = Word::of(script, start..script.len(), true);
            match word.english.last().map(|p| &p.kind) {
                Some(PartKind::Letters { ordinal }) => ordinal.map(str::to_owned),
                _ => None,
            }
        };
        assert_eq!(last("22nd", 2), Some("22".into()));
        assert_eq!(last("1,222nd", 5), Some("222".into()));
        assert_eq!(last("x3rd", 0), Some("3".into()));
        assert_eq!((last("22km", 2), last("nd", 0)), (None, None));
    }

    #[test]
    fn a_unit_is_one_only_after_a_number() {
        assert_eq!(Word::of("5km", 1..3, true).unit, Some("公里"));
        assert_eq!(Word::of("5 km", 2..4, false).unit, None);
    }
}

//! A script cut into pieces: characters, Zhuyin, words in Latin letters, numbers, readings in braces, pauses.
//!
//! What a piece says is decided elsewhere; here only where it starts and ends.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::romanised::{self, fold_width, is_joint};
use super::system::System;
use super::{han, tone, zhuyin};

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

/// What a piece of a script is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// One Chinese character.
    Han(char),
    /// Symbols and tone marks of Zhuyin, run together.
    Zhuyin,
    /// Latin letters, with digits, apostrophes and hyphens inside or digits after.
    Word,
    /// Digits with what may stand between them, a sign of money before or a sign after.
    Number,
    /// A reading in braces; the span is what is inside them.
    Forced,
    /// Whatever ends a phrase.
    Break(Pause),
}

/// A piece of a script and its bytes in it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Token {
    pub(super) kind: Kind,
    pub(super) span: Range<usize>,
}

/// Cuts a script into its pieces, in order and without overlap.
pub(super) fn scan(text: &str) -> Vec<Token> {
    let mut scan = Scan { text, chars: text.char_indices().collect(), at: 0 };
    let mut tokens = Vec::new();
    while let Some(token) = scan.next() {
        tokens.push(token);
    }
    tokens
}

struct Scan<'a> {
    text: &'a str,
    chars: Vec<(usize, char)>,
    at: usize,
}

impl Scan<'_> {
    fn peek(&self, ahead: usize) -> Option<char> {
        self.chars.get(self.at + ahead).map(|(_, c)| fold_width(*c))
    }

    /// The byte where the character at a place begins.
    fn byte(&self, place: usize) -> usize {
        self.chars.get(place).map_or(self.text.len(), |(at, _)| *at)
    }

    fn take(&mut self, kind: Kind, count: usize) -> Token {
        let start = self.at;
        self.at += count;
        Token { kind, span: self.byte(start)..self.byte(self.at) }
    }

    fn next(&mut self) -> Option<Token> {
        let c = self.peek(0)?;
        if c == '{'
            && let Some(close) = self.braces()
        {
            let span = self.byte(self.at + 1)..self.byte(self.at + close);
            self.at += close + 1;
            return Some(Token { kind: Kind::Forced, span });
        }
        if han::is_han(c) || c == '々' {
            return Some(self.take(Kind::Han(c), 1));
        }
        if zhuyin::is_zhuyin(c) {
            let count = self.count(|_, c| zhuyin::is_zhuyin(c));
            return Some(self.take(Kind::Zhuyin, count));
        }
        let before = self.at.checked_sub(1).and_then(|at| self.chars.get(at)).map(|(_, c)| *c);
        let negative = is_minus(c) && before.is_none_or(|b| !b.is_ascii_alphanumeric() && !is_minus(b));
        if negative && self.peek(1).is_some_and(|c| c.is_ascii_digit()) {
            self.at += 1;
            let count = self.number();
            self.at -= 1;
            return Some(self.take(Kind::Number, count + 1));
        }
        if c.is_ascii_digit() || (is_money(c) && self.peek(1).is_some_and(|c| c.is_ascii_digit())) {
            let count = self.number();
            return Some(self.take(Kind::Number, count));
        }
        if is_latin(c) {
            let count = self.word();
            return Some(self.take(Kind::Word, count));
        }
        let pause = self.pause(c);
        Some(self.take(Kind::Break(pause), 1))
    }

    fn count(&self, fits: impl Fn(usize, char) -> bool) -> usize {
        let mut n = 0;
        while self.peek(n).is_some_and(|c| fits(n, c)) {
            n += 1;
        }
        n
    }

    /// Where the brace is closed that opens here, if it holds a reading. Braces around other text are punctuation.
    fn braces(&self) -> Option<usize> {
        let close = (1..80).find(|n| matches!(self.peek(*n), Some('{' | '}' | '\n') | None))?;
        if self.peek(close) != Some('}') {
            return None;
        }
        let inside = &self.text[self.byte(self.at + 1)..self.byte(self.at + close)];
        let after_han = self.at.checked_sub(1).is_some_and(|at| han::is_han(self.chars[at].1));
        let letters = inside.chars().all(|c| !han::is_han(c)) && inside.contains(char::is_alphabetic);
        ((after_han && letters) || inside.split_whitespace().any(is_reading)).then_some(close)
    }

    /// A word: letters, marks and digits, joints between letters, and the colon of u:.
    fn word(&self) -> usize {
        self.count(|n, c| {
            let (before, after) = (n.checked_sub(1).and_then(|n| self.peek(n)), self.peek(n + 1));
            if is_joint(c) {
                // `10-20` and `A - B` are no words; `fang'an` and `ni3-hao3` are.
                before.is_some_and(|b| is_latin(b) || b.is_ascii_digit()) && after.is_some_and(is_latin)
            } else if c == '.' {
                // `v2.0`, but not the end of a sentence.
                [before, after].iter().all(|c| c.is_some_and(|c| c.is_ascii_digit()))
            } else if c == ':' {
                let l_or_n = n.checked_sub(2).and_then(|n| self.peek(n));
                matches!(before, Some('u' | 'U'))
                    && matches!(l_or_n, Some('l' | 'n' | 'L' | 'N'))
                    && matches!(after, Some('0'..='5' | 'e' | 'a'))
            } else {
                is_latin(c) || c.is_ascii_digit()
            }
        })
    }

    /// A number: a sign of money, digits with separators between digits, a sign after.
    fn number(&self) -> usize {
        let start = usize::from(self.peek(0).is_some_and(is_money));
        let mut n = start;
        while let Some(c) = self.peek(n) {
            let between = n > start
                && matches!(c, '.' | ',' | ':' | '/' | '-' | '~' | '–' | '～')
                && self.peek(n + 1).is_some_and(|c| c.is_ascii_digit())
                // A list is no number: 1,2,3 has pauses, 1,234 none.
                && (c != ',' || self.groups(start, n));
            if !c.is_ascii_digit() && !between {
                break;
            }
            n += 1;
        }
        match self.peek(n) {
            Some('%' | '‰' | '℃' | '℉') => n + 1,
            Some('°') if matches!(self.peek(n + 1), Some('C' | 'F')) => n + 2,
            Some('°') => n + 1,
            _ => n,
        }
    }

    /// Whether a comma after these digits parts thousands: three digits follow, at most three or groups stand before.
    fn groups(&self, start: usize, comma: usize) -> bool {
        let digit = |n| self.peek(n).is_some_and(|c: char| c.is_ascii_digit());
        let since = (start..comma).rev().take_while(|n| digit(*n)).count();
        let first = since == comma - start;
        (1..=3).all(|k| digit(comma + k)) && !digit(comma + 4) && (if first { since <= 3 } else { since == 3 })
    }

    fn pause(&self, c: char) -> Pause {
        match c {
            '。' | '！' | '？' | '!' | '?' | '．' => Pause::Sentence,
            // `U.S.A.` and `example.com` are no sentences.
            '.' if self.peek(1).is_some_and(|c| c.is_alphanumeric()) => Pause::None,
            '.' => Pause::Sentence,
            '\n' if self.peek(1) == Some('\n') => Pause::Sentence,
            '\n' | '，' | '、' | '；' | '：' | ',' | ';' | ':' | '—' | '–' | '…' | '(' | ')' => Pause::Comma,
            _ => Pause::None,
        }
    }
}

/// Whether braces around this hold a reading wherever they stand.
fn is_reading(label: &str) -> bool {
    zhuyin::run(label).is_some() || romanised::word(label, System::Hanyu).is_some_and(|_| romanised::shows_tones(label))
}

/// A sign of money that stands before its number.
pub(super) fn is_money(c: char) -> bool {
    matches!(c, '¥' | '￥' | '$' | '€' | '£')
}

/// A sign that makes the number after it negative.
pub(super) fn is_minus(c: char) -> bool {
    matches!(c, '-' | '−')
}

/// A letter of the Latin alphabet, with or without marks, or a mark on one.
fn is_latin(c: char) -> bool {
    c.is_ascii_alphabetic()
        || tone::is_accented(c)
        || matches!(c, 'ɡ' | 'ɑ' | '\u{C0}'..='\u{24F}' | '\u{1E00}'..='\u{1EFF}' if !matches!(c, '×' | '÷'))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cut(text: &str) -> Vec<&str> {
        scan(text).into_iter().filter(|t| !matches!(t.kind, Kind::Break(_))).map(|t| text[t.span].into()).collect()
    }

    #[test]
    fn pieces_end_where_a_reader_would_end_them() {
        assert_eq!(cut("他说hello，3.14。"), ["他", "说", "hello", "3.14"]);
        assert_eq!(cut("行{hang2}长"), ["行", "hang2", "长"]);
        assert_eq!(cut("lu:4 nin2hao3 fang'an"), ["lu:4", "nin2hao3", "fang'an"]);
        assert_eq!(cut("1,234 1,2,3"), ["1,234", "1", "2", "3"]);
        assert_eq!(cut("¥12.5 50% 3:30 25°C"), ["¥12.5", "50%", "3:30", "25°C"]);
        assert_eq!(cut("ㄋㄧˇㄏㄠˇ x"), ["ㄋㄧˇㄏㄠˇ", "x"]);
        assert_eq!(cut("５０％"), ["５０％"]);
    }

    #[test]
    fn pauses_are_told_from_points_inside_words() {
        let pauses = |text| scan(text).iter().filter(|t| t.kind == Kind::Break(Pause::Sentence)).count();
        assert_eq!((pauses("U.S. is. "), pauses("好。坏！"), pauses("a.b")), (2, 2, 0));
    }
}

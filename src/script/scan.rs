//! Cuts a script into tokens: characters, Zhuyin, words in Latin letters, numbers, readings in braces, pauses.
//!
//! Here is only where a token starts and ends; what it can be read as is `token`'s to say.

use super::label::Label;
use super::letters::{fold_width, is_joint};
use super::number::{Number, is_minus, is_money};
use super::token::{Kind, Pause, Token, Word};
use super::{han, tone, zhuyin};

/// The tokens of a script, in order and without overlap.
pub(super) fn scan(text: &str) -> Vec<Token<'_>> {
    let mut scan = Scan { text, chars: text.char_indices().collect(), at: 0 };
    let mut tokens = Vec::new();
    while let Some(token) = scan.next(tokens.last()) {
        tokens.push(token);
    }
    tokens
}

struct Scan<'a> {
    text: &'a str,
    chars: Vec<(usize, char)>,
    at: usize,
}

impl<'a> Scan<'a> {
    fn peek(&self, ahead: usize) -> Option<char> {
        self.chars.get(self.at + ahead).map(|(_, c)| fold_width(*c))
    }

    /// The byte where the character at a place begins.
    fn byte(&self, place: usize) -> usize {
        self.chars.get(place).map_or(self.text.len(), |(at, _)| *at)
    }

    /// The token of the next `count` characters; `kind` makes its candidates.
    fn take(&mut self, count: usize, kind: impl FnOnce(&'a str) -> Kind<'a>) -> Token<'a> {
        let span = self.byte(self.at)..self.byte(self.at + count);
        self.at += count;
        let text = &self.text[span.clone()];
        Token { text, span, kind: kind(text) }
    }

    /// The next token, after the token `before`.
    fn next(&mut self, before: Option<&Token>) -> Option<Token<'a>> {
        let c = self.peek(0)?;
        if c == '{'
            && let Some(token) = self.forced(before)
        {
            return Some(token);
        }
        if han::is_han(c) || c == '々' {
            return Some(self.take(1, |_| Kind::Han(c)));
        }
        if zhuyin::is_zhuyin(c) {
            let count = self.count(|_, c| zhuyin::is_zhuyin(c));
            return Some(self.take(count, |text| Kind::Zhuyin(zhuyin::run(text))));
        }
        if let Some(count) = self.number() {
            let next = self.chars.get(self.at + count).map(|(_, c)| *c);
            return Some(self.take(count, |text| Kind::Number(Number::of(text, next))));
        }
        if is_latin(c) {
            let (script, start) = (self.text, self.byte(self.at));
            let after_number = before.is_some_and(|b| matches!(b.kind, Kind::Number(_)));
            let count = self.word();
            return Some(
                self.take(count, |text| Kind::Word(Word::of(script, start..start + text.len(), after_number))),
            );
        }
        let pause = self.pause(c);
        Some(self.take(1, |_| Kind::Break(pause)))
    }

    fn count(&self, fits: impl Fn(usize, char) -> bool) -> usize {
        let mut n = 0;
        while self.peek(n).is_some_and(|c| fits(n, c)) {
            n += 1;
        }
        n
    }

    /// The readings in the braces that open here. Braces around other text are punctuation.
    fn forced(&mut self, before: Option<&Token>) -> Option<Token<'a>> {
        let close = (1..80).find(|n| matches!(self.peek(*n), Some('{' | '}' | '\n') | None))?;
        if self.peek(close) != Some('}') {
            return None;
        }
        let span = self.byte(self.at + 1)..self.byte(self.at + close);
        let text = &self.text[span.clone()];
        let labels: Vec<Label> = text.split_whitespace().map(Label::of).collect();
        let after_han = before.is_some_and(|b| matches!(b.kind, Kind::Han(_)));
        let letters = text.chars().all(|c| !han::is_han(c)) && text.contains(char::is_alphabetic);
        ((after_han && letters) || labels.iter().any(Label::is_reading)).then(|| {
            self.at += close + 1;
            Token { text, span, kind: Kind::Forced { labels, after_han } }
        })
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

    /// The characters of the number that starts here, with its minus.
    fn number(&self) -> Option<usize> {
        let digit = |n| self.peek(n).is_some_and(|c| c.is_ascii_digit());
        let before = self.at.checked_sub(1).and_then(|at| self.chars.get(at)).map(|(_, c)| *c);
        let first = self.peek(0)?;
        if is_minus(first) && before.is_none_or(|b| !b.is_ascii_alphanumeric() && !is_minus(b)) && digit(1) {
            return Some(self.digits(1));
        }
        (digit(0) || (is_money(first) && digit(1))).then(|| self.digits(0))
    }

    /// Where a number ends whose currency sign or digits start at `from`: digits with separators between digits, a unit
    /// sign after.
    fn digits(&self, from: usize) -> usize {
        let start = from + usize::from(self.peek(from).is_some_and(is_money));
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
        scan(text).into_iter().filter(|t| !matches!(t.kind, Kind::Break(_))).map(|t| t.text).collect()
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
    fn braces_hold_readings_and_know_what_stands_before_them() {
        let forced = |text| {
            scan(text).into_iter().find_map(|t| match t.kind {
                Kind::Forced { labels, after_han } => Some((labels.len(), after_han)),
                _ => None,
            })
        };
        assert_eq!(forced("银行{yin2 hang2}"), Some((2, true)));
        assert_eq!(forced("a {ㄏㄤˊ}"), Some((1, false)));
        assert_eq!((forced("a {b}"), forced("行{1}"), forced("{hang2")), (None, None, None));
    }

    #[test]
    fn letters_are_a_unit_directly_after_a_number() {
        let unit = |text| scan(text).into_iter().find_map(|t| if let Kind::Word(w) = t.kind { w.unit } else { None });
        assert_eq!((unit("5km"), unit("-5kg"), unit("5 km"), unit("km")), (Some("公里"), Some("公斤"), None, None));
    }

    #[test]
    fn pauses_are_told_from_points_inside_words() {
        let pauses = |text| scan(text).iter().filter(|t| t.kind == Kind::Break(Pause::Sentence)).count();
        assert_eq!((pauses("U.S. is. "), pauses("好。坏！"), pauses("a.b")), (2, 2, 0));
    }
}

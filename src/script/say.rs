//! From the pieces of a script to its syllables: characters by their words, Latin letters by what the script is in,
//! numbers in the language around them, readings in braces before all.

use std::ops::Range;

use super::detect::{self, Found, line_of};
use super::label;
use super::reading::Reading;
use super::romanised;
use super::syllable::Syllable;
use super::system::System;
use super::tokens::{self, Kind, Token};
use super::words::Phrase;
use super::{english, han, numbers, numerals, zhuyin};
use crate::disk::{Fault, Result, Setting, message};

/// The syllables of a script, in order, with their mouth shapes (thesis 5.2).
///
/// ```
/// use lianpu::script::{System, syllables};
/// let said = syllables("您好", System::Auto).unwrap();
/// assert_eq!((said[0].pinyin.as_str(), said[1].zhuyin.as_str()), ("nin2", "ㄏㄠˇ"));
/// ```
///
/// # Errors
/// When the romanisation is not told by the text or by `system`, or something in it cannot be read; with the line.
pub fn syllables(text: &str, system: System) -> Result<Vec<Syllable>> {
    let tokens = tokens::scan(text);
    let found = detect::find(text, &tokens, system)?;
    let han = || tokens.iter().filter_map(|t| if let Kind::Han(c) = t.kind { Some(c) } else { None });
    let traditional =
        han().filter(|c| han::is_traditional(*c)).count() > han().filter(|c| han::is_simplified(*c)).count();
    let mut say = Say { text, system, found, traditional, out: Vec::new(), phrase: Vec::new() };
    for (i, token) in tokens.iter().enumerate() {
        say.token(token, i.checked_sub(1).and_then(|i| tokens.get(i)))?;
    }
    say.end_phrase();
    Ok(say.out)
}

/// A character on its way to a syllable.
struct Waiting {
    c: char,
    span: Range<usize>,
    forced: Option<Reading>,
}

struct Say<'a> {
    text: &'a str,
    system: System,
    found: Found,
    traditional: bool,
    out: Vec<Syllable>,
    /// The characters since the last thing that was none: the neighbours that decide a reading.
    phrase: Vec<Waiting>,
}

impl Say<'_> {
    fn token(&mut self, token: &Token, before: Option<&Token>) -> Result<()> {
        let written = &self.text[token.span.clone()];
        match token.kind {
            Kind::Han(c) => self.phrase.push(Waiting { c, span: token.span.clone(), forced: None }),
            Kind::Number if !self.found.english_numbers => self.number(written, token.span.clone()),
            Kind::Forced => self.force(written, token, before)?,
            Kind::Number => {
                self.end_phrase();
                self.english_words(&numerals::read(written), &token.span);
            }
            Kind::Word => {
                if let Some(unit) = self.unit(written, before, token.span.start) {
                    self.phrase.extend(unit.chars().map(|c| Waiting { c, span: token.span.clone(), forced: None }));
                } else {
                    self.end_phrase();
                    self.word(written, token)?;
                }
            }
            Kind::Zhuyin => {
                self.end_phrase();
                let run = zhuyin::run(written).ok_or_else(|| {
                    self.fault(format!("`{written}` is not Zhuyin"), token.span.start)
                        .help("write each syllable with its symbols in order and its tone mark after them: ㄋㄧㄣˊ")
                })?;
                for (reading, span) in run {
                    let span = token.span.start + span.start..token.span.start + span.end;
                    self.out.push(Syllable::mandarin(&self.text[span.clone()], &reading, span));
                }
            }
            Kind::Break(pause) => {
                self.end_phrase();
                if let Some(last) = self.out.last_mut() {
                    last.pause_after = last.pause_after.max(pause);
                }
            }
        }
        Ok(())
    }

    fn fault(&self, what: String, at: usize) -> Fault {
        Fault::new(what).line(line_of(self.text, at))
    }

    fn number(&mut self, written: &str, span: Range<usize>) {
        let before = self.phrase.last().map(|w| w.c);
        let said = numbers::read(written, before, &self.text[span.end..]);
        self.phrase.extend(said.chars().map(|c| Waiting { c, span: span.clone(), forced: None }));
    }

    /// The unit that letters directly after a number are, in a Chinese script.
    fn unit(&self, written: &str, before: Option<&Token>, at: usize) -> Option<&'static str> {
        let after_number = before.is_some_and(|b| b.kind == Kind::Number && b.span.end == at);
        (after_number && !self.found.english_numbers).then(|| numbers::unit(written))?
    }

    fn end_phrase(&mut self) {
        let waiting = std::mem::take(&mut self.phrase);
        let phrase = Phrase::new(waiting.iter().map(|w| w.c).collect(), self.traditional);
        for (at, w) in waiting.into_iter().enumerate() {
            self.out.push(match w.forced.or_else(|| phrase.reading(at)) {
                Some(reading) => Syllable::mandarin(w.c, &reading, w.span),
                None => Syllable::unknown(w.c, w.span),
            });
        }
    }

    /// Readings in braces: as many syllables as are in them, for the characters before them.
    fn force(&mut self, written: &str, token: &Token, before: Option<&Token>) -> Result<()> {
        let help = "write the reading of the character before the braces: 行{hang2}, 行{háng} or 行{ㄏㄤˊ}";
        let at = token.span.start;
        if !before.is_some_and(|b| matches!(b.kind, Kind::Han(_)) && b.span.end + 1 == at) {
            return Err(self.fault(format!("`{{{written}}}` stands after no character"), at).help(help));
        }
        let readings = self.forced_readings(written, at)?;
        let start = self.phrase.len().checked_sub(readings.len()).filter(|_| !readings.is_empty());
        let Some(start) = start else {
            return Err(self.fault(format!("`{{{written}}}` is no reading"), at).help(help));
        };
        for (w, reading) in self.phrase[start..].iter_mut().zip(readings) {
            w.forced = Some(reading);
        }
        Ok(())
    }

    fn forced_readings(&self, written: &str, at: usize) -> Result<Vec<Reading>> {
        let mut out = Vec::new();
        for label in written.split_whitespace() {
            if let Some(run) = label.chars().any(zhuyin::is_zhuyin).then(|| zhuyin::run(label)).flatten() {
                out.extend(run.into_iter().map(|(r, _)| r));
                continue;
            }
            let declared = if self.system == System::Auto { self.found.romanisation } else { Some(self.system) };
            let system = declared.filter(|s| matches!(s, System::Hanyu | System::Tongyong)).or(self.found.romanisation);
            let both = match system {
                Some(system) => label::readings(label, system),
                None => label::readings(label, System::Auto),
            };
            // Where the two romanisations differ, the one the character can have is meant.
            let possible: Vec<Reading> = match self.phrase.last() {
                Some(w) if both.len() > 1 => {
                    let known = han::readings_of(w.c);
                    both.iter().filter(|b| known.iter().any(|k| k.sound() == b.sound())).copied().collect()
                }
                _ => both.clone(),
            };
            match possible.as_slice() {
                [one] => out.push(*one),
                _ if both.len() > 1 => {
                    return Err(self.fault(format!("`{label}` differs in Hanyu and in Tongyong Pinyin"), at).help(
                        message![
                            "give ",
                            Setting::System.of("hanyu"),
                            " or ",
                            Setting::System.of("tongyong"),
                            ", or write the reading in Zhuyin"
                        ],
                    ));
                }
                _ => {
                    let run = romanised::word(label, system.unwrap_or(System::Hanyu)).unwrap_or_default();
                    out.extend(run.iter().map(|w| w.reading));
                }
            }
        }
        Ok(out)
    }

    fn word(&mut self, written: &str, token: &Token) -> Result<()> {
        let start = token.span.start;
        let latin = self.found.latin;
        let system = match latin {
            System::Hanyu | System::Tongyong => Some(latin),
            _ if self.system == System::English => None,
            _ => self.found.romanisation.or(Some(System::Hanyu)),
        };
        let parsed = system.and_then(|system| romanised::word(written, system));
        if let Some(parsed) = parsed.filter(|p| latin != System::English || detect::shows_tones(written, Some(p))) {
            for syllable in parsed {
                let span = start + syllable.span.start..start + syllable.span.end;
                self.out.push(Syllable::mandarin(&self.text[span.clone()], &syllable.reading, span));
            }
            return Ok(());
        }
        let declared = matches!(self.system, System::Hanyu | System::Tongyong);
        if latin != System::English && (declared || romanised::shows_tones(written)) && !detect::is_english(written) {
            let name = if latin == System::Hanyu { "Hanyu" } else { "Tongyong" };
            return Err(self
                .fault(format!("`{written}` is neither {name} Pinyin nor a known English word"), start)
                .help(message!["correct its spelling, or give ", Setting::System]));
        }
        self.english(written, start)
    }

    /// A word of English: its parts between hyphens, and the numbers in it, one by one.
    fn english(&mut self, written: &str, start: usize) -> Result<()> {
        let ordinal = |letters: &str| matches!(letters, "st" | "nd" | "rd" | "th");
        let mut from = 0;
        while from < written.len() {
            let rest = &written[from..];
            let digit = rest.starts_with(|c: char| romanised::fold_width(c).is_ascii_digit());
            let part_end = rest
                .char_indices()
                .find(|(_, c)| {
                    (romanised::fold_width(*c).is_ascii_digit() || *c == '.') != digit
                        || matches!(c, '-' | '‐' | '‑' | '·' | ':')
                })
                .map_or(rest.len(), |(i, _)| i);
            let part = &rest[..part_end];
            let span = start + from..start + from + part_end;
            if part.is_empty() {
                from += rest.chars().next().map_or(1, char::len_utf8);
                continue;
            }
            from += part_end;
            if digit && self.found.english_numbers {
                self.english_words(&numerals::read(part), &span);
            } else if digit {
                self.number(part, span);
            } else {
                self.end_phrase();
                // An ordinal's digits have just been said as a number: 1 st.
                let count =
                    self.out.iter().rev().take_while(|s| s.span.end == span.start && s.phones.len() > 1).count();
                let number = &self.text[..span.start];
                let digits = number.len() - number.trim_end_matches(|c: char| c.is_ascii_digit()).len();
                if ordinal(part) && self.found.english_numbers && digits > 0 && count > 0 {
                    let digits = span.start - digits..span.start;
                    self.out.retain(|s| s.span.start < digits.start || s.span.end > digits.end);
                    let said = numerals::ordinal(&self.text[digits.clone()]);
                    self.english_words(&said, &(digits.start..span.end));
                    continue;
                }
                let phones = english::word(part, !self.found.english_numbers || part != "A");
                if !phones.is_empty() {
                    self.out.push(Syllable::english(part, phones, span));
                }
            }
        }
        Ok(())
    }

    fn english_words(&mut self, words: &[&str], span: &Range<usize>) {
        for word in words {
            self.out.push(Syllable::english(*word, english::word(word, false), span.clone()));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Pause;
    use super::*;

    fn pinyin(text: &str) -> String {
        let said = syllables(text, System::Auto).unwrap();
        said.iter()
            .map(|s| if s.pinyin.is_empty() { &s.text } else { &s.pinyin }.as_str())
            .collect::<Vec<_>>()
            .join(" ")
    }

    #[test]
    fn readings_in_braces_win_in_any_spelling() {
        assert_eq!(pinyin("行{hang2}不行"), "hang2 bu4 xing2");
        assert_eq!(pinyin("行{háng}行{ㄏㄤˊ}"), "hang2 hang2");
        assert_eq!(pinyin("银行{yin2 hang2}"), "yin2 hang2");
        assert_eq!(pinyin("次{ci4}"), "ci4");
        assert_eq!(pinyin("中{jhong4}"), "zhong4");
        for bad in ["{hang2}", "行{xyz}", "行 {hang2}", "a{hang2}", "行{hang2 hang2}"] {
            assert!(syllables(bad, System::Auto).is_err(), "{bad}");
        }
    }

    #[test]
    fn numbers_are_read_in_the_language_around_them() {
        assert_eq!(pinyin("2个"), "liang3 ge4");
        assert_eq!(pinyin("room 2"), "room two");
        assert_eq!(pinyin("第2"), "di4 er4");
        assert_eq!(pinyin("the 22nd"), "the twenty second");
        assert_eq!(pinyin("MP3文件"), "MP san1 wen2 jian4");
        assert_eq!(pinyin("走5km"), "zou3 wu3 gong1 li3");
    }

    #[test]
    fn pauses_and_places_are_kept() {
        let said = syllables("好，不。是", System::Auto).unwrap();
        assert_eq!(
            said.iter().map(|s| s.pause_after).collect::<Vec<_>>(),
            [Pause::Comma, Pause::Sentence, Pause::None]
        );
        assert_eq!(said[1].span, 6..9);
    }
}

//! From the tokens of a script to its syllables: characters by their words, Latin letters by the chosen candidate,
//! numbers in the language around them, readings in braces before all.

use std::ops::Range;

use super::detect::{self, Choice, Chosen};
use super::label::Label;
use super::number::{self, Number};
use super::reading::{Reading, Written};
use super::scan::scan;
use super::syllable::Syllable;
use super::system::System;
use super::token::{Kind, Part, PartKind, Token, Word};
use super::words::Phrase;
use super::{english, han};
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
    let tokens = scan(text);
    let choice = detect::choose(text, &tokens, system)?;
    let mut say = Say { text, choice, traditional: is_traditional(&tokens), out: Vec::new(), phrase: Vec::new() };
    for token in &tokens {
        say.token(token)?;
    }
    say.end_phrase();
    Ok(say.out)
}

/// Whether more characters show traditional writing than simplified.
fn is_traditional(tokens: &[Token]) -> bool {
    let han = || tokens.iter().filter_map(|t| if let Kind::Han(c) = t.kind { Some(c) } else { None });
    han().filter(|c| han::is_traditional(*c)).count() > han().filter(|c| han::is_simplified(*c)).count()
}

/// A character on its way to a syllable.
struct Waiting {
    c: char,
    span: Range<usize>,
    forced: Option<Reading>,
}

struct Say<'a> {
    text: &'a str,
    choice: Choice,
    traditional: bool,
    out: Vec<Syllable>,
    /// The characters since the last thing that was none: the neighbours that decide a reading.
    phrase: Vec<Waiting>,
}

impl Say<'_> {
    fn token(&mut self, token: &Token) -> Result<()> {
        match &token.kind {
            Kind::Han(c) => self.characters([*c], &token.span),
            Kind::Number(number) if self.choice.english_numbers => {
                self.end_phrase();
                self.english_number(number, &token.span);
            }
            Kind::Number(number) => self.mandarin_number(number, &token.span),
            Kind::Forced { labels, after_han } => self.force(labels, *after_han, token)?,
            Kind::Word(word) => match word.unit.filter(|_| !self.choice.english_numbers) {
                Some(unit) => self.characters(unit.chars(), &token.span),
                None => self.word(word, token)?,
            },
            Kind::Zhuyin(run) => {
                self.end_phrase();
                let run = run.as_ref().ok_or_else(|| {
                    self.fault(format!("`{}` is not Zhuyin", token.text), token)
                        .help("write each syllable with its symbols in order and its tone mark after them: ㄋㄧㄣˊ")
                })?;
                self.written(run, token);
            }
            Kind::Break(pause) => {
                self.end_phrase();
                if let Some(last) = self.out.last_mut() {
                    last.pause_after = last.pause_after.max(*pause);
                }
            }
        }
        Ok(())
    }

    fn fault(&self, what: String, token: &Token) -> Fault {
        Fault::new(what).line(token.line_in(self.text))
    }

    /// Adds characters to the phrase, all of one place in the script.
    fn characters(&mut self, characters: impl IntoIterator<Item = char>, span: &Range<usize>) {
        self.phrase.extend(characters.into_iter().map(|c| Waiting { c, span: span.clone(), forced: None }));
    }

    fn mandarin_number(&mut self, number: &Number, span: &Range<usize>) {
        let before = self.phrase.last().map(|w| w.c);
        self.characters(number::mandarin::read(number, before).chars(), span);
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

    /// Adds syllables that a token spells.
    fn written(&mut self, syllables: &[Written], token: &Token) {
        let start = token.span.start;
        self.out.extend(syllables.iter().map(|Written { reading, span }| {
            Syllable::mandarin(&token.text[span.clone()], reading, start + span.start..start + span.end)
        }));
    }

    /// Readings in braces: as many syllables as are in them, for the characters before them.
    fn force(&mut self, labels: &[Label], after_han: bool, token: &Token) -> Result<()> {
        let help = "write the reading of the character before the braces: 行{hang2}, 行{háng} or 行{ㄏㄤˊ}";
        if !after_han {
            return Err(self.fault(format!("`{{{}}}` stands after no character", token.text), token).help(help));
        }
        let mut readings = Vec::new();
        for label in labels {
            readings.extend(self.forced(label, token)?);
        }
        let start = self.phrase.len().checked_sub(readings.len()).filter(|_| !readings.is_empty());
        let Some(start) = start else {
            return Err(self.fault(format!("`{{{}}}` is no reading", token.text), token).help(help));
        };
        for (w, reading) in self.phrase[start..].iter_mut().zip(readings) {
            w.forced = Some(reading);
        }
        Ok(())
    }

    /// The readings of one label in braces.
    fn forced(&self, label: &Label, token: &Token) -> Result<Vec<Reading>> {
        let readings = |run: &[Written]| run.iter().map(|w| w.reading).collect();
        if let Some(run) = label.in_zhuyin() {
            return Ok(readings(run));
        }
        let system = self.choice.romanisation;
        let both = label.readings(system.unwrap_or(System::Auto));
        // Where the two romanisations differ, the one the character can have is meant.
        let possible: Vec<Reading> = match self.phrase.last() {
            Some(w) if both.len() > 1 => {
                let known = han::readings_of(w.c);
                both.iter().filter(|b| known.iter().any(|k| k.sound() == b.sound())).copied().collect()
            }
            _ => both.clone(),
        };
        if possible.len() == 1 {
            return Ok(possible);
        }
        if both.len() > 1 {
            let what = format!("`{}` differs in Hanyu and in Tongyong Pinyin", label.text);
            return Err(self.fault(what, token).help(message![
                "give ",
                Setting::System.of("hanyu"),
                " or ",
                Setting::System.of("tongyong"),
                ", or write the reading in Zhuyin"
            ]));
        }
        let run = label.pinyin.in_system(system.unwrap_or(System::Hanyu));
        Ok(run.map(readings).unwrap_or_default())
    }

    /// A word in Latin letters, by its chosen candidate.
    fn word(&mut self, word: &Word, token: &Token) -> Result<()> {
        self.end_phrase();
        match self.choice.of(token.text, word) {
            Chosen::Pinyin(syllables) => self.written(syllables, token),
            Chosen::English(parts) => parts.iter().for_each(|part| self.part(part)),
            Chosen::Nothing(name) => {
                let what = format!("`{}` is neither {name} Pinyin nor a known English word", token.text);
                return Err(self.fault(what, token).help(message!["correct its spelling, or give ", Setting::System]));
            }
        }
        Ok(())
    }

    /// A part of an English word.
    fn part(&mut self, part: &Part) {
        let english_numbers = self.choice.english_numbers;
        match &part.kind {
            PartKind::Digits(number) if english_numbers => self.english_number(number, &part.span),
            PartKind::Digits(number) => self.mandarin_number(number, &part.span),
            PartKind::Letters { ordinal } => {
                self.end_phrase();
                let digits = ordinal.filter(|_| english_numbers && self.ends_in_a_number(part.span.start));
                if let Some(digits) = digits {
                    self.ordinal(digits, &part.span);
                    return;
                }
                let phones = english::word(part.text, !english_numbers || part.text != "A");
                if !phones.is_empty() {
                    self.out.push(Syllable::english(part.text, phones, part.span.clone()));
                }
            }
        }
    }

    /// Whether the last syllable is a word of a number that ends at a byte of the script.
    fn ends_in_a_number(&self, end: usize) -> bool {
        self.out.last().is_some_and(|s| s.span.end == end && s.phones.len() > 1)
    }

    /// An ordinal, whose digits before the letters have just been read as a number: 1 st.
    fn ordinal(&mut self, digits: &str, letters: &Range<usize>) {
        let start = letters.start - digits.len();
        self.out.retain(|s| s.span.start < start || s.span.end > letters.start);
        self.english_words(&number::english::ordinal(digits), &(start..letters.end));
    }

    fn english_number(&mut self, number: &Number, span: &Range<usize>) {
        self.english_words(&number::english::read(number), span);
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

//! Which language and romanisation the Latin letters of a script are in.
//!
//! What the text does not show is asked for, never guessed: a wrong romanisation makes a wrong mouth.

use super::english;
use super::romanised::{self, Written};
use super::system::System;
use super::tokens::{Kind, Token};
use crate::disk::{Fault, Result, Setting, message};

/// What was found out about a script.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Found {
    /// What a word in Latin letters is: [`System::English`], [`System::Hanyu`] or [`System::Tongyong`].
    pub(super) latin: System,
    /// The romanisation of words that show tones, and of readings in braces, where the text or the call tells.
    pub(super) romanisation: Option<System>,
    /// Whether numbers are read in English.
    pub(super) english_numbers: bool,
}

/// Common English words that can be read as Pinyin, in alphabetical order (`tests/learn/lookalikes.py`).
static LOOKALIKES: &str = include_str!("lookalikes.txt");

/// The two ways one word can be read.
struct Both<'a> {
    text: &'a str,
    at: usize,
    hanyu: Option<Vec<Written>>,
    tongyong: Option<Vec<Written>>,
}

impl Both<'_> {
    fn is_pinyin(&self) -> bool {
        self.hanyu.is_some() || self.tongyong.is_some()
    }

    /// Whether the two read it as different syllables. `e` counts: where Tongyong is written without ê it may be ㄝ.
    fn differs(&self) -> bool {
        let (Some(hanyu), Some(tongyong)) = (&self.hanyu, &self.tongyong) else { return false };
        let lone_e = |w: &Written| w.reading.sound().hanyu() == "e";
        hanyu.len() != tongyong.len()
            || hanyu.iter().zip(tongyong).any(|(h, t)| h.reading.sound() != t.reading.sound() || lone_e(h))
    }
}

/// Tells what a script is in, from what was declared and from its words.
pub(super) fn find(text: &str, tokens: &[Token], system: System) -> Result<Found> {
    let chinese = tokens.iter().any(|t| matches!(t.kind, Kind::Han(_) | Kind::Zhuyin));
    let fixed = |latin, romanisation| Ok(Found { latin, romanisation, english_numbers: false });
    match system {
        System::Hanyu | System::Tongyong => return fixed(system, Some(system)),
        System::Zhuyin => return fixed(System::English, None),
        System::English => {
            return Ok(Found { latin: System::English, romanisation: None, english_numbers: true });
        }
        System::Auto | System::Han => {}
    }
    let words: Vec<Both> = tokens.iter().filter(|t| t.kind == Kind::Word).map(|t| both(text, t)).collect();
    let toned: Vec<&Both> = words.iter().filter(|w| is_toned(w)).collect();
    if chinese || system == System::Han {
        let forced: Vec<Both> = tokens.iter().filter(|t| t.kind == Kind::Forced).map(|t| both(text, t)).collect();
        let romanisation = evidence(toned.iter().copied().chain(&forced))?;
        if let (None, Some(open)) = (romanisation, toned.iter().find(|w| w.differs())) {
            return Err(ambiguous(text, open));
        }
        return fixed(System::English, romanisation);
    }
    let showing: Vec<&Both> = words.iter().filter(|w| w.is_pinyin() && !is_lookalike(w.text)).collect();
    // One word by itself that is one syllable is what a learner of Mandarin asks for.
    let lone =
        matches!(words.as_slice(), [one] if one.hanyu.as_ref().or(one.tongyong.as_ref()).is_some_and(|w| w.len() == 1));
    let foreign = words.iter().filter(|w| !w.is_pinyin()).count();
    if toned.is_empty() && !lone && (showing.len() <= foreign || showing.is_empty()) {
        return Ok(Found { latin: System::English, romanisation: None, english_numbers: !words.is_empty() });
    }
    let pinyin: Vec<&Both> = words.iter().filter(|w| w.is_pinyin()).collect();
    match evidence(pinyin.iter().copied())? {
        Some(system) => fixed(system, Some(system)),
        None => match pinyin.iter().find(|w| w.differs()) {
            Some(open) => Err(ambiguous(text, open)),
            None => fixed(System::Hanyu, Some(System::Hanyu)),
        },
    }
}

fn both<'a>(text: &'a str, token: &Token) -> Both<'a> {
    let word = &text[token.span.clone()];
    Both {
        text: word,
        at: token.span.start,
        hanyu: romanised::word(word, System::Hanyu),
        tongyong: romanised::word(word, System::Tongyong),
    }
}

/// Whether a word is Pinyin that shows its tones, and not a foreign name with an accent: half of its syllables must.
fn is_toned(word: &Both) -> bool {
    shows_tones(word.text, word.hanyu.as_ref().or(word.tongyong.as_ref()))
}

/// The same for a word already taken apart.
pub(super) fn shows_tones(text: &str, syllables: Option<&Vec<Written>>) -> bool {
    let Some(syllables) = syllables else { return false };
    let toned = syllables.iter().filter(|w| w.reading.tone().is_some_and(|t| t < 5)).count();
    let neutral = text.contains(['5', '0']);
    romanised::shows_tones(text) && (2 * toned >= syllables.len() || neutral)
}

/// The romanisation that some word can only be in; nothing where all words can be in both.
fn evidence<'a>(words: impl Iterator<Item = &'a Both<'a>>) -> Result<Option<System>> {
    let (mut hanyu, mut tongyong) = (None, None);
    for word in words {
        match (&word.hanyu, &word.tongyong) {
            (Some(_), None) => hanyu = hanyu.or(Some(word)),
            (None, Some(_)) => tongyong = tongyong.or(Some(word)),
            _ => {}
        }
    }
    match (hanyu, tongyong) {
        (Some(h), Some(t)) => Err(Fault::new(format!(
            "`{}` is Hanyu Pinyin and `{}` is Tongyong Pinyin: a script is in one of the two",
            h.text, t.text
        ))
        .help(message![
            "correct the spelling, or give ",
            Setting::System.of("hanyu"),
            " or ",
            Setting::System.of("tongyong"),
            " (script_system in a lesson)"
        ])),
        (Some(_), None) => Ok(Some(System::Hanyu)),
        (None, Some(_)) => Ok(Some(System::Tongyong)),
        (None, None) => Ok(None),
    }
}

fn ambiguous(text: &str, word: &Both) -> Fault {
    let (hanyu, tongyong) = (zhuyin(word.hanyu.as_deref()), zhuyin(word.tongyong.as_deref()));
    let what = if hanyu == tongyong {
        format!("`{}` is {hanyu} in Hanyu Pinyin and may be ㄝ in Tongyong Pinyin", word.text)
    } else {
        format!("`{}` is {hanyu} in Hanyu Pinyin and {tongyong} in Tongyong Pinyin", word.text)
    };
    Fault::new(format!("{what}, and nothing in the script shows which it is in")).line(line_of(text, word.at)).help(
        message![
            "give ",
            Setting::System.of("hanyu"),
            " or ",
            Setting::System.of("tongyong"),
            " (script_system in a lesson)"
        ],
    )
}

fn zhuyin(word: Option<&[Written]>) -> String {
    word.unwrap_or_default().iter().map(|w| w.reading.sound().zhuyin()).collect::<Vec<_>>().join(" ")
}

/// The line a byte is on, counted from 1.
pub(super) fn line_of(text: &str, at: usize) -> usize {
    1 + text.bytes().take(at).filter(|b| *b == b'\n').count()
}

/// Whether a word that can be read as Pinyin is a common word of English.
fn is_lookalike(word: &str) -> bool {
    let word = word.to_lowercase();
    LOOKALIKES.split_ascii_whitespace().any(|w| w == word)
}

/// Whether a word that is no Pinyin may stand as English in a script of Pinyin: a known word, or capitals.
pub(super) fn is_english(word: &str) -> bool {
    let letters = || word.chars().filter(|c| c.is_alphabetic());
    letters().count() > 0 && (english::is_known(word) || letters().all(char::is_uppercase))
}

#[cfg(test)]
mod tests {
    use super::super::tokens;
    use super::*;

    fn latin(text: &str) -> Result<System> {
        find(text, &tokens::scan(text), System::Auto).map(|f| f.latin)
    }

    #[test]
    fn latin_letters_are_told_apart_by_their_words() {
        for (text, want) in [
            ("ni hao", System::Hanyu),
            ("hello world", System::English),
            ("hang on", System::English),
            ("he can", System::English),
            ("wo he ta", System::Hanyu),
            ("nǐ hǎo Peter", System::Hanyu),
            ("ni hao Peter", System::Hanyu),
            ("jhongguo", System::Tongyong),
            ("syuesheng hao", System::Tongyong),
            ("zhe ci", System::Hanyu),
            ("jhe ci", System::Tongyong),
            ("他说 hao", System::English),
            ("women", System::English),
            ("long", System::Hanyu),
            ("he can ban me", System::English),
        ] {
            assert_eq!(latin(text).unwrap(), want, "{text}");
        }
    }

    #[test]
    fn what_both_romanisations_read_differently_is_asked_for() {
        for text in ["ci", "si", "e", "ma\nci4 hao3"] {
            let fault = latin(text).unwrap_err();
            assert!(fault.advice().steps().next().is_some(), "{text}: {fault}");
        }
        assert_eq!(latin("ma\nci4 hao3").unwrap_err().line_number(), Some(2));
        assert!(latin("zhong jhong").is_err());
    }
}

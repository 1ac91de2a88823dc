//! Which language and romanisation the Latin letters of a script are in, chosen from the candidates of its tokens.
//!
//! What the text does not show is asked for, never guessed: a wrong romanisation makes a wrong mouth.

use super::english;
use super::reading::Written;
use super::romanised::Romanised;
use super::system::System;
use super::token::{Kind, Part, Token, Word};
use crate::disk::{Fault, Result, Setting, message};

/// The language and romanisation of a script.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Choice {
    /// How words in Latin letters are read.
    latin: Latin,
    /// The romanisation of readings in braces, where the text or the call shows one.
    pub(super) romanisation: Option<System>,
    /// Whether numbers are read in English.
    pub(super) english_numbers: bool,
}

/// How words in Latin letters are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Latin {
    /// As Pinyin of this romanisation; where a word cannot be, as English.
    Pinyin {
        /// The romanisation.
        system: System,
        /// Whether the call names it: then a word that is neither is a fault.
        is_declared: bool,
    },
    /// As English; words that show their tones as Pinyin of this romanisation.
    Mixed(System),
    /// As English.
    English,
}

/// The candidate of a word that is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Chosen<'a> {
    /// Its syllables of Pinyin.
    Pinyin(&'a [Written]),
    /// Its parts in English.
    English(&'a [Part<'a>]),
    /// None: the word is no Pinyin of the romanisation of this name, and no English word.
    Nothing(&'static str),
}

impl Choice {
    fn pinyin(system: System, is_declared: bool) -> Self {
        Self { latin: Latin::Pinyin { system, is_declared }, romanisation: Some(system), english_numbers: false }
    }

    /// English between characters or Zhuyin. Toned words are Hanyu Pinyin where no romanisation is shown.
    fn mixed(romanisation: Option<System>) -> Self {
        let latin = Latin::Mixed(romanisation.unwrap_or(System::Hanyu));
        Self { latin, romanisation, english_numbers: false }
    }

    /// The candidate of a word, written `text`, that this choice reads.
    pub(super) fn of<'a>(&self, text: &str, word: &'a Word) -> Chosen<'a> {
        let pinyin = match self.latin {
            Latin::Pinyin { system, .. } => word.pinyin.in_system(system),
            Latin::Mixed(system) => word.pinyin.in_system(system).filter(|p| word.pinyin.is_toned(p)),
            Latin::English => None,
        };
        match (pinyin, self.latin) {
            (Some(syllables), _) => Chosen::Pinyin(syllables),
            (None, Latin::Pinyin { system, is_declared })
                if (is_declared || word.pinyin.shows_tones()) && !is_english(text) =>
            {
                Chosen::Nothing(if system == System::Hanyu { "Hanyu" } else { "Tongyong" })
            }
            (None, _) => Chosen::English(&word.english),
        }
    }
}

/// Common English words that can be read as Pinyin, in alphabetical order (`tests/learn/lookalikes.py`).
static LOOKALIKES: &str = include_str!("lookalikes.txt");

/// A word or forced reading in Latin letters, with its candidates in the two romanisations.
#[derive(Clone, Copy)]
struct Candidate<'a> {
    token: &'a Token<'a>,
    pinyin: &'a Romanised,
}

impl<'a> Candidate<'a> {
    fn of_word(token: &'a Token<'a>) -> Option<Self> {
        let Kind::Word(word) = &token.kind else { return None };
        Some(Self { token, pinyin: &word.pinyin })
    }

    /// A reading in braces that is alone in them: several at once show nothing.
    fn of_forced(token: &'a Token<'a>) -> Option<Self> {
        let Kind::Forced { labels, .. } = &token.kind else { return None };
        let [label] = labels.as_slice() else { return None };
        (label.text == token.text).then_some(Self { token, pinyin: &label.pinyin })
    }

    fn is_pinyin(&self) -> bool {
        self.pinyin.in_either().is_some()
    }

    fn is_toned(&self) -> bool {
        self.pinyin.in_either().is_some_and(|syllables| self.pinyin.is_toned(syllables))
    }

    fn is_one_syllable(&self) -> bool {
        self.pinyin.in_either().is_some_and(|syllables| syllables.len() == 1)
    }
}

/// The language and romanisation of a script, from what was declared and from its words.
pub(super) fn choose(text: &str, tokens: &[Token], system: System) -> Result<Choice> {
    match system {
        System::Hanyu | System::Tongyong => return Ok(Choice::pinyin(system, true)),
        System::Zhuyin => return Ok(Choice::mixed(None)),
        System::English => {
            return Ok(Choice { latin: Latin::English, romanisation: None, english_numbers: true });
        }
        System::Auto | System::Han => {}
    }
    let words: Vec<Candidate> = tokens.iter().filter_map(Candidate::of_word).collect();
    let is_chinese = tokens.iter().any(|t| matches!(t.kind, Kind::Han(_) | Kind::Zhuyin(_)));
    if is_chinese || system == System::Han {
        let toned: Vec<Candidate> = words.into_iter().filter(Candidate::is_toned).collect();
        let forced = tokens.iter().filter_map(Candidate::of_forced);
        let romanisation = evidence(toned.iter().copied().chain(forced))?;
        return match toned.iter().find(|w| w.pinyin.differs()) {
            Some(open) if romanisation.is_none() => Err(ambiguous(text, open)),
            _ => Ok(Choice::mixed(romanisation)),
        };
    }
    if !is_romanised(&words) {
        return Ok(Choice { english_numbers: !words.is_empty(), ..Choice::mixed(None) });
    }
    let romanisation = evidence(words.iter().copied())?;
    match words.iter().find(|w| w.pinyin.differs()) {
        Some(open) if romanisation.is_none() => Err(ambiguous(text, open)),
        _ => Ok(Choice::pinyin(romanisation.unwrap_or(System::Hanyu), false)),
    }
}

/// Whether a script without characters is in Pinyin and not in English.
fn is_romanised(words: &[Candidate]) -> bool {
    // One word by itself that is one syllable is what a learner of Mandarin asks for.
    if words.iter().any(Candidate::is_toned) || matches!(words, [one] if one.is_one_syllable()) {
        return true;
    }
    let showing = words.iter().filter(|w| w.is_pinyin() && !is_lookalike(w.token.text)).count();
    let foreign = words.iter().filter(|w| !w.is_pinyin()).count();
    showing > foreign
}

/// The romanisation that some word can only be in; nothing where all words can be in both.
fn evidence<'a>(words: impl Iterator<Item = Candidate<'a>>) -> Result<Option<System>> {
    let (mut hanyu, mut tongyong) = (None, None);
    for word in words {
        match word.pinyin.only_system() {
            Some(System::Hanyu) => hanyu = hanyu.or(Some(word.token.text)),
            Some(_) => tongyong = tongyong.or(Some(word.token.text)),
            None => {}
        }
    }
    match (hanyu, tongyong) {
        (Some(h), Some(t)) => Err(Fault::new(format!(
            "`{h}` is Hanyu Pinyin and `{t}` is Tongyong Pinyin: a script is in one of the two"
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

fn ambiguous(text: &str, word: &Candidate) -> Fault {
    let [hanyu, tongyong] = [System::Hanyu, System::Tongyong].map(|s| zhuyin(word.pinyin.in_system(s)));
    let written = word.token.text;
    let what = if hanyu == tongyong {
        format!("`{written}` is {hanyu} in Hanyu Pinyin and may be ㄝ in Tongyong Pinyin")
    } else {
        format!("`{written}` is {hanyu} in Hanyu Pinyin and {tongyong} in Tongyong Pinyin")
    };
    Fault::new(format!("{what}, and nothing in the script shows which it is in")).line(word.token.line_in(text)).help(
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

/// Whether a word that can be read as Pinyin is a common word of English.
fn is_lookalike(word: &str) -> bool {
    let word = word.to_lowercase();
    LOOKALIKES.split_ascii_whitespace().any(|w| w == word)
}

/// Whether a word that is no Pinyin may stand as English in a script of Pinyin: a known word, or capitals.
fn is_english(word: &str) -> bool {
    let letters = || word.chars().filter(|c| c.is_alphabetic());
    letters().count() > 0 && (english::is_known(word) || letters().all(char::is_uppercase))
}

#[cfg(test)]
mod tests {
    use super::super::scan::scan;
    use super::*;

    fn latin(text: &str) -> Result<System> {
        choose(text, &scan(text), System::Auto).map(|choice| match choice.latin {
            Latin::Pinyin { system, .. } => system,
            Latin::Mixed(_) | Latin::English => System::English,
        })
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
    fn the_choice_picks_one_candidate_of_each_word() {
        let chosen = |text: &str, system| {
            let tokens = scan(text);
            let choice = choose(text, &tokens, system).unwrap();
            let of = |t: &Token| {
                let Kind::Word(word) = &t.kind else { return None };
                Some(match choice.of(t.text, word) {
                    Chosen::Pinyin(syllables) => syllables[0].reading.pinyin(),
                    Chosen::English(parts) => parts[0].text.to_owned(),
                    Chosen::Nothing(name) => format!("no {name}"),
                })
            };
            tokens.iter().filter_map(of).collect::<Vec<_>>().join(" ")
        };
        assert_eq!(chosen("他说 long hao3", System::Auto), "long hao3");
        assert_eq!(chosen("ci2", System::Tongyong), "qi2");
        assert_eq!(chosen("ci2", System::English), "ci");
        assert_eq!(chosen("hao hello hxllo", System::Hanyu), "hao hello no Hanyu");
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

//! What a clip says as it is shown while it is said: phrases of pieces, each with its reading and its time.

use crate::project::Clip;
use crate::script::{self, Lang, Pause, Syllable};
use crate::timing::{Interval, Tier};

/// Marks that belong to what follows them.
const OPENING: &str = "“‘「『《〈（([【〔";

/// What is read in one breath, and shown on one line.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Phrase {
    /// Seconds.
    pub start: f64,
    /// Seconds.
    pub end: f64,
    /// Which sentence of the clip it belongs to, from 0.
    pub sentence: u32,
    /// In order.
    pub pieces: Vec<Piece>,
}

/// What is lit at once: a syllable, or a number or word of several that are written as one.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Piece {
    /// Opening marks before it.
    pub before: String,
    /// How it is written.
    pub text: String,
    /// Marks and blanks after it.
    pub after: String,
    /// Pinyin with tone marks; empty where it is no Mandarin or its reading is not known.
    pub pinyin: String,
    /// Zhuyin; empty as Pinyin is.
    pub zhuyin: String,
    /// Whether it is English.
    pub english: bool,
    /// Seconds.
    pub start: f64,
    /// Seconds.
    pub end: f64,
}

impl Phrase {
    /// All that is written, on one line.
    pub(crate) fn text(&self) -> String {
        let all: String = self.pieces.iter().map(|p| format!("{}{}{}", p.before, p.text, p.after)).collect();
        all.trim().to_owned()
    }
}

/// The phrases of a clip; none where it has no script.
pub(crate) fn phrases(clip: &Clip) -> Vec<Phrase> {
    let starts: Vec<f64> = clip.phrases().intervals.iter().map(|i| i.start).collect();
    let said: Vec<(&Syllable, &Interval)> = clip.syllables.iter().zip(clip.intervals()).collect();
    let mut phrases: Vec<Phrase> = Vec::new();
    let (mut sentence, mut next_start) = (0, 0);
    let mut before = clip.script.get(..said.first().map_or(0, |s| s.0.span.start)).map(opening).unwrap_or_default();
    let mut at = 0;
    while let Some((first, interval)) = said.get(at).copied() {
        // The syllables of a number share its place in the script.
        let count = said[at..].iter().take_while(|s| s.0.span == first.span).count().max(1);
        let own = &said[at..at + count];
        let last = own.last().copied().unwrap_or((first, interval));
        at += count;
        let next = said.get(at).map_or(clip.script.len(), |s| s.0.span.start);
        let between = clip.script.get(last.0.span.end..next).unwrap_or_default();
        let (after, ahead) = parted(between);
        let readings = |read: &dyn Fn(&Syllable) -> String| {
            let all: Vec<String> = own.iter().map(|s| read(s.0)).filter(|r| !r.is_empty()).collect();
            all.join(" ")
        };
        let written = clip.script.get(first.span.clone()).map(script::without_braces).unwrap_or_default();
        let piece = Piece {
            before: std::mem::replace(&mut before, ahead),
            text: if written.is_empty() { first.text.clone() } else { written },
            after,
            pinyin: readings(&|s| script::with_marks(&s.pinyin)),
            zhuyin: readings(&|s| s.zhuyin.clone()),
            english: first.lang == Lang::En,
            start: interval.start,
            end: last.1.end.max(interval.start),
        };
        let begins = starts.get(next_start).is_some_and(|s| piece.start >= s - 1e-9);
        if begins || phrases.is_empty() {
            next_start = starts.partition_point(|s| *s <= piece.start + 1e-9);
            phrases.push(Phrase { start: piece.start, end: piece.end, sentence, pieces: Vec::new() });
        }
        if let Some(phrase) = phrases.last_mut() {
            phrase.end = piece.end;
            phrase.pieces.push(piece);
        }
        // Verses have no full stops.
        if last.0.pause_after == Pause::Sentence || between.contains('\n') {
            sentence += 1;
        }
    }
    phrases
}

/// The language of clips that say this, as a BCP 47 tag: `zh` where any of it is Chinese, or else `en`. Where nothing is
/// said the title's script tells, and where that does not either the language is `und`: not determined.
pub(crate) fn language<'a>(phrases: impl IntoIterator<Item = &'a Phrase>, title: &str) -> &'static str {
    let mut pieces = phrases.into_iter().flat_map(|p| &p.pieces).peekable();
    if pieces.peek().is_some() {
        return if pieces.all(|p| p.english) { "en" } else { "zh" };
    }
    if title.chars().any(is_chinese) { "zh" } else { "und" }
}

/// Whether a character is Han or Zhuyin (Unicode's blocks of the two).
const fn is_chinese(c: char) -> bool {
    matches!(c, '\u{3105}'..='\u{312F}' | '\u{31A0}'..='\u{31BF}' | '\u{3400}'..='\u{4DBF}' | '\u{4E00}'..='\u{9FFF}'
        | '\u{F900}'..='\u{FAFF}' | '\u{20000}'..='\u{3FFFD}')
}

/// The phrases of a clip with their times, as subtitles have them.
pub(crate) fn captions(clip: &Clip) -> Tier {
    let mut tier = Tier::new("phrases");
    tier.intervals = phrases(clip).iter().map(|p| Interval::new(p.start, p.end, p.text())).collect();
    tier
}

/// What stands between two pieces: what belongs to the first, and what to the second.
fn parted(between: &str) -> (String, String) {
    let plain = plain(between);
    let cut = plain.trim_end_matches(|c| OPENING.contains(c)).len();
    let (after, ahead) = plain.split_at(cut);
    (after.to_owned(), ahead.to_owned())
}

fn opening(text: &str) -> String {
    parted(text).1
}

/// Without readings in braces, blanks in a row as one.
fn plain(text: &str) -> String {
    let bare = script::without_braces(text);
    let blank = |c: Option<char>| c.is_some_and(char::is_whitespace);
    let (first, last) = (blank(text.chars().next()), blank(text.chars().next_back()));
    match (first, last, bare.is_empty()) {
        (_, _, true) if first => " ".to_owned(),
        (a, b, _) => format!("{}{bare}{}", if a { " " } else { "" }, if b { " " } else { "" }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_said_tells_the_language_and_without_that_the_title() {
        let phrase = |english: &[bool]| {
            let piece = |english: &bool| Piece {
                before: String::new(),
                text: "a".to_owned(),
                after: String::new(),
                pinyin: String::new(),
                zhuyin: String::new(),
                english: *english,
                start: 0.0,
                end: 1.0,
            };
            let pieces = english.iter().map(piece).collect();
            Phrase { start: 0.0, end: 1.0, sentence: 0, pieces }
        };
        let (en, mixed, none) = (phrase(&[true, true]), phrase(&[true, false]), phrase(&[]));
        assert_eq!(language([&en, &none], "您好"), "en");
        assert_eq!(language([&en, &mixed], "Hello"), "zh");
        assert_eq!(language([&none], "Seven 情"), "zh");
        assert_eq!(language([], "ㄋㄧ"), "zh");
        assert_eq!(language([], "Seven emotions"), "und");
    }
}

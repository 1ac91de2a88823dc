//! A word in Hanyu or Tongyong Pinyin taken apart into syllables: tone marks or digits or none, ü as ü, v or u:,
//! apostrophes and hyphens, several syllables written as one word.
//!
//! Which of the two romanisations a script uses is `detect`'s to say.

use std::ops::Range;

use super::reading::Reading;
use super::sound::Sound;
use super::system::System;
use super::tone::{self, Part};

/// One syllable of a word and its bytes in it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Written {
    pub(super) reading: Reading,
    pub(super) span: Range<usize>,
}

/// A letter of a word, with what stands on it and where it is.
#[derive(Debug, Clone)]
struct Letter {
    c: char,
    tone: Option<u8>,
    span: Range<usize>,
}

/// Letters between two forced boundaries, and the digit after them.
#[derive(Debug, Default)]
struct Chunk {
    letters: Vec<Letter>,
    digit: Option<(u8, usize)>,
}

/// The longest word that is tried: the longest in a dictionary of Pinyin are below 40 letters.
const LONGEST: usize = 80;

/// The syllables of a word, or nothing where it is not made of syllables of this romanisation.
pub(super) fn word(text: &str, system: System) -> Option<Vec<Written>> {
    if text.len() > LONGEST * 4 {
        return None;
    }
    let mut out = Vec::new();
    for chunk in chunks(text)? {
        out.extend(syllables(&chunk, system)?);
    }
    (!out.is_empty()).then_some(out)
}

/// Whether a word shows its tones, by marks or by digits.
pub(super) fn shows_tones(text: &str) -> bool {
    text.chars().any(|c| c.is_ascii_digit())
        || text.chars().any(|c| tone::parts(c).is_some_and(|p| p.iter().any(|p| matches!(p, Part::Mark(_)))))
}

/// The character that may stand between two syllables of a word.
pub(super) fn is_joint(c: char) -> bool {
    matches!(c, '\'' | '’' | '‘' | 'ʼ' | '`' | '-' | '‐' | '‑' | '·')
}

fn chunks(text: &str) -> Option<Vec<Chunk>> {
    let mut chunks = vec![Chunk::default()];
    for (at, c) in text.char_indices() {
        let c = fold_width(c);
        let end = at + text[at..].chars().next().map_or(1, char::len_utf8);
        let chunk = chunks.last_mut()?;
        if is_joint(c) {
            if chunk.letters.is_empty() {
                return None;
            }
            chunks.push(Chunk::default());
        } else if let Some(tone) = tone::of_digit(c) {
            if chunk.letters.is_empty() {
                return None;
            }
            chunk.digit = Some((tone, end));
            chunks.push(Chunk::default());
        } else if c == ':' {
            let last = chunk.letters.last_mut().filter(|l| l.c == 'u')?;
            last.c = 'ü';
            last.span.end = end;
        } else {
            for part in tone::parts(c)? {
                match part {
                    Part::Letter('v') => chunk.letters.push(Letter { c: 'ü', tone: None, span: at..end }),
                    Part::Letter(c) => chunk.letters.push(Letter { c, tone: None, span: at..end }),
                    Part::Mark(tone) => {
                        let last = chunk.letters.last_mut().filter(|l| l.tone.is_none())?;
                        last.tone = Some(tone);
                        last.span.end = end;
                    }
                    Part::Umlaut => {
                        let last = chunk.letters.last_mut().filter(|l| l.c == 'u')?;
                        last.c = 'ü';
                        last.span.end = end;
                    }
                    Part::Hat => {
                        let last = chunk.letters.last_mut().filter(|l| l.c == 'e')?;
                        last.c = 'ê';
                        last.span.end = end;
                    }
                }
            }
        }
    }
    chunks.retain(|c| !c.letters.is_empty());
    Some(chunks)
}

/// Letters and digits of East Asian full width as the plain ones.
pub(super) fn fold_width(c: char) -> char {
    match c {
        '\u{FF01}'..='\u{FF5E}' => char::from_u32(c as u32 - 0xFEE0).unwrap_or(c),
        _ => c,
    }
}

fn syllables(chunk: &Chunk, system: System) -> Option<Vec<Written>> {
    let letters = &chunk.letters;
    if letters.len() > LONGEST {
        return None;
    }
    // The rules from the strictest: a syllable that starts with a, e or o inside a word is marked by an apostrophe, so
    // that `fangan` is fan gan; then erhua; then words whose writer left the apostrophe out.
    let split = [(false, false), (false, true), (true, false), (true, true)]
        .into_iter()
        .find_map(|(vowels, erhua)| Split { letters, system, vowels, erhua }.run())?;
    let marked = letters.iter().any(|l| l.tone.is_some());
    let erhua = |sound: Sound| sound.is_interjection() && sound.hanyu() == "r" && split.len() > 1;
    let mut out: Vec<Written> = Vec::with_capacity(split.len());
    let mut from = 0;
    for (sound, end) in &split {
        let span = letters[from].span.start..letters[*end - 1].span.end;
        // In a word with marks an unmarked syllable is neutral; a word without any says nothing of tones.
        let tone = letters[from..*end].iter().find_map(|l| l.tone).or(marked.then_some(5));
        out.push(Written { reading: Reading::new(*sound, tone), span });
        from = *end;
    }
    if let Some((tone, end)) = chunk.digit {
        // The digit belongs to the last syllable; after erhua to the one that carries it: dianr3.
        let last = out.len() - 1;
        out[last].span.end = end;
        let at = if erhua(split[last].0) { last - 1 } else { last };
        if at == last || !marked {
            out[at].reading = Reading::new(split[at].0, Some(tone));
        }
        if at != last {
            out[last].reading = Reading::new(split[last].0, Some(5));
        }
    }
    Some(out)
}

/// One attempt to take letters apart, longest syllable first, going back where the rest does not come out.
struct Split<'a> {
    letters: &'a [Letter],
    system: System,
    /// Whether a syllable inside may start with a, e or o.
    vowels: bool,
    /// Whether an r may end a syllable.
    erhua: bool,
}

impl Split<'_> {
    fn run(&self) -> Option<Vec<(Sound, usize)>> {
        let mut dead = vec![false; self.letters.len() + 1];
        let mut out = Vec::new();
        self.from(0, &mut out, &mut dead).then_some(out)
    }

    fn from(&self, at: usize, out: &mut Vec<(Sound, usize)>, dead: &mut [bool]) -> bool {
        if at == self.letters.len() {
            return true;
        }
        if dead[at] || (at > 0 && !self.vowels && matches!(self.letters[at].c, 'a' | 'e' | 'ê' | 'o')) {
            return false;
        }
        // `zhuang` and `chuang` are the longest syllables.
        for end in (at + 1..=self.letters.len().min(at + 6)).rev() {
            let Some(sound) = self.sound(at, end) else { continue };
            out.push((sound, end));
            if self.from(end, out, dead) {
                return true;
            }
            out.pop();
        }
        dead[at] = true;
        false
    }

    fn sound(&self, at: usize, end: usize) -> Option<Sound> {
        let letters = &self.letters[at..end];
        if letters.iter().filter(|l| l.tone.is_some()).count() > 1 {
            return None;
        }
        let spelling: String = letters.iter().map(|l| l.c).collect();
        let sound = of_spelling(&spelling, self.system)?;
        let alone = at == 0 && end == self.letters.len();
        let suffix = self.erhua && at > 0 && spelling == "r";
        (alone || suffix || !sound.is_interjection()).then_some(sound)
    }
}

/// The syllable of a spelling. Hanyu forgives ü after j, q, x and y, and lue and nue for lüe and nüe: no other
/// syllable is spelled so.
fn of_spelling(spelling: &str, system: System) -> Option<Sound> {
    if system == System::Tongyong {
        return Sound::from_tongyong(spelling).or_else(|| {
            // Some write nü and lü for nyu and lyu.
            let yu = spelling.replace('ü', "yu");
            spelling.starts_with(['n', 'l']).then(|| Sound::from_tongyong(&yu)).flatten()
        });
    }
    Sound::from_hanyu(spelling).or_else(|| match spelling {
        "lue" => Sound::from_hanyu("lüe"),
        "nue" => Sound::from_hanyu("nüe"),
        _ if spelling.starts_with(['j', 'q', 'x', 'y']) => Sound::from_hanyu(&spelling.replace('ü', "u")),
        _ => None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hanyu(text: &str) -> String {
        let found = word(text, System::Hanyu).unwrap_or_default();
        found.iter().map(|w| w.reading.pinyin()).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn words_come_apart_by_the_rules_of_the_orthography() {
        for (text, want) in [
            ("nǐhǎo", "ni3 hao3"),
            ("Xī'ān", "xi1 an1"),
            ("xian", "xian"),
            ("fang'an", "fang an"),
            ("fangan", "fan gan"),
            ("nin2hao3", "nin2 hao3"),
            ("lv4", "lü4"),
            ("nü3", "nü3"),
            ("péngyou", "peng2 you5"),
            ("Tiananmen", "tian an men"),
            ("dianr3", "dian3 r5"),
            ("nǎr", "na3 r5"),
            ("wánr5", "wan2 r5"),
            ("nü'er", "nü er"),
            ("lüe4", "lüe4"),
            ("zhuāng", "zhuang1"),
        ] {
            assert_eq!(hanyu(text), want, "{text}");
        }
    }

    #[test]
    fn spans_cover_the_syllables_as_written() {
        let found = word("Xī'ān", System::Hanyu).unwrap();
        assert_eq!(found.iter().map(|w| w.span.clone()).collect::<Vec<_>>(), [0..3, 4..7]);
    }

    #[test]
    fn what_is_no_pinyin_is_none() {
        for text in ["hello", "", "'", "3", "ni3'", "bck", "strength"] {
            let found = word(text, System::Hanyu);
            assert!(found.is_none() || text == "ni3'", "{text}: {found:?}");
        }
        assert!(word("jhih", System::Hanyu).is_none() && word("jhih", System::Tongyong).is_some());
    }
}

//! The two romanisations of a word: Hanyu and Tongyong Pinyin, several syllables written as one word.
//!
//! Which of the two a script uses is `detect`'s to say.

use std::cell::OnceCell;

use super::letters::{self, Chunk, Letter};
use super::reading::{Reading, Written};
use super::sound::Sound;
use super::system::System;

/// The candidates of one word in Hanyu and in Tongyong Pinyin. Its letters are read once; the syllables of a
/// romanisation are found when they are first needed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Romanised {
    chunks: Vec<Chunk>,
    hanyu: OnceCell<Option<Vec<Written>>>,
    tongyong: OnceCell<Option<Vec<Written>>>,
    /// Whether marks or digits show tones.
    shows_tones: bool,
    /// Whether a digit of the neutral tone is in it.
    has_neutral_digit: bool,
}

impl Romanised {
    /// Reads the letters of a word.
    pub(super) fn of(text: &str) -> Self {
        let is_short = text.len() <= LONGEST * 4;
        Self {
            chunks: is_short.then(|| letters::chunks(text)).flatten().unwrap_or_default(),
            hanyu: OnceCell::new(),
            tongyong: OnceCell::new(),
            shows_tones: letters::shows_tones(text),
            has_neutral_digit: text.contains(['5', '0']),
        }
    }

    /// Its syllables in one romanisation, with their bytes in the word; nothing where they are none.
    pub(super) fn in_system(&self, system: System) -> Option<&[Written]> {
        let candidate = if system == System::Tongyong { &self.tongyong } else { &self.hanyu };
        candidate.get_or_init(|| self.syllables(system)).as_deref()
    }

    fn syllables(&self, system: System) -> Option<Vec<Written>> {
        let mut out = Vec::new();
        for chunk in &self.chunks {
            out.extend(syllables(chunk, system)?);
        }
        (!out.is_empty()).then_some(out)
    }

    /// Its syllables in Hanyu Pinyin, else in Tongyong Pinyin.
    pub(super) fn in_either(&self) -> Option<&[Written]> {
        self.in_system(System::Hanyu).or_else(|| self.in_system(System::Tongyong))
    }

    /// The romanisation it is in where it can be in one alone.
    pub(super) fn only_system(&self) -> Option<System> {
        match (self.in_system(System::Hanyu), self.in_system(System::Tongyong)) {
            (Some(_), None) => Some(System::Hanyu),
            (None, Some(_)) => Some(System::Tongyong),
            _ => None,
        }
    }

    /// Whether the two romanisations read it as different syllables. `e` counts: where Tongyong is written without ê it
    /// may be ㄝ.
    pub(super) fn differs(&self) -> bool {
        let (Some(hanyu), Some(tongyong)) = (self.in_system(System::Hanyu), self.in_system(System::Tongyong)) else {
            return false;
        };
        let lone_e = |w: &Written| w.reading.sound().hanyu() == "e";
        hanyu.len() != tongyong.len()
            || hanyu.iter().zip(tongyong).any(|(h, t)| h.reading.sound() != t.reading.sound() || lone_e(h))
    }

    /// Whether marks or digits show tones, of whatever it is a word.
    pub(super) fn shows_tones(&self) -> bool {
        self.shows_tones
    }

    /// Whether it is Pinyin that shows its tones, and no foreign name with an accent: half of `syllables` must.
    pub(super) fn is_toned(&self, syllables: &[Written]) -> bool {
        let toned = syllables.iter().filter(|w| w.reading.tone().is_some_and(|t| t < 5)).count();
        self.shows_tones && (2 * toned >= syllables.len() || self.has_neutral_digit)
    }
}

/// The longest word that is tried: the longest in a dictionary of Pinyin are below 40 letters.
const LONGEST: usize = 80;

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
        let word = Romanised::of(text);
        word.in_system(System::Hanyu)
            .unwrap_or_default()
            .iter()
            .map(|w| w.reading.pinyin())
            .collect::<Vec<_>>()
            .join(" ")
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
    fn both_romanisations_are_candidates_of_one_word() {
        let word = Romanised::of("ci2");
        let sound = |system| word.in_system(system).map(|w| w[0].reading.sound().hanyu());
        assert_eq!((sound(System::Hanyu), sound(System::Tongyong)), (Some("ci"), Some("qi")));
        assert!(word.differs() && word.only_system().is_none() && word.shows_tones());
        assert!(!Romanised::of("ma").differs() && Romanised::of("e").differs());
    }

    #[test]
    fn spans_cover_the_syllables_as_written() {
        let word = Romanised::of("Xī'ān");
        let found = word.in_system(System::Hanyu).unwrap();
        assert_eq!(found.iter().map(|w| w.span.clone()).collect::<Vec<_>>(), [0..3, 4..7]);
    }

    #[test]
    fn what_is_no_pinyin_is_none() {
        for text in ["hello", "", "'", "3", "ni3'", "bck", "strength"] {
            let word = Romanised::of(text);
            let found = word.in_system(System::Hanyu);
            assert!(found.is_none() || text == "ni3'", "{text}: {found:?}");
        }
        assert_eq!(Romanised::of("jhih").only_system(), Some(System::Tongyong));
    }
}

//! Zhuyin as it is typed: symbols run together, tone marks after a syllable, the neutral dot before or after it.

use super::reading::{Reading, Written};
use super::sound::Sound;
use super::tone;

/// Whether a character is a symbol of Zhuyin or one of its tone marks.
pub(super) fn is_zhuyin(c: char) -> bool {
    is_symbol(c) || tone::of_zhuyin_mark(c).is_some()
}

fn is_symbol(c: char) -> bool {
    ('\u{3105}'..='\u{312F}').contains(&c)
}

/// Takes a run of symbols and marks apart into syllables, each with its bytes. A syllable without a mark is of the first
/// tone, as Zhuyin writes it. Nothing where some of it is no syllable.
pub(super) fn run(text: &str) -> Option<Vec<Written>> {
    // The vertical stroke that a horizontal font may give for ㄧ is another character.
    let text_chars: Vec<(usize, char)> =
        text.char_indices().map(|(i, c)| (i, if matches!(c, '一' | '丨') { 'ㄧ' } else { c })).collect();
    let end_of = |i: usize| text_chars.get(i).map_or(text.len(), |(at, _)| *at);
    let mut out = Vec::new();
    let mut i = 0;
    while i < text_chars.len() {
        let start = i;
        let mut tone = None;
        if text_chars[i].1 == '˙' {
            tone = Some(5);
            i += 1;
        }
        let (sound, length) = longest(&text_chars[i..])?;
        i += length;
        if tone.is_none()
            && let Some(mark) = text_chars.get(i).and_then(|(_, c)| tone::of_zhuyin_mark(*c))
        {
            // A dot between two syllables belongs to the one after it where that has symbols and no mark of its own.
            if mark != 5 || !dot_belongs_to_the_next(&text_chars[i + 1..]) {
                tone = Some(mark);
                i += 1;
            }
        }
        out.push(Written { reading: Reading::new(sound, tone.or(Some(1))), span: end_of(start)..end_of(i) });
    }
    (!out.is_empty()).then_some(out)
}

fn dot_belongs_to_the_next(rest: &[(usize, char)]) -> bool {
    longest(rest).is_some_and(|(_, n)| rest.get(n).is_none_or(|(_, c)| tone::of_zhuyin_mark(*c).is_none()))
}

/// The longest syllable at the start of the symbols: no syllable has more than three.
fn longest(chars: &[(usize, char)]) -> Option<(Sound, usize)> {
    (1..=chars.len().min(3)).rev().find_map(|n| {
        let spelling: String = chars[..n].iter().map(|(_, c)| *c).collect();
        Sound::from_zhuyin(&spelling).map(|sound| (sound, n))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pinyin(text: &str) -> Vec<String> {
        run(text).unwrap_or_default().iter().map(|w| w.reading.pinyin()).collect()
    }

    #[test]
    fn syllables_run_together_come_apart_at_marks_and_at_the_longest_spelling() {
        assert_eq!(pinyin("ㄋㄧˇㄏㄠˇ"), ["ni3", "hao3"]);
        assert_eq!(pinyin("ㄒㄧㄢㄕㄥ"), ["xian1", "sheng1"]);
        assert_eq!(pinyin("ㄨㄛˇ˙ㄇㄣ"), ["wo3", "men5"]);
        assert_eq!(pinyin("ㄇㄚ˙"), ["ma5"]);
    }

    #[test]
    fn symbols_that_make_no_syllable_are_none() {
        assert!(run("ㄅㄅㄅ").is_none());
        assert!(run("ˊ").is_none());
    }
}

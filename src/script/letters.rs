//! The letters of a word as they are written: full width, tone marks and digits, ü as ü, v or u:, and the joints that
//! part syllables.
//!
//! Which letters make a syllable is `romanised`'s to say.

use std::ops::Range;

use super::tone::{self, Part};

/// One letter of a word, in lower case, with its tone mark and its bytes in the word.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Letter {
    pub(super) c: char,
    pub(super) tone: Option<u8>,
    pub(super) span: Range<usize>,
}

/// Letters between two joints or digits, and the tone of the digit after them with the byte where it ends.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Chunk {
    pub(super) letters: Vec<Letter>,
    pub(super) digit: Option<(u8, usize)>,
}

/// The chunks of a word, or nothing where a character of it belongs to no romanisation.
pub(super) fn chunks(text: &str) -> Option<Vec<Chunk>> {
    let mut chunks = vec![Chunk::default()];
    for (at, c) in text.char_indices() {
        let (c, span) = (fold_width(c), at..at + c.len_utf8());
        let chunk = chunks.last_mut()?;
        if is_joint(c) || tone::of_digit(c).is_some() {
            if chunk.letters.is_empty() {
                return None;
            }
            chunk.digit = tone::of_digit(c).map(|tone| (tone, span.end));
            chunks.push(Chunk::default());
        } else if c == ':' {
            chunk.change('u', 'ü', span.end)?;
        } else {
            for part in tone::parts(c)? {
                chunk.add(part, &span)?;
            }
        }
    }
    chunks.retain(|c| !c.letters.is_empty());
    Some(chunks)
}

impl Chunk {
    /// Adds a letter, or puts a mark on the last one; nothing where there is no letter that can carry it.
    fn add(&mut self, part: Part, span: &Range<usize>) -> Option<()> {
        match part {
            Part::Letter(c) => {
                let c = if c == 'v' { 'ü' } else { c };
                self.letters.push(Letter { c, tone: None, span: span.clone() });
            }
            Part::Mark(tone) => {
                let last = self.letters.last_mut().filter(|l| l.tone.is_none())?;
                last.tone = Some(tone);
                last.span.end = span.end;
            }
            Part::Umlaut => self.change('u', 'ü', span.end)?,
            Part::Hat => self.change('e', 'ê', span.end)?,
        }
        Some(())
    }

    /// Makes another letter of the last one, which then ends at `end`.
    fn change(&mut self, from: char, to: char, end: usize) -> Option<()> {
        let last = self.letters.last_mut().filter(|l| l.c == from)?;
        last.c = to;
        last.span.end = end;
        Some(())
    }
}

/// Whether a word shows its tones, by marks or by digits.
pub(super) fn shows_tones(text: &str) -> bool {
    let is_mark = |part: &Part| matches!(part, Part::Mark(_));
    text.chars().any(|c| c.is_ascii_digit() || (!c.is_ascii() && tone::parts(c).is_some_and(|p| p.iter().any(is_mark))))
}

/// Whether a character may stand between two syllables of a word.
pub(super) fn is_joint(c: char) -> bool {
    matches!(c, '\'' | '’' | '‘' | 'ʼ' | '`' | '-' | '‐' | '‑' | '·')
}

/// Letters and digits of East Asian full width as the plain ones.
pub(super) fn fold_width(c: char) -> char {
    match c {
        '\u{FF01}'..='\u{FF5E}' => char::from_u32(c as u32 - 0xFEE0).unwrap_or(c),
        _ => c,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_go_to_their_letter_and_digits_end_a_chunk() {
        let word = chunks("nǚ'ＡＮ3").unwrap();
        assert_eq!((word.len(), word[0].letters[1].c, word[0].letters[1].tone), (2, 'ü', Some(3)));
        assert_eq!((word[1].letters[0].c, word[1].digit), ('a', Some((3, 11))));
        assert!(chunks("3a").is_none() && chunks("éa\u{301}\u{301}").is_none());
    }
}

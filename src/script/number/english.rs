//! Numbers as they are read in English: a row of words for a row of digits.

use super::{Number, Sign};

const ONES: [&str; 20] = [
    "zero",
    "one",
    "two",
    "three",
    "four",
    "five",
    "six",
    "seven",
    "eight",
    "nine",
    "ten",
    "eleven",
    "twelve",
    "thirteen",
    "fourteen",
    "fifteen",
    "sixteen",
    "seventeen",
    "eighteen",
    "nineteen",
];
const TENS: [&str; 10] = ["", "", "twenty", "thirty", "forty", "fifty", "sixty", "seventy", "eighty", "ninety"];
const MONTHS: [&str; 12] = [
    "January",
    "February",
    "March",
    "April",
    "May",
    "June",
    "July",
    "August",
    "September",
    "October",
    "November",
    "December",
];

/// The words of a number.
pub(in super::super) fn read(number: &Number) -> Vec<&'static str> {
    let mut words = if number.negative { vec!["minus"] } else { Vec::new() };
    words.extend(plain(number, number.money.is_some() || number.sign.is_some()));
    let one = number.body == "1";
    words.extend(number.money.map(|money| match money {
        '$' if one => "dollar",
        '$' => "dollars",
        '€' if one => "euro",
        '€' => "euros",
        '£' if one => "pound",
        '£' => "pounds",
        _ => "yuan",
    }));
    words.extend_from_slice(match number.sign {
        Some(Sign::Percent) => &["percent"],
        Some(Sign::Permille) => &["per", "thousand"],
        Some(Sign::Degree) => &["degrees"],
        Some(Sign::Celsius) => &["degrees", "Celsius"],
        Some(Sign::Fahrenheit) => &["degrees", "Fahrenheit"],
        None => &[],
    });
    words
}

/// The words of an ordinal: `1st`, `22nd`.
pub(in super::super) fn ordinal(digits: &str) -> Vec<&'static str> {
    let mut words = cardinal(digits);
    if let Some(last) = words.last_mut() {
        *last = ordinal_of(last);
    }
    words
}

fn ordinal_of(word: &'static str) -> &'static str {
    const IRREGULAR: [(&str, &str); 29] = [
        ("zero", "zeroth"),
        ("one", "first"),
        ("two", "second"),
        ("three", "third"),
        ("four", "fourth"),
        ("five", "fifth"),
        ("six", "sixth"),
        ("seven", "seventh"),
        ("eight", "eighth"),
        ("nine", "ninth"),
        ("ten", "tenth"),
        ("eleven", "eleventh"),
        ("twelve", "twelfth"),
        ("thirteen", "thirteenth"),
        ("fourteen", "fourteenth"),
        ("fifteen", "fifteenth"),
        ("sixteen", "sixteenth"),
        ("seventeen", "seventeenth"),
        ("eighteen", "eighteenth"),
        ("nineteen", "nineteenth"),
        ("twenty", "twentieth"),
        ("thirty", "thirtieth"),
        ("forty", "fortieth"),
        ("fifty", "fiftieth"),
        ("sixty", "sixtieth"),
        ("seventy", "seventieth"),
        ("eighty", "eightieth"),
        ("ninety", "ninetieth"),
        ("hundred", "hundredth"),
    ];
    IRREGULAR.iter().find(|(one, _)| *one == word).map_or(word, |(_, nth)| nth)
}

/// The words of its digits; `counted` is whether money or a unit says that they are no year and no code.
fn plain(number: &Number, counted: bool) -> Vec<&'static str> {
    let joined_by = |c| number.is_joined_by(c);
    let small = |text: &str| text.parse::<usize>().unwrap_or(usize::MAX);
    match number.parts().as_slice() {
        [one] => amount(one, counted),
        [y, m, d]
            if y.len() == 4 && !joined_by(':') && (1..=12).contains(&small(m)) && (1..=31).contains(&small(d)) =>
        {
            let mut words = vec![MONTHS[small(m) - 1]];
            words.extend(ordinal(d));
            words.extend(year(y));
            words
        }
        [m, d] if joined_by('/') && (1..=12).contains(&small(m)) && (1..=31).contains(&small(d)) => {
            let mut words = vec![MONTHS[small(m) - 1]];
            words.extend(ordinal(d));
            words
        }
        [h, m] if joined_by(':') && small(h) <= 24 && m.len() == 2 && small(m) < 60 => {
            let mut words = cardinal(h);
            match small(m) {
                0 => words.push("o'clock"),
                1..=9 => {
                    words.push("oh");
                    words.extend(cardinal(m));
                }
                _ => words.extend(cardinal(m)),
            }
            words
        }
        [a, b] if !a.starts_with('0') && a.len() + b.len() < 8 => {
            let between = if joined_by('/') { "over" } else { "to" };
            amount(a, counted).into_iter().chain([between]).chain(amount(b, counted)).collect()
        }
        _ => one_by_one(&number.body),
    }
}

fn amount(text: &str, counted: bool) -> Vec<&'static str> {
    let plain: String = text.chars().filter(|c| *c != ',').collect();
    let mut parts = plain.split('.');
    let whole = parts.next().unwrap_or("");
    let century = plain.get(..2).is_some_and(|c| ("11".."21").contains(&c));
    let is_year = century && plain.len() == 4 && !text.contains(',') && !counted;
    let mut words = if is_year {
        year(whole)
    } else if (whole.len() > 1 && whole.starts_with('0')) || (whole.len() >= 7 && !text.contains(',') && !counted) {
        one_by_one(whole)
    } else {
        cardinal(whole)
    };
    for part in parts {
        words.push("point");
        words.extend(one_by_one(part));
    }
    words
}

/// A year in two halves: twenty twenty-four; two thousand five; nineteen oh five.
fn year(text: &str) -> Vec<&'static str> {
    let (Some(century), Some(rest)) = (text.get(..2), text.get(2..)) else { return cardinal(text) };
    match rest.parse::<u32>() {
        Ok(_) if text.starts_with("200") || text.ends_with("000") => cardinal(text),
        Ok(0) => cardinal(century).into_iter().chain(["hundred"]).collect(),
        Ok(n @ 1..=9) => cardinal(century).into_iter().chain(["oh", ONES[n as usize]]).collect(),
        Ok(_) => cardinal(century).into_iter().chain(cardinal(rest)).collect(),
        Err(_) => cardinal(text),
    }
}

fn one_by_one(text: &str) -> Vec<&'static str> {
    text.chars().filter_map(|c| c.to_digit(10)).map(|d| ONES[d as usize]).collect()
}

fn cardinal(text: &str) -> Vec<&'static str> {
    let Some(number) = text.parse::<u64>().ok().filter(|n| *n < 1_000_000_000_000_000) else { return one_by_one(text) };
    if number == 0 {
        return vec!["zero"];
    }
    let mut words = Vec::new();
    for (unit, name) in [
        (1_000_000_000_000, "trillion"),
        (1_000_000_000, "billion"),
        (1_000_000, "million"),
        (1000, "thousand"),
        (1, ""),
    ] {
        let group = (number / unit % 1000) as usize;
        if group >= 100 {
            words.extend([ONES[group / 100], "hundred"]);
        }
        match group % 100 {
            0 => {}
            rest @ 1..20 => words.push(ONES[rest]),
            rest => {
                words.push(TENS[rest / 10]);
                words.extend(ONES.get(rest % 10).filter(|_| rest % 10 > 0));
            }
        }
        if group > 0 && !name.is_empty() {
            words.push(name);
        }
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_as_an_english_reader_reads_them() {
        for (text, want) in [
            ("0", "zero"),
            ("42", "forty two"),
            ("105", "one hundred five"),
            ("1,234", "one thousand two hundred thirty four"),
            ("2024", "twenty twenty four"),
            ("1905", "nineteen oh five"),
            ("2005", "two thousand five"),
            ("3.14", "three point one four"),
            ("50%", "fifty percent"),
            ("$3", "three dollars"),
            ("3:30", "three thirty"),
            ("2024-11-22", "November twenty second twenty twenty four"),
            ("5551234", "five five five one two three four"),
        ] {
            assert_eq!(read(&Number::of(text, None)).join(" "), want, "{text}");
        }
        assert_eq!(ordinal("22").join(" "), "twenty second");
    }
}

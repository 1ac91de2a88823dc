//! Whether the labels of a tier are the syllables of a script, and where they part if not.

use super::{Interval, Tier, Timing};
use crate::disk::{Fault, Result};

/// How many neighbours are shown on each side of the place where script and tier part.
const CONTEXT: usize = 3;

/// The first place where a script and a tier part.
#[derive(Debug, Clone, PartialEq)]
pub struct Parting {
    /// The place in the script, and among the tier's labels that say something, from 0.
    pub index: usize,
    /// When, in seconds: where the label begins, or where the tier ends.
    pub time: f64,
    /// The label there; nothing where the tier is at its end.
    pub found: Option<String>,
}

/// Finds the first label that does not fit what is expected, or the end of the shorter one. Marks of silence such as
/// `sil` and `#` are passed over. Nothing where all fit.
#[must_use]
pub fn first_parting<T>(expected: &[T], labels: &Tier, fits: impl Fn(&T, &str) -> bool) -> Option<Parting> {
    let mut spoken = labels.spoken();
    let mut index = 0;
    loop {
        let parting = |i: &Interval| Parting { index, time: i.start, found: Some(i.label.clone()) };
        match (expected.get(index), spoken.next()) {
            (None, None) => return None,
            (Some(e), Some(i)) if fits(e, &i.label) => index += 1,
            (_, Some(i)) => return Some(parting(i)),
            (Some(_), None) => return Some(Parting { index, time: labels.end(), found: None }),
        }
    }
}

/// The longest row of pairs, both rising, in which items of two lists fit each other: what an edit of one into the
/// other has left alone. Pairs are (place in the first, place in the second).
#[must_use]
pub fn common<A, B>(first: &[A], second: &[B], fits: impl Fn(&A, &B) -> bool) -> Vec<(usize, usize)> {
    let mut pairs = Vec::new();
    let start = first.iter().zip(second).take_while(|(a, b)| fits(a, b)).count();
    pairs.extend((0..start).map(|i| (i, i)));
    let (a, b) = (&first[start..], &second[start..]);
    let end = a.iter().rev().zip(b.iter().rev()).take_while(|(a, b)| fits(a, b)).count();
    let (a, b) = (&a[..a.len() - end], &b[..b.len() - end]);
    // What is left between is small in all but a script written anew, of which nothing needs to be kept.
    const LARGEST: usize = 4_000_000;
    if a.len().saturating_mul(b.len()) <= LARGEST {
        let width = b.len() + 1;
        let mut lengths = vec![0_u32; (a.len() + 1) * width];
        for i in (0..a.len()).rev() {
            for j in (0..b.len()).rev() {
                lengths[i * width + j] = if fits(&a[i], &b[j]) {
                    1 + lengths[(i + 1) * width + j + 1]
                } else {
                    lengths[(i + 1) * width + j].max(lengths[i * width + j + 1])
                };
            }
        }
        let (mut i, mut j) = (0, 0);
        while i < a.len() && j < b.len() {
            if fits(&a[i], &b[j]) {
                pairs.push((start + i, start + j));
                (i, j) = (i + 1, j + 1);
            } else if lengths[(i + 1) * width + j] >= lengths[i * width + j + 1] {
                i += 1;
            } else {
                j += 1;
            }
        }
    }
    pairs.extend((0..end).rev().map(|k| (first.len() - 1 - k, second.len() - 1 - k)));
    pairs
}

/// What people call a tier of syllables or of characters, the likelier first.
const SYLLABLES: [&str; 12] = [
    "syllables",
    "syllable",
    "syl",
    "characters",
    "character",
    "hanzi",
    "pinyin",
    "zhuyin",
    "bopomofo",
    "words",
    "word",
    "text",
];

/// The tier that holds the syllables of a script: the one called `syllables`; else the one whose labels fit one for
/// one, by the likelihood of its name where several do; else, where nothing fits, the only one there is or the one with
/// the likeliest name, so that [`match_labels`] can say where they part. Nothing where there is nothing like it.
#[must_use]
pub fn fitting_tier<'a, T>(timing: &'a Timing, expected: &[T], fits: impl Fn(&T, &str) -> bool) -> Option<&'a Tier> {
    let rank = |tier: &Tier| {
        let name = tier.name.trim().to_lowercase();
        SYLLABLES.iter().position(|known| *known == name).unwrap_or(SYLLABLES.len())
    };
    let mut likely: Vec<&Tier> = timing.tiers.iter().filter(|t| !t.is_of_points() && t.name != "shapes").collect();
    likely.sort_by_key(|tier| rank(tier));
    let fitting = || likely.iter().copied().find(|tier| first_parting(expected, tier, &fits).is_none());
    let named = || likely.first().copied().filter(|tier| rank(tier) < SYLLABLES.len());
    timing.tier("syllables").or_else(fitting).or_else(|| timing.syllables()).or_else(named)
}

/// Makes sure that the labels of a tier are what is expected, one for one.
///
/// # Errors
/// With the first place where they part: its number and time, what the script has there, what the tier has, and the
/// neighbours on both sides.
pub fn match_labels<T>(
    expected: &[T],
    labels: &Tier,
    fits: impl Fn(&T, &str) -> bool,
    show: impl Fn(&T) -> String,
) -> Result<()> {
    let Some(Parting { index, time, found }) = first_parting(expected, labels, &fits) else {
        return Ok(());
    };
    let name = &labels.name;
    let what = match (expected.get(index).map(&show), found) {
        (Some(script), Some(label)) => format!(
            "syllable {} of the script is `{script}`, and the tier `{name}` has `{label}` there, at {time:.3} s",
            index + 1
        ),
        (Some(script), None) => format!(
            "the tier `{name}` ends after {index} labels, at {time:.3} s, and the script goes on with `{script}`"
        ),
        (None, label) => format!(
            "the script ends after {index} syllables, and the tier `{name}` goes on with `{}`, at {time:.3} s",
            label.unwrap_or_default()
        ),
    };
    let spoken: Vec<&Interval> = labels.spoken().collect();
    let fit = |e: usize, l: usize| expected.get(e).zip(spoken.get(l)).is_some_and(|(e, l)| fits(e, &l.label));
    let hint = if fit(index + 1, index) {
        "; has the tier left one out?"
    } else if fit(index, index + 1) {
        "; has the script left one out?"
    } else {
        ""
    };
    let script = around(index, expected.len(), |i| show(&expected[i]));
    let tier = around(index, spoken.len(), |i| spoken[i].label.clone());
    Err(Fault::new(what.replace('\n', " ")).help(format!("script: {script}; tier: {tier}{hint}").replace('\n', " ")))
}

/// The neighbours of a place, itself in brackets.
fn around(index: usize, length: usize, show: impl Fn(usize) -> String) -> String {
    let (from, to) = (index.saturating_sub(CONTEXT).min(length), (index + CONTEXT + 1).min(length));
    let mut words: Vec<String> =
        (from..to).map(|i| if i == index { format!("[{}]", show(i)) } else { show(i) }).collect();
    if from > 0 {
        words.insert(0, "…".to_owned());
    }
    words.push(
        if index >= length {
            "[end]"
        } else if to < length {
            "…"
        } else {
            ""
        }
        .to_owned(),
    );
    words.join(" ").trim_end().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tier(labels: &str) -> Tier {
        let intervals = labels.split(' ').enumerate().map(|(i, l)| Interval::new(i as f64, i as f64 + 0.5, l));
        Tier { name: "syllables".into(), intervals: intervals.collect() }
    }

    fn fault(script: &str, labels: &str) -> Option<String> {
        let script: Vec<&str> = script.split(' ').collect();
        match_labels(&script, &tier(labels), |e, l| *e == l, |e| (*e).to_owned()).err().map(|f| f.to_string())
    }

    #[test]
    fn a_tier_that_says_the_script_matches_and_its_marks_of_silence_do_not_count() {
        assert_eq!(fault("ni hao ma", "# ni sp hao <sil> ma [SIL]"), None);
    }

    #[test]
    fn the_tier_that_fits_is_found_under_any_name() {
        let named = |name: &str, labels: &str| Tier { name: name.into(), ..tier(labels) };
        let found = |tiers: &[Tier]| {
            let timing = Timing { tiers: tiers.to_vec(), ..Timing::default() };
            fitting_tier(&timing, &["ni", "hao"], |e, l| *e == l).map(|tier| tier.name.clone())
        };
        let (fits, other) = (|name| named(name, "ni sil hao"), |name| named(name, "x"));
        assert_eq!(found(&[other("syllables"), fits("mine")]).as_deref(), Some("syllables"));
        assert_eq!(found(&[other("phones"), fits("mine"), other("words")]).as_deref(), Some("mine"));
        assert_eq!(found(&[fits("mine"), fits("Pinyin")]).as_deref(), Some("Pinyin"));
        assert_eq!(found(&[other("phones"), other("Words")]).as_deref(), Some("Words"));
        assert_eq!(found(&[other("anything"), named("shapes", "m")]).as_deref(), Some("anything"));
        assert_eq!(found(&[other("one"), other("two")]), None);
    }

    #[test]
    fn the_first_place_where_they_part_is_shown_with_its_neighbours() {
        let said = fault("a b c d e f g h", "a b c d X f g h").unwrap();
        assert!(said.contains("syllable 5 of the script is `e`") && said.contains("`X` there, at 4.000 s"), "{said}");
        assert!(said.contains("script: … b c d [e] f g h; tier: … b c d [X] f g h"), "{said}");
    }

    #[test]
    fn a_missing_label_and_one_too_many_are_told_from_a_wrong_one() {
        assert!(fault("a b c", "a c").unwrap().ends_with("script: a [b] c; tier: a [c]; has the tier left one out?"));
        assert!(fault("a c", "a b c").unwrap().ends_with("has the script left one out?"));
    }

    #[test]
    fn what_an_edit_has_left_alone_is_found_again() {
        let pairs = |a: &str, b: &str| {
            let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
            common(&a, &b, |a, b| a == b)
        };
        assert_eq!(pairs("abcd", "abxd"), [(0, 0), (1, 1), (3, 3)]);
        assert_eq!(pairs("abcbd", "acbbd"), [(0, 0), (2, 1), (3, 3), (4, 4)]);
        assert_eq!(pairs("", "ab"), []);
        assert_eq!(pairs("aXbYc", "abc"), [(0, 0), (2, 1), (4, 2)]);
    }

    #[test]
    fn either_may_end_first() {
        let said = fault("a b c", "a b").unwrap();
        assert!(said.contains("ends after 2 labels, at 1.500 s") && said.contains("tier: a b [end]"), "{said}");
        let said = fault("a", "a b").unwrap();
        assert!(said.contains("goes on with `b`, at 1.000 s") && said.contains("script: a [end]"), "{said}");
    }
}

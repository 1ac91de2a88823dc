//! Where espeak says that one phone of a syllable ends and the next begins.

use lianpu::script::{Lang, Syllable};

/// For each phone where it ends, where that is known.
pub fn cuts(syllable: &Syllable, phones: &[&'static str], espeak: &[(String, f64, f64)]) -> Vec<Option<f64>> {
    let mut cuts = vec![None; phones.len()];
    let Some(last) = espeak.last() else { return cuts };
    match syllable.lang {
        Lang::Zh => {
            let initial = syllable.sound().is_some_and(|s| s.initial().is_some());
            if initial && phones.len() > 1 && espeak.len() > 1 {
                cuts[0] = Some(espeak[0].2);
            }
            let coda = matches!(phones.last(), Some(&"n" | &"ng")) && phones.len() > 1;
            if coda && matches!(last.0.as_str(), "n" | "N") && espeak.len() > 1 + usize::from(initial) {
                cuts[phones.len() - 2] = Some(last.1);
            }
        }
        Lang::En => english(phones, espeak, &mut cuts),
    }
    cuts
}

/// Lays the phones of the dictionary beside those of espeak, as few changes apart as can be; where two alike phones
/// follow two alike ones there is a cut.
fn english(phones: &[&'static str], espeak: &[(String, f64, f64)], cuts: &mut [Option<f64>]) {
    let (n, m) = (phones.len(), espeak.len());
    let mut cost = vec![vec![0_u32; m + 1]; n + 1];
    let differ = |i: usize, j: usize| match alike(phones[i], &espeak[j].0) {
        2 => 0,
        1 => 2,
        _ => 5,
    };
    for i in 0..=n {
        for j in 0..=m {
            cost[i][j] = match (i, j) {
                (0, _) => 3 * j as u32,
                (_, 0) => 3 * i as u32,
                _ => (cost[i - 1][j - 1] + differ(i - 1, j - 1)).min(cost[i - 1][j] + 3).min(cost[i][j - 1] + 3),
            };
        }
    }
    let mut with = vec![None; n];
    let (mut i, mut j) = (n, m);
    while i > 0 && j > 0 {
        if cost[i][j] == cost[i - 1][j - 1] + differ(i - 1, j - 1) {
            (i, j) = (i - 1, j - 1);
            with[i] = (differ(i, j) < 5).then_some(j);
        } else if cost[i][j] == cost[i - 1][j] + 3 {
            i -= 1;
        } else {
            j -= 1;
        }
    }
    for i in 0..n.saturating_sub(1) {
        if let (Some(a), Some(b)) = (with[i], with[i + 1])
            && b == a + 1
        {
            cuts[i] = Some(espeak[a].2);
        }
    }
}

/// 2: the same; 1: of a kind, vowel and vowel, stop and stop.
fn alike(arpabet: &str, espeak: &str) -> u32 {
    let (name, class) = of_espeak(espeak);
    let own = match arpabet {
        "P" | "T" | "K" | "B" | "D" | "G" | "CH" | "JH" => 's',
        "F" | "V" | "TH" | "DH" | "S" | "Z" | "SH" | "ZH" | "HH" => 'f',
        "M" | "N" | "NG" | "L" | "R" | "W" | "Y" => 'n',
        _ => 'v',
    };
    if name == arpabet { 2 } else { u32::from(class == own) }
}

fn of_espeak(phone: &str) -> (&'static str, char) {
    let p = phone.trim_start_matches(['\'', ',', '%', '=']);
    match p {
        "p" => ("P", 's'),
        "t" | "t#" | "*" | "t2" | "?" => ("T", 's'),
        "k" => ("K", 's'),
        "b" => ("B", 's'),
        "d" | "d#" => ("D", 's'),
        "g" => ("G", 's'),
        "tS" => ("CH", 's'),
        "dZ" => ("JH", 's'),
        "f" => ("F", 'f'),
        "v" => ("V", 'f'),
        "T" => ("TH", 'f'),
        "D" => ("DH", 'f'),
        "s" => ("S", 'f'),
        "z" | "z#" => ("Z", 'f'),
        "S" => ("SH", 'f'),
        "Z" => ("ZH", 'f'),
        "h" => ("HH", 'f'),
        "m" | "m-" => ("M", 'n'),
        "n" | "n-" => ("N", 'n'),
        "N" => ("NG", 'n'),
        "l" | "l/" | "L" => ("L", 'n'),
        "r" | "r-" | "r/" => ("R", 'n'),
        "w" => ("W", 'n'),
        "j" => ("Y", 'n'),
        "A:" | "A" | "0" | "A@" => ("AA", 'v'),
        "a" | "aa" | "a#" => ("AE", 'v'),
        "V" | "@" | "a2" | "@2" | "I2" | "@5" => ("AH", 'v'),
        "O:" | "O" | "O2" | "O@" => ("AO", 'v'),
        "E" | "E2" | "e@" => ("EH", 'v'),
        "3:" | "3" | "@L" => ("ER", 'v'),
        "I" | "I#" | "i@" => ("IH", 'v'),
        "i:" | "i" => ("IY", 'v'),
        "U" | "U@" => ("UH", 'v'),
        "u:" | "u" => ("UW", 'v'),
        "aU" => ("AW", 'v'),
        "aI" | "aI@" | "aI3" => ("AY", 'v'),
        "eI" => ("EY", 'v'),
        "oU" | "@U" => ("OW", 'v'),
        "OI" => ("OY", 'v'),
        _ => ("", if p.starts_with(|c: char| "aeiouAEIOUV@30".contains(c)) { 'v' } else { 'n' }),
    }
}

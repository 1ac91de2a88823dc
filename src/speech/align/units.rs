//! The sounds that are told apart, and how long each usually lasts.
//!
//! A phone of Mandarin or English is one unit or two: a stop is its closure and its burst, a diphthong of English where
//! it starts and where it ends. Closures are one unit in both languages (but for the voiced stops of English, in which
//! the voice goes on), everything else each has for itself.

/// A unit's number: its place in [`UNITS`].
pub type Unit = u8;

/// What is known of a unit beforehand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kind {
    /// Its name; small letters are English.
    pub name: &'static str,
    /// How long it usually lasts in read speech at 4.5 syllables a second, in ms.
    pub usual: f32,
    /// The standard deviation of the logarithm of how long it lasts.
    pub spread: f32,
    /// The shortest it can be, in ms.
    pub least: f32,
}

const fn unit(name: &'static str, usual: f32, spread: f32, least: f32) -> Kind {
    Kind { name, usual, spread, least }
}

/// Silence.
pub const SILENCE: Unit = 0;
/// Any voice: what is said that is not in the script, and characters whose reading is not known.
pub const ANY: Unit = 1;
/// The closure of a stop.
#[cfg(test)]
pub(crate) const CLOSURE: Unit = 2;

/// Every unit. The times are for people who read: those of a synthesiser are others, and were tried.
pub const UNITS: [Kind; 83] = [
    unit("SIL", 200.0, 1.0, 30.0),
    unit("ANY", 200.0, 0.6, 40.0),
    unit("CL", 45.0, 0.5, 10.0),
    unit("B", 15.0, 0.4, 5.0),
    unit("D", 15.0, 0.4, 5.0),
    unit("G", 22.0, 0.4, 5.0),
    unit("P", 65.0, 0.4, 20.0),
    unit("T", 60.0, 0.4, 20.0),
    unit("K", 70.0, 0.4, 20.0),
    unit("Z", 50.0, 0.45, 15.0),
    unit("ZH", 45.0, 0.45, 15.0),
    unit("J", 55.0, 0.45, 15.0),
    unit("C", 95.0, 0.35, 30.0),
    unit("CH", 95.0, 0.35, 30.0),
    unit("Q", 100.0, 0.35, 30.0),
    unit("S", 105.0, 0.35, 35.0),
    unit("SH", 105.0, 0.35, 35.0),
    unit("X", 110.0, 0.35, 35.0),
    unit("F", 90.0, 0.4, 30.0),
    unit("H", 75.0, 0.4, 20.0),
    unit("M", 65.0, 0.4, 20.0),
    unit("N", 60.0, 0.4, 20.0),
    unit("L", 55.0, 0.4, 15.0),
    unit("R", 60.0, 0.4, 15.0),
    unit("A", 110.0, 0.5, 25.0),
    unit("O", 80.0, 0.5, 20.0),
    unit("E", 100.0, 0.5, 20.0),
    unit("EH", 85.0, 0.5, 20.0),
    unit("I", 85.0, 0.55, 20.0),
    unit("U", 80.0, 0.55, 20.0),
    unit("V", 90.0, 0.5, 20.0),
    unit("IH", 110.0, 0.45, 25.0),
    unit("ER", 140.0, 0.4, 40.0),
    unit("NN", 65.0, 0.5, 15.0),
    unit("NG", 75.0, 0.5, 15.0),
    // English.
    unit("vcl", 50.0, 0.5, 10.0),
    unit("b", 12.0, 0.5, 5.0),
    unit("d", 14.0, 0.5, 5.0),
    unit("g", 20.0, 0.5, 5.0),
    unit("p", 40.0, 0.6, 5.0),
    unit("t", 40.0, 0.6, 5.0),
    unit("k", 45.0, 0.6, 5.0),
    unit("ch", 75.0, 0.4, 20.0),
    unit("jh", 50.0, 0.45, 15.0),
    unit("f", 90.0, 0.4, 25.0),
    unit("v", 55.0, 0.45, 15.0),
    unit("th", 80.0, 0.45, 20.0),
    unit("dh", 40.0, 0.5, 10.0),
    unit("s", 100.0, 0.4, 25.0),
    unit("z", 75.0, 0.45, 20.0),
    unit("sh", 105.0, 0.4, 30.0),
    unit("zh", 75.0, 0.45, 20.0),
    unit("hh", 55.0, 0.45, 15.0),
    unit("m", 65.0, 0.45, 20.0),
    unit("n", 55.0, 0.5, 15.0),
    unit("ng", 65.0, 0.5, 20.0),
    unit("l", 60.0, 0.5, 15.0),
    unit("r", 60.0, 0.5, 15.0),
    unit("w", 60.0, 0.45, 15.0),
    unit("y", 55.0, 0.45, 15.0),
    unit("aa", 110.0, 0.5, 25.0),
    unit("ae", 115.0, 0.5, 25.0),
    unit("ah", 65.0, 0.55, 15.0),
    unit("ao", 115.0, 0.5, 25.0),
    unit("eh", 85.0, 0.5, 20.0),
    unit("er", 90.0, 0.55, 20.0),
    unit("ih", 65.0, 0.5, 15.0),
    unit("iy", 90.0, 0.55, 20.0),
    unit("uh", 65.0, 0.5, 15.0),
    unit("uw", 90.0, 0.55, 20.0),
    unit("aw1", 80.0, 0.5, 20.0),
    unit("aw2", 70.0, 0.5, 15.0),
    unit("ay1", 80.0, 0.5, 20.0),
    unit("ay2", 65.0, 0.5, 15.0),
    unit("ey1", 65.0, 0.5, 15.0),
    unit("ey2", 65.0, 0.5, 15.0),
    unit("ow1", 70.0, 0.5, 15.0),
    unit("ow2", 65.0, 0.5, 15.0),
    unit("oy1", 90.0, 0.5, 20.0),
    unit("oy2", 70.0, 0.5, 15.0),
    // Stops at the end of English words, hardly released or not at all.
    unit("p-", 15.0, 0.6, 5.0),
    unit("t-", 20.0, 0.6, 5.0),
    unit("k-", 25.0, 0.6, 5.0),
];

/// A unit by its name.
///
/// # Panics
/// When there is none: names are written here and nowhere else.
fn named(name: &str) -> Unit {
    UNITS.iter().position(|u| u.name == name).map_or(ANY, |at| at as Unit)
}

/// A phone and the units it is made of.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Spelled {
    /// Its name, as [`crate::script::segments`] gives it.
    pub phone: &'static str,
    /// One unit or two.
    pub units: Vec<Unit>,
}

/// The phones of a syllable or word, as [`crate::script::segments`] gives them, with their units.
#[must_use]
pub fn spelled(phones: &[&'static str]) -> Vec<Spelled> {
    let count = phones.len();
    let one = |(place, phone): (usize, &&'static str)| {
        let (is_first, is_last) = (place == 0 && count > 1, place + 1 == count && count > 1);
        let names = mandarin(phone, is_first).or_else(|| english(phone, is_last)).unwrap_or(&["ANY"]);
        Spelled { phone, units: names.iter().map(|n| named(n)).collect() }
    };
    phones.iter().enumerate().map(one).collect()
}

/// The units of a phone of Mandarin.
fn mandarin(phone: &str, is_first: bool) -> Option<&'static [&'static str]> {
    Some(match phone {
        "b" => &["CL", "B"],
        "p" => &["CL", "P"],
        "d" => &["CL", "D"],
        "t" => &["CL", "T"],
        "g" => &["CL", "G"],
        "k" => &["CL", "K"],
        "z" => &["CL", "Z"],
        "zh" => &["CL", "ZH"],
        "j" => &["CL", "J"],
        "c" => &["CL", "C"],
        "ch" => &["CL", "CH"],
        "q" => &["CL", "Q"],
        "s" => &["S"],
        "sh" => &["SH"],
        "x" => &["X"],
        "f" => &["F"],
        "h" => &["H"],
        "m" => &["M"],
        "n" if is_first => &["N"],
        "n" => &["NN"],
        "l" => &["L"],
        "r" => &["R"],
        "a" => &["A"],
        "o" => &["O"],
        "e" => &["E"],
        "ê" => &["EH"],
        "i" => &["I"],
        "u" => &["U"],
        "ü" => &["V"],
        "ih" => &["IH"],
        "er" => &["ER"],
        "ng" => &["NG"],
        _ => return None,
    })
}

/// The units of a phone of English.
fn english(phone: &str, is_last: bool) -> Option<&'static [&'static str]> {
    Some(match phone {
        "P" if is_last => &["CL", "p-"],
        "T" if is_last => &["CL", "t-"],
        "K" if is_last => &["CL", "k-"],
        "B" => &["vcl", "b"],
        "D" => &["vcl", "d"],
        "G" => &["vcl", "g"],
        "P" => &["CL", "p"],
        "T" => &["CL", "t"],
        "K" => &["CL", "k"],
        "CH" => &["CL", "ch"],
        "JH" => &["vcl", "jh"],
        "F" => &["f"],
        "V" => &["v"],
        "TH" => &["th"],
        "DH" => &["dh"],
        "S" => &["s"],
        "Z" => &["z"],
        "SH" => &["sh"],
        "ZH" => &["zh"],
        "HH" => &["hh"],
        "M" => &["m"],
        "N" => &["n"],
        "NG" => &["ng"],
        "L" => &["l"],
        "R" => &["r"],
        "W" => &["w"],
        "Y" => &["y"],
        "AA" => &["aa"],
        "AE" => &["ae"],
        "AH" => &["ah"],
        "AO" => &["ao"],
        "EH" => &["eh"],
        "ER" => &["er"],
        "IH" => &["ih"],
        "IY" => &["iy"],
        "UH" => &["uh"],
        "UW" => &["uw"],
        "AW" => &["aw1", "aw2"],
        "AY" => &["ay1", "ay2"],
        "EY" => &["ey1", "ey2"],
        "OW" => &["ow1", "ow2"],
        "OY" => &["oy1", "oy2"],
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_unit_is_used_by_some_phone_and_none_is_called_twice() {
        let mandarin = "b p m f d t n l g k h j q x zh ch sh r z c s a o e ê i u ü ih er ng";
        let english =
            "AA AE AH AO AW AY B CH D DH EH ER EY F G HH IH IY JH K L M N NG OW OY P R S SH T TH UH UW V W Y Z ZH";
        let mut used = vec![SILENCE, ANY];
        for phone in mandarin.split(' ').chain(english.split(' ')) {
            for phones in [vec![phone, "a"], vec!["a", phone], vec![phone]] {
                for spelled in spelled(&phones) {
                    assert!((1..=2).contains(&spelled.units.len()));
                    assert!(!spelled.units.contains(&ANY), "{phone}");
                    used.extend(spelled.units);
                }
            }
        }
        for (at, kind) in UNITS.iter().enumerate() {
            assert_eq!(UNITS.iter().position(|k| k.name == kind.name), Some(at), "{}", kind.name);
            assert!(used.contains(&(at as Unit)), "{}", kind.name);
        }
    }
}

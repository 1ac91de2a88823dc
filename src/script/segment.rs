//! The phones that a syllable is made of, in the order they are spoken: what a recording is searched for, and what the
//! tier `phones` holds.
//!
//! Phones of Mandarin have the names of Hanyu Pinyin: the 21 initials; `a o e ê i u ü`, `ih` for the empty rime of zhi
//! and zi, `er`; `n ng` at the end. Those of English have their names in ARPAbet, in capitals.

use super::sound::Sound;
use super::syllable::{Lang, Syllable};

/// The phones of a syllable or English word; none where its reading is not known.
#[must_use]
pub fn segments(syllable: &Syllable) -> Vec<&'static str> {
    match syllable.lang {
        Lang::En => syllable.phones.iter().map(|p| p.name()).collect(),
        Lang::Zh => syllable.sound().map(of_sound).unwrap_or_default(),
    }
}

/// The phones of a toneless syllable of Mandarin.
pub(super) fn of_sound(sound: Sound) -> Vec<&'static str> {
    // Interjections have no rime, and a lone ㄇ is no ㄇ with the empty one.
    match sound.hanyu() {
        "m" => return vec!["m"],
        "n" => return vec!["n"],
        "ng" => return vec!["ng"],
        "hm" => return vec!["h", "m"],
        "hng" => return vec!["h", "ng"],
        "r" => return vec!["er"],
        _ => {}
    }
    let mut out: Vec<&'static str> = sound.initial().and_then(initial).into_iter().collect();
    out.extend_from_slice(rime(sound.rime(), out.is_empty()));
    out
}

fn initial(zhuyin: char) -> Option<&'static str> {
    const NAMES: [&str; 21] =
        ["b", "p", "m", "f", "d", "t", "n", "l", "g", "k", "h", "j", "q", "x", "zh", "ch", "sh", "r", "z", "c", "s"];
    NAMES.get((u32::from(zhuyin).checked_sub(u32::from('ㄅ'))?) as usize).copied()
}

/// The phones of a final. After a glide ㄣ and ㄥ lose their vowel but for wen and weng; ㄧㄢ and ㄩㄢ have ê.
fn rime(zhuyin: &str, alone: bool) -> &'static [&'static str] {
    match zhuyin {
        "" => &["ih"],
        "ㄚ" => &["a"],
        "ㄛ" => &["o"],
        "ㄜ" => &["e"],
        "ㄝ" => &["ê"],
        "ㄞ" => &["a", "i"],
        "ㄟ" => &["ê", "i"],
        "ㄠ" => &["a", "u"],
        "ㄡ" => &["o", "u"],
        "ㄢ" => &["a", "n"],
        "ㄣ" => &["e", "n"],
        "ㄤ" => &["a", "ng"],
        "ㄥ" => &["e", "ng"],
        "ㄦ" => &["er"],
        "ㄧ" => &["i"],
        "ㄧㄚ" => &["i", "a"],
        "ㄧㄛ" => &["i", "o"],
        "ㄧㄝ" => &["i", "ê"],
        "ㄧㄞ" => &["i", "a", "i"],
        "ㄧㄠ" => &["i", "a", "u"],
        "ㄧㄡ" => &["i", "o", "u"],
        "ㄧㄢ" => &["i", "ê", "n"],
        "ㄧㄣ" => &["i", "n"],
        "ㄧㄤ" => &["i", "a", "ng"],
        "ㄧㄥ" => &["i", "ng"],
        "ㄨ" => &["u"],
        "ㄨㄚ" => &["u", "a"],
        "ㄨㄛ" => &["u", "o"],
        "ㄨㄞ" => &["u", "a", "i"],
        "ㄨㄟ" => &["u", "ê", "i"],
        "ㄨㄢ" => &["u", "a", "n"],
        "ㄨㄣ" => &["u", "e", "n"],
        "ㄨㄤ" => &["u", "a", "ng"],
        "ㄨㄥ" if alone => &["u", "e", "ng"],
        "ㄨㄥ" => &["u", "ng"],
        "ㄩ" => &["ü"],
        "ㄩㄝ" => &["ü", "ê"],
        "ㄩㄢ" => &["ü", "ê", "n"],
        "ㄩㄣ" => &["ü", "n"],
        "ㄩㄥ" => &["ü", "u", "ng"],
        _ => &[],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(hanyu: &str) -> String {
        of_sound(Sound::from_hanyu(hanyu).unwrap()).join(" ")
    }

    #[test]
    fn every_syllable_of_the_table_has_its_phones() {
        for sound in Sound::all() {
            let phones = of_sound(sound);
            assert!((1..=4).contains(&phones.len()), "{}: {phones:?}", sound.hanyu());
            assert_eq!(
                phones.len() > usize::from(sound.initial().is_some()),
                !sound.is_interjection() || !matches!(sound.hanyu(), "m" | "n"),
                "{}",
                sound.hanyu()
            );
        }
    }

    #[test]
    fn spelling_and_sound_are_told_apart() {
        assert_eq!(
            (of("nin"), of("zhi"), of("er"), of("r")),
            ("n i n".into(), "zh ih".into(), "er".into(), "er".into())
        );
        assert_eq!((of("weng"), of("dong"), of("xiong")), ("u e ng".into(), "d u ng".into(), "x ü u ng".into()));
        assert_eq!((of("quan"), of("yan"), of("liu")), ("q ü ê n".into(), "i ê n".into(), "l i o u".into()));
    }
}

//! The script room from outside: the whole table of syllables in every spelling, polyphones in real sentences, numbers,
//! romanisations, English, and the command that prints them.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use crate::support::test_data;
use std::fmt::Write as _;

use lianpu::pose::MouthShape;
use lianpu::script::{Lang, Pause, Reading, Sound, Syllable, System, onsets, reading, readings_of, syllables};
use proptest::prelude::*;

/// The rows of `core411`: Hanyu, Zhuyin, Tongyong, shapes.
fn core() -> Vec<[&'static str; 4]> {
    let table = include_str!("../../src/script/syllables.csv");
    let rows = table.lines().map(|l| l.split(',').collect::<Vec<_>>()).filter(|c| c[5] == "core411");
    rows.map(|c| [c[0], c[1], c[2], c[4]]).collect()
}

fn shapes(said: &[Syllable]) -> String {
    let shapes = said.iter().flat_map(|s| &s.shapes).map(MouthShape::to_string);
    shapes.collect::<Vec<_>>().join(" ")
}

fn said(text: &str) -> Vec<Syllable> {
    syllables(text, System::Auto).expect("a text that can be read")
}

/// Pinyin of Mandarin, the word itself for English, parted by spaces.
fn pinyin(text: &str) -> String {
    let said = said(text);
    said.iter().map(|s| if s.lang == Lang::Zh { &*s.pinyin } else { &*s.text }).collect::<Vec<_>>().join(" ")
}

fn text_of(text: &str) -> String {
    said(text).iter().map(|s| s.text.as_str()).collect()
}

/// A syllable of Hanyu Pinyin with a tone mark where it belongs: on a, o, e, ê, else on the last vowel.
fn marked(hanyu: &str, tone: usize) -> String {
    let vowel = hanyu.find(['a', 'o', 'e', 'ê']).or_else(|| hanyu.rfind(['i', 'u', 'ü'])).expect("a vowel");
    let place = vowel + hanyu[vowel..].chars().next().map_or(1, char::len_utf8);
    let mut text = hanyu.to_owned();
    text.insert(place, ['\u{304}', '\u{301}', '\u{30C}', '\u{300}'][tone - 1]);
    text
}

#[test]
fn all_411_syllables_have_the_shapes_of_the_table_in_every_spelling() {
    assert_eq!(core().len(), 411);
    for [hanyu, zhuyin, tongyong, want] in core() {
        let check = |text: &str, system| {
            let found = syllables(text, system).unwrap();
            assert_eq!((found.len(), shapes(&found).as_str()), (1, want), "{text} in {system}");
            found[0].clone()
        };
        check(hanyu, System::Hanyu);
        check(&hanyu.to_uppercase(), System::Hanyu);
        check(&hanyu.replace('ü', "v"), System::Hanyu);
        check(&hanyu.replace('ü', "u:"), System::Hanyu);
        for tone in 1..=4 {
            assert_eq!(check(&marked(hanyu, tone), System::Hanyu).pinyin, format!("{hanyu}{tone}"));
        }
        for tone in 1..=5 {
            let found = check(&format!("{hanyu}{tone}"), System::Hanyu);
            assert_eq!(found.pinyin, format!("{hanyu}{tone}"));
            assert_eq!(check(&found.zhuyin, System::Zhuyin).pinyin, found.pinyin, "{}", found.zhuyin);
            assert_eq!(check(&found.zhuyin, System::Auto).pinyin, found.pinyin, "{}", found.zhuyin);
        }
        check(zhuyin, System::Zhuyin);
        if hanyu != "ê" {
            assert_eq!(check(tongyong, System::Tongyong).pinyin, hanyu);
            assert_eq!(check(&format!("{tongyong}4"), System::Tongyong).pinyin, format!("{hanyu}4"));
        }
    }
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn marked_polyphones_in_real_sentences_have_the_right_mouth() {
    let Some(folder) = test_data::find("mandarin/polyphones") else { return };
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap();
    let (sentences, labels) = (read("dev.sent"), read("dev.lb"));
    let (mut all, mut right, mut toned, mut wrong) = (0, 0, 0, String::new());
    for (sentence, label) in sentences.lines().zip(labels.lines()) {
        let at = sentence.find('▁').unwrap();
        let found = syllables(&sentence.replace('▁', ""), System::Auto).unwrap();
        let found = found.iter().find(|s| s.span.start == at).unwrap();
        let want = reading(&label.replace("u:", "ü"), System::Hanyu).unwrap();
        all += 1;
        right += usize::from(found.shapes == want.shapes());
        toned += usize::from(found.pinyin == want.pinyin());
        if found.shapes != want.shapes() {
            writeln!(wrong, "{} not {label}: {sentence}", found.pinyin).unwrap();
        }
    }
    let share = |n: usize| 100.0 * n as f64 / all as f64;
    println!("{wrong}{all} sentences: mouth {:.2} %, mouth and tone {:.2} %", share(right), share(toned));
    assert!(share(right) >= 98.8, "mouth shapes right in {:.2} %", share(right));
}

#[test]
fn traditional_and_simplified_scripts_sound_the_same() {
    for (traditional, simplified) in [
        ("銀行行長說話", "银行行长说话"),
        ("音樂會很快樂", "音乐会很快乐"),
        ("頭髮長長了", "头发长长了"),
        ("他還沒還書", "他还没还书"),
        ("乾淨的乾隆皇帝", "干净的乾隆皇帝"),
        ("看著著名的著作", "看着著名的著作"),
        ("重慶的重要會計", "重庆的重要会计"),
        ("首都都有", "首都都有"),
    ] {
        assert_eq!(pinyin(traditional), pinyin(simplified), "{traditional}");
    }
}

#[test]
fn readings_are_those_of_the_dictionary_without_sandhi() {
    for (text, want) in [
        ("您好", "nin2 hao3"),
        ("你好", "ni3 hao3"),
        ("一个不是", "yi1 ge4 bu4 shi4"),
        ("绿女", "lü4 nü3"),
        ("女儿和儿子", "nü3 er2 he2 er2 zi5"),
        ("花儿", "hua1 r5"),
        ("一点儿", "yi1 dian3 r5"),
        ("慢慢地走", "man4 man4 de5 zou3"),
        ("他得去", "ta1 dei3 qu4"),
        ("跑得快", "pao3 de5 kuai4"),
        ("睡着了", "shui4 zhao2 le5"),
        ("看着", "kan4 zhe5"),
        ("了解", "liao3 jie3"),
        ("我们都去首都", "wo3 men5 dou1 qu4 shou3 du1"),
    ] {
        assert_eq!(pinyin(text), want, "{text}");
    }
}

#[test]
fn the_suffix_of_erhua_is_a_syllable_of_its_own_with_an_open_mouth() {
    for text in ["玩儿", "玩兒", "wánr", "wanr2"] {
        let found = said(text);
        assert_eq!(found.len(), 2, "{text}");
        assert_eq!((found[1].pinyin.as_str(), &*found[1].shapes), ("r5", &[MouthShape::H][..]), "{text}");
    }
}

#[test]
fn numbers_are_read_by_what_they_are() {
    for (text, want) in [
        ("2024年", "二零二四年"),
        ("100", "一百"),
        ("3.14", "三点一四"),
        ("50%", "百分之五十"),
        ("3:30", "三点三十分"),
        ("2024-11-22", "二零二四年十一月二十二日"),
        ("11/22", "十一月二十二日"),
        ("¥12.5", "十二点五元"),
        ("$3", "三美元"),
        ("3元", "三元"),
        ("13912345678", "一三九一二三四五六七八"),
        ("2个", "两个"),
        ("2個", "两個"),
        ("二〇二四", "二〇二四"),
        ("第2课", "第二课"),
        ("10点", "十点"),
        ("5-10人", "五到十人"),
        ("1990-1995年", "一九九零到一九九五年"),
    ] {
        assert_eq!(text_of(text), want, "{text}");
    }
    assert_eq!(pinyin("〇"), "ling2");
    assert_eq!(pinyin("there are 100"), "there are one hundred");
}

#[test]
fn a_script_says_which_romanisation_it_is_in_or_is_asked() {
    assert_eq!(pinyin("jhe shih syuesheng"), "zhe shi xue sheng");
    assert_eq!(pinyin("zhe ci"), "zhe ci");
    assert_eq!(pinyin("nǐhǎo, Xī'ān!"), "ni3 hao3 xi1 an1");
    assert_eq!(pinyin("fangan fang'an"), "fan gan fang an");
    for text in ["ci", "si4", "wo e"] {
        let fault = syllables(text, System::Auto).unwrap_err();
        assert!(fault.advice().steps().next().is_some() && fault.line_number() == Some(1), "{fault}");
        assert!(syllables(text, System::Hanyu).is_ok() && syllables(text, System::Tongyong).is_ok(), "{text}");
    }
    assert_eq!(pinyin("ma fa"), "ma fa");
    let fault = syllables("ni hao\nhxllo", System::Hanyu).unwrap_err();
    assert_eq!(fault.line_number(), Some(2));
}

#[test]
fn languages_mix_in_one_script() {
    let found = said("他说hello。Nǐ hǎo, 用iPhone15打USB");
    let langs: Vec<_> = found.iter().map(|s| s.lang).collect();
    assert!(langs.contains(&Lang::En) && langs.contains(&Lang::Zh));
    assert_eq!(pinyin("他说hello"), "ta1 shuo1 hello");
    assert_eq!(pinyin("他说hao3"), "ta1 shuo1 hao3");
    assert_eq!(said("说USB")[1].phones.len(), 6);
    assert_eq!(shapes(&said("hello")), "h o u");
}

#[test]
fn english_comes_out_in_its_own_ten_letters() {
    let found = said("The quick brown fox jumps over the lazy dog, splendidly zorbing.");
    assert_eq!(found.len(), 11);
    for word in &found {
        assert!(word.lang == Lang::En && word.pinyin.is_empty() && word.zhuyin.is_empty());
        assert!(!word.shapes.is_empty() && word.shapes.windows(2).all(|w| w[0] != w[1]), "{}", word.text);
    }
    assert_eq!(found[8].pause_after, Pause::Comma);
    assert_eq!(found[10].pause_after, Pause::Sentence);
}

#[test]
fn a_label_can_replace_a_reading_and_is_known_to_belong_to_its_character() {
    let bank = &said("行")[0];
    let hang = reading("ㄏㄤˊ", System::Auto).unwrap();
    assert!(readings_of('行').contains(&hang));
    assert!(!readings_of('行').iter().any(|r| r.sound() == Sound::from_hanyu("ma").unwrap()));
    let read = bank.with_reading(&hang);
    assert_eq!((read.pinyin.as_str(), read.span.clone()), ("hang2", bank.span.clone()));
    assert_eq!(read.reading().as_ref().map(Reading::pinyin), Some("hang2".into()));
    assert_eq!(onsets(&read, Default::default()), [0.0, 0.623]);
}

#[test]
fn the_command_prints_one_line_a_syllable_or_json() {
    let lianpu = || assert_cmd::Command::cargo_bin("lianpu").unwrap();
    lianpu().args(["syllables", "您好"]).assert().success().stdout("您\tnin2\tㄋㄧㄣˊ\ti n\n好\thao3\tㄏㄠˇ\ta u\n");
    lianpu().args(["syllables", "-"]).write_stdin("hao\n").assert().success().stdout("hao\thao\tㄏㄠ\ta u\n");
    lianpu().args(["syllables", "--json", "您 ok"]).assert().success().stdout(concat!(
        r#"[{"text":"您","pinyin":"nin2","zhuyin":"ㄋㄧㄣˊ","shapes":["i","n"],"lang":"zh"},"#,
        r#"{"text":"ok","pinyin":"","zhuyin":"","shapes":["o","u","e","i"],"lang":"en"}]"#,
        "\n"
    ));
    lianpu().args(["syllables", "ci"]).assert().code(1);
    lianpu().args(["syllables", "--from", "klingon", "x"]).assert().code(2);
    lianpu().args(["syllables", "--from", "tongyong", "ci"]).assert().success().stdout("ci\tqi\tㄑㄧ\ti\n");
}

fn piece() -> impl Strategy<Value = String> {
    prop_oneof![
        "[ -~]{0,12}",
        "[一-龥]{0,6}",
        "[ㄅ-ㄩˊˇˋ˙]{0,6}",
        "[a-zāáǎàêü':0-9{}]{0,10}",
        "[0-9.,:/%¥$年个～-]{0,12}",
        any::<String>(),
    ]
}

proptest! {
    #[test]
    fn no_text_breaks_it_and_places_stay_inside_and_in_order(pieces in prop::collection::vec(piece(), 0..5)) {
        let text = pieces.concat();
        for system in System::ALL {
            let Ok(found) = syllables(&text, system) else { continue };
            let mut from = 0;
            for s in found {
                prop_assert!(text.get(s.span.clone()).is_some_and(|t| !t.is_empty()), "{:?}", s);
                prop_assert!(s.span.start >= from, "{:?}", s);
                prop_assert!((1..=4).contains(&s.shapes.len()) || s.lang == Lang::En, "{:?}", s);
                from = s.span.start;
            }
        }
    }
}

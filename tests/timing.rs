//! Every timing format: what is written reads back, what is damaged is named with its line, nothing panics.

#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod test_data;

use lianpu::timing::{Format, Interval, Tier, Timing, parse, read, write, write_tier};
use proptest::prelude::*;

type Labels<'a> = &'a [(f64, f64, &'a str)];

fn timing(tiers: &[(&str, Labels)], duration: f64) -> Timing {
    let tier = |(name, intervals): &(&str, Labels)| Tier {
        name: (*name).to_owned(),
        intervals: intervals.iter().map(|(s, e, l)| Interval::new(*s, *e, *l)).collect(),
    };
    Timing { duration, tiers: tiers.iter().map(tier).collect(), guessed: false }
}

/// The furthest that a time of one is from that of the other, in seconds; panics where anything else differs.
fn furthest(a: &Tier, b: &Tier) -> f64 {
    assert_eq!(a.intervals.len(), b.intervals.len(), "{a:?}\n{b:?}");
    let pairs = a.intervals.iter().zip(&b.intervals);
    pairs.fold(0.0, |far: f64, (x, y)| {
        assert_eq!(x.label, y.label);
        far.max((x.start - y.start).abs()).max((x.end - y.end).abs())
    })
}

/// Writes, reads and compares in every format.
fn round_trip(timing: &Timing) -> f64 {
    let mut far = 0.0_f64;
    for format in Format::ALL {
        let text = write(timing, format);
        let one = matches!(format, Format::Srt | Format::WebVtt);
        if one && timing.subtitles().is_none_or(|t| t.intervals.is_empty()) {
            continue;
        }
        let back = parse(text.as_bytes(), format).unwrap_or_else(|fault| panic!("{format}: {fault}\n{text}"));
        if one {
            far = far.max(furthest(timing.subtitles().unwrap(), back.syllables().unwrap()));
            continue;
        }
        assert_eq!(back.tiers.len(), timing.tiers.len(), "{format}\n{text}");
        assert!((back.duration - timing.duration).abs() < 1e-6 || timing.tiers.is_empty(), "{format}\n{text}");
        for (a, b) in timing.tiers.iter().zip(&back.tiers) {
            assert_eq!(a.name, b.name, "{format}");
            let apart = furthest(a, b);
            assert!(apart <= 0.5e-6 + 1e-9, "{format}: {apart}");
            far = far.max(apart);
        }
        assert_eq!(write(&back, format), text, "{format}: a second writing changes nothing");
    }
    far
}

fn label() -> impl Strategy<Value = String> {
    let piece = prop_oneof![
        "[a-z]{1,5}[1-5]?",
        "[您好夕陽ㄅㄆㄇ]{1,3}",
        Just("say \"so\"".to_owned()),
        Just("one\ntwo".to_owned()),
        Just("<b> & -->, ;!= [1]: 0.5".to_owned()),
        Just("\"".to_owned()),
        Just("NOTE".to_owned()),
        Just("&lt;".to_owned()),
    ];
    prop::collection::vec(piece, 1..4).prop_map(|pieces| pieces.join(" "))
}

fn tier_of(name: &'static str) -> impl Strategy<Value = Tier> {
    prop::collection::vec((0.0..2.0_f64, 0.0..3.0_f64, any::<bool>(), label()), 0..12).prop_map(move |parts| {
        let mut until = 0.0;
        let mut tier = Tier::new(name);
        for (gap, length, touches, label) in parts {
            let start = if touches { until } else { until + gap };
            until = start + length;
            tier.intervals.push(Interval::new(start, until, label));
        }
        tier
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_labels_at_any_times_come_back_from_every_format(
        a in tier_of("syllables"), b in tier_of("my \"own\", tier"), more in 0.0..5.0_f64,
    ) {
        let duration = a.end().max(b.end()) + more;
        let far = round_trip(&Timing { duration, tiers: vec![a, b], guessed: false });
        prop_assert!(far <= 0.0005 + 1e-9, "{}", far);
    }

    #[test]
    fn no_bytes_whatever_make_a_reader_panic(bytes in prop::collection::vec(any::<u8>(), 0..200), text in ".{0,200}") {
        for format in Format::ALL {
            let _ = parse(&bytes, format);
            let _ = parse(text.as_bytes(), format);
        }
        let _ = Format::sniff(&bytes);
    }
}

fn sample() -> Timing {
    let syllables: &[_] = &[(0.3, 0.6178, "nin2"), (0.6307, 1.001, "say \"hao\"\n好")];
    timing(&[("words", &[(0.3, 1.001, "您好")]), ("syllables", syllables), ("phones", &[])], 1.31)
}

#[test]
fn a_file_cut_at_any_byte_is_read_or_refused_and_never_more_than_was_there() {
    for format in Format::ALL {
        let whole = write(&sample(), format).into_bytes();
        let mut refused = 0;
        for cut in 0..whole.len() {
            match parse(&whole[..cut], format) {
                Ok(part) => {
                    for tier in &part.tiers {
                        let there = sample().tier(&tier.name).map_or(0, |t| t.intervals.len());
                        assert!(tier.intervals.len() <= there, "{format} cut at {cut}");
                    }
                }
                Err(fault) => {
                    refused += 1;
                    assert!(!fault.what().is_empty() && !fault.next_step().is_empty() || cut > 0, "{fault}");
                }
            }
            let _ = Format::sniff(&whole[..cut]);
        }
        // A table or subtitle cut between two lines is one that is whole; the others say how much there must be.
        let least = if matches!(format, Format::Srt | Format::WebVtt | Format::Csv) { 10 } else { whole.len() - 4 };
        assert!(refused >= least, "{format}: {refused} of {} refused", whole.len());
    }
}

#[test]
fn utf16_windows_line_ends_comments_and_odd_blanks_read_the_same() {
    let text = write(&sample(), Format::TextGrid);
    let same = |bytes: &[u8]| assert_eq!(parse(bytes, Format::TextGrid).unwrap(), sample());
    same(text.as_bytes());
    same(&[b"\xEF\xBB\xBF", text.as_bytes()].concat());
    same(text.replace('\n', "\r\n").as_bytes());
    same(text.replace(" = ", "=").as_bytes());
    same(text.replace("    item [1]:", "! said by me, \"twice\" = 3\n\n \t item [1]:").as_bytes());
    same(write(&sample(), Format::TextGridShort).as_bytes());
    let wide = |order: fn(u16) -> [u8; 2]| {
        std::iter::once(0xFEFF).chain(text.encode_utf16()).flat_map(order).collect::<Vec<u8>>()
    };
    same(&wide(u16::to_le_bytes));
    same(&wide(u16::to_be_bytes));
    assert_eq!(Format::sniff(&wide(u16::to_le_bytes)), Some(Format::TextGrid));
}

#[test]
fn every_damage_of_a_textgrid_is_named_with_its_line() {
    let whole = write(&sample(), Format::TextGrid);
    let line_of = |text: &str, what: &str| 1 + text.lines().position(|l| l.contains(what)).unwrap();
    // What is replaced, by what, the line of which text is named, what is said.
    for (old, new, at, said) in [
        ("xmin = 0.3\n            xmax = 0.6178", "xmin = 0.7\n            xmax = 0.6178", "xmin = 0.7", "ends before"),
        ("xmin = 0.6307", "xmin = 0.5", "xmin = 0.5", "holds until 0.6"),
        ("xmax = 0.6178", "xmax = nan", "xmax = nan", "found `nan` where the end of interval 2"),
        ("xmax = 0.6178", "xmax = inf", "xmax = inf", "found `inf`"),
        ("xmax = 0.6178", "xmax = 1e999", "xmin = 0.3\n", "cannot be"),
        ("xmin = 0.6307", "xmin = -0.6307", "xmin = -0.6307", "negative"),
        ("text = \"nin2\"", "text = nin2", "text = nin2", "found `nin2` where the label"),
        ("text = \"nin2\"", "text = 5", "text = 5", "found `5` where the label"),
        ("            xmax = 0.6178\n", "", "text = \"nin2\"", "found `text` where the end of interval 2"),
        ("\"say \"\"hao\"\"", "\"say \"hao\"", "say \"hao", "goes on after its closing quote"),
        ("class = \"IntervalTier\"", "class = \"Interval\"", "\"Interval\"", "found `Interval`"),
        ("tiers? <exists>", "tiers? yes", "size = 3", "where `<exists>` is expected"),
        ("Object class = \"TextGrid\"", "Object class = \"Sound\"", "\"Sound\"", "is `Sound`"),
        ("size = 3", "size = 4000000000", "size = 4000000000", "3 are there"),
        ("intervals: size = 5", "intervals: size = 99", "size = 99", "says that it has 99 intervals, and 5"),
        ("xmin = 0\nxmax = 1.31", "xmin = 3\nxmax = 1.31", "xmin = 3", "ends before"),
    ] {
        assert!(whole.contains(old), "{old}");
        let damaged = whole.replacen(old, new, 1);
        let fault = parse(damaged.as_bytes(), Format::TextGrid).expect_err(new);
        assert!(fault.what().contains(said), "{new}: {fault}");
        let found = fault.line_number().unwrap();
        let near = if at.ends_with('\n') { 28..=45 } else { line_of(&damaged, at)..=line_of(&damaged, at) };
        assert!(near.contains(&found), "{new}: line {found}, not {near:?}: {fault}");
    }
}

#[test]
fn the_other_formats_name_their_damage_too() {
    for (format, text, line, said) in [
        (
            Format::Srt,
            "1\n00:00:01,000 --> 00:00:02,000\na\n\n2\n00:00:01,500 --> 00:00:03,000\nb\n",
            6,
            "holds until 2",
        ),
        (Format::Srt, "1\n00:00:02,000 --> 00:00:01,000\na\n", 2, "ends before"),
        (Format::Srt, "1\n00:00:01 -> 00:00:02\na\n", 2, "where a cue's times are expected"),
        (Format::Srt, "1\n00:00:01,000 --> soon\na\n", 2, "`soon` is no time"),
        (Format::WebVtt, "1\n00:00:01.000 --> 00:00:02.000\na\n", 1, "does not begin with `WEBVTT`"),
        (Format::WebVtt, "WEBVTT\n\n00:01.000 --> 00:02.000\na\n\n00:99.000 --> 01:40.000\nb", 6, "is no time"),
        (Format::Csv, "tier,start,label\n", 1, "`end` is missing"),
        (Format::Csv, "tier,start,end,label\ns,0,1,a\ns,nan,2,b\n", 3, "`nan` in the column `start`"),
        (Format::Csv, "tier,start,end,label\ns,0,1,a\ns,0.5,2,b\n", 3, "holds until 1"),
        (Format::Csv, "tier,start,end,label\ns,0,1,\"a\ns,1,2,b\n", 2, "ends inside a label"),
        (Format::Csv, "tier,start,end,label\ns,0,1,a,b\n", 2, "5 values"),
        (Format::Csv, "tier,start,end,label\ns,-1,1,a\n", 2, "negative"),
        (Format::Json, "{\"tiers\":[\n{\"name\":\"s\",\"intervals\":[{\"start\":0}]}]}", 2, "missing field"),
    ] {
        let fault = parse(text.as_bytes(), format).expect_err(text);
        assert_eq!(fault.line_number(), Some(line), "{fault}");
        assert!(fault.what().contains(said), "{fault}");
    }
    for format in Format::ALL {
        assert!(parse(b"", format).is_err(), "{format}");
    }
    assert_eq!(parse(b"\xB1\x7A", Format::Csv).unwrap_err().line_number(), Some(1));
}

#[test]
fn subtitles_of_other_programs_are_read() {
    let vtt = "\u{FEFF}WEBVTT - made elsewhere\nKind: captions\n\nNOTE\na remark\n\nSTYLE\n::cue { color: red }\n\n\
               intro\n00:01.000 --> 00:02.000 align:start position:10%\n<v Mary>Hello &amp; <i>bye</i></v>\nAT&T\n";
    let tier = parse(vtt.as_bytes(), Format::WebVtt).unwrap().tiers.remove(0);
    assert_eq!(tier.intervals, [Interval::new(1.0, 2.0, "Hello & bye\nAT&T")]);
    let srt =
        "\u{FEFF}\r\n1\r\n0:00:01.5 --> 0:00:02,25\r\n一\r\n二\r\n\r\n\r\n00:03,000 --> 00:04,000\r\nno number\r\n";
    let tier = parse(srt.as_bytes(), Format::Srt).unwrap().tiers.remove(0);
    assert_eq!(tier.intervals, [Interval::new(1.5, 2.25, "一\n二"), Interval::new(3.0, 4.0, "no number")]);
}

#[test]
fn subtitles_hold_the_words_unless_a_tier_is_named() {
    assert_eq!(write(&sample(), Format::Srt), "1\n00:00:00,300 --> 00:00:01,001\n您好\n\n");
    assert!(
        write_tier(&sample(), Format::WebVtt, "syllables").unwrap().contains("00:00:00.300 --> 00:00:00.618\nnin2")
    );
    let fault = write_tier(&sample(), Format::Srt, "shapes").unwrap_err();
    assert!(fault.next_step().contains("words, syllables, phones"), "{fault}");
}

#[test]
fn points_are_passed_over_and_namesakes_keep_apart() {
    let text = "File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\n0\n2\n<exists>\n3\n\
                \"TextTier\"\n\"nuclei\"\n0\n2\n1\n0.5\n\"x\"\n\
                \"IntervalTier\"\n\"w\"\n0\n2\n1\n0\n2\n\"a\"\n\"IntervalTier\"\n\"w\"\n0\n2\n1\n0\n2\n\"b\"\n";
    let read = parse(text.as_bytes(), Format::TextGrid).unwrap();
    let names: Vec<&str> = read.tiers.iter().map(|t| t.name.as_str()).collect();
    assert_eq!(names, ["w", "w 2"]);
}

#[test]
fn only_json_keeps_that_times_are_guessed_and_control_characters_come_through_no_door() {
    let guessed = Timing { guessed: true, ..sample() };
    assert_eq!(parse(write(&guessed, Format::Json).as_bytes(), Format::Json).unwrap(), guessed);
    let json = r#"{"tiers":[{"name":"s\u001b","intervals":[{"start":0,"end":1,"label":"a\u001b[31mb"}]}]}"#;
    let tier = parse(json.as_bytes(), Format::Json).unwrap().tiers.remove(0);
    assert_eq!((tier.name.as_str(), tier.intervals[0].label.as_str()), ("s", "a[31mb"));
}

#[test]
fn every_textgrid_of_the_test_data_reads_and_comes_back_within_a_millisecond() {
    let Some(folder) = test_data::find("speech") else { return };
    let (mut files, mut far) = (0, 0.0_f64);
    for kind in std::fs::read_dir(folder).unwrap().filter_map(Result::ok).filter(|e| e.path().is_dir()) {
        for entry in std::fs::read_dir(kind.path()).unwrap().filter_map(Result::ok) {
            let path = entry.path();
            if path.extension().is_none_or(|e| e != "TextGrid") {
                continue;
            }
            let timing = read(&path).unwrap_or_else(|fault| panic!("{fault}"));
            assert!(!timing.tiers.is_empty() && timing.duration > 0.0, "{}", path.display());
            far = far.max(round_trip(&timing));
            files += 1;
        }
    }
    println!("{files} TextGrids, furthest {far:.6} s");
    assert!(files > 0 && far <= 0.001);
}

/// Runs `lianpu convert` and gives its exit code, output and errors.
fn convert(arguments: &[&str]) -> (Option<i32>, String, String) {
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_lianpu"));
    let done = command.arg("convert").args(arguments).output().unwrap();
    (done.status.code(), String::from_utf8(done.stdout).unwrap(), String::from_utf8(done.stderr).unwrap())
}

#[test]
fn the_command_converts_times_and_ratios_by_their_content() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let times = file("times.txt", &write(&sample(), Format::TextGrid));
    let out = folder.path().join("new/times.csv").to_str().unwrap().to_owned();
    assert_eq!(convert(&[&times, "--to", "csv", "--out", &out]), (Some(0), String::new(), String::new()));
    let (code, json, _) = convert(&[&out, "--to", "json"]);
    assert_eq!((code, parse(json.as_bytes(), Format::Json).unwrap()), (Some(0), sample()));
    let (_, srt, _) = convert(&[&out, "--to", "srt", "--tier", "syllables"]);
    assert!(srt.contains("nin2"), "{srt}");

    let ratios = "frame,time,neutral,happy,anger,disgust,sadness,fear,surprised,confidence\n0,0,0.5,0.5,0,0,0,0,0,1\n";
    let record = file("ratios.csv", ratios);
    let (code, json, _) = convert(&[&record, "--to", "json"]);
    assert_eq!(code, Some(0));
    let (code, csv, _) = convert(&[&file("ratios.json", &json), "--to", "csv"]);
    assert_eq!((code, csv.as_str()), (Some(0), ratios));
}

#[test]
fn the_command_tells_a_wrong_call_from_a_wrong_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("times.srt");
    std::fs::write(&path, write(&sample(), Format::Srt)).unwrap();
    let times = path.to_str().unwrap();
    let record = folder.path().join("ratios.csv");
    std::fs::write(&record, "frame,time,neutral,happy,anger,disgust,sadness,fear,surprised,confidence\n").unwrap();
    let ratios = record.to_str().unwrap();
    for (arguments, code, said) in [
        (&[times, "--to", "mp3"][..], 2, "textgrid, textgrid-short, srt, vtt, csv, json"),
        (&[ratios, "--to", "srt"], 2, "csv, json"),
        (&[times, "--to", "csv", "--tier", "words"], 2, "the tiers are syllables"),
        (&[ratios, "--to", "json"], 1, "no rows"),
        (&["no such file", "--to", "csv"], 1, "cannot open it"),
    ] {
        let (found, out, error) = convert(arguments);
        assert_eq!((found, out.as_str()), (Some(code), ""), "{error}");
        assert!(error.contains(said), "{error}");
    }
}

//! Every timing format: what is written reads back, what is damaged is named with its line, nothing panics.

#![allow(clippy::unwrap_used, clippy::print_stdout)]

use crate::support::test_data;
use lianpu::timing::{Format, Interval, Tier, Timing, parse, read, writable, write, write_tier};
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

/// A label as a format without line breaks or blanks holds it.
fn as_it_is_held(label: &str, format: Format) -> String {
    let words: Vec<&str> = label.split_whitespace().collect();
    match format {
        Format::Audacity => words.join(" "),
        Format::Ctm | Format::Lab => words.join("_"),
        _ => label.to_owned(),
    }
}

/// Writes, reads and compares in every format.
fn round_trip(timing: &Timing) -> f64 {
    let mut far = 0.0_f64;
    for format in Format::ALL {
        if writable(timing, format).is_err() {
            continue;
        }
        let text = write(timing, format);
        let one = format.holds_one_tier();
        let back = parse(text.as_bytes(), format).unwrap_or_else(|fault| panic!("{format}: {fault}\n{text}"));
        if one {
            let mut there = timing.subtitles().unwrap().clone();
            for i in &mut there.intervals {
                i.label = as_it_is_held(&i.label, format);
            }
            let found = back.syllables().unwrap_or_else(|| panic!("{format}\n{text}"));
            far = far.max(furthest(&there, found));
            assert_eq!(Format::sniff(text.as_bytes()), Some(format), "{text}");
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
    fn mouth_shapes_come_back_from_the_formats_of_other_programs(
        parts in prop::collection::vec((0_u32..30, 1_u32..30, 0_usize..8), 1..12), more in 0_u32..50,
    ) {
        // All but h, which the others do not have.
        let mut tier = Tier::new("shapes");
        let mut until = 0;
        for (gap, length, shape) in parts {
            let start = until + gap;
            until = start + length;
            // Hundredths of a second for Rhubarb; frames for Moho are tried below.
            tier.intervals.push(Interval::new(f64::from(start) / 100.0, f64::from(until) / 100.0, ["m", "f", "a", "i", "u", "e", "o", "n"][shape]));
        }
        let timing = Timing { duration: f64::from(until + more) / 100.0, tiers: vec![tier.clone()], guessed: false };
        for format in [Format::RhubarbTsv, Format::RhubarbJson, Format::RhubarbXml] {
            let text = write(&timing, format);
            prop_assert_eq!(Format::sniff(text.as_bytes()), Some(format));
            let back = parse(text.as_bytes(), format).unwrap();
            prop_assert!(furthest(&tier, &back.tiers[0]) < 1e-9);
            prop_assert!((back.duration - timing.duration).abs() < 1e-9);
            prop_assert_eq!(write(&back, format), text);
        }
        // The same in frames: hundredths become frames.
        let mut frames = timing.clone();
        frames.stretch(100.0 / 24.0);
        let text = write(&frames, Format::Moho);
        prop_assert_eq!(Format::sniff(text.as_bytes()), Some(Format::Moho));
        let back = parse(text.as_bytes(), Format::Moho).unwrap();
        for frame in 0..until {
            let time = (f64::from(frame) + 0.5) / 24.0;
            let at = |timing: &Timing| timing.tiers[0].at(time).map(|i| i.label.clone());
            prop_assert_eq!(at(&back), at(&frames), "frame {}\n{}", frame, &text);
        }
    }

    #[test]
    fn lines_of_numbers_and_words_make_no_reader_panic(
        lines in prop::collection::vec("(-?[0-9]{1,12}(\\.[0-9]{0,7})?|[A-HX]|rest|MBP|FPS|nan|1e400|\"|\\\\|;;|<|!)([\t ](-?[0-9]{1,12}(\\.[0-9]{0,7})?|[A-HX]|\"x\"|e|)){0,5}", 0..12),
        head in prop_oneof![Just(""), Just("MohoSwitch1\n"), Just("\"Praat chronological TextGrid text file\"\n0 9\n"),
            Just("File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n"), Just("<rhubarbResult>"), Just("{\"mouthCues\":[")],
    ) {
        let text = format!("{head}{}", lines.join("\n"));
        for format in Format::ALL {
            if let Ok(timing) = parse(text.as_bytes(), format) {
                prop_assert!(timing.duration >= 0.0 && timing.duration < 1e6);
                let _ = write(&timing, format);
            }
        }
        let _ = Format::sniff(text.as_bytes());
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
        // What is cut between two lines or in a label is whole where a line says nothing of the next; the others say
        // how much there must be.
        let least = match format {
            Format::TextGrid | Format::TextGridShort | Format::Json | Format::RhubarbJson | Format::RhubarbXml => {
                whole.len() - 4
            }
            Format::Moho => 12,
            Format::Srt | Format::WebVtt | Format::Csv | Format::Ctm | Format::Lab => 10,
            _ => 1,
        };
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
        (Format::Audacity, "0.5\t0.7\ta\n0.6\t0.9\tb\n", 2, "holds until 0.7"),
        (Format::Audacity, "0.5\t0.7\ta\nhello\n", 2, "found `hello`"),
        (Format::Audacity, "0.5\t0.4\ta\n", 1, "ends before"),
        (Format::Ctm, "a 1 0.5 0.2 x\na 1 0.6\n", 2, "3 values"),
        (Format::Ctm, "a 1 0.5 soon x\n", 1, "`soon` is no duration"),
        (Format::Ctm, "a 1 0.5 -1 x\n", 1, "negative"),
        (Format::Lab, "0 5 a\n5 x b\n", 2, "found `5 x b`"),
        (Format::Lab, "#!MLF!#\n\"*/a.lab\"\n0 5 a\n.\n", 1, "of many recordings"),
        (Format::RhubarbTsv, "0.1\tA\n0.2\tQ\n", 2, "`Q` is no mouth shape"),
        (Format::RhubarbTsv, "0.1\tA\n0.05\tB\n", 1, "ends before"),
        (Format::RhubarbTsv, "0.1\tA\n0.2 B\n", 2, "found `0.2 B`"),
        (Format::RhubarbJson, "{\"mouthCues\":\n[{\"start\":0}]}", 2, "missing field"),
        (
            Format::RhubarbXml,
            "<rhubarbResult>\n<mouthCues>\n<mouthCue start=\"0\" end=\"x\">A</mouthCue></mouthCues></rhubarbResult>",
            3,
            "`x` is no end",
        ),
        (Format::RhubarbXml, "<rhubarbResult>\n<mouthCues>\n", 1, "not XML"),
        (Format::RhubarbXml, "<other/>", 1, "found `other`"),
        (Format::Moho, "MohoSwitch2\n", 1, "does not begin"),
        (Format::Moho, "MohoSwitch1\n1 MBP\n2 what\n", 3, "`what` is no mouth shape"),
        (Format::Moho, "MohoSwitch1\nFPS 0\n1 MBP\n", 2, "no frames a second"),
        (Format::Moho, "MohoSwitch1\nx MBP\n", 2, "found `x MBP`"),
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
fn points_are_kept_as_points_and_namesakes_keep_apart() {
    let text = "File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\n0\n2\n<exists>\n3\n\
                \"TextTier\"\n\"nuclei\"\n0\n2\n1\n0.5\n\"x\"\n\
                \"IntervalTier\"\n\"w\"\n0\n2\n1\n0\n2\n\"a\"\n\"IntervalTier\"\n\"w\"\n0\n2\n1\n0\n2\n\"b\"\n";
    let read = parse(text.as_bytes(), Format::TextGrid).unwrap();
    let names: Vec<&str> = read.tiers.iter().map(|t| t.name.as_str()).collect();
    assert_eq!(names, ["nuclei", "w", "w 2"]);
    assert_eq!(read.tiers[0].intervals, [Interval::new(0.5, 0.5, "x")]);
    assert!(read.tiers[0].is_of_points() && !read.tiers[1].is_of_points());
    for format in [Format::TextGrid, Format::TextGridShort] {
        let text = write(&read, format);
        assert!(text.contains("\"TextTier\""), "{text}");
        assert_eq!(parse(text.as_bytes(), format).unwrap(), read);
    }
    let lonely = text.replace("\n1\n0.5\n\"x\"", "\n0").replace("\"IntervalTier\"\n\"w\"\n0\n2\n1\n0\n2\n\"b\"\n", "");
    let read = parse(lonely.replace("\n3\n", "\n2\n").as_bytes(), Format::TextGrid).unwrap();
    assert_eq!(read.tiers.len(), 1, "an empty tier of points is left out");
}

#[test]
fn a_textgrid_in_the_order_of_time_is_read() {
    let text = "\"Praat chronological TextGrid text file\"\n0 2.3   ! Time domain.\n2   ! Number of tiers.\n\
                \"IntervalTier\" \"Mary\" 0 2.3\n\"TextTier\" \"bell\" 0 2.3\n\n! Mary:\n1 0 0.7\n\"\"\n\
                ! bell:\n2 0.5\n\"ding \"\"dong\"\"\"\n1 0.7 2.3\n\"hello\"\n";
    assert_eq!(Format::sniff(text.as_bytes()), Some(Format::TextGrid));
    let read = parse(text.as_bytes(), Format::TextGrid).unwrap();
    let bell = (0.5, 0.5, "ding \"dong\"");
    assert_eq!(read, timing(&[("Mary", &[(0.7, 2.3, "hello")]), ("bell", &[bell])], 2.3));
    for (old, new, line, said) in [
        ("\n2 0.5", "\n3 0.5", 11, "number of a tier"),
        ("0.7 2.3\n\"hello\"", "0.7 \"hello\"", 13, "the end of a label"),
        ("2   !", "2e9 !", 3, "more than 256"),
    ] {
        let fault = parse(text.replace(old, new).as_bytes(), Format::TextGrid).unwrap_err();
        assert!(fault.what().contains(said), "{fault}");
        assert_eq!(fault.line_number(), Some(line), "{fault}");
    }
}

#[test]
fn a_textgrid_that_is_a_little_wrong_is_understood() {
    let whole = write(&sample(), Format::TextGrid);
    let same = |text: &str| {
        let read = parse(text.as_bytes(), Format::TextGrid).unwrap_or_else(|fault| panic!("{fault}\n{text}"));
        assert_eq!(read, sample());
    };
    same(&whole.replace("size = 3\n", ""));
    same(&whole.replace("        intervals: size = 5\n", ""));
    same(&whole.replace("intervals: size = 5", "intervals: size = 99"));
    same(&whole.replace("intervals: size = 5", "intervals: size = 1"));
    same(&whole.replace("xmin = 0.6307", "xmin = 0.6306999"));
    same(&whole.replace("xmin = 0\n", "xmin = -1e-17\n"));
    let bare = |order: fn(u16) -> [u8; 2]| whole.encode_utf16().flat_map(order).collect::<Vec<u8>>();
    for bytes in [bare(u16::to_le_bytes), bare(u16::to_be_bytes)] {
        assert_eq!(Format::sniff(&bytes), Some(Format::TextGrid));
        assert_eq!(parse(&bytes, Format::TextGrid).unwrap(), sample());
    }
    // A file that begins later keeps its times.
    let later = "File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\n5\n9\n<exists>\n1\n\
                 \"IntervalTier\"\n\"w\"\n5\n9\n2\n5\n6\n\"\"\n6\n9\n\"a\"\n";
    assert_eq!(parse(later.as_bytes(), Format::TextGrid).unwrap(), timing(&[("w", &[(6.0, 9.0, "a")])], 9.0));
    let absent = "File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\n0\n9\n<absent>\n";
    assert_eq!(parse(absent.as_bytes(), Format::TextGrid).unwrap(), timing(&[], 9.0));
}

#[test]
fn labels_of_audacity_are_read_as_it_writes_them() {
    let text = "0.300000\t0.617800\tnin2\n\\\t100.000000\t-1.000000\n0.630700\t1.001000\tsay \"hao\"\n1.2\t1.2\t\n";
    assert_eq!(Format::sniff(text.as_bytes()), Some(Format::Audacity));
    let read = parse(text.as_bytes(), Format::Audacity).unwrap();
    let first: Labels = &[(0.3, 0.6178, "nin2"), (0.6307, 1.001, "say \"hao\"")];
    assert_eq!(read, timing(&[("syllables", first)], 1.2));
    // A second track in the same file, and one of version 1.2, without ends.
    let two = parse(format!("{text}0.5\t0.7\tx\n").as_bytes(), Format::Audacity).unwrap();
    assert_eq!(two, timing(&[("syllables", first), ("syllables 2", &[(0.5, 0.7, "x")])], 1.2));
    let old = parse(b"0.5\tone\n1.5\ttwo\n", Format::Audacity).unwrap();
    assert_eq!(old, timing(&[("syllables", &[(0.5, 0.5, "one"), (1.5, 1.5, "two")])], 1.5));
    assert!(old.tiers[0].is_of_points());
}

#[test]
fn ctm_and_lab_are_read_as_their_programs_write_them() {
    let ctm = ";; a remark\ns01 1 0.63 0.371 hao3 0.98\ns01 1 0.30 0.33 nin2\n";
    assert_eq!(Format::sniff(ctm.as_bytes()), Some(Format::Ctm));
    let read = parse(ctm.as_bytes(), Format::Ctm).unwrap();
    assert_eq!(read, timing(&[("words", &[(0.3, 0.63, "nin2"), (0.63, 1.001, "hao3")])], 1.001));
    let read = parse(b"a A 0 1 x\na B 0 1 y\n", Format::Ctm).unwrap();
    assert_eq!(read, timing(&[("a A", &[(0.0, 1.0, "x")]), ("a B", &[(0.0, 1.0, "y")])], 1.0));
    let labels: Labels = &[(0.0, 0.3, "sil"), (0.3, 0.6178, "nin2")];
    for lab in ["0 3000000 sil\n3000000 6178000 nin2 -12.5 nin\n", "0.0 0.3 sil\n0.3 0.6178 nin2\n"] {
        assert_eq!(Format::sniff(lab.as_bytes()), Some(Format::Lab));
        assert_eq!(parse(lab.as_bytes(), Format::Lab).unwrap(), timing(&[("syllables", labels)], 0.6178));
    }
}

#[test]
fn mouth_shapes_are_read_as_their_programs_write_them() {
    let shapes: Labels = &[(0.05, 0.27, "m"), (0.27, 0.48, "a"), (0.48, 0.6, "i")];
    let tsv = "0.00\tX\n0.05\tA\n0.27\tD\n0.48\tB\n0.60\tX\n0.75\tX\n";
    let json = "{\n  \"metadata\": {\n    \"soundFile\": \"C:\\\\a.wav\",\n    \"duration\": 0.75\n  },\n  \"mouthCues\": [\n    \
                { \"start\": 0.00, \"end\": 0.05, \"value\": \"X\" },\n    { \"start\": 0.05, \"end\": 0.27, \"value\": \"A\" },\n    \
                { \"start\": 0.27, \"end\": 0.48, \"value\": \"D\" },\n    { \"start\": 0.48, \"end\": 0.60, \"value\": \"B\" },\n    \
                { \"start\": 0.60, \"end\": 0.75, \"value\": \"X\" }\n  ]\n}\n";
    let xml = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<rhubarbResult>\n  <metadata>\n    <soundFile>a &amp; b.wav</soundFile>\n    \
               <duration>0.75</duration>\n  </metadata>\n  <mouthCues>\n    <mouthCue start=\"0.00\" end=\"0.05\">X</mouthCue>\n    \
               <mouthCue start=\"0.05\" end=\"0.27\">A</mouthCue>\n    <mouthCue start=\"0.27\" end=\"0.48\">D</mouthCue>\n    \
               <mouthCue start=\"0.48\" end=\"0.60\">B</mouthCue>\n    <mouthCue start=\"0.60\" end=\"0.75\">X</mouthCue>\n  \
               </mouthCues>\n</rhubarbResult>\n";
    for (text, format) in [(tsv, Format::RhubarbTsv), (json, Format::RhubarbJson), (xml, Format::RhubarbXml)] {
        assert_eq!(Format::sniff(text.as_bytes()), Some(format));
        let read = parse(text.as_bytes(), format).unwrap();
        assert_eq!(read, timing(&[("shapes", shapes)], 0.75), "{format}");
        assert!(read.syllables().is_none(), "shapes are no syllables");
    }
    // Papagayo's mouths, Rhubarb's letters in the same file format, and Synfig's line of the frame rate.
    let shapes: Labels = &[(0.5, 0.75, "m"), (0.75, 1.0, "u"), (1.0, 1.25, "a")];
    for text in [
        "MohoSwitch1\n1 rest\n13 MBP\n19 WQ\n25 AI\n31 rest\n31 rest\n",
        "MohoSwitch1\n13 A\n19 F\n25 D\n31 X\n",
        "MohoSwitch1\nFPS 48\npng\n-1 rest\n25 MBP\n37 U\n49 AI\n61 rest\n",
    ] {
        assert_eq!(Format::sniff(text.as_bytes()), Some(Format::Moho));
        assert_eq!(parse(text.as_bytes(), Format::Moho).unwrap(), timing(&[("shapes", shapes)], 1.25), "{text}");
    }
}

#[test]
fn deep_and_wide_xml_does_no_harm() {
    let deep = format!("<rhubarbResult>{}", "<a>".repeat(200_000));
    assert!(parse(deep.as_bytes(), Format::RhubarbXml).is_err());
    let closed = format!("<rhubarbResult>{}{}</rhubarbResult>", "<a>".repeat(200_000), "</a>".repeat(200_000));
    assert!(parse(closed.as_bytes(), Format::RhubarbXml).is_err());
    let bomb = "<!DOCTYPE r [<!ENTITY a \"ha\"><!ENTITY b \"&a;&a;\">]><rhubarbResult>&b;</rhubarbResult>";
    assert!(parse(bomb.as_bytes(), Format::RhubarbXml).is_err());
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
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
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

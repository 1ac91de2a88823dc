//! `lianpu convert`: times, mouth shapes and ratios, file to file.

#![allow(clippy::unwrap_used, reason = "a test may stop")]

use lianpu::timing::{Format, Interval, Tier, Timing, parse, write};

fn sample() -> Timing {
    let mut timing = Timing { duration: 1.31, ..Timing::default() };
    let syllables = vec![Interval::new(0.3, 0.6178, "nin2"), Interval::new(0.6307, 1.001, "say \"hao\"\n好")];
    let words = vec![Interval::new(0.3, 1.001, "您好")];
    for (name, intervals) in [("words", words), ("syllables", syllables), ("phones", Vec::new())] {
        timing.set_tier(Tier { name: name.into(), intervals });
    }
    timing
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
fn the_command_converts_mouth_shapes_at_any_frame_rate() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mouth.dat");
    std::fs::write(&path, "MohoSwitch1\n1 rest\n31 MBP\n46 AI\n61 rest\n").unwrap();
    let moho = path.to_str().unwrap();
    let (_, tsv, _) = convert(&[moho, "--to", "rhubarb-tsv", "--fps", "30"]);
    assert_eq!(tsv, "0\tX\n1\tA\n1.5\tD\n2\tX\n");
    let (_, tsv, _) = convert(&[moho, "--to", "rhubarb-tsv"]);
    assert!(tsv.contains("1.25\tA"), "{tsv}");
    // What the file says of its rate counts, however it is written.
    let said = "MohoSwitch1\n FPS 12\n1 rest\n13 MBP\n25 rest\n";
    let wide: Vec<u8> = std::iter::once(0xFEFF).chain(said.encode_utf16()).flat_map(u16::to_le_bytes).collect();
    for bytes in [said.as_bytes(), &wide] {
        std::fs::write(&path, bytes).unwrap();
        for more in [&["--fps", "12"][..], &["--fps", "30"], &[]] {
            let (_, tsv, error) = convert(&[&[moho, "--to", "rhubarb-tsv"], more].concat());
            assert_eq!(tsv, "0\tX\n1\tA\n2\tX\n", "{more:?} {error}");
        }
    }
    let cues = folder.path().join("cues.tsv");
    std::fs::write(&cues, "0\tX\n1\tA\n1.5\tD\n2\tX\n").unwrap();
    let (_, back, _) = convert(&[cues.to_str().unwrap(), "--to", "moho", "--fps", "30"]);
    assert_eq!(back, "MohoSwitch1\n1 rest\n31 MBP\n46 AI\n61 rest\n");
    let (_, grid, _) = convert(&[cues.to_str().unwrap(), "--to", "textgrid"]);
    assert_eq!(parse(grid.as_bytes(), Format::TextGrid).unwrap().tiers[0].intervals[0].label, "m");
    let times = folder.path().join("times.csv");
    std::fs::write(&times, write(&sample(), Format::Csv)).unwrap();
    let (code, _, error) = convert(&[times.to_str().unwrap(), "--to", "rhubarb-json"]);
    assert_eq!(code, Some(1));
    assert!(error.contains("there is no tier `shapes`"), "{error}");
    let (code, _, error) = convert(&[times.to_str().unwrap(), "--to", "moho", "--tier", "syllables"]);
    assert_eq!(code, Some(2));
    assert!(error.contains("`nin2` at 0.300 s in the tier `syllables` is no mouth shape"), "{error}");
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
        (&[times, "--to", "mp3"][..], 2, "textgrid, textgrid-short, srt, vtt, csv, json, audacity"),
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

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

/// Runs `lianpu convert` and gives its exit code, the bytes that came out, and errors.
fn convert_bytes(arguments: &[&str]) -> (Option<i32>, Vec<u8>, String) {
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_lianpu"));
    let done = command.arg("convert").args(arguments).output().unwrap();
    (done.status.code(), done.stdout, String::from_utf8(done.stderr).unwrap())
}

#[test]
fn ratios_and_tracks_go_into_a_compact_record_and_come_out_again() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let header = "frame,time,neutral,happy,anger,disgust,sadness,fear,surprised,confidence\n";
    let ratios =
        format!("{header}0,0,0.5,0.5,0,0,0,0,0,1\n1,0.033333,0.25,0.75,0,0,0,0,0,0.5\n5,0.166667,1,0,0,0,0,0,0,0\n");
    let tracks = "frame,time,gaze_x,gaze_y,lid_left,lid_right,mouth_up,mouth_down,mouth_left,mouth_right,head_x,head_y,head_roll,confidence\n\
                  0,0,0.1,0,1,1,0,0.5,0,0,0.05,0,-2,1\n1,0.033333,0.1,0,0,0,0,0.5,0,0,0.05,0,-2,1\n5,0.166667,0.1,0,1,1,0,0.5,0,0,0.05,0,-2,0\n";
    std::fs::write(at("ratios.csv"), &ratios).unwrap();
    std::fs::write(at("tracks.csv"), tracks).unwrap();
    let (code, bytes, said) = convert_bytes(&[&at("ratios.csv"), "--to", "lpr"]);
    assert_eq!((code, said.as_str()), (Some(0), ""));
    std::fs::write(at("record.lpr"), &bytes).unwrap();
    let (code, csv, said) = convert(&[&at("record.lpr"), "--to", "csv", "--tracks", &at("back.csv")]);
    assert_eq!((code, csv.as_str(), said.as_str()), (Some(0), ratios.as_str(), ""));
    assert_eq!(std::fs::read_to_string(at("back.csv")).unwrap(), tracks);
    let (code, json, said) = convert(&[&at("record.lpr"), "--to", "json"]);
    assert!(code == Some(0) && json.contains("\"happy\":0.75") && said.contains("--tracks FILE"), "{said}");
    let (code, again, _) = convert_bytes(&[&at("record.lpr"), "--to", "lpr"]);
    assert!(code == Some(0) && again == bytes, "a second time changes nothing");
    // What is whole of a damaged record is written, and the damage is said.
    std::fs::write(at("cut.lpr"), &bytes[..bytes.len() - 3]).unwrap();
    let (code, csv, said) = convert(&[&at("cut.lpr"), "--to", "csv"]);
    assert!(code == Some(1) && csv == ratios && said.contains("cut off after frame 5"), "{said}");
    let (code, _, said) = convert(&[&at("tracks.csv"), "--to", "lpr"]);
    assert!(code == Some(2) && said.contains("ratios.csv --to lpr"), "{said}");
    let (code, _, said) = convert(&[&at("record.lpr"), "--to", "srt"]);
    assert!(code == Some(2) && said.contains("csv, json, lpr"), "{said}");
}

/// The values of a CSV's column, row by row.
fn column(csv: &str, name: &str) -> Vec<f64> {
    let mut lines = csv.lines();
    let at = lines.next().unwrap().split(',').position(|n| n == name).unwrap();
    lines.map(|line| line.split(',').nth(at).unwrap().parse().unwrap()).collect()
}

#[test]
fn live_link_face_recordings_become_ratios_and_tracks() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let names = "Timecode,BlendshapeCount,EyeBlinkLeft,EyeBlinkRight,EyeLookOutLeft,EyeLookInRight,JawOpen,MouthSmileLeft,MouthSmileRight,\
                 CheekSquintLeft,CheekSquintRight,EyeSquintLeft,EyeSquintRight,BrowInnerUp,BrowDownLeft,BrowDownRight,HeadRoll";
    let text = format!(
        "{names}\n14:26:59:58.254,61,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0\n\
         14:26:59:59.254,61,0,0.9,0.5,0.5,0,0.85,0.85,0.5,0.5,0.4,0.4,0,0,0,0.1\n\
         14:27:00:00.254,0,,,,,,,,,,,,,,,\n\
         14:27:00:01.254,61,0,0,0,0,0.5,0,0,0,0,0,0,0,0,0,0\n"
    );
    std::fs::write(at("take.csv"), text).unwrap();
    let (code, csv, said) = convert(&[&at("take.csv"), "--to", "csv", "--tracks", &at("tracks.csv")]);
    assert!(code == Some(0) && said.contains("1 of 4 frames have no face"), "{said}");
    let (times, happy, sure) = (column(&csv, "time"), column(&csv, "happy"), column(&csv, "confidence"));
    assert!((times[3] - 0.05).abs() < 1e-5, "sixty frames a second: {times:?}");
    assert!(happy[0].abs() < 0.02 && happy[1] > 0.9, "{happy:?}");
    assert_eq!(sure, [1.0, 1.0, 0.0, 1.0]);
    assert!(column(&csv, "neutral")[3] > 0.8, "an open jaw alone is speech");
    let tracks = std::fs::read_to_string(at("tracks.csv")).unwrap();
    assert_eq!(column(&tracks, "lid_left")[1], 0.0, "a person's right eye is at the image's left");
    assert_eq!(column(&tracks, "lid_right")[1], 1.0);
    assert!((column(&tracks, "gaze_x")[1] - 0.4).abs() < 1e-9 && column(&tracks, "mouth_down")[3] > 0.9);
}

#[test]
fn mediapipe_results_are_read_in_the_forms_that_people_write() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let shapes = |smile: f64| {
        format!(
            "{{\"categoryName\":\"browInnerUp\",\"score\":0.05}},{{\"categoryName\":\"mouthSmileLeft\",\"score\":{smile}}},\
             {{\"categoryName\":\"mouthSmileRight\",\"score\":{smile}}},{{\"categoryName\":\"eyeBlinkLeft\",\"score\":0.1}}"
        )
    };
    let forms = [
        format!(
            "[{{\"timestamp_ms\":0,\"faceBlendshapes\":[{{\"categories\":[{}]}}],\"faceLandmarks\":[[{{\"x\":0.5,\"y\":0.5,\"z\":0}}]]}},\
             {{\"timestamp_ms\":40,\"faceBlendshapes\":[{{\"categories\":[{}]}}]}},{{\"timestamp_ms\":80,\"faceBlendshapes\":[]}}]",
            shapes(0.0),
            shapes(0.85)
        ),
        format!(
            "{{\"fps\":25,\"frames\":[{{\"time\":0,\"face_blendshapes\":[[{}]]}},{{\"time\":0.04,\"face_blendshapes\":[[{}]]}},\
             {{\"time\":0.08,\"face_blendshapes\":[]}}]}}",
            shapes(0.0),
            shapes(0.85)
        ),
        "{\"timestamp\":0,\"blendshapes\":{\"mouthSmileLeft\":0,\"mouthSmileRight\":0}}\n\
         {\"timestamp\":40,\"blendshapes\":{\"mouthSmileLeft\":0.85,\"mouthSmileRight\":0.85}}\n\
         {\"timestamp\":80,\"blendshapes\":{}}\n"
            .to_owned(),
    ];
    for (k, text) in forms.iter().enumerate() {
        let path = at(&format!("{k}.json"));
        std::fs::write(&path, text).unwrap();
        let (code, csv, said) = convert(&[&path, "--to", "csv"]);
        assert_eq!(code, Some(0), "{k} {said}");
        assert_eq!(column(&csv, "time"), [0.0, 0.04, 0.08], "{k}");
        let happy = column(&csv, "happy");
        assert!(happy[0] < 0.05 && happy[1] > 0.8, "{k} {happy:?}");
        assert_eq!(column(&csv, "confidence"), [1.0, 1.0, 0.0], "{k}");
    }
}

#[test]
fn openface_units_become_ratios_and_points_alone_ask_for_a_face() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let points: String = (0..68).map(|i| format!(", x_{i}")).chain((0..68).map(|i| format!(", y_{i}"))).collect();
    let places = ", 100".repeat(136);
    let text = format!(
        "frame, face_id, timestamp, confidence, success, gaze_angle_x, gaze_angle_y, pose_Tx, pose_Ty, pose_Rz{points}, AU06_r, AU12_r, AU45_r\n\
         1, 0, 0.000, 0.98, 1, 0.2, 0, 10, 5, 0{places}, 0, 0, 0\n\
         2, 0, 0.033, 0.98, 1, 0.2, 0, 73, 5, 0.1{places}, 1.8, 3.1, 0\n\
         3, 0, 0.067, 0.10, 0, 0, 0, 0, 0, 0{places}, 0, 0, 0\n\
         4, 0, 0.100, 0.98, 1, 0.2, 0, 10, 5, 0{places}, 0, 0, 3.5\n"
    );
    std::fs::write(at("video.csv"), &text).unwrap();
    let (code, csv, said) = convert(&[&at("video.csv"), "--to", "csv", "--tracks", &at("tracks.csv")]);
    assert_eq!(code, Some(0), "{said}");
    let happy = column(&csv, "happy");
    assert!(happy[0] < 0.02 && happy[1] > 0.9, "{happy:?}");
    assert_eq!(
        (column(&csv, "frame"), column(&csv, "confidence")),
        (vec![0.0, 1.0, 2.0, 3.0], vec![0.98, 0.98, 0.0, 0.98])
    );
    let tracks = std::fs::read_to_string(at("tracks.csv")).unwrap();
    assert_eq!((column(&tracks, "lid_left")[3], column(&tracks, "lid_right")[3]), (0.0, 0.0));
    assert!((column(&tracks, "head_x")[1] - 1.0).abs() < 1e-6, "63 mm are a pupil distance");
    let cut = |line: &str| line.split(',').take(146).collect::<Vec<_>>().join(",") + "\n";
    std::fs::write(at("points.csv"), text.lines().map(cut).collect::<String>()).unwrap();
    let (code, _, said) = convert(&[&at("points.csv"), "--to", "csv"]);
    assert!(code == Some(1) && said.contains("--face faces/NAME"), "{said}");
}

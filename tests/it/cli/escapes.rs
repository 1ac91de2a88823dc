//! Nothing that a stranger's file says reaches the terminal as a control character, a mark that reorders text, or a flood
//! of combining marks: a payload stands in every text of every format that is read.

#![allow(clippy::unwrap_used, reason = "a test may stop")]

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// A title for the terminal, a sequence of C1, an override, a tag and a flood.
fn payload() -> String {
    format!("\u{1b}]0;PWN\u{7}\u{9b}31m\u{202e}\u{7f}\u{E0041}\u{61c}\u{3164}e{}", "\u{316}".repeat(3000))
}

/// As TOML and JSON spell it in a text.
fn spelled() -> String {
    format!("\\u001b]0;PWN\\u0007\\u009b31m\\u202e\\u007fe{}", "\\u0316".repeat(3000))
}

/// Runs the program and looks at all that it prints.
fn clean(args: &[&str]) -> String {
    let mut command = assert_cmd::Command::new(env!("CARGO_BIN_EXE_lianpu"));
    let output = command.args(args).timeout(Duration::from_secs(120)).output().unwrap();
    for (name, bytes) in [("stdout", &output.stdout), ("stderr", &output.stderr)] {
        let text = String::from_utf8(bytes.clone()).unwrap();
        let hidden = |c: char| {
            (c.is_control() && !matches!(c, '\n' | '\t'))
                || matches!(c, '\u{61c}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{3164}' | '\u{e0000}'..='\u{e007f}')
        };
        assert!(!text.contains(hidden), "{args:?} {name}: {:?}", text.chars().take(300).collect::<String>());
        assert!(!text.contains(&"\u{316}".repeat(9)), "{args:?} {name}: a flood of marks");
    }
    String::from_utf8(output.stderr).unwrap() + &String::from_utf8(output.stdout).unwrap()
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap().flatten() {
        let to = to.join(entry.file_name());
        if entry.path().is_dir() {
            copy(&entry.path(), &to);
        } else {
            fs::copy(entry.path(), to).unwrap();
        }
    }
}

fn lesson() -> (tempfile::TempDir, PathBuf) {
    let dir = tempfile::tempdir().unwrap();
    let lesson = dir.path().join("lesson");
    copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join("projects/nihao"), &lesson);
    (dir, lesson)
}

#[test]
fn no_key_or_word_of_a_project_s_files_reaches_the_terminal_raw() {
    let (spelled, payload) = (spelled(), payload());
    let manifest = |more: &str| {
        format!("format = 1\ntitle = \"t\"\n\n[[face]]\nname = \"teacher\"\n{more}\n\n[[clip]]\nname = \"nihao\"\n")
    };
    let with_key = format!("\"{spelled}\" = 1\n");
    let mut files: Vec<(&str, String)> = vec![
        (
            "lianpu.toml",
            format!("format = 1\ntitle = \"{spelled}\"\n[[face]]\nname = \"teacher\"\n[[clip]]\nname = \"nihao\"\n"),
        ),
        ("lianpu.toml", format!("format = 1\ntitle = \"t\"\n{with_key}")),
        ("lianpu.toml", format!("format = 1\n[[clip]]\nname = \"{spelled}\"\n")),
        ("lianpu.toml", format!("format = 1\n[[face]]\nname = \"{spelled}\"\n")),
        ("lianpu.toml", format!("{payload} = [")),
        ("lianpu.toml", manifest(&format!("script_system = \"{spelled}\""))),
        ("clips/nihao/script.txt", payload.clone()),
        ("clips/nihao/script.txt", format!("您好[{payload} 0.6]：{payload}")),
        ("clips/nihao/timing.TextGrid", payload.clone()),
        ("clips/nihao/ratios.csv", format!("frame,time,{payload}\n0,0,1\n")),
        (
            "clips/nihao/ratios.csv",
            format!(
                "frame,time,neutral,happy,anger,disgust,sadness,fear,surprised,confidence\n0,{payload},1,0,0,0,0,0,0,1\n"
            ),
        ),
        ("clips/nihao/tracks.csv", format!("frame,time,{payload}\n0,0,1\n")),
        ("faces/teacher/calibration.toml", with_key.clone()),
        ("faces/teacher/happy.toml", with_key.clone()),
        ("export/manifest.json", format!("{{\"{spelled}\":1}}")),
    ];
    for key in ["figure", "style", "mouths"] {
        files.push(("lianpu.toml", manifest(&format!("{key} = \"{spelled}\""))));
    }
    for (key, folder) in [("figure", "figures"), ("style", "styles")] {
        files.push(("lianpu.toml", manifest(&format!("{key} = \"{folder}/{spelled}.toml\""))));
    }
    files.push(("lianpu.toml", manifest(&format!("layers = [{{ file = \"layers/{spelled}.svg\" }}]"))));
    for file in ["clips/nihao/score.toml", "faces/teacher/face.toml"] {
        files.push((file, with_key.clone()));
        files.push((file, format!("[[key]]\ntrack = \"{spelled}\"\n[[marker]]\ntime = 0\ntext = \"{spelled}\"\n")));
    }
    for (file, text) in files {
        let (dir, lesson) = lesson();
        fs::create_dir_all(lesson.join(file).parent().unwrap()).unwrap();
        let before = fs::read_to_string(lesson.join(file)).unwrap_or_default();
        // Behind what is right as well, where more is found wrong.
        for text in [text.clone(), format!("{before}\n{text}")] {
            fs::write(lesson.join(file), text).unwrap();
            let path = lesson.to_str().unwrap();
            clean(&["check", path]);
            clean(&["check", path, "--json"]);
            clean(&["export", path, "--to", "srt,textgrid,html", "--out", dir.path().join("out").to_str().unwrap()]);
            clean(&["merge", lesson.join("export").to_str().unwrap()]);
        }
    }
}

#[test]
fn no_text_of_a_file_that_is_converted_reaches_the_terminal_raw() {
    let (spelled, payload) = (spelled(), payload());
    let grid = format!(
        "File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\nxmin = 0\nxmax = 1\ntiers? <exists>\nsize = 1\nitem []:\n\
         item [1]:\nclass = \"IntervalTier\"\nname = \"{payload}\"\nxmin = 0\nxmax = 1\nintervals: size = 1\n\
         intervals [1]:\nxmin = 0\nxmax = 1\ntext = \"{payload}\"\n"
    );
    let files = [
        ("a.TextGrid", grid),
        ("a.srt", format!("1\n00:00:00,000 --> 00:00:01,000\n{payload}\n\n{payload}\n")),
        (
            "a.vtt",
            format!(
                "WEBVTT {payload}\n\nNOTE {payload}\n\n{payload}\n00:00.000 --> 00:01.000 {payload}\n<v {payload}>{payload}\n"
            ),
        ),
        ("a.csv", format!("start,end,{payload}\n0,1,{payload}\n")),
        ("b.csv", format!("start,end,label\n0,{payload},a\n")),
        ("a.json", format!("{{\"{spelled}\":1}}")),
        ("b.json", format!("{{\"words\":{{\"entries\":[[0,1,\"{spelled}\"]]}},\"{spelled}\":[]}}")),
        (
            "c.json",
            format!(
                "{{\"metadata\":{{\"soundFile\":\"{spelled}\",\"duration\":1}},\"mouthCues\":[{{\"start\":0,\"end\":1,\"value\":\"{spelled}\"}}]}}"
            ),
        ),
        ("d.json", format!("[{{\"{spelled}\":\"{spelled}\"}}]")),
        (
            "a.xml",
            format!(
                "<rhubarbResult><mouthCues><mouthCue start=\"0\" end=\"1\">{payload}</mouthCue></mouthCues></rhubarbResult>"
            ),
        ),
        ("a.tsv", format!("0.00\tA\n0.50\t{payload}\n")),
        ("a.txt", format!("0.0\t1.0\t{payload}\n")),
        ("a.dat", format!("MohoSwitch1\n1 {payload}\n5 {payload}\n")),
        ("a.lab", format!("0 10000000 {payload}\n")),
        ("a.ctm", format!("{payload} 1 0.0 1.0 {payload}\n")),
        ("a.lpr", format!("LPR{payload}")),
        (
            "r.csv",
            format!("frame,time,neutral,happy,anger,disgust,sadness,fear,surprised,{payload}\n0,0,1,0,0,0,0,0,0,1\n"),
        ),
        ("o.csv", format!("frame, face_id, timestamp, {payload}\n1, 0, 0.0, 1\n")),
    ];
    let dir = tempfile::tempdir().unwrap();
    for (name, text) in files {
        let path = dir.path().join(name);
        fs::write(&path, text).unwrap();
        for to in ["srt", "textgrid", "json", "csv", payload.as_str()] {
            clean(&["convert", path.to_str().unwrap(), "--to", &to.replace('\0', "")]);
        }
        clean(&["convert", path.to_str().unwrap(), "--to", "srt", "--tier", &payload]);
    }
}

#[test]
fn no_name_of_a_file_or_folder_reaches_the_terminal_raw() {
    let (dir, lesson) = lesson();
    // A name has at most 255 bytes.
    let name = format!("\u{1b}]0;P\u{7}\u{9b}\u{202e}\u{E0041}e{}", "\u{316}".repeat(60));
    let odd = dir.path().join(&name);
    fs::rename(&lesson, &odd).unwrap();
    let path = odd.to_str().unwrap();
    let out = dir.path().join("out").join(&name);
    clean(&["check", path]);
    clean(&["check", path, "--json"]);
    clean(&["check", path, "--quality"]);
    clean(&["export", path, "--to", "srt,png", "--size", "96x54"]);
    clean(&["export", path, "--to", "srt", "--json", "--out", out.to_str().unwrap()]);
    clean(&["merge", odd.join("export").to_str().unwrap()]);
    clean(&["merge", odd.join("export").to_str().unwrap(), "--json"]);
    clean(&["plot", path, "--what", "ratios"]);
    clean(&["face", path]);
    clean(&["align", path, "--clip", "nihao"]);
    clean(&["align", path, "--clip", &name]);
    clean(&["farm", "parallel", path, "--to", "png"]);
    clean(&["new", path]);
    clean(&["new", dir.path().join("made").to_str().unwrap(), "--speech", path]);
    clean(&["convert", path, "--to", "srt"]);
    clean(&[path, path]);
    clean(&["check", &format!("--{name}")]);
    clean(&[&name]);
    for (folder, ending) in
        [("clips/nihao", "speech2.wav"), ("faces/teacher", "happy.png"), ("clips/nihao/frames", "0.png")]
    {
        fs::create_dir_all(odd.join(folder)).unwrap();
        fs::write(odd.join(folder).join(format!("{}{ending}", &name[..40])), "no picture").unwrap();
        clean(&["check", path]);
        clean(&["track", path]);
    }
    let said = clean(&["check", dir.path().join("none").join(&name).to_str().unwrap()]);
    assert!(said.contains("\\u{1b}"), "it can be recognised: {said}");
}

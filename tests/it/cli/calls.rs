//! The program as its users call it.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn lianpu(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_lianpu")).args(args).output().unwrap()
}

fn project(name: &str) -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("projects").join(name).display().to_string()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn done(args: &[&str]) -> String {
    let output = lianpu(args);
    assert!(output.status.success(), "{args:?}: {}", text(&output.stderr));
    text(&output.stdout)
}

fn fails(args: &[&str], code: i32, word: &str) {
    let output = lianpu(args);
    let said = text(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{args:?}: {said}");
    assert!(said.contains(word), "{args:?} does not say `{word}`: {said}");
}

fn files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut all: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .flatten()
        .map(|e| (e.file_name().to_string_lossy().into_owned(), std::fs::read(e.path()).unwrap()))
        .collect();
    all.sort();
    all
}

fn export(out: &Path, more: &[&str]) -> String {
    let nihao = project("nihao");
    let out = out.display().to_string();
    let mut args = vec!["export", nihao.as_str(), "--to", "png,svg", "--out", &out, "--size", "320x180"];
    args.extend(more);
    done(&args)
}

#[test]
fn the_sample_lesson_exports_every_frame_at_its_size() {
    let folder = tempfile::tempdir().unwrap();
    let printed = export(folder.path(), &[]);
    let clip = folder.path().join("nihao");
    assert_eq!(printed.trim(), clip.display().to_string());
    let frames = files(&clip);
    // 1.733741 s at 25 frames a second.
    assert_eq!(frames.len(), 2 * 44);
    assert_eq!(frames[0].0, "000000.png");
    let header = &frames[0].1[16..24];
    assert_eq!(header, [0, 0, 1, 64, 0, 0, 0, 180]);
    let svg = text(&frames[1].1);
    for part in ["<g id=\"static\">", "<g id=\"dynamic\">", "<title", "<desc", "id=\"lip-upper\"", "id=\"right-brow\""]
    {
        assert!(svg.contains(part), "{part}");
    }
}

#[test]
fn an_export_run_again_writes_only_what_is_missing_damaged_or_changed() {
    let folder = tempfile::tempdir().unwrap();
    export(folder.path(), &[]);
    let clip = folder.path().join("nihao");
    let before = files(&clip);
    std::fs::remove_file(clip.join("000003.png")).unwrap();
    std::fs::write(clip.join("000004.png"), &before[8].1[..200]).unwrap();
    std::fs::write(clip.join("000005.svg"), "<svg/>").unwrap();
    let nihao = project("nihao");
    let out = folder.path().display().to_string();
    let output = lianpu(&["export", &nihao, "--to", "png,svg", "--out", &out, "--size", "320x180"]);
    let said = text(&output.stderr);
    assert!(said.contains("3 files written, 85 already there") && said.contains("1 file among the frames"), "{said}");
    // What is no frame of this program's may be somebody's work.
    std::fs::remove_file(clip.join("000005.svg~")).unwrap();
    assert!(files(&clip) == before);
}

#[test]
fn frames_of_a_longer_export_are_removed_and_files_of_others_are_not() {
    let folder = tempfile::tempdir().unwrap();
    export(folder.path(), &["--fps", "30"]);
    let clip = folder.path().join("nihao");
    std::fs::write(clip.join("000099.png"), "somebody's own").unwrap();
    export(folder.path(), &[]);
    let names: Vec<String> = files(&clip).into_iter().map(|f| f.0).collect();
    assert!(!names.contains(&"000044.png".to_owned()));
    assert!(names.contains(&"000099.png".to_owned()));
}

#[test]
fn shards_and_threads_change_no_byte() {
    let (whole, parts) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    export(whole.path(), &["--jobs", "1"]);
    for shard in ["1/3", "2/3", "3/3"] {
        export(parts.path(), &["--jobs", "2", "--shard", shard]);
    }
    assert_eq!(files(&whole.path().join("nihao")), files(&parts.path().join("nihao")));
}

#[test]
fn frames_count_inclusively() {
    let folder = tempfile::tempdir().unwrap();
    export(folder.path(), &["--frames", "3-5,7"]);
    let names: Vec<String> = files(&folder.path().join("nihao")).into_iter().map(|f| f.0).collect();
    assert_eq!(names.iter().filter(|n| n.ends_with("png")).count(), 4);
}

#[test]
fn her_own_recording_and_script_become_a_lesson_that_exports() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).display().to_string();
    let speech = project("nihao") + "/clips/nihao/speech.wav";
    std::fs::write(at("script.txt"), "您好").unwrap();
    let said = done(&["new", &at("mine"), "--speech", &speech, "--script", &at("script.txt")]);
    assert!(said.contains("found in the sound") && said.contains("lianpu export"), "{said}");
    assert!(!done(&["check", &at("mine")]).contains("guessed"));
    let quality = done(&["check", "--quality", &at("mine")]);
    assert!(quality.contains("voice at -") && !quality.contains("note"), "{quality}");
    done(&["export", &at("mine"), "--to", "png", "--frames", "0-3"]);
    assert!(PathBuf::from(at("mine/export/mine/000003.png")).is_file());
    fails(&["new", &at("mine"), "--ratios", &at("x")], 1, "already there");
}

#[test]
fn a_lesson_that_cannot_be_made_leaves_nothing_behind() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).display().to_string();
    let speech = project("nihao") + "/clips/nihao/speech.wav";
    std::fs::write(at("ambiguous.txt"), "ci e").unwrap();
    std::fs::write(at("silence.wav"), "RIFF").unwrap();
    fails(&["new", &at("a"), "--speech", &speech, "--script", &at("ambiguous.txt")], 1, "--from");
    fails(&["new", &at("b"), "--speech", &at("silence.wav"), "--script", &at("ambiguous.txt")], 1, "silence.wav");
    fails(&["new", &at("c"), "--script", &at("ambiguous.txt")], 2, "recording");
    fails(&["new", &at("d")], 2, "--ratios");
    let left: Vec<String> = files(folder.path()).into_iter().map(|f| f.0).collect();
    assert_eq!(left, ["ambiguous.txt", "silence.wav"]);
}

#[test]
fn every_chart_is_drawn_as_svg_and_as_png() {
    let folder = tempfile::tempdir().unwrap();
    let nihao = project("nihao");
    for what in ["ratios", "change", "timeline", "faces", "frame"] {
        for form in ["svg", "png"] {
            let path = folder.path().join(format!("{what}.{form}")).display().to_string();
            let mut args = vec!["plot", nihao.as_str(), "--what", what, "--out", &path];
            if what == "frame" {
                args.extend(["--at", "1.0"]);
            }
            assert_eq!(done(&args).trim(), path);
            assert!(std::fs::metadata(&path).unwrap().len() > 2000, "{path}");
        }
    }
    fails(&["plot", &nihao, "--what", "frame"], 2, "--at");
    fails(&["plot", &nihao, "--what", "frame", "--at", "99"], 2, "lasts");
}

#[test]
fn wrong_calls_and_wrong_inputs_are_told_apart_and_say_what_to_do() {
    let nihao = project("nihao");
    fails(&["export", &nihao, "--to", "pgn"], 2, "formats: svg, png");
    fails(&["export", &nihao, "--to", "png", "--clip", "nihoa"], 2, "did you mean `nihao`");
    fails(&["export", &nihao, "--to", "png", "--frames", "9-999"], 2, "44 frames");
    fails(&["export", &nihao, "--to", "png", "--size", "100000x1"], 2, "16384");
    fails(&["export", "/nowhere", "--to", "png"], 1, "lianpu new");
    fails(&["check", "/nowhere"], 1, "wrong");
}

#[test]
fn subtitles_are_phrases_without_markup_and_a_folder_of_lessons_is_all_of_them() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out").display().to_string();
    let all = Path::new(env!("CARGO_MANIFEST_DIR")).join("projects").display().to_string();
    done(&["export", &all, "--to", "srt,textgrid", "--out", &out]);
    let srt = std::fs::read_to_string(folder.path().join("out/nihao/nihao.srt")).unwrap();
    assert_eq!(srt.lines().collect::<Vec<_>>()[..3], ["1", "00:00:00,300 --> 00:00:01,284", "您好。"]);
    assert!(folder.path().join("out/seven-emotions/walk.TextGrid").is_file());
    assert!(done(&["check", &all]).contains("seven-emotions"));
}

#[test]
fn a_mistyped_command_is_told_from_a_folder() {
    fails(&["exprot", "mine"], 2, "did you mean `export`");
    fails(&["nowhere"], 2, "neither a command nor a folder");
}

#[test]
fn one_damaged_lesson_does_not_keep_the_others_from_being_exported() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out").display().to_string();
    let bad = folder.path().join("bad");
    std::fs::create_dir(&bad).unwrap();
    std::fs::write(bad.join("lianpu.toml"), "format = 1").unwrap();
    let (bad, nihao) = (bad.display().to_string(), project("nihao"));
    fails(&["export", &bad, &nihao, "--to", "svg", "--frames", "0-1", "--out", &out], 1, "1 of 2 projects");
    assert!(folder.path().join("out/nihao/nihao/000001.svg").is_file());
    fails(&["export", &nihao, &nihao, "--to", "svg", "--out", &out], 2, "same folder");
    fails(&["export", &nihao, "--to", "svg", "--jobs", "100000"], 2, "256");
    fails(&["export", &nihao, "--to", "svg", "--fps", "-1"], 2, "1 to 240");
}

#[test]
fn json_lines_can_be_read_by_machines() {
    let folder = tempfile::tempdir().unwrap();
    let printed = export(folder.path(), &["--json", "--frames", "0-9"]);
    let lines: Vec<serde_json::Value> = printed.lines().map(|l| serde_json::from_str(l).unwrap()).collect();
    assert_eq!(lines.len(), 2);
    assert_eq!(lines[0]["frames"], 10);
    assert_eq!(lines[1]["written"], 20);
}

#[test]
fn without_a_terminal_the_program_prints_its_help() {
    assert!(done(&[]).contains("Usage: lianpu"));
}

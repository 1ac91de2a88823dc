//! What comes into the program and what goes out of it: links, pipes and devices where files should be.

#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test may stop")]

use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::time::Duration;

/// Runs the program; it must end by itself.
fn lianpu(args: &[&str]) -> Output {
    let mut command = assert_cmd::Command::new(env!("CARGO_BIN_EXE_lianpu"));
    command.args(args).timeout(Duration::from_secs(60)).output().unwrap()
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
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

fn pipe(path: &Path) {
    assert!(Command::new("mkfifo").arg(path).status().unwrap().success());
}

/// A copy of the sample lesson, and an empty folder beside it that nothing of it may reach.
fn lesson() -> (tempfile::TempDir, PathBuf, PathBuf) {
    let dir = tempfile::tempdir().unwrap();
    let (lesson, outside) = (dir.path().join("lesson"), dir.path().join("outside"));
    copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join("projects/nihao"), &lesson);
    fs::create_dir(&outside).unwrap();
    (dir, lesson, outside)
}

fn is_empty(folder: &Path) -> bool {
    fs::read_dir(folder).unwrap().next().is_none()
}

#[test]
fn nothing_is_written_through_a_link_out_of_a_project() {
    for link in ["export", "export/nihao", ".lianpu", ".lianpu/lock", ".lianpu/journal"] {
        let (_dir, lesson, outside) = lesson();
        let at = lesson.join(link);
        fs::create_dir_all(at.parent().unwrap()).unwrap();
        let target =
            if link.ends_with("lock") || link.ends_with("journal") { outside.join("new") } else { outside.clone() };
        symlink(&target, &at).unwrap();
        let path = lesson.to_str().unwrap();
        let exported = lianpu(&["export", path, "--to", "png,srt", "--size", "96x54"]);
        assert_eq!(exported.status.success(), link.starts_with(".lianpu"), "{link}: {}", said(&exported));
        if link.starts_with("export") {
            assert!(
                said(&exported).contains("leads out") && said(&exported).contains("--out DIR"),
                "{}",
                said(&exported)
            );
        }
        lianpu(&["align", path, "--clip", "nihao"]);
        lianpu(&["face", path]);
        assert!(is_empty(&outside), "{link}");
    }
}

#[test]
fn links_within_a_project_are_followed() {
    let (_dir, lesson, _) = lesson();
    fs::create_dir_all(lesson.join("store/exported")).unwrap();
    for (file, link) in [("faces", "store/faces"), ("clips/nihao/script.txt", "store/said")] {
        fs::rename(lesson.join(file), lesson.join(link)).unwrap();
        symlink(lesson.join(link), lesson.join(file)).unwrap();
    }
    symlink("store/exported", lesson.join("export")).unwrap();
    let output = lianpu(&["export", lesson.to_str().unwrap(), "--to", "srt"]);
    assert!(output.status.success(), "{}", said(&output));
    assert!(lesson.join("store/exported/nihao.srt").is_file());
}

#[test]
fn no_pipe_and_no_device_keeps_a_command_waiting() {
    let (_dir, lesson, _) = lesson();
    let path = lesson.to_str().unwrap();
    fs::create_dir_all(lesson.join("export")).unwrap();
    fs::create_dir_all(lesson.join(".lianpu")).unwrap();
    pipe(&lesson.join("export/manifest.json"));
    pipe(&lesson.join(".lianpu/lock"));
    symlink("/dev/zero", lesson.join("export/manifest-1-of-2.json")).unwrap();
    let exported = lianpu(&["export", path, "--to", "srt"]);
    assert!(exported.status.success(), "{}", said(&exported));
    assert!(said(&exported).contains("manifest.json~"), "{}", said(&exported));
    assert!(!lianpu(&["align", path, "--clip", "nihao"]).status.success());
    fs::create_dir_all(lesson.join("clips/nihao/frames")).unwrap();
    pipe(&lesson.join("clips/nihao/frames/0000.png"));
    lianpu(&["check", path]);
    lianpu(&["track", path]);
    for name in ["script.txt", "timing.TextGrid", "score.toml"] {
        fs::remove_file(lesson.join("clips/nihao").join(name)).unwrap();
        symlink("/dev/zero", lesson.join("clips/nihao").join(name)).unwrap();
        assert!(!lianpu(&["check", path]).status.success(), "{name}");
        fs::remove_file(lesson.join("clips/nihao").join(name)).unwrap();
    }
    fs::remove_file(lesson.join("lianpu.toml")).unwrap();
    symlink("/dev/zero", lesson.join("lianpu.toml")).unwrap();
    assert!(!lianpu(&["check", path]).status.success());
}

#[test]
fn a_pipe_that_a_user_names_is_refused_with_what_to_do() {
    let dir = tempfile::tempdir().unwrap();
    let at = dir.path().join("pipe.srt");
    pipe(&at);
    let at = at.to_str().unwrap();
    for args in [
        vec!["convert", at, "--to", "vtt"],
        vec!["face", "--photo", at],
        vec!["align", "--speech", at, "--without-script"],
    ] {
        let output = lianpu(&args);
        assert_eq!(output.status.code(), Some(1), "{args:?}: {}", said(&output));
        assert!(said(&output).contains("a named pipe"), "{args:?}: {}", said(&output));
    }
}

#[test]
fn what_is_named_for_the_output_is_written_to_and_never_replaced() {
    let (dir, lesson, _) = lesson();
    let from = lesson.join("clips/nihao/timing.TextGrid");
    let convert = |out: &str| lianpu(&["convert", from.to_str().unwrap(), "--to", "srt", "--out", out]);
    let plain = dir.path().join("plain.srt");
    assert!(convert(plain.to_str().unwrap()).status.success());
    let text = fs::read(&plain).unwrap();
    assert!(convert("/dev/null").status.success());
    let full = convert("/dev/full");
    assert!(!full.status.success() && said(&full).contains("No space"), "{}", said(&full));
    for device in ["/dev/null", "/dev/full"] {
        assert!(!fs::symlink_metadata(device).unwrap().is_file(), "{device}");
    }
    assert_eq!(convert("/dev/stdout").stdout, text);
    // Through a link to the file that it names.
    let link = dir.path().join("link.srt");
    symlink("plain.srt", &link).unwrap();
    fs::write(&plain, "old").unwrap();
    assert!(convert(link.to_str().unwrap()).status.success());
    assert!(link.is_symlink() && fs::read(&plain).unwrap() == text);
    // Into a pipe that is read.
    let at = dir.path().join("pipe");
    pipe(&at);
    let reader = std::thread::spawn({
        let at = at.clone();
        move || fs::read(at).unwrap()
    });
    assert!(convert(at.to_str().unwrap()).status.success());
    assert_eq!(reader.join().unwrap(), text);
    assert!(!fs::symlink_metadata(&at).unwrap().is_file());
}

#[test]
fn an_export_sets_aside_what_is_of_no_export() {
    let (dir, lesson, _) = lesson();
    let out = dir.path().join("out");
    fs::create_dir_all(out.join("nihao")).unwrap();
    for name in ["manifest.json", "nihao.srt", "nihao.html", "nihao/000003.png"] {
        fs::write(out.join(name), "theirs").unwrap();
    }
    let args = ["export", lesson.to_str().unwrap(), "--to", "png,srt,html", "--clip", "nihao", "--size", "96x54"];
    let run = || lianpu(&[&args[..], &["--out", out.to_str().unwrap()]].concat());
    let output = run();
    assert!(output.status.success(), "{}", said(&output));
    for name in ["manifest.json", "nihao.srt", "nihao.html", "nihao/000003.png"] {
        assert_eq!(fs::read_to_string(out.join(format!("{name}~"))).unwrap(), "theirs", "{name}");
        assert_ne!(fs::read(out.join(name)).unwrap(), b"theirs", "{name}");
    }
    assert!(
        said(&output).contains("nihao.srt~") && said(&output).contains("1 file among the frames"),
        "{}",
        said(&output)
    );
    // Its own, whose manifest is gone, is written again.
    fs::remove_file(out.join("manifest.json")).unwrap();
    let output = run();
    assert!(output.status.success() && !said(&output).contains('~'), "{}", said(&output));
    // What was kept before is not lost to what is kept now.
    for name in ["nihao.srt", "nihao/000003.png"] {
        fs::write(out.join(name), "theirs again").unwrap();
    }
    let output = run();
    assert!(said(&output).contains("kept as nihao.srt~2"), "{}", said(&output));
    for name in ["nihao.srt", "nihao/000003.png"] {
        assert_eq!(fs::read_to_string(out.join(format!("{name}~"))).unwrap(), "theirs", "{name}");
        assert_eq!(fs::read_to_string(out.join(format!("{name}~2"))).unwrap(), "theirs again", "{name}");
    }
}

#[test]
fn what_an_export_has_set_aside_is_told_also_when_it_fails_then() {
    let (dir, lesson, _) = lesson();
    let out = dir.path().join("out");
    fs::create_dir_all(out.join("nihao.html")).unwrap();
    fs::write(out.join("nihao.srt"), "theirs").unwrap();
    let args = ["export", lesson.to_str().unwrap(), "--to", "srt,html", "--clip", "nihao"];
    let output = lianpu(&[&args[..], &["--out", out.to_str().unwrap()]].concat());
    assert_eq!(output.status.code(), Some(1), "{}", said(&output));
    assert!(said(&output).contains("kept as nihao.srt~"), "{}", said(&output));
    assert_eq!(fs::read_to_string(out.join("nihao.srt~")).unwrap(), "theirs");
}

#[test]
fn what_is_no_file_or_no_photo_in_a_lesson_is_wrong_and_not_overlooked() {
    for (name, word) in [
        ("clips/nihao/script.txt", "named pipe"),
        ("clips/nihao/score.toml", "named pipe"),
        ("clips/nihao/speech.wav", "named pipe"),
        ("faces/teacher/neutral.png", "can be read"),
    ] {
        let (_dir, lesson, _) = lesson();
        let at = lesson.join(name);
        let _ = fs::remove_file(&at);
        fs::create_dir_all(at.parent().unwrap()).unwrap();
        if name.ends_with("png") {
            fs::write(&at, "").unwrap();
        } else {
            pipe(&at);
        }
        let output = lianpu(&["check", lesson.to_str().unwrap()]);
        let all = String::from_utf8_lossy(&output.stdout).into_owned() + &said(&output);
        assert!(output.status.code() == Some(1) && all.contains(word), "{name}: {all}");
    }
}

#[test]
fn nothing_is_written_over_what_it_is_made_from_or_over_a_lesson() {
    let (dir, lesson, _) = lesson();
    let srt = dir.path().join("in.srt");
    fs::write(&srt, "1\n00:00:00,300 --> 00:00:00,660\n您\n").unwrap();
    let at = |name: &str| lesson.join(name).to_str().unwrap().to_owned();
    let (srt, project) = (srt.to_str().unwrap(), lesson.to_str().unwrap());
    let (script, times) = (at("clips/nihao/script.txt"), at("clips/nihao/timing.TextGrid"));
    for args in [
        vec!["convert", srt, "--to", "vtt", "--out", srt],
        vec!["convert", srt, "--to", "textgrid", "--out", &times],
        vec!["align", project, "--json", "--out", &script],
        vec!["plot", project, "--what", "timeline", "--out", &at("lianpu.toml")],
    ] {
        let output = lianpu(&args);
        assert!(
            output.status.code() == Some(2) && said(&output).contains("written over"),
            "{args:?} {}",
            said(&output)
        );
    }
}

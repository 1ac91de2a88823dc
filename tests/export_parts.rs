//! Exports in parts and again: together the parts are the whole, what is there is kept, and what was asked for is known
//! before it is made.

#![allow(clippy::unwrap_used, reason = "a test may stop")]

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use assert_cmd::Command;
use lianpu::export::{Asked, Exported, Format, Ledger, Manifest, Request, Shard, Step, asked, export};
use lianpu::project::Lesson;

/// Everything that needs no other program, small.
const FORMS: &str =
    "png,svg,smil,html,lottie,gif,apng,textgrid,srt,vtt,rhubarb,moho,wav,ratios,lpr,poses,mouths,layers";

fn sample(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("projects").join(name)
}

/// The program without `ffmpeg`, which makes sound slower and is told apart by its versions.
fn lianpu() -> Command {
    let mut command = Command::cargo_bin("lianpu").unwrap();
    command.env("PATH", "");
    command
}

fn call(out: &Path, frames: &str) -> Command {
    let mut command = lianpu();
    command.arg("export").args(["--to", FORMS, "--size", "96x54", "--frames", frames, "--out"]).arg(out);
    command.args([sample("nihao"), sample("seven-emotions")]);
    command
}

#[test]
fn parts_joined_are_the_whole_bit_for_bit() {
    let folder = tempfile::tempdir().unwrap();
    let (plain, parts) = (folder.path().join("plain"), folder.path().join("parts"));
    call(&plain, "0-9,12").assert().success();
    for part in ["1/4", "2/4", "4/4"] {
        call(&parts, "0-9,12").args(["--shard", part]).assert().success();
    }
    let missing = lianpu().arg("merge").arg(&parts).assert().failure();
    let said = String::from_utf8(missing.get_output().stderr.clone()).unwrap();
    assert!(said.contains("part 3/4") && said.contains("--shard 3/4"), "{said}");
    // The task of a job array that counts from 10 in steps of 5.
    let array = [("ID", "20"), ("MIN", "10"), ("COUNT", "4"), ("STEP", "5")];
    let mut third = call(&parts, "0-9,12");
    third.envs(array.map(|(name, value)| (format!("SLURM_ARRAY_TASK_{name}"), value))).assert().success();
    lianpu().arg("merge").arg(&parts).assert().success();
    let manifest = |folder: &Path| std::fs::read_to_string(folder.join("manifest.json")).unwrap();
    assert_eq!(manifest(&plain), manifest(&parts));
    let read = Manifest::read(&plain.join("manifest.json")).unwrap();
    assert_eq!(read.files.iter().filter(|f| f.path.ends_with("/000012.png")).count(), read.clips.len());
    // What was asked for and what is there are the same.
    let asked: BTreeSet<&String> = read.clips.iter().flat_map(|c| &c.whole).collect();
    let there: BTreeSet<&String> = read.files.iter().map(|f| &f.path).filter(|p| !is_frame(p)).collect();
    assert_eq!(asked, there);
    // A part of another export is refused.
    call(&parts, "0-9").args(["--shard", "2/4"]).assert().success();
    let mixed = lianpu().arg("merge").arg(&parts).assert().failure();
    let said = String::from_utf8(mixed.get_output().stderr.clone()).unwrap();
    assert!(said.contains("another export") && said.contains("11 frames and 10"), "{said}");
}

fn is_frame(path: &str) -> bool {
    let name = path.rsplit('/').next().unwrap_or_default();
    name.len() == 10 && name[..6].bytes().all(|b| b.is_ascii_digit())
}

#[test]
fn a_lesson_that_changes_between_two_parts_is_noticed() {
    let folder = tempfile::tempdir().unwrap();
    let (lesson, out) = (folder.path().join("lesson"), folder.path().join("out"));
    copy(&sample("nihao"), &lesson);
    let part = |part: &str| {
        let mut command = lianpu();
        command.arg("export").arg(&lesson).args(["--to", "srt", "--shard", part, "--out"]).arg(&out);
        command.assert().success();
    };
    part("1/2");
    let manifest = lesson.join("lianpu.toml");
    let text = std::fs::read_to_string(&manifest).unwrap();
    std::fs::write(&manifest, text + "\n# Seen again.\n").unwrap();
    part("2/2");
    let refused = lianpu().arg("merge").arg(&out).assert().failure();
    let said = String::from_utf8(refused.get_output().stderr.clone()).unwrap();
    assert!(said.contains("lesson"), "{said}");
}

fn copy(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap().flatten() {
        let target = to.join(entry.file_name());
        if entry.path().is_dir() {
            copy(&entry.path(), &target);
        } else {
            std::fs::copy(entry.path(), target).unwrap();
        }
    }
}

/// A GIF and an APNG of a few frames; `stop_at` stops it when the second has so many.
fn films(out: &Path, title: &str, stop_at: Option<u32>) -> (Exported, bool) {
    let mut lesson = Lesson::read(&sample("nihao")).unwrap();
    lesson.manifest.title = title.into();
    let request = Request {
        out: Some(out.into()),
        size: Some([96, 54]),
        frames: "0-11".parse().unwrap(),
        ..Request::new(vec![Format::Gif, Format::Apng])
    };
    let stop = AtomicBool::new(false);
    let mut ledger = Ledger::open(out, Shard::WHOLE);
    ledger.ask(asked(&lesson, &request).unwrap());
    let tell = |step: Step<'_>| {
        if let Step::Whole(whole, p) = step
            && whole.format == Format::Apng
            && stop_at.is_some_and(|at| p.done >= at)
        {
            stop.store(true, Ordering::Relaxed);
        }
    };
    let exported = export(&lesson, &request, &mut ledger, &tell, &stop).unwrap();
    let whole = !exported.report.stopped;
    if whole {
        ledger.close().unwrap();
    }
    (exported, whole)
}

#[test]
fn moving_pictures_are_kept_while_they_show_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path();
    let counts = |e: &Exported| (e.report.written, e.report.kept);
    let (first, whole) = films(out, "A", Some(5));
    assert_eq!((counts(&first), whole), ((1, 0), false));
    assert!(!out.join("nihao.apng").exists() && !out.join("manifest.json").exists());
    // What was made before the stop is known although there is no manifest.
    let (second, whole) = films(out, "A", None);
    assert_eq!((counts(&second), whole), ((1, 1), true));
    let (third, _) = films(out, "A", None);
    assert_eq!(counts(&third), (0, 2));
    // One that somebody damaged, and all when something else is to be shown.
    let gif = out.join("nihao.gif");
    let mut bytes = std::fs::read(&gif).unwrap();
    *bytes.last_mut().unwrap() ^= 1;
    std::fs::write(&gif, bytes).unwrap();
    let (fourth, _) = films(out, "A", None);
    assert_eq!(counts(&fourth), (1, 1));
    let (fifth, _) = films(out, "B", None);
    assert_eq!(counts(&fifth), (2, 0));
    let left: BTreeSet<String> =
        std::fs::read_dir(out).unwrap().flatten().map(|e| e.file_name().to_string_lossy().into_owned()).collect();
    assert_eq!(left, ["manifest.json", "nihao.apng", "nihao.gif"].map(String::from).into());
}

#[test]
fn what_is_asked_of_a_clip_is_told_alike_for_every_share() {
    let lesson = Lesson::read(&sample("nihao")).unwrap();
    let all = Request::new(Format::ALL.to_vec());
    let clips: Vec<Asked> = asked(&lesson, &all).unwrap();
    let one = Request { shares: Some(Vec::new()), ..all };
    assert_eq!(clips, asked(&lesson, &one).unwrap());
    assert_eq!(clips[0].whole.iter().filter(|w| w.starts_with("lesson.")).count(), 2);
}

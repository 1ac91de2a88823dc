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
    // What was damaged may have been somebody's work.
    assert_eq!(left, ["manifest.json", "nihao.apng", "nihao.gif", "nihao.gif~"].map(String::from).into());
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

/// `lianpu export` of a lesson's parts into a folder.
fn part(lesson: &Path, out: &Path, part: &str, forms: &str) -> assert_cmd::assert::Assert {
    let mut command = lianpu();
    command.arg("export").arg(lesson).args(["--to", forms, "--size", "96x54", "--shard", part, "--out"]).arg(out);
    command.assert()
}

fn merged(out: &Path) -> (bool, String) {
    let run = lianpu().arg("merge").arg(out).output().unwrap();
    (run.status.success(), String::from_utf8(run.stderr).unwrap())
}

#[test]
fn a_style_that_changes_between_two_parts_is_noticed_as_well() {
    let folder = tempfile::tempdir().unwrap();
    let (lesson, out) = (folder.path().join("lesson"), folder.path().join("out"));
    copy(&sample("nihao"), &lesson);
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let style = std::fs::read_to_string(root.join("src/figure/cartoon/styles/normal.toml")).unwrap();
    std::fs::create_dir(lesson.join("styles")).unwrap();
    std::fs::write(lesson.join("styles/own.toml"), &style).unwrap();
    let manifest = std::fs::read_to_string(lesson.join("lianpu.toml")).unwrap();
    let own = manifest.replace("figure = \"cartoon\"", "figure = \"cartoon\"\nstyle = \"styles/own.toml\"");
    assert_ne!(own, manifest);
    std::fs::write(lesson.join("lianpu.toml"), own).unwrap();
    part(&lesson, &out, "1/2", "png").success();
    std::fs::write(lesson.join("styles/own.toml"), style.clone() + "\n# Another.\n").unwrap();
    part(&lesson, &out, "2/2", "png").success();
    let (done, said) = merged(&out);
    assert!(!done && said.contains("part 2/2 is of another export"), "{said}");
}

#[cfg(unix)]
#[test]
fn what_a_lesson_s_folder_holds_beside_the_lesson_neither_stops_an_export_nor_leads_out_of_it() {
    let folder = tempfile::tempdir().unwrap();
    let lesson = folder.path().join("lesson");
    copy(&sample("nihao"), &lesson);
    let clip = lesson.join("clips/nihao");
    let state = || {
        let lesson = Lesson::read(&lesson).unwrap();
        asked(&lesson, &Request::new(vec![Format::Srt])).unwrap()[0].settings["lesson"].clone()
    };
    let before = state();
    let elsewhere = folder.path().join("elsewhere");
    std::fs::create_dir(&elsewhere).unwrap();
    std::os::unix::fs::symlink(&elsewhere, clip.join("out")).unwrap();
    std::os::unix::fs::symlink(".", clip.join("round")).unwrap();
    let pipe = std::process::Command::new("mkfifo").arg(clip.join("pipe")).status();
    assert!(pipe.is_err() || clip.join("pipe").exists());
    let with_links = state();
    assert_ne!(before, with_links);
    std::fs::write(elsewhere.join("more"), "more").unwrap();
    assert_eq!(with_links, state(), "what a link leads to is not read");
}

#[test]
fn a_part_that_fails_is_not_done_and_frames_of_a_longer_export_go() {
    let folder = tempfile::tempdir().unwrap();
    let (course, out) = (folder.path().join("course"), folder.path().join("out"));
    copy(&sample("nihao"), &course.join("one"));
    copy(&sample("nihao"), &course.join("two"));
    part(&course, &out, "1/2", "png").success();
    part(&course, &out, "2/2", "png").success();
    assert!(merged(&out).0);
    let manifest = course.join("two/lianpu.toml");
    let good = std::fs::read_to_string(&manifest).unwrap();
    std::fs::write(&manifest, "format = 1\nnonsense").unwrap();
    part(&course, &out, "1/2", "png").failure();
    let (done, said) = merged(&out);
    assert!(!done && said.contains("1/2"), "{said}");
    // At half the frames a second half of the frames are left over, whichever part removes them.
    std::fs::write(&manifest, good).unwrap();
    for index in ["1/3", "2/3", "3/3"] {
        let mut command = lianpu();
        command.arg("export").arg(&course).args(["--to", "png", "--size", "96x54", "--fps", "12.5", "--shard", index]);
        command.arg("--out").arg(&out).assert().success();
    }
    let (done, said) = merged(&out);
    assert!(done, "the manifests of another division are gone: {said}");
    let frames = std::fs::read_dir(out.join("one/nihao")).unwrap().count();
    let listed = Manifest::read(&out.join("manifest.json")).unwrap();
    assert_eq!(frames, listed.files.iter().filter(|f| f.path.starts_with("one/")).count());
}

#[test]
fn several_exports_into_one_place_at_once_lose_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let forms = ["srt", "vtt", "textgrid", "rhubarb", "moho", "poses", "ratios", "gif"];
    let runs: Vec<_> = forms
        .iter()
        .map(|form| {
            let mut command = std::process::Command::new(assert_cmd::cargo::cargo_bin("lianpu"));
            command.arg("export").arg(sample("nihao")).args(["--to", form, "--size", "48x27", "--out"]).arg(&out);
            command.stdout(std::process::Stdio::null()).stderr(std::process::Stdio::null()).spawn().unwrap()
        })
        .collect();
    assert!(runs.into_iter().all(|mut run| run.wait().unwrap().success()));
    let manifest = Manifest::read(&out.join("manifest.json")).unwrap();
    let listed: BTreeSet<&str> = manifest.files.iter().map(|f| f.path.as_str()).collect();
    let there: Vec<String> =
        std::fs::read_dir(&out).unwrap().flatten().map(|e| e.file_name().to_string_lossy().into_owned()).collect();
    let there: BTreeSet<&str> = there.iter().map(String::as_str).filter(|n| *n != "manifest.json").collect();
    assert_eq!(listed, there);
    let asked: BTreeSet<&str> = manifest.clips.iter().flat_map(|c| &c.whole).map(String::as_str).collect();
    assert_eq!(asked, listed);
    assert!(merged(&out).0);
}

#[test]
fn a_manifest_says_what_is_there_after_other_forms_and_other_frames() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let export = |words: &[&str]| {
        let mut command = lianpu();
        command.arg("export").arg(sample("nihao")).args(["--size", "96x54", "--out"]).arg(&out).args(words);
        command.assert().success();
        Manifest::read(&out.join("manifest.json")).unwrap()
    };
    export(&["--to", "svg,srt", "--frames", "0-2"]);
    let two = export(&["--to", "png", "--frames", "5-6"]);
    let rows: Vec<_> = two.clips.iter().map(|c| (c.frame_forms.join(","), c.frames.clone(), c.whole.len())).collect();
    assert_eq!(rows, [("png".into(), vec![(5, 6)], 0), ("svg".into(), vec![(0, 2)], 2)]);
    // Some of them in another size, and one file gone.
    std::fs::remove_file(out.join("nihao.srt")).unwrap();
    let three = export(&["--to", "svg", "--frames", "2", "--background", "white"]);
    let rows: Vec<_> = three.clips.iter().map(|c| (c.frame_forms.join(","), c.frames.clone(), c.whole.len())).collect();
    assert_eq!(
        rows,
        [("svg".into(), vec![(2, 2)], 0), ("png".into(), vec![(5, 6)], 0), ("svg".into(), vec![(0, 1)], 1)]
    );
    assert!(merged(&out).0);
}

#[test]
fn names_that_would_meet_are_refused_before_anything_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let lesson = folder.path().join("lesson");
    copy(&sample("nihao"), &lesson);
    let refused = |clips: [&str; 2], words: &[&str]| {
        std::fs::remove_dir_all(lesson.join("clips")).unwrap();
        for clip in clips {
            copy(&sample("nihao").join("clips/nihao"), &lesson.join("clips").join(clip));
        }
        let rows = clips.map(|c| format!("[[clip]]\nname = \"{c}\"\nscript_system = \"han\"\n"));
        let face = "[[face]]\nname = \"teacher\"\nfigure = \"cartoon\"\n";
        std::fs::write(lesson.join("lianpu.toml"), format!("format = 1\ntitle = \"A\"\n{face}{}{}", rows[0], rows[1]))
            .unwrap();
        let out = folder.path().join("out");
        let run = lianpu().arg("export").arg(&lesson).args(words).arg("--out").arg(&out).output().unwrap();
        (run.status.code() == Some(2) && !out.exists(), String::from_utf8(run.stderr).unwrap())
    };
    for (clips, words) in [
        (["a", "a.gif"], &["--to", "png,gif"][..]),
        (["a", "manifest-1-of-2"], &["--to", "lottie", "--shard", "1/2"]),
        (["a", "lesson"], &["--to", "html", "--clip", "lesson"]),
    ] {
        let (right, said) = refused(clips, words);
        assert!(right && said.contains("rename"), "{clips:?}: {said}");
    }
}

#[test]
fn a_lesson_without_the_clip_that_is_asked_for_does_not_stop_the_others() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let mut command = lianpu();
    command.arg("export").args([sample("seven-emotions"), sample("nihao")]).args(["--to", "srt", "--clip", "nihao"]);
    let run = command.arg("--out").arg(&out).output().unwrap();
    assert_eq!(run.status.code(), Some(1));
    assert!(out.join("nihao/nihao.srt").exists() && out.join("manifest.json").exists());
}

#[test]
fn merge_names_every_part_that_has_to_be_run_again() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    for index in ["1/2", "2/2"] {
        part(&sample("nihao"), &out, index, "png,srt").success();
    }
    std::fs::remove_file(out.join("nihao/000040.png")).unwrap();
    std::fs::write(out.join("nihao.srt"), "mine").unwrap();
    let (done, said) = merged(&out);
    assert!(!done && said.contains("another file") && said.contains("--shard 1/2, and then 2/2"), "{said}");
}

#[cfg(unix)]
#[test]
fn equal_frames_are_links_beside_svg_as_well_and_no_pipe_keeps_an_export_waiting() {
    use std::os::unix::fs::MetadataExt;
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    std::fs::create_dir(&out).unwrap();
    let pipe = std::process::Command::new("mkfifo").arg(out.join("nihao.srt")).status();
    let mut command = lianpu();
    command.arg("export").arg(sample("nihao")).args(["--to", "png,svg,srt", "--size", "96x54", "--out"]).arg(&out);
    command.timeout(std::time::Duration::from_secs(60)).assert().success();
    let inodes = |ending: &str| {
        let files = std::fs::read_dir(out.join("nihao")).unwrap().flatten();
        let own = files.filter(|f| f.path().extension().is_some_and(|e| e == ending));
        own.map(|f| f.metadata().unwrap().ino()).collect::<BTreeSet<u64>>().len()
    };
    assert_eq!(inodes("svg"), 44, "each says its time");
    assert!(inodes("png") < 44 || pipe.is_err());
    assert!(out.join("nihao.srt").is_file());
}

#[test]
fn subtitles_keep_the_marks_of_what_is_said_and_verses_their_lines() {
    let folder = tempfile::tempdir().unwrap();
    let (lesson, out) = (folder.path().join("lesson"), folder.path().join("out"));
    copy(&sample("nihao"), &lesson);
    std::fs::remove_file(lesson.join("clips/nihao/timing.TextGrid")).unwrap();
    std::fs::write(lesson.join("clips/nihao/script.txt"), "“您好！”他说：《红楼梦》\n床前明月光\n疑是地上霜").unwrap();
    lianpu().arg("export").arg(&lesson).args(["--to", "srt,vtt,html", "--out"]).arg(&out).assert().success();
    let read = |name: &str| std::fs::read_to_string(out.join(name)).unwrap();
    let cues: Vec<String> =
        read("nihao.srt").lines().filter(|l| l.chars().any(|c| c > '\u{2000}')).map(str::to_owned).collect();
    assert_eq!(cues.join("|"), "“您好！”|他说：|《红楼梦》|床前明月光|疑是地上霜");
    let plain = |line: &str| {
        let mut inside = false;
        line.chars()
            .filter(|c| {
                inside = (inside || *c == '<') && *c != '>';
                !inside && *c != '>'
            })
            .collect::<String>()
    };
    let in_vtt: Vec<String> =
        read("nihao.vtt").lines().filter(|l| l.chars().any(|c| c > '\u{2000}')).map(plain).collect();
    assert_eq!(cues, in_vtt);
}

#[test]
fn what_somebody_has_changed_is_kept_beside_what_is_written_anew() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let export = || {
        let mut command = lianpu();
        command.arg("export").arg(sample("nihao")).args(["--to", "srt,wav", "--out"]).arg(&out);
        String::from_utf8(command.assert().success().get_output().stderr.clone()).unwrap()
    };
    assert!(!export().contains('~'));
    std::fs::write(out.join("nihao.srt"), "mine").unwrap();
    std::fs::remove_file(out.join("nihao.wav")).unwrap();
    let said = export();
    assert!(said.contains("nihao.srt was changed") && !said.contains("wav was"), "{said}");
    assert_eq!(std::fs::read(out.join("nihao.srt~")).unwrap(), b"mine");
    assert_ne!(std::fs::read(out.join("nihao.srt")).unwrap(), b"mine");
    assert!(!export().contains('~'));
}

#[test]
fn a_frame_that_somebody_has_changed_is_kept_beside_and_those_of_a_run_that_was_killed_are_not() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let export = |size: &str| {
        let mut command = lianpu();
        let forms = ["--to", "svg,png", "--frames", "0-5", "--dedupe", "none", "--size", size, "--out"];
        command.arg("export").arg(sample("nihao")).args(forms).arg(&out);
        String::from_utf8(command.assert().success().get_output().stderr.clone()).unwrap()
    };
    export("96x54");
    let [svg, png] = ["svg", "png"].map(|form| out.join(format!("nihao/000002.{form}")));
    let drawn = std::fs::read_to_string(&svg).unwrap().replace("</svg>", "<circle r=\"9\"/></svg>");
    std::fs::write(&svg, &drawn).unwrap();
    let told = export("96x54");
    assert!(told.contains("1 file among the frames"), "{told}");
    assert_eq!(std::fs::read_to_string(out.join("nihao/000002.svg~")).unwrap(), drawn);
    assert!(!std::fs::read_to_string(&svg).unwrap().contains("circle r=\"9\""));
    assert!(!export("98x54").contains('~'), "another size is nobody's change");

    // Killed in the middle: frames are newer than the manifest, and its draft says so.
    let kept =
        ["manifest.json", "nihao/000003.png"].map(|name| (out.join(name), std::fs::read(out.join(name)).unwrap()));
    export("96x54");
    std::fs::write(&kept[0].0, &kept[0].1).unwrap();
    std::fs::write(&kept[1].0, &kept[1].1).unwrap();
    std::fs::copy(out.join("manifest.json"), out.join(".manifest.json.part")).unwrap();
    assert!(!export("100x54").contains('~'));
    assert!(!out.join(".manifest.json.part").exists());
    assert!(png.exists() && !out.join("nihao/000003.png~").exists());
}

#[test]
fn without_ffmpeg_a_video_is_refused_before_anything_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let run =
        lianpu().arg("export").arg(sample("nihao")).args(["--to", "srt,mp4,html", "--out"]).arg(&out).output().unwrap();
    let said = String::from_utf8(run.stderr).unwrap();
    assert!(!run.status.success() && !out.exists() && said.contains("`ffmpeg`"), "{said}");
}

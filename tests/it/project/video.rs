//! A lesson with a video, by the program as a teacher runs it: calibrated, followed, looked at, changed, followed again.

#![allow(clippy::unwrap_used, reason = "a test may stop")]

use std::path::{Path, PathBuf};

use assert_cmd::Command;
use lianpu::calibration::Kept;
use lianpu::project::{Lesson, Method, TrackJob};
use lianpu::ratios::Record;
use lianpu::track::Options;

/// A copy of the sample lesson without anything that was found in it, its video cut to a second.
fn copied() -> (tempfile::TempDir, PathBuf) {
    let from = Path::new(env!("CARGO_MANIFEST_DIR")).join("projects/xiyang");
    let room = tempfile::tempdir().unwrap();
    let root = room.path().join("xiyang");
    for folder in ["faces/teacher", "clips/xiyang/frames"] {
        std::fs::create_dir_all(root.join(folder)).unwrap();
        for entry in std::fs::read_dir(from.join(folder)).unwrap().flatten() {
            let path = entry.path();
            let name = path.file_name().unwrap().to_str().unwrap();
            let is_picture = name.ends_with(".png") || name.ends_with(".jpg");
            if is_picture && (!folder.ends_with("frames") || name < "0025") {
                std::fs::copy(&path, root.join(folder).join(name)).unwrap();
            }
        }
    }
    for name in ["lianpu.toml", "faces/teacher/face.toml", "clips/xiyang/script.txt", "clips/xiyang/speech.wav"] {
        std::fs::copy(from.join(name), root.join(name)).unwrap();
    }
    (room, root)
}

fn lianpu(words: &[&str], root: &Path) -> (String, String, bool) {
    let done = Command::cargo_bin("lianpu").unwrap().args(words).arg(root).output().unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (text(&done.stdout), text(&done.stderr), done.status.success())
}

#[test]
fn a_video_is_followed_kept_and_never_over_what_somebody_set() {
    let (_room, root) = copied();
    let clip = root.join("clips/xiyang");
    let ratios = || std::fs::read_to_string(clip.join("ratios.csv")).unwrap();

    let (said, _, fine) = lianpu(&["calibrate"], &root);
    assert!(fine && said.contains("hardest to tell apart") && said.contains("calibration.toml"), "{said}");
    let (said, _, _) = lianpu(&["calibrate"], &root);
    assert!(said.contains("nothing has changed"), "the same photos give the same bytes: {said}");

    let (said, notes, fine) = lianpu(&["track"], &root);
    assert!(fine && said.contains("25 frames followed"), "{said}{notes}");
    let found = ratios();
    assert_eq!(Record::parse(&found).unwrap().rows.len(), 25);
    let (_, notes, _) = lianpu(&["track"], &root);
    assert!(notes.contains("what was found stays"), "{notes}");
    let (said, _, fine) = lianpu(&["check"], &root);
    assert!(fine && said.contains("25 rows of ratios") && !said.contains("never"), "{said}");

    // What a hand has changed is hers.
    let own = found.replacen("\n0,0,", "\n0,0.000001,", 1);
    std::fs::write(clip.join("ratios.csv"), &own).unwrap();
    let (_, notes, fine) = lianpu(&["track"], &root);
    assert!(fine && notes.contains("--replace"), "{notes}");
    assert_eq!(ratios(), own);
    let (said, notes, fine) = lianpu(&["track", "--replace"], &root);
    assert!(fine && said.contains("25 frames followed"), "{said}{notes}");
    assert_eq!(ratios(), found, "the same video and the same calibration give the same bytes");

    // Another calibration is another record.
    std::fs::remove_file(root.join("faces/teacher/fear.jpg")).unwrap();
    let (said, _, _) = lianpu(&["check"], &root);
    assert!(said.contains("changed since it was calibrated"), "{said}");
    let (said, notes, _) = lianpu(&["track"], &root);
    assert!(said.contains("followed") && notes.contains("have changed since"), "{said}{notes}");
    assert_ne!(ratios(), found);
}

/// Writes a calibration of the lesson's face.
fn keep(root: &Path, kept: &Kept) {
    Lesson::open(root).unwrap().keep_calibration(0, kept).unwrap();
}

#[test]
fn what_was_followed_is_a_change_like_any_other() {
    let (_room, root) = copied();
    keep(&root, &Kept::make(&root.join("faces/teacher")).unwrap());
    let record = root.join("clips/xiyang/ratios.csv");
    let mut lesson = Lesson::open(&root).unwrap();
    let found = TrackJob::of(&lesson, 0, Method::Aam, Options::default()).unwrap().run(&mut |_, _| true).unwrap();
    let change = lesson.tracked(0, &found.tracked, &found.checksum).unwrap();
    lesson.change(change).unwrap();
    assert!(lesson.clips[0].record.is_some() && lesson.clips[0].tracks.is_some() && !record.exists());
    // The connection is lost: the journal has it.
    drop(lesson);
    let mut lesson = Lesson::open(&root).unwrap();
    assert_eq!(lesson.recovered, 1);
    assert!(lesson.clips[0].record.is_some());
    lesson.save().unwrap();
    assert!(record.is_file());
    lesson.undo().unwrap();
    assert!(lesson.clips[0].record.is_none() && lesson.clips[0].score.tracked.is_none());
    lesson.save().unwrap();
    assert!(!record.exists(), "what tracking wrote goes with its undo");
    lesson.redo().unwrap();
    lesson.save().unwrap();
    assert_eq!(std::fs::read_to_string(&record).unwrap(), found.tracked.record.to_csv());
    // Stopped, it changes nothing.
    let job = TrackJob::of(&lesson, 0, Method::Regions, Options::default()).unwrap();
    assert!(job.run(&mut |done, _| done < 3).is_err());
}

#[test]
fn a_calibration_outlives_its_photos() {
    let (_room, root) = copied();
    let face = root.join("faces/teacher");
    let made = Kept::make(&face).unwrap();
    keep(&root, &made);
    for entry in std::fs::read_dir(&face).unwrap().flatten() {
        if entry.path().extension().is_some_and(|e| e == "png" || e == "jpg") {
            std::fs::remove_file(entry.path()).unwrap();
        }
    }
    let (kept, notes) = Kept::of(&face).unwrap();
    assert_eq!(kept.fingerprint(), made.fingerprint());
    assert!(notes.iter().any(|n| n.to_string().contains("as it was kept")), "{notes:?}");
}

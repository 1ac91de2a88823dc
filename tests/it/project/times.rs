//! The times of a lesson's clips: found in the sound, kept where a hand set them, taken from whatever a file calls them.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use std::path::{Path, PathBuf};
use std::process::Command;

use lianpu::project::{AlignJob, Change, ClipEdit, Edit, Lesson, NewLesson, create};
use lianpu::timing::{Interval, Tier, Timing};
use serde_json::Value;

/// The sample's recording: 您 from 0.300 to 0.749 s, 好 from 0.766 to 1.284 s.
fn recording() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("projects/nihao/clips/nihao/speech.wav")
}

const TRUTH: [(f64, f64); 2] = [(0.300, 0.749), (0.766, 1.284)];

/// A lesson of the sample's recording, its folder kept as long as the first value.
fn lesson(script: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("script.txt");
    std::fs::write(&path, script).unwrap();
    let root = folder.path().join("hello");
    let new = NewLesson { speech: Some(recording()), script: Some(path), ..NewLesson::default() };
    create(&root, &new, &mut |_, _| true).unwrap();
    (folder, root)
}

/// Leaves a lesson as it was before it was ever aligned.
fn forget_times(root: &Path) {
    std::fs::remove_file(root.join("clips/hello/timing.TextGrid")).unwrap();
    std::fs::remove_file(root.join("clips/hello/score.toml")).unwrap();
}

fn times(lesson: &Lesson) -> Vec<(f64, f64)> {
    lesson.clips[0].intervals().iter().map(|i| (i.start, i.end)).collect()
}

fn close(found: &[(f64, f64)], expected: &[(f64, f64)], by: f64) -> bool {
    found.len() == expected.len()
        && found.iter().zip(expected).all(|(a, b)| (a.0 - b.0).abs() < by && (a.1 - b.1).abs() < by)
}

/// A change that ends the first syllable earlier, and vouches for it.
fn end_first_at(lesson: &Lesson, end: f64) -> Change {
    let before = vec![times(lesson)[0]];
    let after = vec![(before[0].0, end)];
    let edits = vec![
        Edit::Clip(0, ClipEdit::Times { first: 0, before, after }),
        Edit::Clip(0, ClipEdit::Pin { index: 0, pinned: true }),
    ];
    Change { label: "shorter".into(), edits }
}

fn align(lesson: &mut Lesson) {
    let (_, found) = AlignJob::of(lesson, &[0]).unwrap().run().pop().unwrap();
    let found = found.unwrap();
    if let Some(change) = lesson.aligned(0, &found) {
        lesson.change(change).unwrap();
    }
}

#[test]
fn a_new_lesson_has_the_times_of_its_sound_and_says_how_sure_it_is() {
    let (_folder, root) = lesson("您好。");
    let lesson = Lesson::read(&root).unwrap();
    let clip = &lesson.clips[0];
    assert!(close(&times(&lesson), &TRUTH, 0.05), "{:?}", times(&lesson));
    assert!(!clip.timing.guessed && !clip.wants_alignment() && clip.syllables_with_phones() == 2);
    let tiers: Vec<&str> = clip.timing.tiers.iter().map(|t| t.name.as_str()).collect();
    assert_eq!(tiers, ["words", "syllables", "phones", "confidence"]);
    assert_eq!(clip.timing.tier("words").unwrap().intervals[0].label, "您好");
    assert!((0..2).all(|i| clip.confidence(i).is_some_and(|c| c > 0.75)) && clip.doubts().is_empty());
}

#[test]
fn what_a_hand_has_set_stays_to_the_microsecond_when_the_rest_is_found_anew() {
    let (_folder, root) = lesson("您好。");
    let mut lesson = Lesson::open(&root).unwrap();
    let change = end_first_at(&lesson, 0.6);
    lesson.change(change).unwrap();
    align(&mut lesson);
    assert_eq!(times(&lesson)[0].1, 0.6);
    assert!(times(&lesson)[1].0 >= 0.6);
    assert_eq!(lesson.clips[0].confidence(0), Some(1.0));
    lesson.save().unwrap();
    drop(lesson);
    let lesson = Lesson::read(&root).unwrap();
    assert!((times(&lesson)[0].1 - 0.6).abs() < 1e-6 && lesson.clips[0].score.pins == [0]);
}

#[test]
fn phones_and_words_go_with_the_syllable_they_are_in_and_come_back_with_it() {
    let (_folder, root) = lesson("您好。");
    let mut lesson = Lesson::open(&root).unwrap();
    let before = lesson.clips[0].timing.clone();
    let change = end_first_at(&lesson, 0.6);
    lesson.change(change).unwrap();
    let phones = lesson.clips[0].timing.tier("phones").unwrap();
    assert_eq!(phones.intervals[2].end, 0.6);
    assert!(phones.intervals.windows(2).all(|w| w[0].end <= w[1].start + 1e-9));
    assert_eq!(lesson.clips[0].syllables_with_phones(), 2);
    lesson.undo().unwrap();
    let after = &lesson.clips[0].timing;
    for (a, b) in before.tiers.iter().zip(&after.tiers) {
        let near = |a: &Interval, b: &Interval| (a.start - b.start).abs() < 1e-9 && (a.end - b.end).abs() < 1e-9;
        assert!(a.intervals.iter().zip(&b.intervals).all(|(a, b)| near(a, b)), "{}", a.name);
    }
}

#[test]
fn an_alignment_is_one_change_that_undo_takes_back() {
    let (_folder, root) = lesson("您好。");
    forget_times(&root);
    let mut lesson = Lesson::open(&root).unwrap();
    assert!(lesson.clips[0].timing.guessed && lesson.clips[0].wants_alignment());
    let guessed = times(&lesson);
    align(&mut lesson);
    assert!(close(&times(&lesson), &TRUTH, 0.05) && !lesson.clips[0].timing.guessed);
    lesson.undo().unwrap();
    assert!(lesson.clips[0].timing.guessed && times(&lesson) == guessed);
    lesson.redo().unwrap();
    assert!(close(&times(&lesson), &TRUTH, 0.05));
}

#[test]
fn a_corrected_script_is_aligned_anew_and_keeps_what_a_hand_set() {
    let (_folder, root) = lesson("您早。");
    let mut lesson = Lesson::open(&root).unwrap();
    let change = end_first_at(&lesson, 0.7);
    lesson.change(change).unwrap();
    lesson.save().unwrap();
    drop(lesson);
    std::fs::write(root.join("clips/hello/script.txt"), "您好。").unwrap();
    let mut lesson = Lesson::open(&root).unwrap();
    assert!(lesson.clips[0].wants_alignment());
    assert!(
        lesson.clips[0].warnings.iter().any(|w| w.to_string().contains("has changed")),
        "{:?}",
        lesson.clips[0].warnings
    );
    align(&mut lesson);
    assert!((times(&lesson)[0].1 - 0.7).abs() < 1e-6, "{:?}", times(&lesson));
    assert_eq!(lesson.clips[0].score.pins, [0]);
    lesson.save().unwrap();
    drop(lesson);
    let lesson = Lesson::read(&root).unwrap();
    assert!(!lesson.clips[0].wants_alignment() && lesson.clips[0].syllables[1].text == "好");
}

/// A lesson whose times come from a file.
fn with_times(timing: &Timing, script: &str) -> Lesson {
    let folder = tempfile::tempdir().unwrap();
    let (times, text) = (folder.path().join("times.TextGrid"), folder.path().join("script.txt"));
    std::fs::write(&times, lianpu::timing::write(timing, lianpu::timing::Format::TextGrid)).unwrap();
    std::fs::write(&text, script).unwrap();
    let new = NewLesson { timing: Some(times), script: Some(text), ..NewLesson::default() };
    create(&folder.path().join("hello"), &new, &mut |_, _| true).unwrap().lesson
}

/// A tier: its name, and when each label starts and ends.
type Labels<'a> = (&'a str, &'a [(f64, f64, &'a str)]);

fn timing(tiers: &[Labels<'_>]) -> Timing {
    let mut timing = Timing { duration: 2.0, ..Timing::default() };
    for (name, labels) in tiers {
        let intervals = labels.iter().map(|(a, b, l)| Interval::new(*a, *b, *l)).collect();
        timing.set_tier(Tier { name: (*name).into(), intervals });
    }
    timing
}

#[test]
fn the_tier_that_says_the_script_is_taken_whatever_it_is_called() {
    let file = timing(&[("Mary", &[(0.1, 0.5, "您"), (0.5, 0.9, "好")]), ("notes", &[(0.0, 1.0, "loud")])]);
    let lesson = with_times(&file, "您好");
    assert_eq!(times(&lesson), [(0.1, 0.5), (0.5, 0.9)]);
    assert!(!lesson.clips[0].timing.guessed);
}

#[test]
fn words_and_subtitles_share_their_time_among_their_syllables() {
    let file = timing(&[("words", &[(0.2, 0.8, "您好，"), (1.0, 1.4, "老師")]), ("notes", &[(0.0, 1.0, "loud")])]);
    let lesson = with_times(&file, "您好，老師。");
    assert!(close(&times(&lesson), &[(0.2, 0.5), (0.5, 0.8), (1.0, 1.2), (1.2, 1.4)], 1e-9), "{:?}", times(&lesson));
    // Somebody's own times, which nothing replaces unasked.
    assert!(!lesson.clips[0].wants_alignment());
    assert!(lesson.clips[0].warnings.iter().any(|w| w.to_string().contains("words or phrases")));
}

#[test]
fn a_file_of_mouth_shapes_alone_moves_the_mouth() {
    let file = timing(&[("shapes", &[(0.2, 0.5, "m"), (0.5, 0.9, "a")])]);
    let lesson = with_times(&file, "媽");
    let timeline = lesson.timeline(0, None);
    assert_eq!(timeline.mouth(0.3).0.opening(), 0.0);
    assert!(timeline.mouth(0.8).0.opening() > 0.5);
}

fn lianpu(args: &[&str]) -> (i32, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_lianpu")).args(args).output().unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code().unwrap(), text(&output.stdout), text(&output.stderr))
}

#[test]
fn the_command_prints_an_object_a_syllable_and_writes_what_it_is_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let script = folder.path().join("script.txt");
    std::fs::write(&script, "您好。").unwrap();
    let (speech, script) = (recording().display().to_string(), script.display().to_string());
    let (code, out, err) = lianpu(&["align", "--speech", &speech, "--script", &script, "--json"]);
    assert_eq!((code, err.as_str()), (0, ""));
    let said: Value = serde_json::from_str(&out).unwrap();
    let first = &said[0];
    assert_eq!((first["text"].as_str(), first["pinyin"].as_str()), (Some("您"), Some("nin2")));
    assert!((first["start"].as_f64().unwrap() - 0.3).abs() < 0.05 && first["confidence"].as_f64().unwrap() > 0.75);
    let phones: Vec<&str> = first["phones"].as_array().unwrap().iter().map(|p| p["phone"].as_str().unwrap()).collect();
    assert_eq!(phones, ["n", "i", "n"]);
    assert_eq!(first["phones"][2]["end"], first["end"]);

    let grid = folder.path().join("times.TextGrid").display().to_string();
    let (code, out, _) = lianpu(&["align", "--speech", &speech, "--script", &script, "--out", &grid]);
    assert_eq!((code, out.as_str()), (0, ""));
    let tiers: Vec<String> =
        lianpu::timing::read(Path::new(&grid)).unwrap().tiers.into_iter().map(|t| t.name).collect();
    assert_eq!(tiers, ["words", "syllables", "phones", "confidence"]);

    let (code, out, _) = lianpu(&["align", "--speech", &speech, "--without-script", "--json"]);
    let marks: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(code, 0);
    let syllables = marks.as_array().unwrap().iter().filter(|m| m["kind"] == "syllable").count();
    assert_eq!(syllables, 2, "{out}");
}

#[test]
fn the_command_says_what_is_missing_and_leaves_other_people_s_times_alone() {
    let speech = recording().display().to_string();
    for (args, code) in [
        (vec!["align"], 2),
        (vec!["align", "--speech", &speech], 2),
        (vec!["align", "--speech", "nowhere.wav", "--script", "nowhere.txt"], 1),
        (vec!["align", "--speech", &speech, "--script", &speech], 1),
        (vec!["align", "nowhere"], 1),
    ] {
        let (found, _, err) = lianpu(&args);
        assert_eq!(found, code, "{args:?}: {err}");
        assert!(!err.is_empty());
    }
    let (_folder, root) = lesson("您好。");
    let grid = root.join("clips/hello/timing.TextGrid");
    // Somebody's own times: nothing says that an alignment made them.
    std::fs::remove_file(root.join("clips/hello/score.toml")).unwrap();
    let before = std::fs::read(&grid).unwrap();
    let path = root.display().to_string();
    let (code, _, err) = lianpu(&["align", &path]);
    assert_eq!(code, 0);
    assert!(err.contains("times of its own"), "{err}");
    assert_eq!(std::fs::read(&grid).unwrap(), before);
    assert_eq!(lianpu(&["align", &path, "--clip", "hello"]).0, 0);
    let (_, _, err) = lianpu(&["align", &path]);
    assert!(err.contains("its times stay"), "{err}");
}

#[test]
fn an_export_of_a_lesson_that_was_never_aligned_finds_its_times_and_leaves_it_as_it_is() {
    let (_folder, root) = lesson("您好。");
    forget_times(&root);
    let out = root.parent().unwrap().join("out");
    let (code, _, err) =
        lianpu(&["export", &root.display().to_string(), "--to", "textgrid,poses", "--out", &out.display().to_string()]);
    assert_eq!(code, 0, "{err}");
    assert!(err.contains("were found in its sound"), "{err}");
    assert!(!root.join("clips/hello/timing.TextGrid").exists());
    let timing = lianpu::timing::read(&out.join("hello.TextGrid")).unwrap();
    assert!(timing.tier("phones").is_some());
    let poses = std::fs::read_to_string(out.join("hello.poses.csv")).unwrap();
    let mut lines = poses.lines();
    assert!(lines.next().unwrap().starts_with("frame,time,shape,opening,width,neutral,happy"));
    assert_eq!(lines.clone().count(), 44);
    assert!(lines.all(|l| l.split(',').count() == 19));
}

/// A lesson of two clips of the sample's recording.
fn two_clips() -> (tempfile::TempDir, PathBuf) {
    let (folder, root) = lesson("您早。");
    let text = std::fs::read_to_string(root.join("lianpu.toml")).unwrap();
    let other = root.join("clips/other");
    std::fs::create_dir_all(&other).unwrap();
    std::fs::copy(recording(), other.join("speech.wav")).unwrap();
    std::fs::write(other.join("script.txt"), "您好").unwrap();
    std::fs::write(root.join("lianpu.toml"), text + "\n[[clip]]\nname = \"other\"\n").unwrap();
    (folder, root)
}

#[test]
fn a_clip_whose_script_changed_keeps_what_a_hand_set_whatever_else_is_saved() {
    let (_folder, root) = two_clips();
    let mut lesson = Lesson::open(&root).unwrap();
    let change = end_first_at(&lesson, 0.7);
    lesson.change(change).unwrap();
    lesson.save().unwrap();
    drop(lesson);
    std::fs::write(root.join("clips/hello/script.txt"), "您好。").unwrap();
    let path = root.display().to_string();
    assert_eq!(lianpu(&["align", &path, "--clip", "other"]).0, 0);
    assert_eq!(lianpu(&["check", &path]).0, 0);
    let lesson = Lesson::read(&root).unwrap();
    assert_eq!(lesson.clips[0].score.pins, [0]);
    assert!((times(&lesson)[0].1 - 0.7).abs() < 1e-6 && lesson.clips[0].wants_alignment());
}

#[test]
fn a_syllable_put_in_between_two_that_a_hand_set_finds_room_or_the_later_goes() {
    let (_folder, root) = lesson("您好。");
    let mut lesson = Lesson::open(&root).unwrap();
    let before = times(&lesson);
    let after = vec![(0.3, 0.76), (0.76, 1.28)];
    let pin = |index| Edit::Clip(0, ClipEdit::Pin { index, pinned: true });
    let edits = vec![Edit::Clip(0, ClipEdit::Times { first: 0, before, after }), pin(0), pin(1)];
    lesson.change(Change { label: "both".into(), edits }).unwrap();
    lesson.save().unwrap();
    drop(lesson);
    std::fs::write(root.join("clips/hello/script.txt"), "您老好。").unwrap();
    let mut lesson = Lesson::open(&root).unwrap();
    assert_eq!(lesson.clips[0].score.pins, [0]);
    assert!(times(&lesson).windows(2).all(|w| w[0].1 <= w[1].0 + 1e-9), "{:?}", times(&lesson));
    lesson.save().unwrap();
    drop(lesson);
    assert_eq!(Lesson::read(&root).unwrap().clips[0].score.pins, [0]);
}

#[test]
fn tiers_that_are_somebody_else_s_stay_through_an_alignment_and_its_undo() {
    let (_folder, root) = lesson("您好。");
    let grid = root.join("clips/hello/timing.TextGrid");
    let mut timing = lianpu::timing::read(&grid).unwrap();
    timing.set_tier(Tier { name: "notes".into(), intervals: vec![Interval::new(0.1, 0.5, "loud")] });
    std::fs::write(&grid, lianpu::timing::write(&timing, lianpu::timing::Format::TextGrid)).unwrap();
    std::fs::write(root.join("clips/hello/script.txt"), "您早。").unwrap();
    let mut lesson = Lesson::open(&root).unwrap();
    let notes = |lesson: &Lesson| lesson.clips[0].timing.tier("notes").map(|t| t.intervals.len());
    assert_eq!(notes(&lesson), Some(1));
    align(&mut lesson);
    assert_eq!(notes(&lesson), Some(1));
    lesson.undo().unwrap();
    assert_eq!(notes(&lesson), Some(1));
}

#[test]
fn an_alignment_that_was_saved_and_then_taken_back_is_gone_when_the_lesson_is_opened_again() {
    let (_folder, root) = lesson("您好。");
    forget_times(&root);
    let mut lesson = Lesson::open(&root).unwrap();
    align(&mut lesson);
    lesson.save().unwrap();
    lesson.undo().unwrap();
    lesson.save().unwrap();
    drop(lesson);
    let lesson = Lesson::read(&root).unwrap();
    assert!(lesson.clips[0].timing.guessed && lesson.clips[0].wants_alignment());
}

#[test]
fn what_is_found_in_a_clip_does_not_depend_on_which_others_are_asked_for() {
    let (_folder, root) = two_clips();
    let lesson = Lesson::open(&root).unwrap();
    let both = AlignJob::of(&lesson, &[0, 1]).unwrap().run();
    let one = AlignJob::of(&lesson, &[1]).unwrap().run();
    assert_eq!(both[1].1.as_ref().ok(), one[0].1.as_ref().ok());
}

#[test]
fn nothing_is_written_where_one_of_the_files_was_changed_by_something_else() {
    let (_folder, root) = lesson("您好。");
    let mut lesson = Lesson::open(&root).unwrap();
    let change = end_first_at(&lesson, 0.6);
    lesson.change(change).unwrap();
    let grid = root.join("clips/hello/timing.TextGrid");
    let score = root.join("clips/hello/score.toml");
    std::fs::write(&score, "seed = 9\n").unwrap();
    let before = std::fs::read(&grid).unwrap();
    assert!(lesson.save().is_err());
    assert_eq!(std::fs::read(&grid).unwrap(), before);
    assert!(lesson.is_unsaved());
}

#[test]
fn a_recording_alone_becomes_a_lesson_whose_words_are_typed_onto_what_is_heard() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().join("hello");
    let new = NewLesson { speech: Some(recording()), ..NewLesson::default() };
    create(&root, &new, &mut |_, _| true).unwrap();
    let mut lesson = Lesson::open(&root).unwrap();
    let sound = lesson.clips[0].sound.clone().unwrap();
    let places = lianpu::speech::nuclei(&sound).syllables;
    let change = lesson.lay_words(0, "您好", &places).unwrap();
    lesson.change(change).unwrap();
    lesson.save().unwrap();
    drop(lesson);
    let mut lesson = Lesson::open(&root).unwrap();
    assert!(close(&times(&lesson), &TRUTH, 0.08), "{:?}", times(&lesson));
    align(&mut lesson);
    assert!(close(&times(&lesson), &TRUTH, 0.05), "{:?}", times(&lesson));
}

#[test]
fn times_whose_script_is_gone_or_emptied_stay_and_that_is_told() {
    for emptied in [false, true] {
        let (_folder, root) = lesson("您好。");
        let script = root.join("clips/hello/script.txt");
        let mut opened = Lesson::open(&root).unwrap();
        let change = end_first_at(&opened, 0.7);
        opened.change(change).unwrap();
        opened.save().unwrap();
        let kept = times(&opened);
        drop(opened);
        if emptied {
            std::fs::write(&script, "\n").unwrap();
        } else {
            std::fs::remove_file(&script).unwrap();
        }
        let mut lesson = Lesson::open(&root).unwrap();
        assert!(!lesson.clips[0].wants_alignment());
        let told = |l: &Lesson| l.clips[0].warnings.iter().any(|w| w.to_string().contains("script.txt"));
        assert!(told(&lesson), "{:?}", lesson.clips[0].warnings);
        assert!(lesson.align(None, true).unwrap().aligned.is_empty());
        assert_eq!(times(&Lesson::read(&root).unwrap()), kept);
    }
}

#[test]
fn a_timing_file_is_no_script() {
    let folder = tempfile::tempdir().unwrap();
    let script = folder.path().join("said.txt");
    std::fs::write(&script, "1\n00:00:00,300 --> 00:00:00,660\n您\n\n2\n00:00:00,660 --> 00:00:01,080\n好\n").unwrap();
    let new = NewLesson { speech: Some(recording()), script: Some(script), ..NewLesson::default() };
    let fault = create(&folder.path().join("hello"), &new, &mut |_, _| true).unwrap_err();
    assert!(fault.what().contains("holds times in the format srt"), "{fault}");
}

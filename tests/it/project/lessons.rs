//! Lessons on disk: changes and their inverses, saving, the journal, the lock, and what a damaged file says.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use std::path::{Path, PathBuf};

use lianpu::disk::FileFault;
use lianpu::pose::{Emotion, MouthShape, Ratios};
use lianpu::project::{Change, ClipEdit, Edit, Finding, Lesson, ProjectFault, check};
use lianpu::timeline::{Key, KeyValue, Marker, Range};
use proptest::prelude::*;

/// A copy of the sample lesson to write to.
fn sample() -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().join("nihao");
    copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join("projects/nihao"), &root);
    (folder, root)
}

fn copy(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap().flatten() {
        let name = entry.file_name();
        if name == "export" || name == ".lianpu" {
            continue;
        }
        if entry.path().is_dir() {
            copy(&entry.path(), &to.join(name));
        } else {
            std::fs::copy(entry.path(), to.join(name)).unwrap();
        }
    }
}

fn times(lesson: &Lesson) -> Vec<(f64, f64)> {
    lesson.clips[0].intervals().iter().map(|i| (i.start, i.end)).collect()
}

fn move_start(lesson: &Lesson, to: f64) -> Change {
    let before = vec![times(lesson)[0]];
    let after = vec![(to, before[0].1)];
    Change::one("move a boundary", Edit::Clip(0, ClipEdit::Times { first: 0, before, after }))
}

/// Everything of a lesson that edits can change, as text.
fn state(lesson: &Lesson) -> String {
    let clip = &lesson.clips[0];
    format!("{:?}\n{:?}\n{:?}", clip.timing, clip.score, clip.syllables)
}

#[test]
fn a_change_is_made_saved_and_read_back() {
    let (_folder, root) = sample();
    let mut lesson = Lesson::open(&root).unwrap();
    assert!(!lesson.is_unsaved());
    let change = move_start(&lesson, 0.28);
    lesson.change(change).unwrap();
    let label = lesson.clips[0].intervals()[1].label.clone();
    lesson
        .change(Change::one(
            "reading",
            Edit::Clip(0, ClipEdit::Label { index: 1, before: label, after: "好{hao4}".into() }),
        ))
        .unwrap();
    assert!(lesson.is_unsaved());
    let written = lesson.save().unwrap();
    assert!(written.iter().any(|p| p.ends_with("timing.TextGrid")), "{written:?}");
    assert!(!lesson.is_unsaved());
    drop(lesson);
    let again = Lesson::read(&root).unwrap();
    assert_eq!(times(&again)[0].0, 0.28);
    assert_eq!(again.clips[0].syllables[1].pinyin, "hao4");
}

#[test]
fn a_save_leaves_files_of_which_nothing_changed_as_somebody_wrote_them() {
    let (_folder, root) = sample();
    let [score, times] = ["score.toml", "timing.TextGrid"].map(|name| root.join("clips/nihao").join(name));
    std::fs::write(&score, "# mine\n[[marker]]\ntime = 0.5\ntext = \"here\"\n").unwrap();
    let before = std::fs::read(&times).unwrap();
    let mut lesson = Lesson::open(&root).unwrap();
    let change = move_start(&lesson, 0.28);
    lesson.change(change).unwrap();
    lesson.save().unwrap();
    assert!(std::fs::read_to_string(&score).unwrap().starts_with("# mine"));
    assert_ne!(std::fs::read(&times).unwrap(), before);
    let key = ClipEdit::AddKey { key: Key::new(0.5, KeyValue::Blink(0.2)) };
    lesson.change(Change::one("key", Edit::Clip(0, key))).unwrap();
    lesson.save().unwrap();
    assert!(!std::fs::read_to_string(&score).unwrap().starts_with("# mine"));
}

#[test]
fn a_key_of_a_frame_is_the_same_key_after_it_was_saved_and_read() {
    let (_folder, root) = sample();
    let key = |frame: f64| Key::new(frame / 29.97, KeyValue::Blink(1.0 / 3.0));
    let mut lesson = Lesson::open(&root).unwrap();
    lesson.change(Change::one("key", Edit::Clip(0, ClipEdit::AddKey { key: key(11.0) }))).unwrap();
    lesson.save().unwrap();
    let edits = [ClipEdit::RemoveKey { key: key(11.0) }, ClipEdit::AddKey { key: key(12.0) }];
    let moved = Change { label: "move".into(), edits: edits.into_iter().map(|e| Edit::Clip(0, e)).collect() };
    drop(lesson);
    // By a reader of the file, and by a journal that is brought back to it.
    let mut lesson = Lesson::open(&root).unwrap();
    lesson.change(moved).unwrap();
    drop(lesson);
    let lesson = Lesson::open(&root).unwrap();
    assert_eq!((lesson.recovered, lesson.lost), (1, 0));
    assert_eq!(lesson.clips[0].score.keys.iter().filter(|k| k.is_same(&key(12.0))).count(), 1);
}

#[test]
fn a_file_that_was_changed_by_something_else_is_not_overwritten() {
    let (_folder, root) = sample();
    let mut lesson = Lesson::open(&root).unwrap();
    let change = move_start(&lesson, 0.28);
    lesson.change(change).unwrap();
    let path = root.join("clips/nihao/timing.TextGrid");
    let other = std::fs::read_to_string(&path).unwrap().replace("1.283764", "1.25");
    std::fs::write(&path, &other).unwrap();
    let fault = lesson.save().unwrap_err();
    assert!(fault.to_string().contains("changed by something else"), "{fault}");
    assert_eq!(std::fs::read_to_string(&path).unwrap(), other);
    assert!(lesson.is_unsaved());
    std::fs::remove_file(&path).unwrap();
    lesson.save().unwrap();
    assert_eq!(times(&Lesson::read(&root).unwrap())[0].0, 0.28);
}

#[test]
fn what_is_noted_after_a_recovery_is_recovered_too() {
    let (_folder, root) = sample();
    let key = |time| Change::one("key", Edit::Clip(0, ClipEdit::AddKey { key: Key::new(time, KeyValue::Blink(0.2)) }));
    let mut lesson = Lesson::open(&root).unwrap();
    lesson.change(key(0.5)).unwrap();
    drop(lesson);
    let journal = root.join(".lianpu/journal");
    let mut bytes = std::fs::read(&journal).unwrap();
    bytes.extend_from_slice(b"{\"label\":\"half");
    std::fs::write(&journal, bytes).unwrap();
    let mut lesson = Lesson::open(&root).unwrap();
    lesson.change(key(0.9)).unwrap();
    drop(lesson);
    let lesson = Lesson::open(&root).unwrap();
    assert_eq!(lesson.recovered, 2);
    // A save that was cut off before it emptied the journal: nothing is made twice.
    let bytes = std::fs::read(&journal).unwrap();
    let keys = lesson.clips[0].score.keys.len();
    let mut lesson = lesson;
    lesson.save().unwrap();
    drop(lesson);
    std::fs::write(&journal, bytes).unwrap();
    let lesson = Lesson::open(&root).unwrap();
    assert_eq!(lesson.clips[0].score.keys.len(), keys);
}

#[cfg(unix)]
#[test]
fn a_recording_that_is_a_link_out_of_the_lesson_is_refused() {
    let (folder, root) = sample();
    let speech = root.join("clips/nihao/speech.wav");
    std::fs::rename(&speech, folder.path().join("other.wav")).unwrap();
    std::os::unix::fs::symlink(folder.path().join("other.wav"), &speech).unwrap();
    assert!(Lesson::read(&root).unwrap_err().to_string().contains("leads out"));
}

#[test]
fn phrases_are_the_script_s_own_words_and_never_cut_a_number() {
    let (_folder, root) = sample();
    let clip = root.join("clips/nihao");
    std::fs::remove_file(clip.join("timing.TextGrid")).unwrap();
    std::fs::write(clip.join("script.txt"), "行{hang2}，我们一起说说说说说说说说说说说说说一百二十三。").unwrap();
    let lesson = Lesson::read(&root).unwrap();
    let phrases = lesson.clips[0].phrases();
    assert_eq!(phrases.intervals[0].label, "行，");
    std::fs::write(clip.join("script.txt"), "12345678901234567890123456789").unwrap();
    let lesson = Lesson::read(&root).unwrap();
    let labels: Vec<String> = lesson.clips[0].phrases().intervals.iter().map(|i| i.label.clone()).collect();
    assert_eq!(labels, ["12345678901234567890123456789"]);
}

#[test]
fn saving_twice_writes_nothing_the_second_time() {
    let (_folder, root) = sample();
    let mut lesson = Lesson::open(&root).unwrap();
    lesson.save().unwrap();
    assert!(lesson.save().unwrap().is_empty());
}

#[test]
fn what_was_not_saved_is_brought_back_from_the_journal() {
    let (_folder, root) = sample();
    let mut lesson = Lesson::open(&root).unwrap();
    let change = move_start(&lesson, 0.25);
    lesson.change(change).unwrap();
    let change = Change::one(
        "key",
        Edit::Clip(0, ClipEdit::AddKey { key: Key::new(0.5, KeyValue::Mouth(Some(MouthShape::A))) }),
    );
    lesson.change(change).unwrap();
    let before = state(&lesson);
    // The connection is lost: nothing is saved, and the last line is cut off in the middle.
    drop(lesson);
    let journal = root.join(".lianpu/journal");
    let mut bytes = std::fs::read(&journal).unwrap();
    bytes.extend_from_slice(b"{\"label\":\"half");
    std::fs::write(&journal, bytes).unwrap();
    let again = Lesson::open(&root).unwrap();
    assert_eq!(again.recovered, 2);
    assert!(again.is_unsaved());
    assert_eq!(state(&again), before);
}

#[test]
fn a_second_studio_opens_read_only_and_changes_nothing() {
    let (_folder, root) = sample();
    let _first = Lesson::open(&root).unwrap();
    let mut second = Lesson::open(&root).unwrap();
    assert!(second.read_only.as_deref().is_some_and(|why| why.contains("another window")));
    let change = move_start(&second, 0.2);
    assert!(second.change(change).is_err());
    assert!(second.save().is_err());
}

#[test]
fn times_cannot_be_set_over_a_neighbour_and_a_failed_change_leaves_nothing_behind() {
    let (_folder, root) = sample();
    let mut lesson = Lesson::open(&root).unwrap();
    let before = state(&lesson);
    let now = times(&lesson);
    let change = Change {
        label: "both".into(),
        edits: vec![
            Edit::Clip(0, ClipEdit::Pin { index: 0, pinned: true }),
            Edit::Clip(0, ClipEdit::Times { first: 0, before: vec![now[0]], after: vec![(now[0].0, now[1].0 + 0.1)] }),
        ],
    };
    assert!(lesson.change(change).unwrap_err().next_step().contains("there is room from"));
    assert_eq!(state(&lesson), before);
}

#[test]
fn a_tier_that_does_not_match_the_script_shows_where_they_part() {
    let (_folder, root) = sample();
    let path = root.join("clips/nihao/timing.TextGrid");
    let text = std::fs::read_to_string(&path).unwrap().replace("\"好\"", "\"坏\"");
    std::fs::write(&path, text).unwrap();
    let fault = Lesson::read(&root).unwrap_err();
    assert_eq!(fault.path(), Some(path.as_path()));
    assert!(fault.to_string().contains('好') && fault.to_string().contains('坏'), "{fault}");
}

#[test]
fn labels_may_be_any_romanisation_and_their_reading_wins() {
    let (_folder, root) = sample();
    let path = root.join("clips/nihao/timing.TextGrid");
    let text = std::fs::read_to_string(&path).unwrap();
    for (label, pinyin) in [("hao4", "hao4"), ("ㄏㄠˋ", "hao4"), ("hào", "hao4"), ("hao", "hao3"), ("好{hao4}", "hao4")]
    {
        std::fs::write(&path, text.replace("\"好\"", &format!("\"{label}\""))).unwrap();
        let lesson = Lesson::read(&root).unwrap_or_else(|f| panic!("{label}: {f}"));
        assert_eq!(lesson.clips[0].syllables[1].pinyin, pinyin, "{label}");
    }
}

#[test]
fn every_damaged_file_of_a_lesson_is_named_with_its_line() {
    let damages: [(&str, &str, &str); 5] = [
        ("lianpu.toml", "fps = 25", "fps = -1"),
        ("clips/nihao/score.toml", "track = \"emotion\"", "track = \"emotoin\""),
        ("clips/nihao/score.toml", "surprised = 0.35", "surprise = 0.35"),
        ("clips/nihao/score.toml", "time = 0.6", "time = nan"),
        ("clips/nihao/timing.TextGrid", "xmin = 0.300000", "xmin = 9.3"),
    ];
    for (file, from, to) in damages {
        let (_folder, root) = sample();
        let path = root.join(file);
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(text.contains(from), "{file} has no `{from}`");
        std::fs::write(&path, text.replacen(from, to, 1)).unwrap();
        let wrong: Vec<_> = check(&root).into_iter().filter(|f| matches!(f, Finding::Wrong(_))).collect();
        let [Finding::Wrong(fault)] = wrong.as_slice() else { panic!("{file} {to}: {wrong:?}") };
        assert!(fault.path().is_some_and(|p| p.ends_with(file)), "{fault}");
        assert!(fault.line_number().is_some(), "{fault}");
        assert!(!fault.next_step().is_empty(), "{fault}");
    }
}

#[cfg(unix)]
#[test]
fn a_manifest_cannot_reach_out_of_its_folder() {
    let (folder, root) = sample();
    std::fs::write(folder.path().join("secret.toml"), "x").unwrap();
    let manifest = root.join("lianpu.toml");
    let text = std::fs::read_to_string(&manifest).unwrap();
    for figure in ["figures/../../secret.toml", "figures/link.toml"] {
        std::fs::create_dir_all(root.join("figures")).unwrap();
        let _ = std::os::unix::fs::symlink(folder.path().join("secret.toml"), root.join("figures/link.toml"));
        std::fs::write(&manifest, text.replace("figure = \"cartoon\"", &format!("figure = \"{figure}\""))).unwrap();
        let lesson = Lesson::read(&root).unwrap();
        let fault = lesson.figure_of(&lesson.manifest.clips[0]).unwrap_err();
        assert!(fault.to_string().contains("out of the project"), "{fault}");
    }
}

fn any_edit() -> impl Strategy<Value = u32> {
    0u32..8
}

/// An edit of a kind that fits the lesson as it is.
fn edit_of(lesson: &Lesson, kind: u32, number: f64) -> Vec<Edit> {
    let clip = &lesson.clips[0];
    let score = &clip.score;
    match kind {
        0 => {
            let before = times(lesson);
            let end = before[0].1;
            let after = vec![(number * end * 0.9, end), before[1]];
            vec![Edit::Clip(0, ClipEdit::Times { first: 0, before, after })]
        }
        1 => vec![Edit::Clip(
            0,
            ClipEdit::AddKey { key: Key::new(number, KeyValue::Emotion(Ratios::some(Emotion::Fear, number))) },
        )],
        2 => score.keys.first().map(|key| Edit::Clip(0, ClipEdit::RemoveKey { key: *key })).into_iter().collect(),
        3 => vec![Edit::Clip(
            0,
            ClipEdit::AddRange { at: score.ranges.len() / 2, range: Range::new(number, number + 1.0) },
        )],
        4 => {
            let last = score.ranges.len().checked_sub(1);
            last.map(|at| Edit::Clip(0, ClipEdit::RemoveRange { at, range: score.ranges[at] })).into_iter().collect()
        }
        5 => vec![Edit::Clip(0, ClipEdit::AddMarker { marker: Marker { time: number, text: format!("m{number}") } })],
        6 => vec![Edit::Clip(0, ClipEdit::Pin { index: 1, pinned: !score.pins.contains(&1) })],
        _ => {
            let before = clip.intervals()[0].label.clone();
            let after = if before == "您" { "您{nin1}" } else { "您" };
            vec![Edit::Clip(0, ClipEdit::Label { index: 0, before, after: after.into() })]
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn undoing_everything_gives_the_lesson_back_and_redoing_gives_the_changes_back(
        steps in prop::collection::vec((any_edit(), 0.0..1.0f64), 1..12),
    ) {
        let (_folder, root) = sample();
        let mut lesson = Lesson::open(&root).unwrap();
        let start = keys_sorted(&lesson);
        let mut made = 0;
        for (kind, number) in steps {
            let edits = edit_of(&lesson, kind, number);
            if !edits.is_empty() {
                lesson.change(Change { label: "step".into(), edits }).unwrap();
                made += 1;
            }
        }
        let end = keys_sorted(&lesson);
        for _ in 0..made {
            prop_assert!(lesson.undo().unwrap().is_some());
        }
        prop_assert!(lesson.undo().unwrap().is_none());
        prop_assert!(!lesson.is_unsaved());
        prop_assert_eq!(keys_sorted(&lesson), start);
        while lesson.redo().unwrap().is_some() {}
        prop_assert_eq!(keys_sorted(&lesson), end);
    }
}

/// The state with keys in order of time: where in its list a key stands means nothing.
fn keys_sorted(lesson: &Lesson) -> String {
    let clip = &lesson.clips[0];
    let mut score = clip.score.clone();
    score.keys.sort_by(|a, b| a.time.total_cmp(&b.time).then(format!("{a:?}").cmp(&format!("{b:?}"))));
    format!("{:?}\n{score:?}\n{:?}", clip.timing, clip.syllables)
}

#[test]
fn faults_of_a_lesson_are_told_apart_by_their_kind_and_not_by_their_words() {
    let (_folder, root) = sample();
    let lesson = Lesson::read(&root).unwrap();
    let kind = lesson.clip_named(Some("other")).unwrap_err().kind::<ProjectFault>().copied();
    assert_eq!(kind, Some(ProjectFault::NoSuchClip));
    let of_file = |name: &str, text: Option<&[u8]>| {
        let path = root.join(name);
        let before = std::fs::read(&path).unwrap();
        match text {
            Some(text) => std::fs::write(&path, text).unwrap(),
            None => std::fs::remove_file(&path).unwrap(),
        }
        let fault = Lesson::read(&root).unwrap_err();
        std::fs::write(&path, before).unwrap();
        assert!(fault.path().is_some_and(|p| p.ends_with(name)), "{fault}");
        (fault.kind::<FileFault>().copied(), fault.kind::<ProjectFault>().copied())
    };
    let file = |kind| (Some(kind), None);
    assert_eq!(of_file("lianpu.toml", None), (None, Some(ProjectFault::NoProject)));
    assert_eq!(of_file("lianpu.toml", Some(b"format = 7\ntitle = \"x\"\n")), file(FileFault::Version));
    assert_eq!(of_file("lianpu.toml", Some(b"format =\n")), file(FileFault::Malformed));
    assert_eq!(of_file("clips/nihao/script.txt", Some(b"\xB1\x7A")), file(FileFault::Encoding));
    let cut = b"File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\n0\n1.6\n<exists>\n1\n\"Int";
    assert_eq!(of_file("clips/nihao/timing.TextGrid", Some(cut)), file(FileFault::CutOff));
}

//! A save of several files is one commit: whatever call of it fails, and wherever the process dies, a project is as it was
//! or as it was to be.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use lianpu::calibration::Kept;
use lianpu::disk::Lock;
use lianpu::face::Face;
use lianpu::project::{Change, ClipEdit, Edit, FaceEdit, Finding, Footage, Lesson, check};
use lianpu::ratios::Record;
use lianpu::timeline::{Key, KeyValue};

use crate::support::faulty_disk::{Disk, How, files};

const EIO: i32 = 5;
const ENOSPC: i32 = 28;

/// The kinds of files that a session may change.
const KINDS: [&str; 5] = ["script", "times", "score", "face", "ratios"];

fn source() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_owned()
}

/// A lesson of one clip that says 您, with ratios and a face.
fn lesson() -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().join("l");
    copy(&source().join("tests/torn_save"), &root);
    fs::write(root.join("clips/l/script.txt"), "您\n").unwrap();
    fs::write(root.join("clips/l/ratios.csv"), ratios(0.5)).unwrap();
    fs::create_dir_all(root.join("faces/teacher")).unwrap();
    fs::copy(source().join("projects/nihao/faces/teacher/face.toml"), root.join("faces/teacher/face.toml")).unwrap();
    (folder, root)
}

fn ratios(happy: f64) -> String {
    let mut text = String::from("frame,time,neutral,happy,anger,disgust,sadness,fear,surprised,confidence\n");
    for frame in 0..43 {
        text.push_str(&format!("{frame},{},{},{happy},0,0,0,0,0,1\n", f64::from(frame) * 0.04, 1.0 - happy));
    }
    Record::parse(&text).unwrap().to_csv()
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap().flatten() {
        let path = to.join(entry.file_name());
        if entry.path().is_dir() {
            copy(&entry.path(), &path);
        } else {
            fs::copy(entry.path(), path).unwrap();
        }
    }
}

/// A change of a kind.
fn change(lesson: &Lesson, kind: &str) -> Change {
    let edit = match kind {
        "script" => return lesson.lay_words(0, "好", &[(0.8, 1.29)]).unwrap(),
        "times" => {
            let first = &lesson.clips[0].intervals()[0];
            let before = vec![(first.start, first.end)];
            Edit::Clip(0, ClipEdit::Times { first: 0, before, after: vec![(0.3, 0.7)] })
        }
        "score" => Edit::Clip(0, ClipEdit::AddKey { key: Key::new(0.5, KeyValue::Blink(0.2)) }),
        "face" => {
            let before = lesson.faces[0].face.as_ref().map(Face::to_toml);
            Edit::Face(0, FaceEdit::Face { before, after: None })
        }
        _ => {
            let before = Footage { ratios: Some(ratios(0.5)), ..Footage::default() };
            let after = Footage { ratios: Some(ratios(0.25)), ..Footage::default() };
            Edit::Clip(0, ClipEdit::Tracked { before: Box::new(before), after: Box::new(after) })
        }
    };
    Change::one(kind, edit)
}

/// A lesson with unsaved changes of these kinds in its journal; its files now, and as a save makes them.
struct Case {
    _folder: tempfile::TempDir,
    root: PathBuf,
    count: usize,
    old: BTreeMap<PathBuf, Vec<u8>>,
    new: BTreeMap<PathBuf, Vec<u8>>,
}

impl Case {
    fn new(kinds: &[&str]) -> Self {
        let (folder, root) = lesson();
        let mut open = Lesson::open_by(&root, &mut Disk::sound()).unwrap();
        for kind in kinds {
            let change = change(&open, kind);
            open.change(change).unwrap();
        }
        drop(open);
        let old = files(&root);
        let saved = folder.path().join("saved");
        copy(&root, &saved);
        Lesson::open_by(&saved, &mut Disk::sound()).unwrap().save_by(&mut Disk::sound()).unwrap();
        let new = files(&saved);
        assert_ne!(old, new, "{kinds:?}");
        Self { _folder: folder, root, count: kinds.len(), old, new }
    }

    /// A copy of it to spoil.
    fn copied(&self) -> (tempfile::TempDir, PathBuf) {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path().join("l");
        copy(&self.root, &root);
        (folder, root)
    }

    /// Opens a lesson whose save was cut off: every file is old and the journal has the changes, or every file is new and
    /// the journal has none; nothing is left over. `more` changes were made after the save. Returns whether it is new.
    fn judge(&self, root: &Path, more: usize, what: &dyn std::fmt::Debug) -> bool {
        let open = Lesson::open_by(root, &mut Disk::sound()).unwrap_or_else(|f| panic!("{what:?}: {f}"));
        let now = files(root);
        let is_new = now == self.new;
        if !is_new {
            let differ: Vec<_> = self.old.iter().filter(|(path, bytes)| now.get(*path) != Some(bytes)).collect();
            let names: Vec<_> = differ.iter().map(|(path, _)| path).collect();
            assert_eq!(now.len(), self.old.len(), "{what:?}: {:?}", now.keys());
            assert!(names.is_empty(), "{what:?}: mixed, {names:?} are not as they were");
        }
        let unsaved = if is_new { more } else { self.count + more };
        assert_eq!((open.recovered, open.lost), (unsaved, 0), "{what:?}: new {is_new}");
        let own: Vec<_> = fs::read_dir(root.join(".lianpu")).unwrap().flatten().map(|e| e.file_name()).collect();
        assert!(own.iter().all(|n| ["lock", "journal", "commit"].iter().any(|k| n == k)), "{what:?}: {own:?}");
        is_new
    }
}

/// All sets of kinds but the empty one.
fn subsets() -> impl Iterator<Item = Vec<&'static str>> {
    (1..1 << KINDS.len())
        .map(|bits| KINDS.into_iter().enumerate().filter(|(n, _)| bits >> n & 1 == 1).map(|k| k.1).collect())
}

/// Saves with something going wrong at every call in turn, until a save is over before it does.
fn at_every_call(case: &Case, how: How, mut then: impl FnMut(&Path, Lesson, bool, usize)) -> usize {
    for at in 1.. {
        let (_folder, root) = case.copied();
        let mut open = Lesson::open_by(&root, &mut Disk::sound()).unwrap();
        assert_eq!(open.recovered, case.count);
        let mut disk = Disk::new(at, how);
        let is_saved = open.save_by(&mut disk).is_ok();
        let is_over = disk.calls < at;
        then(&root, open, is_saved, at);
        if is_over {
            return at - 1;
        }
    }
    0
}

#[test]
fn a_process_that_dies_in_any_call_leaves_the_old_lesson_or_the_new_one() {
    let (mut cases, mut new) = (0, 0);
    for kinds in subsets() {
        let case = Case::new(&kinds);
        at_every_call(&case, How::Dies, |root, open, is_saved, at| {
            drop(open);
            let is_new = case.judge(root, 0, &(&kinds, at));
            assert!(is_new || !is_saved, "{kinds:?} {at}: what was saved is there");
            (cases, new) = (cases + 1, new + usize::from(is_new));
        });
    }
    println!("{cases} deaths: {new} new, {} old, 0 mixed", cases - new);
    assert!(new > 100 && cases - new > 100);
}

#[test]
fn a_power_cut_in_any_call_leaves_the_old_lesson_or_the_new_one() {
    let (mut cases, mut new) = (0, 0);
    let all = Case::new(&KINDS);
    let two = Case::new(&["times", "face"]);
    for case in [&all, &two] {
        // Nothing that was not flushed is lost, everything is, and some of it.
        for bits in
            [0, u64::MAX, 0xAAAA_AAAA_AAAA_AAAA, 0x5555_5555_5555_5555, 0x9249_2492_4924_9249, 0xF0F0_CCCC_0FF0_3C3C]
        {
            at_every_call(case, How::LosesPower(bits), |root, open, is_saved, at| {
                drop(open);
                let is_new = case.judge(root, 0, &(bits, at));
                assert!(is_new || !is_saved, "{bits:x} {at}: what was saved is there");
                (cases, new) = (cases + 1, new + usize::from(is_new));
            });
        }
    }
    println!("{cases} power cuts: {new} new, {} old, 0 mixed", cases - new);
}

#[test]
fn a_recovery_that_dies_in_any_call_is_finished_by_the_next() {
    let case = Case::new(&KINDS);
    let mut cases = 0;
    for how in [How::Dies, How::LosesPower(u64::MAX), How::LosesPower(0xAAAA_AAAA_AAAA_AAAA)] {
        at_every_call(&case, How::Dies, |root, open, _, at| {
            drop(open);
            for second in 1.. {
                let folder = tempfile::tempdir().unwrap();
                let again = folder.path().join("l");
                copy(root, &again);
                let mut disk = Disk::new(second, how);
                drop(Lesson::open_by(&again, &mut disk));
                case.judge(&again, 0, &(how, at, second));
                cases += 1;
                if disk.calls < second {
                    break;
                }
            }
        });
    }
    println!("{cases} second deaths, 0 mixed");
}

#[test]
fn after_a_failure_the_session_saves_again_and_refuses_none_of_its_own_files() {
    for kinds in [&KINDS[..], &["times"], &["score", "face"]] {
        let case = Case::new(kinds);
        for how in [How::FailsOnce(EIO), How::FailsOnce(ENOSPC), How::Fails(EIO), How::Fails(ENOSPC)] {
            at_every_call(&case, how, |root, mut open, _, at| {
                open.save_by(&mut Disk::sound()).unwrap_or_else(|f| panic!("{kinds:?} {how:?} {at}: {f}"));
                assert!(!open.is_unsaved());
                drop(open);
                assert!(case.judge(root, 0, &(kinds, how, at)));
            });
        }
    }
}

#[test]
fn after_a_failure_a_session_that_dies_leaves_one_state_and_every_later_change() {
    let case = Case::new(&KINDS);
    for how in [How::FailsOnce(EIO), How::Fails(ENOSPC)] {
        at_every_call(&case, how, |root, mut open, _, at| {
            let later = Key::new(0.9, KeyValue::Blink(0.2));
            open.change(Change::one("later", Edit::Clip(0, ClipEdit::AddKey { key: later }))).unwrap();
            drop(open);
            case.judge(root, 1, &(how, at));
        });
    }
}

#[test]
fn a_calibration_and_the_changes_saved_with_it_are_one_commit() {
    let (_folder, root) = lesson();
    let photos = source().join("projects/xiyang/faces/teacher");
    let kept = Kept::make(&photos).unwrap();
    let mut open = Lesson::open(&root).unwrap();
    let change = change(&open, "score");
    open.change(change).unwrap();
    drop(open);
    let old = files(&root);
    let mut states = [0, 0];
    for at in 1.. {
        let folder = tempfile::tempdir().unwrap();
        let again = folder.path().join("l");
        copy(&root, &again);
        let mut open = Lesson::open_by(&again, &mut Disk::sound()).unwrap();
        let mut disk = Disk::new(at, How::Dies);
        let is_kept = open.keep_calibration_by(0, &kept, &mut disk).is_ok();
        drop(open);
        let open = Lesson::open_by(&again, &mut Disk::sound()).unwrap();
        let now = files(&again);
        let is_new = now != old;
        assert_eq!(is_new, Kept::read(&again.join("faces/teacher")).unwrap().is_some());
        assert_eq!(open.recovered, usize::from(!is_new), "{at}");
        assert!(is_new || !is_kept);
        states[usize::from(is_new)] += 1;
        if disk.calls < at {
            break;
        }
    }
    assert!(states[0] > 5 && states[1] > 5, "{states:?}");
}

/// A lesson whose save died after its first file was put in place.
fn cut_off(case: &Case) -> (tempfile::TempDir, PathBuf) {
    let mut found = None;
    at_every_call(case, How::Dies, |root, open, _, _| {
        drop(open);
        let now = files(root);
        let moved = case.old.iter().filter(|(path, bytes)| now.get(*path) != Some(bytes)).count();
        if moved == 1 && found.is_none() {
            let folder = tempfile::tempdir().unwrap();
            copy(root, &folder.path().join("l"));
            found = Some(folder);
        }
    });
    let folder = found.unwrap();
    let root = folder.path().join("l");
    (folder, root)
}

#[test]
fn a_reader_finishes_a_save_that_was_cut_off_and_says_so() {
    let case = Case::new(&["script", "score"]);
    let (_folder, root) = cut_off(&case);
    let open = Lesson::read(&root).unwrap();
    assert_eq!(open.clips[0].syllables.len(), 2);
    assert!(open.notes.iter().any(|n| n.to_string().contains("has been finished")), "{:?}", open.notes);
    assert_eq!(files(&root), case.new);
}

#[test]
fn a_reader_that_may_not_finish_a_save_sees_the_new_lesson() {
    let case = Case::new(&["script", "score"]);
    let (_folder, root) = cut_off(&case);
    let before = files(&root);
    let _held = Lock::take(&root.join(".lianpu/lock")).unwrap().unwrap();
    let open = Lesson::read(&root).unwrap();
    assert_eq!(open.clips[0].syllables.len(), 2);
    assert_eq!(open.clips[0].score.keys.len(), 1);
    assert_eq!(files(&root), before, "nothing on the disk has changed");
    assert!(!check(&root).iter().any(|f| matches!(f, Finding::Wrong(_))));
}

#[test]
fn a_file_that_was_changed_after_a_save_was_cut_off_is_left_as_it_is() {
    let case = Case::new(&["times", "score", "face"]);
    let (_folder, root) = cut_off(&case);
    let score = root.join("clips/l/score.toml");
    let theirs = b"seed = 7\n";
    let was_new = files(&root).get(Path::new("clips/l/score.toml")) == case.new.get(Path::new("clips/l/score.toml"));
    assert!(!was_new, "the times are put in place first");
    fs::write(&score, theirs).unwrap();
    let open = Lesson::open(&root).unwrap();
    assert_eq!(fs::read(&score).unwrap(), theirs);
    assert!(open.notes.iter().any(|n| n.to_string().contains("clips/l/score.toml")), "{:?}", open.notes);
    let aside = root.join(".lianpu/unsaved-clips-l-score.toml");
    assert_eq!(fs::read(aside).unwrap(), case.new[Path::new("clips/l/score.toml")]);
}

#[test]
fn unsaved_changes_of_an_earlier_session_are_mentioned_by_check() {
    let case = Case::new(&["times", "score"]);
    let mentioned = || {
        check(&case.root).iter().any(
            |f| matches!(f, Finding::Odd(text) if text.to_string().contains("2 unsaved changes of an earlier session")),
        )
    };
    assert!(mentioned());
    assert_eq!(Lesson::read(&case.root).unwrap().unsaved.changes, 2);
    let mut open = Lesson::open(&case.root).unwrap();
    assert!(!mentioned(), "they are those of this session");
    open.discard().unwrap();
    assert!(!mentioned());
}

/// Lessons of an earlier version, whose save was cut off between two files.
#[test]
fn a_lesson_torn_by_an_earlier_version_opens_with_the_change_of_its_journal() {
    let torn: [(&[&str], &[&str]); 4] = [
        (&["script"], &["clips/l/script.txt"]),
        (&["script", "score"], &["clips/l/script.txt"]),
        (&["script", "score"], &["clips/l/script.txt", "clips/l/timing.TextGrid"]),
        (&["times", "score"], &["clips/l/timing.TextGrid"]),
    ];
    for (kinds, new) in torn {
        let case = Case::new(kinds);
        let (_folder, root) = case.copied();
        for path in new.iter().map(Path::new) {
            fs::write(root.join(path), &case.new[path]).unwrap();
        }
        let mut open = Lesson::open(&root).unwrap_or_else(|f| panic!("{new:?}: {f}"));
        assert_eq!(open.lost, 0, "{new:?}");
        open.save().unwrap();
        drop(open);
        assert_eq!(files(&root), case.new, "{new:?}");
    }
    // Without its journal nobody knows, and the message says what can be done.
    let folder = tempfile::tempdir().unwrap();
    copy(&source().join("tests/torn_save"), folder.path());
    let fault = Lesson::open(folder.path()).unwrap_err();
    assert!(fault.next_step().contains("timing.TextGrid"), "{fault}");
}

#[cfg(unix)]
#[test]
fn a_save_keeps_the_rights_of_its_files() {
    use std::os::unix::fs::{MetadataExt, PermissionsExt};
    let (_folder, root) = lesson();
    let mode = |path: &str| fs::metadata(root.join(path)).unwrap().mode() & 0o777;
    let set = |path: &str, mode| fs::set_permissions(root.join(path), fs::Permissions::from_mode(mode)).unwrap();
    set("lianpu.toml", 0o640);
    set("clips/l/timing.TextGrid", 0o660);
    let mut open = Lesson::open(&root).unwrap();
    for kind in ["times", "score"] {
        let change = change(&open, kind);
        open.change(change).unwrap();
    }
    assert_eq!(mode(".lianpu/journal"), 0o640);
    open.save().unwrap();
    assert_eq!(mode(".lianpu/journal"), 0o640);
    assert_eq!(mode("clips/l/timing.TextGrid"), 0o660);
    assert_eq!(mode("clips/l/score.toml"), 0o640, "a new file is as private as the project");
}

#[test]
fn a_lesson_that_was_moved_while_open_is_not_saved_at_its_old_place() {
    let (folder, root) = lesson();
    let mut open = Lesson::open(&root).unwrap();
    let one = change(&open, "times");
    open.change(one).unwrap();
    let moved = folder.path().join("moved");
    fs::rename(&root, &moved).unwrap();
    let fault = open.save().unwrap_err();
    assert!(fault.to_string().contains("moved") && !root.exists(), "{fault}");
    // Another lesson in its place is not written to either.
    copy(&moved, &root);
    let before = files(&root);
    assert!(open.save().is_err());
    assert_eq!(files(&root), before);
    drop(open);
    assert_eq!(Lesson::open(&moved).unwrap().recovered, 1);
}

#[test]
fn a_lesson_whose_own_folder_was_removed_while_open_is_saved() {
    let (_folder, root) = lesson();
    let mut open = Lesson::open(&root).unwrap();
    let one = change(&open, "times");
    open.change(one).unwrap();
    fs::remove_dir_all(root.join(".lianpu")).unwrap();
    assert!(!open.save().unwrap().is_empty());
    assert!(Lock::is_held(&root.join(".lianpu/lock")));
}

#[test]
fn a_lesson_that_is_open_elsewhere_says_where() {
    let (_folder, root) = lesson();
    let first = Lesson::open(&root).unwrap();
    let mut second = Lesson::open(&root).unwrap();
    let why = second.read_only.clone().unwrap();
    assert!(why.contains("another window") && why.contains(&format!("process {}", std::process::id())), "{why}");
    assert!(second.save().unwrap_err().next_step().contains("close it there"));
    drop(first);
    assert!(Lesson::open(&root).unwrap().read_only.is_none());
}

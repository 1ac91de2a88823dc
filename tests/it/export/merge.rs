//! The parts of an export joined: complete, damaged, missing, mixed.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use lianpu::disk::Fault;
use lianpu::export::{Asked, Entry, Manifest, Shard, divide, merge};

const COUNTS: [u32; 3] = [7, 4, 10];

fn asked(fps: &str) -> Vec<Asked> {
    let clip = |(i, count): (usize, &u32)| Asked {
        project: format!("lesson-{i}"),
        clip: "one".into(),
        settings: BTreeMap::from([("fps".into(), fps.into()), ("size".into(), "8x8".into())]),
        folder: format!("lesson-{i}/one"),
        frame_forms: vec!["png".into()],
        frames: Asked::runs(&(0..*count).collect::<Vec<_>>()),
        whole: vec![format!("lesson-{i}/one.srt")],
    };
    COUNTS.iter().enumerate().map(clip).collect()
}

/// Does one part as an export would.
fn export(folder: &Path, shard: Shard, fps: &str) -> Manifest {
    let mut files = Vec::new();
    let mut put = |path: String, content: String| {
        fs::create_dir_all(folder.join(&path).parent().unwrap()).unwrap();
        fs::write(folder.join(&path), &content).unwrap();
        files.push(Entry::of(path, content.as_bytes()));
    };
    for (i, share) in divide(&COUNTS, shard).into_iter().enumerate() {
        for frame in share.frames {
            put(format!("lesson-{i}/one/{frame:06}.png"), format!("{i} {frame}"));
        }
        if share.whole_files {
            put(format!("lesson-{i}/one.srt"), format!("subtitles of {i}"));
        }
    }
    let manifest = Manifest::new(shard, asked(fps), files);
    manifest.write(folder).unwrap();
    manifest
}

fn shard(index: u32, count: u32) -> Shard {
    Shard::new(index, count).unwrap()
}

fn all_parts(folder: &Path, count: u32) {
    (1..=count).for_each(|i| drop(export(folder, shard(i, count), "25")));
}

fn refused(folder: &Path, what: &[&str]) -> Fault {
    let fault = merge(folder).unwrap_err();
    let text = fault.to_string();
    println!("{text}");
    assert!(what.iter().all(|w| text.contains(w)), "{what:?} is not in\n{text}");
    fault
}

#[test]
fn parts_joined_are_what_one_export_writes_and_joining_again_changes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let alone = tempfile::tempdir().unwrap();
    export(alone.path(), Shard::WHOLE, "25");
    for count in [2, 3, 30] {
        let folder = folder.path().join(count.to_string());
        all_parts(&folder, count);
        let merged = merge(&folder).unwrap();
        assert_eq!((merged.parts, merged.files), (count, 24));
        let text = fs::read(&merged.path).unwrap();
        assert_eq!(text, fs::read(alone.path().join("manifest.json")).unwrap());
        assert_eq!(merge(&folder).unwrap(), merged);
        assert_eq!(fs::read(&merged.path).unwrap(), text);
    }
    // An export that was never divided is checked.
    assert_eq!(merge(alone.path()).unwrap().parts, 1);
    fs::write(alone.path().join("lesson-1/one.srt"), "no").unwrap();
    refused(alone.path(), &["it is not as it was written", "run the export again"]);
}

#[test]
fn a_part_that_is_missing_is_named() {
    let folder = tempfile::tempdir().unwrap();
    all_parts(folder.path(), 12);
    let name = Manifest::name(shard(3, 12));
    assert_eq!(name, "manifest-03-of-12.json");
    fs::remove_file(folder.path().join(name)).unwrap();
    fs::remove_file(folder.path().join("manifest-11-of-12.json")).unwrap();
    refused(folder.path(), &["parts 3/12, 11/12 of the export are missing", "with part 3/12"]);
    assert!(!folder.path().join("manifest.json").exists());
    export(folder.path(), shard(3, 12), "25");
    refused(folder.path(), &["part 11/12 of the export is missing"]);
    export(folder.path(), shard(11, 12), "25");
    merge(folder.path()).unwrap();
}

#[test]
fn a_file_that_is_missing_or_damaged_is_named_with_its_part() {
    let folder = tempfile::tempdir().unwrap();
    all_parts(folder.path(), 3);
    let frame = folder.path().join("lesson-2/one/000003.png");
    fs::write(&frame, "2 4").unwrap();
    refused(folder.path(), &["it is not as it was written", "000003.png", "with part 3/3"]);
    fs::remove_file(&frame).unwrap();
    refused(folder.path(), &["it was written, but is missing", "000003.png", "with part 3/3"]);
    export(folder.path(), shard(3, 3), "25");
    merge(folder.path()).unwrap();
}

#[test]
fn a_frame_that_no_part_wrote_is_a_gap() {
    let folder = tempfile::tempdir().unwrap();
    all_parts(folder.path(), 3);
    let mut part = export(folder.path(), shard(2, 3), "25");
    let at = part.files.iter().position(|f| f.path.ends_with("lesson-1/one/000002.png")).unwrap();
    part.files.remove(at);
    part.write(folder.path()).unwrap();
    refused(folder.path(), &["no part wrote it", "lesson-1/one/000002.png", "with part 2/3"]);
}

#[test]
fn two_parts_may_have_the_same_file_but_not_two_of_one_name() {
    let folder = tempfile::tempdir().unwrap();
    all_parts(folder.path(), 3);
    let first = export(folder.path(), shard(1, 3), "25");
    let third = export(folder.path(), shard(3, 3), "25");
    let with = |entry: Entry| {
        let files = third.files.iter().cloned().chain([entry]).collect();
        Manifest::new(shard(3, 3), asked("25"), files).write(folder.path()).unwrap();
    };
    with(first.files[2].clone());
    merge(folder.path()).unwrap();
    with(Entry::of(first.files[2].path.clone(), b"other"));
    refused(folder.path(), &["parts 1/3 and 3/3 wrote it, each in another way"]);
}

#[test]
fn parts_of_two_exports_are_not_joined() {
    let folder = tempfile::tempdir().unwrap();
    all_parts(folder.path(), 3);
    export(folder.path(), shard(2, 3), "24");
    refused(folder.path(), &["part 2/3 is of another export", "fps 25 and 24"]);
    export(folder.path(), shard(2, 3), "25");
    export(folder.path(), shard(2, 4), "25");
    refused(folder.path(), &["parts of two exports are mixed"]);
}

#[test]
fn a_manifest_that_is_damaged_or_leads_out_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    refused(folder.path(), &["no manifest of an export here"]);
    assert!(merge(&folder.path().join("none")).is_err());
    let path = folder.path().join("manifest-1-of-2.json");
    let good = export(folder.path(), shard(1, 2), "25");
    let text = fs::read_to_string(&path).unwrap();
    for (from, to, what) in [
        ("lesson-0/one/000001.png", "../outside.png", "leads out"),
        ("lesson-0/one/000001.png", "/etc/passwd", "leads out"),
        ("\"format\": 1", "\"format\": 2", "has form 2"),
        ("1/2", "3/2", "is no shard"),
        ("1/2", "2/2", "its name does not"),
        ("\"sha256\"", "\"sha255\"", "no manifest of an export"),
    ] {
        assert!(text.contains(from));
        fs::write(&path, text.replacen(from, to, 1)).unwrap();
        refused(folder.path(), &[what, "manifest-1-of-2.json"]);
    }
    for cut in (0..text.len()).step_by(97) {
        fs::write(&path, &text[..cut]).unwrap();
        assert!(Manifest::read(&path).is_err(), "cut at {cut}");
    }
    fs::write(&path, &text).unwrap();
    assert_eq!(Manifest::read(&path).unwrap(), good);
}

#[test]
fn an_export_beside_an_earlier_one_keeps_what_that_wrote() {
    let folder = tempfile::tempdir().unwrap();
    let first = export(folder.path(), Shard::WHOLE, "25");
    let mut clips = asked("25");
    for clip in &mut clips {
        (clip.frame_forms, clip.whole) = (vec![], vec![format!("{}/one.vtt", clip.project)]);
        fs::write(folder.path().join(&clip.whole[0]), "WEBVTT").unwrap();
    }
    let files = clips.iter().map(|c| Entry::of(c.whole[0].clone(), b"WEBVTT").made_from("k")).collect();
    fs::remove_file(folder.path().join("lesson-0/one.srt")).unwrap();
    let both = Manifest::new(Shard::WHOLE, clips, files).beside(first, folder.path());
    assert_eq!(both.files.len(), 24 - 1 + 3);
    assert_eq!(both.clips[0].whole, ["lesson-0/one.vtt"]);
    // A row of its own for what was asked before and is still there; of the first lesson the frames alone.
    let rows: Vec<_> = both.clips[3..].iter().map(|c| (&*c.project, c.frame_forms.len(), c.whole.len())).collect();
    assert_eq!(rows, [("lesson-0", 1, 0), ("lesson-1", 1, 1), ("lesson-2", 1, 1)]);
    both.write(folder.path()).unwrap();
    merge(folder.path()).unwrap();
    assert!(both.holds(folder.path(), "lesson-0/one.vtt", "k"));
    assert!(!both.holds(folder.path(), "lesson-0/one.vtt", "l"));
    assert!(!both.holds(folder.path(), "lesson-1/one.srt", "k"));
}

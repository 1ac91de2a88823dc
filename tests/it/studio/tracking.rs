//! The studio's side of calibration and tracking, on `projects/xiyang`: shots are walked, corrected and calibrated; the
//! face of a video is followed, shown beside the drawing, and its ratios are edited.

#![allow(clippy::unwrap_used, reason = "a test may stop")]

use std::path::{Path, PathBuf};

use crate::support::studio_bench::Bench;
use lianpu::calibration::{CalibrationFile, Marks, Source};
use lianpu::face::{FeaturePoint, How, create};
use lianpu::photo::Photo;
use lianpu::pose::Emotion;
use lianpu::project::{Change, Concern, Edit, FaceEdit, Finding, Lesson, check};
use lianpu::studio::{Colours, Studio};

const XIYANG: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/projects/xiyang");

/// A copy of the lesson with the photos that are named, the points of its neutral one, and a video of these pictures.
fn copied(photos: &[&str], frames: &[Vec<u8>]) -> tempfile::TempDir {
    let dir = tempfile::tempdir().unwrap();
    let root = dir.path().join("nihao");
    let (face, clip) = (root.join("faces/teacher"), root.join("clips/xiyang"));
    std::fs::create_dir_all(&face).unwrap();
    std::fs::create_dir_all(&clip).unwrap();
    std::fs::copy(Path::new(XIYANG).join("lianpu.toml"), root.join("lianpu.toml")).unwrap();
    for name in photos {
        std::fs::copy(Path::new(XIYANG).join("faces/teacher").join(name), face.join(name)).unwrap();
    }
    let (photo, sum) = Photo::read_with_sum(&face.join("neutral.png")).unwrap();
    std::fs::write(face.join("face.toml"), create(&photo, &sum, None, None).unwrap().face.to_toml()).unwrap();
    if frames.is_empty() {
        for name in ["script.txt", "speech.wav"] {
            std::fs::copy(Path::new(XIYANG).join("clips/xiyang").join(name), clip.join(name)).unwrap();
        }
    } else {
        std::fs::create_dir(clip.join("frames")).unwrap();
        for (i, bytes) in frames.iter().enumerate() {
            std::fs::write(clip.join(format!("frames/{i:04}.jpg")), bytes).unwrap();
        }
    }
    dir
}

fn bench(dir: tempfile::TempDir, colours: Colours) -> Bench {
    let studio =
        Studio::new(dir.path(), colours, Box::new(|_, _, _| Ok(lianpu::export::CourseReport::default()))).unwrap();
    Bench { studio, dir }
}

fn folder(bench: &Bench) -> PathBuf {
    bench.dir.path().join("nihao/faces/teacher")
}

fn marks(bench: &Bench, name: &str) -> Marks {
    Marks::parse(&std::fs::read_to_string(folder(bench).join(name)).unwrap()).unwrap()
}

/// A point of a shot as the lesson on the desk has it.
fn placed(bench: &Bench, emotion: Emotion, point: FeaturePoint) -> lianpu::face::Placed {
    let face = bench.studio.project().unwrap().borrow().lesson.faces[0].clone();
    face.shot(emotion).unwrap().points().find(|p| p.0 == point).unwrap().1
}

#[test]
fn shots_are_walked_calibrated_corrected_undone_saved_and_read_back() {
    let mut bench = bench(copied(&["neutral.png", "happy.jpg", "surprised.jpg"], &[]), Colours::None);
    bench.keys("Enter f");
    assert!(bench.screen(100, 30).contains("never calibrated: C does that"), "{}", bench.screen(100, 30));
    bench.keys("]");
    assert!(bench.screen(100, 30).contains("no points yet: C finds them"));
    bench.keys("Right");
    assert!(bench.message().contains("C finds them") && !bench.studio.is_unsaved());
    bench.keys("]");
    let missing = bench.screen(100, 30);
    assert!(missing.contains("There is no photo of anger") && missing.contains("○anger"), "{missing}");

    bench.keys("C");
    assert!(bench.message().starts_with("calibrated:"), "{}", bench.message());
    let face = folder(&bench);
    let file = CalibrationFile::read(&face.join("calibration.toml")).unwrap();
    let source = |e: Emotion| file.calibration.shapes()[e.index()].source;
    assert!(matches!(source(Emotion::Happy), Source::Found(_)) && source(Emotion::Anger) == Source::Modelled);
    assert!(face.join("model.aam").is_file() && !face.join("anger.toml").exists());
    assert!(!bench.studio.is_unsaved(), "what was found is saved");
    let screen = bench.screen(100, 30);
    assert!(screen.contains("modelled after everybody's face"), "{screen}");
    insta::assert_snapshot!("shot_missing_80x24", bench.screen(80, 24));

    // A point moved with both sides, taken back, moved again.
    bench.keys("[");
    assert_eq!(bench.face().shot, Emotion::Happy);
    let before = marks(&bench, "happy.toml");
    let point = bench.face().point;
    let was = placed(&bench, Emotion::Happy, point);
    bench.keys("Right Down");
    let now = placed(&bench, Emotion::Happy, point);
    assert_eq!((now.how, now.confidence), (How::Hand, 1.0));
    assert!((now.at.x - was.at.x - 1.0).abs() < 0.06 && (now.at.y - was.at.y - 1.0).abs() < 0.06, "{was:?} {now:?}");
    assert!(bench.screen(100, 30).contains("changed since the face was calibrated"));
    bench.keys("u u");
    assert_eq!(placed(&bench, Emotion::Happy, point), was);
    assert!(!bench.face().is_stale);
    bench.keys("Ctrl-r b Right Tab x");
    assert!(bench.message().contains("not set by hand"), "{}", bench.message());
    bench.keys("s");
    assert!(bench.message().contains("happy.toml") && !bench.message().contains("surprised"), "{}", bench.message());
    let after = marks(&bench, "happy.toml");
    let set = after.points.iter().filter(|p| p.how == How::Hand).count();
    assert_eq!((set, after.photo == before.photo), (2, true), "the point and its mirror image");
    let read = Lesson::read(&bench.dir.path().join("nihao")).unwrap();
    assert_eq!(read.faces[0].shot(Emotion::Happy).unwrap().marks.as_ref(), Some(&after));
    let odd = check(&read.root)
        .into_iter()
        .any(|f| matches!(f, Finding::Odd(t) if t.to_string().contains("since it was calibrated")));
    assert!(odd, "check says that the calibration is of other points");

    // What a hand has set stays through a calibration, and is what it goes by.
    bench.keys("C");
    assert!(bench.message().starts_with("calibrated:"), "{}", bench.message());
    assert!(!bench.face().is_stale);
    let again = marks(&bench, "happy.toml");
    for (one, other) in after.points.iter().zip(&again.points).filter(|p| p.0.how == How::Hand) {
        assert_eq!(one, other);
    }
    bench.keys("Shift-Tab x");
    assert!(bench.message().contains("free again"), "{}", bench.message());
    assert!(bench.face().is_stale);
    bench.keys("u");

    // Somebody else's change of the file is not written over.
    bench.keys("Left");
    std::fs::write(folder(&bench).join("happy.toml"), before.to_toml()).unwrap();
    bench.keys("s");
    assert!(bench.message().contains("changed by something else"), "{}", bench.message());
    assert_eq!(marks(&bench, "happy.toml"), before);
}

#[test]
fn points_of_somebody_elses_annotation_are_shown_and_not_moved() {
    let dir = copied(&["neutral.png", "happy.jpg"], &[]);
    let list = "version: 1\nn_points: 3\n{\n200 200\n280 200\n240 300\n}\n";
    for name in ["neutral.pts", "happy.pts"] {
        std::fs::write(dir.path().join("nihao/faces/teacher").join(name), list).unwrap();
    }
    let mut bench = bench(dir, Colours::None);
    bench.keys("Enter f ]");
    let screen = bench.screen(80, 24);
    assert!(screen.contains("3 points of happy.pts") && screen.contains('·'), "{screen}");
    bench.keys("Right");
    assert!(bench.message().contains("change them in happy.pts"), "{}", bench.message());
}

#[test]
fn journals_of_before_read_as_points_of_the_neutral_shot() {
    let text = r#"{"label":"move 3.6","edits":[{"point":{"face":0,"point":"3.6",
        "before":{"at":[1.0,2.0],"confidence":0.5,"how":"found"},"after":{"at":[2.0,2.0],"confidence":1.0,"how":"hand"}}}]}"#;
    let change: Change = serde_json::from_str(text).unwrap();
    assert!(matches!(change.edits[0], Edit::Face(_, FaceEdit::Point { shot: Emotion::Neutral, .. })));
}

#[test]
fn a_face_is_followed_shown_and_its_ratios_edited_and_what_was_tracked_stays() {
    // Twelve frames, four of them black.
    let frame = |i: usize| std::fs::read(format!("{XIYANG}/clips/xiyang/frames/{i:04}.jpg")).unwrap();
    let black = {
        let photo = Photo::decode(&frame(0)).unwrap();
        let image = image::RgbImage::new(photo.width() as u32, photo.height() as u32);
        let mut bytes = std::io::Cursor::new(Vec::new());
        image.write_to(&mut bytes, image::ImageFormat::Jpeg).unwrap();
        bytes.into_inner()
    };
    let frames: Vec<_> = (0..14).map(|i| if (6..10).contains(&i) { black.clone() } else { frame(18 + i) }).collect();
    let shots = ["neutral.png", "happy.jpg", "surprised.jpg"];
    let mut bench = bench(copied(&shots, &frames), Colours::True);
    // A clip that is opened is followed of itself, once; T does it again.
    bench.keys("Enter Enter");
    let clip = |b: &Bench| b.clip().clone();
    let said = bench.message();
    assert_eq!(clip(&bench).record.as_ref().map(|r| r.rows.len()), Some(14), "{said}");
    assert!(said.contains("14 frames") && said.contains("d goes there"), "{said}");
    let lost = clip(&bench).lost();
    let whole = lost.iter().find(|d| d.what == Concern::FaceLost).unwrap();
    assert!((whole.start - 0.24).abs() < 0.05 && (whole.end - 0.40).abs() < 0.13, "{lost:?}");
    bench.keys("d");
    assert!((bench.cursor() - lost[0].start).abs() < 0.021, "{}", bench.message());
    bench.keys("u");
    assert!(clip(&bench).record.is_none(), "one step takes it back");
    bench.keys("Ctrl-r T");
    assert!(bench.message().contains("nothing new"), "{}", bench.message());

    // The frame of the cursor beside the drawing, on narrow screens too.
    bench.keys("Home V");
    let shown = |b: &Bench| b.editor().borrow().footage.picture().map(|p| p.pixels()[0]);
    let first = shown(&bench).unwrap();
    for (width, height) in [(60, 20), (80, 24), (160, 48)] {
        let with = bench.screen(width, height).matches('▀').count();
        bench.keys("V");
        let without = bench.screen(width, height).matches('▀').count();
        bench.keys("V");
        assert!(with > without + 40, "{width} × {height}: {with} against {without}");
    }
    bench.keys("Right Right Right Right Right Right Right");
    let dark = shown(&bench).unwrap();
    assert!(dark.iter().all(|v| *v < 10) && first.iter().any(|v| *v > 20), "{first:?} {dark:?}");

    // An edit of a stretch over the record: the file of what was tracked stays as it is.
    bench.keys("s");
    let file = bench.dir.path().join("nihao/clips/xiyang/ratios.csv");
    let tracked = std::fs::read_to_string(&file).unwrap();
    let happy = |b: &Bench| b.editor().borrow().timeline.ratios(0.16)[Emotion::Happy];
    let before = happy(&bench);
    bench.keys("Home v End v 'happy *0.5 +0.3, smooth 0.08' Enter");
    assert!(bench.studio.is_unsaved(), "{}", bench.message());
    assert!((happy(&bench) - before).abs() > 0.05, "{} {before}", happy(&bench));
    bench.keys("s");
    assert_eq!(std::fs::read_to_string(&file).unwrap(), tracked);
    let score = std::fs::read_to_string(file.with_file_name("score.toml")).unwrap();
    assert!(score.contains("[[range]]"), "{score}");
    bench.keys("u");
    assert!((happy(&bench) - before).abs() < 1e-9);

    // Ratios that somebody else made give way only when that was asked.
    let score = file.with_file_name("score.toml");
    std::fs::write(&score, "").unwrap();
    std::fs::write(&file, tracked.replace(",0.9", ",0.8")).unwrap();
    bench.keys("q q d Enter Enter T");
    assert!(bench.message().contains("T again"), "{}", bench.message());
    assert!(!bench.studio.is_unsaved());
    bench.keys("T");
    assert!(bench.message().contains("followed the face"), "{}", bench.message());
    bench.keys("V");

    // A video that cannot be read is said, and nothing is shown.
    std::fs::write(bench.dir.path().join("nihao/clips/xiyang/frames/0003.jpg"), "no picture").unwrap();
    bench.keys("Home Right Right Right");
    assert!(shown(&bench).is_none() && !bench.message().is_empty());
}

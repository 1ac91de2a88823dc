//! From a photo to a face that talks, as a teacher does it: on the command line and in the studio.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use lianpu::face::{Face, FeaturePoint, How, Part};
use lianpu::photo::Photo;
use lianpu::project::Lesson;
use lianpu::studio::{Colours, FaceScreen, Studio};
use ratatui::Terminal;
use ratatui::backend::TestBackend;

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn lianpu(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_lianpu")).args(args).output().unwrap()
}

fn done(args: &[&str]) -> String {
    let output = lianpu(args);
    assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// What a failed call says.
fn refused(args: &[&str], code: i32) -> String {
    let output = lianpu(args);
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(code), "{args:?}: {said}");
    said
}

/// A copy of the sample lesson, to change.
fn sample(folder: &Path) -> PathBuf {
    fn copy(from: &Path, to: &Path) {
        std::fs::create_dir_all(to).unwrap();
        for entry in std::fs::read_dir(from).unwrap().flatten() {
            let name = entry.file_name();
            match entry.file_type().unwrap().is_dir() {
                true if [".lianpu", "export"].contains(&name.to_str().unwrap()) => {}
                true => copy(&entry.path(), &to.join(name)),
                false => drop(std::fs::copy(entry.path(), to.join(name)).unwrap()),
            }
        }
    }
    let to = folder.join("nihao");
    copy(&root().join("projects/nihao"), &to);
    to
}

fn face_of(project: &Path) -> Face {
    Face::parse(&std::fs::read_to_string(project.join("faces/teacher/face.toml")).unwrap()).unwrap()
}

#[test]
fn any_photo_gives_its_points_colours_and_warnings_as_json() {
    let photo = root().join("tests/pictures/man.png");
    let printed = done(&["face", "--photo", photo.to_str().unwrap(), "--json"]);
    let json: serde_json::Value = serde_json::from_str(&printed).unwrap();
    for point in FeaturePoint::fixed() {
        let row = &json["points"][point.name()];
        let (x, y) = (row["x"].as_f64().unwrap(), row["y"].as_f64().unwrap());
        assert!((0.0..480.0).contains(&x) && (0.0..480.0).contains(&y), "{point}: {row}");
        assert!((0.0..=1.0).contains(&row["confidence"].as_f64().unwrap()), "{point}: {row}");
        assert!(["found", "rule"].contains(&row["how"].as_str().unwrap()), "{point}: {row}");
    }
    let y = |name: &str| json["points"][name]["y"].as_f64().unwrap();
    assert!(y("4.4") < y("3.2") && y("3.2") < y("3.4") && y("3.4") < y("9.15") && y("9.15") < y("8.1"));
    assert!(y("8.1") < y("2.3") && y("2.3") < y("8.2") && y("8.2") < y("2.1"));
    for colour in ["skin", "hair", "lips", "iris"] {
        assert!(json["colours"][colour].as_str().unwrap().starts_with('#'), "{printed}");
    }
    assert!(json["warnings"].is_array());
}

#[test]
fn a_picture_without_one_frontal_face_is_refused_with_the_reason() {
    for name in ["turned", "profile", "away", "two"] {
        let photo = root().join(format!("tests/pictures/refused/{name}.png"));
        let said = refused(&["face", "--photo", photo.to_str().unwrap(), "--json"], 1);
        assert!(said.lines().count() >= 3, "what, where and what to do: {said}");
        println!("{name}: {said}");
    }
    let said = refused(&["face", "--photo", root().join("Cargo.toml").to_str().unwrap()], 1);
    assert!(said.contains("PNG, JPEG or WebP"), "{said}");
    refused(&["face"], 2);
    refused(&["face", "--photo", "a.png", "--at", "1,2"], 2);
}

#[test]
fn what_a_hand_has_set_is_kept_when_the_points_are_found_again() {
    let folder = tempfile::tempdir().unwrap();
    let project = sample(folder.path());
    let path = project.join("faces/teacher/face.toml");
    let before = face_of(&project);
    let corner = before.points[FeaturePoint::P8_4.index()].at;
    let mut edited = before.clone();
    let placed = edited.placed_mut(FeaturePoint::P8_4).unwrap();
    placed.at.x = corner.x - 6.0;
    placed.how = How::Hand;
    std::fs::write(&path, edited.to_toml()).unwrap();
    let printed = done(&["face", project.to_str().unwrap()]);
    assert!(printed.contains("1 by hand"), "{printed}");
    let after = face_of(&project);
    let kept = after.placed(FeaturePoint::P8_4).unwrap();
    assert!((kept.at.x - (corner.x - 6.0)).abs() < 0.11 && kept.how == How::Hand && kept.confidence == 1.0, "{kept:?}");
    // The eyes are where they were, within 2.5 % of their distance: a corner of the mouth says little of them.
    let eye = |face: &Face| face.points[FeaturePoint::P3_6.index()].at;
    let off = eye(&after).distance(eye(&before));
    assert!(off < 2.5, "the eye moved by {off} pixels");
    for file in ["score.toml", "timing.TextGrid"] {
        let read = |root: &Path| std::fs::read(root.join("clips/nihao").join(file)).unwrap();
        assert_eq!(read(&project), read(&root().join("projects/nihao")), "{file}");
    }
}

#[test]
fn four_places_by_hand_are_enough_where_nothing_is_found() {
    let photo = root().join("tests/pictures/man.png");
    let found: serde_json::Value =
        serde_json::from_str(&done(&["face", "--photo", photo.to_str().unwrap(), "--json"])).unwrap();
    let at = |name: &str| {
        let row = &found["points"][name];
        (row["x"].as_f64().unwrap(), row["y"].as_f64().unwrap())
    };
    let mouth = ((at("2.2").0 + at("2.3").0) / 2.0, (at("2.2").1 + at("2.3").1) / 2.0);
    let places: Vec<String> = [at("3.6"), at("3.5"), mouth, at("2.1")].map(|(x, y)| format!("{x:.0},{y:.0}")).to_vec();
    let mut args = vec!["face", "--photo", photo.to_str().unwrap(), "--json", "--at"];
    args.extend(places.iter().map(String::as_str));
    let placed: serde_json::Value = serde_json::from_str(&done(&args)).unwrap();
    let unit = (at("3.5").0 - at("3.6").0).hypot(at("3.5").1 - at("3.6").1);
    for point in FeaturePoint::fixed().filter(|p| ![Part::Ears].contains(&p.part())) {
        let row = &placed["points"][point.name()];
        let (x, y) = at(&point.name());
        let off = (row["x"].as_f64().unwrap() - x).hypot(row["y"].as_f64().unwrap() - y) / unit;
        assert!(off < 0.2, "{point} is {off:.3} pupil distances off");
    }
}

#[test]
fn a_lesson_from_a_photo_has_its_cartoon_and_no_metadata() {
    let folder = tempfile::tempdir().unwrap();
    let project = folder.path().join("mine");
    let photo = root().join("tests/pictures/man.png");
    let printed = done(&["new", project.to_str().unwrap(), "--neutral", photo.to_str().unwrap()]);
    assert!(printed.contains("a face, and no clip yet"), "{printed}");
    let kept = project.join("faces/teacher/neutral.png");
    assert_eq!(Photo::read(&kept).unwrap(), Photo::read(&photo).unwrap());
    let lesson = Lesson::read(&project).unwrap();
    assert_eq!(lesson.manifest.faces[0].figure.as_deref(), Some("cartoon"));
    assert!(lesson.cartoon_of(&lesson.faces[0]).is_ok());
    assert!(done(&["check", project.to_str().unwrap()]).contains("drawn as a cartoon"));

    let nobody = folder.path().join("nobody");
    let away = root().join("tests/pictures/refused/away.png");
    refused(&["new", nobody.to_str().unwrap(), "--neutral", away.to_str().unwrap()], 1);
    assert!(!nobody.exists());
}

#[test]
fn style_and_layers_of_the_author_are_drawn_and_what_is_wrong_with_them_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let project = sample(folder.path());
    let manifest = std::fs::read_to_string(project.join("lianpu.toml")).unwrap();
    let with = |more: &str| {
        let text = manifest.replace("figure = \"cartoon\"\n", &format!("figure = \"cartoon\"\n{more}\n"));
        assert_ne!(text, manifest);
        std::fs::write(project.join("lianpu.toml"), text).unwrap();
    };
    let drawn = || {
        let lesson = Lesson::read(&project).unwrap();
        let figure = lesson.figure_of(&lesson.manifest.clips[0]).unwrap();
        figure.draw(&lianpu::pose::Pose::default()).fingerprint()
    };
    let normal = drawn();
    with("style = \"cute\"");
    assert_ne!(drawn(), normal);
    std::fs::create_dir_all(project.join("styles")).unwrap();
    std::fs::write(project.join("styles/mine.toml"), lianpu::figure::cartoon::Style::built_in_text("ink").unwrap())
        .unwrap();
    with("style = \"styles/mine.toml\"");
    assert_ne!(drawn(), normal);
    std::fs::create_dir_all(project.join("layers")).unwrap();
    let scarf = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"410\" height=\"550\">\
                 <rect x=\"90\" y=\"440\" width=\"230\" height=\"40\" fill=\"#b03a48\"/><text x=\"9\" y=\"9\">hi</text></svg>";
    std::fs::write(project.join("layers/scarf.svg"), scarf).unwrap();
    with("layers = [{ file = \"layers/scarf.svg\" }]");
    assert_ne!(drawn(), normal);
    assert!(done(&["check", project.to_str().unwrap()]).contains("turn it into paths"));

    with("style = \"cuet\"");
    refused(&["check", project.to_str().unwrap()], 1);
    let printed = done_or_said(&project);
    assert!(printed.contains("did you mean `cute`"), "{printed}");
    with("layers = [{ file = \"../secret.svg\" }]");
    refused(&["check", project.to_str().unwrap()], 1);
    with("layers = [{ file = \"layers/none.svg\" }]");
    refused(&["export", project.to_str().unwrap(), "--to", "png"], 1);
}

/// What a check prints, whatever its exit code.
fn done_or_said(project: &Path) -> String {
    String::from_utf8(lianpu(&["check", project.to_str().unwrap()]).stdout).unwrap()
}

fn studio(project: &Path) -> Studio {
    let mut studio =
        Studio::new(project, Colours::True, Box::new(|_, _, _| Ok(lianpu::export::CourseReport::default()))).unwrap();
    studio.key("Enter");
    studio.settle();
    studio.key("f");
    studio.settle();
    studio
}

fn screen(studio: &mut Studio, width: u16, height: u16) -> String {
    let mut terminal = Terminal::new(TestBackend::new(width, height)).unwrap();
    terminal.draw(|frame| studio.draw(frame)).unwrap();
    let buffer = terminal.backend().buffer().clone();
    let rows = (0..height).map(|y| (0..width).map(|x| buffer[(x, y)].symbol().to_owned()).collect::<String>());
    rows.map(|row| row.trim_end().to_owned()).collect::<Vec<_>>().join("\n")
}

#[test]
fn points_move_by_keys_alone_or_with_their_mirror_image_and_undo_takes_it_back() {
    let folder = tempfile::tempdir().unwrap();
    let project = sample(folder.path());
    let before = face_of(&project);
    let mut studio = studio(&project);
    let at = |studio: &Studio, p: FeaturePoint| {
        *studio.project().unwrap().borrow().lesson.faces[0].face.as_ref().unwrap().placed(p).unwrap()
    };
    assert!(screen(&mut studio, 80, 24).contains("middle of the left eyeball"));
    for key in ["g", "Ctrl-u", "8", ".", "4", "Enter"] {
        studio.key(key);
    }
    assert!(screen(&mut studio, 80, 24).contains("left corner of the mouth"));
    studio.key("Left");
    studio.key("Shift-Down");
    let moved = at(&studio, FeaturePoint::P8_4);
    let start = before.placed(FeaturePoint::P8_4).unwrap().at;
    assert!((moved.at.x - start.x + 1.0).abs() < 1e-6 && (moved.at.y - start.y - 10.0).abs() < 1e-6);
    assert_eq!(moved.how, How::Hand);
    assert_eq!(at(&studio, FeaturePoint::P8_3), *before.placed(FeaturePoint::P8_3).unwrap());
    studio.key("b");
    studio.key("H");
    let other = at(&studio, FeaturePoint::P8_3).at - before.placed(FeaturePoint::P8_3).unwrap().at;
    assert!((other.x - 10.0).abs() < 0.6, "{other:?}");
    for _ in 0..3 {
        studio.key("u");
    }
    assert_eq!(studio.project().unwrap().borrow().lesson.faces[0].face.as_ref().unwrap(), &before);
    studio.key("Right");
    studio.key("s");
    assert_eq!(face_of(&project).placed(FeaturePoint::P8_4).unwrap().how, How::Hand);
}

#[test]
fn stages_emotions_and_mouths_can_be_looked_at_and_the_face_placed_by_hand() {
    let folder = tempfile::tempdir().unwrap();
    let project = sample(folder.path());
    let mut studio = studio(&project);
    let plain = screen(&mut studio, 120, 40);
    studio.key("v");
    studio.key("v");
    assert!(screen(&mut studio, 120, 40).contains("eq. 3.4"), "{plain}");
    studio.key("V");
    studio.key("V");
    studio.key("e");
    studio.key("m");
    assert!(screen(&mut studio, 120, 40).contains("shown: happy, mouth m"));
    let face = face_of(&project);
    let goal = |p: FeaturePoint| face.points[p.index()].at;
    let mouth = goal(FeaturePoint::P2_2).midpoint(goal(FeaturePoint::P2_3));
    studio.key("o");
    assert!(screen(&mut studio, 120, 40).contains("1 of 4"));
    for place in [goal(FeaturePoint::P3_6), goal(FeaturePoint::P3_5), mouth, goal(FeaturePoint::P2_1)] {
        let cross = studio.stack.find::<FaceScreen>().unwrap().desk.placing.as_ref().unwrap().cross;
        let (x, y) = ((place.x - cross.x).round() as i32, (place.y - cross.y).round() as i32);
        (0..x.abs()).for_each(|_| _ = studio.key(if x < 0 { "h" } else { "l" }));
        (0..y.abs()).for_each(|_| _ = studio.key(if y < 0 { "k" } else { "j" }));
        studio.key("Enter");
    }
    studio.settle();
    let placed = studio.project().unwrap().borrow().lesson.faces[0].face.clone().unwrap();
    assert!(placed.points[FeaturePoint::P8_4.index()].at.distance(goal(FeaturePoint::P8_4)) < 12.0);
    studio.key("c");
    assert!(screen(&mut studio, 80, 24).contains("hair: wavy"));
}

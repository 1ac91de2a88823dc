//! The cartoon: what holds for any face, style and pose, and how it looks.
//!
//! The faces of `tests/faces` are nobody's. `LIANPU_GOLDEN=write cargo test --test it cartoon` makes the pictures again.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use std::path::PathBuf;

use crate::support::golden_picture::{cells, hold, same_as_resvg};
use lianpu::drawing::{Area, Drawing, Group, Item};
use lianpu::face::{Face, FeaturePoint, HairKind};
use lianpu::figure::Figure;
use lianpu::figure::cartoon::{Cartoon, Extra, Sheet, Style};
use lianpu::geometry::{Circle, PathEl, Point, Shape};
use lianpu::pose::{Emotion, Gaze, Head, Lids, MouthPose, MouthPreset, MouthShape, Pose, Ratios};
use proptest::prelude::*;

const FACES: [&str; 3] = ["mei", "omar", "lena"];

fn face(name: &str) -> Face {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/faces").join(format!("{name}.toml"));
    Face::parse(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn cartoon(name: &str, style: &str) -> Cartoon {
    Cartoon::new(&face(name), &Style::built_in(style).unwrap())
}

fn mouth(shape: MouthShape) -> MouthPose {
    MouthPose::of(shape, MouthPreset::Distinct)
}

/// Everything in a drawing, groups and what is shared taken apart.
fn flat(drawing: &Drawing) -> Vec<Item> {
    fn add(item: &Item, all: &mut Vec<Item>) {
        all.push(item.clone());
        match item {
            Item::Group(Group { items, .. }) => items.iter().for_each(|i| add(i, all)),
            Item::Shared(shared) => shared.items().iter().for_each(|i| add(i, all)),
            _ => {}
        }
    }
    let mut all = Vec::new();
    drawing.layers.iter().flat_map(|l| &l.items).for_each(|i| add(i, &mut all));
    all
}

fn name_of(item: &Item) -> &str {
    match item {
        Item::Area(area) => &area.name,
        Item::Group(group) => &group.name,
        Item::Glow(glow) => &glow.name,
        _ => "",
    }
}

fn has(drawing: &Drawing, name: &str) -> bool {
    flat(drawing).iter().any(|i| name_of(i) == name)
}

fn area(drawing: &Drawing, name: &str) -> Option<Area> {
    flat(drawing).into_iter().find_map(|i| match i {
        Item::Area(area) if area.name == name => Some(area),
        _ => None,
    })
}

/// Whether every number of a drawing is finite and none is absurd.
fn is_sound(drawing: &Drawing) -> Result<(), String> {
    let far = |p: Point| !p.is_finite() || p.x.abs() > 1e5 || p.y.abs() > 1e5;
    for item in flat(drawing) {
        let bad = match &item {
            Item::Area(area) => area.path.elements().iter().any(|e| match *e {
                PathEl::MoveTo(a) | PathEl::LineTo(a) => far(a),
                PathEl::QuadTo(a, b) => far(a) || far(b),
                PathEl::CurveTo(a, b, c) => far(a) || far(b) || far(c),
                PathEl::ClosePath => false,
            }),
            Item::Glow(glow) => far(glow.at) || far(glow.radii.to_point()),
            Item::Group(group) => group.transform.as_coeffs().iter().any(|v| !v.is_finite()),
            _ => false,
        };
        if bad {
            return Err(format!("{} is not sound", name_of(&item)));
        }
    }
    let view = drawing.view;
    if view.width() > 100.0 && view.height() > 100.0 && view.is_finite() { Ok(()) } else { Err(format!("{view:?}")) }
}

#[test]
fn people_look_as_they_did_in_every_style() {
    let drawings = FACES.iter().flat_map(|f| Style::BUILT_IN.map(|s| cartoon(f, s).draw(&Pose::default())));
    hold("cartoon-styles", &cells(&drawings.collect::<Vec<_>>(), 4, (150.0, 201.0)));
}

#[test]
fn a_face_speaks_feels_and_moves_as_it_did() {
    let lena = cartoon("lena", "normal");
    let mut poses: Vec<Pose> = Emotion::ALL.iter().map(|e| Pose::of(Ratios::pure(*e))).collect();
    poses.extend(MouthShape::ALL.map(|s| Pose { mouth: mouth(s), ..Pose::default() }));
    let closed = Lids { left: 0.0, right: 0.0 };
    poses.push(Pose { lids: closed, ..Pose::default() });
    for (x, y, roll) in [(0.05, 0.0, 6.0), (0.0, 0.12, 0.0), (-0.08, -0.05, -8.0)] {
        poses.push(Pose { head: Head { x, y, roll }, mouth: mouth(MouthShape::A), ..Pose::default() });
    }
    poses.push(Pose { gaze: Gaze { x: 0.6, y: 0.1 }, ..Pose::default() });
    let drawings: Vec<Drawing> = poses.iter().map(|p| lena.draw(p)).collect();
    hold("cartoon-poses", &cells(&drawings, 7, (120.0, 150.0)));
}

#[test]
fn hair_falls_as_the_style_says() {
    let mut drawings = Vec::new();
    for kind in ["straight", "wavy", "curly", "shaved", "bald"] {
        let text = format!("format = 1\nhair = \"{kind}\"\nglasses = false\n");
        drawings.push(Cartoon::new(&face("mei"), &Style::parse(&text).unwrap()).draw(&Pose::default()));
    }
    let cut = "format = 1\nhair_curve = \"corner-cutting\"\nbeard = true\nfolds = 0.8\nstrands = 0.4\nink = 1.5\n";
    for name in FACES {
        drawings.push(Cartoon::new(&face(name), &Style::parse(cut).unwrap()).draw(&Pose::default()));
    }
    hold("cartoon-hair", &cells(&drawings, 4, (150.0, 201.0)));
}

#[test]
fn our_pixels_are_those_that_resvg_makes_of_our_svg() {
    let open = Pose { mouth: mouth(MouthShape::A), ..Pose::of(Ratios::pure(Emotion::Happy)) };
    let turned = Pose { head: Head { x: 0.1, y: 0.05, roll: 5.0 }, ..open };
    for name in FACES {
        for style in Style::BUILT_IN {
            let cartoon = cartoon(name, style);
            for pose in [Pose::default(), open, turned] {
                same_as_resvg(&format!("{name} {style}"), &cartoon.draw(&pose), 60);
            }
        }
    }
}

#[test]
fn closed_lids_show_no_eye() {
    for name in FACES {
        for style in Style::BUILT_IN {
            let cartoon = cartoon(name, style);
            for emotion in Emotion::ALL {
                let open = Pose::of(Ratios::pure(emotion));
                let shut = Pose { lids: Lids { left: 0.0, right: 0.0 }, ..open };
                assert!(has(&cartoon.draw(&open), "left-iris"), "{name} {style} {emotion}");
                assert!(!has(&cartoon.draw(&shut), "left-iris"), "{name} {style} {emotion}");
                assert!(!has(&cartoon.draw(&shut), "right-iris"), "{name} {style} {emotion}");
            }
        }
    }
}

#[test]
fn m_closes_the_mouth_whatever_the_face_feels() {
    for name in FACES {
        for style in Style::BUILT_IN {
            let cartoon = cartoon(name, style);
            for emotion in Emotion::ALL {
                let say = |shape| Pose { mouth: mouth(shape), ..Pose::of(Ratios::pure(emotion)) };
                assert!(!has(&cartoon.draw(&say(MouthShape::M)), "mouth-open"), "{name} {style} {emotion}");
                assert!(has(&cartoon.draw(&say(MouthShape::A)), "mouth-open"), "{name} {style} {emotion}");
            }
        }
    }
}

#[test]
fn what_is_static_stays_the_same_while_the_head_rests() {
    for name in FACES {
        let cartoon = cartoon(name, "normal");
        let still = cartoon.draw(&Pose::default()).layers[0].clone();
        for emotion in Emotion::ALL {
            for shape in MouthShape::ALL {
                let pose = Pose {
                    mouth: mouth(shape),
                    lids: Lids { left: 0.3, right: 0.8 },
                    gaze: Gaze { x: 0.4, y: -0.2 },
                    ..Pose::of(Ratios::pure(emotion))
                };
                assert_eq!(cartoon.draw(&pose).layers[0], still, "{name} {emotion} {shape}");
            }
        }
    }
}

#[test]
fn the_body_stays_when_the_head_moves() {
    let lena = cartoon("lena", "normal");
    let (rest, turned) = (Pose::default(), Pose { head: Head { x: 0.1, y: 0.1, roll: 8.0 }, ..Pose::default() });
    let (rest, turned) = (lena.draw(&rest), lena.draw(&turned));
    assert_eq!(area(&rest, "shirt"), area(&turned, "shirt"));
    let neck = |d: &Drawing| area(d, "neck").unwrap().path;
    assert_eq!(neck(&rest).bounding_box().y1, neck(&turned).bounding_box().y1);
    assert_ne!(neck(&rest), neck(&turned), "its upper end follows");
    let moved = turned.layers[1].items.iter().filter(|i| name_of(i).starts_with("h")).count();
    assert_eq!(moved, 2, "the head and the hair behind it");
}

#[test]
fn a_chin_that_comes_down_leaves_nothing_of_the_still_one_in_sight() {
    for name in FACES {
        let cartoon = cartoon(name, "normal");
        let wide = Pose { mouth: mouth(MouthShape::A), ..Pose::of(Ratios::pure(Emotion::Surprised)) };
        let (rest, open) = (cartoon.draw(&Pose::default()), cartoon.draw(&wide));
        let (face, jaw) = (area(&rest, "face").unwrap().path, area(&open, "jaw").unwrap().path);
        let (shown, top) = (jaw.bounding_box(), jaw.bounding_box().y0);
        assert!(shown.y1 > face.bounding_box().y1 + 5.0, "{name}");
        // Ink 1.15 wide lies on the new edge, so the old one may stand out by half of that.
        for i in 0..60 {
            for k in 0..40 {
                let p = Point::new(-150.0 + 5.0 * f64::from(i), top + 3.0 * f64::from(k));
                let inside = face.contains(p) && p.y > top + 1.0;
                let near = [(1.2, 0.0), (-1.2, 0.0), (0.0, 1.2), (0.0, -1.2)]
                    .iter()
                    .any(|(x, y)| jaw.contains(Point::new(p.x + x, p.y + y)));
                assert!(!inside || jaw.contains(p) || near, "{name} {p:?}");
            }
        }
    }
}

#[test]
fn the_view_follows_the_hair() {
    let mut tall = face("lena");
    for p in &mut tall.hair.front[0] {
        if p.y < 150.0 {
            p.y -= 120.0;
        }
    }
    tall.hair.vertices.clear();
    let style = Style::built_in("normal").unwrap();
    let (usual, tall) = (Cartoon::new(&face("lena"), &style), Cartoon::new(&tall, &style));
    assert!(tall.view().y0 < usual.view().y0 - 50.0);
    assert!(tall.view().contains(tall.face_view().origin()));
}

#[test]
fn a_hand_that_moves_a_point_changes_the_drawing() {
    let style = Style::built_in("normal").unwrap();
    let before = Cartoon::new(&face("lena"), &style);
    for name in ["8.4", "4.6", "3.2", "9.1", "2.1", "10.4", "h.9"] {
        let mut moved = face("lena");
        moved.placed_mut(FeaturePoint::named(name).unwrap()).unwrap().at.y -= 6.0;
        let after = Cartoon::new(&moved, &style);
        assert_ne!(before.fingerprint(), after.fingerprint(), "{name}");
        assert_ne!(Figure::from(before.clone()).key(), Figure::from(after).key(), "{name}");
    }
}

#[test]
fn an_author_lays_her_own_things_over_and_under_sheets() {
    let badge = |name: &str| {
        let round = Circle::new((60.0, 270.0), 12.0).to_path(0.1);
        vec![Item::area(name, round, lianpu::drawing::Colour::rgb(200, 40, 40))]
    };
    let extra = |sheet, over, name: &str| Extra { sheet, over, items: badge(name) };
    let plain = cartoon("lena", "normal");
    let with = plain.clone().with(vec![
        extra(Sheet::Shirt, true, "badge"),
        extra(Sheet::Face, false, "scarf"),
        extra(Sheet::Hair, true, "hat"),
    ]);
    assert_ne!(plain.fingerprint(), with.fingerprint());
    let order = |d: &Drawing| flat(d).iter().map(|i| name_of(i).to_owned()).collect::<Vec<_>>();
    for head in [Head::default(), Head { x: 0.1, y: 0.0, roll: 4.0 }] {
        let names = order(&with.draw(&Pose { head, ..Pose::default() }));
        let place = |name: &str| names.iter().position(|n| n == name).unwrap_or_else(|| panic!("{name}"));
        assert!(place("shirt") < place("badge") && place("badge") < place("face"));
        assert!(place("scarf") < place("face") && place("right-brow") < place("hat"));
    }
    let close = with.close_up(1.5);
    assert!(has(&close.draw(&Pose::default()), "hat"));
    assert_eq!(close.view(), with.face_view());
}

#[test]
fn the_four_styles_are_files_and_a_bare_one_is_the_normal_one() {
    for name in Style::BUILT_IN {
        assert_eq!(Style::built_in(name).unwrap().title(), name);
        assert!(Style::built_in_text(name).unwrap().starts_with('#'), "{name} says what it is");
    }
    let bare = Style::parse("format = 1\ntitle = \"normal\"\n").unwrap();
    assert_eq!(bare, Style::built_in("normal").unwrap());
    assert!(Style::built_in("cuet").unwrap_err().next_step().contains("did you mean `cute`"));
}

#[test]
fn faults_of_a_style_name_the_line_and_the_nearest_key() {
    let normal = Style::built_in_text("normal").unwrap();
    for (from, to, line, said) in [
        ("ink_only = false", "inkonly = false", "inkonly", "did you mean `ink_only`"),
        ("ink = 1.0 ", "ink = 9.0 ", "ink = 9", "from 0 to 4"),
        ("ink = 1.0 ", "ink = nan ", "ink = nan", "from 0 to 4"),
        ("hair = \"auto\"", "hair = \"culry\"", "hair =", "did you mean `curly`"),
        ("beard = \"auto\"", "beard = \"maybe\"", "beard =", "see the README"),
        ("symmetry = 0.65", "symmetry = 2", "symmetry =", "from 0 to 1"),
        ("# skin, shade,", "skni = \"#ffffff\" #", "skni =", "did you mean `skin`"),
        ("# skin, shade,", "skin = \"fff\" #", "skin =", ""),
        ("format = 1", "format = 2", "format =", "reads format 1"),
    ] {
        let text = normal.replacen(from, to, 1);
        assert_ne!(text, normal, "{from}");
        let fault = Style::parse(&text).unwrap_err();
        let at = text.lines().position(|l| l.starts_with(line)).unwrap() + 1;
        assert_eq!(fault.line_number(), Some(at), "{to}: {fault}");
        assert!(fault.next_step().contains(said), "{to}: {fault}");
    }
}

#[test]
fn choices_of_a_style_win_over_what_was_found() {
    let drawn = |name: &str, line: &str| {
        let style = Style::parse(&format!("format = 1\n{line}\n")).unwrap();
        Cartoon::new(&face(name), &style).draw(&Pose::default())
    };
    assert!(has(&drawn("mei", ""), "lens") && !has(&drawn("mei", "glasses = false"), "lens"));
    assert!(!has(&drawn("omar", ""), "lens") && has(&drawn("omar", "glasses = true"), "lens"));
    assert!(has(&drawn("omar", ""), "beard") && !has(&drawn("omar", "beard = false"), "beard"));
    assert!(has(&drawn("mei", "beard = true"), "beard"));
    assert!(!has(&drawn("mei", "hair = \"bald\""), "hair-front"));
    assert!(!has(&drawn("mei", "disc = false"), "disc"));
    assert_eq!(drawn("mei", "background = false").background, None);
    let red = drawn("mei", "shirt = \"#cc2222\"");
    assert_eq!(area(&red, "shirt").unwrap().colour.to_string(), "#cc2222");
    // Hair that is not in the file cannot be drawn however it is asked for.
    assert!(has(&drawn("omar", "hair = \"wavy\""), "skull"));
}

fn any_pose() -> impl Strategy<Value = Pose> {
    let wild = prop_oneof![-2.0..2.0f64, Just(0.0), Just(1.0), -1e6..1e6f64];
    (
        prop::array::uniform7(wild.clone()),
        prop::array::uniform11(-2.0..2.0f64),
        prop::array::uniform4(wild.clone()),
        prop::array::uniform3(wild),
    )
        .prop_map(|(ratios, mouth, eyes, head)| Pose {
            ratios: Ratios(ratios),
            mouth: MouthPose::from_array(mouth),
            gaze: Gaze { x: eyes[0], y: eyes[1] },
            lids: Lids { left: eyes[2], right: eyes[3] },
            head: Head { x: head[0], y: head[1], roll: head[2] },
            shape: None,
        })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn any_finite_pose_gives_a_sound_drawing(pose in any_pose(), person in 0usize..3, style in 0usize..4) {
        thread_local! {
            static ALL: Vec<Cartoon> =
                FACES.iter().flat_map(|f| Style::BUILT_IN.map(|s| cartoon(f, s))).collect();
        }
        let sound = ALL.with(|all| is_sound(&all[person * 4 + style].draw(&pose)));
        prop_assert!(sound.is_ok(), "{:?}", sound);
    }

    /// Hands may put points anywhere, and hair may be any outline.
    #[test]
    fn any_places_of_the_points_give_a_sound_drawing(
        moves in prop::collection::vec((0usize..72, -900.0..900.0f64, -900.0..900.0f64), 0..30),
        outline in prop::collection::vec((-200.0..900.0f64, -200.0..900.0f64), 3..40),
        kind in 0usize..5, cut in any::<bool>(),
    ) {
        let mut face = face(FACES[kind % 3]);
        for (n, x, y) in moves {
            if let Some(placed) = face.placed_mut(FeaturePoint::all().nth(n).unwrap()) {
                placed.at = Point::new(x, y);
            }
        }
        face.hair.kind = [HairKind::Straight, HairKind::Wavy, HairKind::Curly, HairKind::Shaved, HairKind::Bald][kind];
        face.hair.vertices.clear();
        let outline: Vec<Point> = outline.into_iter().map(Point::from).collect();
        face.hair.back.push(outline.clone());
        face.hair.front.push(outline);
        let curve = if cut { "corner-cutting" } else { "tufts" };
        let style = Style::parse(&format!("format = 1\nhair_curve = \"{curve}\"\n")).unwrap();
        let sound = is_sound(&Cartoon::new(&face, &style).draw(&Pose::default()));
        prop_assert!(sound.is_ok(), "{:?}", sound);
    }
}

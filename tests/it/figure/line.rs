//! The line figures against the paper's tables, and the joints of their lines in pixels.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use crate::support::test_data;
use lianpu::drawing::{Colour, Drawing, Item, Layer};
use lianpu::figure::LineFigure;
use lianpu::geometry::{Point, Rect, Ribbon};
use lianpu::pose::{Emotion, MouthPose, MouthPreset, MouthShape, Pose, Ratios};
use lianpu::render::Painter;

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn blending_at_the_seven_corners_gives_table_1_back_exactly() {
    let Some(table) = test_data::find("line-figure/table1.csv") else { return };
    let table = std::fs::read_to_string(table).unwrap();
    let figure = LineFigure::built_in("line").unwrap();
    let mut cells = 0;
    for (point, row) in table.lines().skip(1).enumerate() {
        let numbers: Vec<f64> = row.split(',').skip(1).map(|c| c.parse().unwrap()).collect();
        for (emotion, cell) in Emotion::ALL.into_iter().zip(numbers.chunks(3)) {
            let knot = figure.blend(&Ratios::pure(emotion))[point];
            assert_eq!([knot.x, knot.y, knot.w], cell, "point {point}, {emotion}");
            cells += 3;
        }
    }
    assert_eq!(cells, 1176);
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn the_lines_are_those_of_table_2() {
    let Some(table) = test_data::find("line-figure/table2.csv") else { return };
    let table = std::fs::read_to_string(table).unwrap();
    let figure = LineFigure::built_in("line").unwrap();
    let names: Vec<&str> = table.lines().skip(1).filter_map(|l| l.split(',').next()).collect();
    assert_eq!(figure.line_names().collect::<Vec<_>>(), names);
}

/// Every pose that a test of joints should hold in: the seven, mixtures with negative ratios, all mouths on them.
fn poses() -> Vec<Pose> {
    let mut ratios: Vec<Ratios> = Emotion::ALL.map(Ratios::pure).to_vec();
    ratios.push(Ratios([0.66, -0.17, 0.08, -0.18, 0.44, 0.17, 0.0]));
    ratios.push(Ratios([-0.25, 0.44, 0.85, -0.03, -0.14, -0.10, 0.23]));
    let mut poses = Vec::new();
    for ratios in ratios {
        poses.push(Pose::of(ratios));
        for shape in MouthShape::ALL {
            poses.push(Pose { mouth: MouthPose::of(shape, MouthPreset::Distinct), ..Pose::of(ratios) });
        }
    }
    poses
}

#[test]
fn the_six_corners_of_lids_and_mouth_meet_exactly_in_every_pose() {
    let figure = LineFigure::built_in("line").unwrap();
    for pose in poses() {
        let knots = figure.points(&pose);
        // Outer and inner corner of both eyes, both corners of the mouth (Table 2).
        for (a, b) in [(8, 19), (11, 16), (12, 23), (15, 20), (35, 40), (39, 44)] {
            assert_eq!(knots[a].point(), knots[b].point(), "{a} and {b} in {:?}", pose.ratios);
        }
    }
}

/// The strokes of a lip of a drawing.
fn strokes(drawing: &Drawing, name: &str) -> Vec<Ribbon> {
    let items = drawing.layers.iter().flat_map(|l| &l.items);
    let lips = items.filter_map(|item| match item {
        Item::Group(group) if group.name == name => Some(&group.items),
        _ => None,
    });
    lips.flatten()
        .filter_map(|item| match item {
            Item::Ink(ink) => Some(ink.strokes.clone()),
            _ => None,
        })
        .flatten()
        .collect()
}

#[test]
fn the_ends_of_the_links_lie_under_the_ink_of_other_strokes() {
    let figure = LineFigure::built_in("line").unwrap();
    let mut painter = Painter::new(1280, 720).unwrap();
    let mut ends = 0;
    for pose in poses() {
        let drawing = figure.draw(&pose);
        for lip in ["upper-lip", "lower-lip"] {
            let chain = strokes(&drawing, lip);
            assert_eq!(chain.len(), 4, "two halves and two links");
            for link in [1, 2] {
                // All strokes of the lip but this link, black on white, at the size of an exported frame.
                let mut others = chain.clone();
                let link = others.remove(link);
                let alone = Drawing {
                    layers: vec![Layer { name: "lip".into(), items: vec![Item::ink("", others, Colour::BLACK)] }],
                    ..drawing.clone()
                };
                let picture = painter.paint(&alone);
                let scale = (1280.0 / drawing.view.width()).min(720.0 / drawing.view.height());
                let middle = drawing.view.center();
                for end in [link.0[0], link.0[3]] {
                    let x = 640.0 + (end.x - middle.x) * scale;
                    let y = 360.0 + (end.y - middle.y) * scale;
                    let [r, ..] = picture[(x as usize, y as usize)];
                    assert!(r < 255, "white under a link's end of the {lip} in {:?} {:?}", pose.ratios, pose.mouth);
                    ends += 1;
                }
            }
        }
    }
    assert_eq!(ends, poses().len() * 8);
}

/// Height of the gap between the lips on the middle line, in pixels of the figure.
fn gap(figure: &LineFigure, pose: &Pose) -> f64 {
    let drawing = figure.draw(pose);
    let height = |name: &str| {
        let chain = strokes(&drawing, name);
        let ends: Vec<Point> = chain.iter().flat_map(|r| [r.0[0].point(), r.0[3].point()]).collect();
        let x = ends.iter().map(|p| p.x).fold(0.0, |a, x| a + x) / ends.len() as f64;
        ends.iter().min_by(|a, b| (a.x - x).abs().total_cmp(&(b.x - x).abs())).unwrap().y
    };
    height("lower-lip") - height("upper-lip")
}

#[test]
fn lips_that_must_meet_do_on_every_emotion_and_open_vowels_open() {
    for name in LineFigure::BUILT_IN {
        let figure = LineFigure::built_in(name).unwrap();
        for emotion in Emotion::ALL {
            let spoken =
                |shape| Pose { mouth: MouthPose::of(shape, MouthPreset::Distinct), ..Pose::of(Ratios::pure(emotion)) };
            assert!(gap(&figure, &spoken(MouthShape::M)).abs() < 2.0, "{name} {emotion} m");
            let (i, a) = (gap(&figure, &spoken(MouthShape::I)), gap(&figure, &spoken(MouthShape::A)));
            assert!(a > i + 10.0, "{name} {emotion}: a {a}, i {i}");
        }
    }
}

#[test]
fn the_nine_mouths_of_a_figure_differ_pairwise_in_pixels() {
    for name in LineFigure::BUILT_IN {
        let figure = LineFigure::built_in(name).unwrap();
        for emotion in [Emotion::Neutral, Emotion::Happy] {
            let mut painter = Painter::new(320, 180).unwrap();
            let pictures = MouthShape::ALL.map(|shape| {
                let mouth = MouthPose::of(shape, MouthPreset::Distinct);
                let picture = painter.paint(&figure.draw(&Pose { mouth, ..Pose::of(Ratios::pure(emotion)) }));
                picture.pixels().as_flattened().to_vec()
            });
            for (i, a) in pictures.iter().enumerate() {
                for (j, b) in pictures.iter().enumerate().skip(i + 1) {
                    let differ = a.iter().zip(b).filter(|(x, y)| x.abs_diff(**y) > 64).count();
                    assert!(differ > 20, "{name} {emotion}: {} and {}", MouthShape::ALL[i], MouthShape::ALL[j]);
                }
            }
        }
    }
}

#[test]
fn closed_lids_hide_the_iris_and_a_look_aside_moves_it() {
    let figure = LineFigure::built_in("line").unwrap();
    let has_iris = |pose: &Pose| format!("{:?}", figure.draw(pose)).contains("-iris\"");
    let mut pose = Pose::default();
    assert!(has_iris(&pose));
    pose.lids.left = 0.0;
    pose.lids.right = 0.0;
    assert!(!has_iris(&pose));
}

#[test]
fn an_svg_has_every_line_of_table_2_by_its_name() {
    let figure = LineFigure::built_in("line").unwrap();
    for pose in poses() {
        let svg = lianpu::render::to_svg(&figure.draw(&pose), 640, 360);
        for name in figure.line_names() {
            assert!(svg.contains(&format!("<path id=\"{name}\" d=\"M")), "{name}");
        }
    }
}

#[test]
fn every_id_of_an_svg_is_its_own() {
    for name in LineFigure::BUILT_IN {
        let figure = LineFigure::built_in(name).unwrap();
        for pose in poses() {
            let svg = lianpu::render::to_svg(&figure.draw(&pose), 640, 360);
            let mut ids: Vec<&str> = svg.split(" id=\"").skip(1).filter_map(|s| s.split('"').next()).collect();
            let count = ids.len();
            ids.sort_unstable();
            ids.dedup();
            assert_eq!(ids.len(), count, "{name}");
        }
    }
}

#[test]
fn a_damaged_figure_says_what_and_where() {
    let good = include_str!("../../../src/figure/line/line.toml");
    for (from, to, word) in [
        ("points = [0, 1, 2, 3]", "points = [0, 1, 2, 99]", "0 to 55"),
        ("upper = \"leyeulid\"", "upper = \"leyeulit\"", "did you mean `leyeulid`"),
        ("pen = 2.0", "pen = 0.0", "above 0"),
        ("format = 1", "format = 9", "format 1"),
        ("pivot =", "pivott =", "did you mean `pivot`"),
        ("pivot = [249, 520]", "pivot = [nan, 520]", "numbers up to"),
        ("upper = [\"lmu\", \"lmulink\", \"rmulink\", \"rmu\"]", "upper = []", "both `upper` and `lower`"),
        ("name = \"rbow\"", "name = \"r bow\"", "letters, digits"),
    ] {
        let fault = LineFigure::parse(&good.replacen(from, to, 1)).unwrap_err();
        assert!(fault.next_step().contains(word), "{fault}");
    }
    let view: Rect = LineFigure::built_in("line").unwrap().view();
    assert!(view.width() > 0.0);
}

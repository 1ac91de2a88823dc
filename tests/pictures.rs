//! Golden pictures. `LIANPU_GOLDEN=write cargo test --test pictures` makes them again; on failure the difference is
//! written as three panels (expected, found, where) and its path is printed.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use std::path::PathBuf;

use lianpu::drawing::{Anchor, Colour, Drawing, Item, Layer};
use lianpu::figure::LineFigure;
use lianpu::geometry::{Point, Rect};
use lianpu::pose::{Emotion, MouthPose, MouthPreset, MouthShape, Pose, Ratios};
use lianpu::render::{Painter, Picture, encode_png, to_svg};

/// A channel may differ by so much: rounding of another mathematics library.
const CHANNEL: u8 = 24;

/// So many pixels of a sheet may differ by more.
const PIXELS: usize = 30;

fn golden(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/golden").join(format!("{name}.png"))
}

fn decode(bytes: &[u8]) -> Picture {
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
    let mut rgba = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut rgba).unwrap();
    Picture { width: info.width, height: info.height, rgba }
}

fn differing(a: &Picture, b: &Picture) -> usize {
    let pairs = a.rgba.chunks_exact(4).zip(b.rgba.chunks_exact(4));
    pairs.filter(|(x, y)| x.iter().zip(*y).any(|(p, q)| p.abs_diff(*q) > CHANNEL)).count()
}

fn three_panels(expected: &Picture, found: &Picture) -> Picture {
    let (w, h) = (found.width, found.height);
    let mut rgba = Vec::new();
    for y in 0..h {
        for panel in 0..3 {
            for x in 0..w {
                let (a, b) = (expected.pixel(x, y).unwrap_or([0; 4]), found.pixel(x, y).unwrap_or([0; 4]));
                let apart = a.iter().zip(b).any(|(p, q)| p.abs_diff(q) > CHANNEL);
                rgba.extend(match panel {
                    0 => a,
                    1 => b,
                    _ if apart => [255, 0, 0, 255],
                    _ => [255, 255, 255, 255],
                });
            }
        }
    }
    Picture { width: 3 * w, height: h, rgba }
}

fn hold(name: &str, drawing: &Drawing) {
    let (width, height) = (drawing.view.width() as u32, drawing.view.height() as u32);
    let found = Painter::new(width, height).unwrap().paint(drawing);
    let path = golden(name);
    if std::env::var_os("LIANPU_GOLDEN").is_some_and(|v| v == "write") {
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, encode_png(&found, "").unwrap()).unwrap();
        return;
    }
    let expected = decode(&std::fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display())));
    assert_eq!((expected.width, expected.height), (width, height), "{name}");
    let apart = differing(&expected, &found);
    if apart > PIXELS {
        let panels = std::env::temp_dir().join(format!("lianpu-{name}-difference.png"));
        std::fs::write(&panels, encode_png(&three_panels(&expected, &found), "").unwrap()).unwrap();
        panic!("{name}: {apart} pixels differ, see {}", panels.display());
    }
}

fn sheet(figure: &LineFigure, poses: &[(String, Pose)], columns: usize) -> Drawing {
    const CELL: (f64, f64) = (112.0, 128.0);
    let mut items = Vec::new();
    for (i, (label, pose)) in poses.iter().enumerate() {
        let (x, y) = ((i % columns) as f64 * CELL.0, (i / columns) as f64 * CELL.1);
        items.push(figure.draw(pose).placed_in(Rect::new(x + 4.0, y + 16.0, x + CELL.0 - 4.0, y + CELL.1 - 4.0)));
        items.push(Item::text(Point::new(x + 6.0, y + 12.0), 11.0, Anchor::Start, Colour::BLACK, label));
    }
    let rows = poses.len().div_ceil(columns);
    Drawing {
        view: Rect::new(0.0, 0.0, columns as f64 * CELL.0, rows as f64 * CELL.1),
        title: "sheet".into(),
        description: String::new(),
        background: Some(Colour::WHITE),
        layers: vec![Layer { name: "sheet".into(), items }],
    }
}

fn emotions_and_mouths() -> Vec<(String, Pose)> {
    let mut poses: Vec<(String, Pose)> =
        Emotion::ALL.into_iter().map(|e| (e.to_string(), Pose::of(Ratios::pure(e)))).collect();
    for emotion in [Emotion::Neutral, Emotion::Happy] {
        for shape in MouthShape::ALL {
            let mouth = MouthPose::of(shape, MouthPreset::Distinct);
            poses.push((format!("{emotion} {shape}"), Pose { mouth, ..Pose::of(Ratios::pure(emotion)) }));
        }
    }
    poses
}

#[test]
fn the_line_face_looks_as_it_did() {
    hold("line", &sheet(&LineFigure::built_in("line").unwrap(), &emotions_and_mouths(), 9));
}

#[test]
fn the_cat_looks_as_it_did() {
    hold("cat", &sheet(&LineFigure::built_in("cat").unwrap(), &emotions_and_mouths(), 9));
}

#[test]
fn the_figures_hide_what_is_behind_them() {
    for name in LineFigure::BUILT_IN {
        let figure = LineFigure::built_in(name).unwrap();
        let poses: Vec<(String, Pose)> =
            Emotion::ALL.into_iter().map(|e| (e.to_string(), Pose::of(Ratios::pure(e)))).collect();
        let mut drawing = sheet(&figure, &poses, 7);
        drawing.background = Some(Colour::rgb(0x7F, 0xC4, 0xE8));
        hold(&format!("{name}-on-blue"), &drawing);
    }
}

#[test]
fn our_pixels_are_those_that_resvg_makes_of_our_svg() {
    for name in LineFigure::BUILT_IN {
        let figure = LineFigure::built_in(name).unwrap();
        for (label, pose) in emotions_and_mouths() {
            let drawing = figure.draw(&pose);
            let ours = Painter::new(640, 360).unwrap().paint(&drawing);
            let tree = usvg::Tree::from_str(&to_svg(&drawing, 640, 360), &usvg::Options::default());
            let mut canvas = tiny_skia::Pixmap::new(640, 360).unwrap();
            resvg::render(&tree.unwrap(), tiny_skia::Transform::identity(), &mut canvas.as_mut());
            let theirs = Picture { width: 640, height: 360, rgba: canvas.data().to_vec() };
            // SVG carries hundredths of a unit and antialiases clips its own way: edges may differ, areas may not.
            let strong = ours.rgba.iter().zip(&theirs.rgba).filter(|(a, b)| a.abs_diff(**b) > 96).count();
            assert!(strong < 60, "{name} {label}: {strong} channels apart");
        }
    }
}

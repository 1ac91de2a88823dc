//! Golden pictures. `LIANPU_GOLDEN=write cargo test --test it pictures` makes them again; on failure the difference is
//! written as three panels (expected, found, where) and its path is printed.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use crate::support::golden_picture::{hold, same_as_resvg};
use lianpu::drawing::{Anchor, Colour, Drawing, Item, Layer};
use lianpu::figure::LineFigure;
use lianpu::geometry::{Point, Rect};
use lianpu::pose::{Emotion, MouthPose, MouthPreset, MouthShape, Pose, Ratios};

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
            same_as_resvg(&format!("{name} {label}"), &drawing, 60);
        }
    }
}

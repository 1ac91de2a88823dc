//! How widths run between control points: the curve's reading and the paper's, in figures and in what is exported.

#![allow(clippy::unwrap_used, reason = "a test may stop")]

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

use crate::support::inked::lines;
use lianpu::figure::{Figure, LineFigure, Widths};
use lianpu::pose::{Emotion, Pose, Ratios};

#[test]
fn in_the_paper_s_reading_a_width_is_between_those_of_the_adjacent_points() {
    for name in LineFigure::BUILT_IN {
        let figure = LineFigure::built_in(name).unwrap();
        let paper = figure.clone().with_widths(Widths::Paper);
        for emotion in Emotion::ALL {
            let pose = Pose::of(Ratios::pure(emotion));
            let (bezier, paper) = (lines(&figure, &pose), lines(&paper, &pose));
            assert!(bezier.len() > 20 && bezier.len() == paper.len());
            for ((line, strokes), (same, parts)) in bezier.iter().zip(&paper) {
                assert_eq!((line, 3 * strokes.len()), (same, parts.len()));
                for (stroke, parts) in strokes.iter().zip(parts.chunks(3)) {
                    for i in 0..=30 {
                        let t = f64::from(i) / 30.0;
                        // Point j stands at j thirds; between two of them the width goes straight.
                        let j = (3.0 * t).min(2.0) as usize;
                        let u = 3.0 * t - j as f64;
                        let width = (1.0 - u) * stroke.0[j].w + u * stroke.0[j + 1].w;
                        let drawn = parts[j].eval(u);
                        assert!((drawn.w - width).abs() < 1e-9, "{name} {emotion} {line}: {} for {width}", drawn.w);
                        assert!((drawn.point() - stroke.eval(t).point()).hypot() < 1e-9, "{name} {emotion} {line}");
                    }
                }
            }
        }
    }
}

#[test]
fn a_figure_file_says_how_its_widths_run() {
    let text = include_str!("../../../src/figure/line/line.toml");
    let parse = |widths: &str| LineFigure::parse(&text.replacen("pen = 2.0", widths, 1));
    let drawn = |figure: LineFigure| figure.draw(&Pose::of(Ratios::pure(Emotion::Happy))).fingerprint();
    let of = |widths| drawn(LineFigure::built_in("line").unwrap().with_widths(widths));
    assert_eq!(drawn(parse("pen = 2.0\nwidths = \"paper\"").unwrap()), of(Widths::Paper));
    assert_eq!(drawn(parse("pen = 2.0\nwidths = \"bezier\"").unwrap()), of(Widths::Bezier));
    assert_eq!(drawn(parse("pen = 2.0").unwrap()), of(Widths::Bezier));
    assert_ne!(of(Widths::Paper), of(Widths::Bezier));
    assert!(parse("pen = 2.0\nwidths = \"pepper\"").unwrap_err().to_string().contains("pepper"));
}

/// What an export of a sample lesson writes, by file name; the manifest apart.
fn exported(project: &str, to: &str, more: &[&str]) -> (BTreeMap<String, Vec<u8>>, String) {
    let out = tempfile::tempdir().unwrap();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let run = Command::new(env!("CARGO_BIN_EXE_lianpu"))
        .args(["export", "--to", to, "--size", "320x180", "--frames", "0-2", "--jobs", "1", "--out"])
        .arg(out.path())
        .args(more)
        .arg(root.join("projects").join(project))
        .output()
        .unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let mut files = BTreeMap::new();
    let mut folders = vec![out.path().to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let name = path.strip_prefix(out.path()).unwrap().display().to_string();
                files.insert(name, std::fs::read(path).unwrap());
            }
        }
    }
    let manifest = files.remove("manifest.json").map(|m| String::from_utf8(m).unwrap()).unwrap_or_default();
    (files, manifest)
}

#[test]
fn every_form_that_shows_a_line_figure_follows_the_option() {
    let forms = "svg,png,apng,smil,html,lottie,layers,mouths";
    let (usual, _) = exported("seven-emotions", forms, &[]);
    let (paper, manifest) = exported("seven-emotions", forms, &["--width", "paper"]);
    assert!(usual.len() > 20 && usual.keys().eq(paper.keys()), "{:?}", usual.keys());
    for (name, bytes) in &usual {
        assert_ne!(bytes, &paper[name], "{name}");
    }
    assert!(manifest.contains("\"width\":\"paper\""), "{manifest}");
    assert_eq!(
        exported("seven-emotions", "svg,png", &["--width", "bezier"]).0,
        exported("seven-emotions", "svg,png", &[]).0
    );
}

#[test]
fn a_cartoon_has_no_such_strokes() {
    assert_eq!(exported("nihao", "svg,png", &["--width", "paper"]).0, exported("nihao", "svg,png", &[]).0);
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let lesson = lianpu::project::Lesson::read(&root.join("projects/nihao")).unwrap();
    let figure = lesson.figure_of(&lesson.clips[0].entry).unwrap();
    assert!(matches!(figure, Figure::Cartoon(_)));
    let pose = Pose::of(Ratios::pure(Emotion::Neutral));
    assert_eq!(figure.draw(&pose), figure.clone().with_widths(Widths::Paper).draw(&pose));
}

#[test]
fn another_word_is_refused() {
    let run = Command::new(env!("CARGO_BIN_EXE_lianpu"))
        .args(["export", "--to", "svg", "--width", "wide", "projects/nihao"])
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&run.stderr).into_owned();
    assert!(!run.status.success() && said.contains("write bezier or paper"), "{said}");
}

//! The cartoon: what holds for any face, style and pose, and how it looks.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use std::path::Path;

use lianpu::face::Face;
use lianpu::figure::cartoon::{Cartoon, Style};
use lianpu::pose::{Emotion, Pose, Ratios};
use lianpu::render::{Painter, encode_png, to_svg};

/// `LIANPU_FACES=folder LIANPU_OUT=folder cargo test --test cartoon -- --ignored drawn` draws every face.toml of a
/// folder in every style, to look at. `LIANPU_ONLY=003,129` takes some, `LIANPU_POSES=1` the emotions too, and
/// `LIANPU_SVG=folder` makes pictures of SVG files beside them.
#[test]
#[ignore = "for looking at"]
fn faces_of_a_folder_are_drawn() {
    let var = |name: &str| std::env::var(name).unwrap_or_default();
    let (folder, out) = (var("LIANPU_FACES"), var("LIANPU_OUT"));
    let only = var("LIANPU_ONLY");
    let wanted = |name: &str| only.is_empty() || only.split(',').any(|o| name.starts_with(o));
    let (width, height) = (410, 550);
    let files = |folder: &str, ending: &str| {
        let mut found: Vec<_> = std::fs::read_dir(folder).unwrap().flatten().map(|e| e.path()).collect();
        found.retain(|p| p.extension().is_some_and(|e| e == ending));
        found.sort();
        found
    };
    let stem = |path: &Path| path.file_stem().unwrap().to_string_lossy().into_owned();
    if !var("LIANPU_SVG").is_empty() {
        for path in files(&var("LIANPU_SVG"), "svg").into_iter().filter(|p| wanted(&stem(p))) {
            let tree = usvg::Tree::from_data(&std::fs::read(&path).unwrap(), &usvg::Options::default()).unwrap();
            let mut canvas = tiny_skia::Pixmap::new(width, height).unwrap();
            let scale = width as f32 / tree.size().width();
            resvg::render(&tree, tiny_skia::Transform::from_scale(scale, scale), &mut canvas.as_mut());
            canvas.save_png(path.with_extension("png")).unwrap();
        }
        return;
    }
    for path in files(&folder, "toml").into_iter().filter(|p| wanted(&stem(p))) {
        let face = Face::parse(&std::fs::read_to_string(&path).unwrap()).unwrap();
        for name in Style::BUILT_IN {
            if !var("LIANPU_STYLE").is_empty() && var("LIANPU_STYLE") != name {
                continue;
            }
            let started = std::time::Instant::now();
            let cartoon = Cartoon::new(&face, &Style::built_in(name).unwrap());
            let made = started.elapsed();
            let mut poses = vec![(name.to_owned(), Pose::default())];
            if !var("LIANPU_POSES").is_empty() {
                poses.extend(Emotion::ALL.iter().map(|e| (format!("{name}_e_{e}"), Pose::of(Ratios::pure(*e)))));
            }
            for (label, pose) in poses {
                let drawing = cartoon.draw(&pose);
                let picture = Painter::new(width, height).unwrap().paint(&drawing);
                let file = format!("{out}/{}_{label}.png", stem(&path));
                std::fs::write(&file, encode_png(&picture, "").unwrap()).unwrap();
                std::fs::write(file.replace(".png", ".svg"), to_svg(&drawing, width, height)).unwrap();
            }
            println!("{} {name} made in {made:?}", stem(&path));
        }
    }
}

/// How long a drawing and a picture take: `LIANPU_FACES=folder cargo test --release --test cartoon -- --ignored --nocapture long`.
#[test]
#[ignore = "for measuring"]
fn how_long_a_drawing_takes() {
    let folder = std::env::var("LIANPU_FACES").unwrap_or_default();
    for name in ["003", "037", "069", "129"] {
        let face = Face::parse(&std::fs::read_to_string(format!("{folder}/{name}.toml")).unwrap()).unwrap();
        let cartoon = Cartoon::new(&face, &Style::built_in("normal").unwrap());
        let rest = Pose::default();
        let happy = Pose::of(Ratios::pure(Emotion::Happy));
        let open = Pose {
            mouth: lianpu::pose::MouthPose::of(lianpu::pose::MouthShape::A, lianpu::pose::MouthPreset::Distinct),
            ..happy
        };
        let turned = Pose { head: lianpu::pose::Head { x: 0.02, y: 0.03, roll: 3.0 }, ..open };
        for (label, pose) in [("rest", rest), ("happy a", open), ("turned", turned)] {
            let mut painter = Painter::new(1280, 720).unwrap();
            let mut first = cartoon.draw(&pose);
            let _ = painter.paint(&first);
            // The least of many: other work on the machine only adds.
            let time = |n: u32, f: &mut dyn FnMut()| {
                let one = |_| {
                    let started = std::time::Instant::now();
                    f();
                    started.elapsed()
                };
                (0..n).map(one).min().unwrap()
            };
            let draw = time(500, &mut || first = cartoon.draw(&pose));
            let print = time(200, &mut || {
                std::hint::black_box(first.fingerprint());
            });
            let paint = time(40, &mut || {
                std::hint::black_box(painter.paint(&first));
            });
            println!("{name} {label}: draw {draw:?}, fingerprint {print:?}, paint {paint:?}");
        }
    }
}

#[test]
#[ignore = "for measuring"]
fn what_takes_long() {
    use lianpu::drawing::{Item, Layer};
    let folder = std::env::var("LIANPU_FACES").unwrap_or_default();
    let face = Face::parse(&std::fs::read_to_string(format!("{folder}/003.toml")).unwrap()).unwrap();
    let cartoon = Cartoon::new(&face, &Style::built_in("normal").unwrap());
    let drawing = cartoon.draw(&Pose::default());
    fn flat(item: &Item, out: &mut Vec<Item>) {
        match item {
            Item::Shared(s) => s.items().iter().for_each(|i| flat(i, out)),
            i => out.push(i.clone()),
        }
    }
    let mut all = Vec::new();
    drawing.layers[1].items.iter().for_each(|i| flat(i, &mut all));
    let time = |items: Vec<Item>| {
        let mut d = drawing.clone();
        d.layers = vec![Layer { name: "dynamic".into(), items }];
        let mut painter = Painter::new(1280, 720).unwrap();
        let _ = painter.paint(&d);
        let one = |_| {
            let started = std::time::Instant::now();
            std::hint::black_box(painter.paint(&d));
            started.elapsed()
        };
        (0..20).map(one).min().unwrap()
    };
    println!("nothing {:?}", time(vec![]));
    for item in all.clone() {
        if let Item::Group(g) = &item {
            for inner in &g.items {
                let mut g = g.clone();
                g.items = vec![inner.clone()];
                println!("  inner {:?}", time(vec![Item::Group(g)]));
            }
            let mut g = g.clone();
            g.items = vec![];
            println!("  empty {} {:?}", g.clip.as_ref().map_or(0, |c| c.elements().len()), time(vec![Item::Group(g)]));
        }
    }
    for item in all {
        let name = match &item {
            Item::Area(a) => a.name.clone(),
            Item::Group(g) => format!("group {} {}", g.name, g.items.len()),
            _ => "other".into(),
        };
        println!("{name} {:?}", time(vec![item]));
    }
}

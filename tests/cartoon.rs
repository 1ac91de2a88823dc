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

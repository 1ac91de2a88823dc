//! Golden pictures: kept ones to compare with, and resvg's to agree with.

use std::path::PathBuf;

use lianpu::drawing::{Colour, Drawing, Layer, Picture};
use lianpu::geometry::Rect;
use lianpu::render::{Painter, encode_png, to_svg};

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
    Picture::new(info.width as usize, info.height as usize, rgba.as_chunks::<4>().0.to_vec())
}

fn differing(a: &Picture, b: &Picture) -> usize {
    let pairs = a.pixels().iter().zip(b.pixels());
    pairs.filter(|(x, y)| x.iter().zip(*y).any(|(p, q)| p.abs_diff(*q) > CHANNEL)).count()
}

fn three_panels(expected: &Picture, found: &Picture) -> Picture {
    let (w, h) = (found.width(), found.height());
    let mut pixels = Vec::new();
    for y in 0..h {
        for panel in 0..3 {
            for x in 0..w {
                let (a, b) = (expected.get(x, y).copied().unwrap_or([0; 4]), found[(x, y)]);
                let apart = a.iter().zip(b).any(|(p, q)| p.abs_diff(q) > CHANNEL);
                pixels.push(match panel {
                    0 => a,
                    1 => b,
                    _ if apart => [255, 0, 0, 255],
                    _ => [255, 255, 255, 255],
                });
            }
        }
    }
    Picture::new(3 * w, h, pixels)
}

/// Holds a drawing against the picture kept under a name.
pub fn hold(name: &str, drawing: &Drawing) {
    let (width, height) = (drawing.view.width() as u32, drawing.view.height() as u32);
    let found = Painter::new(width, height).unwrap().paint(drawing);
    let path = golden(name);
    if std::env::var_os("LIANPU_GOLDEN").is_some_and(|v| v == "write") {
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, encode_png(&found, "").unwrap()).unwrap();
        return;
    }
    let expected = decode(&std::fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display())));
    assert_eq!((expected.width(), expected.height()), (width as usize, height as usize), "{name}");
    let apart = differing(&expected, &found);
    if apart > PIXELS {
        let panels = std::env::temp_dir().join(format!("lianpu-{name}-difference.png"));
        std::fs::write(&panels, encode_png(&three_panels(&expected, &found), "").unwrap()).unwrap();
        panic!("{name}: {apart} pixels differ, see {}", panels.display());
    }
}

/// Drawings side by side.
pub fn cells(drawings: &[Drawing], columns: usize, (wide, high): (f64, f64)) -> Drawing {
    let place = |i: usize| ((i % columns) as f64 * wide, (i / columns) as f64 * high);
    let items = drawings.iter().enumerate().map(|(i, drawing)| {
        let (x, y) = place(i);
        drawing.placed_in(Rect::new(x, y, x + wide, y + high))
    });
    let items = items.collect();
    let rows = drawings.len().div_ceil(columns) as f64;
    Drawing {
        view: Rect::new(0.0, 0.0, columns as f64 * wide, rows * high),
        title: "sheet".into(),
        description: String::new(),
        background: Some(Colour::WHITE),
        layers: vec![Layer { name: "sheet".into(), items }],
    }
}

/// Holds our pixels of a drawing against those that resvg makes of our SVG. SVG carries hundredths of a unit and resvg
/// antialiases clips its own way: edges may differ, areas may not. `strong` channels may be far apart.
pub fn same_as_resvg(what: &str, drawing: &Drawing, strong: usize) {
    let ours = Painter::new(640, 360).unwrap().paint(drawing);
    let tree = usvg::Tree::from_str(&to_svg(drawing, 640, 360), &usvg::Options::default());
    let mut canvas = tiny_skia::Pixmap::new(640, 360).unwrap();
    resvg::render(&tree.unwrap(), tiny_skia::Transform::identity(), &mut canvas.as_mut());
    let apart = ours.pixels().as_flattened().iter().zip(canvas.data()).filter(|(a, b)| a.abs_diff(**b) > 96).count();
    assert!(apart < strong, "{what}: {apart} channels apart");
}

//! Strokes of varying width held against what they are: the union of the discs along them.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use lianpu::drawing::{Colour, Drawing, Item, Layer};
use lianpu::figure::LineFigure;
use lianpu::geometry::{BezPath, Knot, Rect, Ribbon, outline, outline_in_pieces};
use lianpu::pose::{Emotion, Pose, Ratios};
use lianpu::render::Painter;

/// Strokes lie in a box of so many units, and are painted with so many pixels a unit.
const SIDE: f64 = 150.0;
const SCALE: f64 = 4.0;
const PIXELS: usize = 600;

/// The truth is looked at so much more closely, for how near a rim is says how much of a pixel is covered only roughly.
const FINER: usize = 3;
const FINE: usize = FINER * PIXELS;

/// How much of each pixel the discs cover: 0 to 1.
fn discs(chain: &[Ribbon]) -> Vec<f32> {
    const SCALE: f64 = self::SCALE * FINER as f64;
    // The distance to the nearest rim, negative inside; more than a pixel away it does not matter.
    let mut depth = vec![1.0_f32; FINE * FINE];
    for ribbon in chain {
        let ends: f64 = ribbon.0.windows(2).map(|k| (k[1].point() - k[0].point()).hypot()).sum();
        let steps = (ends * SCALE).ceil().max(300.0) as usize;
        for i in 0..=steps {
            let knot = ribbon.eval(i as f64 / steps as f64);
            if knot.w > 0.0 {
                disc(&mut depth, [knot.x * SCALE, knot.y * SCALE], knot.w / 2.0 * SCALE);
            }
        }
    }
    let mut mean = vec![0.0; PIXELS * PIXELS];
    for (i, d) in depth.iter().enumerate() {
        mean[i / FINE / FINER * PIXELS + i % FINE / FINER] += (0.5 - d).clamp(0.0, 1.0) / (FINER * FINER) as f32;
    }
    mean
}

fn disc(depth: &mut [f32], [x, y]: [f64; 2], radius: f64) {
    let within = |v: f64| v.clamp(0.0, FINE as f64) as usize;
    for row in within(y - radius - 1.0)..within(y + radius + 2.0).min(FINE) {
        let up = row as f64 + 0.5 - y;
        let half = |r: f64| (r * r - up * up).max(0.0).sqrt();
        let (outer, inner) = (half(radius + 1.0), if radius > 1.0 { half(radius - 1.0) } else { 0.0 });
        let line = &mut depth[row * FINE..(row + 1) * FINE];
        let (from, to) = (within(x - outer - 0.5), within(x + outer + 0.5));
        let (full_from, full_to) = (within((x - inner + 0.5).ceil()), within((x + inner - 0.5).floor()));
        let mut rim = |range: std::ops::Range<usize>| {
            for (column, d) in line.iter_mut().enumerate().take(range.end).skip(range.start) {
                let across = column as f64 + 0.5 - x;
                *d = d.min(((across * across + up * up).sqrt() - radius) as f32);
            }
        };
        if full_from < full_to {
            rim(from..full_from);
            rim(full_to..to);
            line[full_from..full_to].fill(-1.0);
        } else {
            rim(from..to);
        }
    }
}

fn painted(painter: &mut Painter, path: BezPath) -> Vec<f32> {
    let drawing = Drawing {
        view: Rect::new(0.0, 0.0, SIDE, SIDE),
        title: String::new(),
        description: String::new(),
        background: None,
        layers: vec![Layer { name: "strokes".into(), items: vec![Item::area("", path, Colour::BLACK)] }],
    };
    painter.paint(&drawing).rgba.chunks_exact(4).map(|p| f32::from(p[3]) / 255.0).collect()
}

/// What is inked wrongly, as a share of what should be inked.
fn error(painter: &mut Painter, chain: &[Ribbon], path: BezPath) -> f64 {
    let truth = discs(chain);
    let found = painted(painter, path);
    let off: f64 = truth.iter().zip(&found).map(|(a, b)| f64::from((a - b).abs())).sum();
    off / truth.iter().map(|v| f64::from(*v)).sum::<f64>()
}

/// Such as a face has, and such as are hard.
fn drawn() -> Vec<(&'static str, Ribbon)> {
    let stroke = |points: [(f64, f64); 4], widths: [f64; 4]| {
        Ribbon(std::array::from_fn(|i| Knot::new(points[i].0, points[i].1, widths[i])))
    };
    vec![
        ("brow", stroke([(20.0, 80.0), (45.0, 35.0), (95.0, 30.0), (130.0, 85.0)], [6.0, 11.0, 9.0, 1.5])),
        ("brow of the paper", stroke([(20.0, 60.0), (42.0, 40.0), (80.0, 35.0), (120.0, 55.0)], [1.0, 4.0, 4.0, 3.0])),
        (
            "corner of a mouth",
            stroke([(40.0, 60.0), (120.0, 60.0), (120.0, 90.0), (110.0, 62.0)], [2.0, 8.0, 6.0, 2.0]),
        ),
        ("cusp", stroke([(30.0, 100.0), (130.0, 40.0), (20.0, 40.0), (120.0, 100.0)], [3.0, 10.0, 10.0, 3.0])),
        ("loop", stroke([(30.0, 100.0), (160.0, 20.0), (-10.0, 20.0), (120.0, 100.0)], [2.0, 12.0, 12.0, 2.0])),
        (
            "wide pen in a tight bend",
            stroke([(60.0, 30.0), (60.0, 130.0), (80.0, 130.0), (80.0, 30.0)], [6.0, 30.0, 30.0, 6.0]),
        ),
        ("fast taper", stroke([(50.0, 75.0), (60.0, 75.0), (70.0, 75.0), (85.0, 75.0)], [50.0, 20.0, 4.0, 0.0])),
        (
            "to nothing and back",
            stroke([(20.0, 75.0), (60.0, 20.0), (90.0, 130.0), (130.0, 75.0)], [12.0, -4.0, -4.0, 12.0]),
        ),
        ("handle on its end", stroke([(30.0, 75.0), (30.0, 75.0), (120.0, 30.0), (120.0, 75.0)], [8.0; 4])),
        ("back and forth", stroke([(30.0, 75.0), (140.0, 75.0), (10.0, 75.0), (120.0, 75.0)], [8.0; 4])),
    ]
}

/// The same 400 every time (xorshift, Marsaglia 2003).
fn random() -> Vec<Ribbon> {
    let mut state = 88_172_645_463_325_252_u64;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut stroke = || {
        let places: [(f64, f64); 4] = std::array::from_fn(|_| (25.0 + 100.0 * next(), 25.0 + 100.0 * next()));
        Ribbon(places.map(|(x, y)| Knot::new(x, y, 20.0 * next())))
    };
    (0..400).map(|_| stroke()).collect()
}

#[test]
fn an_outline_is_the_union_of_its_discs() {
    let mut painter = Painter::new(PIXELS as u32, PIXELS as u32).unwrap();
    let mut errors = Vec::new();
    for (name, stroke) in drawn() {
        let off = error(&mut painter, &[stroke], outline(&[stroke], 0.02));
        println!("{name}: {:.2} %", 100.0 * off);
        errors.push((off, name.to_owned()));
    }
    for (i, stroke) in random().into_iter().enumerate() {
        errors.push((error(&mut painter, &[stroke], outline(&[stroke], 0.02)), format!("random {i}")));
    }
    let mean = errors.iter().map(|e| e.0).sum::<f64>() / errors.len() as f64;
    let worst = errors.iter().max_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
    println!("mean {:.3} %, worst {:.2} % ({})", 100.0 * mean, 100.0 * worst.0, worst.1);
    assert!(mean <= 0.004, "{mean}");
    assert!(worst.0 <= 0.01, "{worst:?}");
}

#[test]
fn the_lines_of_a_figure_keep_their_ink_with_always_as_many_elements() {
    let figure = LineFigure::built_in("line").unwrap();
    let mut painter = Painter::new(PIXELS as u32, PIXELS as u32).unwrap();
    let mut errors = Vec::new();
    for emotion in Emotion::ALL {
        let drawing = figure.draw(&Pose::of(Ratios::pure(emotion)));
        let fit = SIDE / drawing.view.width().max(drawing.view.height());
        let place = |k: Knot| Knot::new((k.x - drawing.view.x0) * fit, (k.y - drawing.view.y0) * fit, k.w * fit);
        for item in drawing.layers.iter().flat_map(|l| &l.items) {
            let Item::Ink(ink) = item else { continue };
            let chain: Vec<Ribbon> = ink.strokes.iter().map(|s| Ribbon(s.0.map(place))).collect();
            let truth: f32 = discs(&chain).iter().sum();
            if truth < 50.0 {
                continue;
            }
            let exact = error(&mut painter, &chain, outline(&chain, 0.02));
            let pieces = error(&mut painter, &chain, outline_in_pieces(&chain, 8));
            errors.push((exact, pieces, format!("{emotion} {}", ink.name)));
        }
    }
    assert!(errors.len() > 20);
    let mean = |pick: fn(&(f64, f64, String)) -> f64| errors.iter().map(pick).sum::<f64>() / errors.len() as f64;
    let worst = |pick: fn(&(f64, f64, String)) -> f64| errors.iter().map(pick).fold(0.0, f64::max);
    println!(
        "{} lines: outline mean {:.3} % worst {:.3} %; in pieces mean {:.3} % worst {:.3} %",
        errors.len(),
        100.0 * mean(|e| e.0),
        100.0 * worst(|e| e.0),
        100.0 * mean(|e| e.1),
        100.0 * worst(|e| e.1)
    );
    assert!(worst(|e| e.0) <= 0.03, "{errors:?}");
    assert!(mean(|e| e.1) <= 0.02, "{errors:?}");
}

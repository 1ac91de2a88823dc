//! Strokes of varying width held against what they are: the union of the discs along them.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use crate::support::discs::{Rows, reach};
use crate::support::inked;
use lianpu::drawing::{Colour, Drawing, Item, Layer};
use lianpu::figure::{LineFigure, Widths};
use lianpu::geometry::{BezPath, Knot, Rect, Ribbon, outline, outline_in_pieces};
use lianpu::pose::{Emotion, Pose, Ratios};
use lianpu::render::Painter;

/// Strokes lie in a box of so many units, and are painted with so many pixels a unit.
const SIDE: f64 = 150.0;
const SCALE: f64 = 4.0;
const PIXELS: usize = 600;

/// Rows in which a pixel is looked at.
const ROWS: usize = 16;

/// The error allowed on the mean and at most (issue: against a union of discs).
const MEAN: f64 = 0.004;
const WORST: f64 = 0.01;

/// Errors of many strokes.
#[derive(Default)]
struct Errors(Vec<(f64, String)>);

impl Errors {
    fn mean(&self) -> f64 {
        self.0.iter().map(|e| e.0).sum::<f64>() / self.0.len() as f64
    }

    fn worst(&self) -> &(f64, String) {
        self.0.iter().max_by(|a, b| a.0.total_cmp(&b.0)).unwrap()
    }

    fn tell(&self, what: &str) {
        let (worst, which) = self.worst();
        println!("{what}: {}, mean {:.3} %, worst {:.3} % ({which})", self.0.len(), 100.0 * self.mean(), 100.0 * worst);
    }
}

/// What an outline covers wrongly, as a share of what the discs cover; rows `high` units high.
fn error(chain: &[Ribbon], path: &BezPath, high: f64) -> f64 {
    let (top, count) = reach(chain, path, high);
    let truth = Rows::of_discs(chain, top, high, count);
    let (all, off) = truth.against(&Rows::of_path(path, top, high, count));
    off / all
}

fn painted(painter: &mut Painter, chain: &[Ribbon]) -> Vec<f32> {
    let drawing = Drawing {
        view: Rect::new(0.0, 0.0, SIDE, SIDE),
        title: String::new(),
        description: String::new(),
        background: None,
        layers: vec![Layer { name: "strokes".into(), items: vec![Item::ink("", chain.to_vec(), Colour::BLACK)] }],
    };
    painter.paint(&drawing).pixels().iter().map(|p| f32::from(p[3]) / 255.0).collect()
}

/// What is painted wrongly, as a share of what should be painted.
fn painted_error(painter: &mut Painter, chain: &[Ribbon]) -> f64 {
    let larger = |k: Knot| Knot::new(k.x * SCALE, k.y * SCALE, k.w * SCALE);
    let larger: Vec<Ribbon> = chain.iter().map(|r| Ribbon(r.0.map(larger))).collect();
    let truth = Rows::of_discs(&larger, 0.0, 1.0 / ROWS as f64, PIXELS * ROWS).pixels(PIXELS, ROWS);
    let found = painted(painter, chain);
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

/// The lines of a figure in every emotion, in the figure's own units.
fn lines(figure: &str, widths: Widths) -> Vec<(String, Vec<Ribbon>)> {
    let figure = LineFigure::built_in(figure).unwrap().with_widths(widths);
    let mut all = Vec::new();
    for emotion in Emotion::ALL {
        let lines = inked::lines(&figure, &Pose::of(Ratios::pure(emotion)));
        all.extend(lines.into_iter().map(|(name, chain)| (format!("{emotion} {name}"), chain)));
    }
    all
}

/// How high the rows are in which a figure's lines are looked at, in its units.
const HIGH: f64 = 0.04;

/// As the renderers ask for it (`render::TOLERANCE`).
const TOLERANCE: f64 = 0.05;

#[test]
fn an_outline_is_the_union_of_its_discs() {
    let mut errors = Errors::default();
    for (name, stroke) in drawn() {
        let off = error(&[stroke], &outline(&[stroke], TOLERANCE), 0.02);
        println!("{name}: {:.2} %", 100.0 * off);
        errors.0.push((off, name.to_owned()));
    }
    for (i, stroke) in random().into_iter().enumerate() {
        errors.0.push((error(&[stroke], &outline(&[stroke], TOLERANCE), 0.05), format!("random {i}")));
    }
    errors.tell("strokes");
    assert!(errors.mean() <= MEAN && errors.worst().0 <= WORST);
}

#[test]
fn the_lines_of_a_figure_are_the_unions_of_their_discs() {
    let readings = [Widths::Bezier, Widths::Paper];
    for (figure, widths) in LineFigure::BUILT_IN.into_iter().flat_map(|f| readings.map(|w| (f, w))) {
        let (mut errors, mut four, mut eight) = (Errors::default(), Errors::default(), Errors::default());
        for (name, chain) in lines(figure, widths) {
            let off = |path: &BezPath| (error(&chain, path, HIGH), name.clone());
            errors.0.push(off(&outline(&chain, TOLERANCE)));
            four.0.push(off(&outline_in_pieces(&chain, 4)));
            eight.0.push(off(&outline_in_pieces(&chain, 8)));
        }
        errors.tell(&format!("{figure}, {}", widths.name()));
        four.tell("  in four pieces");
        eight.tell("  in eight pieces");
        assert!(errors.0.len() > 150);
        for errors in [errors, four, eight] {
            assert!(errors.mean() <= MEAN && errors.worst().0 <= WORST);
        }
    }
}

/// The measure itself: rows half as high say the same.
#[test]
fn the_measure_is_fine_enough() {
    for (name, chain) in lines("line", Widths::Bezier).into_iter().step_by(5) {
        let path = outline(&chain, TOLERANCE);
        let (coarse, fine) = (error(&chain, &path, HIGH), error(&chain, &path, HIGH / 2.0));
        assert!((coarse - fine).abs() < 3e-4, "{name}: {coarse} and {fine}");
    }
}

/// What is seen in the end, with what cutting curves into straight edges and whole 256ths of a pixel add.
#[test]
fn pixels_show_the_union_of_the_discs() {
    let mut painter = Painter::new(PIXELS as u32, PIXELS as u32).unwrap();
    let mut errors = Errors::default();
    let strokes = drawn().into_iter().map(|(name, s)| (name.to_owned(), vec![s]));
    let random = random().into_iter().enumerate().map(|(i, s)| (format!("random {i}"), vec![s]));
    for (name, chain) in strokes.chain(random) {
        errors.0.push((painted_error(&mut painter, &chain), name));
    }
    errors.tell("strokes, painted");
    let mut thin = Errors::default();
    for (name, chain) in lines("line", Widths::Bezier) {
        // As large as in a frame of 1280 × 720: the line face is 664 units high.
        let fit = 720.0 / 664.0 / SCALE;
        let place = |k: Knot| Knot::new((k.x + 40.0) * fit, (k.y - 100.0) * fit, k.w * fit);
        let chain: Vec<Ribbon> = chain.iter().map(|r| Ribbon(r.0.map(place))).collect();
        thin.0.push((painted_error(&mut painter, &chain), name));
    }
    thin.tell("lines of a face, painted");
    assert!(errors.mean() <= MEAN && errors.worst().0 <= WORST);
    // Where an outline lies over itself within a pixel the painter adds both parts: of one short line of the mouth, which
    // curls up, 2.7 %.
    let over = thin.0.iter().filter(|e| e.0 > WORST).count();
    assert!(thin.mean() <= MEAN && over <= 1 && thin.worst().0 <= 0.03);
}

//! What an active appearance model has learned: its mean, its mesh, and how shape and look vary.

use super::axes::chart;
use super::sheet::sheet;
use crate::aam::Model;
use crate::drawing::{Colour, Drawing, Item, Raster};
use crate::geometry::{Affine, BezPath, Circle, Point, Rect, Shape, stroke_outline};

/// Modes are drawn so far out, in their standard deviations.
const OUT: f64 = 2.0;
/// The most modes that are drawn, of the shape and of the look.
const SHOWN: usize = 6;
/// Units in the mean shape's width.
const ACROSS: f64 = 200.0;
/// Points, mesh and arrows, on greys and on paper.
const POINTS: Colour = Colour::rgb(0x3B, 0xD9, 0xA4);
const LINES: Colour = Colour::rgb(0x00, 0x72, 0xB2);
const MOVES: Colour = Colour::rgb(0xD5, 0x5E, 0x00);
const PAPER: Colour = Colour::rgb(0xE9, 0xE8, 0xE4);

/// A model on a sheet: the mean face, its points and its mesh; then a row a mode of the shape and of the look, at two
/// deviations to either side and what changes between.
#[must_use]
pub fn model(model: &Model) -> Drawing {
    let shapes = model.shapes();
    let page = Page::of(model);
    let mean = shapes.mean();
    let [pixels, parameters] = model.size();
    let triangles = model.triangles().len();
    let mut parts = vec![
        ("Mean face".to_owned(), page.face(&mean, 0, 0.0, false)),
        (format!("{} points: over the mean face", model.count()), page.face(&mean, 0, 0.0, true)),
        (format!("{triangles} triangles: {pixels} pixels and {parameters} parameters are fitted"), page.mesh(&mean)),
        page.nothing(),
        page.nothing(),
    ];
    let total: f64 = shapes.deviations().iter().map(|d| f64::from(d * d)).sum();
    let (forms, looks) = (shapes.deviations().len().min(SHOWN), model.looks().min(SHOWN));
    for k in 0..forms.max(looks) {
        let name = k + 1;
        match shapes.deviations().get(k).filter(|_| k < forms).map(|d| f64::from(*d)) {
            Some(deviation) => {
                let at = |by: f64| shapes.shape(&one(k, by * deviation));
                let share = 100.0 * deviation * deviation / total.max(1e-300);
                let said =
                    format!("Shape {name}: {share:.0} % of how shapes vary, from \u{2212}{OUT} to +{OUT} \u{3c3}");
                parts.push((format!("Shape {name}, \u{2212}{OUT} \u{3c3}"), page.face(&at(-OUT), 0, 0.0, true)));
                parts.push((said, page.moves(&at(-OUT), &at(OUT))));
                parts.push((format!("Shape {name}, +{OUT} \u{3c3}"), page.face(&at(OUT), 0, 0.0, true)));
            }
            None => parts.extend([page.nothing(), page.nothing(), page.nothing()]),
        }
        if k < looks {
            parts.push((format!("Look {name}, \u{2212}{OUT} \u{3c3}"), page.face(&mean, name, -OUT, false)));
            parts.push((format!("Look {name}, +{OUT} \u{3c3}"), page.face(&mean, name, OUT, false)));
        } else {
            parts.extend([page.nothing(), page.nothing()]);
        }
    }
    let mut drawing = sheet(&parts, 5);
    drawing.title = "A model".into();
    drawing
}

/// A vector with one number that is not 0.
fn one(k: usize, v: f64) -> Vec<f64> {
    (0..=k).map(|i| if i == k { v } else { 0.0 }).collect()
}

/// What every face on the sheet has in common.
struct Page<'m> {
    model: &'m Model,
    /// What is shown, in widths of the mean shape.
    view: Rect,
    place: Affine,
}

impl<'m> Page<'m> {
    fn of(model: &'m Model) -> Self {
        let shapes = model.shapes();
        let mut all = shapes.mean();
        for (k, deviation) in shapes.deviations().iter().take(SHOWN).enumerate() {
            for by in [-OUT, OUT] {
                all.extend(shapes.shape(&one(k, by * f64::from(*deviation))));
            }
        }
        let first = Rect::from_points(Point::ORIGIN, Point::ORIGIN);
        let view = all.iter().fold(first, |r, p| r.union_pt(*p)).inflate(0.06, 0.06);
        Self { model, view, place: Affine::scale(ACROSS) * Affine::translate(-view.origin().to_vec2()) }
    }

    fn drawing(&self, items: Vec<Item>) -> Drawing {
        let size = self.view.size() * ACROSS;
        let mut drawing = chart("A face", "A face of the model.", size.width, size.height, items);
        drawing.background = Some(PAPER);
        drawing
    }

    /// A place that stays empty.
    fn nothing(&self) -> (String, Drawing) {
        let mut drawing = self.drawing(Vec::new());
        drawing.background = None;
        (String::new(), drawing)
    }

    /// A shape with the mean look, moved along one of its modes, and its points if wanted.
    fn face(&self, shape: &[Point], mode: usize, by: f64, dots: bool) -> Drawing {
        let scale = 2.0 * ACROSS;
        let (width, height) = ((self.view.width() * scale) as usize + 1, (self.view.height() * scale) as usize + 1);
        let at = |p: Point| (Affine::scale(2.0) * self.place) * p;
        let placed: Vec<Point> = shape.iter().map(|p| at(*p)).collect();
        let painted = self.model.painted(&placed, mode, by, [width, height]);
        let raster = Raster::new("face", painted).placed(Affine::scale(0.5));
        let mut items = vec![Item::Picture(raster)];
        if dots {
            let dot = |p: &Point| Item::area("", Circle::new(self.place * *p, 1.6).to_path(0.05), POINTS);
            items.extend(shape.iter().take(self.model.count()).map(dot));
        }
        self.drawing(items)
    }

    fn mesh(&self, shape: &[Point]) -> Drawing {
        let mut lines = BezPath::new();
        for [a, b, c] in self.model.triangles() {
            lines.move_to(shape[*a]);
            lines.line_to(shape[*b]);
            lines.line_to(shape[*c]);
            lines.close_path();
        }
        let lines = stroke_outline(&(self.place * lines), 0.8);
        let dot = |p: &Point| Item::area("", Circle::new(self.place * *p, 1.8).to_path(0.05), MOVES);
        let items =
            std::iter::once(Item::area("mesh", lines, LINES)).chain(shape.iter().take(self.model.count()).map(dot));
        self.drawing(items.collect())
    }

    /// How each point moves from a shape to another.
    fn moves(&self, from: &[Point], to: &[Point]) -> Drawing {
        let mut items = Vec::new();
        for (a, b) in from.iter().zip(to).take(self.model.count()) {
            let (a, b) = (self.place * *a, self.place * *b);
            let mut line = BezPath::new();
            line.move_to(a);
            line.line_to(b);
            if a.distance(b) > 0.5 {
                items.push(Item::area("", stroke_outline(&line, 1.1), MOVES));
            }
            items.push(Item::area("", Circle::new(a, 1.3).to_path(0.05), LINES));
            items.push(Item::area("", Circle::new(b, 1.8).to_path(0.05), MOVES));
        }
        self.drawing(items)
    }
}

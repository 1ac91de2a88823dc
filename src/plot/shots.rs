//! The shapes of a calibration (paper fig. 3): each laid over the mean, as its mesh.

use super::axes::{TEXT, chart};
use super::curves::heading;
use super::{GREY, INK, colour_of};
use crate::aam::triangles;
use crate::calibration::{Calibration, Source};
use crate::drawing::{Anchor, Colour, Drawing, Item};
use crate::geometry::{Affine, BezPath, Circle, Point, Rect, Shape, stroke_outline};
use crate::pose::Emotion;

/// A cell of the sheet.
const CELL: (f64, f64) = (290.0, 340.0);
/// The neutral shape behind each of the others.
const BEHIND: Colour = Colour::rgb(0xC9, 0xC8, 0xC4);
/// How large a point is.
const DOT: f64 = 2.2;

/// The seven shots laid over each other, one a cell: its mesh in its emotion's colour, the neutral one behind it, how
/// it came to be, and `said` of it.
#[must_use]
pub fn shots(title: &str, calibration: &Calibration, said: &[String; 7]) -> Drawing {
    let laid = calibration.laid();
    let mesh = edges(&laid[0]);
    let all = laid.iter().flatten();
    let bounds = all.fold(Rect::new(f64::MAX, f64::MAX, f64::MIN, f64::MIN), |r, p| r.union_pt(*p));
    let mut items = vec![heading(title)];
    for emotion in Emotion::ALL {
        let i = emotion.index();
        let (x, y) = ((i % 4) as f64 * CELL.0 + 20.0, (i / 4) as f64 * CELL.1 + 60.0);
        let name = format!("{} {emotion}", emotion.letter());
        items.push(Item::text(Point::new(x + 8.0, y + 14.0), TEXT + 1.0, Anchor::Start, INK, name));
        let how = match calibration.shapes()[i].source {
            Source::Marked => "marked by hand".to_owned(),
            Source::Found(sure) => format!("found, {:.0} % sure", 100.0 * sure),
            Source::Modelled => "modelled: no shot".to_owned(),
        };
        for (line, text) in [how, said[i].clone()].into_iter().enumerate() {
            let at = Point::new(x + 8.0, y + 32.0 + 17.0 * line as f64);
            items.push(Item::text(at, TEXT - 1.0, Anchor::Start, GREY, text));
        }
        let area = Rect::new(x + 8.0, y + 60.0, x + CELL.0 - 24.0, y + CELL.1 - 14.0);
        let scale = (area.width() / bounds.width()).min(area.height() / bounds.height());
        let place = Affine::translate(area.center().to_vec2())
            * Affine::scale(scale)
            * Affine::translate(-bounds.center().to_vec2());
        if i > 0 {
            items.push(net(&laid[0], &mesh, place, BEHIND, 1.0));
        }
        items.push(net(&laid[i], &mesh, place, colour_of(emotion), 1.2));
        items.push(dots(&laid[i], place, INK));
    }
    let said = "The seven calibration shots, laid over the neutral one.";
    chart(title, said, 4.0 * CELL.0 + 20.0, 2.0 * CELL.1 + 70.0, items)
}

/// The edges of the mesh, each once.
fn edges(points: &[Point]) -> Vec<[usize; 2]> {
    let mut edges: Vec<[usize; 2]> = triangles(points)
        .iter()
        .flat_map(|t| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]])
        .map(|[a, b]| [a.min(b), a.max(b)])
        .collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}

fn net(points: &[Point], mesh: &[[usize; 2]], place: Affine, colour: Colour, width: f64) -> Item {
    let mut path = BezPath::new();
    for [a, b] in mesh {
        path.move_to(place * points[*a]);
        path.line_to(place * points[*b]);
    }
    Item::area("", stroke_outline(&path, width), colour)
}

fn dots(points: &[Point], place: Affine, colour: Colour) -> Item {
    let mut path = BezPath::new();
    for p in points {
        path.extend(Circle::new(place * *p, DOT).path_elements(0.1));
    }
    Item::area("", path, colour)
}

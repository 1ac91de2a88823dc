//! A model's look, painted onto a shape.

use super::ground::Channels;
use super::level::grid;
use super::model::Model;
use crate::drawing::Picture;
use crate::geometry::Point;

/// How many deviations of a texture's values there are from black to white.
const SPAN: f64 = 5.0;

impl Model {
    /// How many modes its look has.
    #[must_use]
    pub(crate) fn looks(&self) -> usize {
        self.stored.last().map_or(0, |l| l.textures.len().saturating_sub(1))
    }

    /// The mean look, moved `by` deviations along its mode (1 is the first; 0 and what there is not: none), painted onto
    /// a shape in a picture of `width` × `height` pixels: grey with alpha, nothing where the shape is
    /// not. Of a model that compares edges the mean strength of edges is painted, dark on light.
    #[must_use]
    pub(crate) fn painted(&self, shape: &[Point], mode: usize, by: f64, [width, height]: [usize; 2]) -> Picture {
        let mut picture = Picture::filled(width, height, [0; 4]);
        let (Some(level), Some(look)) = (self.levels.last(), self.stored.last()) else { return picture };
        let table = &level.table;
        let value = |t: usize, i: usize| f64::from(look.textures[t].values[i]) * f64::from(look.textures[t].step);
        let moved = look.textures.get(mode).filter(|_| mode > 0).map_or(0.0, |t| by * f64::from(t.deviation));
        let channels = look.channels.count();
        let planes: Vec<Vec<f64>> = (0..channels)
            .map(|channel| {
                let mut next = channel * table.count()..;
                let value = |i: usize| value(0, i) + if moved == 0.0 { 0.0 } else { moved * value(mode, i) };
                let texture: Vec<f64> =
                    table.places().map(|at| at.and_then(|_| next.next()).map_or(0.0, value)).collect();
                grid(table, &texture)
            })
            .collect();
        // A texture has length 1, so that this is the deviation of its values.
        let deviation = 1.0 / ((table.count() * channels) as f64).sqrt();
        let [w, _] = table.size();
        let mean: Vec<Point> = self.shapes.mean().iter().map(|p| table.place(*p)).collect();
        for t in &self.triangles {
            let [a, b, c] = t.map(|v| shape[v]);
            let area = (b - a).cross(c - a);
            if area.abs() < 1e-9 {
                continue;
            }
            let low = |f: fn(Point) -> f64| f(a).min(f(b)).min(f(c)).floor().max(0.0) as usize;
            let high =
                |f: fn(Point) -> f64, size: usize| f(a).max(f(b)).max(f(c)).ceil().clamp(0.0, size as f64) as usize;
            for y in low(|p| p.y)..high(|p| p.y, height) {
                for x in low(|p| p.x)..high(|p| p.x, width) {
                    let p = Point::new(x as f64, y as f64) - a;
                    let (u, v) = (p.cross(c - a) / area, (b - a).cross(p) / area);
                    if u < -1e-9 || v < -1e-9 || u + v > 1.0 + 1e-9 {
                        continue;
                    }
                    let [a, b, c] = t.map(|v| mean[v]);
                    let at = a + (b - a) * u + (c - a) * v;
                    let values: Vec<f64> = planes.iter().map(|plane| between(plane, w, at) / deviation).collect();
                    let grey = match look.channels {
                        Channels::Luma => 0.5 + values[0] / SPAN,
                        Channels::Edges => 1.0 - values[0].hypot(values[1]) / SPAN,
                    };
                    let grey = (255.0 * grey).clamp(0.0, 255.0) as u8;
                    picture[(x, y)] = [grey, grey, grey, 255];
                }
            }
        }
        picture
    }
}

/// The value of a grid between its pixels; 0 where it has none.
fn between(grid: &[f64], width: usize, at: Point) -> f64 {
    let (x, y) = (at.x.max(0.0).floor(), at.y.max(0.0).floor());
    let (fx, fy) = (at.x - x, at.y - y);
    let i = y as usize * width + x as usize;
    let value = |i: usize| grid.get(i).copied().filter(|v| !v.is_nan());
    let near = value(i).unwrap_or(0.0);
    let [b, c, d] = [i + 1, i + width, i + width + 1].map(|i| value(i).unwrap_or(near));
    (near * (1.0 - fx) + b * fx) * (1.0 - fy) + (c * (1.0 - fx) + d * fx) * fy
}

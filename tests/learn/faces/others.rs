//! Pictures without a face that could be accepted: drawn by chance, torn from photos, or heads turned away.

use lianpu::geometry::{Point, Similarity};
use lianpu::photo::{Photo, Plane};

use crate::chance::Chance;

/// Kinds of drawn pictures.
const DRAWN: usize = 9;

/// A picture drawn by chance, `side` pixels wide and high.
pub fn drawn(kind: usize, side: usize, chance: &mut Chance) -> Plane {
    let mut plane = clouds(side, chance.between(0.3, 1.2), chance);
    let n = side as f64;
    match kind % DRAWN {
        0 => {}
        1 => plane.pixels_mut().iter_mut().for_each(|v| *v = (128.0 + 60.0 * chance.normal()).clamp(0.0, 255.0) as f32),
        2 => {
            // Blobs, dark and light, often in rows, as eyes and windows are.
            for _ in 0..chance.below(120) + 20 {
                let value = chance.between(0.0, 255.0) as f32;
                let (x, y) = (chance.between(0.0, n), chance.between(0.0, n));
                let (rx, ry) = (chance.between(3.0, n / 8.0), chance.between(3.0, n / 8.0));
                let twins = 1 + chance.below(3);
                for k in 0..twins {
                    ellipse(&mut plane, x + k as f64 * rx * 3.0, y, rx, ry, value);
                }
            }
        }
        3 => {
            // Stripes and checks.
            let (fx, fy) = (chance.between(0.02, 0.5), chance.between(0.0, 0.4));
            let both = chance.share() < 0.5;
            for y in 0..side {
                for x in 0..side {
                    let a = (x as f64 * fx + y as f64 * fy).sin() > 0.0;
                    let b = both && (x as f64 * -fy + y as f64 * fx).sin() > 0.0;
                    plane[(x, y)] = plane[(x, y)] * 0.3 + if a != b { 170.0 } else { 20.0 };
                }
            }
        }
        4 => {
            // Leaning boxes, as houses and shelves are.
            for _ in 0..chance.below(60) + 20 {
                let value = chance.between(0.0, 255.0) as f32;
                let (x, y) = (chance.between(0.0, n) as usize, chance.between(0.0, n) as usize);
                let (w, h) = (chance.between(4.0, n / 4.0) as usize, chance.between(4.0, n / 4.0) as usize);
                for row in y..(y + h).min(side) {
                    for v in &mut plane.row_mut(row)[x..(x + w).min(side)] {
                        *v = *v * 0.2 + value * 0.8;
                    }
                }
            }
        }
        5 => {
            // Writing: short strokes in rows.
            plane.pixels_mut().iter_mut().for_each(|v| *v = *v * 0.1 + 215.0);
            let height = chance.between(6.0, 40.0);
            let mut y = height;
            while y + height < n {
                let mut x = height;
                while x + height < n {
                    for _ in 0..3 {
                        let at = |c: &mut Chance| c.between(0.0, height * 0.7);
                        let (x0, y0, x1, y1) = (at(chance), at(chance), at(chance), at(chance));
                        line(&mut plane, x + x0, y + y0, x + x1, y + y1, height / 12.0 + 0.7, 20.0);
                    }
                    x += height * chance.between(0.7, 1.4);
                }
                y += height * 1.6;
            }
        }
        6 => {
            // Land under a sky.
            let far = chance.between(0.3, 0.7) * n;
            let waves: Vec<(f64, f64, f64)> = (0..6)
                .map(|_| (chance.between(0.003, 0.08), chance.between(0.0, 6.0), chance.between(0.0, n / 25.0)))
                .collect();
            for layer in 0..4 {
                let shade = 190.0 - 45.0 * f64::from(layer);
                for x in 0..side {
                    let rise: f64 = waves.iter().map(|(f, p, a)| (x as f64 * f + p + f64::from(layer)).sin() * a).sum();
                    let top = (far + f64::from(layer) * n / 10.0 + rise).clamp(0.0, n - 1.0) as usize;
                    for y in top..side {
                        let v = &mut plane[(x, y)];
                        *v = (f64::from(*v) * 0.25 + shade * 0.75) as f32;
                    }
                }
            }
        }
        7 => {
            // Faces as children draw them, and sockets.
            for _ in 0..1 + chance.below(5) {
                let r = chance.between(n / 16.0, n / 4.0);
                let (x, y) = (chance.between(r, n - r), chance.between(r, n - r));
                let (light, dark) = (chance.between(150.0, 255.0) as f32, chance.between(0.0, 90.0) as f32);
                ellipse(&mut plane, x, y, r * 1.04, r * chance.between(1.0, 1.35), dark);
                ellipse(&mut plane, x, y, r, r * chance.between(1.0, 1.3), light);
                let (ex, ey, er) =
                    (r * chance.between(0.25, 0.45), r * chance.between(0.1, 0.35), r * chance.between(0.05, 0.2));
                for s in [-1.0, 1.0] {
                    ellipse(&mut plane, x + s * ex, y - ey, er, er * chance.between(0.5, 1.6), dark);
                }
                ellipse(&mut plane, x, y + r * 0.5, r * chance.between(0.1, 0.5), r * chance.between(0.03, 0.2), dark);
            }
        }
        _ => {
            // A web of lines.
            for _ in 0..chance.below(150) + 20 {
                let mut at = || chance.between(0.0, n);
                let (a, b, c, d) = (at(), at(), at(), at());
                let (wide, value) = (chance.between(0.7, 7.0), chance.between(0.0, 255.0) as f32);
                line(&mut plane, a, b, c, d, wide, value);
            }
        }
    }
    if chance.share() < 0.5 { plane.blurred(chance.between(0.5, 3.0)) } else { plane }
}

/// Noise whose waves are the stronger the longer they are.
fn clouds(side: usize, fall: f64, chance: &mut Chance) -> Plane {
    let mut plane = Plane::filled(side, side, 128.0);
    let mut size = 4;
    while size < side {
        let grid = Plane::new(
            size,
            size,
            (0..size * size).map(|_| (55.0 * (4.0 / size as f64).powf(fall) * chance.normal()) as f32).collect(),
        );
        let step = (size - 1) as f64 / side as f64;
        for y in 0..side {
            for x in 0..side {
                plane[(x, y)] += grid.sample(x as f64 * step, y as f64 * step);
            }
        }
        size *= 2;
    }
    plane.pixels_mut().iter_mut().for_each(|v| *v = v.clamp(0.0, 255.0));
    plane
}

fn ellipse(plane: &mut Plane, x: f64, y: f64, rx: f64, ry: f64, value: f32) {
    let (w, h) = (plane.width() as f64, plane.height() as f64);
    for j in (y - ry).max(0.0) as usize..(y + ry).clamp(0.0, h) as usize {
        for i in (x - rx).max(0.0) as usize..(x + rx).clamp(0.0, w) as usize {
            let d = ((i as f64 - x) / rx).powi(2) + ((j as f64 - y) / ry).powi(2);
            if d < 1.0 {
                plane[(i, j)] = value;
            }
        }
    }
}

fn line(plane: &mut Plane, x0: f64, y0: f64, x1: f64, y1: f64, wide: f64, value: f32) {
    let steps = (x1 - x0).hypot(y1 - y0).ceil().max(1.0);
    for k in 0..=steps as usize {
        let t = k as f64 / steps;
        ellipse(plane, x0 + (x1 - x0) * t, y0 + (y1 - y0) * t, wide.max(1.0), wide.max(1.0), value);
    }
}

/// A plane turned by quarters of a full turn.
pub fn quarters(plane: &Plane, quarters: usize) -> Plane {
    let (w, h) = (plane.width(), plane.height());
    let (width, height) = if quarters % 2 == 1 { (h, w) } else { (w, h) };
    let value = |x: usize, y: usize| match quarters % 4 {
        0 => plane[(x, y)],
        1 => plane[(y, h - 1 - x)],
        2 => plane[(w - 1 - x, h - 1 - y)],
        _ => plane[(w - 1 - y, x)],
    };
    let values = (0..width * height).map(|i| value(i % width, i / width)).collect();
    Plane::new(width, height, values)
}

/// A photo whose tiles have changed places.
pub fn shuffled(plane: &Plane, tile: usize, chance: &mut Chance) -> Plane {
    let (nx, ny) = (plane.width() / tile, plane.height() / tile);
    let mut order: Vec<usize> = (0..nx * ny).collect();
    for i in (1..order.len()).rev() {
        order.swap(i, chance.below(i + 1));
    }
    let mut out = Plane::filled(nx * tile, ny * tile, 0.0);
    for y in 0..ny * tile {
        for x in 0..nx * tile {
            let from = order[y / tile * nx + x / tile];
            let (sx, sy) = (from % nx * tile + x % tile, from / nx * tile + y % tile);
            out[(x, y)] = plane[(sx, sy)];
        }
    }
    out
}

/// How far a head's surface lies before the axis of its neck, in pupil distances: an ellipsoid with a nose.
fn depth(x: f64, y: f64) -> f64 {
    let inside = 1.0 - (x / 1.22).powi(2) - ((y - 0.35) / 1.75).powi(2);
    let nose = 0.30 * (-(x / 0.17).powi(2) - ((y - 0.58) / 0.24).powi(2)).exp();
    if inside <= 0.0 { 0.0 } else { 1.35 * inside.sqrt() + nose }
}

/// A photo as if its head were turned by `yaw` radians to a side, and where points of it come to lie.
pub fn turned(photo: &Photo, face: &Similarity, yaw: f64, points: &[Point]) -> (Photo, Vec<Point>) {
    let (w, h) = (photo.width(), photo.height());
    let (sin, cos) = yaw.sin_cos();
    // The middle of the face stays about where it is.
    let shift = -1.2 * sin;
    let moved = |p: Point| {
        let q = face.undo(p);
        let z = depth(q.x, q.y);
        let within = (z / 0.3).min(1.0);
        let x = (q.x * cos + z * sin + shift) * within + q.x * (1.0 - within);
        (Point::new(x, q.y), z * cos - q.x * sin)
    };
    let mut pixels = photo.pixels().to_vec();
    let mut near = vec![f64::NEG_INFINITY; w * h];
    for y in 0..h {
        let mut last: Option<f64> = None;
        for step in 0..2 * w {
            let x = step as f64 / 2.0;
            let from = Point::new(x, y as f64);
            let (q, z) = moved(from);
            // Turned heads are drawn row by row: the face is nearly upright.
            let to = face.apply(q).x;
            let source = photo.at(x.round() as isize, y as isize);
            if let Some(before) = last {
                let (a, b) = (before.min(to), before.max(to));
                if b - a < 40.0 {
                    for column in a.ceil().max(0.0) as usize..(b.floor().max(-1.0) + 1.0) as usize {
                        if column < w && z >= near[y * w + column] - 1e-9 {
                            near[y * w + column] = z;
                            pixels[y * w + column] = source;
                        }
                    }
                }
            }
            last = Some(to);
        }
    }
    (Photo::new(w, h, pixels), points.iter().map(|p| face.apply(moved(*p).0)).collect())
}

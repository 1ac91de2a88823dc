//! A line drawn over the face: a height for every x between its first and last point.

use crate::vector::mix;

const STEPS: usize = 96;

/// A smooth function of x through given points, tabulated; beyond its ends it keeps its end values.
#[derive(Clone)]
pub struct Curve {
    pub from: f32,
    pub to: f32,
    table: [f32; STEPS + 1],
}

impl Curve {
    /// Through `points`, whose x must rise: cubic Hermite pieces, each tangent the slope between the neighbours.
    pub fn through(points: &[(f32, f32)]) -> Curve {
        let n = points.len();
        let slope = |i: usize| {
            let (a, b) = (points[i.saturating_sub(1)], points[(i + 1).min(n - 1)]);
            (b.1 - a.1) / (b.0 - a.0)
        };
        let (from, to) = (points[0].0, points[n - 1].0);
        let mut table = [0.0; STEPS + 1];
        for (step, value) in table.iter_mut().enumerate() {
            let x = mix(from, to, step as f32 / STEPS as f32);
            let i = points[1..n - 1].iter().filter(|p| p.0 <= x).count();
            let (a, b) = (points[i], points[i + 1]);
            let w = b.0 - a.0;
            let t = (x - a.0) / w;
            let (t2, t3) = (t * t, t * t * t);
            *value = (2.0 * t3 - 3.0 * t2 + 1.0) * a.1
                + (t3 - 2.0 * t2 + t) * w * slope(i)
                + (3.0 * t2 - 2.0 * t3) * b.1
                + (t3 - t2) * w * slope(i + 1);
        }
        Curve { from, to, table }
    }

    pub fn at(&self, x: f32) -> f32 {
        let u = ((x - self.from) / (self.to - self.from)).clamp(0.0, 1.0) * STEPS as f32;
        let i = (u as usize).min(STEPS - 1);
        mix(self.table[i], self.table[i + 1], u - i as f32)
    }

    /// The same with every height changed by what is said of it and its x.
    pub fn altered(&self, by: impl Fn(f32, f32) -> f32) -> Curve {
        let mut table = self.table;
        for (step, y) in table.iter_mut().enumerate() {
            *y = by(mix(self.from, self.to, step as f32 / STEPS as f32), *y);
        }
        Curve { table, ..*self }
    }

    /// Rise over run at `x`.
    pub fn slope(&self, x: f32) -> f32 {
        let h = (self.to - self.from) / STEPS as f32;
        (self.at(x + h) - self.at(x - h)) / (2.0 * h)
    }

    /// How far `(x, y)` lies below the line (y grows downwards), measured across it.
    pub fn below(&self, x: f32, y: f32) -> f32 {
        let s = self.slope(x);
        (y - self.at(x)) / (1.0 + s * s).sqrt()
    }
}

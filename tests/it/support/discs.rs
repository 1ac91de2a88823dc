//! The union of the discs along strokes, looked at row by row: where the ink of each row begins and ends.
//!
//! Ends are exact; only rows and discs are counted, and both so closely that twice as many change nothing.

use lianpu::geometry::{BezPath, ParamCurve, Point, Ribbon, Shape};

/// The next disc of the union lies this share of its radius further on: what is missing between two of them is then
/// 0.01 % of the radius.
const APART: f64 = 0.03;

/// Discs smaller than this, in units of the drawing, lie as close as these.
const SMALL: f64 = 0.02;

/// Straight pieces that a curve of a path is looked at by.
const CHORDS: u32 = 100;

/// Ink row by row, each row by its middle line.
pub struct Rows {
    /// Where the first row begins, and how high one is.
    pub top: f64,
    pub high: f64,
    /// From where to where there is ink, left to right.
    pub ink: Vec<Vec<[f64; 2]>>,
}

impl Rows {
    /// The union of the discs of a chain.
    pub fn of_discs(chain: &[Ribbon], top: f64, high: f64, count: usize) -> Self {
        let mut rows = Self { top, high, ink: vec![Vec::new(); count] };
        for ribbon in chain {
            let mut t = 0.0;
            while t < 1.0 {
                rows.disc(ribbon, t);
                let (a, b) = (ribbon.eval((t - 1e-6).max(0.0)), ribbon.eval((t + 1e-6).min(1.0)));
                let rate = ((b.point() - a.point()).hypot() + (b.w - a.w).abs() / 2.0) / 2e-6;
                let radius = (ribbon.eval(t).w / 2.0).max(SMALL);
                t += (APART * radius / rate.max(1e-9)).clamp(1e-6, 1e-2);
            }
            rows.disc(ribbon, 1.0);
        }
        rows.ink.iter_mut().for_each(unite);
        rows
    }

    fn disc(&mut self, ribbon: &Ribbon, t: f64) {
        let knot = ribbon.eval(t);
        let radius = knot.w / 2.0;
        let row = |y: f64| ((y - self.top) / self.high - 0.5).ceil().clamp(0.0, self.ink.len() as f64) as usize;
        for i in row(knot.y - radius)..row(knot.y + radius) {
            let up = self.top + (i as f64 + 0.5) * self.high - knot.y;
            let half = (radius * radius - up * up).max(0.0).sqrt();
            self.ink[i].push([knot.x - half, knot.x + half]);
        }
    }

    /// What a path covers, filled non-zero.
    pub fn of_path(path: &BezPath, top: f64, high: f64, count: usize) -> Self {
        let mut crossings: Vec<Vec<(f64, i32)>> = vec![Vec::new(); count];
        let mut edge = |a: Point, b: Point| {
            let (a, b, down) = if a.y <= b.y { (a, b, 1) } else { (b, a, -1) };
            let row = |y: f64| ((y - top) / high - 0.5).ceil().clamp(0.0, count as f64) as usize;
            for (i, crossing) in crossings.iter_mut().enumerate().take(row(b.y)).skip(row(a.y)) {
                let y = top + (i as f64 + 0.5) * high;
                crossing.push((a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y), down));
            }
        };
        for piece in path.segments() {
            // So many chords are nearer to any curve here than a ten-thousandth of a unit.
            let places: Vec<Point> = (0..=CHORDS).map(|i| piece.eval(f64::from(i) / f64::from(CHORDS))).collect();
            places.windows(2).for_each(|w| edge(w[0], w[1]));
        }
        let ink = crossings.into_iter().map(covered).collect();
        Self { top, high, ink }
    }

    /// The length of ink, and the length of ink that another has not or that only the other has.
    pub fn against(&self, other: &Self) -> (f64, f64) {
        let length = |row: &[[f64; 2]]| row.iter().map(|[a, b]| b - a).sum::<f64>();
        let rows = self.ink.iter().zip(&other.ink);
        rows.map(|(a, b)| (length(a), length(a) + length(b) - 2.0 * shared(a, b)))
            .fold((0.0, 0.0), |sum, row| (sum.0 + row.0, sum.1 + row.1))
    }

    /// How much of each pixel of a picture is inked, 0 to 1; `rows` to a pixel, and pixels of side 1 from 0.
    pub fn pixels(&self, width: usize, rows: usize) -> Vec<f32> {
        let mut shares = vec![0.0_f32; width * self.ink.len() / rows];
        for (i, row) in self.ink.iter().enumerate() {
            let line = &mut shares[i / rows * width..(i / rows + 1) * width];
            for [from, to] in row.iter().map(|ink| ink.map(|x| x.clamp(0.0, width as f64))) {
                for (x, share) in line.iter_mut().enumerate().take(to.ceil() as usize).skip(from as usize) {
                    let x = x as f64;
                    *share += ((to.min(x + 1.0) - from.max(x)) / rows as f64) as f32;
                }
            }
        }
        shares
    }
}

/// Where a line is covered, from where it goes into the path and out.
fn covered(mut crossings: Vec<(f64, i32)>) -> Vec<[f64; 2]> {
    crossings.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut winding, mut from, mut ink) = (0, 0.0, Vec::new());
    for (x, down) in crossings {
        if winding == 0 {
            from = x;
        }
        winding += down;
        if winding == 0 {
            ink.push([from, x]);
        }
    }
    unite(&mut ink);
    ink
}

/// Stretches that touch become one.
fn unite(ink: &mut Vec<[f64; 2]>) {
    ink.sort_by(|a, b| a[0].total_cmp(&b[0]));
    ink.dedup_by(|next, last| {
        let touch = next[0] <= last[1];
        if touch {
            last[1] = last[1].max(next[1]);
        }
        touch
    });
}

/// The length that two rows share.
fn shared(a: &[[f64; 2]], b: &[[f64; 2]]) -> f64 {
    let (mut i, mut j, mut sum) = (0, 0, 0.0);
    while i < a.len() && j < b.len() {
        sum += (a[i][1].min(b[j][1]) - a[i][0].max(b[j][0])).max(0.0);
        if a[i][1] < b[j][1] { i += 1 } else { j += 1 }
    }
    sum
}

/// The rows that a chain and its outline reach: where they begin and how many, `high` each.
pub fn reach(chain: &[Ribbon], path: &BezPath, high: f64) -> (f64, usize) {
    let knots = chain.iter().flat_map(|r| r.0).map(|k| (k.y - k.w.max(0.0), k.y + k.w.max(0.0)));
    let area = path.bounding_box();
    let (top, bottom) = knots.fold((area.y0, area.y1), |all, knot| (all.0.min(knot.0), all.1.max(knot.1)));
    (top - high, ((bottom - top) / high) as usize + 3)
}

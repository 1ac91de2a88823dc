//! The photo as the face sees it: warped once into the face's own frame, in OKLab.

use crate::drawing::{Colour, Oklab};
use crate::face::{FeaturePoint as P, Points, to_face_frame};
use crate::geometry::{Affine, Point, Rect};
use crate::photo::Photo;

/// What of the face frame is looked at, in units of which the pupils are 100 apart: it holds long hair and big hair.
pub(super) const VIEW: Rect = Rect::new(-230.0, -260.0, 230.0, 320.0);
/// Pixels of the frame in a row, one a unit: outlines are simplified to 2.3 units, so finer tells nothing.
pub(super) const WIDTH: usize = 460;
/// Rows of the frame.
pub(super) const HEIGHT: usize = 580;

/// A colour in OKLab: lightness, green to red, blue to yellow.
pub(super) type Lab = [f32; 3];

/// The photo in the face frame; pixel centres are whole units from [`VIEW`]'s corner.
pub(super) struct Frame {
    /// OKLab, row by row.
    pub lab: Vec<Lab>,
    /// Whether the photo shows the place; beyond its border the nearest pixel's colour stands in.
    pub inside: Vec<bool>,
    to_units: Affine,
    to_photo: Affine,
}

impl Frame {
    /// Warps `photo` so that the pupils of `points` lie 100 units apart on a level line.
    pub(crate) fn of(photo: &Photo, points: &Points) -> Self {
        let to_units = to_face_frame(points[P::P3_6], points[P::P3_5]);
        let to_photo = to_units.inverse();
        let scale = to_photo.determinant().abs().sqrt();
        let corner = Affine::translate(VIEW.origin().to_vec2());
        let small = Reduced::of(photo, to_photo.transform_rect_bbox(VIEW), scale);
        let [xx, xy, yx, yy, x0, y0] = (small.from_photo * to_photo * corner).as_coeffs().map(|c| c as f32);
        let (right, bottom) = (small.photo.width() as f32 - 0.5, small.photo.height() as f32 - 0.5);
        let curve = Curve::new();
        let mut lab = Vec::with_capacity(WIDTH * HEIGHT);
        let mut inside = Vec::with_capacity(WIDTH * HEIGHT);
        for row in 0..HEIGHT {
            let (bx, by) = (x0 + yx * row as f32, y0 + yy * row as f32);
            for column in 0..WIDTH {
                let (x, y) = (bx + xx * column as f32, by + xy * column as f32);
                inside.push(x >= -0.5 && y >= -0.5 && x <= right && y <= bottom);
                lab.push(curve.oklab(small.sample(x, y)));
            }
        }
        Self { lab, inside, to_units, to_photo }
    }

    /// The 47 points in units.
    pub(crate) fn units(&self, points: &Points) -> Points {
        Points(points.0.map(|p| self.to_units * p))
    }

    /// Units as pixels of the photo.
    pub(crate) fn photo(&self, p: Point) -> Point {
        self.to_photo * p
    }

    /// The colour at a place in units; beyond the frame that of its border.
    pub(crate) fn at(&self, x: f64, y: f64) -> Lab {
        let column = (x - VIEW.x0).round().clamp(0.0, (WIDTH - 1) as f64) as usize;
        let row = (y - VIEW.y0).round().clamp(0.0, (HEIGHT - 1) as f64) as usize;
        self.lab[row * WIDTH + column]
    }

    /// All colours within `radius` units of `at`, a square.
    pub(crate) fn around(&self, at: Point, radius: f64) -> Vec<Lab> {
        let r = Rect::from_center_size(at, (2.0 * radius, 2.0 * radius));
        self.within(&[Point::new(r.x0, r.y0), Point::new(r.x1, r.y0), Point::new(r.x1, r.y1), Point::new(r.x0, r.y1)])
    }

    /// All colours of the photo inside a polygon given in units.
    pub(crate) fn within(&self, polygon: &[Point]) -> Vec<Lab> {
        let mut found = Vec::new();
        let shifted: Vec<Point> = polygon.iter().map(|p| *p - VIEW.origin().to_vec2()).collect();
        scan(&shifted, WIDTH, HEIGHT, |row, from, to| {
            let place = row * WIDTH;
            found.extend((place + from..place + to).filter(|i| self.inside[*i]).map(|i| self.lab[i]));
        });
        found
    }
}

/// Calls `fill(row, from, to)` for every run of pixel centres inside a closed polygon (even-odd).
pub(super) fn scan(polygon: &[Point], width: usize, height: usize, mut fill: impl FnMut(usize, usize, usize)) {
    let low = polygon.iter().fold(f64::INFINITY, |m, p| m.min(p.y)).ceil().max(0.0);
    let high = polygon.iter().fold(f64::NEG_INFINITY, |m, p| m.max(p.y)).floor().min(height as f64 - 1.0);
    let mut crossings = Vec::new();
    let mut row = low;
    while row <= high {
        crossings.clear();
        for (a, b) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
            if (a.y <= row) != (b.y <= row) {
                crossings.push(a.x + (row - a.y) / (b.y - a.y) * (b.x - a.x));
            }
        }
        crossings.sort_by(f64::total_cmp);
        for pair in crossings.chunks_exact(2) {
            let from = pair[0].ceil().clamp(0.0, width as f64) as usize;
            let to = (pair[1].floor() + 1.0).clamp(0.0, width as f64) as usize;
            if from < to {
                fill(row as usize, from, to);
            }
        }
        row += 1.0;
    }
}

/// The part of a photo that the frame shows, made smaller by averaging whole areas where the photo is larger.
struct Reduced {
    photo: Photo,
    from_photo: Affine,
}

impl Reduced {
    /// `scale` is how many pixels of the photo one unit is.
    fn of(photo: &Photo, view: Rect, scale: f64) -> Self {
        let step = (scale.floor() as usize).max(1);
        let (w, h) = (photo.width(), photo.height());
        // At least one block is left, also where the frame lies beside the photo.
        let span = |low: f64, high: f64, length: usize| {
            let from = (low.floor() - 1.0).clamp(0.0, (length - 1) as f64) as usize;
            let to = (high.ceil() + 2.0).clamp((from + 1) as f64, length as f64) as usize;
            (from, (to - from).div_ceil(step))
        };
        let (left, width) = span(view.x0, view.x1, w);
        let (top, height) = span(view.y0, view.y1, h);
        let mut pixels = Vec::with_capacity(width * height);
        for row in 0..height {
            let rows = top + row * step..(top + (row + 1) * step).min(h);
            for column in 0..width {
                let columns = left + column * step..(left + (column + 1) * step).min(w);
                let count = (rows.len() * columns.len()).max(1) as u32;
                let mut sum = [count / 2; 3];
                for y in rows.clone() {
                    for p in &photo.row(y)[columns.clone()] {
                        sum.iter_mut().zip(p).for_each(|(s, v)| *s += u32::from(*v));
                    }
                }
                pixels.push(sum.map(|s| (s / count) as u8));
            }
        }
        // The centre of a block of n pixels lies (n - 1) / 2 after its first pixel's.
        let middle = (step as f64 - 1.0) / 2.0;
        let from_photo =
            Affine::scale(1.0 / step as f64) * Affine::translate((-(left as f64) - middle, -(top as f64) - middle));
        Self { photo: Photo::new(width, height, pixels), from_photo }
    }

    /// Bilinear, sRGB 0 to 255; beyond the border the nearest pixel.
    fn sample(&self, x: f32, y: f32) -> [f32; 3] {
        let ([a, b, c, d], [fx, fy]) = self.photo.around(f64::from(x), f64::from(y));
        let (fx, fy) = (fx as f32, fy as f32);
        std::array::from_fn(|k| {
            let mix = |p: &[u8; 3], q: &[u8; 3]| {
                let (u, v) = (f32::from(p[k]), f32::from(q[k]));
                u + (v - u) * fx
            };
            let (top, bottom) = (mix(a, b), mix(c, d));
            top + (bottom - top) * fy
        })
    }
}

/// The sRGB curve undone, as a table: 4 entries a step of 8 bits leave an error below 1e-5.
struct Curve(Vec<f32>);

impl Curve {
    fn new() -> Self {
        let linear = |v: f64| if v <= 0.040_45 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) };
        Self((0..=1024).map(|i| linear(f64::from(i) / 1020.0) as f32).collect())
    }

    /// OKLab of sRGB values from 0 to 255 (Ottosson 2020, as `drawing::Oklab`, in single precision).
    fn oklab(&self, rgb: [f32; 3]) -> Lab {
        let [r, g, b] = rgb.map(|v| {
            let place = v * 4.0;
            let i = (place as usize).min(1023);
            self.0[i] + (self.0[i + 1] - self.0[i]) * (place - i as f32)
        });
        let l = cube_root(0.412_221_46 * r + 0.536_332_55 * g + 0.051_445_995 * b);
        let m = cube_root(0.211_903_5 * r + 0.680_699_5 * g + 0.107_396_96 * b);
        let s = cube_root(0.088_302_46 * r + 0.281_718_85 * g + 0.629_978_7 * b);
        [
            0.210_454_26 * l + 0.793_617_8 * m - 0.004_072_047 * s,
            1.977_998_5 * l - 2.428_592_2 * m + 0.450_593_7 * s,
            0.025_904_037 * l + 0.782_771_77 * m - 0.808_675_77 * s,
        ]
    }
}

/// The cube root of a number from 0 to 1, to 1e-6: a third of the exponent, then two steps of Newton's.
fn cube_root(v: f32) -> f32 {
    if v < 1e-9 {
        return 0.0;
    }
    let mut x = f32::from_bits(v.to_bits() / 3 + 0x2a51_19f2);
    for _ in 0..2 {
        x = (2.0 * x + v / (x * x)) / 3.0;
    }
    x
}

/// A colour of the frame as files have it.
pub(super) fn colour(lab: Lab) -> Colour {
    Oklab { l: f64::from(lab[0]), a: f64::from(lab[1]), b: f64::from(lab[2]) }.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_quick_oklab_is_the_exact_one_to_four_digits() {
        let curve = Curve::new();
        for r in (0..=255_u8).step_by(15) {
            for g in (0..=255_u8).step_by(15) {
                for b in (0..=255_u8).step_by(15) {
                    let exact = Oklab::from(Colour::rgb(r, g, b));
                    let quick = curve.oklab([r, g, b].map(f32::from));
                    for (q, e) in quick.into_iter().zip([exact.l, exact.a, exact.b]) {
                        assert!((f64::from(q) - e).abs() < 2e-4, "{r} {g} {b}: {q} for {e}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_photo_four_times_as_large_makes_the_same_frame() {
        let tone = |x: usize, y: usize| [(x / 2 % 256) as u8, (y / 2 % 256) as u8, ((x + y) / 8 % 256) as u8];
        let of = |factor: usize| {
            let (w, h) = (400 * factor, 500 * factor);
            let pixels = (0..w * h).map(|i| tone(i % w / factor, i / w / factor)).collect();
            let mut points = Points([Point::ZERO; P::FIXED]);
            // Pixel centres are whole numbers: the middle of the first pixel is (factor - 1) / 2 of the larger one.
            let at = |x: f64, y: f64| {
                let f = factor as f64;
                Point::new(x * f + (f - 1.0) / 2.0, y * f + (f - 1.0) / 2.0)
            };
            points[P::P3_6] = at(150.0, 240.0);
            points[P::P3_5] = at(250.0, 240.0);
            Frame::of(&Photo::new(w, h, pixels), &points)
        };
        let (one, four) = (of(1), of(4));
        let off: f32 =
            one.lab.iter().zip(&four.lab).map(|(a, b)| (a[0] - b[0]).abs()).sum::<f32>() / one.lab.len() as f32;
        assert!(off < 0.01, "mean difference {off}");
        assert_eq!(one.inside.iter().filter(|i| **i).count(), four.inside.iter().filter(|i| **i).count());
    }
}
